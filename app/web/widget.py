"""`bihdist.widget`: the page that computes, in a notebook."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from bihdist_core import ParameterError
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ..document.quantities import Quantity
from ..session.array_store import Mesh
from .arguments import recipe_of
from .export import page_of
from .options import USUAL

if TYPE_CHECKING:
    from .distance_widget import DistanceWidget


def widget(
    mesh: Mesh,
    distances: Sequence[str | Quantity] = USUAL,
    source: Source | str | None = None,
    *,
    fields: Mapping[str, npt.ArrayLike] | None = None,
    on_pick: Callable[[int], object] | None = None,
    precision: str = "24",
    eigenpairs: int = 0,
    progress: Progress | None = None,
    **options: Any,
) -> DistanceWidget:
    """Linked panels of distances in a notebook (Jupyter, VS Code, marimo), in which a click computes, in the browser.

    mesh: a file, a sample, a Surface, or vertices (n, 3) and faces (m, 3).  distances: a panel each, in words,
    "geodesic" or "biharmonic - commute-time".  source: a vertex, the highest if None.  fields: your own by name, (n,)
    with NaN where undefined, which stay as they are whatever the source; each has a panel, or is named in `distances`
    like one: "biharmonic - mine".  on_pick: called with the vertex of each click.  precision: of coordinates, "24" bits
    of the largest side or "float32".  eigenpairs: how many may be sent for each truncated or diffusion distance.
    options: those of `figure` that mean something here: `areas`, `cut`, `merge`, `isolines` and what else is said of
    these, `views`, `camera`, `up`, `projection`, `colours`, `reversed`, `range`, `style` and `pins`.  The traits
    `source` and `pins` of what is returned go both ways.  Raises BihdistError, also where the package anywidget is not
    installed.

    >>> import bihdist
    >>> shown = bihdist.widget("hand", ["biharmonic", "biharmonic - geodesic"], source=12, pins=[900])
    >>> shown.source, shown.pins
    (12, [{'id': 900, 'name': ''}])
    >>> shown.source = 900
    """
    try:
        from .distance_widget import DistanceWidget
    except ImportError:
        raise ParameterError("Widgets need the package anywidget: pip install 'bihdist[widget]'.") from None
    recipe, given = recipe_of("widget", mesh, distances, source, fields, options, progress)
    made = DistanceWidget.of(page_of(recipe, given, precision, eigenpairs, progress))
    if on_pick is not None:
        made.on_pick(on_pick)
    return made
