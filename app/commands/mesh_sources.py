"""The sources that an option names, on the mesh of a command."""

import argparse
import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import short_words_of

from ..document.document import COMPARISON
from ..document.quantities import Quantity
from ..document.repairs import Repairs
from ..document.sources import HIGHEST, LISTED, POSITION, Sources
from .mesh import found_mesh
from .terminal import tell, tell_moved

if TYPE_CHECKING:
    from bihdist_core import Distance, Surface

    from ..session.chosen_sources import Chosen


def sources_on(
    options: argparse.Namespace,
    surface: "Surface",
    distance: "Callable[[], Distance]",
    progress: Progress | None = None,
) -> "Chosen":
    """Return the sources of `--sources` on the surface of the command's mesh, the highest vertex by default.

    `distance` returns the one by which points are farthest.
    """
    return sources_of_mesh(options.sources or HIGHEST, options.mesh, surface, distance, progress)


def sources_of_mesh(
    asked: Sources,
    mesh: str,
    surface: "Surface",
    distance: "Callable[[], Distance]",
    progress: Progress | None = None,
) -> "Chosen":
    """Return the sources on the surface of a mesh, and tell how far the points of a file had to be moved."""
    from ..session.chosen_sources import chosen_sources

    name = os.path.splitext(os.path.basename(mesh))[0]
    found = chosen_sources(asked, surface, distance, name, progress=progress)
    if found.pins is not None:
        noun = "position" if asked.file.startswith(POSITION) else "pin"
        tell_moved(found.path, noun, found.pins, found.pins.ids.tolist(), surface)
    return found


def sources_of_document(
    asked: Sources | None,
    mesh: str,
    shows: Sequence[Spec | Quantity],
    areas: str | None,
    repairs: Repairs,
    progress: Progress | None = None,
) -> list[Source]:
    """Return the sources on the mesh of a document that is still to be opened, [] if none are named.

    Points are farthest by the first distance of `shows`; `areas` and `repairs` say how the mesh is taken.
    """
    if asked is None or asked.rule == LISTED:
        # Whoever opens the document looks where they are.
        return [] if asked is None else [*asked.members]
    from bihdist_core import Laplacian
    from bihdist_core.distances.answers import Distances

    from ..session.repaired_surface import read_repaired

    surface = read_repaired(found_mesh(mesh), repairs)
    spec = first_spec(shows)
    distances = Distances(Laplacian(surface, areas or "voronoi", repairs.operator))
    return sources_of_mesh(asked, mesh, surface, lambda: distances.get(spec, progress), progress).sources


def sources_of_two(asked: Sources | None, found: list[Source], other: str) -> tuple[list[Source], Source | None]:
    """Return the sources on the first mesh as one for it and one for the second, None for the highest vertex.

    Raises ParameterError for more than two, and for a second one by a rule or a file, which are of the first mesh.
    """
    if len(found) > 2 or (asked is not None and asked.rule != LISTED and len(found) > 1):
        raise ParameterError(
            f"Two meshes have a source each, and --sources names {len(found):,} of the first; write one of each with a "
            "comma, such as 12,40."
        )
    if len(found) == 1:
        tell(
            f"--sources names one of the first mesh, and {other} starts from its highest vertex; one of each is named "
            f"as {short_words_of(found[0])},40."
        )
    return found[:1], found[1] if len(found) > 1 else None


def first_spec(shows: Sequence[Spec | Quantity]) -> Spec:
    """Return the first distance of what is shown, or the usual one."""
    specs = (spec for each in shows for spec in ((each,) if isinstance(each, Spec) else each.specs))
    return next(specs, COMPARISON[0])


def one_source(sources: list[Source]) -> Source | None:
    """Return the only source, None if there is none; ParameterError for several."""
    from ..session.chosen_sources import Chosen

    return Chosen(sources).one() if sources else None
