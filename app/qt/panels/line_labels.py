"""The values of isolines on the panels' pictures: found on a thread once the camera rests, and gone when it moves."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import ceil
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, ByteArray, FloatArray
from bihdist_core.progress import Progress

from ...drawing.painters.qt import paint, text_width
from ...drawing.shapes import Box, Pen, Text
from ...scene.camera import SeenNow
from ...scene.clipping import ClipPlane
from ...scene.drawable import outward_faces
from ...scene.levels import BOLD, Levels
from ...scene.line_clipping import Line, clipped
from ...scene.line_labels import PAD, STRAIGHT, Contour, labelled, value_text
from ...scene.style import CASING, IsolineInk, Style
from ..background import Background
from ..look.look import LOOK
from .motion_state import REST_MS
from .panel import DistancePanel

if TYPE_CHECKING:
    from ...figures.hidden_lines import HiddenLineRemoval

Ink = Callable[[float, bool], IsolineInk]
"""The ink of an isoline of a value, and whether it passes through a point."""

FONT_SIZE = 11.0
"""Logical pixels."""


@dataclass(frozen=True)
class PlacedLabel:
    """A text of this width about a middle (x, y) of the picture, in logical pixels, turned against the clock."""

    text: str
    middle: tuple[float, float]
    angle: float
    width: float
    value: float
    is_bold: bool
    is_through: bool


def painted(picture: AnyArray, written: Sequence[PlacedLabel], style: Style, ink_of: Ink, ratio: float) -> AnyArray:
    """Return a copy of a picture (h, w, 4) with labels; `ratio` is the number of device pixels in a pixel."""
    result = picture.copy()
    for label in written:
        _open(result, label, style, ratio)
    height, width, _ = result.shape
    image = QtGui.QImage(result.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGBX8888)
    painter = QtGui.QPainter(image)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    paint(painter, [_shape(label, ink_of, ratio) for label in written])
    painter.end()
    return _pixels(image)


def _shape(label: PlacedLabel, ink_of: Ink, ratio: float) -> Text:
    """Return a label in device pixels, in the colour of its line."""
    ink = ink_of(label.value, label.is_through)
    halo = ink.rim and Pen(ink.rim, 2 * ink.rim_width * ratio, cap="round", join="round")
    (x, y), size = (ratio * place for place in label.middle), ratio * round(FONT_SIZE * LOOK.scale)
    return Text(label.text, x, y, size, ink.colour, True, "centre", "capitals", label.angle, halo)


def _open(picture: AnyArray, label: PlacedLabel, style: Style, ratio: float) -> None:
    """Clear a gap in a label's line, in place, with the colours of the surface on both sides of it."""
    height, width, _ = picture.shape
    across = style.isoline_width / 2 * (BOLD if label.is_bold or label.is_through else 1.0)
    band = ratio * (across + CASING * label.is_through + STRAIGHT * FONT_SIZE * LOOK.scale + 1.2)
    half = ratio * (label.width / 2 + PAD - 0.5)
    middle = ratio * np.array(label.middle)
    turn = np.radians(label.angle)
    way = np.array([np.cos(turn), -np.sin(turn)])
    normal = np.array([-way[1], way[0]])
    reach = np.abs(half * way) + np.abs(band * normal)
    low = np.maximum(np.floor(middle - reach), 0).astype(int)
    high = np.minimum(np.ceil(middle + reach), (width, height)).astype(int)
    y, x = np.mgrid[low[1] : high[1], low[0] : high[0]]
    off = np.stack([x.ravel(), y.ravel()], 1) + 0.5 - middle
    along, side = off @ way, off @ normal
    inside = (np.abs(along) <= half) & (np.abs(side) <= band)
    along, side, off = along[inside], side[inside], off[inside]

    def beside(which: int) -> FloatArray:
        at = np.floor(middle + along[:, None] * way + which * (band + 1) * normal).astype(int)
        paint: FloatArray = picture[at[:, 1].clip(0, height - 1), at[:, 0].clip(0, width - 1)].astype(float)
        return paint

    share = ((side / (band + 1)) + 1)[:, None] / 2
    column, row = np.floor(middle + off).astype(int).T
    picture[row, column] = np.round((1 - share) * beside(-1) + share * beside(1)).astype(np.uint8)


def _pixels(image: QtGui.QImage) -> ByteArray:
    """Return a copy of an image's pixels (h, w, 4)."""
    memory = image.constBits()
    if hasattr(memory, "setsize"):  # of PyQt
        memory.setsize(image.sizeInBytes())
    return np.array(memory, np.uint8).reshape(image.height(), image.width(), 4)


