"""The panels of the window, equal in size and seen from one camera.  Shows what a session knows; decides nothing."""

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkRenderingCore import vtkCamera

from ..document.camera import Camera, View
from ..document.document import Document
from ..document.edits import possible_edits
from ..document.quantities import Difference
from ..drawing.camera import camera_seen, place_camera, show_camera
from ..drawing.relief import rise
from ..drawing.style import PAPER, Style
from ..session.anchors import anchors_on
from ..session.opened import Opened
from ..session.questions import vertex_at
from ..session.session import Session
from .controls import MOST_PANELS
from .panel import DistancePanel

HOVER_DELAY_MS = 25
SIDE_BY_SIDE = 3
"""Panels in a row at most; more stand in rows as even as can be."""


class PanelGrid(QtWidgets.QWidget):
    """A panel for each of the document's, by its id; gestures come out as signals that name the panel."""

    clicked = QtCore.Signal(int, object)  # panel, where the surface is met
    dragged = QtCore.Signal(int, int)  # the source's mark, over a vertex
    released = QtCore.Signal()
    chosen = QtCore.Signal(int, object)  # panel, quantity
    asked = QtCore.Signal(int, str)  # panel, a word of PANEL_EDITS
    hovered = QtCore.Signal(object)  # a vertex, or None beside the surface
    looked = QtCore.Signal(Camera)  # where the user has turned or moved the camera to

    def __init__(self, session: Session, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.camera = vtkCamera()
        self._panels: dict[int, DistancePanel] = {}
        self._spare: list[DistancePanel] = []
        self._style = PAPER
        self._layout = QtWidgets.QGridLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(1)
        self._repaint_soon = QtCore.QTimer(self, singleShot=True, interval=HOVER_DELAY_MS)
        self._repaint_soon.timeout.connect(self.repaint_views)
        self.show_panels(session.document)

    @property
    def panels(self) -> list[DistancePanel]:
        """In the order of the document."""
        return list(self._panels.values())

    def panel(self, id: int) -> DistancePanel:
        return self._panels[id]

    @property
    def aspect(self) -> float:
        """Width / height of a panel."""
        if not self._panels:
            return 1.0
        size = self.panels[0].interactor.size()
        return size.width() / max(size.height(), 1)

    # ------------------------------------------------------------------ the document
    def show_panels(self, document: Document) -> None:
        """Make, leave out and put in order the panels, and let their controls say what they show."""
        wanted = {panel.id: panel for panel in document.panels}
        for id in self._panels.keys() - wanted.keys():
            gone = self._panels.pop(id)
            self._layout.removeWidget(gone)
            gone.hide()
            gone.rest()
            # Kept for the next: VTK does not give back all the memory of a view that is closed.
            self._spare.append(gone)
        for id, panel in wanted.items():
            if id not in self._panels:
                self._panels[id] = self._spare.pop() if self._spare else self._new_panel()
                self._begin(self._panels[id], id)
            fields = [field.name for field in document.fields if field.surface == panel.surface]
            self._panels[id].controls.show_quantity(panel.shows, fields)
        self._panels = {id: self._panels[id] for id in wanted}
        self._arrange()
        for id, panel in self._panels.items():
            panel.controls.allow(possible_edits(document, id, MOST_PANELS))

    def _arrange(self) -> None:
        count = len(self._panels)
        rows = -(-count // SIDE_BY_SIDE)
        columns = -(-count // rows) if rows else 0
        for number, panel in enumerate(self._panels.values()):
            place = divmod(number, columns)
            index = self._layout.indexOf(panel)
            if index < 0 or self._layout.getItemPosition(index)[:2] != place:
                self._layout.addWidget(panel, *place)
        for row in range(self._layout.rowCount()):
            self._layout.setRowStretch(row, int(row < rows))
        for column in range(self._layout.columnCount()):
            self._layout.setColumnStretch(column, int(column < columns))

    def _new_panel(self) -> DistancePanel:
        panel = DistancePanel(self)
        panel.clicked.connect(lambda met: self.clicked.emit(panel.id, met))
        panel.dragged.connect(lambda vertex: self.dragged.emit(panel.id, vertex))
        panel.released.connect(self.released)
        panel.hovered.connect(self.hovered)
        panel.moved.connect(self._looked)
        panel.resized.connect(self._keep_in_view)
        panel.changed.connect(lambda chosen: self.chosen.emit(panel.id, chosen))
        panel.controls.asked.connect(lambda word: self.asked.emit(panel.id, word))
        panel.renderer.SetActiveCamera(self.camera)
        panel.show_style(self._style)
        return panel

    def _begin(self, panel: DistancePanel, id: int) -> None:
        """Let a panel be that of an id, without a field yet."""
        panel.id = id
        opened = self._session.opened()
        if opened is not None:
            self._show_surface(panel, opened)
        panel.scene.show_isolines(self._session.document.isolines)
        panel.show()

    def show_style(self, style: Style) -> None:
        """Let all panels look like this; what they show has to be shown again."""
        self._style = style
        for panel in (*self.panels, *self._spare):
            panel.show_style(style)

    def show_surface(self) -> None:
        """Another surface is there."""
        for panel in self.panels:
            self._show_surface(panel, self._session.opened())

    def _show_surface(self, panel: DistancePanel, opened: Opened) -> None:
        panel.show_surface(opened, self.camera)

    def mark_points(self, document: Document) -> None:
        """Put the mark of each panel where its field starts."""
        for panel in document.panels:
            opened = self._session.opened(panel.surface)
            starts = [vertex_at(document.point(name).at, opened.surface) for name in panel.shows.points]
            self._panels[panel.id].mark_source(starts[0] if starts else None)

    def mark_anchors(self, document: Document) -> None:
        """Put the anchors of each panel's surface where they are."""
        for panel in document.panels:
            opened = self._session.opened(panel.surface)
            self._panels[panel.id].mark_anchors(anchors_on(document, panel.surface, opened))

    def show_insets(self, document: Document) -> None:
        """Enlarge the document's places in each panel."""
        for panel in self.panels:
            panel.show_insets(document.zooms)
        self._settle_insets()

    def _settle_insets(self) -> None:
        for panel in self.panels if self._session.surface is not None else ():
            panel.settle_insets()

    @property
    def _rise(self) -> float:
        """How far up the panels' reliefs go; 0 if they are none."""
        opened, height = self._session.opened(), self._session.document.height
        return rise(opened.prepared.bounds, height) if height and opened and opened.prepared.is_flat else 0.0

    def show_isolines(self, count: int) -> None:
        for panel in self.panels:
            panel.scene.show_isolines(count)

    # ------------------------------------------------------------------ answers
    def show_answer(self, id: int) -> None:
        """The answer that the session has now for a panel."""
        for other in self._session.shown if self._session.document.shared_range else (id,):
            if other in self._panels:
                shown = self._session.shown[other]
                self._panels[other].show_answer(shown, self._maximum(other), self._session.document.height)

    def show_certificate(self, id: int) -> None:
        self._panels[id].show_certificate(self._session.shown[id])

    def _maximum(self, id: int) -> float | None:
        """The end of a panel's colour bar; None for the field's own maximum."""
        document, shown = self._session.document, self._session.shown
        if not document.shared_range:
            return document.panel(id).maximum
        unit = shown[id].answer.unit
        ends = [
            document.panel(other).maximum or shown[other].answer.maximum
            for other in shown
            if shown[other].answer.unit == unit
        ]
        return max(ends)

    # ------------------------------------------------------------------ the camera
    def look(self, view: View) -> None:
        """See the surface from a standard view, fitted closely, or as a camera saw it."""
        if isinstance(view, Camera):
            show_camera(self.camera, view, self.aspect)
        else:
            points, up = self._session.opened().prepared.points, self._rise
            if up:
                signed = any(isinstance(panel.shows, Difference) for panel in self._session.document.panels)
                down = np.array([0, 0, up if signed else 0])
                points = np.concatenate([points - down, points + np.array([0, 0, up])])
            place_camera(self.camera, points, self.aspect, "relief" if up and view == "home" else view)
        self._settle_insets()
        self.repaint_views()

    def _looked(self) -> None:
        """The user has moved the camera."""
        if self._session.surface is not None:
            self.looked.emit(camera_seen(self.camera, self.aspect))
        self.repaint_views()

    def _keep_in_view(self) -> None:
        """After a change of the panels' size.  Left to itself VTK keeps the height and cuts off the sides."""
        if self._session.surface is not None:
            self.look(self._session.document.camera)

    # ------------------------------------------------------------------ pictures
    def point_at(self, vertex: int | None) -> None:
        """Mark the vertex under the pointer in every panel, and show its values."""
        for panel in self.panels:
            panel.point_at(vertex)
        self._repaint_soon.start()

    def repaint_views(self) -> None:
        opened = self._session.opened()
        if opened is not None and self._panels:
            # The panels have one camera.  Left to itself VTK would go over all vertices to find the bounds.
            *others, low, high = opened.prepared.bounds
            self.panels[0].renderer.ResetCameraClippingRange(*others, low - self._rise, high + self._rise)
        for panel in self.panels:
            panel.repaint_view()

    def paint_into(self, painter: QtGui.QPainter, window: QtWidgets.QWidget) -> None:
        """The views, which are no part of a picture that Qt takes of the window."""
        for panel in self.panels:
            corner = panel.interactor.mapTo(window, QtCore.QPoint(0, 0))
            painter.drawImage(QtCore.QRect(corner, panel.interactor.size()), panel.picture())

    def close_views(self) -> None:
        for panel in (*self.panels, *self._spare):
            panel.interactor.close()
