"""Marks of a figure, with what is written at them, and the frames of its insets, as shapes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, sin

import numpy as np

from bihdist_core.arrays import BoolArray, FloatArray

from ..drawing.glyphs import NAMED, TRIANGLE_DOWN, TRIANGLE_UP, glyph_shapes
from ..drawing.shapes import Box, Group, Path, Pen, Shape, opaque, polyline, rectangle
from ..marks.primitives import PointMark, cut_away_words
from ..scene.clipping import clip_plane, is_kept, lines_cut_away
from ..scene.corners import Rectangle, inside, joins
from .page_layout import ComposedPage
from .shots import Shot
from .words import TextLines

MOST_NAMED = 3
"""Most hidden marks that have a sentence each."""

NEAR = ((1, 0, 0), (-1, 0, 0), (0, -1, 0), (0, 1, 0))
"""Where words stand beside a mark: directions across and down, and further distances in sizes of labels."""
FAR = tuple((cos(angle), sin(angle), far) for far in (1, 2, 3.5, 5, 7, 9, 12) for angle in np.pi / 4 * np.arange(-1, 7))
"""The same with a line to the mark."""

GROUND = 0.8
"""Opacity of the ground under words."""


def mark_shapes(page: ComposedPage, shot: Shot) -> list[Shape]:
    """Return the marks of one picture with the words beside them, those that stand above their places over others."""
    marks, across = page.figure.panels[shot.panel].marks, page.layout.mark
    insets = [inset.box for inset in page.insets_of(shot.panel)] if shot.source is None else []
    placed = [(marks[k], True, x, y) for k, x, y in shot.ghosts] + [(marks[k], False, x, y) for k, x, y in shot.marks]
    written: list[Box] = []
    flat: list[Shape] = []
    beside: list[Shape] = []
    over: list[Shape] = []
    for mark, is_hidden, x, y in placed:
        stands = mark.glyph.rise > 0
        if any(box.holds(x, y, across / 2) for box in insets):
            continue
        if not stands:
            flat += _glyph(page, shot, mark, (x, y), is_hidden)
        if not is_hidden:
            words = _words_beside(page, shot, mark, (x, y), insets, written)
            (over if stands else beside).extend(words)
    standing = [each for each in placed if each[0].glyph.rise > 0]
    standing.sort(key=lambda each: (each[0].glyph.rank, not each[1], -(each[0].number or 0)))
    heads: list[Shape] = []
    for mark, is_hidden, x, y in standing:
        if not any(box.holds(x, y) for box in insets):
            heads += _glyph(page, shot, mark, (x, y), is_hidden)
    return [*flat, *beside, *heads, *over]


def _glyph(page: ComposedPage, shot: Shot, mark: PointMark, at: tuple[float, float], is_hidden: bool) -> list[Shape]:
    """Return a mark's glyph, of one that is hidden perhaps none; in an inset those that are seen end at its frame."""
    glyph = mark.glyph.hidden if is_hidden else mark.glyph
    if glyph is None:
        return []
    reach = glyph.reach_of(page.layout.mark, page.layout.label)
    shapes = glyph_shapes(glyph, at, reach, page.figure.style.named_for(mark.colour), mark.number)
    return [Group(tuple(shapes), shot.box)] if shot.source is not None and not is_hidden else shapes


def _words_beside(
    page: ComposedPage,
    shot: Shot,
    mark: PointMark,
    place: tuple[float, float],
    insets: list[Box],
    written: list[Box],
) -> list[Shape]:
    """Return the words of a mark, if it has any, off what is written already, to which they are added."""
    text = ", ".join(filter(None, (mark.text, mark.aside)))
    if not text or page.figure.panels[shot.panel].failure:
        return []
    is_far = mark.glyph == NAMED
    found = _beside(page, shot, text, place, [*insets, *written], FAR if is_far else NEAR)
    # Names stand off the shape where there is room: the first of those that cover least.
    words = min(found, key=lambda words: _covered(page, shot, words), default=None) if is_far else next(found, None)
    if words is None:
        return []
    written.append(_box_of(page, words))
    line = _line_to(page, place, written[-1]) if is_far else []
    return [*line, _ground(page, written[-1]), *words.shapes(page.figure.style)]


def _covered(page: ComposedPage, shot: Shot, words: TextLines) -> bool:
    """Return whether words stand on the shape, or across the frame of what an inset enlarges."""
    box = _box_of(page, words).grown(2)
    frames = [inset.source for inset in page.insets_of(shot.panel) if shot.source is None]
    if any(frame and frame.meets(box) and not frame.contains(box) for frame in frames):
        return True
    across, down = np.meshgrid(np.linspace(box.x, box.right, 9), np.linspace(box.y, box.bottom, 3))
    return bool((shot.cover_at(np.column_stack([across.ravel(), down.ravel()])) > 0).any())


def _line_to(page: ComposedPage, place: tuple[float, float], box: Box) -> list[Shape]:
    """Return a thin line, light under dark, from the edge of a mark to words in a box."""
    style, at = page.figure.style, np.array(place)
    stop = np.clip(at, (box.x, box.y), (box.right, box.bottom))
    away = (stop - at) / max(float(np.linalg.norm(stop - at)), 1e-9)
    course = polyline(np.array([at + NAMED.reach_of(page.layout.mark, page.layout.label) * away, stop]))
    pens = (Pen(opaque(style.background, GROUND), 2.2), Pen(opaque(style.text), 0.7))
    return [Path(course, pen=pen) for pen in pens]