GRID = 4.0
"""Logical pixels between the places of which it is known whether they are on the shape."""


@dataclass(frozen=True, eq=False)
class PicturePart:
    """A part of a picture with isolines of its own: where it stands, and what of the picture it shows."""

    box: Box
    source: Box
    levels: Levels


@dataclass(frozen=True, eq=False)
class LabelRequest:
    """All that the labels of a panel's picture depend on, in logical pixels.

    Attributes
    ----------
    outward, clip
        (m, 3) faces, and a plane, see `HiddenLineRemoval`.
    field
        (n,) values.
    parts
        The whole picture first, then insets.
    marked, apart
        (k, 3) marked places, and how far labels keep from them.
    size
        Of the letters.
    widths
        Widths of the texts.
    """

    surface: Surface
    outward: AnyArray | None
    clip: ClipPlane | None
    field: FloatArray
    projection: SeenNow
    picture: tuple[float, float]
    parts: tuple[PicturePart, ...]
    marked: FloatArray
    apart: float
    size: float
    widths: dict[str, float]

    @property
    def sight_key(self) -> tuple[object, ...]:
        """A key that is equal for what is seen alike."""
        projection = self.projection
        return id(self.surface), self.clip, self.picture, projection.view.tobytes(), projection.matrix.tobytes()


