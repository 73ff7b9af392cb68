"""Meshes of the shading that is wanted: made at once; of a large surface on a thread, with the old one until then."""

from contextlib import suppress
from threading import Thread

from qtpy import QtCore

from bihdist_core.unexpected import note_unexpected

from ...document.looks import Shading
from ...scene.prepared import Drawn, Meshes

LARGE = 100_000
"""Faces from which on it takes a tenth of a second and more."""


class ShadingCache(QtCore.QObject):
    """Keeps the mesh of the shading that was asked for last."""

    made = QtCore.Signal()  # what was asked for last
    _done = QtCore.Signal(object, object, object)  # meshes, shading, drawn: from a thread

    def __init__(self, parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._making: tuple[Meshes, Shading] | None = None
        self._last: tuple[Meshes, Drawn] | None = None
        self._done.connect(self._take)

    def drawn(self, meshes: Meshes, shading: Shading) -> Drawn:
        """Return the mesh for a shading, or for now another one of the same surface."""
        found = meshes.ready(shading)
        if found is None and len(meshes.surface.faces) < LARGE:
            found = meshes.make(shading)
        if found is not None:
            self._making, self._last = None, (meshes, found)
            return found
        if self._making != (meshes, shading):
            self._making = (meshes, shading)
            Thread(target=self._make, args=self._making, name="shading", daemon=True).start()
        if self._last is not None and self._last[0] is meshes:
            return self._last[1]
        return meshes.usual

    def _make(self, meshes: Meshes, shading: Shading) -> None:
        try:
            drawn = meshes.made(shading)
        except Exception as error:
            note_unexpected(error)
            drawn = meshes.usual
        with suppress(RuntimeError):  # the window may have been closed meanwhile
            self._done.emit(meshes, shading, drawn)

    def _take(self, meshes: Meshes, shading: Shading, drawn: Drawn) -> None:
        """Keep a mesh if it is still wanted: one that was overtaken may come later."""
        if self._making == (meshes, shading):
            meshes.keep(drawn)
            self.made.emit()
