"""What happens in a panel by the mouse, and in its head and its bar: typed events, with who wants to hear of them."""

from collections import defaultdict
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from qtpy import QtCore

from ...document.quantities import Quantity
from ...scene.picking import Hit

Event = TypeVar("Event")


class Events:
    """`on(Click, handler)`: the handler is called with a panel's id and each `Click` in it, after those before it."""

    def __init__(self) -> None:
        self._handlers: defaultdict[type, list[Callable[[int, Any], object]]] = defaultdict(list)

    def on(self, kind: type[Event], handler: Callable[[int, Event], object]) -> None:
        """Call the handler with the panel and the event, for each event of a kind."""
        self._handlers[kind].append(handler)

    def emit(self, panel: int, event: object) -> None:
        """Hand an event of a panel to all who asked for its kind."""
        for handler in tuple(self._handlers[type(event)]):
            handler(panel, event)


class Click(NamedTuple):
    """Of the left button on the surface, without a move."""

    hit: Hit
    has_shift: bool = False
    has_ctrl: bool = False

    @property
    def is_plain(self) -> bool:
        """Whether neither Shift nor Ctrl was held."""
        return not (self.has_shift or self.has_ctrl)


class MarkClick(NamedTuple):
    """On a pin marker.  tool: whose it is, by its word; number: from 1."""

    tool: str
    number: int
    has_ctrl: bool = False


class MarkDrag(NamedTuple):
    """The tip of a pin marker, or with the tool "" a mark of the source by its number from 0, is over a place."""

    tool: str
    number: int
    hit: Hit


class MarkRelease(NamedTuple):
    """The button is up that has dragged a mark."""

    tool: str


class Stroke(NamedTuple):
    """The surface is drawn on.  hit: None beside it."""

    hit: Hit | None


class StrokeEnd(NamedTuple):
    has_ctrl: bool


class Hover(NamedTuple):
    """hit: what is under the pointer, None beside the surface."""

    hit: Hit | None


class BrushTouch(NamedTuple):
    """pixel: how long a pixel is there."""

    hit: Hit
    pixel: float


class BrushLift:
    """The button is up that has painted."""


class MenuWanted(NamedTuple):
    """hit: None beside the surface; where: on the screen."""

    hit: Hit | None
    where: QtCore.QPoint


# ---------------------------------------------------------------------- of the head and the bar
class QuantityChosen(NamedTuple):
    shows: Quantity


class EditChosen(NamedTuple):
    """word: the text of a `PanelEdit`."""

    word: str


class BarEnded(NamedTuple):
    """end: where the colour bar is to end, None for the field's own maximum."""

    end: float | None


class SaveWanted:
    """Of the panel's field."""


class Cancelled:
    """What is computed for the panel."""


class Retried:
    """What was cancelled, once more."""