def _beside(
    page: ComposedPage,
    shot: Shot,
    text: str,
    place: tuple[float, float],
    taken: list[Box],
    ways: Sequence[tuple[float, float, float]],
) -> Iterator[TextLines]:
    """Yield words at a mark, in these directions and distances, where they stay in the picture and off all others."""
    size, type = page.layout.label, page.layout.lettering
    x, y = place
    area, gap = shot.box, page.layout.mark / 2 + 0.3 * size
    wide = type.width(text, size)
    others = [Box(a - 1, b - 1, 2, 2) for k, a, b in shot.marks if (a, b) != place]
    for right, down, far in ways:
        middle = x + right * (gap + far * size) + np.sign(round(right, 3)) * wide / 2
        level = y + down * (gap + (0.5 + far) * size)
        middle = max(min(middle, area.right - wide / 2 - 1), area.x + wide / 2 + 1)
        words = TextLines((text,), middle, level + 0.36 * size, size)
        box = _box_of(page, words)
        if (
            area.holds(box.x, box.y)
            and area.holds(box.right, box.bottom)
            and not box.holds(x, y, 0.8 * page.layout.mark / 2)
            and not any(box.meets(other) for other in (*taken, *others))
        ):
            yield words


def _ground(page: ComposedPage, box: Box) -> Path:
    """Return the ground of words that may stand on any of a map's colours."""
    return Path(rectangle(box.grown(1, 0)), opaque(page.figure.style.background, GROUND))


def _box_of(page: ComposedPage, words: TextLines) -> Box:
    wide = max(page.layout.lettering.width(line, words.size) for line in words.lines)
    return Box(words.x - wide / 2, words.y - 0.95 * words.size, wide, 1.2 * words.size)


def frame_shapes(page: ComposedPage, shot: Shot) -> list[Shape]:
    """Return frames around an inset and around what it enlarges, and lines that join these where they cross nothing.

    Where they would, both have a number instead, if there are several.
    """
    colour = opaque(page.figure.style.quiet_text)
    main, insets = next(other for other in page.shots if other.panel == shot.panel), page.insets_of(shot.panel)
    shapes: list[Shape] = [Path(rectangle(box), pen=Pen(colour)) for box in _boxes(shot)]
    for joining in _leaders(main, insets, shot):
        shapes.append(Path(polyline(joining), pen=Pen(colour, 0.6)))
    if len(insets) > 1 and not all(_leaders(main, insets, other) for other in insets):
        for words in _numbers(page, main, insets, shot):
            shapes += [_ground(page, _box_of(page, words)), *words.shapes(page.figure.style)]
    return shapes


def _numbers(page: ComposedPage, main: Shot, insets: list[Shot], shot: Shot) -> tuple[TextLines, TextLines]:
    """Return the number of an inset in its corner, and beside what it enlarges, where it hides nothing if possible."""
    size, (source, _) = page.layout.label, _boxes(shot)
    number, gap, (x, y) = (str(1 + insets.index(shot)),), 0.55 * size, source.middle
    places = np.array([(source.right + gap, y), (source.x - gap, y), (x, source.y - gap), (x, source.bottom + gap)])
    is_there = np.array([main.box.holds(across, down, -gap) for across, down in places])
    free = is_there & ~_taken(main, insets, shot, places)
    # Where no side has room, a number stands in the frame.
    at = places[int((2 * free + is_there).argmax())] if is_there.any() else (source.x + gap, source.y + gap)
    corner = TextLines(number, shot.box.x + 0.6 * size, shot.box.y + 1.1 * size, size)
    return corner, TextLines(number, at[0], at[1] + 0.36 * size, size)


def _leaders(main: Shot, insets: list[Shot], shot: Shot) -> list[FloatArray]:
    """Return lines (2, 2) that join an inset to what it enlarges."""

    def is_taken(points: FloatArray) -> BoolArray:
        return _taken(main, insets, shot, points * (1, -1))

    source, box = _boxes(shot)
    return [line * (1, -1) for line in joins(_upright(source), _upright(box), is_taken)]


def _taken(main: Shot, insets: list[Shot], shot: Shot, points: FloatArray) -> BoolArray:
    """Return which of points (k, 2) of the page lie on the shape, on another inset, or on what that enlarges."""
    others = [_upright(box) for other in insets if other is not shot for box in _boxes(other)]
    on_others = (inside(points * (1, -1), box) for box in others)
    is_taken: BoolArray = np.any([main.cover_at(points) > 127, *on_others], axis=0)
    return is_taken


def _boxes(inset: Shot) -> tuple[Box, Box]:
    """Return the box that an inset enlarges, and its own."""
    assert inset.source is not None
    return inset.source, inset.box


def _upright(box: Box) -> Rectangle:
    """Return a box with y up."""
    return box.x, box.right, -box.bottom, -box.y


def hidden_words(page: ComposedPage) -> list[str]:
    """Return a sentence on each source, other mark or line that no picture of its panel shows."""
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
            rest = f"hidden in {views}: a dashed {what}; try --cpos source or --cpos front,back."
            if len(some) > MOST_NAMED:
                others = "marked places" if what == "ring" else "numbered points" if some[0].name else "pins"
                found[f"{some[0].title} and {len(some) - 1} other {others} are {rest}"] = None
                continue
            for mark in some:
                found[f"{mark.title} is {rest}"] = None
        plane, x = clip_plane(panel.clip, panel.surface), panel.surface.vertices
        gone = [mark for mark in panel.marks if not is_kept(plane, mark.on(x)[None])[0]]
        lines = lines_cut_away(plane, ((line.name, line.positions(x)) for line in panel.lines))
        if (gone or lines) and not panel.warp_factor:
            found[cut_away_words(gone, lines)] = None
        for name in dict.fromkeys(line.name for line in panel.lines if line.name):
            if name not in lines and not any(name in shot.seen for shot in shots):
                rest = ", or cut away" if plane is not None else "; try --cpos source or --cpos front,back"
                found[f"{name} is hidden in {views}{rest}."] = None
    return list(found)
