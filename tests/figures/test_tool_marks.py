"""What a tool of somebody else marks is drawn in figures."""

from types import SimpleNamespace

import numpy as np
import pytest

import app
from app.document import tools
from tests.shapes import bumpy

from .marked_tool import CYAN, LIME, MAGENTA, TOOL


@pytest.fixture
def joined(monkeypatch):
    """The tool has joined by its entry point."""
    entry = SimpleNamespace(name="farthest", load=lambda: TOOL)
    monkeypatch.setattr(tools, "entry_points", lambda group: [entry])
    tools.tools.cache_clear()
    yield
    tools.tools.cache_clear()


def pixels():
    """A figure from the front and from the back, so that all is seen once."""
    surface = bumpy(200)
    shown = app.figure(
        (surface.vertices, surface.faces),
        ["biharmonic"],
        source=4,
        layout={"size": "800x400"},
        view={"cpos": ["front", "back"]},
    )
    return shown.pixels


def painted(pixels, colour):
    """How many pixels have a colour, nearly."""
    wanted = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
    return int((np.abs(pixels[..., :3].astype(int) - wanted).max(axis=-1) < 60).sum())


def test_points_lines_and_areas_of_a_tool_are_drawn(joined):
    drawn = pixels()
    assert all(painted(drawn, colour) > 20 for colour in (MAGENTA, LIME, CYAN))


def test_without_it_they_are_not():
    assert not any(painted(pixels(), colour) for colour in (MAGENTA, LIME, CYAN))
