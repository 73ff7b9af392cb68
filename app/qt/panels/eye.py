"""The camera from which all panels are seen."""

from collections.abc import Callable, Sequence

import numpy as np
from qtpy import QtCore
from vtkmodules.vtkRenderingCore import vtkCamera

from bihdist_core.analysis.upright import axis_of

from ...document.camera import Camera, View
from ...document.quantities import Difference
from ...drawing.camera import camera_seen, outwards_at, show_camera, standard_camera
from ...drawing.relief import rise
from ...session.questions import vertex_at
from ...session.session import Session
from .panel import DistancePanel


class Eye(QtCore.QObject):
    """panels: asks for those that are shown, which are equal in size."""

    placed = QtCore.Signal()  # it sees something else, but not because the user has moved it

    def __init__(
        self, session: Session, panels: Callable[[], Sequence[DistancePanel]], parent: QtCore.QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._panels = session, panels
        self.camera = vtkCamera()
        self.is_turntable = False  # whether what is up stays upright while the surface turns
        self._fitted = QtCore.QSize()  # of the views that the camera was placed for

    @property
    def _size(self) -> QtCore.QSize:
        panels = self._panels()
        return panels[0].view.size() if panels else QtCore.QSize()

    @property
    def aspect(self) -> float:
        """Width / height of a view."""
        size = self._size
        return size.width() / max(size.height(), 1) if size.isValid() else 1.0

    @property
    def seen(self) -> Camera:
        """What the camera sees now."""
        return camera_seen(self.camera, self.aspect)

    @property
    def upright(self) -> np.ndarray | None:
        """(3,) what stays upright; None if the surface turns freely."""
        up = self._session.document.up
        return axis_of(up) if self.is_turntable and up != "auto" else None

    @property
    def rise(self) -> float:
        """How far up the panels' reliefs go; 0 if they are none."""
        opened, height = self._session.opened(), self._session.document.height
        return rise(opened.prepared.bounds, height) if height and opened and opened.prepared.is_flat else 0.0

    def look(self, view: View) -> None:
        """See the surface from a standard view, fitted closely, or as a camera saw it."""
        self._fitted = self._size
        document = self._session.document
        is_parallel = document.projection == "orthographic"
        if not isinstance(view, Camera):
            points, up = self._session.opened().prepared.points, self.rise
            if up:
                signed = any(isinstance(panel.shows, Difference) for panel in document.panels)
                down = np.array([0, 0, up if signed else 0])
                points = np.concatenate([points - down, points + np.array([0, 0, up])])
            name = "relief" if up and view == "home" else view
            outwards = self._source_seen() if name == "source" else None
            view = standard_camera(points, self.aspect, name, None, document.up, outwards, is_parallel)
        show_camera(self.camera, view, self.aspect, None, is_parallel)
        self.placed.emit()

    def look_again(self) -> None:
        """After a change of the panels' size.  Left to itself VTK keeps the height and cuts off the sides."""
        if self._session.surface is not None and self._panels() and self._size != self._fitted:
            self.look(self._session.document.camera)

    def _source_seen(self) -> np.ndarray | None:
        """(3,) the way out of the surface where the first panel's field starts."""
        document, surface = self._session.document, self._session.opened().surface
        sources = document.sources
        return outwards_at(surface, vertex_at(sources[0], surface)) if sources else None
