"""The time that panels take to follow a value, and the number of new solves, in the status bar."""

import time

from qtpy import QtCore

from bihdist_core.counts import counted

from ...qt.context import Context
from ...session.loaded_mesh import LoadedMesh
from .answers import InterpolantMemory
from .part import Anchor, Anchors


class AnchorClock:
    """Measures how long all panels take to follow the values of anchors."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._begun: float | None = None
        self._columns = 0
        self._anchors: tuple[Anchor, ...] = ()

    def begin(self, anchors: tuple[Anchor, ...]) -> None:
        """Start the clock: the values become these."""
        session = self._context.session
        loaded = session.loaded()
        if loaded is not None and anchors != session.document[Anchors].anchors:
            self._begun, self._columns, self._anchors = time.perf_counter(), _columns(loaded), anchors

    def note(self) -> None:
        """Note that a panel shows another field; the time is told when all do, after they were painted."""
        session = self._context.session
        if session.document[Anchors].anchors != self._anchors:
            self._begun = None  # something else has been done meanwhile
        if self._begun is not None and all(session.is_answered(panel.id) for panel in session.document.panels):
            QtCore.QTimer.singleShot(0, self._say)

    def _say(self) -> None:
        begun, self._begun = self._begun, None
        loaded = self._context.session.loaded()
        if begun is None or loaded is None:
            return
        count = _columns(loaded) - self._columns
        solved = f", with {counted(count, 'new solve')}" if count else ", without solving again"
        self._context.status.show_time(f"Updated in {1000 * (time.perf_counter() - begun):.0f} ms{solved}")


def _columns(loaded: LoadedMesh) -> int:
    """Return the number of columns of distances solved for so far."""
    return loaded.memory(InterpolantMemory).columns
