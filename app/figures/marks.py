"""Marks of a figure, with what is written at them, and the frames of its insets."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from bihdist_core.arrays import BoolArray, FloatArray

from ..marks.glyphs import TRIANGLE_DOWN, TRIANGLE_UP
from ..marks.primitives import PointMark
from ..scene.corners import Rectangle, inside, joins
from .boxes import Box, Words
from .glyphs import POINT, draw_glyph
from .shots import Shot

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

    from .canvas import Composition

MOST_NAMED = 3
"""So many hidden marks have a sentence each."""

GROUND = 0.8
"""How much of what is under words their ground covers."""


def draw_marks(
    axes: Axes, page: Composition, shot: Shot, order: int, frame: Patch, write: Callable[[Words, int], None]
) -> None:
    """Those of one picture with the words beside them, and over all others those that stand above their places."""
    marks, across = page.figure.panels[shot.panel].marks, page.layout.mark
    insets = [other.box for other in page.shots if other.panel == shot.panel and other.source is not None]
    insets = [box for box in insets if shot.source is None]
    placed = [(marks[k], True, x, y) for k, x, y in shot.ghosts] + [(marks[k], False, x, y) for k, x, y in shot.marks]
    written: list[Box] = []
    for mark, is_hidden, x, y in placed:
        stands = mark.glyph.rise > 0
        if any(box.holds(x, y, across / 2) for box in insets):
            continue
        if not stands:
            _draw(axes, page, shot, mark, (x, y), is_hidden, order, frame)
        if not is_hidden:
            _write_beside(axes, page, shot, mark, (x, y), insets, written, order + 2 if stands else order + 1, write)
    standing = [each for each in placed if each[0].glyph.rise > 0]
    standing.sort(key=lambda each: (each[0].glyph.rank, not each[1], -(each[0].number or 0)))
    for rank, (mark, is_hidden, x, y) in enumerate(standing):
        if not any(box.holds(x, y) for box in insets):
            # Each with its numeral below the next.
            _draw(axes, page, shot, mark, (x, y), is_hidden, order + 1 + rank / len(standing), frame)


def _draw(
    axes: Axes,
    page: Composition,
    shot: Shot,
    mark: PointMark,
    at: tuple[float, float],
    is_hidden: bool,
    order: float,
    frame: Patch,
) -> None:
    for part in draw_glyph(axes, page, mark, at, is_hidden, order):
        if shot.source is not None and not is_hidden:
            part.set_clip_path(frame)


def _write_beside(
    axes: Axes,
    page: Composition,
    shot: Shot,
    mark: PointMark,
    place: tuple[float, float],
    insets: list[Box],
    written: list[Box],
    order: int,
    write: Callable[[Words, int], None],
) -> None:
    """The words of a mark, if it has any, off what is written already, to which they are added."""
    text = ", ".join(filter(None, (mark.text, mark.aside)))
    words = _beside(page, shot, text, place, [*insets, *written]) if text else None
    if words and not page.figure.panels[shot.panel].failure:
        written.append(_box_of(page, words))
        _draw_ground(axes, page, written[-1], order)
        write(words, order)


def _beside(page: Composition, shot: Shot, text: str, place: tuple[float, float], taken: list[Box]) -> Words | None:
    """Words at a mark, where they stay in the picture and off all others; None if there is no such place."""
    size, type = page.layout.label, page.layout.lettering
    x, y = place
    area, gap = shot.box, page.layout.mark / 2 + 0.3 * size
    wide = type.width(text, size)
    others = [Box(a - 1, b - 1, 2, 2) for k, a, b in shot.marks if (a, b) != place]
    sides = ((x + gap + wide / 2, y), (x - gap - wide / 2, y), (x, y - gap - 0.5 * size), (x, y + gap + 0.5 * size))
    for middle, level in sides:
        middle = max(min(middle, area.right - wide / 2 - 1), area.x + wide / 2 + 1)
        words = Words((text,), middle, level + 0.36 * size, size)
        box = _box_of(page, words)
        if (
            area.holds(box.x, box.y)
            and area.holds(box.right, box.bottom)
            and not box.holds(x, y, 0.8 * page.layout.mark / 2)
            and not any(box.meets(other) for other in (*taken, *others))
        ):
            return words
    return None


def _draw_ground(axes: Axes, page: Composition, box: Box, order: int) -> None:
    """Under words that may stand on any of a map's colours."""
    from matplotlib.patches import Rectangle

    ground = Rectangle((box.x - 1, box.y), box.width + 2, box.height, linewidth=0, zorder=order)
    ground.set_facecolor((*page.figure.style.background, 1.0 if page.is_opaque else GROUND))
    axes.add_artist(ground)


def _box_of(page: Composition, words: Words) -> Box:
    wide = max(page.layout.lettering.width(line, words.size) for line in words.lines)
    return Box(words.x - wide / 2, words.y - 0.95 * words.size, wide, 1.2 * words.size)


