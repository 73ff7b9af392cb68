"""Typed events for what the mouse does in a panel, and the handlers that listen to them."""

from collections import defaultdict
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from qtpy import QtCore

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
    """A click of the left button on the surface."""

    hit: Hit
    has_shift: bool = False
    has_ctrl: bool = False

    @property
    def is_plain(self) -> bool:
        """True if neither Shift nor Ctrl was held."""
        return not (self.has_shift or self.has_ctrl)


class SecondClick:
    """The second of two clicks on the surface, the first of which was a plain `Click`."""


class MarkClick(NamedTuple):
    """A click on a numbered mark of a tool; numbers start from 1."""

    tool: str
    number: int
    has_ctrl: bool = False


class MarkDrag(NamedTuple):
    """A mark is dragged to a place: one of a tool by its number, or of the source, with the tool "", from 0."""

    tool: str
    number: int
    hit: Hit


class MarkRelease(NamedTuple):
    """The end of dragging a mark of a tool."""

    tool: str


class Stroke(NamedTuple):
    """A point of a drawn stroke, None beside the surface."""

    hit: Hit | None


class StrokeEnd(NamedTuple):
    has_ctrl: bool


class Hover(NamedTuple):
    """The place under the pointer, None beside the surface."""

    hit: Hit | None


class BrushTouch(NamedTuple):
    """A touch of a brush, with the length of a pixel there."""

    hit: Hit
    pixel: float


class BrushLift:
    """The end of a stroke of a brush."""


class MenuWanted(NamedTuple):
    """A request for the menu of a place, None beside the surface, at a point of the screen."""

    hit: Hit | None
    where: QtCore.QPoint
