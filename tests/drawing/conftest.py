"""The painter for Qt needs the application of the window's tests."""

from tests.qt.conftest import application

__all__ = ["application"]
