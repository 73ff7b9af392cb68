"""What is marked on the surface of a panel: kept as vertices and places, so that it follows the shape that is shown."""

from collections.abc import Collection, Sequence

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.places import Places
from bihdist_core.analysis.region_boundaries import Boundary
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.sources.pieces import Pieces

from ...marks.field_marks import source_lines
from ...marks.primitives import LineMark
from ...scene.style import PINS, WAITING
from ...session.isoline_points import IsolinePoint
from ...session.pair_locations import Candidate, LocatedPairPoint
from ...session.pin_locations import LocatedPin
from ..look.numbers import share
from .anchor_labels import AnchorLabel
from .pair_marks import CandidateMark
from .pin_marks import PinMark
from .view import View


class PanelMarks:
    """view: that they are seen in.  positions: (n, 3) where the vertices are drawn, in a height field raised."""

    def __init__(self, view: View) -> None:
        self._view = view
        self.positions = np.empty((0, 3))
        self._forget()

    def _forget(self) -> None:
        self.source: int | None = None  # a vertex that stands for it
        self._pieces: tuple[Pieces, ...] = ()
        self._lines: list[LineMark] = []
        self.anchors: Sequence[int] = ()
        self._held: Sequence[AnchorLabel] | None = None
        self._pins: Sequence[LocatedPin] = ()
        self._lit: Collection[str] = ()
        self._pairs: Sequence[LocatedPairPoint] = ()
        self._candidate: Candidate | None = None
        self._truth: Sequence[int] = ()
        self._off: float | None = None
        self._chosen_pair = ""
        self._path: Places | None = None
        self._regions: Sequence[Boundary] = ()
        self._extrema = np.empty(0, np.int64), np.empty(0, np.int64)
        self._ends: Sequence[int] = ()
        self.dots = np.empty((0, 3))  # on isolines through points

    def rest(self) -> None:
        """Mark nothing, and keep nothing of it."""
        self.positions = np.empty((0, 3))
        self._forget()
        self._view.over.show_pins(())
        self._view.over.pairs.show((), None)
        self._view.over.show_anchors(())
        self._view.handles, self._view.over.strokes = np.empty((0, 3)), ()
        self._view.over.sources.place(self.positions)
        self._put_extrema()
        self._put_ends()
        self._put_path()

    def begin(self, surface: Surface) -> None:
        """Lie on a surface; nothing is marked there yet."""
        self.positions = surface.vertices
        self._view.over.sources.place(np.empty((0, 3)))

    def follow(self, surface: Surface) -> None:
        """Lie on another shape of the surface from now on, but for the source and the anchors: see `mark_source`."""
        self.positions = surface.vertices
        self._put_path()
        self._put_pins()
        self._put_pairs()
        self._put_regions()
        self._put_extrema()
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
        self._view.over.sources.place(places)
        self._view.scene.show_source_lines(lines)
        self._view.redraw()

    def show_strokes(self, strokes: Sequence[tuple[AnyArray, AnyArray]]) -> None:
        """What has been drawn so far: of each stroke the corners (k, 3) of faces, and the weights (k, 3) of these."""
        self._view.over.show_strokes([np.einsum("kc,kcx->kx", w, self.positions[corners]) for corners, w in strokes])

    def mark_anchors(self, vertices: Sequence[int]) -> None:
        """Rings at the vertices of anchors, in their order."""
        self.anchors = vertices
        self._view.scene.mark_anchors(self.positions[list(vertices)])
        self._view.redraw()

    def hold_anchors(self, names: Sequence[str] | None, texts: Sequence[str] = (), chosen: str = "") -> None:
        """Let the anchors, and not the source, be dragged, with their values beside them.

        names: of their points, in their order, None for no more; texts: what stands there, "" for nothing.
        """
        view = self._view
        if names is None:
            if self._held is not None:
                self._held, view.handles = None, np.empty((0, 3))
                view.over.show_anchors(())
            return
        places = self.positions[list(self.anchors)]
        view.handles = places
        self._held = [
            AnchorLabel(at, text, name == chosen) for at, text, name in zip(places, texts, names, strict=True) if text
        ]
        view.over.show_anchors(self._held)

    # ------------------------------------------------------------------ what measures
    def show_pins(self, pins: Sequence[LocatedPin], lit: Collection[str] = ()) -> None:
        """Drops at these places; lit: the names of the points of those that stand out."""
        self._pins, self._lit = pins, lit
        self._put_pins()

    def _put_pins(self) -> None:
        if len(self.positions):
            self._view.over.show_pins(
                tuple(
                    PinMark(each.number, each.position(self.positions), PINS[each.pin.colour], each.point in self._lit)
                    for each in self._pins
                )
            )

    def show_pairs(self, pairs: Sequence[LocatedPairPoint], candidate: Candidate | None, chosen: str = "") -> None:
        """Drops at these vertices, and where the next would be; chosen: a point of the pair that stands out."""
        self._pairs, self._candidate, self._chosen_pair = pairs, candidate, chosen
        self._put_pairs()

    def show_truth(self, vertices: Sequence[int], off: float | None) -> None:
        """Crosses where the partner of the point that waits is; off: how far the candidate is from there, if known."""
        if (tuple(vertices), off) != (tuple(self._truth), self._off):
            self._truth, self._off = vertices, off
            self._put_pairs()

    def _put_pairs(self) -> None:
        if not len(self.positions):
            return
        marks = [
            PinMark(
                each.number,
                self.positions[each.vertex],
                WAITING if each.is_waiting else PINS[each.pair.colour],
                self._chosen_pair in each.pair.points,
            )
            for each in self._pairs
        ]
        candidate = self._candidate
        mark = None
        if candidate is not None:
            position = self.positions[candidate.vertex]
            said = share(candidate.share) if self._off is None else f"{share(self._off)} off"
            mark = CandidateMark(candidate.number, position, str(candidate.vertex), said)
        self._view.over.pairs.show(tuple(marks), mark, tuple(self.positions[vertex] for vertex in self._truth))

    def show_selected(self, colours: FloatArray | None) -> None:
        """Vertices that stand out, see `selected_colours`."""
        if colours is None or len(colours) == len(self.positions):
            self._view.scene.show_selected(colours)
            self._view.redraw()

    def show_dabs(self, vertices: IntArray | None, colour: str = "") -> None:
        """More vertices (k,) that a brush has touched, None for none; see `MarksOver.show_dabs`."""
        self._view.over.show_dabs(None if vertices is None else self.positions[vertices], colour)

    def show_path(self, path: Places | None) -> None:
        """A line through places."""
        self._path = path
        self._put_path()

    def _put_path(self) -> None:
        is_there = self._path is not None and len(self.positions)
        if self._view.over.path.show(self._path.values(self.positions) if is_there else np.empty((0, 3))):
            self._view.redraw()

    def show_regions(self, boundaries: Sequence[Boundary]) -> None:
        """Draw the boundaries of regions, or none."""
        if boundaries is not self._regions:
            self._regions = boundaries
            self._put_regions()
            self._view.redraw()

    def _put_regions(self) -> None:
        has_shape = len(self.positions) > 0
        self._view.scene.show_regions(
            [
                (np.einsum("kc,kcx->kx", each.weights, self.positions[each.corners]), each.closed)
                for each in self._regions
                if has_shape
            ]
        )

    def mark_extrema(self, minima: Sequence[int] = (), maxima: Sequence[int] = ()) -> None:
        """Put triangles at these vertices."""
        self._extrema = np.asarray(minima, np.int64), np.asarray(maxima, np.int64)
        self._put_extrema()

    def _put_extrema(self) -> None:
        minima, maxima = self._extrema
        is_maximum = np.arange(len(minima) + len(maxima)) >= len(minima)
        self._view.over.extrema.show(self.positions[np.concatenate([minima, maxima])], is_maximum)

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
