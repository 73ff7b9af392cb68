"""How long panels take to follow a value, and what had to be solved for it, in the status bar."""

import time

from qtpy import QtCore

from ...qt.context import Context
from ...session.loaded_mesh import LoadedMesh
from .answers import InterpolantMemory
from .part import Anchor, Anchors


class AnchorClock:
    """See the module."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._begun: float | None = None
        self._columns = 0
        self._anchors: tuple[Anchor, ...] = ()

    def begin(self, anchors: tuple[Anchor, ...]) -> None:
        """The values become these."""
        session = self._context.session
        loaded = session.loaded()
        if loaded is not None and anchors != session.document[Anchors].anchors:
            self._begun, self._columns, self._anchors = time.perf_counter(), _columns(loaded), anchors

    def note(self) -> None:
        """A panel shows another field; once all do it is said, after they have been painted."""
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
        solved = "no solve" if not count else f"{count} {'column' if count == 1 else 'columns'} solved for"
        self._context.tell(f"repainted in {1000 * (time.perf_counter() - begun):.0f} ms, {solved}")


def _columns(loaded: LoadedMesh) -> int:
    """Of distances from anchors, solved for so far."""
    return loaded.memory(InterpolantMemory).columns
