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
from ..document.option import (
    NotExpressible,
    Option,
    Row,
    attribute,
    unsaid,
    with_attribute,
)
from ..document.page import Recipe
from ..document.settings import AXES, ISOLINE_LABELS, PARALLEL_PROJECTION, SCALE_BAR, SHOW_EDGES
from ..document.tools import tools
from .look_options import BASE, COLOURS, ISOLINES, OPACITY, RANGE, SHADING, suits_one_bar, with_range
from .repair_options import REPAIRS
from .size import is_column
from .view_options import CLIP, INSETS, UP, VIEWS

VERTEX_AREAS = attribute("document.areas", "vertex areas (default: voronoi)", group="", choices=AREAS)


def _layout(name: str, meaning: str, metavar: str | None = None, **how: Any) -> Row:
    return attribute(f"page.{name}", meaning, metavar, group="layout", **how)


PAGE_ROWS = (
    _layout("font_family", "font of all text (default: DejaVu Sans)", "FAMILY"),
    _layout(
        "font_size",
        "font size of labels in points, other text in proportion (default: by the size)",
        "POINTS",
        read=float,
    ),
    _layout(
        "size",
        "such as 85mm, 3.5in, 1680x640, 160mm@300dpi; or column (85 mm, cropped), double (178 mm), slide, A0",
        "SIZE",
    ),
    _layout("style", "paper, uniform, lines, dark or cover (default: paper)", "NAME"),
)
"""Of a page, with panels or with a chart."""


# ---------------------------------------------------------------------- columns
def rows_of_sources(recipe: Recipe) -> int | None:
    """Return the columns of a page with a row of panels for each source, None if there is one source."""
    names = {name for panel in recipe.document.panels for name in panel.shows.points}
    return len(recipe.document.panels) // len(names) if len(names) > 1 else None


def _columns_of(recipe: Recipe) -> dict[str, Any]:
    """Return the columns, unless there is a row for each source, which is the default."""
    usual = rows_of_sources(recipe)
    if recipe.page.columns is None and usual is not None:
        raise NotExpressible("The panels of several sources are in one row.")
    return {} if recipe.page.columns == usual else {"columns": recipe.page.columns}


