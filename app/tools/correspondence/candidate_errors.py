"""The place where the point without a partner belongs, and how far the candidates are from it."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from bihdist_core.progress import Progress

from ...document.document import Document
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import vertex_at
from .map_errors import KeptGeodesics, right_places
from .maps import Maps, Truth
from .pairs import other_side, waiting_point


@dataclass(frozen=True, eq=False)
class CandidateErrorRequest:
    """Candidates for a vertex of one of two surfaces, by the ids of panels, and the truth that says where it
    belongs."""

    one: LoadedMesh
    two: LoadedMesh
    areas: str
    truth: Truth
    vertex: int
    is_on_first: bool
    candidates: tuple[tuple[int, int], ...]

    @property
    def about(self) -> tuple[object, ...]:
        """The values that the answer depends on, except the candidates."""
        return id(self.one.surface), id(self.two.surface), self.areas, self.truth, self.vertex, self.is_on_first

    @property
    def there(self) -> LoadedMesh:
        """The surface of the candidates."""
        return self.two if self.is_on_first else self.one


@dataclass(frozen=True, eq=False)
class CandidateErrors:
    """The right vertex and, if it counts, its symmetric partner; and errors over the root of the area, by the ids of
    panels.

    There are no errors as long as they are not known.
    """

    places: tuple[int, ...]
    errors: dict[int, float]


def candidate_request(
    document: Document, one: LoadedMesh, two: LoadedMesh, candidates: dict[int, int]
) -> CandidateErrorRequest | None:
    """Return the request for these candidates, None if no point is without a partner."""
    point = waiting_point(document)
    if point is None or other_side(document, point.surface) is None:
        return None
    is_on_first = point.surface == document.surfaces[0].name
    vertex = vertex_at(point.at, (one if is_on_first else two).surface)
    found = tuple(sorted(candidates.items()))
    return CandidateErrorRequest(one, two, document.areas, document[Maps].truth, vertex, is_on_first, found)


class CandidateErrorWorker:
    """Finds errors of candidates, on one thread; distances are kept as long as the surface stays."""

    def __init__(self) -> None:
        self._kept: KeptGeodesics | None = None

    def errors(self, asked: CandidateErrorRequest, progress: Progress | None = None) -> Iterator[CandidateErrors]:
        """Yield the right places, then the errors of the candidates as well.

        Raises ParameterError for a truth that does not fit the surfaces.
        """
        one, two, there = asked.one.surface, asked.two.surface, asked.there.surface
        places = tuple(right_places(asked.truth, one, two, asked.vertex, asked.is_on_first))
        yield CandidateErrors(places, {})
        if not places or not asked.candidates:
            return
        laplacian = asked.there.distances(asked.areas).laplacian
        if self._kept is None or self._kept.surface is not laplacian.surface:
            self._kept = KeptGeodesics(laplacian, asked.truth.samples or len(one.vertices))
        kept = self._kept
        kept.find(places, progress)
        unit = float(np.sqrt(there.face_areas.sum()))
        nearest = kept.from_sources(np.array(places)).min(axis=1)
        yield CandidateErrors(places, {panel: float(nearest[vertex]) / unit for panel, vertex in asked.candidates})
