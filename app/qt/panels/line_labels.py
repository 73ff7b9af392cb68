"""The values of isolines on the panels' pictures: found on a thread once the camera rests, and gone when it moves."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.progress import Progress

from ...scene.camera import SeenNow
from ...scene.corners import Rectangle
from ...scene.drawable import outward_faces
from ...scene.levels import Levels
from ...scene.line_clipping import Line, clipped
from ...scene.line_labels import Contour, labelled, value_text
from ..background import Background
from ..look.look import LOOK
from .label_painting import FONT_SIZE, Written, label_font, painted
from .moving import REST_MS
from .panel import DistancePanel

if TYPE_CHECKING:
    from ...figures.hidden_lines import HiddenLineRemoval

GRID = 4.0
"""Logical pixels between the places of which it is known whether they are on the shape."""


@dataclass(frozen=True, eq=False)
class Part:
    """A part of a picture with isolines of its own: where it stands, what of the picture it shows; y down."""

    box: Rectangle
    source: Rectangle
    levels: Levels


@dataclass(frozen=True, eq=False)
class Asked:
    """All that the labels of a panel's picture depend on, in logical pixels.

    outward: see `HiddenLineRemoval`; field: (n,); parts: the whole picture first, then insets; marked: (k, 3); apart:
    how far words keep from these; size: of the letters; widths: of texts in them.
    """

    surface: Surface
    outward: AnyArray | None
    field: FloatArray
    projection: SeenNow
    picture: tuple[float, float]
    parts: tuple[Part, ...]
    marked: FloatArray
    apart: float
    size: float
    widths: dict[str, float]

    @property
    def sight_key(self) -> tuple[object, ...]:
        """Equal for what is seen alike."""
        projection = self.projection
        return id(self.surface), self.picture, projection.view.tobytes(), projection.matrix.tobytes()


class LineLabels(QtCore.QObject):
    """See the module.  panels: asks for those that are shown."""

    def __init__(self, panels: Callable[[], Sequence[DistancePanel]], parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._panels = panels
        self._background = Background("labels of isolines", _found, self)
        self._background.answered.connect(lambda _, found: self._write(*found))
        self._timer = QtCore.QTimer(self, singleShot=True, interval=REST_MS)
        self._timer.timeout.connect(lambda: self._background.ask(self._open(self._panels()) or None))
        self._finder = Finder()
        self._done: dict[DistancePanel, int] = {}

    def watch(self, panel: DistancePanel) -> None:
        """Write on this panel's pictures, too."""
        panel.view.drawn.connect(self._timer.start)
        panel.view.shot_wanted.connect(lambda: self.write_now([panel]))

    def close(self) -> None:
        """For good."""
        self._timer.stop()
        self._panels = tuple
        self._background.close(waits=False)

    def write_now(self, panels: Sequence[DistancePanel] | None = None) -> None:
        """Without waiting, on all panels or on these."""
        for panel, number, asked in self._open(self._panels() if panels is None else panels):
            self._write(panel, number, self._finder.find(asked))

    def _open(self, panels: Sequence[DistancePanel]) -> list[tuple[DistancePanel, int, Asked]]:
        """Pictures on which nothing has been written yet."""
        found = []
        for panel in panels:
            number = panel.view.pictures
            if self._done.get(panel) != number and (asked := asked_of(panel)) is not None:
                found.append((panel, number, asked))
        return found

    def _write(self, panel: DistancePanel, number: int, written: Sequence[Written]) -> None:
        view = panel.view
        if view.picture is None or view.pictures != number:
            return  # of a picture that is gone
        self._done[panel] = number
        if written and panel.answer is not None:
            scene, signed = view.scene, panel.answer.is_signed
            view.write(painted(view.picture, written, scene.style, signed, scene.maximum, view.devicePixelRatioF()))


def _found(pictures: Sequence[tuple[DistancePanel, int, Asked]], progress: Progress) -> Iterator[object]:
    finder = Finder()
    for panel, number, asked in pictures:
        yield panel, number, finder.find(asked)


def asked_of(panel: DistancePanel) -> Asked | None:
    """What a panel's picture needs; None where it has no labels, or there is no picture."""
    view, answer = panel.view, panel.answer
    scene = view.scene
    if view.picture is None or scene.is_stand_in or not panel.isolines.labels:
        return None
    if answer is None or answer.field is None or panel.shape is None:
        return None
    width, height = view.width(), view.height()
    whole = (0.0, float(width), 0.0, float(height))
    ratio = view.devicePixelRatioF()
    parts = [Part(whole, whole, scene.levels)]
    for inset in scene.insets.parts:
        # From device pixels, y up.
        box, source = (
            (left / ratio, right / ratio, height - top / ratio, height - bottom / ratio)
            for left, right, bottom, top in (inset.box, inset.source)
        )
        parts.append(Part(box, source, inset.levels))
    texts = {value_text(value) for part in parts for value in part.levels.values}
    metrics = QtGui.QFontMetricsF(label_font(1.0))
    return Asked(
        panel.shape,
        outward_faces(scene.mesh),
        answer.field,
        SeenNow(view.camera, width / max(height, 1)),
        (width, height),
        tuple(parts),
        panel.marks.places,
        scene.style.marker_size / 2 + 3,
        FONT_SIZE * LOOK.scale,
        {text: metrics.horizontalAdvance(text) for text in texts},
    )