def draw_frames(axes: Axes, page: Composition, shot: Shot, order: int, write: Callable[[Words, int], None]) -> None:
    """Around what an inset enlarges, around the inset, and lines that join the two where they cross nothing.

    Where they would, both have a number instead, if there are several.
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Rectangle

    colour = page.figure.style.quiet_text
    of_panel = [other for other in page.shots if other.panel == shot.panel]
    main, insets = of_panel[0], [other for other in of_panel if other.source is not None]
    for box in _boxes(shot):
        look: dict[str, Any] = {"fill": False, "edgecolor": colour, "linewidth": POINT, "zorder": order}
        axes.add_artist(Rectangle((box.x, box.y), box.width, box.height, **look))
    for line in _leaders(main, insets, shot):
        axes.add_artist(Line2D(line[:, 0], line[:, 1], color=colour, linewidth=0.6 * POINT, zorder=order))
    if len(insets) > 1 and not all(_leaders(main, insets, other) for other in insets):
        for words in _numbers(page, main, insets, shot):
            _draw_ground(axes, page, _box_of(page, words), order)
            write(words, order)


def _numbers(page: Composition, main: Shot, insets: list[Shot], shot: Shot) -> tuple[Words, Words]:
    """The number of an inset, in its corner and beside what it enlarges, where nothing is hidden if may be."""
    size, (source, _) = page.layout.label, _boxes(shot)
    number, gap, (x, y) = (str(1 + insets.index(shot)),), 0.55 * size, source.middle
    places = np.array([(source.right + gap, y), (source.x - gap, y), (x, source.y - gap), (x, source.bottom + gap)])
    is_there = np.array([main.box.holds(across, down, -gap) for across, down in places])
    free = is_there & ~_taken(main, insets, shot, places)
    # Where no side has room, a number stands in the frame.
    at = places[int((2 * free + is_there).argmax())] if is_there.any() else (source.x + gap, source.y + gap)
    corner = Words(number, shot.box.x + 0.6 * size, shot.box.y + 1.1 * size, size)
    return corner, Words(number, at[0], at[1] + 0.36 * size, size)


def _leaders(main: Shot, insets: list[Shot], shot: Shot) -> list[FloatArray]:
    """Lines (2, 2) that join an inset to what it enlarges."""

    def is_taken(points: FloatArray) -> BoolArray:
        return _taken(main, insets, shot, points * (1, -1))

    source, box = _boxes(shot)
    return [line * (1, -1) for line in joins(_upright(source), _upright(box), is_taken)]


def _taken(main: Shot, insets: list[Shot], shot: Shot, points: FloatArray) -> BoolArray:
    """Which of points (k, 2) of the page lie on the shape, on another inset, or on what that enlarges."""
    others = [_upright(box) for other in insets if other is not shot for box in _boxes(other)]
    is_taken: BoolArray = np.any([_on_shape(main, points), *(inside(points * (1, -1), box) for box in others)], axis=0)
    return is_taken


def _boxes(inset: Shot) -> tuple[Box, Box]:
    """What an inset enlarges, and its own."""
    assert inset.source is not None
    return inset.source, inset.box


def _upright(box: Box) -> Rectangle:
    """With y up."""
    return box.x, box.right, -box.bottom, -box.y


def _on_shape(shot: Shot, points: FloatArray) -> BoolArray:
    """Which of points (k, 2) of the page lie on the shape in a picture."""
    alpha = shot.image[..., 3]
    rows, columns = alpha.shape
    column = np.floor((points[:, 0] - shot.box.x) / shot.box.width * columns).astype(int)
    row = np.floor((points[:, 1] - shot.box.y) / shot.box.height * rows).astype(int)
    inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
    found = np.zeros(len(points), bool)
    found[inside] = alpha[row[inside], column[inside]] > 127
    return found


def hidden_words(page: Composition) -> list[str]:
    """A sentence on each source or other marked vertex, and each line, that no picture of its panel shows."""
    found: dict[str, None] = {}
    for k, panel in enumerate(page.figure.panels):
        shots = [shot for shot in page.shots if shot.panel == k]
        shown = {mark[0] for shot in shots for mark in shot.marks}
        hidden = {mark[0] for shot in shots for mark in shot.ghosts} - shown
        names = " and ".join(view if isinstance(view, str) else "of the camera" for view in panel.views)
        views = f"the view {names}" if len(panel.views) == 1 else f"the views {names}"
        # Of extrema there may be dozens, on all sides.
        marks = [
            mark
            for mark in map(panel.marks.__getitem__, sorted(hidden))
            if mark.glyph not in (TRIANGLE_UP, TRIANGLE_DOWN)
        ]
        for what in ("ring", "pin marker"):
            some = [mark for mark in marks if (mark.number is None) == (what == "ring")]
            rest = f"hidden in {views}: a dashed {what}; try --view source or --view front,back."
            if len(some) > MOST_NAMED:
                others = "marked places" if what == "ring" else "numbered points" if some[0].name else "pins"
                found[f"{_named(some[0])} and {len(some) - 1} other {others} are {rest}"] = None
                continue
            for mark in some:
                found[f"{_named(mark)} is {rest}"] = None
        for name in dict.fromkeys(line.name for line in panel.lines if line.name):
            if not any(name in shot.seen for shot in shots):
                found[f"{name} is hidden in {views}; try --view source or --view front,back."] = None
    return list(found)


def _named(mark: PointMark) -> str:
    return mark.name or (f"Pin {mark.number}" if mark.number is not None else f"Vertex {mark.vertex}")
