"""The prediction of where a point of one surface is on another, from the pairs of a document."""

import threading
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core import BihdistError, Cancelled, Correspondence, VertexError
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, failed, same_on
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...document.document import Document, MeshFile
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import ByDistance, question_of, vertex_at
from .pairs import other_side, waiting_point, whole_pairs
from .quantity import PREDICTION, Prediction

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
