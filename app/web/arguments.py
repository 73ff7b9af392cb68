"""What the functions `page` and `widget` are told, as a recipe."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy.typing as npt

from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.page import Recipe
from ..document.quantities import Quantity
from ..figures.options import with_options
from ..session.array_store import ArrayStore, Mesh, comparison_of_arrays
from .options import page_rows


def recipe_of(
    function: str,
    mesh: Mesh,
    distances: Sequence[str | Quantity],
    source: Source | str | None,
    fields: Mapping[str, npt.ArrayLike] | None,
    options: Mapping[str, Any],
    progress: Progress | None = None,
) -> tuple[Recipe, ArrayStore]:
    """What a function of that name shows, with options by their names, and the arrays that it is given.

    TypeError for an option that pages have not, ParameterError for what makes no sense.
    """
    known = {option.name: option for row in page_rows() for option in row.options}
    if unknown := options.keys() - known.keys():
        raise TypeError(f"{function}() got an unexpected keyword argument {min(unknown)!r}")
    document, given = comparison_of_arrays(mesh, distances, {} if fields is None else fields, (source,))
    values = {name: value for name, value in options.items() if not known[name].is_usual(value)}
    return with_options(Recipe(document), values, progress=progress), given
