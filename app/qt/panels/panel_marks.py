"""What is marked on the surface of a panel: kept as vertices and places, so that it follows the shape that is shown."""

from collections.abc import Collection, Sequence
from typing import Any, TypeVar

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import IntArray
from bihdist_core.sources.pieces import Pieces

from ...marks.field_marks import source_lines
from ...marks.glyphs import RING
from ...marks.line_looks import BOUNDARY, SOURCE
from ...marks.primitives import AreaMark, LegendRow, LineMark, PointMark, SurfaceMark
from ...scene.selected import selected_colours
from ...session.isoline_points import IsolinePoint
from .anchor_labels import AnchorLabel
from .panel_view import PanelView

DISC = PointMark(0)
"""Where a field starts."""

Kind = TypeVar("Kind", PointMark, LineMark, AreaMark, LegendRow)


class PanelMarks:
    """view: that they are seen in.  positions: (n, 3) where the vertices are drawn, in a height field raised."""

    def __init__(self, view: PanelView) -> None:
        self._view = view
        self.positions = np.empty((0, 3))
        self._forget()

    def _forget(self) -> None:
        self.source: int | None = None  # a vertex that stands for it
        self._pieces: tuple[Pieces, ...] = ()
        self._lines: list[LineMark] = []
        self.anchors: Sequence[int] = ()
        self._held: Sequence[AnchorLabel] | None = None
        self._shown: dict[str, tuple[SurfaceMark, ...]] = {}  # by the words of tools
        self._lit: dict[str, Collection[str]] = {}
        self.found: dict[type, Any] = {}  # beside the window's thread, by its type
        self._ends: Sequence[int] = ()
        self.dots = np.empty((0, 3))  # on isolines through points

    def rest(self) -> None:
        """Mark nothing, and keep nothing of it."""
        for tool in self._shown:
            self.show(tool, ())
        self.positions = np.empty((0, 3))
        self._forget()
        self._view.over.show_anchors(())
        self._view.handles, self._view.over.strokes = np.empty((0, 3)), ()
        self._put_source(self.positions)
        self._put_ends()

    def begin(self, surface: Surface) -> None:
        """Lie on a surface; nothing is marked there yet."""
        self.positions = surface.vertices
        self._put_source(np.empty((0, 3)))

    def follow(self, surface: Surface) -> None:
        """Lie on another shape of the surface from now on, but for the source and the anchors: see `mark_source`."""
        self.positions = surface.vertices
        for tool in self._shown:
            self._put_points(tool)
        self._put_labels()
        self._put_rings()
        self._put_lines()
        self._put_ends()

    # ------------------------------------------------------------------ the source and the anchors
    def expect_source(self, vertex: int | None, pieces: Sequence[Pieces] = ()) -> None:
        """Where the field starts, None for one that starts nowhere; marked once that field is there.

        vertex: one that stands for it; pieces: all that it consists of.
        """
        self.source, self._pieces = vertex, tuple(pieces)
        self._lines = [line for each in self._pieces for line in source_lines(each)]

    def mark_source(self) -> None:
        """Put the mark where the field starts."""
        has_shape = len(self.positions) > 0
        points = [each.points.positions(self.positions)[0] for each in self._pieces if has_shape]
        places = np.concatenate(points) if points else np.empty((0, 3))
        lines = [(line.positions(self.positions), line.is_closed) for line in self._lines if has_shape]
        if self._held is None:
            self._view.handles = places
        self._put_source(places)
        self._view.scene.show_lines(SOURCE, lines)
        self._view.redraw()

    def _put_source(self, places: np.ndarray) -> None:
        self._view.over.points.show("field", [DISC] * len(places), places)

    def show_strokes(self, strokes: Sequence[tuple[np.ndarray, np.ndarray]]) -> None:
        """What has been drawn so far: of each stroke the corners (k, 3) of faces, and the weights (k, 3) of these."""
        self._view.over.show_strokes([np.einsum("kc,kcx->kx", w, self.positions[corners]) for corners, w in strokes])

    def expect_anchors(self, vertices: Sequence[int]) -> None:
        """The vertices of the anchors, in their order."""
        self.anchors = vertices

    def hold_anchors(self, names: Sequence[str] | None, texts: Sequence[str] = (), chosen: str = "") -> None:
        """Let the anchors, and not the source, be dragged, with their values beside them.

        names: of their points, in their order, None for no more; texts: what stands there, "" for nothing.
        """
        view = self._view
        if names is None:
            if self._held is not None:
                self._held, view.handles = None, np.empty((0, 3))
                self._put_labels()
            return
        places = self.positions[list(self.anchors)]
        view.handles = places
        self._held = [
            AnchorLabel(at, text, name == chosen) for at, text, name in zip(places, texts, names, strict=True) if text
        ]
        self._put_labels()

    # ------------------------------------------------------------------ what tools mark
    def show(self, tool: str, marks: Sequence[SurfaceMark], lit: Collection[str] = ()) -> bool:
        """The marks of a tool, by its word, instead of those that it had; whether areas of it are others.

        lit: the points of the document whose marks stand out.
        """
        before, now = self._shown.get(tool, ()), tuple(marks)
        if not len(self.positions) or (before, self._lit.get(tool, ())) == (now, lit):
            return False
        self._shown[tool], self._lit[tool] = now, lit
        self._put_points(tool)
        self._put_labels()
        if _rings(before) != _rings(now):
            self._put_rings()
        if _of(LineMark, before) != _of(LineMark, now):
            self._put_lines()
        self._view.over.show_legend([row for each in self._shown.values() for row in _of(LegendRow, each)])
        has_other_areas = _of(AreaMark, before) != _of(AreaMark, now)
        if has_other_areas:
            areas = [area for each in self._shown.values() for area in _of(AreaMark, each)]
            self._view.scene.show_selected(selected_colours(areas, len(self.positions)))
            self._view.redraw()
        return has_other_areas

    def _put_points(self, tool: str) -> None:
        points = [mark for mark in _of(PointMark, self._shown[tool]) if mark.glyph != RING]
        places = np.array([mark.on(self.positions) for mark in points]).reshape(-1, 3)
        self._view.over.points.show(tool, points, places, self._lit[tool])

    def _put_labels(self) -> None:
        """The values of held anchors, and the texts of marks; those that have an aside are labelled by themselves."""
        marks = [mark for each in self._shown.values() for mark in _of(PointMark, each) if mark.text and not mark.aside]
        texts = [AnchorLabel(mark.on(self.positions), mark.text) for mark in marks]
        self._view.over.show_anchors([*(self._held or ()), *texts])

    def _put_rings(self) -> None:
        """Drawn with the surface, which hides them."""
        rings = [ring.on(self.positions) for each in self._shown.values() for ring in _rings(each)]
        self._view.scene.mark_anchors(np.array(rings).reshape(-1, 3))
        self._view.redraw()

    def _put_lines(self) -> None:
        lines = [line for each in self._shown.values() for line in _of(LineMark, each)]
        placed = [(line, line.positions(self.positions)) for line in lines]
        self._view.scene.show_lines(BOUNDARY, [(at, line.is_closed) for line, at in placed if line.look == BOUNDARY])
        over = [
            (line.look, np.concatenate([at, at[:1]]) if line.is_closed else at)
            for line, at in placed
            if line.look != BOUNDARY
        ]
        self._view.over.lines.show(over)
        self._view.redraw()

    def show_dabs(self, vertices: IntArray | None, colour: str = "") -> None:
        """More vertices (k,) that a brush has touched, None for none; see `MarksOver.show_dabs`."""
        self._view.over.show_dabs(None if vertices is None else self.positions[vertices], colour)

    def mark_ends(self, vertices: Sequence[int] = ()) -> None:
        """Rings at vertices that are joined with each other."""
        self._ends = vertices
        self._put_ends()

    def _put_ends(self) -> None:
        known = [vertex for vertex in self._ends if vertex < len(self.positions)]
        self._view.over.show_ends(self.positions[known])

    def mark_passed(self, points: Sequence[IsolinePoint]) -> None:
        """Dots at points that isolines pass through."""
        self.dots = np.array([point.of(self.positions) for point in points]).reshape(-1, 3)
        self._view.scene.mark_passed(self.dots)


def _rings(marks: Sequence[SurfaceMark]) -> list[PointMark]:
    return [mark for mark in _of(PointMark, marks) if mark.glyph == RING]


def _of(kind: type[Kind], marks: Sequence[SurfaceMark]) -> list[Kind]:
    return [mark for mark in marks if isinstance(mark, kind)]
