"""The figure of a profile: fields over the length of a path, in the fonts and colours of the other figures.

Values in several units have a plot each, side by side or, on a narrow page, one below the other.
"""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from textwrap import wrap

import numpy as np

from bihdist_core import ParameterError
from bihdist_core.analysis.surface_paths import SurfacePath
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer

from ...document.document import MESH_UNITS, Document, free_names
from ...document.page import Page
from ...document.shared_parts.pins import Pins
from ...drawing.chart import Axis, Plot
from ...drawing.shapes import Box, Pen, Shape, Text, disc, hexadecimal, opaque
from ...figures.arrangement import ChartRow
from ...figures.chart_look import RIM, TICK, USUAL_LOOK, ChartLook, faded
from ...figures.chart_page import save_chart
from ...figures.size import UNITS_PER_INCH
from ...scene.style import PINS, Style, curve_colours, style_of
from .curves import ProfileCurve, parted, profile_curve
from .part import Profile, points_along
from .paths import path_of

MIN_PLOT_WIDTH_IN = 2.8
"""Inches that each of several plots side by side has at least; else they stand below each other."""

MIN_PLOT_HEIGHT_IN, MAX_PLOT_HEIGHT_IN, HEIGHT_PER_WIDTH = 1.5, 2.2, 0.5
"""Inches that a plot is high, and how high it would be for each that it is wide."""

NAME_WRAP_CHARS = 14
"""Letters from which on a name has several lines."""

LINE, NAME_GAP = 1.9, 6.7
"""Units that a curve is wide, and from the plot to the curves' names."""

DISC = 0.62
"""The radius of a point's disc, in font sizes."""

ROOM = 0.05
"""Free space above and below curves, as a fraction of their range."""


@dataclass(frozen=True)
class ProfileKnot:
    """A point that the path goes through, at a length along it: a disc in a colour with a number, "" for a source;
    without a colour no disc."""

    arc: float
    number: str
    colour: str
    name: str = ""


@dataclass(frozen=True, eq=False)
class ProfileFigure:
    """Curves of fields along a path; those of one unit share a plot.

    Attributes
    ----------
    arcs
        The lengths (k,) along the path, in `unit`.
    in_shares
        Whether all are drawn as percentages of their maxima.
    """

    arcs: FloatArray
    curves: tuple[ProfileCurve, ...]
    in_shares: bool = True
    unit: str = ""
    knots: tuple[ProfileKnot, ...] = ()
    look: ChartLook = USUAL_LOOK

    @property
    def plots(self) -> list[tuple[str, bool, list[ProfileCurve]]]:
        """The plots of the figure, see `parted`."""
        return parted(self.curves, self.in_shares)

    @property
    def is_row(self) -> bool:
        """Whether plots stand side by side."""
        return self.look.inches >= MIN_PLOT_WIDTH_IN * len(self.plots)

    @property
    def height(self) -> float:
        """The height of a page for it, in units."""
        count, inches = len(self.plots), self.look.inches
        each = HEIGHT_PER_WIDTH * (inches / count if self.is_row else inches)
        return min(max(each, MIN_PLOT_HEIGHT_IN), MAX_PLOT_HEIGHT_IN) * UNITS_PER_INCH * (1 if self.is_row else count)

    def shapes(self, height: float) -> list[Shape]:
        """Return the plots with the names of curves, at a height in units."""
        count = len(self.plots)
        wide, high = (self.look.width / count, height) if self.is_row else (self.look.width, height / count)
        margins = None if self.is_row else _margins(self, high)
        shapes: list[Shape] = []
        for k, (unit, in_shares, curves) in enumerate(self.plots):
            room = Box(k * wide, 0.0, wide, high) if self.is_row else Box(0.0, k * high, wide, high)
            length = "length along the path" if self.look.inches > MIN_PLOT_WIDTH_IN else "along the path"
            along = f"{length} ({self.unit})" if self.is_row or k == count - 1 else ""
            words = along, "% of the maximum" if in_shares else unit or "value"
            shapes += _plot(self, room, curves, in_shares, words, self.is_row or k == 0, margins)
        return shapes


def save_profile_figure(figure: ProfileFigure, path: str | os.PathLike[str]) -> None:
    """Save the figure of a profile as `save_chart` does; ParameterError if there are no curves, too."""
    if not figure.curves:
        raise ParameterError("There is no field along the path yet; wait until a panel has one.")
    save_chart(path, figure, figure.height)


