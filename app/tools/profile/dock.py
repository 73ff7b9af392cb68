"""The dock of the profile: the fields of all panels along a path, live, and where the path leads."""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.places import Places
from bihdist_core.analysis.surface_paths import SurfacePath
from bihdist_core.arrays import FloatArray

from ...document.document import Document
from ...qt.context import Context
from ...qt.docks.instrument import Instrument
from ...qt.look.look import LOOK
from ...qt.look.segments import Segments
from ...qt.panels.flat_button import FlatButton
from .badges import BadgeButton, BadgeRow, badge_of
from .charts import ProfileCharts
from .choices import WAYS, ProfileChoices
from .curves import ProfileCurve, profile_curve
from .files import ProfileFiles
from .part import Profile, points_along
from .paths import PathWanted, PathWorker, wanted_path

if TYPE_CHECKING:
    from ...qt.panels.panel import DistancePanel

FINDING = "Finding the path…"

NEAR = 14.0
"""Logical pixels from the path within which the pointer on a surface means it."""

DRAWN = 500
"""Points that the path has on the panels, beside its own."""


class ProfileDock(Instrument):
    word, title, area = "profile", "Profile", "below"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.chart = ProfileCharts(self)
        self.path: SurfacePath | None = None
        self.curves: dict[int, ProfileCurve] = {}
        self._path_surface: Surface | None = None
        self._wanted: PathWanted | None = None
        self.surface = "A"
        self._echoed: float | None = None  # where the pointer in the chart is, as a length
        self._worker = PathWorker(context.post, self._found, self._going)
        self.files = ProfileFiles(self)
        self.choices = ProfileChoices(self)
        self.ends = (BadgeButton(self, "From"), BadgeButton(self, "To"))
        self._between = BadgeRow(self)
        self._to = QtWidgets.QLabel("to")
        self._to.setProperty("quiet", True)
        for k, button in enumerate(self.ends):
            button.menu().aboutToShow.connect(partial(self.choices.fill_ends, k))
        self.way = FlatButton(self, quiet=True)
        self.way.setAccessibleName("Way of the profile")
        self.way.setSizePolicy(QtWidgets.QSizePolicy.Policy.Preferred, QtWidgets.QSizePolicy.Policy.Fixed)
        self.way.setMenu(QtWidgets.QMenu(self.way))
        self.way.menu().aboutToShow.connect(self.choices.fill_ways)
        self.scale = Segments({"Value": "value", "% of max": "share"}, "Profile in")
        self.scale.chosen.connect(self._choose_scale)
        self.save = FlatButton(self, "save")
        self.save.setToolTip("Save or copy the profile")
        self.save.setAccessibleName("Save or copy the profile")
        self.save.setMenu(self.files.menu(self.save))
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 4, 0, 0)
        column.addWidget(self.chart)
        self.setMinimumHeight(124)
        self.chart.pointed.connect(self._point)
        LOOK.follow(self, self._colour)

    def title_widgets(self) -> list[QtWidgets.QWidget]:
        return [self.ends[0], self._between, self._to, self.ends[1], self.way]

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        return [self.scale, self.save]

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        self.scale.choose("share" if document[Profile].shares else "value")
        through = points_along(document)
        for k, button in enumerate(self.ends):
            button.show_badge(badge_of(document, through[-k]) if len(through) > 1 else None)
        self._between.show_badges(tuple(badge_of(document, name) for name in through[1:-1]))
        try:
            wanted = wanted_path(document, self.surface_of, self.seen())
        except ParameterError as error:
            self._worker.ask(None)
            self._wanted = None
            self._show_none(str(error))
            return
        self.surface = document.point(through[0]).surface
        if not wanted.is_as(self._wanted):
            if self._wanted is None or wanted.surface is not self._wanted.surface:
                self._show_none(FINDING)
            self._wanted = wanted
            self._show_way()
            self._worker.ask(wanted)
        elif self.path is not None:
            self._show_path(self.path)  # panels and pins may be others

    def show_answer(self, panel: int) -> None:
        if self._path_here is not None:
            self._read(panel)
            self._show_curves()
            if self._echoed is not None:
                self._echo(self._path_here, self._echoed)

    @property
    def pointed_surface(self) -> str:
        return self.surface

    def show_pointed(self, vertex: int | None) -> None:
        """Near the path on a surface: where that is in the chart."""
        path = self._path_here
        if self._echoed is not None or path is None:
            return
        surface = self.surface_of(self.surface)
        arc = None if vertex is None else self._arc_near(path, surface.vertices[vertex])
        self.chart.show_at(arc, "" if vertex is None else f"vertex {vertex}")

    def show_again(self) -> None:
        if self._path_here is not None:
            self._show_path(self._path_here)

    def show_closed(self) -> None:
        self._worker.ask(None)
        self._wanted = self.path = None
        self._put_path(None)
        for panel in self.context.grid.panels:
            panel.head.show_dot("")

    def end(self) -> None:
        self._worker.close()

    # ------------------------------------------------------------------ the path
    @property
    def document(self) -> Document:
        """As it is now: where the camera moves, instruments are told nothing."""
        return self.context.document

    @property
    def _path_here(self) -> SurfacePath | None:
        """The path, if it is on the surface that is shown now."""
        loaded = self.context.session.loaded(self.surface)
        return self.path if loaded is not None and loaded.surface is self._path_surface else None

    @property
    def _panels(self) -> "list[DistancePanel]":
        """Those of the path's surface."""
        panels = self.context.document.panels
        return [self.context.grid.panel(panel.id) for panel in panels if panel.surface == self.surface]

    def surface_of(self, name: str) -> Surface:
        """The surface of a name in the document."""
        return self.context.session.mesh(name).surface

    def seen(self) -> tuple[float, float, float]:
        """(3,) the direction in which the panels are looked at."""
        seen = self.context.grid.eye_of(self.surface).seen
        way = np.subtract(seen.focal_point, seen.position)
        x, y, z = (way / np.linalg.norm(way)).tolist()
        return x, y, z

    def _found(self, wanted: PathWanted, found: SurfacePath | str) -> None:
        self.note_changed.emit("")
        if isinstance(found, str):
            self._show_none(found)
            return
        self.path, self._path_surface = found, wanted.surface
        self._show_path(found)

    def _going(self, text: str) -> None:
        self.note_changed.emit(text)

    def _show_none(self, sentence: str) -> None:
        self.path = None
        self.curves = {}
        self.chart.say(sentence)
        self._show_way()
        self._put_path(None)
        self.files.allow(False)

    def _show_path(self, path: SurfacePath) -> None:
        document = self.document
        self.chart.say("")
        names = points_along(document)
        names = (*names, names[0])  # a whole section may come back to the first
        knots = [(float(path.arcs[at]), badge_of(document, name)) for at, name in zip(path.knots, names, strict=False)]
        self.chart.show_path(path.arcs, "mesh units", knots)
        self._show_way()
        between = np.linspace(0, path.length, DRAWN)
        self._put_path(path.at(np.union1d(path.arcs, between)))
        self._colour()
        self.files.allow(True)

    def _put_path(self, places: Places | None) -> None:
        """Over the panels of its surface."""
        for panel in self.context.grid.panels:
            self.context.show_found(panel.id, Places, places if panel in self._panels else None)

    def _show_way(self) -> None:
        self.way.setText(self.path.label if self.path is not None else WAYS[self.document[Profile].way])
        self.way.setToolTip(f"How the profile goes from point to point: {self.way.text()}")
        self.way.updateGeometry()

    # ------------------------------------------------------------------ the curves
    def _colour(self) -> None:
        """All curves anew: other panels, another path, other colours."""
        self.curves = {}
        if self.path is not None and not self.isHidden():
            colours = LOOK.theme.curves
            for place, panel in enumerate(self.document.panels):
                self._read(panel.id)
                self.context.grid.panel(panel.id).head.show_dot(colours[place % len(colours)])
            self._show_curves()

    def _read(self, id: int) -> None:
        """The field of a panel along the path."""
        shown, document, path = self.context.session.shown.get(id), self.document, self.path
        panel = next((panel for panel in document.panels if panel.id == id), None)
        self.curves.pop(id, None)
        if path is None or shown is None or panel is None or panel.surface != self.surface:
            return
        if shown.answer.field is not None:
            values = path.along(shown.answer.field)
            self.curves[id] = profile_curve(document, id, shown.answer, values, LOOK.theme.curves)

    def _show_curves(self) -> None:
        order = [panel.id for panel in self.document.panels if panel.id in self.curves]
        self.chart.show_curves([self.curves[id] for id in order], self.document[Profile].shares)

    # ------------------------------------------------------------------ the pointer
    def _point(self, at: tuple[float, float] | None) -> None:
        """In the chart: the place on all panels, and its values on their bars."""
        status, path = self.context.status, self._path_here
        if at is None or path is None:
            if self._echoed is not None:
                self._echoed = None
                self._unpoint()
                status.show_place(None, None)
            self.chart.show_at(None)
            return
        arc = float(np.clip(at[0], 0, path.length))
        place = path.at([arc])
        vertex = int(place.corners[0, int(place.weights[0].argmax())])
        self._echo(path, arc)
        surface = self.surface_of(self.surface)
        status.show_place(vertex, place.values(surface.vertices)[0])
        self.chart.show_at(arc, f"vertex {vertex}")

    def _echo(self, path: SurfacePath, arc: float) -> None:
        """Rings on the panels, and ticks on their bars, at a length along the path."""
        if self._echoed is None:
            self._unpoint()
        self._echoed = arc
        for panel in self._panels:
            panel.echo(path.at([arc]))

    def _unpoint(self) -> None:
        grid = self.context.grid
        for panel in grid.panels:
            grid.pointing.show(panel.id, None)

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._point(None)

    def _arc_near(self, path: SurfacePath, point: FloatArray) -> float | None:
        """The length up to the place of the path that is nearest to a point (3,) of the surface, if that is seen near
        it."""
        arc = nearest_arc(path, point)
        if not self._panels:
            return None
        view = self._panels[0].view
        there = view.place_of(path.at([arc]).values(self.surface_of(self.surface).vertices)[0])
        apart = there - view.place_of(point)
        return arc if np.hypot(apart.x(), apart.y()) <= NEAR else None

    def _choose_scale(self, word: str) -> None:
        self.choices.show(self.document, shares=word == "share")


def nearest_arc(path: SurfacePath, point: FloatArray) -> float:
    """The length up to the point of a path that is nearest to a point (3,)."""
    a, b = path.points[:-1], path.points[1:]
    side = b - a
    square = np.einsum("ij,ij->i", side, side)
    t = np.clip(np.einsum("ij,ij->i", point - a, side) / np.where(square > 0, square, 1), 0, 1)
    best = int(np.linalg.norm(a + t[:, None] * side - point, axis=1).argmin())
    return float(path.arcs[best] + t[best] * (path.arcs[best + 1] - path.arcs[best]))
