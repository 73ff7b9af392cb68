"""The camera from which the panels of a surface are seen, and how those of two surfaces move together."""

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore

from bihdist_core.analysis.upright import axis_of
from bihdist_core.arrays import AnyArray, FloatArray

from ...document.camera import Camera, View
from ...scene.camera import camera_seen, follow_camera, outwards_at, show_camera, standard_camera
from ...scene.drawable import rise
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import vertex_at
from ...session.session import Session
from .panel import DistancePanel

if TYPE_CHECKING:
    import pyvista


class CameraController(QtCore.QObject):
    """Moves the camera of one surface, which its panels share.

    Attributes
    ----------
    known
        What the camera saw when it was last told.
    """

    placed = QtCore.Signal()  # it sees something else, but not because the user has moved it

    def __init__(
        self,
        session: Session,
        panels: Callable[[], Sequence[DistancePanel]],
        parent: QtCore.QObject | None = None,
        place: int = 0,
    ) -> None:
        super().__init__(parent)
        self._session, self._panels, self._place = session, panels, place
        self.known: Camera | None = None
        self.is_turntable = False  # whether what is up stays upright while the surface turns
        self._fitted = QtCore.QSize()  # of the views that the camera was placed for

    @cached_property
    def camera(self) -> "pyvista.Camera":
        """The camera that all panels of the surface share."""
        import pyvista  # with the first panel, not with the window

        return pyvista.Camera()

    @property
    def surface(self) -> str:
        """The name of its surface in the document; "" where there is none."""
        meshes = self._session.document.surfaces
        return meshes[self._place].name if self._place < len(meshes) else ""

    @property
    def _loaded(self) -> LoadedMesh | None:
        return self._session.loaded(self.surface)

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
        """The camera as it is now."""
        return camera_seen(self.camera, self.aspect)

    @property
    def upright(self) -> FloatArray | None:
        """The direction (3,) that stays upright; None if the surface turns freely."""
        up = self._session.document.up_of(self.surface)
        return axis_of(up) if self.is_turntable and up != "auto" else None

    @property
    def rise(self) -> float:
        """The height of the panels' height fields; 0 if they are none."""
        loaded, height = self._loaded, self._session.document.warp_factor
        return rise(loaded.prepared.bounds, height) if height and loaded and loaded.prepared.is_flat else 0.0

    def set_view(self, view: View) -> View:
        """See the surface from a standard view, fitted closely, or as a camera saw it; return the view."""
        if self._loaded is None:
            return view
        self._fitted = self._size
        document = self._session.document
        is_parallel = document.parallel_projection
        axis = document.up_of(self.surface)
        view = chosen = self._loaded.view_of(view, axis)
        if not isinstance(view, Camera):
            points, up = self._loaded.prepared.points, self.rise
            if up:
                signed = any(panel.shows.is_difference for panel in document.panels_of(self.surface))
                down = np.array([0, 0, up if signed else 0])
                points = np.concatenate([points - down, points + np.array([0, 0, up])])
            name = "relief" if up and view == "home" else view
            outwards = self._source_seen() if name == "source" else None
            view = standard_camera(points, self.aspect, name, axis, outwards, is_parallel)
        show_camera(self.camera, view, self.aspect, is_parallel)
        self.known = self.seen
        self.placed.emit()
        return chosen

    def refit(self) -> None:
        """Fit the camera to another size of the panels; left to itself, VTK keeps the height and cuts off the sides."""
        if self._loaded is not None and self._panels() and self._size != self._fitted:
            self.set_view(self._session.document.camera_of(self.surface))

    def note(self) -> Camera:
        """Return and remember what the camera sees now, as the user has moved it."""
        self.known = self.seen
        return self.known

    def follow(self, before: Camera, after: Camera) -> Camera | None:
        """Move as another camera has moved; return what this one sees then, None without a surface."""
        if self._loaded is None or self.known is None:
            return None
        is_parallel = self._session.document.parallel_projection
        show_camera(self.camera, follow_camera(self.known, before, after), self.aspect, is_parallel)
        return self.note()

    def _source_seen(self) -> AnyArray | None:
        """Return the normal (3,) that points out of the surface where the first panel's field starts."""
        document, surface = self._session.document, self._session.mesh(self.surface).surface
        names = [name for panel in document.panels_of(self.surface) for name in panel.shows.points]
        return outwards_at(surface, vertex_at(document.point(names[0]).at, surface)) if names else None
