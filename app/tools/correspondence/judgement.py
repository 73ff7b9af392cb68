"""How far the maps of a document are from the truth: the errors of sampled vertices, found beside the window's thread.

Errors are geodesic distances on the second surface from where sampled vertices of the first belong.  These are found
once, whatever pairs there are: then another pair costs its maps alone.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from bihdist_core import BihdistError, Cancelled, Laplacian, ParameterError, Surface
from bihdist_core.applications.correspondence import NOWHERE
from bihdist_core.applications.map_errors import (
    ErrorCurve,
    error_curve,
    error_distance,
    error_method,
    map_errors,
    sampled_vertices,
)
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.distances.geodesic import GeodesicDistance
from bihdist_core.distances.kinds import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...document.document import Document
from ...session.loaded_mesh import LoadedMesh
from .map_answers import map_in
from .maps import SAME_IDS, MapFile, Maps, Truth
from .pairs import whole_pairs
from .prediction_answers import correspondence

MOST_KEPT = 40_000_000
"""Numbers of four bytes that are kept of geodesic distances: from 400 vertices of a surface of 100,000."""

BLOCK = 8
"""So many of these are found between two answers, or as many as take EVERY seconds."""

EVERY = 0.7

KEY = 20
"""The seed of the order in which sampled vertices are judged: the first of them are all over the surface, too."""

Map = Spec | MapFile
"""Made by the document's pairs and a distance, or in a file."""


def maps_of(document: Document) -> tuple[Map, ...]:
    """Those that the panels show, or predict a point of, each once; and those of the document's files."""
    shown = [panel.shows for panel in document.panels if panel.shows.relates_surfaces]
    return (*dict.fromkeys(spec for each in shown for spec in each.specs), *document[Maps].maps)


# ---------------------------------------------------------------------- the truth
def is_same_ids(one: Surface, two: Surface) -> bool:
    """Whether vertices with the same ids correspond as far as the faces say."""
    return len(one.vertices) == len(two.vertices) and np.array_equal(one.faces, two.faces)


def truth_of(truth: Truth, one: Surface, two: Surface) -> IntArray | None:
    """(n,) where each vertex of one surface belongs on the other, -1 where that is not known; None for no such map.

    ParameterError for a map that is none between these surfaces.
    """
    if truth.file is not None:
        return _on_faces(map_in(truth.file, one, two), two)
    if truth.word == "identity" or (truth.word == "auto" and is_same_ids(one, two)):
        return _on_faces(map_in(MapFile(SAME_IDS), one, two), two)
    return None


def _on_faces(right: IntArray, two: Surface) -> IntArray:
    """From vertices of no face no distance is defined: what belongs there belongs nowhere."""
    return np.where((right != NOWHERE) & (two.component_of_vertex[right] >= 0), right, NOWHERE)


def partners_of(truth: Truth, two: Surface) -> IntArray | None:
    """(n,) the symmetric partner of each vertex of the second surface, if that counts; the same error."""
    return _on_faces(map_in(truth.partners, two, two), two) if truth.mirror and truth.partners is not None else None


def right_places(truth: Truth, one: Surface, two: Surface, vertex: int, is_on_first: bool) -> list[int]:
    """Where a vertex of one of the surfaces belongs on the other: a vertex, and its symmetric partner if that counts.

    [] where that is not known.
    """
    right = truth_of(truth, one, two)
    if right is None:
        return []
    partners = partners_of(truth, two)
    if is_on_first:
        found = [int(right[vertex])]
        found += [] if partners is None or found[0] == NOWHERE else [int(partners[found[0]])]
    else:
        images = [vertex] if partners is None else [vertex, int(partners[vertex])]
        found = [int(each) for image in images if image != NOWHERE for each in np.flatnonzero(right == image)[:1]]
    return [each for each in dict.fromkeys(found) if each != NOWHERE]


