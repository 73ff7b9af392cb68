"""Clicks, drags and keys on sources: points, sets of them, boundary loops, and curves that strokes draw."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.sources.boundary import boundary_loops
from bihdist_core.sources.pieces import pieces_of
from bihdist_core.sources.plane_walk import PlaneWalk
from bihdist_core.sources.source import BoundaryLoop, Curve, Member, Source, SurfacePoint
from bihdist_core.sources.words import short_words_of

from ...document.edits import move_source, source_name
from ...document.source_edits import (
    members_of,
    place_at,
    place_in,
    points_of,
    source_from,
    with_member,
    with_moved,
    without_member,
)
from ...qt.context import Context
from ...qt.dragging import Dragging
from ...qt.files.curve_files import CurveFiles
from ...qt.gesture import LAST, Gesture
from ...qt.panels.events import Click, Stroke, StrokeEnd
from ...qt.snapping import Snapping
from ...scene.picking import Hit

MAX_DETOUR = 3.0
"""A way on the surface between two places drawn one after another is at most so many times as long as the straight
line; otherwise the pointer has come from one part of the surface to another behind it."""
MAX_LEAP, MAX_LEAP_DETOUR = 6.0, 1.2
"""Steps so many times as long as most are cut as well: the surface is seen from the side there, or another part of
it behind."""


def source_from_strokes(strokes: Sequence[Sequence[SurfacePoint]], surface: Surface, is_closed: bool = False) -> Source:
    """Return the source of strokes on a surface: curves, and points for strokes of one place, or on points.

    Places that no path on the surface joins are cut apart. With `is_closed` the only stroke returns to where it
    began.
    """
    if not len(surface.faces):
        places = [place for stroke in strokes for place in stroke]
        return source_from(list(dict.fromkeys(_member([place], surface.shape, False) for place in places)))
    joins = _Joins(strokes, surface)
    runs: list[list[SurfacePoint]] = []
    for stroke in strokes:
        runs.append([stroke[0]])
        for start, stop in pairwise(stroke):
            if joins.has(start, stop):
                runs[-1].append(stop)
            else:
                runs.append([stop])
    is_ring = is_closed and len(runs) == 1 and len(runs[0]) > 2 and joins.has(runs[0][-1], runs[0][0])
    return source_from([_member(run, surface, is_ring) for run in runs])


def _member(run: Sequence[SurfacePoint], surface: Surface, is_ring: bool) -> Member:
    if len(run) == 1:
        return place_at(surface.faces[run[0].face], run[0].face, run[0].weights)
    return Curve(tuple(run), is_ring)


class _Joins:
    """Which places of strokes a way on the surface joins."""

    def __init__(self, strokes: Sequence[Sequence[SurfacePoint]], surface: Surface) -> None:
        self._surface, self._walk = surface, PlaneWalk(surface)
        steps = [self._straight(*pair) for stroke in strokes for pair in pairwise(stroke)]
        self._usual = float(np.median(steps)) if steps else 0.0

    def has(self, start: SurfacePoint, stop: SurfacePoint) -> bool:
        way = self._walk.between(start, stop)
        if way is None:
            return False
        corners = self._surface.vertices[self._surface.faces[[face for face, _, _ in way]]]
        steps = np.einsum("kc,kcx->kx", np.array([there - here for _, here, there in way]), corners)
        straight = self._straight(start, stop)
        most = MAX_LEAP_DETOUR if straight > MAX_LEAP * self._usual else MAX_DETOUR
        return float(np.linalg.norm(steps, axis=1).sum()) <= most * max(straight, 1e-300)

    def _straight(self, start: SurfacePoint, stop: SurfacePoint) -> float:
        p, q = (np.array(x.weights) @ self._surface.vertices[self._surface.faces[x.face]] for x in (start, stop))
        return float(np.linalg.norm(q - p))


POINTER_REACH_PX = 24.0
"""Pixels from the pointer to a member of the source, or to a boundary, that a menu means."""

SETTLE_MS = 200
"""After the last of several steps, until the source has arrived."""

MIN_TOWARDS_COS = 0.3
"""Cosine of the angle between a direction and an edge that still leads there."""

CLOSING_REACH_PX = 14.0
"""Pixels between the ends of what is drawn below which it is closed, if it has been farther away."""


class SourceGestures(Gesture):
    """The gestures where no other tool is on; with `is_drawing` the left button draws."""

    turn = LAST
    follows = True

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._grid, self.at = context.grid, context[Snapping].at
        self.is_drawing = False
        self._moved: tuple[str, Source | None, Member] | None = None  # a point, what it was, and which member moves
        self._strokes: list[list[SurfacePoint]] = []
        self._is_beside = True  # the pointer is not on the surface, or the button was up
        self._stepped_soon = QtCore.QTimer(self, singleShot=True, interval=SETTLE_MS)
        self._stepped_soon.timeout.connect(self._stepped)
        self._grid.events.on(Stroke, lambda panel, stroke: self._draw(panel, stroke.hit))
        self._grid.events.on(StrokeEnd, lambda panel, end: self._stroke_ended(panel, end.has_ctrl))

    def begin(self) -> None:
        self._stepped_soon.stop()
        self.release()
        self._forget_stroke()

    def is_on(self, panel: int) -> bool:
        return True

    def takes(self, panel: int, click: Click) -> bool:
        return True

    def click(self, panel: int, click: Click) -> None:
        if click.has_ctrl:
            self.add_or_remove(panel, click.hit)
        else:
            self._move(panel, self.at(panel, click.hit))

    def follow(self, panel: int, hit: Hit) -> None:
        self._move(panel, self.at(panel, hit), key="live", live=True)

    def cancel(self) -> bool:
        is_drawing = self.is_drawing
        if is_drawing:
            self.context.actions["draw source"].trigger()
        return is_drawing

    def _move(self, panel: int, at: Source, key: str = "", live: bool = False) -> None:
        self.context.session.show(move_source(self.document, panel, at), key, live=live)

    # ------------------------------------------------------------------ points
    def drag(self, panel: int, number: int, hit: Hit) -> None:
        """Move a member of the source of a panel."""
        session = self.context.session
        if self._moved is None:
            document = session.document
            marked = [
                (name, document.point(name).at, member)
                for name in document.panel(panel).shows.points
                for member in points_of(document.point(name).at)
            ]
            if number >= len(marked):
                return
            self._moved = marked[number]
            self.context[Dragging].begin()
        name, whole, member = self._moved
        moved = with_moved(session.document, name, whole, member, self.at(panel, hit))
        session.show(moved, key=f"drag in {panel}", live=True)

    def release(self) -> None:
        self._moved = None
        self.context[Dragging].end()

    def step(self, right: int, up: int) -> None:
        """Move the source along the edge whose direction on the screen is nearest to the key's."""
        session, id = self.context.session, self._grid.active
        if session.loaded() is None or id < 0 or not session.document.panel(id).shows.points:
            return
        surface = session.mesh(id).surface
        panel = self._grid.panel(id)
        vertex = panel.marks.source
        if vertex is None:
            return
        faces = surface.shape.faces[(surface.shape.faces == vertex).any(axis=1)]
        others = np.setdiff1d(faces, [vertex])
        at = panel.view.place_of(panel.positions[vertex])
        places = [panel.view.place_of(panel.positions[other]) for other in others]
        ways = np.array([(place.x() - at.x(), at.y() - place.y()) for place in places])
        towards = ways @ (right, up) / np.maximum(np.linalg.norm(ways, axis=1), 1e-9)
        if towards.max() > MIN_TOWARDS_COS:
            # Held, the key is a drag: stand-ins will do.
            is_held = self._stepped_soon.isActive()
            self._move(id, int(others[towards.argmax()]), key=f"steps in {id}", live=is_held)
            if is_held:
                self.context[Dragging].begin()
            self._stepped_soon.start()

    def _stepped(self) -> None:
        """End a series of steps along edges."""
        self.release()
        self.context.session.show(self.document, key=f"steps in {self._grid.active}")

    # ------------------------------------------------------------------ members
    def add_or_remove(self, panel: int, hit: Hit) -> None:
        """Add a place to the source by Ctrl and a click, or remove a member that is there."""
        member, at = self._member_at(panel, hit), self.at(panel, hit)
        if member is None and at in self._members(panel):
            member = at
        if member is not None:
            self.remove(panel, member)
        else:
            self.add(panel, at)

    def add(self, panel: int, more: Source) -> None:
        """Add something to the source of a panel."""
        session = self.context.session
        session.show(with_member(session.document, panel, more))
        self._say(panel)

    def remove(self, panel: int, member: Member) -> None:
        """Remove a member of the source; the last one stays."""
        session = self.context.session
        if len(self._members(panel)) < 2:
            self.context.tell("This is the only part of the source")
            return
        session.show(without_member(session.document, panel, member))
        self._say(panel)

    def put(self, panel: int, source: Source) -> None:
        """Replace the source."""
        session = self.context.session
        session.show(move_source(session.document, panel, source))
        self._say(panel)

    def _say(self, panel: int) -> None:
        session = self.context.session
        name = source_name(session.document, panel)
        at = session.document.point(name).at if name else None
        if at is not None:

            def holds() -> bool:
                return any(point.name == name and point.at == at for point in session.document.points)

            self.context.tell(f"Source: {short_words_of(at)}", holds)

    def _members(self, panel: int) -> tuple[Member, ...]:
        document = self.document
        name = source_name(document, panel)
        return members_of(document.point(name).at) if name else ()

    def _member_at(self, panel: int, hit: Hit) -> Member | None:
        """Return the member of the source near a place, None if there is none."""
        members = self._members(panel)
        if not members:
            return None
        nearest = [self._nearest_of(panel, member, hit) for member in members]
        best = int(np.argmin([np.linalg.norm(x - hit.position) for x in nearest]))
        return members[best] if self._is_near(panel, nearest[best], hit, POINTER_REACH_PX / 2) else None

    def _nearest_of(self, panel: int, member: Member, hit: Hit) -> AnyArray:
        """Return the point (3,) of a member that is nearest to a place."""
        pieces = pieces_of(member, self.context.session.mesh(panel).surface)
        start, stop = pieces.positions(self._grid.panel(panel).positions)
        way = stop - start
        share = np.einsum("kx,kx->k", hit.position - start, way) / np.maximum(np.einsum("kx,kx->k", way, way), 1e-300)
        points = start + np.clip(share, 0, 1)[:, None] * way
        nearest: AnyArray = points[np.linalg.norm(points - hit.position, axis=1).argmin()]
        return nearest

    def _is_near(self, panel: int, point: FloatArray, hit: Hit, pixels: float) -> bool:
        view = self._grid.panel(panel).view
        away = view.place_of(point) - view.place_of(hit.position)
        return float(np.hypot(away.x(), away.y())) <= pixels

    # ------------------------------------------------------------------ the menu
    def offer(self, menu: QtWidgets.QMenu, panel: int, hit: Hit) -> None:
        """Add what can be done to the source to a menu."""
        menu.addAction("Source here\tClick", lambda: self._click_by_menu(panel, hit))
        member, members = self._member_at(panel, hit), self._members(panel)
        if member is None:
            menu.addAction("Add to the source\tCtrl+click", lambda: self.add(panel, self.at(panel, hit)))
        elif len(members) > 1:
            menu.addAction("Remove from the source\tCtrl+click", lambda: self.remove(panel, member))
        if isinstance(member, Curve):
            menu.addAction("Save this curve…", lambda: self.context[CurveFiles].choose_and_save(member))
        loop = self._loop_near(panel, hit)
        if loop is not None:
            menu.addAction("This boundary as source", lambda: self.put(panel, loop))
            if members and loop not in members:
                menu.addAction("Add this boundary to the source", lambda: self.add(panel, loop))

    def _click_by_menu(self, panel: int, hit: Hit) -> None:
        self.context.picked.emit(panel, hit)
        self.click(panel, Click(hit))

    def _loop_near(self, panel: int, hit: Hit) -> BoundaryLoop | None:
        surface, positions = self.context.session.mesh(panel).surface, self._grid.panel(panel).positions
        edges = surface.boundary_edges
        if not len(edges):
            return None
        middles = positions[edges].mean(axis=1)
        nearest = int(np.linalg.norm(middles - hit.position, axis=1).argmin())
        ends = positions[edges[nearest]]
        if not any(self._is_near(panel, point, hit, POINTER_REACH_PX) for point in (*ends, middles[nearest])):
            return None
        loops = boundary_loops(surface)
        return BoundaryLoop(next(number for number, rows in enumerate(loops) if nearest in rows))

    # ------------------------------------------------------------------ drawing
    def set_drawing(self, is_drawing: bool) -> None:
        """Let the left button draw a source, or no longer."""
        self.is_drawing = is_drawing
        self._forget_stroke()
        self._grid.marks.draw_on(is_drawing)
        self.context.tell("Drag over the surface to draw a source; Ctrl adds the curve, Esc ends" * is_drawing)

    def _draw(self, panel: int, hit: Hit | None) -> None:
        if hit is None:
            self._is_beside = True
            return
        place = place_in(hit.face, hit.weights.tolist())
        if self._is_beside:
            self._strokes.append([])
            self._is_beside = False
        if place not in self._strokes[-1][-1:]:
            self._strokes[-1].append(place)
            self._show_strokes(panel)

    def _stroke_ended(self, panel: int, has_ctrl: bool) -> None:
        strokes, ends = self._strokes, self._on_view(panel)
        self._forget_stroke()
        if not strokes:
            return
        away = np.linalg.norm(ends - ends[0], axis=1)
        is_closed = len(ends) > 3 and away[-1] < CLOSING_REACH_PX and away.max() > 2 * CLOSING_REACH_PX
        drawn = source_from_strokes(strokes, self.context.session.mesh(panel).surface, bool(is_closed))
        (self.add if has_ctrl else self.put)(panel, drawn)

    def _on_view(self, panel: int) -> AnyArray:
        """Return the places (k, 2) in the view of what has been drawn."""
        widget, faces = self._grid.panel(panel), self.context.session.mesh(panel).surface.shape.faces
        places = [place for stroke in self._strokes for place in stroke]
        points = [np.array(place.weights) @ widget.positions[faces[place.face]] for place in places]
        seen = [widget.view.place_of(point) for point in points]
        return np.array([(each.x(), each.y()) for each in seen])

    def _show_strokes(self, panel: int) -> None:
        """Show the strokes on all panels of the surface."""
        surface, name = self.context.session.mesh(panel).surface, self._grid.panel(panel).surface
        strokes = [
            (surface.shape.faces[[place.face for place in stroke]], np.array([place.weights for place in stroke]))
            for stroke in self._strokes
        ]
        for widget in self._grid.panels:
            if widget.surface == name:
                widget.marks.show_strokes(strokes)

    def _forget_stroke(self) -> None:
        self._strokes, self._is_beside = [], True
        for widget in self._grid.panels:
            widget.marks.show_strokes([])
