"""The arguments of the functions `page` and `widget` as a recipe."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.document import COMPARISON
from ..document.page import Recipe
from ..document.quantities import Quantity
from ..figures.arguments import option_values
from ..figures.options import with_options
from ..session.array_store import ArrayStore, Mesh, Values, comparison_of_arrays
from .options import USUAL, page_rows


def recipe_of(
    function: str,
    mesh: Mesh,
    distances: Sequence[str | Quantity] | None,
    source: Source | str | None,
    fields: Mapping[str, Values] | None,
    arguments: Mapping[str, Any],
    progress: Progress | None = None,
) -> tuple[Recipe, ArrayStore]:
    """Return the recipe of a page, and the arrays that it refers to.

    Raises TypeError for an unknown argument, with the name of the function, and ParameterError for an invalid value.
    """
    values = option_values(function, page_rows(), arguments)
    document, given = comparison_of_arrays(mesh, distances, {} if fields is None else fields, (source,))
    if distances is None:  # of the three of figures the first two
        panels = document.panels
        document = replace(document, panels=(*panels[: len(USUAL)], *panels[len(COMPARISON) :]))
    return with_options(Recipe(document), values, progress=progress), given
