"""Panels in rows by what they differ in, with a heading for each row and column; and a chart at the end of each row."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace

from bihdist_core import ParameterError
from bihdist_core.distances.answers import Answer
from bihdist_core.distances.distance_types import Spec
from bihdist_core.formats.mesh_names import mesh_name
from bihdist_core.sources.words import short_words_of

from ..document.document import Document, Panel, starting_points
from ..document.page import Page
from ..document.quantities import Quantity, column_names, from_point
from ..document.tools import charted_tools
from ..session.loaded_mesh import LoadedMesh
from ..session.questions import source_at
from .chart_look import Chart

SIGNS = {"alpha": "α"}
"""Signs of parameters that are not typed as they are written."""


@dataclass(frozen=True)
class Arrangement:
    """The panels of a page.

    Attributes
    ----------
    order
        Indices of the document's panels, row by row.
    columns
        Number of columns; None for as many as the page has room for.
    row_heads, column_heads
        Headings in place of those of panels, if there are any.
    """

    order: tuple[int, ...]
    columns: int | None
    row_heads: tuple[str, ...] = ()
    column_heads: tuple[str, ...] = ()


def arranged(
    document: Document, rows: str, surfaces: Mapping[str, LoadedMesh], answers: Sequence[Answer]
) -> Arrangement:
    """Return the arrangement with a row for each source, mesh, distance or value of a parameter.

    Raises ParameterError if rows would have different numbers of panels.
    """
    keys = [_keys(panel, rows) for panel in document.panels]
    downs, acrosses = (list(dict.fromkeys(each)) for each in zip(*keys, strict=True))
    places = {key: k for k, key in enumerate(keys)}
    if not len(places) == len(keys) == len(downs) * len(acrosses):
        raise ParameterError(
            f"Rows by {rows} need the same panels in each row; {len(keys)} panels do not fill "
            f"{len(downs)} rows of {len(acrosses)}."
        )
    order = tuple(places[down, across] for down in downs for across in acrosses)
    words = [_words(document, rows, document.panels[k], surfaces, answers[k]) for k in order]
    count = len(acrosses)

    def joined(some: Sequence[str]) -> str:
        return " / ".join(dict.fromkeys(some))

    return Arrangement(
        order,
        count,
        tuple(joined([word for word, _ in words[k : k + count]]) for k in range(0, len(words), count)),
        tuple(joined([word for _, word in words[k::count]]) for k in range(count)),
    )


def _keys(panel: Panel, rows: str) -> tuple[Hashable, Hashable]:
    """Return what decides in which row a panel stands, and in which column."""
    shows, points, surface = from_point(panel.shows, ""), panel.shows.points, panel.surface
    if rows == "source":
        return points, (shows, surface)
    if rows == "mesh":
        return surface, shows
    if rows == "distance":
        return shows, (points, surface)
    return _value(panel.shows, rows), (_without(shows, rows), points, surface)


def _value(shows: Quantity, name: str) -> str:
    """Return the value of a parameter as it is typed."""
    values = [spec.distance_type.parameter(name).written(spec[name]) for spec in shows.specs if _has(spec, name)]
    if not values:
        raise ParameterError(f"There cannot be rows by {name}: {shows} has no parameter {name}.")
    return " − ".join(dict.fromkeys(values))


def _without(shows: Quantity, name: str) -> Quantity:
    """Return the quantity with the default of a parameter."""

    def usual(part: Quantity) -> Quantity:
        for spec in part.specs:
            if _has(spec, name):
                part = part.with_spec(spec.changed(**{name: spec.distance_type.parameter(name).default}))
        return part

    return shows.with_parts(tuple(map(usual, shows.parts)))


def _has(spec: Spec, name: str) -> bool:
    return name in dict(spec.values)


def _words(
    document: Document, rows: str, panel: Panel, surfaces: Mapping[str, LoadedMesh], answer: Answer
) -> tuple[str, str]:
    """Return the headings of a panel's row and column."""
    loaded, sources = surfaces[panel.surface], source_words(document, panel, surfaces)
    mesh = mesh_name(loaded.surface.name) if loaded.origin is None else f"after: {loaded.mesh.change}"
    others = [mesh] * (len(document.surfaces) > 1) + [sources] * bool(sources)
    if rows == "source":
        return sources, ", ".join([answer.label, *others[:-1]])
    if rows == "mesh":
        return mesh, answer.label
    if rows == "distance":
        return answer.label, ", ".join(others)
    value = _value(panel.shows, rows)
    return value if rows == "method" else f"{SIGNS.get(rows, rows)} = {value}", ", ".join([panel.shows.title, *others])


def source_words(document: Document, panel: Panel, surfaces: Mapping[str, LoadedMesh]) -> str:
    """Return where a panel's field starts, as in "from 12", "" where all start alike."""
    starting = [point for point in starting_points(document) if not point.image_of]
    if len(dict.fromkeys(starting)) < 2 or not panel.shows.points:
        return ""
    surface = surfaces[panel.surface].surface
    starts = [source_at(document.point(name).at, surface) for name in panel.shows.points]
    return f"from {', '.join(map(short_words_of, starts))}"


@dataclass(frozen=True, eq=False)
class ChartRow:
    """The input of a chart: a row of panels.

    Attributes
    ----------
    document
        The document with these panels only.
    surfaces
        The document's surfaces by their names.
    answers
        Answers of panels by their ids.
    tops
        Where the colours of panels end, by their ids.
    """

    document: Document
    page: Page
    surfaces: Mapping[str, LoadedMesh]
    answers: Mapping[int, Answer]
    tops: Mapping[int, float]

    def label(self, panel: Panel) -> str:
        """Return the label of a panel, with the source if the row has several."""
        sources = source_words(self.document, panel, self.surfaces)
        return ", ".join([self.answers[panel.id].label, *[sources] * bool(sources)])

    @property
    def names(self) -> dict[int, str]:
        """Short names of panels by their ids, by what they differ in."""
        panels = self.document.panels
        names = column_names([panel.shows for panel in panels])
        sources = [source_words(self.document, panel, self.surfaces) for panel in panels]
        if any(sources):
            are_alike = len(set(names)) == 1
            names = [source if are_alike else f"{name}, {source}" for name, source in zip(names, sources, strict=True)]
        return dict(zip((panel.id for panel in panels), names, strict=True))


def charts_of(
    document: Document,
    page: Page,
    surfaces: Mapping[str, LoadedMesh],
    answers: Sequence[Answer],
    arrangement: Arrangement,
    tops: Sequence[float],
) -> tuple[tuple[Chart, ...], ...]:
    """Return the charts of each row of a page, one below the other; none of rows without fields.

    Raises ParameterError, also before there are answers, for rows that cannot have such a chart.
    """
    tool = charted_tools()[page.chart]
    make, order = tool.load(tool.charts[page.chart]), arrangement.order
    columns, found = arrangement.columns or len(order), []
    ends = {document.panels[k].id: top for k, top in zip(order, tops, strict=True)}
    for start in range(0, len(order), columns):
        row = order[start : start + columns]
        panels = tuple(document.panels[k] for k in row)
        shown = {document.panels[k].id: answers[k] for k in row if not answers[k].failure}
        shown = {id: answer for id, answer in shown.items() if answer.field is not None or answer.colours is not None}
        some = ChartRow(replace(document, panels=panels), page, surfaces, shown, ends)
        found.append(tuple(make(some)))
    return tuple(found)
