"""The errors of the maps of a document at sampled vertices, found in the background.

Errors are geodesic distances on the second surface from where sampled vertices of the first belong. These are found
once, whatever pairs there are, so that another pair costs its maps alone.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from weakref import WeakKeyDictionary

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
from bihdist_core.distances.distance_types import Spec
from bihdist_core.distances.geodesic import GeodesicDistance
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...document.document import Document
from ...document.quantities import kind_name
from ...figures.arrangement import ChartRow
from ...figures.chart_look import ChartLook
from ...figures.error_figure import ErrorFigure
from ...scene.style import curve_colours, style_of
from ...session.loaded_mesh import LoadedMesh
from .answers import correspondence
from .maps import SAME_IDS, MapFile, Maps, Truth, map_in
from .pairs import whole_pairs

MAX_KEPT_VALUES = 40_000_000
"""Numbers of four bytes that are kept of geodesic distances: from 400 vertices of a surface of 100,000."""

VERTICES_PER_BLOCK = 8
"""The vertices whose distances are found between two answers, unless that takes longer than ANSWER_INTERVAL_S
seconds."""

ANSWER_INTERVAL_S = 0.7

ORDER_SEED = 20
"""The seed of the random order in which sampled vertices are measured, so that the first ones lie all over the
surface."""

Map = Spec | MapFile
"""Made by the document's pairs and a distance, or in a file."""


def maps_of(document: Document) -> tuple[Map, ...]:
    """Return the maps that panels show or predict by, each once, and those of the document's files."""
    shown = [panel.shows for panel in document.panels if panel.shows.relates_surfaces]
    return (*dict.fromkeys(spec for each in shown for spec in each.specs), *document[Maps].maps)


def map_name(map: Map, document: Document) -> str:
    """Return the name of a map among those of a document."""
    if isinstance(map, MapFile):
        return map.name
    same = [each for each in maps_of(document) if isinstance(each, Spec) and each.word == map.word]
    return kind_name(map.distance_type) if len(same) < 2 else str(map)


# ---------------------------------------------------------------------- the truth
def is_same_ids(one: Surface, two: Surface) -> bool:
    """Return whether both surfaces have the same faces, so that equal ids correspond."""
    return len(one.vertices) == len(two.vertices) and np.array_equal(one.faces, two.faces)


def truth_of(truth: Truth, one: Surface, two: Surface) -> IntArray | None:
    """Return the right vertex (n,) for each vertex of one surface, -1 where it is not known; None without a truth.

    Raises ParameterError for a map that does not fit these surfaces.
    """
    if truth.file is not None:
        return _on_faces(map_in(truth.file, one, two), two)
    if truth.word == "identity" or (truth.word == "auto" and is_same_ids(one, two)):
        return _on_faces(map_in(MapFile(SAME_IDS), one, two), two)
    return None


def _on_faces(right: IntArray, two: Surface) -> IntArray:
    """Replace vertices without faces, from which no distance is defined, by -1."""
    return np.where((right != NOWHERE) & (two.component_of_vertex[right] >= 0), right, NOWHERE)


def partners_of(truth: Truth, two: Surface) -> IntArray | None:
    """Return the symmetric partner (n,) of each vertex of the second surface, None if partners do not count."""
    return _on_faces(map_in(truth.partners, two, two), two) if truth.mirror and truth.partners is not None else None