# ---------------------------------------------------------------------- one column
def _with_column(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    """Return the recipe cropped and with one colour bar, if its size is one column of a journal."""
    if not is_column(values.get("size", "")):
        return recipe
    if "crop" not in values:
        recipe = with_attribute(recipe, "page.crop", True)
    if "clim" not in values and recipe.document.range == "own" and suits_one_bar(recipe):
        recipe = with_attribute(recipe, "document.range", "fraction")
    return recipe


CROP = Row(
    (Option("crop", "crop the empty margins (default: in one column)", group="layout", is_flag=True),),
    ("Page.crop",),
    lambda recipe: {} if recipe.page.crop == is_column(recipe.page.size) else {"crop": recipe.page.crop},
    lambda recipe, values: with_attribute(recipe, "page.crop", values["crop"]),
)

# ---------------------------------------------------------------------- all of them
ROWS = (
    VERTEX_AREAS,
    REPAIRS,
    ISOLINES,
    attribute(
        "document.isolines.bold",
        "draw every n-th isoline bold (without a number: 5)",
        "N",
        name="bold_isolines",
        group="isolines",
        key="bold",
        read=int,
        bare=5,
    ),
    ISOLINE_LABELS.row,
    UP,
    VIEWS,
    PARALLEL_PROJECTION.row,
    AXES.row,
    SCALE_BAR.row,
    attribute("document.unit", "unit of the mesh's lengths, such as mm (default: mesh units)", "UNIT", group="view"),
    CLIP,
    Row(
        (
            Option(
                "columns",
                "number of panels side by side (default: all, or one row for each source)",
                group="layout",
                metavar="N",
                read=int,
            ),
        ),
        ("Page.columns",),
        _columns_of,
        lambda recipe, values: with_attribute(recipe, "page.columns", values["columns"]),
    ),
    INSETS,
    attribute(
        "document.extrema", "mark maxima, and minima away from the source, by triangles (default: no)", group="look"
    ),
    attribute(
        "document.warp_factor",
        "show a flat mesh as a height field, its highest point at this fraction of its extent (without a number: 0.35)",
        "FRACTION",
        group="look",
        read=float,
        bare=0.35,
    ),
    *COLOURS,
    *BASE,
    RANGE,
    _layout("hints", "say under each heading what to look for (default: no)"),
    _layout("panel_letters", "write (a), (b), (c) over the panels"),
    _layout(
        "rows",
        "a row of panels for each source, mesh, distance, or value of t, alpha, k or method, with headings of rows and "
        "columns",
        "WHAT",
    ),
    attribute(
        "page.chart",
        "a chart at the end of each row: profile (with --profile), scatter, histogram or errors",
        "NAME",
        name="row_chart",
        group="layout",
        key="chart",
    ),
    _layout("title", "show names as heading (default), as caption at the bars, or none", "WHERE"),
    *PAGE_ROWS,
    _layout("transparent", "draw no background"),
    _layout("ground", "draw a soft shadow on the ground"),
    _layout("feature_edges", "draw thin lines along sharp edges, as the style cover does (see --feature-angle)"),
    CROP,
    _layout(
        "layout",
        "hemispheres: lateral and medial views of each hemisphere in a row, a row for each distance",
        "hemispheres",
        choices=("hemispheres",),
    ),
    SHADING,
    SHOW_EDGES.row,
    OPACITY,
    unsaid("for panels that are still to come", "Document.next_id"),
    unsaid("where instruments stand in the window", "Document.dock_places"),
    unsaid("what the pointer does in the window", "Document.snap"),
    unsaid("each is said by itself", "Document.parts"),
    unsaid("for the window and the history", "Panel.id"),
    unsaid("with one mesh all panels are of it", "Panel.surface"),
    unsaid("with one mesh there is none beside it", "Document.second_views"),
    unsaid("what the cameras of the window do", "Document.linked"),
    unsaid("the file's name says it", "Page.format"),
    unsaid("what the mask holds is looked up", "Repairs.cut_sha256"),
)


@cache
def tool_rows() -> tuple[Row, ...]:
    """Return the rows of tools, in their order."""
    return tuple(row for tool in tools() if tool.options for row in tool.load(tool.options))


def rows() -> tuple[Row, ...]:
    """Return the table, with the rows of tools at its end."""
    return (*ROWS, *tool_rows())


def arguments() -> dict[str, Option]:
    """Return the options of `bihdist.figure` by their names, without the mesh, the distances and the sources."""
    return {option.name: option for row in rows() for option in row.options}


def made_from(document: Document) -> tuple[Document, dict[str, Any]]:
    """Return the document that a row has derived this one from, and the option's value; itself and {} if none has."""
    for row in rows():
        made, value = (document, None) if row.made_from is None else row.made_from(document)
        if value is not None:
            return made, {row.options[0].name: value}
    return document, {}


def with_rows(recipe: Recipe, values: Mapping[str, Any], those: Iterable[Row]) -> Recipe:
    """Return the recipe with the values, by name, that some rows know."""
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
    """Return the recipe with the values of any options, by name.

    Parameters
    ----------
    beside
        Returns the document with a second mesh, if there is to be one.
    tell
        Called with a sentence on colour limits that were taken from a file.
    progress
        Told of the fields that this computes.

    Raises
    ------
    ParameterError
        If a value is invalid.
    """
    document, made = made_from(recipe.document)
    was = recipe.page.columns if made else None
    first = [row for row in rows() if not row.is_late]
    recipe = with_rows(replace(recipe, document=document), values, first)
    ends = values.get("clim")
    is_ranged = "clim" in values
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
    recipe = with_range(recipe, values, tell, progress) if is_ranged and is_of_all else recipe
    return _with_column(recipe, values)
