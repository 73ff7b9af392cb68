"""Places of a surface that are painted over a view, and which of them the surface hides."""

from typing import Any

import numpy as np
from qtpy import QtCore

from bihdist_core.arrays import AnyArray, FloatArray

REST_MS = 120
"""After the last move of the camera it is looked anew which of many places are hidden."""

AT_ONCE = 20
"""Of so many it is looked in each picture: going through the surface for more is too slow while it turns."""


class SeenPlaces(QtCore.QObject):
    """view: the `View` that they lie over.  positions: (k, 3)."""

    def __init__(self, view: Any) -> None:
        super().__init__(view)
        self._view = view
        self.positions = np.empty((0, 3))
        self._is_seen = np.empty(0, bool)
        self._looked_from: tuple[float, ...] | None = None
        self._rest = QtCore.QTimer(self, singleShot=True, interval=REST_MS)
        self._rest.timeout.connect(self._look)

    def place(self, positions: FloatArray) -> None:
        """Be at these positions (k, 3)."""
        if len(positions) or len(self.positions):
            self.positions, self._looked_from = positions, None
            self._is_seen = np.ones(len(positions), bool)
            self._view.update()

    def seen(self) -> AnyArray:
        """(k,) which of them are seen; of many as it was where the camera rested last."""
        if self._looked_from != self._camera():
            if self._looked_from is None or len(self.positions) <= AT_ONCE:
                self._look(then_paint=False)
            else:
                self._rest.start()
        return self._is_seen

    def _look(self, then_paint: bool = True) -> None:
        seen = np.array([self._view.sees(position) for position in self.positions], bool)
        self._looked_from = self._camera()
        changes = not np.array_equal(seen, self._is_seen)
        self._is_seen = seen
        if changes and then_paint:
            self._view.update()

    def _camera(self) -> tuple[float, ...]:
        camera = self._view.camera
        return (*camera.GetPosition(), *camera.GetFocalPoint(), camera.GetParallelProjection())
