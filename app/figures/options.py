"""All that a figure can be told, in one table: from it come options of commands, arguments of `bihdist.figure`, and the
lines that make a figure again (`one_line`).  Rows of tools stand in their folders (`Tool.options`).
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from bihdist_core.progress import Progress

from ..document.derived_surfaces import COLUMNS
from ..document.document import AREAS, Document
from ..document.looks import PROJECTIONS
from ..document.option import (
    NotExpressible,
    Option,
    Row,
    attribute,
    unsaid,
    with_attribute,
)
from ..document.page import Recipe
from ..document.tools import tools
from .look_options import COLOURS, ISOLINES, RANGE, SHADING, with_range
from .repair_options import REPAIRS
from .view_options import UP, VIEWS, ZOOMS

VERTEX_AREAS = attribute("document.areas", "vertex areas (default: voronoi)", choices=AREAS)

PAGE_ROWS = (
    attribute("page.font", "of all words (default: DejaVu Sans)", "FAMILY"),
    attribute("page.text", "size of labels, other words in proportion (default: by the size)", "POINTS", read=float),
    attribute(
        "page.size",
        "such as 85mm, 1680x640, 160mm@300dpi, 160x80mm; or column (85 mm), double (178 mm), slide, A0",
        "SIZE",
    ),
    attribute("page.style", "paper, uniform, lines or dark (default: paper)", "NAME"),
)
"""Of a page, with panels or with a chart."""


# ---------------------------------------------------------------------- columns
def rows_of_sources(recipe: Recipe) -> int | None:
    """The columns of a page with a row of panels for each source, None if there are not several sources."""
    names = {name for panel in recipe.document.panels for name in panel.shows.points}
    return len(recipe.document.panels) // len(names) if len(names) > 1 else None


def _columns_of(recipe: Recipe) -> dict[str, Any]:
    """Without a word, one row a source."""
    usual = rows_of_sources(recipe)
    if recipe.page.columns is None and usual is not None:
        raise NotExpressible("The panels of several sources are in one row.")
    return {} if recipe.page.columns == usual else {"columns": recipe.page.columns}


# ---------------------------------------------------------------------- all of them
ROWS = (
    VERTEX_AREAS,
    REPAIRS,
    ISOLINES,
    attribute(
        "document.isolines.bold", "each of so many is bolder (nothing: 5)", "N", name="bold_isolines", read=int, bare=5
    ),
    attribute("document.isolines.labels", "the values stand on the lines", name="isoline_labels"),
    UP,
    VIEWS,
    attribute("document.projection", "how depth is drawn (default: perspective)", choices=PROJECTIONS),
    attribute("document.axes", "where x, y and z point to, in a corner (default: no)"),
    Row(
        (Option("columns", "panels side by side (default: all, or one row a source)", metavar="N", read=int),),
        ("Page.columns",),
        _columns_of,
        lambda recipe, values: with_attribute(recipe, "page.columns", values["columns"]),
    ),
    ZOOMS,
    attribute("document.extrema", "triangles at maxima and at minima away from the source (default: no)"),
    attribute(
        "document.height",
        "a flat mesh becomes a height field, its highest point at this fraction of its extent (nothing: 0.35)",
        "FRACTION",
        read=float,
        bare=0.35,
    ),
    COLOURS,
    RANGE,
    attribute("page.hints", "what to look for, under the headings (default: no)"),
    attribute("page.title", "names as heading (default), as caption at the bars, or none", "WHERE"),
    *PAGE_ROWS,
    attribute("page.transparent", "no background"),
    attribute("page.crop", "without the empty margins"),
    SHADING,
    unsaid("for panels that are still to come", "Document.next_id"),
    unsaid("where instruments stand in the window", "Document.dock_places"),
    unsaid("what the pointer does in the window", "Document.snap"),
    unsaid("each is said by itself", "Document.parts"),
    unsaid("for the window and the history", "Panel.id"),
    unsaid("with one mesh all panels are of it", "Panel.surface"),
    unsaid("with one mesh there is none beside it", "Document.beside"),
    unsaid("what the cameras of the window do", "Document.linked"),
    unsaid("the file's name says it", "Page.format"),
    unsaid("what the mask holds is looked up", "Repairs.cut_sha256"),
)


@cache
def tool_rows() -> tuple[Row, ...]:
    """Those of tools, in their order."""
    return tuple(row for tool in tools() if tool.options for row in tool.load(tool.options))


def rows() -> tuple[Row, ...]:
    """The table, with the rows of tools at its end."""
    return (*ROWS, *tool_rows())


def arguments() -> dict[str, Option]:
    """By name, what `bihdist.figure` takes besides a mesh, what is shown of it, and from where."""
    return {option.name: option for row in rows() for option in row.options}


def made_from(document: Document) -> tuple[Document, dict[str, Any]]:
    """The document that a row has made this one from, and the value of its option; itself and {} if none has."""
    for row in rows():
        made, value = (document, None) if row.made_from is None else row.made_from(document)
        if value is not None:
            return made, {row.options[0].name: value}
    return document, {}


def with_rows(recipe: Recipe, values: Mapping[str, Any], those: Iterable[Row]) -> Recipe:
    """The recipe with the values that some rows know, by name."""
    for row in those:
        own = {option.name: values[option.name] for option in row.options if option.name in values}
        recipe = row.put(recipe, own) if own else recipe
    return recipe


def with_options(
    recipe: Recipe,
    values: Mapping[str, Any],
    beside: Callable[[Document], Document] = lambda document: document,
    tell: Callable[[str], None] = lambda sentence: None,
    progress: Progress | None = None,
) -> Recipe:
    """The recipe with the values of any options, by name; ParameterError where they make no sense.

    beside: the document with a second mesh, if there is to be one.  tell: gets a sentence on colour bars that end as in
    a file.  progress: of fields that this takes.
    """
    document, made = made_from(recipe.document)
    was = recipe.page.columns if made else None
    first = [row for row in rows() if not row.is_late]
    recipe = with_rows(replace(recipe, document=document), values, first)
    ends = values.get("range")
    is_ranged = "range" in values
    # What replaces the panels has colour bars of its own.
    is_of_all = any(option.replaces_panels for name, option in arguments().items() if name in values) or (
        isinstance(ends, list | tuple) and len(ends) not in (1, len(document.panels))
    )
    if is_ranged and not is_of_all:
        recipe = with_range(recipe, values, tell, progress)
    making = [row for row in rows() if row.made_from is not None]
    chosen = {option.name: values[option.name] for row in making for option in row.options if option.name in values}
    if chosen or made:
        recipe = with_rows(recipe, chosen or made, making)
        columns = values.get("columns") or (None if chosen else was) or COLUMNS
        recipe = with_attribute(recipe, "page.columns", columns)
    last = [REPAIRS, *(row for row in rows() if row.is_of_two)]
    recipe = with_rows(replace(recipe, document=beside(recipe.document)), values, last)
    return with_range(recipe, values, tell, progress) if is_ranged and is_of_all else recipe
