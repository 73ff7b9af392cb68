"""`bihdist.page`: the command `bihdist page` as a function."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy.typing as npt

from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.quantities import Quantity
from ..session.array_store import Mesh
from .arguments import recipe_of
from .export import Page, write_page
from .options import USUAL


def page(
    mesh: Mesh,
    path: str | os.PathLike[str],
    distances: Sequence[str | Quantity] = USUAL,
    source: Source | str | None = None,
    *,
    fields: Mapping[str, npt.ArrayLike] | None = None,
    precision: str = "24",
    eigenpairs: int = 0,
    progress: Progress | None = None,
    **options: Any,
) -> Page:
    """Write what `bihdist page` writes: one HTML file that computes distances by itself, from wherever one clicks.

    distances: in words, "geodesic" or "biharmonic - commute-time".  source: the vertex that they start from at first,
    the highest if None.  fields: your own by name, (n,) with NaN where undefined, which stay as they are whatever the
    source; each has a panel, or is named in `distances` like one: "biharmonic - mine".  precision: how exactly
    coordinates are kept, "24" bits of the largest side or "float32".  eigenpairs: up to so many may go into the file
    for each truncated or diffusion distance.  options: those of `figure` that mean something here: `areas`, `cut`,
    `merge`, `isolines` and what else is said of these, `views`, `camera`, `up`, `projection`, `colours`, `reversed`,
    `range`, `style` and `pins`.  Returns what the page holds; `differs` is by how much its distances differ from those
    on the mesh itself.  Raises BihdistError, as the command says its sentences.

    >>> import bihdist, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "hand.html")
    >>> page = bihdist.page("hand", path, ["biharmonic", "biharmonic - geodesic"], source=12)
    >>> page.labels
    ('biharmonic, exact', 'biharmonic, exact − geodesic, exact')
    >>> max(page.differs.values()) < 1e-6
    True
    """
    recipe, given = recipe_of("page", mesh, distances, source, fields, options, progress)
    page, _ = write_page(recipe, path, given, precision, eigenpairs, progress)
    return page