class Finder:
    """Finds labels; keeps what is hidden from one panel to the next, which sees the same surface alike."""

    def __init__(self) -> None:
        self._key: object = None
        self._sight: HiddenLineRemoval | None = None  # with the surface, whose id stays its own
        self._covers: dict[tuple[Rectangle, ...], AnyArray] = {}

    def find(self, asked: Asked) -> list[Written]:
        """On any thread."""
        from ...figures.hidden_lines import HiddenLineRemoval, contours_seen

        sight, covers = self._sight, self._covers
        if sight is None or self._key != asked.sight_key:
            sight = HiddenLineRemoval(asked.surface, asked.projection, asked.picture, asked.outward)
            covers = {}
            self._key, self._sight, self._covers = asked.sight_key, sight, covers
        marked = sight.pixels(asked.marked)[:, :2]
        marked = marked[np.isfinite(marked).all(axis=1)]
        found: list[Written] = []
        seen: dict[int, list[Contour]] = {}
        for part in asked.parts:
            if id(part.levels) not in seen:
                seen[id(part.levels)] = contours_seen(sight, asked.field, part.levels)
            contours = [replace(line, parts=_moved(line.parts, part)) for line in seen[id(part.levels)]]
            others = [other.box for other in asked.parts[1:]] if part is asked.parts[0] else []
            frames = [other.source for other in asked.parts[1:]] if others else []
            key = (part.box, part.source, *others, *frames)
            if key not in covers:
                covers[key] = _cover(sight.covers, part, others, frames)
            is_on = partial(_is_on, covers[key], part.box)
            place = _shares(marked, part.source) * _size(part.box) + _corner(part.box)
            frame = (*_corner(part.box), *_size(part.box))
            width_of = asked.widths.__getitem__
            lines, labels = labelled(contours, frame, asked.size, width_of, is_on, place, asked.apart)
            for each in labels:
                line, width = lines[each.contour], asked.widths[each.text]
                way = (each.x, each.y), each.angle
                found.append(Written(each.text, *way, width, line.value, line.is_bold, line.is_through))
        return found


def _cover(
    covers: Callable[[AnyArray], AnyArray], part: Part, others: Sequence[Rectangle], frames: Sequence[Rectangle]
) -> AnyArray:
    """(k, l) whether places all over a part, row by row, are on the shape, and in none of other boxes.

    frames: these boxes' sides keep free, too, but not what is in them.
    """
    across, down = np.maximum(np.ceil(_size(part.box) / GRID), 1).astype(int)
    x, y = ((np.arange(count) + 0.5) / count for count in (across, down))
    shares = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
    is_on = covers(shares * _size(part.source) + _corner(part.source))
    at = shares * _size(part.box) + _corner(part.box)
    for box in others:
        is_on &= ~_within(at, box, GRID)
    for box in frames:
        is_on &= ~_within(at, box, GRID) | _within(at, box, -GRID)
    return is_on.reshape(down, across)


def _within(places: FloatArray, box: Rectangle, beyond: float) -> AnyArray:
    """Which of places (k, 2) are in a box that is larger by so much at each side."""
    left, right, top, bottom = box
    x, y = places.T
    found: AnyArray = (x > left - beyond) & (x < right + beyond) & (y > top - beyond) & (y < bottom + beyond)
    return found


def _is_on(cover: AnyArray, box: Rectangle, places: FloatArray) -> AnyArray:
    """Which of places (k, 2) of the part in a box are on what its cover (l, m) shows."""
    rows, columns = cover.shape
    shares = _shares(places, box)
    across, down = ((shares >= 0) & (shares < 1)).T
    column, row = np.floor(np.clip(shares, 0, 1 - 1e-9) * (columns, rows)).astype(int).T
    found: AnyArray = across & down & cover[row, column]
    return found


def _moved(lines: Sequence[Line], part: Part) -> list[Line]:
    """From the picture into a part of it, as far as that shows them."""
    if part.box == part.source:
        return list(lines)
    inside = [piece for line in lines for piece in clipped(line, part.source)]
    return [(_shares(points, part.source) * _size(part.box) + _corner(part.box), closed) for points, closed in inside]


def _shares(points: FloatArray, box: Rectangle) -> AnyArray:
    """Points (…, 2) as shares of a box with y down."""
    return (points - _corner(box)) / _size(box)


def _corner(box: Rectangle) -> AnyArray:
    return np.array([box[0], box[2]])


def _size(box: Rectangle) -> AnyArray:
    return np.array([box[1] - box[0], box[3] - box[2]])
