"""The dock of the profile: the fields of all panels along a path, live, and where the path leads."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError, ParameterError, Surface
from bihdist_core.analysis.places import Places
from bihdist_core.analysis.surface_paths import SurfacePath

from ...document.document import Document
from ...document.measuring import pinned_at
from ...document.quantities import Difference
from ...session.profiling import PathLane, PathWanted, points_along, wanted_path
from ..look.look import LOOK
from ..look.segments import Segments
from ..look.text_box import TextBox
from ..panels.flat_button import FlatButton
from ..panels.quantity_menu import quantity_name
from .badges import BadgeButton, BadgeRow, badge_of
from .instrument import Instrument
from .profile_chart import Curve
from .profile_charts import ProfileCharts
from .profile_files import ProfileFiles

WAYS = {
    "auto": "shortest geodesic",
    "exact": "shortest geodesic, exact",
    "straightened": "geodesic, straightened",
    "edges": "shortest path along edges",
    "section": "section by a plane",
}
"""In words, by the document's; what has been found says more."""

FINDING = "Finding the path …"

NEAR = 14.0
"""Logical pixels from the path within which the pointer on a surface means it."""

DRAWN = 500
"""Points that the path has on the panels, beside its own."""


class ProfileDock(Instrument):
    word, title, area = "profile", "Profile", "below"

    _posted = QtCore.Signal(object)

    def __init__(self, window) -> None:
        super().__init__(window)
        self.chart = ProfileCharts(self)
        self.path: SurfacePath | None = None
        self.curves: dict[int, Curve] = {}
        self._places: Places | None = None
        self._path_surface: Surface | None = None
        self._wanted: PathWanted | None = None
        self._document: Document | None = None
        self._surface = "A"
        self._echoed: float | None = None  # where the pointer in the chart is, as a length
        self._posted.connect(self._run)
        self._lane = PathLane(self._posted.emit, self._found, self._going)
        self.files = ProfileFiles(self)
        self.ends = (BadgeButton(self, "From"), BadgeButton(self, "To"))
        self._between = BadgeRow(self)
        self._to = QtWidgets.QLabel("to")
        self._to.setProperty("quiet", True)
        for k, button in enumerate(self.ends):
            button.menu().aboutToShow.connect(partial(self._fill_ends, k))
        self.way = FlatButton(self, quiet=True)
        self.way.setAccessibleName("Way of the profile")
        self.way.setMenu(QtWidgets.QMenu(self.way))
        self.way.menu().aboutToShow.connect(self._fill_ways)
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

    @staticmethod
    def _run(function: Callable[[], None]) -> None:
        """What the lane has posted, on the window's thread."""
        function()

    def title_widgets(self) -> list[QtWidgets.QWidget]:
        return [self.ends[0], self._between, self._to, self.ends[1], self.way]

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        return [self.scale, self.save]

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        self._document = document
        self.scale.choose("share" if document.profile.shares else "value")
        through = points_along(document)
        for k, button in enumerate(self.ends):
            button.show_badge(badge_of(document, through[-k]) if len(through) > 1 else None)
        self._between.show_badges(tuple(badge_of(document, name) for name in through[1:-1]))
        try:
            wanted = wanted_path(document, self._surface_of, self._seen())
        except ParameterError as error:
            self._lane.ask(None)
            self._wanted = None
            self._show_none(str(error))
            return
        self._surface = document.point(through[0]).surface
        if not wanted.is_as(self._wanted):
            if self._wanted is None or wanted.surface is not self._wanted.surface:
                self._show_none(FINDING)
            self._wanted = wanted
            self._show_way()
            self._lane.ask(wanted)
        elif self.path is not None:
            self._show_path()  # panels and pins may be others

    def show_answer(self, panel: int) -> None:
        if self._has_path:
            self._read(panel)
            self._show_curves()
            if self._echoed is not None:
                self._echo(self._echoed)

    def show_pointed(self, vertex: int | None) -> None:
        """Near the path on a surface: where that is in the chart."""
        if self._echoed is not None or not self._has_path:
            return
        surface = self.window_.session.surface
        arc = None if vertex is None else self._arc_near(surface.vertices[vertex])
        self.chart.show_at(arc, "" if vertex is None else f"vertex {vertex}")

    def show_closed(self) -> None:
        self._lane.ask(None)
        self._wanted = self.path = None
        self._put_path(None)
        for panel in self.window_.grid.panels:
            panel.head.show_dot("")

    def end(self) -> None:
        self._lane.close()

    # ------------------------------------------------------------------ the path
    @property
    def _has_path(self) -> bool:
        """Whether there is one on the surface that is shown now."""
        opened = self.window_.session.opened(self._surface)
        return self.path is not None and opened is not None and opened.surface is self._path_surface

    @property
    def _panels(self) -> list:
        """Those of the path's surface."""
        panels = self.window_.session.document.panels
        return [self.window_.grid.panel(panel.id) for panel in panels if panel.surface == self._surface]

    def _surface_of(self, name: str) -> Surface:
        return self.window_.session.opened(name).surface

    def _seen(self) -> tuple[float, float, float]:
        """(3,) the direction in which the panels are looked at."""
        seen = self.window_.grid.seen
        way = np.subtract(seen.focal_point, seen.position)
        x, y, z = (way / np.linalg.norm(way)).tolist()
        return x, y, z

    def _found(self, wanted: PathWanted, found: SurfacePath | str) -> None:
        self.said.emit("")
        if isinstance(found, str):
            self._show_none(found)
            return
        self.path, self._path_surface = found, wanted.surface
        self._places = found.places
        self._show_path()

    def _going(self, text: str) -> None:
        self.said.emit(text)

    def _show_none(self, sentence: str) -> None:
        self.path = self._places = None
        self.curves = {}
        self.chart.say(sentence)
        self._show_way()
        self._put_path(None)
        self.files.allow(False)

    def _show_path(self) -> None:
        path, document = self.path, self._document
        self.chart.say("")
        names = points_along(document)
        knots = [(float(path.arcs[at]), badge_of(document, name)) for at, name in zip(path.knots, names, strict=False)]
        self.chart.show_path(path.arcs, "mesh units", knots)
        self._show_way()
        between = np.linspace(0, path.length, DRAWN)
        self._put_path(path.at(np.union1d(path.arcs, between)))
        self._colour()
        self.files.allow(True)

    def _put_path(self, places: Places | None) -> None:
        """Over the panels of its surface."""
        for panel in self.window_.grid.panels:
            panel.show_path(places if panel in self._panels else None)

    def _show_way(self) -> None:
        self.way.setText(self.path.label if self.path is not None else WAYS[self._document.profile.way])
        self.way.setToolTip(f"How the profile goes from point to point: {self.way.text()}")
        self.way.updateGeometry()

    # ------------------------------------------------------------------ the curves
    def _colour(self) -> None:
        """All curves anew: other panels, another path, other colours."""
        self.curves = {}
        if self.path is not None and not self.isHidden():
            colours = LOOK.theme.curves
            for place, panel in enumerate(self._document.panels):
                self._read(panel.id)
                self.window_.grid.panel(panel.id).head.show_dot(colours[place % len(colours)])
            self._show_curves()

    def _read(self, id: int) -> None:
        """The field of a panel along the path."""
        shown, document = self.window_.session.shown.get(id), self._document
        place = next((k for k, panel in enumerate(document.panels) if panel.id == id), None)
        self.curves.pop(id, None)
        if shown is None or place is None or shown.answer.field is None:
            return
        panel, answer = document.panels[place], shown.answer
        if panel.surface != self._surface:
            return
        colours = LOOK.theme.curves
        self.curves[id] = Curve(
            quantity_name(panel.shows),
            colours[place % len(colours)],
            self._places.values(answer.field),
            answer.maximum,
            answer.unit,
            answer.is_signed,
            isinstance(panel.shows, Difference) and not panel.shows.raw,
            place >= len(colours),
        )

    def _show_curves(self) -> None:
        order = [panel.id for panel in self._document.panels if panel.id in self.curves]
        self.chart.show_curves([self.curves[id] for id in order], self._document.profile.shares)

    # ------------------------------------------------------------------ the pointer
    def _point(self, at: tuple[float, float] | None) -> None:
        """In the chart: the place on all panels, and its values on their bars."""
        status = self.window_.status
        if at is None or not self._has_path:
            if self._echoed is not None:
                self._echoed = None
                self._unpoint()
                status.show_place(None, None)
            self.chart.show_at(None)
            return
        arc = float(np.clip(at[0], 0, self.path.length))
        place = self.path.at([arc])
        vertex = int(place.corners[0, int(place.weights[0].argmax())])
        self._echo(arc)
        surface = self._surface_of(self._surface)
        status.show_place(vertex, place.values(surface.vertices)[0])
        self.chart.show_at(arc, f"vertex {vertex}")

    def _echo(self, arc: float) -> None:
        """Rings on the panels, and ticks on their bars, at a length along the path."""
        if self._echoed is None:
            self._unpoint()
        self._echoed = arc
        for panel in self._panels:
            panel.echo(self.path.at([arc]))

    def _unpoint(self) -> None:
        grid = self.window_.grid
        grid.point_at(grid.panels[0].id, None)

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._point(None)

    def _arc_near(self, point: np.ndarray) -> float | None:
        """The length up to the place of the path that is nearest to a point (3,) of the surface, if that is seen near
        it."""
        path = self.path
        arc = nearest_arc(path, point)
        grid = self.window_.grid
        view = grid.panels[0].view
        there = view.place_of(path.at([arc]).values(self._surface_of(self._surface).vertices)[0])
        apart = there - view.place_of(point)
        return arc if np.hypot(apart.x(), apart.y()) <= NEAR else None

    # ------------------------------------------------------------------ what is chosen
    def _show(self, document: Document, **profile: object) -> None:
        self.window_.session.show(replace(document, profile=replace(document.profile, **profile)))

    def _choose_scale(self, word: str) -> None:
        self._show(self._document, shares=word == "share")

    def _choose_way(self, way: str) -> None:
        self._show(self._document, way=way, across=self._seen() if way == "section" else None)

    def _choose_end(self, k: int, name: str, document: Document | None = None) -> None:
        """Let the profile begin (0) or end (1) at a point."""
        document = document or self._document
        through = points_along(document)
        other = (
            through[k - 1]
            if len(through) > 1
            else next((each for each in ("source", *(pin.point for pin in document.pins)) if each != name), "")
        )
        if other == name:  # then it goes the other way
            other = through[-k] if len(through) > 1 else ""
        known = {point.name for point in document.points}
        if other not in known or other == name:
            self.window_.failed("A profile needs two points; choose the other end first.")
            return
        self._show(document, points=(name, other) if k == 0 else (other, name))

    def type_end(self, k: int, text: str) -> None:
        """An end by its vertex id, which is pinned."""
        try:
            surface = self._surface_of(self._surface)
            if not text.strip().isdigit():
                raise ParameterError(f"A vertex id is a whole number, not {text.strip()!r}.")
            document, name = pinned_at(self._document, surface.check_vertex(int(text)), self._surface)
            self._choose_end(k, name, document)
        except BihdistError as error:
            self.window_.failed(str(error))

    def _fill_ends(self, k: int) -> None:
        menu, document = self.ends[k].menu(), self._document
        menu.clear()
        through = points_along(document)
        points = [*(point.name for point in document.points if point.name.startswith("source"))]
        for name in [*points, *(pin.point for pin in document.pins)]:
            badge = badge_of(document, name)
            action = menu.addAction(badge.name[:1].upper() + badge.name[1:], partial(self._choose_end, k, name))
            action.setCheckable(True)
            action.setChecked(len(through) > 1 and through[-k] == name)
        menu.addSeparator()
        box = TextBox()
        box.setPlaceholderText("Vertex id")
        box.setAccessibleName("Vertex id")
        box.returnPressed.connect(partial(self._take_typed, k, box))
        typed = QtWidgets.QWidgetAction(menu)
        typed.setDefaultWidget(_padded(box))
        menu.addAction(typed)

    def _take_typed(self, k: int, box: QtWidgets.QLineEdit) -> None:
        text = box.text()
        self.ends[k].menu().close()
        # The menu with the box is gone by then.
        QtCore.QTimer.singleShot(0, partial(self.type_end, k, text))

    def _fill_ways(self) -> None:
        menu, document = self.way.menu(), self._document
        menu.clear()
        for way, words in WAYS.items():
            words = {
                "auto": "shortest geodesic, as exact as it goes",
                "section": f"{words} through both and the view",
            }.get(way, words)
            action = menu.addAction(words[:1].upper() + words[1:], partial(self._choose_way, way))
            action.setCheckable(True)
            action.setChecked(document.profile.way == way)
        menu.addSeparator()
        along = menu.addAction("Through all pins, in order", partial(self._show, document, points=()))
        along.setCheckable(True)
        along.setChecked(not document.profile.points)
        along.setEnabled(len(document.pins) > 1)
        through = points_along(document)
        turn = menu.addAction("The other way round", partial(self._show, document, points=through[::-1]))
        turn.setEnabled(len(through) > 1)


def nearest_arc(path: SurfacePath, point: np.ndarray) -> float:
    """The length up to the point of a path that is nearest to a point (3,)."""
    a, b = path.points[:-1], path.points[1:]
    side = b - a
    square = np.einsum("ij,ij->i", side, side)
    t = np.clip(np.einsum("ij,ij->i", point - a, side) / np.where(square > 0, square, 1), 0, 1)
    best = int(np.linalg.norm(a + t[:, None] * side - point, axis=1).argmin())
    return float(path.arcs[best] + t[best] * (path.arcs[best + 1] - path.arcs[best]))


def _padded(widget: QtWidgets.QWidget) -> QtWidgets.QWidget:
    around = QtWidgets.QWidget()
    row = QtWidgets.QHBoxLayout(around)
    row.setContentsMargins(12, 4, 12, 4)
    row.addWidget(widget)
    return around
