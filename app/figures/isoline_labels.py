"""The values of isolines, standing on them: along the line, in a gap of it, where there is room."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter
from scipy.spatial import cKDTree

from ..drawing.field_actor import CASING
from .description import Figure
from .layout import Layout
from .marks import POINT
from .shots import Contour, Line, Shot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LABEL_SIZE = 0.85
"""Of the letters of colour bars."""

EVERY = 3.0
"""Units along a line from one place that is tried to the next."""

PAD = 3.0
"""Units of the gap to each side of the words."""

STRAIGHT = 0.35
"""Of the letters' size: a line may be off the words' own by so much."""

CLEAR = 0.75
"""Of the letters' size: other lines keep so far from the words' middle line."""

EDGE = 0.8
"""Of the letters' size: the edge of the shape does."""


@dataclass(frozen=True)
class Label:
    """Words about a middle (x, y) on the page, turned by an angle in degrees, against the clock."""

    text: str
    x: float
    y: float
    angle: float
    contour: int


def value_text(value: float) -> str:
    """Three digits, or all before the point."""
    if value and not 1e-4 <= abs(value) < 1e6:
        return f"{value:.3g}".replace("-", "\N{MINUS SIGN}")
    digits = max(0, 2 - int(np.floor(np.log10(abs(value))))) if value else 0
    text = f"{value:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return text.replace("-", "\N{MINUS SIGN}")


def labelled(
    shot: Shot, size: float, width: Callable[[str], float], marks: float, written: Sequence[tuple[float, float]] = ()
) -> tuple[list[Contour], list[Label]]:
    """The shot's isolines with gaps, and what stands in them: one for each value that has room somewhere.

    size: of the letters; width: of a text in them; marks: how far words keep from the middle of a mark;
    written: middles of single signs that stand in the picture.
    """
    dense = [[_along(part, 1.0)[0] for part in line.parts] for line in shot.isolines]
    points = np.concatenate([np.empty((0, 2)), *(p for parts in dense for p in parts)])
    owner = np.concatenate([np.empty(0, int), *(np.full(len(p), k) for k, ps in enumerate(dense) for p in ps)])
    tree, taken = cKDTree(points) if len(points) else None, [(np.array(place), size / 2) for place in written]
    crowded = _crowded(shot, points, owner, CLEAR * size)
    marked = np.array([[x, y] for _, x, y in shot.marks]).reshape(-1, 2)
    lines, labels = list(shot.isolines), []
    done: set[float] = set()
    # Those that stand out come first, then the values from the largest: near the source lines are close.
    order = sorted(range(len(lines)), key=lambda k: (not lines[k].is_through, not lines[k].is_bold, -_length(lines[k])))
    for k in order:
        line = lines[k]
        if line.value in done:
            continue
        text = value_text(line.value)
        wide = width(text) + 2 * PAD
        best = None
        for number, part in enumerate(line.parts):
            best = max(
                [best, *_places(shot, part, number, wide, size, tree, points, owner, k, marked, marks, taken, crowded)],
                key=lambda place: -np.inf if place is None else place[0],
            )
        if best is None:
            continue
        _, number, start, stop, middle, way = best
        angle = float(np.degrees(np.arctan2(-way[1], way[0])))
        angle = angle - 180 if angle > 90 else angle + 180 if angle <= -90 else angle
        labels.append(Label(text, float(middle[0]), float(middle[1]), angle, k))
        taken.append((middle, wide / 2))
        parts = list(line.parts)
        parts[number : number + 1] = _without(parts[number], start, stop)
        lines[k] = replace(line, parts=parts)
        done.add(line.value)
    return lines, labels


def _places(shot, part: Line, number: int, wide, size, tree, points, owner, k, marked, marks, taken, crowded):
    """Places on a part of a line that have room: how good, the part, from where to where, the middle and the way."""
    at, length = _along(part, 1.0)
    starts = np.arange(0.0, length[-1] - wide, EVERY)
    first, last = (np.stack([np.interp(s, length, at[:, i]) for i in (0, 1)], 1) for s in (starts, starts + wide))
    # First what is found out at once for all places.
    chords = np.hypot(*(last - first).T)
    ways = (last - first) / np.maximum(chords, 1e-9)[:, None]
    middles = (first + last) / 2
    is_free = (chords >= 0.96 * wide) & ~crowded(middles)
    for s in (-1, -0.5, 0, 0.5, 1):
        for t in (-1, 1):
            corner = middles + s * wide / 2 * ways + t * EDGE * size * np.stack([-ways[:, 1], ways[:, 0]], 1)
            is_free &= _is_covered(shot, corner)
    for other, half in taken:
        is_free &= np.hypot(*(middles - other).T) >= half + wide / 2 + size
    for mark in marked:
        is_free &= np.hypot(*(middles - mark).T) >= marks + wide / 2
    found = []
    for place in np.flatnonzero(is_free):
        start, stop, a, b, way, middle, chord = (
            each[place] for each in (starts, starts + wide, first, last, ways, middles, chords)
        )
        inner = at[(length > start) & (length < stop)]
        off = np.abs((inner - a) @ [-way[1], way[0]]).max(initial=0.0)
        if off > STRAIGHT * size:
            continue
        near = tree.query_ball_point(middle, wide / 2 + size)
        others = [j for j in near if owner[j] != k or not _is_between(points[j], a, way, chord)]
        room = _least_distance(points[others], a, b)
        if room >= CLEAR * size:
            found.append((min(room, 2 * size) / size - off / size, number, start, stop, middle, way))
    return found