def _margins(figure: ProfileFigure, high: float) -> tuple[float, float]:
    """Return the left and right margins that all of several plots below each other have."""
    axes = [_axis(*_drawn_values(curves, in_shares), in_shares) for _, in_shares, curves in figure.plots]
    left = max(figure.look.left(up, high - figure.look.foot, "up") for up in axes)
    return left, max(_right(figure.look, curves) for _, _, curves in figure.plots)


def _drawn_values(curves: Sequence[ProfileCurve], in_shares: bool) -> tuple[list[FloatArray], bool]:
    """Return the values that are drawn, and whether 100 % is the most that one of the curves can have."""
    drawn = [100 * curve.shares if in_shares else curve.values for curve in curves]
    return drawn, any(not curve.is_share for curve in curves)


def _name_lines(curve: ProfileCurve) -> list[str]:
    return wrap(curve.name, NAME_WRAP_CHARS, break_long_words=False)


def _right(look: ChartLook, curves: Sequence[ProfileCurve]) -> float:
    """Return the room of the curves' names at the right of their plot."""
    lines = [line for curve in curves for line in _name_lines(curve)]
    return RIM + NAME_GAP + max(look.text_width(line, look.size, True) for line in lines)


def _plot(
    figure: ProfileFigure,
    room: Box,
    curves: Sequence[ProfileCurve],
    in_shares: bool,
    words: tuple[str, str],
    has_discs: bool,
    margins: tuple[float, float] | None,
) -> list[Shape]:
    """Return one plot, with the points that the path goes through and the curves' names."""
    look = figure.look
    drawn, has_whole = _drawn_values(curves, in_shares)
    left, right = margins or (None, _right(look, curves))
    top = RIM + (2 * DISC * look.size if has_discs and figure.knots else 0.6 * look.size)
    across = Axis(0.0, float(figure.arcs[-1]) or 1.0)
    area = Box(room.x, room.y + top, room.width - right, room.height - top)
    plot, shapes = look.plot(area, across, _axis(drawn, has_whole, in_shares), words, left)
    if not words[0]:
        shapes = [shape for shape in shapes if not (isinstance(shape, Text) and shape.y > plot.box.bottom + TICK)]
    knots = _knot_shapes(figure, plot, has_discs)
    paths = []
    for curve, values in zip(curves, drawn, strict=True):
        dashes = (3.7, 1.6) if curve.is_dashed else ()
        pen = Pen(hexadecimal(curve.colour), LINE, dashes, join="round")
        path = plot.curve(figure.arcs, values, pen, f"curve-{figure.curves.index(curve)}")
        paths += [path] if path else []
    return [*knots, *shapes, plot.clipped(paths, LINE), *_name_shapes(look, plot, curves, drawn)]


def _axis(drawn: Sequence[FloatArray], has_whole: bool, in_shares: bool) -> Axis:
    """Return the axis up, to 100 % where that is the most that one of the curves can have."""
    values = np.concatenate([values[np.isfinite(values)] for values in drawn])
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
    pad = ROOM * ((high - low) or 1.0)
    if in_shares and low - pad > -5 and has_whole:
        return Axis(0.0, high + pad if high + pad > 106 else 100.0)
    return Axis(0.0 if low >= 0 else low - pad, high + pad)


def _knot_shapes(figure: ProfileFigure, plot: Plot, has_discs: bool) -> list[Shape]:
    """Return lines where the path goes through points and, over the plot, discs, none on another: the ends go first."""
    look, radius = figure.look, DISC * figure.look.size
    taken: list[float] = []
    shapes: list[Shape] = []
    ends = figure.knots[:1] + figure.knots[-1:]
    for knot in (*ends, *figure.knots[1:-1]):
        shapes.append(plot.upright(knot.arc, Pen(faded(look.style, 0.4), 0.67)))
        x = float(plot.x(knot.arc))
        if not has_discs or not knot.colour or any(abs(x - other) < 2 * radius for other in taken):
            continue
        taken.append(x)
        at, colour = (x, plot.box.y - 1.3 * radius), hexadecimal(knot.colour)
        if knot.number:
            shapes.append(disc(at, radius, colour))
            white = 1.0, 1.0, 1.0, 1.0
            shapes.append(Text(knot.number, *at, 0.85 * look.size, white, True, "centre", "capitals"))
        else:
            shapes.append(disc(at, 0.7 * radius, colour, Pen(opaque(look.style.mark_edge), 1.07)))
    return shapes


