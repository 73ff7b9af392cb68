"""The dock of the profile: the fields of all panels along a path, live, where the path leads, and files of both."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.places import Places
from bihdist_core.analysis.surface_paths import PROFILE_FORMATS, SurfacePath, write_profile
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer

from ...document.document import Document
from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.docks.instrument import Instrument
from ...qt.files.exports import save_figure
from ...qt.files.saving import save
from ...qt.look.controls import Segments
from ...qt.look.form import in_column
from ...qt.look.look import LOOK
from ...qt.panels.badges import curve_colour
from .badges import badge_of
from .chart import ProfileCharts
from .curves import ProfileCurve, profile_curve
from .part import Profile, points_along
from .path_controls import PathControls
from .paths import PathWanted, PathWorker, wanted_path

if TYPE_CHECKING:
    from ...qt.panels.panel import DistancePanel
    from .figure import ProfileFigure


class ProfileFiles:
    """Saves and copies a profile; `profile()` returns its path and the ids of the panels with a curve."""

    def __init__(self, context: Context, profile: Callable[[], tuple[SurfacePath | None, list[int]]]) -> None:
        self._context, self._profile = context, profile

    def save_numbers(self, path: str = "") -> None:
        """Save the path and the fields along it; ask for a file if none is given."""

        def write(path: str) -> None:
            write_profile(path, self._path(), self._fields())

        save(self._context, "Save the profile's numbers", self._name, tuple(PROFILE_FORMATS), write, path)

    def save_figure(self, path: str = "") -> None:
        """Save the figure in the background; ask for a file if none is given."""
        from .figure import save_profile_figure

        title = "Save the profile as a figure"
        save_figure(self._context, title, self._name, save_profile_figure, self.figure, path)

    def figure(self) -> "ProfileFigure":
        """Return the figure of the chart, in the style of the page and the colours that go with its background."""
        from .figure import profile_figure

        context = self._context
        return profile_figure(context.document, context.page, self._path(), self._answers)

    def copy(self) -> None:
        """Copy a table with tabs, as spreadsheets read it."""
        path = self._path()
        fields = {name: path.along(field) for name, field in self._fields().items()}
        rows = ["\t".join(["arc", *fields])]
        for k, arc in enumerate(path.arcs):
            rows.append("\t".join(repr(float(x)) for x in (arc, *(column[k] for column in fields.values()))))
        self._context.copy("\n".join(rows) + "\n", f"{len(rows) - 1:,} points of the profile are on the clipboard")

    @property
    def _name(self) -> str:
        return file_name([self._context.session.mesh().surface.name], "profile")

    def _path(self) -> SurfacePath:
        path, _ = self._profile()
        if path is None:
            raise ParameterError("There is no path yet; wait until it has been found.")
        return path

    @property
    def _answers(self) -> dict[int, Answer]:
        """The answers of the panels that show a curve."""
        _, panels = self._profile()
        return {id: self._context.session.shown[id].answer for id in panels}

    def _fields(self) -> dict[str, FloatArray]:
        from .figure import profile_fields

        return profile_fields(self._context.document, self._answers)


FINDING = "Finding the path…"

POINTER_REACH_PX = 14.0
"""Logical pixels from the path within which the pointer on a surface means it."""

PATH_POINTS = 500
"""Points that the path has on the panels, beside its own."""


class ProfileDock(Instrument):
    word, area = "profile", "below"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.chart = ProfileCharts(self)
        self.path: SurfacePath | None = None
        self.curves: dict[int, ProfileCurve] = {}
        self._path_surface: Surface | None = None
        self._wanted: PathWanted | None = None
        self.surface = "A"
        self._pointed_arc: float | None = None  # where the pointer in the chart is, as a length
        self._worker = PathWorker(context.post, self._found, self.note_changed.emit)
        self.files = ProfileFiles(context, lambda: (self.path, list(self.curves)))
        self.controls = PathControls(self, context, lambda: self.surface, self.view_direction)
        self.scale = Segments({"Value": "value", "% of max": "share"}, "Profile in")
        self.scale.chosen.connect(lambda word: self.controls.edit(self.document, shares=word == "share"))
        self.beside_title += self.controls.widgets
        self.head.append(self.scale)
        menu = {
            "Save the numbers…": self.files.save_numbers,
            "Save as a figure…": self.files.save_figure,
            "Copy the numbers": self.files.copy,
        }
        self.save = self.add_head_button("save", "Save or copy the profile", menu)
        self.save.setEnabled(False)
        in_column(self.chart, of=self, margins=(0, 4, 0, 0))
        self.setMinimumHeight(124)
        self.chart.pointed.connect(self._point)
        LOOK.follow(self, self._colour)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        self.scale.choose("share" if document[Profile].shares else "value")
        self.controls.show_document(document)
        try:
            wanted = wanted_path(document, self.surface_of, self.view_direction())
        except ParameterError as error:
            self._worker.ask(None)
            self._wanted = None
            self._show_none(str(error))
            return
        self.surface = document.point(points_along(document)[0]).surface
        if wanted != self._wanted:
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
            if self._pointed_arc is not None:
                self._highlight_place(self._path_here, self._pointed_arc)

    @property
    def pointed_surface(self) -> str:
        return self.surface

    def show_pointed(self, vertex: int | None) -> None:
        """Mark the place of the pointer in the chart, if it is near the path on a surface."""
        path = self._path_here
        if self._pointed_arc is not None or path is None:
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
    def _path_here(self) -> SurfacePath | None:
        """The path, if it is on the surface that is shown now."""
        loaded = self.context.session.loaded(self.surface)
        return self.path if loaded is not None and loaded.surface is self._path_surface else None

    @property
    def _panels(self) -> "list[DistancePanel]":
        """The panels of the path's surface."""
        panels = self.document.panels
        return [self.context.grid.panel(panel.id) for panel in panels if panel.surface == self.surface]

    def surface_of(self, name: str) -> Surface:
        """Return the surface of a name in the document."""
        return self.context.session.mesh(name).surface

    def view_direction(self) -> tuple[float, float, float]:
        """Return the direction (3,) in which the panels are looked at."""
        seen = self.context.grid.controller_of(self.surface).seen
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

    def _show_none(self, sentence: str) -> None:
        self.path = None
        self.curves = {}
        self.chart.say(sentence)
        self._show_way()
        self._put_path(None)
        self.save.setEnabled(False)

    def _show_path(self, path: SurfacePath) -> None:
        document = self.document
        self.chart.say("")
        names = points_along(document)
        names = (*names, names[0])  # a whole section may come back to the first
        knots = [(float(path.arcs[at]), badge_of(document, name)) for at, name in zip(path.knots, names, strict=False)]
        self.chart.show_path(path.arcs, "mesh units", knots)
        self._show_way()
        between = np.linspace(0, path.length, PATH_POINTS)
        self._put_path(path.at(np.union1d(path.arcs, between)))
        self._colour()
        self.save.setEnabled(True)

    def _put_path(self, places: Places | None) -> None:
        """Draw the path on the panels of its surface."""
        for panel in self.context.grid.panels:
            self.context.show_found(panel.id, Places, places if panel in self._panels else None)

    def _show_way(self) -> None:
        self.controls.show_way("" if self.path is None else self.path.label)

    # ------------------------------------------------------------------ the curves
    def _colour(self) -> None:
        """Read all curves again, for other panels, another path or other colours."""
        self.curves = {}
        if self.path is not None and not self.isHidden():
            for place, panel in enumerate(self.document.panels):
                self._read(panel.id)
                self.context.grid.panel(panel.id).head.show_dot(curve_colour(place))
            self._show_curves()

    def _read(self, id: int) -> None:
        """Read the field of a panel along the path."""
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
        """Mark the place under the pointer of the chart on all panels, and its values on their colour bars."""
        status, path = self.context.status, self._path_here
        if at is None or path is None:
            if self._pointed_arc is not None:
                self._pointed_arc = None
                self._unpoint()
                status.show_place(None)
            self.chart.show_at(None)
            return
        arc = float(np.clip(at[0], 0, path.length))
        place = path.at([arc])
        vertex = int(place.corners[0, int(place.weights[0].argmax())])
        self._highlight_place(path, arc)
        surface = self.surface_of(self.surface)
        status.show_place(vertex, place.values(surface.vertices)[0], surface)
        self.chart.show_at(arc, f"vertex {vertex}")

    def _highlight_place(self, path: SurfacePath, arc: float) -> None:
        """Put rings on the panels, and ticks on their colour bars, at a length along the path."""
        if self._pointed_arc is None:
            self._unpoint()
        self._pointed_arc = arc
        for panel in self._panels:
            panel.highlight_place(path.at([arc]))

    def _unpoint(self) -> None:
        grid = self.context.grid
        for panel in grid.panels:
            grid.pointing.show(panel.id, None)

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._point(None)

    def _arc_near(self, path: SurfacePath, point: FloatArray) -> float | None:
        """Return the length up to the place of the path nearest to a point (3,), None if the view shows them apart."""
        arc = nearest_arc(path, point)
        if not self._panels:
            return None
        view = self._panels[0].view
        there = view.place_of(path.at([arc]).values(self.surface_of(self.surface).vertices)[0])
        apart = there - view.place_of(point)
        return arc if np.hypot(apart.x(), apart.y()) <= POINTER_REACH_PX else None


def nearest_arc(path: SurfacePath, point: FloatArray) -> float:
    """Return the length up to the point of a path that is nearest to a point (3,)."""
    a, b = path.points[:-1], path.points[1:]
    side = b - a
    square = np.einsum("ij,ij->i", side, side)
    t = np.clip(np.einsum("ij,ij->i", point - a, side) / np.where(square > 0, square, 1), 0, 1)
    best = int(np.linalg.norm(a + t[:, None] * side - point, axis=1).argmin())
    return float(path.arcs[best] + t[best] * (path.arcs[best + 1] - path.arcs[best]))