def right_places(truth: Truth, one: Surface, two: Surface, vertex: int, is_on_first: bool) -> list[int]:
    """Return the right vertex for a vertex of either surface, and its symmetric partner if that counts; [] if
    unknown."""
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
    """Geodesic distances on a surface from `count` vertices, each found once; used like a `Distance` by
    `map_errors`."""

    is_symmetric = False
    """So that `map_errors` asks for fields, which are kept, and not for pairs."""

    def __init__(self, laplacian: Laplacian, count: int) -> None:
        self.surface = laplacian.surface
        self.distance: GeodesicDistance = error_distance(laplacian, count)
        self.most = max(MAX_KEPT_VALUES // max(len(self.surface.vertices), 1), 1)
        self._columns: dict[int, FloatArray] = {}

    def missing(self, vertices: Sequence[int]) -> list[int]:
        """Return the vertices whose distances are not known yet, each once."""
        return [vertex for vertex in dict.fromkeys(vertices) if vertex not in self._columns]

    def find(self, vertices: Sequence[int], progress: Progress | None = None) -> None:
        """Compute the distances from these vertices, and forget those that were asked for the longest ago."""
        new = self.missing(vertices)
        if new:
            found = self.distance.from_sources(new, progress).astype(np.float32)
            self._columns.update(zip(new, np.ascontiguousarray(found.T), strict=True))
        for vertex in vertices:
            self._columns[vertex] = self._columns.pop(vertex)
        while len(self._columns) > max(self.most, len(vertices)):
            del self._columns[next(iter(self._columns))]

    def from_sources(self, vertices: IntArray) -> AnyArray:
        """Return the distances (n, m) from (m,) vertices."""
        ids = np.asarray(vertices).tolist()
        self.find(ids)
        return np.stack([self._columns[vertex] for vertex in ids], axis=1)


@dataclass(frozen=True, eq=False)
class MapErrorRequest:
    """The maps whose errors are wanted, the surfaces they are between, and the truth."""

    one: LoadedMesh
    two: LoadedMesh
    areas: str
    maps: tuple[Map, ...]
    pairs: tuple[tuple[Source | None, Source | None], ...]
    truth: Truth

    @property
    def about(self) -> tuple[object, ...]:
        """The values that the answer depends on."""
        return id(self.one.surface), id(self.two.surface), self.areas, self.maps, self.pairs, self.truth


def request_of(document: Document, one: LoadedMesh, two: LoadedMesh) -> MapErrorRequest:
    """Return the request for the errors of a document's maps."""
    pairs = tuple((document.point(pair.first).at, document.point(pair.second).at) for pair in whole_pairs(document))
    return MapErrorRequest(one, two, document.areas, maps_of(document), pairs, document[Maps].truth)


@dataclass(frozen=True, eq=False)
class MapErrors:
    """The error curves of maps over `known` of the `wanted` sampled vertices.

    `failures` are the reasons why maps have none, `method` the distance of the errors in words.
    """

    curves: dict[Map, ErrorCurve]
    failures: dict[Map, str]
    known: int
    wanted: int
    vertices: int
    method: str

    @property
    def is_whole(self) -> bool:
        """Return whether the errors of all wanted vertices are known."""
        return self.known == self.wanted or not self.curves


class MapErrorWorker:
    """Finds errors of maps, on one thread; what does not depend on pairs is kept from one request to the next."""

    def __init__(self) -> None:
        self._kept: KeptGeodesics | None = None

    def errors(self, asked: MapErrorRequest, progress: Progress | None = None) -> Iterator[MapErrors]:
        """Yield the curves over more and more of the sampled vertices, the last over all of them.

        Yields nothing without a truth or a map. Raises ParameterError for a truth that does not fit, and Cancelled
        as `progress` does.
        """
        one, two = asked.one.surface, asked.two.surface
        right = truth_of(asked.truth, one, two)
        if right is None or not asked.maps:
            return
        partners = partners_of(asked.truth, two)
        ids = sampled_vertices(len(one.vertices), self._samples(asked))
        # Vertices of no face are mapped nowhere, and nobody can say where they belong.
        ids = np.random.default_rng(ORDER_SEED).permutation(
            ids[(right[ids] != NOWHERE) & (one.component_of_vertex[ids] >= 0)]
        )
        if not len(ids):
            raise ParameterError("The truth is not known for any of the sampled vertices.")
        found, failures = self._images(asked, ids, part(progress, 0, 0.2))
        if not found:
            yield MapErrors({}, failures, 0, len(ids), len(one.vertices), "")
            return
        kept = self._geodesics(asked, len(ids))
        report, to = part(progress, 0.25, 1), np.stack(list(found.values()), axis=1)
        for stop in self._stops(kept, right[ids], partners, report):
            errors = map_errors(kept, to[:stop], right[ids[:stop]], partners)  # type: ignore[arg-type]
            curves = {map: error_curve(column) for map, column in zip(found, errors.T, strict=True)}
            yield MapErrors(curves, failures, stop, len(ids), len(one.vertices), kept.distance.label)

    def _samples(self, asked: MapErrorRequest) -> int | None:
        wanted = asked.truth.samples or len(asked.one.surface.vertices)
        return min(wanted, max(MAX_KEPT_VALUES // len(asked.two.surface.vertices), 1))

    def _images(
        self, asked: MapErrorRequest, ids: IntArray, progress: Progress | None
    ) -> tuple[dict[Map, IntArray], dict[Map, str]]:
        """Return the images (m,) of these vertices under each map, and the reasons why maps have none."""
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

    def _geodesics(self, asked: MapErrorRequest, count: int) -> KeptGeodesics:
        laplacian, kept = asked.two.distances(asked.areas).laplacian, self._kept
        surface = laplacian.surface
        if kept is None or kept.surface is not surface or kept.distance.method != error_method(surface, count):
            kept = self._kept = KeptGeodesics(laplacian, count)
        return kept

    @staticmethod
    def _stops(kept: KeptGeodesics, right: IntArray, partners: IntArray | None, report: Progress) -> Iterator[int]:
        """Yield how many of the right answers (m,) are known by now, each time that there are more."""
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
            some = answers[stop : stop + VERTICES_PER_BLOCK]
            kept.find([vertex for each in some for vertex in each], _checked(report, stop / len(answers)))
            stop += len(some)
            if stop < len(answers) and time.monotonic() - last > ANSWER_INTERVAL_S:
                last = time.monotonic()
                yield stop
        kept.find([vertex for each in answers for vertex in each])
        yield stop


def _checked(report: Progress, share: float) -> Progress:
    """Return a progress that can be cancelled, and reports no other fraction than `share`."""
    return lambda fraction, text: report(share, text)


_workers: WeakKeyDictionary[LoadedMesh, MapErrorWorker] = WeakKeyDictionary()


def charts(row: ChartRow) -> list[ErrorFigure]:
    """Return the error curves of the maps that the panels of a row show or predict by."""
    document, surfaces = row.document, row.surfaces
    if len(document.surfaces) != 2:
        raise ParameterError("A chart of errors is of maps between two meshes; add a second mesh, and maps to it.")
    if not row.answers:
        return []
    one, two = (surfaces[mesh.name] for mesh in document.surfaces)
    worker = _workers.setdefault(two, MapErrorWorker())
    *_, found = (None, *worker.errors(request_of(document, one, two)))
    if found is None or not found.curves:
        raise ParameterError("The errors of these maps are not known: there is no map, or no truth to measure it by.")
    curves = {map_name(map, document): curve for map, curve in found.curves.items()}
    style = style_of(row.page.style, document.colours)
    return [ErrorFigure(curves, curve_colours(style), ChartLook.of(row.page, style))]
