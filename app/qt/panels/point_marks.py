"""The marked points of a view: their visibility, what is under the pointer, and their shapes."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from qtpy import QtCore, QtGui

from ...drawing.painters.qt import box_of, paint
from ...drawing.shapes import Box, Point, Shape
from ...marks.primitives import PointMark
from ...scene.clipping import is_kept
from ...scene.picking import pixel_of
from . import overlay
from .overlay import MarkText, box_of_glyph, covers, mark_shapes, point_of

if TYPE_CHECKING:
    from .view import View

REST_MS = 120
"""After the last move of the camera it is looked anew which of many places are hidden."""

AT_ONCE = 20
"""Most marks whose visibility is found in each picture: for more it is too slow while the surface turns."""


@dataclass(eq=False)
class MarkGroup:
    """Marks (k) of one tool.

    Attributes
    ----------
    positions
        (k, 3) their places.
    highlighted
        Points of the document whose marks stand out.
    is_seen
        (k,) whether the surface does not hide them.
    looked_from
        The camera for which that was found.
    """

    marks: tuple[PointMark, ...] = ()
    positions: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    highlighted: Collection[str] = ()
    is_seen: np.ndarray = field(default_factory=lambda: np.empty(0, bool))
    looked_from: tuple[float, ...] | None = None

    def equals(self, other: "MarkGroup") -> bool:
        """Return whether the same is marked at the same places."""
        return (
            self.marks == other.marks
            and self.highlighted == other.highlighted
            and np.array_equal(self.positions, other.positions)
        )


@dataclass(frozen=True, eq=False)
class PlacedMark:
    """A mark of a tool, whether it is seen, and whether it stands out."""

    key: str
    mark: PointMark
    position: np.ndarray
    is_seen: bool
    is_highlighted: bool

    @property
    def stands(self) -> bool:
        """True for a mark above its place, over all that lie flat."""
        return self.mark.glyph.rise > 0

    @property
    def level(self) -> tuple[int, bool, bool, int]:
        """The order of standing marks: hidden ones lowest, then by number, the first and highlighted on top."""
        return self.mark.glyph.rank, self.is_seen, self.is_highlighted, -(self.mark.number or 0)


class PointMarks(QtCore.QObject):
    """The marked points over a view; with `is_target` a key takes the mark that has a label."""

    def __init__(self, view: "View") -> None:
        super().__init__(view)
        self._view = view
        self._groups: dict[str, MarkGroup] = {}
        self.is_target = False
        self._rest = QtCore.QTimer(self, singleShot=True, interval=REST_MS, timeout=self._refit)

    # ------------------------------------------------------------------ what there is
    def show(
        self, key: str, marks: Sequence[PointMark], positions: np.ndarray, highlighted: Collection[str] = ()
    ) -> None:
        """Put the marks of a tool at positions (k, 3), instead of those that it had."""
        known = self._groups.get(key, MarkGroup())
        group = MarkGroup(tuple(marks), positions, highlighted, np.ones(len(marks), bool))
        if not group.equals(known):
            self._groups[key] = group
            self._view.update()

    def show_as_target(self, is_target: bool) -> None:
        """Show the mark with a label as the one that a key takes, or not."""
        if is_target != self.is_target:
            self.is_target = is_target
            self._view.update()

    def positions(self, key: str) -> np.ndarray:
        """Return the places (k, 3) of a tool's marks."""
        return self._groups.get(key, MarkGroup()).positions

    def placed(self, key: str = "") -> list[PlacedMark]:
        """Return the marks of a tool, or all, without those that are cut away."""
        groups = self._groups if not key else {key: self._groups.get(key, MarkGroup())}
        return [
            PlacedMark(name, mark, position, bool(is_seen), bool(mark.point) and mark.point in group.highlighted)
            for name, group in groups.items()
            for mark, position, is_seen, is_there in zip(
                group.marks, group.positions, self._seen(group), is_kept(self._view.clip, group.positions), strict=True
            )
            if is_there
        ]

    def cut_away(self) -> list[PointMark]:
        """Return the marks that are cut away."""
        return [
            mark
            for group in self._groups.values()
            for mark, is_there in zip(group.marks, is_kept(self._view.clip, group.positions), strict=True)
            if not is_there
        ]

    # ------------------------------------------------------------------ what is hidden
    def _seen(self, group: MarkGroup) -> np.ndarray:
        """Return which marks of a group are seen (k,); of many as it was where the camera rested last."""
        if group.looked_from != self._camera() and len(group.marks):
            if group.looked_from is None or len(group.marks) <= AT_ONCE:
                self._look(group)
            else:
                self._rest.start()
        return group.is_seen

    def _look(self, group: MarkGroup) -> None:
        # Through a surface that is translucent all are.
        is_translucent = self._view.scene.field_actor.opacity < 1
        group.is_seen = np.array([is_translucent or self._view.sees(position) for position in group.positions], bool)
        group.looked_from = self._camera()

    def _refit(self) -> None:
        for group in self._groups.values():
            before = group.is_seen
            if group.looked_from != self._camera():
                self._look(group)
            if not np.array_equal(group.is_seen, before):
                self._view.update()

    def find_hidden(self) -> None:
        """Look again which marks are hidden: another surface may be before them."""
        for group in self._groups.values():
            if len(group.marks) <= AT_ONCE:
                group.looked_from = None

    def _camera(self) -> tuple[float, ...]:
        camera = self._view.camera
        return (*camera.GetPosition(), *camera.GetFocalPoint(), camera.GetParallelProjection())

    # ------------------------------------------------------------------ where they are
    def standing(self, key: str = "") -> list[tuple[PlacedMark, Point]]:
        """Return the marks that stand, with their places, the lowest first; not those that an inset covers."""
        view, found = self._view, []
        for each in self.placed(key):
            if each.stands:
                pixel = pixel_of(view.renderer, each.position)
                if view.scene.insets.renderer_at(*pixel) is view.renderer:
                    found.append((each, point_of(view.place_of(each.position))))
        return sorted(found, key=lambda each: each[0].level)

    def standing_at(self, position: QtCore.QPoint) -> tuple[str, int] | None:
        """Return the tool and the number of the uppermost mark that stands under a point; None if it has no number."""
        view, place = self._view, point_of(QtCore.QPointF(position))
        for each, tip in reversed(self.standing()):
            if covers(each.mark.glyph, tip, place, view.scene.style, view.proportion):
                return (each.key, each.mark.number) if each.mark.number else None
        return None

    def tip_of(self, key: str, number: int) -> QtCore.QPoint:
        """Return the pixel of the place of a mark that stands, by its tool and number."""
        at = next(at for each, at in reversed(self.standing(key)) if each.mark.number == number)
        return QtCore.QPoint(*(int(np.floor(part)) for part in at))

    # ------------------------------------------------------------------ painting
    def paint_flat(self, painter: QtGui.QPainter) -> None:
        """Paint those that do not stand, also in insets; the hidden ones lie lowest."""
        view, flat = self._view, [each for each in self.placed() if not each.stands]
        if not flat:
            return
        flat.sort(key=lambda each: (each.is_seen, each.mark.glyph.rank))
        painter.save()
        for renderer, region, _ in view.parts():
            painter.setClipRegion(region)
            for each in flat:
                at = point_of(view.place_of(each.position, renderer))
                paint(painter, mark_shapes(each.mark, at, view.scene.style, view.proportion, not each.is_seen))
        painter.restore()

    def texts(self) -> list[MarkText]:
        """Return the texts beside marks that are seen; those with words aside have a label of their own."""
        view = self._view
        return [
            (each.mark.text, each.is_highlighted, point_of(view.place_of(each.position)))
            for each in self.placed()
            if each.mark.text and not each.mark.aside and each.is_seen
        ]

    def standing_shapes(self) -> list[Shape]:
        """Return the marks that stand, over all others, and labels of those that have one beside them."""
        view, style = self._view, self._view.scene.style
        standing = self.standing()
        shapes: list[Shape] = []
        for each, at in standing:
            shapes += mark_shapes(each.mark, at, style, view.proportion, not each.is_seen, each.is_highlighted)
        for each, at in standing:
            if each.mark.aside:
                others = [box_of(box_of_glyph(o.mark.glyph, tip, style)) for o, tip in standing if o is not each]
                box = _label_box(each.mark, at, style, box_of(view.rect()), others)
                shapes += overlay.label_shapes(box, each.mark.text, each.mark.aside, self.is_target)
        return shapes


def _label_box(mark: PointMark, tip: Point, style: Any, view: Box, others: Sequence[Box]) -> Box:
    """Return a box beside the head of a mark that stands, in the view, off the others if there is such a place."""
    size = overlay.label_box(tip, mark.text, mark.aside, view)
    outline, gap = box_of(box_of_glyph(mark.glyph, tip, style)), overlay.LABEL_PADDING
    reach = outline.width / 2
    middle = outline.y + reach if outline.y < tip[1] - 1 else outline.bottom - reach
    left, top = tip[0] - size.width / 2, middle - size.height / 2
    right_or_left = (outline.right + gap, top), (outline.x - gap - size.width, top)
    above_or_below = (left, outline.y - gap - size.height), (left, outline.bottom + gap)
    boxes = [Box(*place, size.width, size.height) for place in (*right_or_left, *above_or_below)]
    inside = [box for box in boxes if view.grown(-4).contains(box)]
    free = [box for box in inside if not any(box.meets(other) for other in others)]
    return (free or inside or boxes)[0]
