"""What pages that compute, and widgets, are told: of the options of figures those that mean something for them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy.typing as npt

from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.option import Row
from ..document.page import Recipe
from ..document.quantities import Quantity
from ..figures.options import rows, with_options
from ..session.array_store import ArrayStore, Mesh, comparison_of_arrays

USUAL = ("biharmonic", "geodesic")
"""The panels where none are named: neither needs eigenpairs."""

NAMES = ("areas", "cut", "isolines", "up", "views", "projection", "colours", "range", "style", "pins")
"""Of each row the first option."""


def page_rows() -> tuple[Row, ...]:
    """The rows of the table of figures' options that pages know."""
    return tuple(row for row in rows() if row.options and row.options[0].name in NAMES)


def other_names() -> list[str]:
    """The arguments of figures that pages have not."""
    known = {option.name for row in page_rows() for option in row.options}
    return [option.name for row in rows() for option in row.options if option.name not in known]


def chosen(
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
