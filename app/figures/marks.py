"""Marks of a figure, with what is written at them, and the frames of its insets."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ..scene.corners import Rectangle, inside, joins
from ..scene.marks import DOT
from ..scene.source_disc import DASHED, DASHES, HALO, RIM
from .boxes import Box, Words
from .crosses import cross_of
from .description import Mark
from .diamonds import solid_of
from .drops import RISE, drop_of, head_radius
from .shots import Shot
from .triangles import triangle_of

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from .canvas import Composition

POINT = 0.75
"""Points in a unit."""

MOST_NAMED = 3
"""So many hidden marks have a sentence each."""

LEAST_DOT = 4.0
"""Units across."""

LEAST_GHOST = 7.5
"""Units across, at which dashes are still told apart."""

GROUND = 0.8
"""How much of what is under words their ground covers."""


def draw_marks(
    axes: Axes, page: Composition, shot: Shot, order: int, frame, write: Callable[[Words, int], None]
) -> None:
    """Those of one picture: discs, rings with a halo at anchors, dashed rings where they are hidden."""
    style, panel = page.figure.style, page.figure.panels[shot.panel]
    across = page.layout.mark
    insets = [other.box for other in page.shots if other.panel == shot.panel and other.source is not None]
    insets = [box for box in insets if shot.source is None]
    written: list[Box] = []
    for k, x, y in shot.ghosts:
        if panel.marks[k].number is not None or any(box.holds(x, y, across / 2) for box in insets):
            continue
        if panel.marks[k].extremum:
            for patch in triangle_of(page, panel.marks[k], x, y, True, order):
                axes.add_artist(patch)
            continue
        if panel.marks[k].is_truth:
            cross_of(axes, page, x, y, True, order)
            continue
        if panel.marks[k].ball or panel.marks[k].diamond:
            for patch in solid_of(page, panel.marks[k], x, y, True, order):
                axes.add_artist(patch)
            continue
        _draw_ghost(axes, x, y, across, style, order)
    for k, x, y in shot.marks:
        if any(box.holds(x, y, across / 2) for box in insets):
            continue
        mark = panel.marks[k]
        if mark.is_passed:
            dot = _disc(x, y, max(DOT * across, LEAST_DOT), style.source, style.mark_edge, order)
            axes.add_artist(dot)
            if shot.source is not None:
                dot.set_clip_path(frame)
            continue
        if mark.number is not None:
            _write_beside(axes, page, shot, mark, (x, y), insets, written, order + 2, write)
            continue
        if mark.extremum or mark.ball or mark.diamond:
            for patch in (triangle_of if mark.extremum else solid_of)(page, mark, x, y, False, order):
                axes.add_artist(patch)
                if shot.source is not None:
                    patch.set_clip_path(frame)
            continue
        if mark.is_truth:
            for line in cross_of(axes, page, x, y, False, order):
                if shot.source is not None:
                    line.set_clip_path(frame)
            continue
        colour = style.largest if mark.is_largest else style.source
        if mark.value is not None:
            patches = _anchor(x, y, across, style.mark_edge, order)
        else:
            patches = [_disc(x, y, across, colour, style.mark_edge, order)]
        for patch in patches:
            axes.add_artist(patch)
            if shot.source is not None:
                patch.set_clip_path(frame)
        _write_beside(axes, page, shot, mark, (x, y), insets, written, order + 1, write)
    _draw_pins(axes, page, shot, order + 1, frame, insets)


def draw_sample(axes: Axes, page: Composition, mark: Mark, x: float, y: float, order: int) -> None:
    """A mark as in a legend: in the middle of its place, with no picture around it."""
    style, across = page.figure.style, page.layout.mark
    if mark.number is not None:
        drop_of(axes, page, mark, x, y + RISE * head_radius(page.layout) / 2, False, order)
    elif mark.is_truth:
        cross_of(axes, page, x, y, False, order)
    else:
        if mark.extremum:
            patches = triangle_of(page, mark, x, y, False, order)
        elif mark.ball or mark.diamond:
            patches = solid_of(page, mark, x, y, False, order)
        else:
            patches = [_disc(x, y, across, style.source, style.mark_edge, order)]
        for patch in patches:
            axes.add_artist(patch)


def _write_beside(
    axes: Axes,
    page: Composition,
    shot: Shot,
    mark: Mark,
    place: tuple[float, float],
    insets: list[Box],
    written: list[Box],
    order: int,
    write: Callable[[Words, int], None],
) -> None:
    """The words of a mark, if it has any, off what is written already, to which they are added."""
    words = _beside(page, shot, mark.text, place, [*insets, *written]) if mark.text else None
    if words and not page.figure.panels[shot.panel].failure:
        written.append(_box_of(page, words))
        _draw_ground(axes, page, written[-1], order)
        write(words, order)


def _draw_pins(axes: Axes, page: Composition, shot: Shot, order: int, frame, insets: list[Box]) -> None:
    """Over all else: the hidden ones below the others, and the first on top, but for a candidate."""
    marks = page.figure.panels[shot.panel].marks
    drops = [(mark[0], True, *mark[1:]) for mark in shot.ghosts] + [(mark[0], False, *mark[1:]) for mark in shot.marks]
    drops = [drop for drop in drops if marks[drop[0]].number is not None]
    drops.sort(key=lambda drop: (marks[drop[0]].is_candidate, not drop[1], -(marks[drop[0]].number or 0)))
    for rank, (k, is_hidden, x, y) in enumerate(drops):
        if any(box.holds(x, y) for box in insets):
            continue
        # Each with its numeral below the next.
        for part in drop_of(axes, page, marks[k], x, y, is_hidden, order + rank / len(drops)):
            if shot.source is not None:
                part.set_clip_path(frame)


def _disc(x: float, y: float, across: float, colour, edge, order: int) -> Artist:
    from matplotlib.patches import Circle

    rim = max(RIM * across, 0.5)
    look = {"facecolor": colour, "edgecolor": edge, "linewidth": rim * POINT}
    return Circle((x, y), across / 2 - rim / 2, zorder=order, **look)


def _anchor(x: float, y: float, across: float, edge, order: int) -> list:
    """A dark ring on a white disc, which is its halo, too."""
    from matplotlib.patches import Annulus, Circle

    halo = Circle((x, y), across / 2, facecolor="white", linewidth=0, zorder=order)
    width = 0.165 * across
    return [halo, Annulus((x, y), 0.25 * across + width, width, facecolor=edge, linewidth=0, zorder=order)]


def _draw_ghost(axes: Axes, x: float, y: float, across: float, style, order: int) -> None:
    """A hollow, dashed circle: light under dark, to be seen on every colour."""
    from matplotlib.patches import Circle

    across = max(across, LEAST_GHOST)
    width = max(DASHED * across, 0.7)
    light = {"edgecolor": style.background, "linewidth": HALO * width * POINT}
    dark = {"edgecolor": style.text, "linewidth": width * POINT, "linestyle": (0, DASHES)}
    for look in (light, dark):
        axes.add_artist(Circle((x, y), across / 2 - width / 2, fill=False, zorder=order, **look))


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
    for box in (shot.source, shot.box):
        look = {"fill": False, "edgecolor": colour, "linewidth": POINT, "zorder": order}
        axes.add_artist(Rectangle((box.x, box.y), box.width, box.height, **look))
    for line in _leaders(main, insets, shot):
        axes.add_artist(Line2D(line[:, 0], line[:, 1], color=colour, linewidth=0.6 * POINT, zorder=order))
    if len(insets) > 1 and not all(_leaders(main, insets, other) for other in insets):
        for words in _numbers(page, main, insets, shot):
            _draw_ground(axes, page, _box_of(page, words), order)
            write(words, order)


def _numbers(page: Composition, main: Shot, insets: list[Shot], shot: Shot) -> tuple[Words, Words]:
    """The number of an inset, in its corner and beside what it enlarges, where nothing is hidden if may be."""
    size, source = page.layout.label, shot.source
    assert source is not None
    number, gap, (x, y) = (str(1 + insets.index(shot)),), 0.55 * size, source.middle
    places = np.array([(source.right + gap, y), (source.x - gap, y), (x, source.y - gap), (x, source.bottom + gap)])
    is_there = np.array([main.box.holds(*place, -gap) for place in places])
    free = is_there & ~_taken(main, insets, shot, places)
    # Where no side has room, a number stands in the frame.
    at = places[int((2 * free + is_there).argmax())] if is_there.any() else (source.x + gap, source.y + gap)
    corner = Words(number, shot.box.x + 0.6 * size, shot.box.y + 1.1 * size, size)
    return corner, Words(number, at[0], at[1] + 0.36 * size, size)


def _leaders(main: Shot, insets: list[Shot], shot: Shot) -> list[np.ndarray]:
    """Lines (2, 2) that join an inset to what it enlarges."""

    def is_taken(points: np.ndarray) -> np.ndarray:
        return _taken(main, insets, shot, points * (1, -1))

    return [line * (1, -1) for line in joins(_upright(shot.source), _upright(shot.box), is_taken)]


def _taken(main: Shot, insets: list[Shot], shot: Shot, points: np.ndarray) -> np.ndarray:
    """Which of points (k, 2) of the page lie on the shape, on another inset, or on what that enlarges."""
    others = [_upright(box) for other in insets if other is not shot for box in (other.box, other.source)]
    return np.any([_on_shape(main, points), *(inside(points * (1, -1), box) for box in others)], axis=0)


def _upright(box: Box) -> Rectangle:
    """With y up."""
    return box.x, box.right, -box.bottom, -box.y


def _on_shape(shot: Shot, points: np.ndarray) -> np.ndarray:
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
        marks = [mark for mark in map(panel.marks.__getitem__, sorted(hidden)) if not mark.extremum]
        for what in ("ring", "pin marker"):
            some = [mark for mark in marks if (mark.number is None) == (what == "ring")]
            rest = f"hidden in {views}: a dashed {what}; try --view source or --two-views."
            if len(some) > MOST_NAMED:
                others = "marked places" if what == "ring" else "numbered points" if some[0].name else "pins"
                found[f"{_named(some[0])} and {len(some) - 1} other {others} are {rest}"] = None
                continue
            for mark in some:
                found[f"{_named(mark)} is {rest}"] = None
        for name in dict.fromkeys(line.name for line in panel.lines):
            if not any(name in shot.seen for shot in shots):
                found[f"{name} is hidden in {views}; try --view source or --two-views."] = None
    return list(found)


def _named(mark: Mark) -> str:
    return mark.name or (f"Pin {mark.number}" if mark.number is not None else f"Vertex {mark.vertex}")