def _crowded(shot: Shot, points: np.ndarray, owner: np.ndarray, clear: float) -> Callable[[np.ndarray], np.ndarray]:
    """Says of places (k, 2) on lines whether another line is nearer than `clear` for sure.

    points: (n, 2) of all lines, owner: (n,) which line each is of.
    """
    reach = int(clear / np.sqrt(2) - 1.5)  # of a square inside the circle, whose units are whole
    if reach < 1 or not len(points):
        return lambda places: np.zeros(len(places), bool)
    corner = np.array([shot.box.x, shot.box.y])
    shape = (int(shot.box.height) + 2, int(shot.box.width) + 2)

    def cells(places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        column, row = np.floor(places - corner).astype(int).T
        return np.clip(row, 0, shape[0] - 1), np.clip(column, 0, shape[1] - 1)

    least, most = np.full(shape, owner.max() + 1), np.full(shape, -1)
    np.minimum.at(least, cells(points), owner)
    np.maximum.at(most, cells(points), owner)
    least, most = minimum_filter(least, 2 * reach + 1), maximum_filter(most, 2 * reach + 1)
    return lambda places: least[cells(places)] < most[cells(places)]


def _is_between(point: np.ndarray, a: np.ndarray, way: np.ndarray, chord: float) -> bool:
    """Whether a point of the line itself is the part under the words, or goes on from it."""
    along, across = (point - a) @ way, abs((point - a) @ [-way[1], way[0]])
    return bool(across < 0.5 * chord and -chord < along < 2 * chord and across < 4.0) or along < 0 or along > chord


def _least_distance(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> float:
    """From points (k, 2) to the segment from a to b."""
    if not len(points):
        return np.inf
    t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return float(np.hypot(*(points - a - t[:, None] * (b - a)).T).min())


def _is_covered(shot: Shot, places: np.ndarray) -> np.ndarray:
    """Which of places (k, 2) are wholly on the shape."""
    height, width = shot.image.shape[:2]
    x = ((places[:, 0] - shot.box.x) / shot.box.width * width).astype(int)
    y = ((places[:, 1] - shot.box.y) / shot.box.height * height).astype(int)
    is_inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    return is_inside & (shot.image[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1), 3] > 250)


def _length(line: Contour) -> float:
    return sum(float(_along(part, np.inf)[1][-1]) for part in line.parts)


def _along(part: Line, step: float) -> tuple[np.ndarray, np.ndarray]:
    """(k, 2) points along a line, no farther apart than `step`, and their lengths (k,) from its start."""
    points, closed = part
    ring = np.concatenate([points, points[:1]]) if closed else points
    length = np.append(0.0, np.cumsum(np.hypot(*np.diff(ring, axis=0).T)))
    if np.isfinite(step):
        more = np.union1d(length, np.arange(0.0, length[-1], step))
        ring = np.stack([np.interp(more, length, ring[:, k]) for k in (0, 1)], 1)
        length = more
    return ring, length


def _without(part: Line, start: float, stop: float) -> list[Line]:
    """What is left of a line without the part from one length to another."""
    ring, length = _along(part, np.inf)

    def cut(a: float, b: float) -> np.ndarray:
        lengths = np.concatenate([[a], length[(length > a) & (length < b)], [b]])
        return np.stack([np.interp(lengths, length, ring[:, k]) for k in (0, 1)], 1)

    before, after = cut(0.0, start), cut(stop, length[-1])
    if part[1]:
        return [(np.concatenate([after, before[1:]]), False)]
    return [(each, False) for each, room in ((before, start), (after, length[-1] - stop)) if room > 0]


def draw_labels(axes: Axes, figure: Figure, layout: Layout, shot: Shot, order: int) -> list[Contour]:
    """Values on a shot's isolines, in the lines' own colours; the isolines with gaps for them."""
    from matplotlib.patheffects import withStroke

    style, panel, top = figure.style, figure.panels[shot.panel], figure.tops()[shot.panel]
    size = LABEL_SIZE * layout.label
    # The number of an inset.
    corner = [(shot.box.x + 0.6 * size, shot.box.y + 0.8 * size)] if shot.source and len(panel.zooms) > 1 else []
    width = partial(layout.lettering.width, size=size)
    contours, labels = labelled(shot, size, width, layout.mark / 2 + 3, corner)
    for label in labels:
        line = contours[label.contour]
        text = axes.text(
            label.x,
            label.y,
            label.text,
            ha="center",
            va="center_baseline",
            rotation=label.angle,
            rotation_mode="anchor",
            size=size * POINT,
            color=style.source if line.is_through else style.line(panel.signed, line.value / top if top > 0 else 0.0),
            weight="bold",
            zorder=order,
            gid="isoline-label",
        )
        if line.is_through:
            rim = 2 * CASING * layout.stroke * POINT
            text.set_path_effects([withStroke(linewidth=rim, foreground=style.mark_edge)])
    return contours
