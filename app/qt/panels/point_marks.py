"""The marked points of a view: which of them the surface hides, what is under the pointer, and how they are painted."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from qtpy import QtCore, QtGui

from ...marks.primitives import PointMark
from ...scene.picking import pixel_of
from . import overlay
from .glyph_painting import covers, outline_at, paint_glyph
from .mark_texts import MarkText

if TYPE_CHECKING:
    from .view import View

REST_MS = 120
"""After the last move of the camera it is looked anew which of many places are hidden."""

AT_ONCE = 20
"""Of so many it is looked in each picture: going through the surface for more is too slow while it turns."""


@dataclass(eq=False)
class Group:
    """Marks (k) of one tool at positions (k, 3), and which of them are seen.

    lit: points of the document whose marks stand out.
    """

    marks: tuple[PointMark, ...] = ()
    positions: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    lit: Collection[str] = ()
    is_seen: np.ndarray = field(default_factory=lambda: np.empty(0, bool))
    looked_from: tuple[float, ...] | None = None

    def is_as(self, other: "Group") -> bool:
        """Whether the same is marked at the same places."""
        return self.marks == other.marks and self.lit == other.lit and np.array_equal(self.positions, other.positions)


@dataclass(frozen=True, eq=False)
class Placed:
    """A mark of a tool, whether it is seen, and whether it stands out."""

    key: str
    mark: PointMark
    position: np.ndarray
    is_seen: bool
    is_lit: bool

    @property
    def stands(self) -> bool:
        """Whether it stands above its place, over all that lie flat."""
        return self.mark.glyph.rise > 0

    @property
    def level(self) -> tuple[int, bool, bool, int]:
        """Of those that stand, what lies lowest first: hidden ones, then by their numbers, the first and lit on top."""
        return self.mark.glyph.rank, self.is_seen, self.is_lit, -(self.mark.number or 0)


class PointMarks(QtCore.QObject):
    """view: that they lie over.  is_meant: the mark with a label is the one that a key takes."""

    def __init__(self, view: "View") -> None:
        super().__init__(view)
        self._view = view
        self._groups: dict[str, Group] = {}
        self.is_meant = False
        self._rest = QtCore.QTimer(self, singleShot=True, interval=REST_MS, timeout=self._look_again)

    # ------------------------------------------------------------------ what there is
    def show(self, key: str, marks: Sequence[PointMark], positions: np.ndarray, lit: Collection[str] = ()) -> None:
        """Put the marks of a tool at positions (k, 3), instead of those that it had."""
        known = self._groups.get(key, Group())
        group = Group(tuple(marks), positions, lit, np.ones(len(marks), bool))
        if not group.is_as(known):
            self._groups[key] = group
            self._view.update()

    def mean(self, is_meant: bool) -> None:
        """Whether the mark with a label is the one that a key takes."""
        if is_meant != self.is_meant:
            self.is_meant = is_meant
            self._view.update()

    def positions(self, key: str) -> np.ndarray:
        """(k, 3) of a tool's marks."""
        return self._groups.get(key, Group()).positions

    def placed(self, key: str = "") -> list[Placed]:
        """The marks of a tool, or all."""
        groups = self._groups if not key else {key: self._groups.get(key, Group())}
        return [
            Placed(name, mark, position, bool(is_seen), bool(mark.point) and mark.point in group.lit)
            for name, group in groups.items()
            for mark, position, is_seen in zip(group.marks, group.positions, self._seen(group), strict=True)
        ]

    # ------------------------------------------------------------------ what is hidden
    def _seen(self, group: Group) -> np.ndarray:
        """(k,) which of them are seen; of many as it was where the camera rested last."""
        if group.looked_from != self._camera() and len(group.marks):
            if group.looked_from is None or len(group.marks) <= AT_ONCE:
                self._look(group)
            else:
                self._rest.start()
        return group.is_seen

    def _look(self, group: Group) -> None:
        group.is_seen = np.array([self._view.sees(position) for position in group.positions], bool)
        group.looked_from = self._camera()

    def _look_again(self) -> None:
        for group in self._groups.values():
            before = group.is_seen
            if group.looked_from != self._camera():
                self._look(group)
            if not np.array_equal(group.is_seen, before):
                self._view.update()

    def see_again(self) -> None:
        """Another surface may be before them."""
        for group in self._groups.values():
            if len(group.marks) <= AT_ONCE:
                group.looked_from = None

    def _camera(self) -> tuple[float, ...]:
        camera = self._view.camera
        return (*camera.GetPosition(), *camera.GetFocalPoint(), camera.GetParallelProjection())

    # ------------------------------------------------------------------ where they are
    def standing(self, key: str = "") -> list[tuple[Placed, QtCore.QPointF]]:
        """Those that stand, with their places, what lies lowest first; not those that an inset covers."""
        view, found = self._view, []
        for each in self.placed(key):
            if each.stands:
                pixel = pixel_of(view.renderer, each.position)
                if view.scene.insets.renderer_at(*pixel) is view.renderer:
                    found.append((each, view.place_of(each.position)))
        return sorted(found, key=lambda each: each[0].level)

    def standing_at(self, position: QtCore.QPoint) -> tuple[str, int] | None:
        """The tool and the number of the uppermost mark that stands under a point; None if it has no number."""
        view, place = self._view, QtCore.QPointF(position)
        for each, tip in reversed(self.standing()):
            if covers(each.mark.glyph, tip, place, view.scene.style, view.proportion):
                return (each.key, each.mark.number) if each.mark.number else None
        return None

    def tip_of(self, key: str, number: int) -> QtCore.QPoint:
        """The pixel of the place of a mark that stands, by its tool and number."""
        at = next(at for each, at in reversed(self.standing(key)) if each.mark.number == number)
        return QtCore.QPoint(int(np.floor(at.x())), int(np.floor(at.y())))

    # ------------------------------------------------------------------ painting
    def paint_flat(self, painter: QtGui.QPainter) -> None:
        """Those that do not stand, also in insets; the hidden ones lie lowest."""
        view, flat = self._view, [each for each in self.placed() if not each.stands]
        if not flat:
            return
        flat.sort(key=lambda each: (each.is_seen, each.mark.glyph.rank))
        painter.save()
        for renderer, region, _ in view.parts():
            painter.setClipRegion(region)
            for each in flat:
                at = view.place_of(each.position, renderer)
                paint_glyph(painter, each.mark, at, view.scene.style, view.proportion, not each.is_seen)
        painter.restore()

    def texts(self) -> list[MarkText]:
        """What stands beside marks that are seen; those with words aside have a label of their own."""
        view = self._view
        return [
            (each.mark.text, each.is_lit, view.place_of(each.position))
            for each in self.placed()
            if each.mark.text and not each.mark.aside and each.is_seen
        ]

    def paint_standing(self, painter: QtGui.QPainter) -> None:
        """Over all others; labels of what has one beside it."""
        view, style = self._view, self._view.scene.style
        standing = self.standing()
        for each, at in standing:
            paint_glyph(painter, each.mark, at, style, view.proportion, not each.is_seen, each.is_lit)
        for each, at in standing:
            if each.mark.aside:
                others = [outline_at(o.mark.glyph, tip, style).boundingRect() for o, tip in standing if o is not each]
                box = _label_box(each.mark, at, style, QtCore.QRectF(view.rect()), others)
                overlay.paint_label(painter, box, each.mark.text, each.mark.aside, self.is_meant)


def _label_box(
    mark: PointMark, tip: QtCore.QPointF, style: Any, view: QtCore.QRectF, others: Sequence[QtCore.QRectF]
) -> QtCore.QRectF:
    """Beside the head of a mark that stands: at the right or the left, in the view, off the others if may be."""
    size = overlay.label_place(tip, mark.text, mark.aside, view).size()
    outline = outline_at(mark.glyph, tip, style).boundingRect()
    gap = overlay.LABEL_PADDING
    reach = outline.width() / 2
    middle = outline.top() + reach if outline.top() < tip.y() - 1 else outline.bottom() - reach
    left, top = tip.x() - size.width() / 2, middle - size.height() / 2
    right_or_left = (outline.right() + gap, top), (outline.left() - gap - size.width(), top)
    above_or_below = (left, outline.top() - gap - size.height()), (left, outline.bottom() + gap)
    boxes = [QtCore.QRectF(QtCore.QPointF(*place), size) for place in (*right_or_left, *above_or_below)]
    inside = [box for box in boxes if view.adjusted(4, 4, -4, -4).contains(box)]
    free = [box for box in inside if not any(box.intersects(other) for other in others)]
    return (free or inside or boxes)[0]
