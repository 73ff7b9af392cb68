"""The marks of a panel: kept as vertices and places, so that they follow the shape that is shown."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import chain, takewhile
from typing import Any, TypeVar

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import FloatArray, IntArray
from bihdist_core.distances.answers import Answer

from ...marks.marked_panel import isoline_points, largest
from ...marks.primitives import AreaMark, LegendRow, LineMark, PointMark, SurfaceMark
from ...scene.selected import selected_colours
from ...session.isoline_points import IsolinePoint
from ...session.questions import Question
from .panel_view import PanelView

FIELD, ISOLINES = "field", "isolines"
"""Keys of the marks that belong to no tool."""

Kind = TypeVar("Kind", PointMark, LineMark, AreaMark, LegendRow)


class PanelMarks:
    """The marks in a view.

    Attributes
    ----------
    positions
        (n, 3) places of the vertices, raised in a height field.
    source
        A vertex where the field starts, None for one that starts nowhere.
    found
        What has been found beside the window's thread, by its type.
    """

    def __init__(self, view: PanelView) -> None:
        self._view = view
        self.positions = np.empty((0, 3))
        self._forget()

    def _forget(self) -> None:
        self.source: int | None = None
        self._starts: dict[Question, Sequence[SurfaceMark]] = {}  # the oldest first
        self._shown: dict[str, tuple[SurfaceMark, ...]] = {}  # by the words of tools
        self._highlighted: dict[str, Collection[str]] = {}
        self.found: dict[type, Any] = {}

    def clear(self) -> None:
        """Mark nothing, and keep nothing of it."""
        for tool in self._shown:
            self.show(tool, ())
        self.positions = np.empty((0, 3))
        self._forget()
        self._view.over.show_strokes(())

    def begin(self, surface: Surface) -> None:
        """Lie on a surface; nothing is marked there yet."""
        self.clear()
        self.positions = surface.vertices

    def follow(self, surface: Surface) -> None:
        """Lie on another shape of the surface from now on."""
        self.positions = surface.vertices
        for tool in self._shown:
            self._put_points(tool)
        self._put_lines()

    @property
    def places(self) -> FloatArray:
        """The places (k, 3) of marked points, and of where the field starts."""
        starts = [] if self.source is None else [self.source]
        shown = [self._view.over.points.positions(tool) for tool in self._shown]
        return np.concatenate([self.positions[starts], *shown])

    # ------------------------------------------------------------------ what belongs to the field
    def expect(self, asked: Question, source: int | None, starts: Sequence[SurfaceMark]) -> None:
        """Take where the field that answers a question starts; it is marked once that field is there."""
        self.source = source
        self._starts.pop(asked, None)
        self._starts[asked] = starts

    def mark_field(self, answer: Answer | None, asked: Question | None) -> None:
        """Mark where the field starts that answers a question, of the last one if none is named or it is not known.

        The place of the largest difference is marked, too: how large it is stands at the bar.
        """
        starts = next(reversed(self._starts.values()), ())
        if asked is not None and asked in self._starts:
            starts = self._starts[asked]
            for older in list(takewhile(lambda question: question != asked, self._starts)):
                del self._starts[older]
        marks = [] if answer is None else largest(answer)
        most = [replace(mark, text="") if isinstance(mark, PointMark) else mark for mark in marks]
        self.show(FIELD, [*starts, *most])

    def mark_passed(self, points: Sequence[IsolinePoint], answer: Answer | None) -> None:
        """Mark points that isolines of an answer pass through by dots."""
        self.show(ISOLINES, [] if answer is None else isoline_points(points, answer))

    # ------------------------------------------------------------------ what tools mark
    def show(self, tool: str, marks: Sequence[SurfaceMark], highlighted: Collection[str] = ()) -> bool:
        """Show the marks of a tool in place of those that it had; return whether its areas have changed.

        The marks of the points `highlighted` stand out.
        """
        before, now = self._shown.get(tool, ()), tuple(marks)
        if not len(self.positions) or (before, self._highlighted.get(tool, ())) == (now, highlighted):
            return False
        self._shown[tool], self._highlighted[tool] = now, highlighted
        self._put_points(tool)
        if _of(LineMark, before) != _of(LineMark, now):
            self._put_lines()
        self._view.over.show_legend(self._all(LegendRow))
        has_other_areas = _of(AreaMark, before) != _of(AreaMark, now)
        if has_other_areas:
            self._view.scene.field_actor.show_selected(selected_colours(self._all(AreaMark), len(self.positions)))
            self._view.redraw()
        return has_other_areas

    def _all(self, kind: type[Kind]) -> list[Kind]:
        return [mark for marks in self._shown.values() for mark in _of(kind, marks)]

    def _put_points(self, tool: str) -> None:
        points, over = _of(PointMark, self._shown[tool]), self._view.over.points
        over.show(tool, points, self._places(points), self._highlighted[tool])
        # What a tool lets be dragged comes before where the field starts.
        handles = {
            tool: [mark for mark in _of(PointMark, marks) if mark.is_handle] for tool, marks in self._shown.items()
        }
        starts = handles.pop(FIELD, [])
        self._view.handles = self._places([*chain(*handles.values())] or starts)

    def _places(self, marks: Sequence[PointMark]) -> FloatArray:
        return np.array([mark.on(self.positions) for mark in marks]).reshape(-1, 3)

    def _put_lines(self) -> None:
        placed = [(line, line.positions(self.positions)) for line in self._all(LineMark)]
        self._view.over.lines.show(
            [(line.name, line.look, np.concatenate([at, at[:1]]) if line.is_closed else at) for line, at in placed]
        )
        self._view.redraw()

    # ------------------------------------------------------------------ what is being done
    def show_strokes(self, strokes: Sequence[tuple[np.ndarray, np.ndarray]]) -> None:
        """Show the lines drawn so far, each by corners (k, 3) of faces and the weights (k, 3) of these."""
        self._view.over.show_strokes([np.einsum("kc,kcx->kx", w, self.positions[corners]) for corners, w in strokes])

    def show_dabs(self, vertices: IntArray | None, colour: str = "") -> None:
        """Show more vertices (k,) that a brush has touched, None for none; see `MarksOver.show_dabs`."""
        self._view.over.show_dabs(None if vertices is None else self.positions[vertices], colour)


def _of(kind: type[Kind], marks: Sequence[SurfaceMark]) -> list[Kind]:
    return [mark for mark in marks if isinstance(mark, kind)]
