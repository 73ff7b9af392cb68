"""Two vertices picked one after the other, by clicks on a surface.  `window` is the main window."""

from collections.abc import Callable
from typing import Any

from qtpy import QtCore

FIRST, SECOND = "Click the first of two places", "Click the second place"
NEW = "That part of the surface is new; click one that was there before"


class Picking(QtCore.QObject):
    """While it is on, clicks on a surface, or on one that is made from it, pick its vertices and do nothing else.

    picked: those so far, of the first surface of the document; word: what they are for.  `changed` is emitted whenever
    one of these is another.
    """

    changed = QtCore.Signal()

    def __init__(self, window: Any) -> None:
        super().__init__(window)
        self._window = window
        self._done: Callable[[tuple[int, int]], None] = _nothing
        self.word = ""
        self.picked: tuple[int, ...] = ()

    @property
    def is_on(self) -> bool:
        return bool(self.word)

    def begin(self, word: str, done: Callable[[tuple[int, int]], None]) -> None:
        """done: called with both vertices."""
        self.word, self._done, self.picked = word, done, ()
        self._window.say(FIRST)
        self.changed.emit()

    def stop(self) -> None:
        if self.is_on:
            self.word, self._done, self.picked = "", _nothing, ()
            self._window.say("")
            self.changed.emit()

    def take(self, panel: int, vertex: int) -> None:
        """A vertex of a panel's surface has been clicked."""
        loaded = self._window.session.opened_in(panel)
        if loaded is None:
            return
        if loaded.origin is not None:
            vertex = int(loaded.ids[vertex])
        if vertex < 0:
            self._window.say(NEW)
            return
        if not self.picked:
            self.picked = (vertex,)
            self._window.say(SECOND)
            self.changed.emit()
        elif vertex != self.picked[0]:
            done, pair = self._done, (self.picked[0], vertex)
            self.stop()
            done(pair)


def _nothing(_: tuple[int, int]) -> None:
    pass
