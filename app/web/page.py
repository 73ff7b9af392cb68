"""`bihdist.page`: the command `bihdist page` as a function."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.page import Recipe
from ..document.quantities import Quantity
from ..figures.options import with_options
from ..session.array_store import Mesh, comparison_of_arrays
from .export import Page, write_page
from .options import USUAL, page_rows


def page(
    mesh: Mesh,
    path: str | os.PathLike[str],
    distances: Sequence[str | Quantity] = USUAL,
    source: Source | str | None = None,
    *,
    precision: str = "24",
    eigenpairs: int = 0,
    progress: Progress | None = None,
    **options: Any,
) -> Page:
    """Write what `bihdist page` writes: one HTML file that computes distances by itself, from wherever one clicks.

    distances: in words, "geodesic" or "biharmonic - commute-time".  source: the vertex that they start from at first,
    the highest if None.  precision: how exactly coordinates are kept, "24" bits of the largest side or "float32".
    eigenpairs: up to so many may go into the file for each truncated or diffusion distance.  options: those of
    `figure` that mean something here, such as `areas`, `cut`, `merge`, `isolines`, `views`, `camera`, `up`,
    `projection`, `colours`, `range` and `pins`.  Returns what the page holds; `differs` is by how much its
    distances differ from those on the mesh itself.  Raises BihdistError, as the command says its sentences.

    >>> import bihdist, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "hand.html")
    >>> page = bihdist.page("hand", path, ["biharmonic", "biharmonic - geodesic"], source=12)
    >>> page.labels
    ('biharmonic, exact', 'biharmonic, exact − geodesic, exact')
    >>> max(page.differs.values()) < 1e-6
    True
    """
    known = {option.name: option for row in page_rows() for option in row.options}
    if unknown := options.keys() - known.keys():
        raise TypeError(f"page() got an unexpected keyword argument {min(unknown)!r}")
    document, store = comparison_of_arrays(mesh, distances, {}, (source,))
    values = {name: value for name, value in options.items() if not known[name].is_usual(value)}
    recipe = with_options(Recipe(document), values, progress=progress)
    page, _ = write_page(recipe, path, store, precision, eigenpairs, progress)
    return page
