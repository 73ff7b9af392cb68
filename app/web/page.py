"""`bihdist.page`: the command `bihdist page` as a function."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy.typing as npt

from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.quantities import Quantity
from ..figures.arguments import IsolineOptions, LayoutOptions, LookOptions, MarkOptions, ViewOptions
from ..session.array_store import Mesh
from .arguments import recipe_of
from .export import Page, write_page


def page(
    mesh: Mesh,
    path: str | os.PathLike[str],
    distances: Sequence[str | Quantity] | None = None,
    source: Source | str | None = None,
    *,
    fields: Mapping[str, npt.ArrayLike | os.PathLike[str]] | None = None,
    areas: str = "voronoi",
    cut: str = "",
    merge: float | None = None,
    largest_component: bool = False,
    operator: str = "cotan",
    isolines: int | IsolineOptions = 20,
    look: LookOptions | None = None,
    view: ViewOptions | None = None,
    marks: MarkOptions | None = None,
    layout: LayoutOptions | None = None,
    precision: str = "24",
    eigenpairs: int | None = None,
    credit: str = "",
    progress: Progress | None = None,
    **others: Any,
) -> Page:
    """Write a web page that computes distances by itself, from wherever one clicks, as `bihdist page` does.

    Parameters
    ----------
    mesh : str or MeshLike
        A file, the name of a sample, or the mesh itself.
    path : str or path
        The .html file.
    distances : sequence of str, optional
        The distances, a panel each, such as ``"geodesic"`` or ``"biharmonic - commute-time"``; by default biharmonic,
        and geodesic, or commute-time where there are no faces.
    source : int, str or Source, optional
        Vertex that distances start from at first, by default the highest.
    fields : mapping of str to (n,) array_like or file, optional
        Your own fields by name, NaN where undefined, or files of them, which stay as they are whatever the source.
    areas : {"voronoi", "barycentric"}
        Vertex areas.
    cut : str
        File with 1 for each vertex that stays and 0 for each that is cut out; ``{name}`` in it is the mesh's name.
    merge : float, optional
        Merge vertices that are no farther apart.
    largest_component : bool
        Keep only the connected component with most vertices.
    operator : {"cotan", "intrinsic-delaunay", "tufted"}
        The operator, see `Laplacian`.
    isolines : int or IsolineOptions
        About how many isolines, at round values; or ``count``, ``equal``, ``spacing``, ``values`` and ``through``.
    look : LookOptions, optional
        Colours: ``cmap``, ``flip_scalars``, ``bands`` and ``clim``.
    view : ViewOptions, optional
        The first view: ``cpos``, ``camera``, ``viewup`` and ``parallel_projection``.
    marks : MarkOptions, optional
        Marks on surfaces: ``pins``.
    layout : LayoutOptions, optional
        The look of the page: ``style``.
    precision : {"24", "float32"}
        Bits of the largest side that coordinates keep, or single precision.
    eigenpairs : int, optional
        The most that may go into the file for each truncated distance of a panel, with none for one that readers can
        choose; by default as many as take 1 MB.
    credit : str
        A line that the page shows, such as who made the mesh.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    **others
        Any other argument raises a TypeError, which suggests the one that was probably meant.

    Returns
    -------
    Page
        What the page holds.  Its ``differs`` says by how much its distances differ from those on the mesh itself, from
        up to eight vertices; from others they may differ more.

    Raises
    ------
    BihdistError
        If something cannot be read, computed, shown on a page or written.

    Examples
    --------
    >>> import bihdist, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "hand.html")
    >>> page = bihdist.page("hand", path, ["biharmonic", "biharmonic - geodesic"], source=12)
    >>> page.labels
    ('biharmonic, exact', 'biharmonic, exact − geodesic, exact')
    >>> max(page.differs.values()) < 1e-6
    True
    """
    own = {"areas": areas, "cut": cut, "merge": merge, "largest_component": largest_component, "operator": operator}
    groups = {"isolines": isolines, "look": look, "view": view, "marks": marks, "layout": layout}
    recipe, given = recipe_of("page", mesh, distances, source, fields, {**own, **groups, **others}, progress)
    page, _ = write_page(recipe, path, given, precision, eigenpairs, progress, credit)
    return page