# ---------------------------------------------------------------------- errors
class KeptGeodesics:
    """Geodesic distances on a surface, each found once: like a `Distance`, as far as `map_errors` goes.

    count: from so many vertices, which says by which method.
    """

    is_symmetric = False
    """So that `map_errors` asks for fields, which are kept, and not for pairs."""

    def __init__(self, laplacian: Laplacian, count: int) -> None:
        self.surface = laplacian.surface
        self.distance: GeodesicDistance = error_distance(laplacian, count)
        self.most = max(MOST_KEPT // max(len(self.surface.vertices), 1), 1)
        self._columns: dict[int, FloatArray] = {}

    def missing(self, vertices: Sequence[int]) -> list[int]:
        """Those of the vertices whose geodesic distances are not known yet, each once."""
        return [vertex for vertex in dict.fromkeys(vertices) if vertex not in self._columns]

    def find(self, vertices: Sequence[int], progress: Progress | None = None) -> None:
        """Know these; those that were asked for the longest ago are forgotten, if there are too many."""
        new = self.missing(vertices)
        if new:
            found = self.distance.from_sources(new, progress).astype(np.float32)
            self._columns.update(zip(new, np.ascontiguousarray(found.T), strict=True))
        for vertex in vertices:
            self._columns[vertex] = self._columns.pop(vertex)
        while len(self._columns) > max(self.most, len(vertices)):
            del self._columns[next(iter(self._columns))]

    def from_sources(self, vertices: IntArray) -> AnyArray:
        """(n, m) from (m,) vertices."""
        ids = np.asarray(vertices).tolist()
        self.find(ids)
        return np.stack([self._columns[vertex] for vertex in ids], axis=1)


@dataclass(frozen=True, eq=False)
class Asked:
    """Which maps are to be judged, between which surfaces, by which truth."""

    one: LoadedMesh
    two: LoadedMesh
    areas: str
    maps: tuple[Map, ...]
    pairs: tuple[tuple[Source | None, Source | None], ...]
    truth: Truth

    @property
    def about(self) -> tuple[object, ...]:
        """What the answer depends on."""
        return id(self.one.surface), id(self.two.surface), self.areas, self.maps, self.pairs, self.truth


def asked_of(document: Document, one: LoadedMesh, two: LoadedMesh) -> Asked:
    """What a document asks of its two surfaces."""
    pairs = tuple((document.point(pair.first).at, document.point(pair.second).at) for pair in whole_pairs(document))
    return Asked(one, two, document.areas, maps_of(document), pairs, document[Maps].truth)


@dataclass(frozen=True, eq=False)
class Judgement:
    """The curves of maps, of those that there are, over so many (`known`) of the sampled vertices (`wanted`).

    failures: why a map has none.  method: of the errors, in words.
    """

    curves: dict[Map, ErrorCurve]
    failures: dict[Map, str]
    known: int
    wanted: int
    vertices: int
    method: str

    @property
    def is_whole(self) -> bool:
        """Whether all that was wanted is known."""
        return self.known == self.wanted or not self.curves


class Judging:
    """Judges maps, on one thread; what does not depend on pairs is kept from one request to the next."""

    def __init__(self) -> None:
        self._kept: KeptGeodesics | None = None

    def judge(self, asked: Asked, progress: Progress | None = None) -> Iterator[Judgement]:
        """The curves over more and more of the sampled vertices, the last over all of them.

        Nothing where it is not known what is right, or there is no map.  Raises ParameterError for a truth that is
        none, Cancelled as `progress` does.
        """
        one, two = asked.one.surface, asked.two.surface
        right = truth_of(asked.truth, one, two)
        if right is None or not asked.maps:
            return
        partners = partners_of(asked.truth, two)
        ids = sampled_vertices(len(one.vertices), self._samples(asked))
        # Vertices of no face are mapped nowhere, and nobody can say where they belong.
        ids = np.random.default_rng(KEY).permutation(ids[(right[ids] != NOWHERE) & (one.component_of_vertex[ids] >= 0)])
        if not len(ids):
            raise ParameterError("Of no sampled vertex it is known where it belongs.")
        found, failures = self._found(asked, ids, part(progress, 0, 0.2))
        if not found:
            yield Judgement({}, failures, 0, len(ids), len(one.vertices), "")
            return
        kept = self._geodesics(asked, len(ids))
        report, to = part(progress, 0.25, 1), np.stack(list(found.values()), axis=1)
        for stop in self._stops(kept, right[ids], partners, report):
            errors = map_errors(kept, to[:stop], right[ids[:stop]], partners)  # type: ignore[arg-type]
            curves = {map: error_curve(column) for map, column in zip(found, errors.T, strict=True)}
            yield Judgement(curves, failures, stop, len(ids), len(one.vertices), kept.distance.label)

    def _samples(self, asked: Asked) -> int | None:
        wanted = asked.truth.samples or len(asked.one.surface.vertices)
        return min(wanted, max(MOST_KEPT // len(asked.two.surface.vertices), 1))

    def _found(
        self, asked: Asked, ids: IntArray, progress: Progress | None
    ) -> tuple[dict[Map, IntArray], dict[Map, str]]:
        """Of each map where it leads from these vertices (m,), or why that is not known."""
        found: dict[Map, IntArray] = {}
        failures: dict[Map, str] = {}
        for k, map in enumerate(asked.maps):
            step = part(progress, k / len(asked.maps), (k + 1) / len(asked.maps))
            try:
                if isinstance(map, MapFile):
                    found[map] = map_in(map, asked.one.surface, asked.two.surface)[ids]
                elif asked.pairs:
                    known = correspondence(asked.areas, map, asked.pairs, asked.one, asked.two, step)
                    found[map] = known.map(ids)
            except Cancelled:
                raise
            except (BihdistError, MemoryError) as error:
                failures[map] = failure_in_words(error)
        return found, failures

    def _geodesics(self, asked: Asked, count: int) -> KeptGeodesics:
        laplacian, kept = asked.two.distances(asked.areas).laplacian, self._kept
        surface = laplacian.surface
        if kept is None or kept.surface is not surface or kept.distance.method != error_method(surface, count):
            kept = self._kept = KeptGeodesics(laplacian, count)
        return kept

    @staticmethod
    def _stops(kept: KeptGeodesics, right: IntArray, partners: IntArray | None, report: Progress) -> Iterator[int]:
        """How many of the right answers (m,) are known by now, each time that more of them are."""
        answers = [[int(each)] for each in right]
        if partners is not None:
            answers = [[*each, *(int(p) for p in partners[each] if p != NOWHERE)] for each in answers]
        stop, last = 0, time.monotonic()
        while stop < len(answers) and not kept.missing(answers[stop]):
            stop += 1
        if 0 < stop < len(answers):
            yield stop
        while stop < len(answers):
            report(stop / len(answers), f"errors of {stop:,} of {len(answers):,} vertices")
            some = answers[stop : stop + BLOCK]
            kept.find([vertex for each in some for vertex in each], _checked(report, stop / len(answers)))
            stop += len(some)
            if stop < len(answers) and time.monotonic() - last > EVERY:
                last = time.monotonic()
                yield stop
        kept.find([vertex for each in answers for vertex in each])
        yield stop


def _checked(report: Progress, share: float) -> Progress:
    """Cancelled where the report is, without another share."""
    return lambda fraction, text: report(share, text)
