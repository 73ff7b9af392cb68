"""Farthest points of a surface, found in the background."""

from collections.abc import Iterator
from dataclasses import dataclass

from bihdist_core.analysis.sampling import farthest_points, starts_of
from bihdist_core.arrays import IntArray
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from .loaded_mesh import LoadedMesh


@dataclass(frozen=True, eq=False)
class SamplesRequest:
    """A request for a number of vertices from a source, each the farthest from those before it by a distance."""

    loaded: LoadedMesh
    areas: str
    spec: Spec
    at: Source
    count: int


def find_samples(request: SamplesRequest, progress: Progress) -> Iterator[IntArray]:
    """Yield the vertices (count,) of a request; VertexError or ParameterError for a source that is not on vertices."""
    starts = starts_of(request.at, request.loaded.surface)
    distance = request.loaded.distances(request.areas).get(request.spec, part(progress, 0, 0.5))
    yield farthest_points(distance, starts, request.count, part(progress, 0.5, 1))
