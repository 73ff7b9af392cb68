"""What clicks and drags mean while a change to the mesh is told by them: two places picked, faces cut out."""

from collections.abc import Callable

from qtpy import QtCore

from ...qt.context import Context
from ...qt.docks.brushing import Brushing
from ...qt.gesture import FIRST, Gesture
from ...qt.panels.events import Click

CLICK_FIRST, CLICK_SECOND = "Click the first of two places", "Click the second place"
NEW = "That part of the surface is new; click one that was there before"


class ChangeGestures(Gesture):
    """While it is on, clicks on a surface, or on one that is made from it, pick its vertices and do nothing else.

    picked: those so far, of the first surface of the document; word: what they are for.  `changed` is emitted whenever
    one of these is another.
    """

    changed = QtCore.Signal()
    turn = FIRST

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._done: Callable[[tuple[int, int]], None] = _nothing
        self.word = ""
        self.picked: tuple[int, ...] = ()

    def takes(self, panel: int, click: Click) -> bool:
        return click.is_plain and bool(self.word)

    def pick(self, word: str, done: Callable[[tuple[int, int]], None]) -> None:
        """done: called with both vertices."""
        self.word, self._done, self.picked = word, done, ()
        self.context.tell(CLICK_FIRST)
        self.changed.emit()

    def stop(self) -> None:
        """Let clicks pick no points of a change any more."""
        if self.word:
            self.word, self._done, self.picked = "", _nothing, ()
            self.context.tell("")
            self.changed.emit()

    def put_down(self) -> bool:
        is_picking, brushing = bool(self.word), self.context[Brushing]
        if is_picking:
            self.stop()
        elif brushing.cuts:
            brushing.switch(False)
            return True
        return is_picking

    def click(self, panel: int, click: Click) -> None:
        vertex = click.hit.vertex
        loaded = self.context.session.loaded_in(panel)
        if loaded is None:
            return
        if loaded.origin is not None:
            vertex = int(loaded.ids[vertex])
        if vertex < 0:
            self.context.tell(NEW)
            return
        if not self.picked:
            self.picked = (vertex,)
            self.context.tell(CLICK_SECOND)
            self.changed.emit()
        elif vertex != self.picked[0]:
            done, pair = self._done, (self.picked[0], vertex)
            self.stop()
            done(pair)


def _nothing(_: tuple[int, int]) -> None:
    pass
