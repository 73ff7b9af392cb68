"""Farthest points of a surface, found in the background."""

from collections.abc import Callable
from dataclasses import dataclass

from bihdist_core.analysis.sampling import farthest_points, starts_of
from bihdist_core.arrays import IntArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import Cancelled
from bihdist_core.progress import part
from bihdist_core.sources.source import Source

from ..document.document import MeshFile
from .latest_request_worker import LatestRequestWorker
from .loaded_mesh import LoadedMesh


@dataclass(frozen=True)
class SamplesQuestion:
    """So many vertices from a source, each the farthest from those before it by a distance."""

    mesh: MeshFile
    areas: str
    spec: Spec
    at: Source
    count: int


@dataclass(frozen=True, eq=False)
class Sampled:
    """The answer (k,), or why there is none."""

    question: SamplesQuestion
    vertices: IntArray | None = None
    failure: str = ""


class Sampling:
    """Both functions are called on the view's thread: `told` with the answer to what was asked last, and `going` with a
    share done and a text, or None when nothing goes on."""

    def __init__(
        self,
        post: Callable[[Callable[[], None]], None],
        told: Callable[[Sampled], None],
        going: Callable[[float | None, str], None],
    ) -> None:
        self._post, self._told, self._going = post, told, going
        self._asked: SamplesQuestion | None = None
        self._worker: LatestRequestWorker[tuple[SamplesQuestion, LoadedMesh]] | None = None

    def ask(self, question: SamplesQuestion, loaded: LoadedMesh) -> None:
        """Look for samples beside the window's thread, in place of those asked for before."""
        self._asked = question
        if self._worker is None:
            self._worker = LatestRequestWorker("samples", self._sample, self._report, lambda *_: None)
        self._worker.submit((question, loaded))

    def cancel(self) -> None:
        """Stop looking for samples."""
        self._asked = None
        if self._worker is not None:
            self._worker.submit(None)

    @property
    def is_going(self) -> bool:
        """Whether samples are being looked for."""
        return self._asked is not None

    def close(self) -> None:
        """Stop, and wait for it."""
        if self._worker is not None:
            self._worker.close()

    def _sample(
        self,
        request: tuple[SamplesQuestion, LoadedMesh],
        worker: LatestRequestWorker[tuple[SamplesQuestion, LoadedMesh]],
    ) -> None:
        question, loaded = request
        progress = worker.progress(lambda latest: latest is request)
        try:
            starts = starts_of(question.at, loaded.surface)
            distance = loaded.distances(question.areas).get(question.spec, part(progress, 0, 0.5))
            found = farthest_points(distance, starts, question.count, part(progress, 0.5, 1))
            sampled = Sampled(question, found)
        except Cancelled:
            raise
        except Exception as error:
            sampled = Sampled(question, failure=failure_in_words(error))
        self._post(lambda: self._arrived(sampled))

    def _arrived(self, sampled: Sampled) -> None:
        if sampled.question == self._asked:
            self._asked = None
            self._told(sampled)

    def _report(self, fraction: float | None, text: str) -> None:
        self._post(lambda: self._going(fraction, text))
