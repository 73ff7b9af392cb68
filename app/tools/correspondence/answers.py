"""The answers of pairs: where a point is on the other surface; and maps, from files or pairs, with their colours."""

import threading
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core import BihdistError, Cancelled, Correspondence, ParameterError, Surface, VertexError
from bihdist_core.applications.correspondence import NOWHERE, carried_back, position_colours
from bihdist_core.arrays import FloatArray, IntArray
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, failed, same_on
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...document.document import Document, MeshFile, Panel
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import ByDistance, Question, question_of, vertex_at
from .maps import MapColours, MapFile, Maps, map_in
from .pairs import Pair, Pairs, half_pair, number_of, other_side, waiting_point, whole_pairs
from .quantity import PREDICTION, Prediction, predicts_in

NO_OTHER = "There is no second mesh: open one beside this to find corresponding points."
"""The message of a panel that predicts without a second mesh."""

MISFIT = "misfit"
"""The unit of predictions: distances in them are fractions of the largest one."""

MAX_SPARE_COLUMNS = 64
"""Columns of points that are in no pair any more which are kept: of one that is dragged, of what is undone."""


class KnownColumns:
    """Distances of a surface's vertices from some of them, (n,) each, for any thread; the latest come last.

    `solved` is the number of columns computed so far.
    """

    def __init__(self) -> None:
        self.solved = 0
        self._columns: dict[tuple[str, Spec], dict[int, FloatArray]] = {}
        self._lock = threading.Lock()

    def of(self, areas: str, spec: Spec) -> dict[int, FloatArray]:
        """Return a copy of the columns of a distance, by vertex."""
        with self._lock:
            return dict(self._columns.get((areas, spec), {}))

    def put(self, areas: str, spec: Spec, columns: dict[int, FloatArray], wanted: set[int]) -> None:
        """Keep these, as far as they are wanted or among the latest."""
        with self._lock:
            known = self._columns.pop((areas, spec), {})
            self._columns[areas, spec] = known  # the latest
            self.solved += len(columns.keys() - known.keys())
            for vertex in (*(columns.keys() - wanted), *wanted):
                if vertex in columns:
                    known[vertex] = known.pop(vertex, columns[vertex])
            spare = [vertex for vertex in known if vertex not in wanted]
            for vertex in spare[: max(len(spare) - MAX_SPARE_COLUMNS, 0)]:
                del known[vertex]

    def keep(self, areas: str, wanted: set[Spec]) -> None:
        """Forget what is known with other areas and by other distances, but for the last of each word.

        That may be the method that both surfaces have, or a stand-in; a slider leaves one at every step.
        """
        with self._lock:
            last = {spec.word: spec for _, spec in self._columns if spec not in wanted}
            spared = {*wanted, *last.values()}
            self._columns = {key: c for key, c in self._columns.items() if key[0] == areas and key[1] in spared}


