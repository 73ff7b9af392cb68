"""The pairs of a document on one of its surfaces: where their points are, and where the best partner would be."""

from dataclasses import dataclass

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.arrays import IntArray
from bihdist_core.distances.answers import Answer

from ...document.document import Document, Panel
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import vertex_at
from .pairs import Pair, Pairs, half_pair, number_of, waiting_point, whole_pairs
from .prediction_answers import candidate_of
from .quantity import predicts_in


@dataclass(frozen=True)
class LocatedPairPoint:
    """A point of a pair at a vertex, with the number of the pair from 1."""

    number: int
    pair: Pair
    point: str
    vertex: int

    @property
    def is_waiting(self) -> bool:
        """Return whether the point has no partner yet."""
        return self.pair.is_half


@dataclass(frozen=True)
class Candidate:
    """The vertex that fits the point without a partner best, with its misfit, also as a share of the largest."""

    number: int
    vertex: int
    misfit: float
    share: float


def located_pair_points(document: Document, surface: str, loaded: LoadedMesh) -> tuple[LocatedPairPoint, ...]:
    """Return the points of pairs on a surface, each at its nearest vertex."""
    found = []
    for pair in document[Pairs].pairs:
        for name in pair.points:
            point = document.point(name)
            if point.surface == surface:
                vertex = vertex_at(point.at, loaded.surface)
                found.append(LocatedPairPoint(number_of(document, pair), pair, name, vertex))
    return tuple(found)


def candidate_in(document: Document, panel: Panel, answer: Answer | None) -> Candidate | None:
    """Return the candidate of a panel, None if it predicts nothing."""
    half, waiting = half_pair(document), waiting_point(document)
    if not predicts_in(panel) or half is None or waiting is None or waiting.surface == panel.surface:
        return None
    if answer is None or answer.field is None or np.isnan(answer.field).all():
        return None
    vertex, share = candidate_of(answer.field)
    return Candidate(number_of(document, half), vertex, float(answer.field[vertex]), share)


def vertex_pairs(document: Document, first: Surface, second: Surface) -> IntArray:
    """Return the vertices (k, 2) of whole pairs on both surfaces, for a file; ParameterError if there are none."""
    pairs = [
        [
            vertex_at(document.point(name).at, surface)
            for name, surface in zip(pair.points, (first, second), strict=True)
        ]
        for pair in whole_pairs(document)
    ]
    if not pairs:
        raise ParameterError("There are no pairs to write.")
    return np.array(pairs)