def _name_shapes(
    look: ChartLook,
    plot: Plot,
    curves: Sequence[ProfileCurve],
    drawn: Sequence[FloatArray],
) -> list[Shape]:
    """Return each curve's name at its end, one above the other where they would touch."""
    step = 1.25 * look.size
    ends = [
        (float(plot.y(values[np.isfinite(values)][-1])), curve, _name_lines(curve))
        for curve, values in zip(curves, drawn, strict=True)
        if np.isfinite(values).any()
    ]
    ends.sort(key=lambda each: -each[0])
    halves = [step * len(lines) / 2 for _, _, lines in ends]
    places: list[float] = []
    for k, (y, _, _) in enumerate(ends):
        places.append(min(y, places[-1] - halves[k - 1] - halves[k]) if places else y)
    top = plot.box.y - step / 2
    for k in range(len(places) - 1, -1, -1):
        places[k] = max(places[k], top + halves[k])
        top = places[k] + halves[k]
    x, shapes = plot.box.right + NAME_GAP, list[Shape]()
    for (_, curve, lines), y in zip(ends, places, strict=True):
        for k, words in enumerate(lines):
            middle = y + (k - (len(lines) - 1) / 2) * step
            shapes.append(Text(words, x, middle, look.size, hexadecimal(curve.colour), True, level="capitals"))
    return shapes


def profile_figure(
    document: Document,
    page: Page,
    path: SurfacePath,
    answers: Mapping[int, Answer],
    names: Mapping[int, str] | None = None,
) -> ProfileFigure:
    """Return the figure of the chart, in the style of the page and the colours that go with its background.

    The answers are those of panels on the path's surface, by the panels' ids; so are names of curves, if given.
    """
    style = style_of(page.style, document.colours)
    fields = {id: answer.field for id, answer in answers.items() if answer.field is not None}
    along = {panel.id: path.along(fields[panel.id]) for panel in document.panels if panel.id in fields}
    curves = {
        id: profile_curve(document, id, answers[id], values, curve_colours(style))
        for id, values in along.items()
        if np.isfinite(values).any()
    }
    points = points_along(document)
    points = (*points, *points[:1])  # a whole section may come back to the first
    knots = [_knot(document, name, float(path.arcs[at]), style) for at, name in zip(path.knots, points, strict=False)]
    return ProfileFigure(
        path.arcs,
        tuple(replace(curve, name=names[id]) if names else curve for id, curve in curves.items()),
        document[Profile].shares,
        document.unit_of(MESH_UNITS),
        tuple(knots),
        ChartLook.of(page, style),
    )


def charts(row: ChartRow) -> list[ProfileFigure]:
    """Return the profile of a row's panels, along the same path on the row's surface."""
    document, (surface, *others) = row.document, dict.fromkeys(panel.surface for panel in row.document.panels)
    if others:
        raise ParameterError("A profile is of panels of one mesh; --rows mesh gives each mesh a row of its own.")
    names = points_along(document)
    if len(names) < 2:
        raise ParameterError("A chart of a profile needs its path: points of the profile, or pins.")
    own, on = row.surfaces[document.point(names[0]).surface], row.surfaces[surface]
    if not np.array_equal(own.surface.faces, on.surface.faces):
        raise ParameterError(
            f"The path lies on {own.surface.name}; {on.surface.name} has other faces, and no such path."
        )
    _, path = path_of(document, {document.point(names[0]).surface: on})
    return [profile_figure(document, row.page, path, row.answers, row.names)] if row.answers else []


def profile_fields(document: Document, answers: Mapping[int, Answer]) -> dict[str, FloatArray]:
    """Return the fields (n,) of panels, by distinct names."""
    found: dict[str, FloatArray] = {}
    for panel in document.panels:
        answer = answers.get(panel.id)
        if answer is None or answer.field is None:
            continue
        base = str(panel.shows)
        if (point := (*panel.shows.points, "source")[0]) != "source":
            base = f"{base} from {point}"
        (name,) = free_names(base, 1, list(found))
        found[name] = answer.field
    return found


def _knot(document: Document, name: str, arc: float, style: Style) -> ProfileKnot:
    """Return the mark of a point: a pin by its number, a source without one, another point without a disc."""
    number = document[Pins].number(name)
    if number:
        return ProfileKnot(arc, str(number), PINS[document[Pins].pins[number - 1].colour])
    is_source = any(name in panel.shows.points for panel in document.panels)
    colour = "#" + "".join(f"{round(255 * x):02X}" for x in style.source)
    return ProfileKnot(arc, "", colour if is_source else "")
