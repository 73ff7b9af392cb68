"""Menu entries and keys for the sources of panels."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...qt.actions import Action
from ...qt.context import Context

if TYPE_CHECKING:
    from .gestures import SourceGestures


def _gestures(context: Context) -> "SourceGestures":
    from .gestures import SourceGestures  # with the panels: the window is shown before

    return context[SourceGestures]


def _step(right: int, up: int) -> Callable[[Context], object]:
    return lambda context: _gestures(context).step(right, up)


ACTIONS = (
    Action(
        "draw source",
        "&Draw a source",
        lambda c: _gestures(c).set_drawing(c.actions["draw source"].isChecked()),
        ("D",),
        "Drag over the surface: distances from a curve",
        needs_mesh=True,
        is_check=True,
        icon="draw",
        synonyms="curve line stroke pen",
    ),
    Action("step left", "Step along an edge to the left", _step(-1, 0), ("Ctrl+Left",), of_view=True, needs_mesh=True),
    Action(
        "step right", "Step along an edge to the right", _step(1, 0), ("Ctrl+Right",), of_view=True, needs_mesh=True
    ),
    Action("step up", "Step along an edge up", _step(0, 1), ("Ctrl+Up",), of_view=True, needs_mesh=True),
    Action("step down", "Step along an edge down", _step(0, -1), ("Ctrl+Down",), of_view=True, needs_mesh=True),
)
