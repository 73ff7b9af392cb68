"""Values at vertices, interpolated by a distance: the question, its answer, and what is used again for the next one."""

import threading
from collections.abc import Callable, Hashable
from dataclasses import dataclass

import numpy as np

from bihdist_core import BihdistError, Cancelled, ShepardInterpolant, Surface, VertexError
from bihdist_core.applications.weights import INVERSE_DISTANCES, Weights
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Answer, failed
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source, SourceSet

from ...document.document import Document, MeshFile
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import ByDistance, question_of, vertex_at
from .part import Anchors
from .quantity import Interpolant

NO_ANCHORS = "There is no anchor with a value: click the surface to set one."
"""The message of a panel of an interpolant without anchors."""

VALUE = "value"
"""The unit of what is interpolated, which is the user's own."""


class InterpolantMemory:
    """The last interpolant of a surface by each distance, for any thread.

    `columns` is the number of columns of distances from anchors solved for so far.
    """

    def __init__(self) -> None:
        self.columns = 0
        self._last: dict[tuple[str, Spec], ShepardInterpolant] = {}
        self._lock = threading.Lock()

    def last(self, areas: str, spec: Spec) -> ShepardInterpolant | None:
        """Return the last interpolant by a distance."""
        with self._lock:
            return self._last.get((areas, spec))

    def put(self, areas: str, spec: Spec, interpolant: ShepardInterpolant, solved: int) -> None:
        """Remember an interpolant, for which so many columns were solved for."""
        with self._lock:
            self._last[areas, spec] = interpolant
            self.columns += solved

    def keep(self, areas: str, wanted: set[Spec]) -> None:
        """Forget interpolants with other areas, and by other distances."""
        with self._lock:
            self._last = {key: i for key, i in self._last.items() if key[0] == areas and key[1] in wanted}


@dataclass(frozen=True)
class InterpolantQuestion(ByDistance):
    """Values at vertices, interpolated by a distance; or, if total, the sum of the weights."""

    mesh: MeshFile
    areas: str
    spec: Spec
    anchors: tuple[tuple[Source | None, float], ...]
    weights: Weights = INVERSE_DISTANCES
    total: bool = False

    @property
    def about(self) -> Hashable:
        """The values that the answer depends on, except the anchors."""
        return (self.mesh, self.areas, self.spec, self.total, "interpolant")

    def __str__(self) -> str:
        return str(Interpolant(self.spec, self.total))

    def answer(
        self, loaded: LoadedMesh, progress: Progress | None = None, at_once: Callable[[Answer], object] | None = None
    ) -> Answer:
        """Return the field; what is known of the last interpolant by this distance is used again."""
        if not self.anchors:
            return Answer(label=str(self), failure=NO_ANCHORS)
        memory = loaded.memory(InterpolantMemory)
        try:
            distance = loaded.distances(self.areas).get(self.spec, part(progress, 0, 0.8))
            vertices = [vertex_at(at, loaded.surface) for at, _ in self.anchors]
            values = [value for _, value in self.anchors]
            last = memory.last(self.areas, self.spec)
            if last is None or last.distance is not distance:
                last = ShepardInterpolant(distance, vertices, values)
            interpolant = last.changed(vertices, values, self.weights.exponent, self.weights.smoothness)
            new = len(interpolant.missing)
            found = interpolant.sum_of_weights if self.total else interpolant.evaluate
            field = found(part(progress, 0.8, 1))
        except (Cancelled, VertexError):
            raise
        except (BihdistError, MemoryError) as error:
            return failed(str(self), error)
        memory.put(self.areas, self.spec, interpolant, new)
        if self.total:
            # At the anchors themselves it is infinite.
            field = np.minimum(field, field[np.isfinite(field)].max(initial=0.0))
        field.flags.writeable = False
        is_signed = bool(np.nanmin(field, initial=0.0) < 0)
        label = f"{'weights' if self.total else 'interpolant'} by {distance.label}"
        unit = "powers of ten" if self.total else VALUE
        return Answer(label=label, unit=unit, field=field, error_estimate=ErrorEstimate(), is_signed=is_signed)

    def is_at_hand(self, loaded: LoadedMesh) -> bool:
        """Return whether the distances from all anchors are known."""
        last = loaded.memory(InterpolantMemory).last(self.areas, self.spec)
        if last is None:
            return False
        known = {*last.anchors.tolist()}.difference(last.missing)
        return all(vertex_at(at, loaded.surface) in known for at, _ in self.anchors)

    def start(self, field: FloatArray, surface: Surface) -> Source:
        """Return the anchors."""
        return SourceSet(tuple(vertex_at(at, surface) for at, _ in self.anchors))


@question_of.register
def _(shows: Interpolant, document: Document, surface: str) -> InterpolantQuestion:
    listed = document[Anchors]
    anchors = [(document.point(anchor.point), anchor) for anchor in listed.anchors if not anchor.left_out]
    known = tuple((p.at, a.value) for p, a in anchors if p.surface == surface and a.value is not None)
    return InterpolantQuestion(document.mesh(surface), document.areas, shows.spec, known, listed.weights, shows.total)
