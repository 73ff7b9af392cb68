"""`bihdist.widget`: the page that computes, in a notebook."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from bihdist_core import ParameterError
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.quantities import Quantity
from ..figures.arguments import IsolineOptions, LayoutOptions, LookOptions, MarkOptions, ViewOptions
from ..session.array_store import Mesh
from ..version import install_command
from .arguments import recipe_of
from .export import page_of

if TYPE_CHECKING:
    from .distance_widget import DistanceWidget


def widget(
    mesh: Mesh,
    distances: Sequence[str | Quantity] | None = None,
    source: Source | str | None = None,
    *,
    fields: Mapping[str, npt.ArrayLike | os.PathLike[str]] | None = None,
    on_pick: Callable[[int], object] | None = None,
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
    progress: Progress | None = None,
    **others: Any,
) -> DistanceWidget:
    """Show linked panels of distances in a notebook (Jupyter, VS Code, marimo); a click computes in the browser.

    Parameters
    ----------
    mesh : str or MeshLike
        A file, the name of a sample, or the mesh itself.
    distances : sequence of str, optional
        The distances, a panel each, such as ``"geodesic"`` or ``"biharmonic - commute-time"``; by default biharmonic,
        and geodesic, or commute-time where there are no faces.
    source : int, str or Source, optional
        Vertex that distances start from, by default the highest.
    fields : mapping of str to (n,) array_like or file, optional
        Your own fields by name, NaN where undefined, or files of them, which stay as they are whatever the source.
    on_pick : callable, optional
        Called with the vertex of each click.
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
        The most that may be sent for each truncated distance of a panel, with none for one that readers can choose; by
        default as many as take 1 MB.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    **others
        Any other argument raises a TypeError, which suggests the one that was probably meant.

    Returns
    -------
    DistanceWidget
        The panels.  Its traits ``source`` and ``pins`` go both ways.

    Raises
    ------
    ParameterError
        If an argument makes no sense.
    BihdistError
        If something cannot be read, computed or shown, or if the package anywidget is not installed.

    Examples
    --------
    >>> import bihdist
    >>> shown = bihdist.widget("hand", ["biharmonic", "biharmonic - geodesic"], source=12, marks={"pins": [900]})
    >>> shown.source, shown.pins
    (12, [{'id': 900, 'name': ''}])
    >>> shown.source = 900
    """
    try:
        from .distance_widget import DistanceWidget
    except ImportError:
        raise ParameterError(f"Widgets need the package anywidget: {install_command('anywidget')}") from None
    own = {"areas": areas, "cut": cut, "merge": merge, "largest_component": largest_component, "operator": operator}
    groups = {"isolines": isolines, "look": look, "view": view, "marks": marks, "layout": layout}
    recipe, given = recipe_of("widget", mesh, distances, source, fields, {**own, **groups, **others}, progress)
    made = DistanceWidget.of(page_of(recipe, given, precision, eigenpairs, progress))
    if on_pick is not None:
        made.on_pick(on_pick)
    return made