@dataclass(frozen=True)
class PredictionQuestion(ByDistance):
    """The misfit of each vertex to a point of another surface, from pairs of points here and there.

    `other` is that surface, None if there is none, and `at` the point, None if none is to be predicted.
    """

    mesh: MeshFile
    areas: str
    spec: Spec
    other: MeshFile | None
    pairs: tuple[tuple[Source | None, Source | None], ...]
    at: Source | None

    @property
    def about(self) -> Hashable:
        """The values that the answer depends on, except where the points are."""
        return (self.mesh, self.areas, self.spec, self.other, self.at is None, "prediction")

    @property
    def others(self) -> tuple[MeshFile, ...]:
        return () if self.other is None else (self.other,)

    def __str__(self) -> str:
        return f"{PREDICTION}{self.spec}"

    def answer(
        self, loaded: LoadedMesh, progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        """Return the misfit of every vertex to the point; neither field nor failure where none waits, or no pair is
        known."""
        other = loaded.shown_with(self.other)
        if self.other is None or other is None:
            return Answer(label=str(self), failure=NO_OTHER)
        if self.at is None or not self.pairs:
            return Answer(label=str(self), unit=MISFIT, error_estimate=ErrorEstimate())
        try:
            pairs = [(there, here) for here, there in self.pairs]
            known = correspondence(self.areas, self.spec, pairs, other, loaded, progress)
            field = known.misfit(vertex_at(self.at, other.surface))
        except (Cancelled, VertexError):
            raise
        except (BihdistError, MemoryError) as error:
            return failed(str(self), error)
        field.flags.writeable = False
        label = f"prediction by {known.distance_n.label}"
        if np.isnan(field).all():
            return Answer(label=label, failure="The point and those of the pairs are on different components.")
        best, share = candidate_of(field)
        sentence = f"the best is vertex {best}, misfit {field[best]:.4g}, {100 * share:.1f} % of the largest"
        return Answer(label=label, unit=MISFIT, field=field, error_estimate=ErrorEstimate(), remark=sentence)

    def is_at_hand(self, loaded: LoadedMesh) -> bool:
        """Return whether the distances from all points of the pairs are known, or none are needed."""
        other = loaded.shown_with(self.other)
        if other is None or self.at is None:
            return True
        sides = loaded.distances(self.areas), other.distances(self.areas)
        if not all(side.is_ready(self.spec) for side in sides):
            return False
        spec = same_on(self.spec, sides)
        for side, each in enumerate((loaded, other)):
            known = each.memory(KnownColumns).of(self.areas, spec)
            if any(vertex_at(pair[side], each.surface) not in known for pair in self.pairs):
                return False
        return True


@question_of.register
def _(shows: Prediction, document: Document, surface: str) -> PredictionQuestion:
    there, waiting = other_side(document, surface), waiting_point(document)
    other = None if there is None else document.mesh(there)
    asked = PredictionQuestion(document.mesh(surface), document.areas, shows.spec, other, (), None)
    if there is None or waiting is None or waiting.surface != there or not whole_pairs(document):
        return asked  # what is plain is the same whatever pairs there are
    return replace(asked, pairs=pairs_on(document, surface, there), at=waiting.at)


def pairs_on(document: Document, surface: str, there: str) -> tuple[tuple[Source | None, Source | None], ...]:
    """Return the points of whole pairs on one surface and on the other."""
    on = [{document.point(name).surface: document.point(name).at for name in p.points} for p in whole_pairs(document)]
    return tuple((each[surface], each[there]) for each in on)


def correspondence(
    areas: str,
    spec: Spec,
    pairs: Sequence[tuple[Source | None, Source | None]],
    one: LoadedMesh,
    two: LoadedMesh,
    progress: Progress | None = None,
) -> Correspondence:
    """Return the correspondence of two surfaces by pairs of points; known columns are used again.

    Raises the errors of distances and vertices.
    """
    spec = same_on(spec, (one.distances(areas), two.distances(areas)), part(progress, 0.0, 0.5))
    on_one = one.distances(areas).get(spec, part(progress, 0.0, 0.3))
    on_two = two.distances(areas).get(spec, part(progress, 0.3, 0.6))
    places = [(vertex_at(a, one.surface), vertex_at(b, two.surface)) for a, b in pairs]
    columns = one.memory(KnownColumns).of(areas, spec), two.memory(KnownColumns).of(areas, spec)
    found = Correspondence(on_one, on_two, places, None, part(progress, 0.6, 1.0), columns)
    for side, loaded in enumerate((one, two)):
        loaded.memory(KnownColumns).put(areas, spec, columns[side], {place[side] for place in places})
    return found


def candidate_of(field: FloatArray) -> tuple[int, float]:
    """Return the vertex with the least misfit (n,), and that misfit as a fraction of the largest; not all may be
    NaN."""
    best, most = int(np.nanargmin(field)), float(np.nanmax(field))
    return best, float(field[best]) / most if most > 0 else 0.0


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


NO_PAIRS = "There are no pairs yet to make a map from."
"""The message of a panel that shows a map before there is a pair."""


@dataclass(frozen=True)
class PositionQuestion(Question):
    """The colours of a surface by position."""

    mesh: MeshFile
    areas: str

    def __str__(self) -> str:
        return str(MapColours())

    def answer(
        self, loaded: LoadedMesh, progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        colours = position_colours(loaded.surface)
        colours.flags.writeable = False
        return Answer(label=str(self), colours=colours, error_estimate=ErrorEstimate())


@dataclass(frozen=True)
class MapQuestion(Question):
    """The map to another surface, in a file or made by pairs of points here and there.

    `other` is that surface, None if there is none.
    """

    mesh: MeshFile
    areas: str
    by: Spec | MapFile
    other: MeshFile | None
    pairs: tuple[tuple[Source | None, Source | None], ...]

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (self.by,) if isinstance(self.by, Spec) else ()

    def with_specs(self, specs: tuple[Spec, ...]) -> "MapQuestion":
        return replace(self, by=specs[0]) if specs else self

    @property
    def about(self) -> Hashable:
        """The values that the answer depends on, except the pairs."""
        return (self.mesh, self.areas, self.by, self.other, "map")

    @property
    def others(self) -> tuple[MeshFile, ...]:
        return () if self.other is None else (self.other,)

    def __str__(self) -> str:
        return str(MapColours(self.by.path if isinstance(self.by, MapFile) else self.by))

    def answer(
        self, loaded: LoadedMesh, progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        """Return each vertex in the colour of the one that it is mapped to."""
        other = loaded.shown_with(self.other)
        if other is None:
            return Answer(label=str(self), failure=NO_OTHER)
        try:
            if isinstance(self.by, MapFile):
                found, label = map_in(self.by, loaded.surface, other.surface), f"map {self.by.name}"
            elif not self.pairs:
                return Answer(label=str(self), failure=NO_PAIRS)
            else:
                known = correspondence(self.areas, self.by, self.pairs, loaded, other, part(progress, 0, 0.5))
                found, label = known.map(progress=part(progress, 0.5, 1)), f"map by {known.distance_m.label}"
            colours = carried_back(position_colours(other.surface), found)
        except (Cancelled, VertexError):
            raise
        except (BihdistError, MemoryError) as error:
            return failed(str(self), error)
        found.flags.writeable = colours.flags.writeable = False
        remark = _reached_in_words(found, other.surface)
        return Answer(label=label, colours=colours, leads_to=found, error_estimate=ErrorEstimate(), remark=remark)


@question_of.register
def _(shows: MapColours, document: Document, surface: str) -> PositionQuestion | MapQuestion:
    mesh, areas, there = document.mesh(surface), document.areas, other_side(document, surface)
    if not shows.by:
        return PositionQuestion(mesh, areas)
    other = None if there is None else document.mesh(there)
    if isinstance(shows.by, str):
        return MapQuestion(mesh, areas, document[Maps].of(shows.by), other, ())
    return MapQuestion(mesh, areas, shows.by, other, () if there is None else pairs_on(document, surface, there))


def _reached_in_words(found: IntArray, onto: Surface) -> str:
    """Return a sentence on the vertices of the other surface that are reached, and on those mapped nowhere."""
    reached, count = len(np.unique(found[found != NOWHERE])), len(onto.vertices)
    sentence = f"{reached:,} of {count:,} vertices of {onto.name} are reached"
    lost = int((found == NOWHERE).sum())
    return f"{sentence}, {lost:,} are mapped nowhere (grey)" if lost else sentence


def colours_words(answer: Answer | None) -> tuple[str, ...]:
    """Return the meaning of an answer's colours, in more and in fewer words; () for an answer without colours."""
    if answer is None or answer.colours is None or answer.labels is not None:
        return ()
    if answer.leads_to is None:
        return "red, green and blue from x, y and z", "coloured by position", ""
    reached = len(np.unique(answer.leads_to[answer.leads_to != NOWHERE]))
    return answer.remark, f"{reached:,} vertices are reached", ""
