"""The fixtures of the folders beside: a tool is tested in the document, in figures and in the window."""

from tests.app.conftest import desk
from tests.figures.conftest import drawn, mesh
from tests.qt.conftest import application, head, open_screens, out, screen, shared_screen, small

__all__ = ["application", "desk", "drawn", "head", "mesh", "open_screens", "out", "screen", "shared_screen", "small"]