class LineLabels(QtCore.QObject):
    """Writes the values of isolines on the pictures of the panels that are shown."""

    def __init__(self, panels: Callable[[], Sequence[DistancePanel]], parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._panels = panels
        self._background = Background("labels of isolines", _found, self)
        self._background.answered.connect(lambda _, found: self._write(*found))
        self._timer = QtCore.QTimer(self, singleShot=True, interval=REST_MS)
        self._timer.timeout.connect(lambda: self._background.ask(self._open(self._panels()) or None))
        self._finder = LabelFinder()
        self._done: dict[DistancePanel, int] = {}

    def watch(self, panel: DistancePanel) -> None:
        """Write on this panel's pictures, too."""
        panel.view.drawn.connect(self._timer.start)
        panel.view.shot_wanted.connect(lambda: self.write_now([panel]))

    def close(self) -> None:
        """Stop for good."""
        self._timer.stop()
        self._panels = tuple
        self._background.close(waits=False)

    def write_now(self, panels: Sequence[DistancePanel] | None = None) -> None:
        """Write without waiting, on all panels or on these."""
        for panel, number, request in self._open(self._panels() if panels is None else panels):
            self._write(panel, number, self._finder.find(request))

    def _open(self, panels: Sequence[DistancePanel]) -> list[tuple[DistancePanel, int, LabelRequest]]:
        """Return pictures on which nothing has been written yet."""
        found = []
        for panel in panels:
            number = panel.view.pictures
            if self._done.get(panel) != number and (request := label_request(panel)) is not None:
                found.append((panel, number, request))
        return found

    def _write(self, panel: DistancePanel, number: int, written: Sequence[PlacedLabel]) -> None:
        view = panel.view
        if view.picture is None or view.pictures != number:
            return  # of a picture that is gone
        self._done[panel] = number
        if written and panel.answer is not None:
            ink_of = view.scene.field_actor.isoline_ink
            view.write(painted(view.picture, written, view.scene.style, ink_of, view.devicePixelRatioF()))


def _found(pictures: Sequence[tuple[DistancePanel, int, LabelRequest]], progress: Progress) -> Iterator[object]:
    finder = LabelFinder()
    for panel, number, request in pictures:
        yield panel, number, finder.find(request)


def label_request(panel: DistancePanel) -> LabelRequest | None:
    """Return all that a panel's labels depend on; None where it has no labels, or there is no picture."""
    view, answer = panel.view, panel.answer
    scene = view.scene
    if view.picture is None or scene.field_actor.stand_in.is_shown or not panel.isolines.labels:
        return None
    if answer is None or answer.field is None or panel.shape is None or panel.shape.shape is not panel.shape:
        return None
    width, height = view.width(), view.height()
    whole = Box(0.0, 0.0, float(width), float(height))
    ratio = view.devicePixelRatioF()
    parts = [PicturePart(whole, whole, scene.field_actor.levels)]
    for inset in scene.insets.parts:
        # From device pixels, y up.
        box, source = (
            Box(left / ratio, height - top / ratio, (right - left) / ratio, (top - bottom) / ratio)
            for left, right, bottom, top in (inset.box, inset.source)
        )
        parts.append(PicturePart(box, source, inset.levels))
    texts = {value_text(value) for part in parts for value in part.levels.values}
    return LabelRequest(
        panel.shape,
        outward_faces(scene.field_actor.mesh, view.clip is not None, scene.field_actor.opacity),
        view.clip,
        answer.field,
        SeenNow(view.camera, width / max(height, 1)),
        (width, height),
        tuple(parts),
        panel.marks.places,
        scene.style.marker_size / 2 + 3,
        FONT_SIZE * LOOK.scale,
        {text: text_width(text, FONT_SIZE * LOOK.scale, True) for text in texts},
    )


class LabelFinder:
    """Finds labels; keeps what is hidden from one panel to the next, which sees the same surface alike."""

    def __init__(self) -> None:
        self._key: object = None
        self._sight: HiddenLineRemoval | None = None  # with the surface, whose id stays its own
        self._covers: dict[tuple[Box, ...], AnyArray] = {}

    def find(self, request: LabelRequest) -> list[PlacedLabel]:
        """Return the labels of a picture; this runs on any thread."""
        from ...figures.hidden_lines import HiddenLineRemoval, contours_seen

        sight, covers = self._sight, self._covers
        if sight is None or self._key != request.sight_key:
            sight = HiddenLineRemoval(
                request.surface, request.projection, request.picture, request.outward, request.clip
            )
            covers = {}
            self._key, self._sight, self._covers = request.sight_key, sight, covers
        marked = sight.pixels(request.marked)[:, :2]
        marked = marked[np.isfinite(marked).all(axis=1)]
        found: list[PlacedLabel] = []
        seen: dict[int, list[Contour]] = {}
        for part in request.parts:
            if id(part.levels) not in seen:
                seen[id(part.levels)] = contours_seen(sight, request.field, part.levels)
            contours = [replace(line, parts=_moved(line.parts, part)) for line in seen[id(part.levels)]]
            others = [other.box for other in request.parts[1:]] if part is request.parts[0] else []
            frames = [other.source for other in request.parts[1:]] if others else []
            key = (part.box, part.source, *others, *frames)
            if key not in covers:
                covers[key] = _cover(sight.covers, part, others, frames)
            is_on = partial(_is_on, covers[key], part.box)
            place = part.box.at(part.source.shares(marked))
            width_of = request.widths.__getitem__
            lines, labels = labelled(contours, part.box, request.size, width_of, is_on, place, request.apart)
            for each in labels:
                line, width = lines[each.contour], request.widths[each.text]
                way = (each.x, each.y), each.angle
                found.append(PlacedLabel(each.text, *way, width, line.value, line.is_bold, line.is_through))
        return found


def _cover(
    covers: Callable[[AnyArray], AnyArray], part: PicturePart, others: Sequence[Box], frames: Sequence[Box]
) -> AnyArray:
    """Return whether places all over a part, row by row (k, l), are on the shape and in none of other boxes.

    The sides of the boxes `frames` are kept free, too, but not what is in them.
    """
    across, down = (max(ceil(side / GRID), 1) for side in (part.box.width, part.box.height))
    x, y = ((np.arange(count) + 0.5) / count for count in (across, down))
    shares = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
    is_on, at = covers(part.source.at(shares)), part.box.at(shares)
    for box in others:
        is_on &= ~_within(at, box, GRID)
    for box in frames:
        is_on &= np.logical_or(~_within(at, box, GRID), _within(at, box, -GRID))
    return is_on.reshape(down, across)


def _within(places: FloatArray, box: Box, beyond: float) -> AnyArray:
    """Return which of places (k, 2) are in a box that is larger by so much at each side."""
    half = box.width / 2 + beyond, box.height / 2 + beyond
    return np.asarray((np.abs(places - box.middle) < half).all(axis=1))


def _is_on(cover: AnyArray, box: Box, places: FloatArray) -> AnyArray:
    """Return which of places (k, 2) of the part in a box are on what its cover (l, m) shows."""
    rows, columns = cover.shape
    shares = box.shares(places)
    across, down = ((shares >= 0) & (shares < 1)).T
    column, row = np.floor(np.clip(shares, 0, 1 - 1e-9) * (columns, rows)).astype(int).T
    found: AnyArray = across & down & cover[row, column]
    return found


def _moved(lines: Sequence[Line], part: PicturePart) -> list[Line]:
    """Move lines from the picture into a part of it, as far as that shows them."""
    if part.box == part.source:
        return list(lines)
    inside = [piece for line in lines for piece in clipped(line, part.source)]
    return [(part.box.at(part.source.shares(points)), closed) for points, closed in inside]
