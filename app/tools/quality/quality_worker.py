"""The quality of what panels show, measured in the background: what is cheap first, each once.

Distances have all measures. A field from Python has those of a distance, if it seems to be one, except triangles; it
and a difference have extrema and kinks in any case.

`ask` and `found` are called on the view's thread. There are two workers: triangles take as long as dozens of fields,
and are the same wherever a distance starts. They come for some points first, then for more.
"""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from bihdist_core.analysis.diagnostics import TriangleSample
from bihdist_core.analysis.persistence import OtherExtrema, other_extrema
from bihdist_core.analysis.quality import FieldQuality, difference_quality, field_quality
from bihdist_core.analysis.triangle_samples import TRIANGLE_POINTS, triangle_samples
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer, failure_in_words
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import BihdistError, Cancelled
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source
from bihdist_core.surface import Surface

from ...session.latest_request_worker import LatestRequestWorker
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import DistanceQuestion, Question, vertex_at

GEODESIC = Spec.of("geodesic")

MAX_REMEMBERED = 256
"""The number of answers whose quality is remembered."""

ONE_SOURCE = "A field from Python is known from one source only; triangles need distances from many points."
NO_DISTANCE = "Triangles are measured for distances only, not for differences."


@dataclass(frozen=True, eq=False)
class KnownQuality:
    """The quality of an answer as far as it is known, None for what is not.

    `extrema` are those away from the source, `whole` has circles and kinks; `triangles` are of the distance from so
    many `points`, with more to come unless `is_sampled`. `failure` and `triangles_failure` say why there is no more.
    """

    extrema: OtherExtrema | None = None
    whole: FieldQuality | None = None
    triangles: TriangleSample | None = None
    points: int = 0
    is_sampled: bool = False
    failure: str = ""
    triangles_failure: str = ""

    @property
    def is_whole(self) -> bool:
        """Return whether the measures of the whole field are known, or have failed."""
        return self.whole is not None or bool(self.failure)

    @property
    def is_complete(self) -> bool:
        """Return whether all measures are known, or have failed."""
        return self.is_whole and (self.is_sampled or bool(self.triangles_failure))


@dataclass(frozen=True, eq=False)
class _FieldRequest:
    """A question's surface and field (n,)."""

    question: Question
    loaded: LoadedMesh
    field: FloatArray
    only_extrema: bool

    @property
    def surface(self) -> Surface:
        return self.loaded.surface


_Request = Mapping[Question, _FieldRequest]
_Distances = Mapping[Question, LoadedMesh]


class QualityWorker:
    """Measures the quality of answers; `told()` is called on the view's thread whenever more is known."""

    def __init__(self, post: Callable[[Callable[[], None]], None], told: Callable[[], None]) -> None:
        self._post, self._told = post, told
        self._found: OrderedDict[Question, KnownQuality] = OrderedDict()
        # Triangles of a distance are those of a component; of which, is found out on the lane.
        self._samples: OrderedDict[tuple[Hashable, int], KnownQuality] = OrderedDict()
        self._components: OrderedDict[Hashable, int] = OrderedDict()
        self._near: tuple[DistanceQuestion, FloatArray] | None = None
        self._lock = threading.Lock()
        # Empty cells of the table show what is missing, and errors are told where they happen.
        self._fields: LatestRequestWorker[_Request] = LatestRequestWorker("quality", self._measure)
        self._triangles: LatestRequestWorker[_Distances] = LatestRequestWorker("triangles", self._sample)

    def ask(
        self,
        asked: Mapping[Question, tuple[LoadedMesh, Answer]],
        only_extrema: bool = False,
        on_its_way: Mapping[Question, LoadedMesh] | None = None,
    ) -> None:
        """Check these answers, and no others; with `only_extrema` find nothing but their extrema.

        The triangles go on for `on_its_way`, the questions that have no answer yet.
        """
        request = {
            question: _FieldRequest(question, loaded, answer.field, only_extrema)
            for question, (loaded, answer) in asked.items()
            if answer.field is not None
        }
        self._fields.submit(request or None)
        distances = {question: each.loaded for question, each in request.items()} | dict(on_its_way or {})
        self._triangles.submit(None if only_extrema else distances or None)

    def found(self, question: Question) -> KnownQuality:
        """Return the quality of an answer, as far as it is known."""
        with self._lock:
            found = self._found.get(question, KnownQuality())
            # Of a question that is new, those that the distance was last asked for.
            component = self._components.get(question, self._components.get(question.about, 0))
            sample = self._samples.get((question.about, component), KnownQuality())
        if not question.is_distance:
            reason = ONE_SOURCE if question.is_own_field else NO_DISTANCE
            return replace(found, triangles_failure=reason)
        return replace(
            found,
            triangles=sample.triangles,
            points=sample.points,
            is_sampled=sample.is_sampled,
            triangles_failure=sample.triangles_failure,
        )

    def close(self) -> None:
        """Stop, and wait until the work has ended."""
        for worker in (self._fields, self._triangles):
            worker.end()
        for worker in (self._fields, self._triangles):
            worker.close()

    # ------------------------------------------------------------------ on the lanes
    def _measure(self, request: _Request, worker: LatestRequestWorker[_Request]) -> None:
        for stage in (self._find_extrema, self._find_whole):
            for each in request.values():
                stage(each, request, worker.progress(partial(_has_question, each.question)))

    def _find_extrema(self, each: _FieldRequest, request: _Request, progress: Progress) -> None:
        found = self.found(each.question)
        if found.extrema is not None or found.failure:
            return
        progress(0.0, "extrema")
        try:
            found = KnownQuality(other_extrema(each.surface, each.field, each.question.start(each.field, each.surface)))
        except Exception as error:
            found = KnownQuality(failure=failure_in_words(error))
        self._answer(each.question, found)

    def _find_whole(self, each: _FieldRequest, request: _Request, progress: Progress) -> None:
        found = self.found(each.question)
        if found.is_whole or each.only_extrema:
            return
        progress(0.0, "circles and kinks")
        surface = each.surface
        try:
            source = each.question.start(each.field, surface)
            near = None if source is None else self._nearness(each, source, request, progress)
            if len(each.question.parts) > 1 or source is None or near is None:
                whole = difference_quality(surface, each.field, near, source)
            else:
                whole = field_quality(surface, each.field, near, source)
            found = replace(found, whole=whole)
        except Cancelled:
            raise
        except Exception as error:
            found = replace(found, failure=failure_in_words(error))
        self._answer(each.question, found)

    def _nearness(self, each: _FieldRequest, source: Source, request: _Request, progress: Progress) -> FloatArray:
        """Return geodesic distances (n,) from a source; BihdistError if there are none."""
        asked = DistanceQuestion(each.question.mesh, each.question.areas, GEODESIC, source)
        if asked in request:
            return request[asked].field
        if self._near is None or self._near[0] != asked:
            distance = each.loaded.distances(asked.areas).get(GEODESIC, progress)
            self._near = (asked, distance.from_source(source, progress))
        return self._near[1]

    def _sample(self, request: _Distances, worker: LatestRequestWorker[_Distances]) -> None:
        distances = [question for question in request if isinstance(question, DistanceQuestion)]
        # Exact geodesic distances are slow.
        for question in sorted(distances, key=lambda question: question.spec.word == "geodesic"):
            surface = request[question].surface
            try:
                component = int(surface.component_of_vertex[vertex_at(question.at, surface)])
            except BihdistError:
                continue  # its answer says so
            self._note(question, component)
            if not self.found(question).is_sampled:
                progress = worker.progress(partial(_is_asked_about, question.about))
                self._sample_one(question, component, request[question], progress)

    def _note(self, question: DistanceQuestion, component: int) -> None:
        with self._lock:
            before = self._components.get(question.about, component)
            for key in (question, question.about):
                _remember(self._components, key, component)
        if component != before:
            self._post(self._told)

    def _sample_one(self, question: DistanceQuestion, component: int, loaded: LoadedMesh, wanted: Progress) -> None:
        wanted(0.0, "triangles")
        key = (question.about, component)
        last = min(TRIANGLE_POINTS, int((loaded.surface.component_of_vertex == component).sum()))
        try:
            distance = loaded.distances(question.areas).get(question.spec, wanted)
            for points, sample in triangle_samples(distance, component=component, progress=wanted):
                wanted(0.0, "triangles")
                self._learn(key, KnownQuality(triangles=sample, points=points, is_sampled=points == last))
        except Cancelled:
            raise
        except Exception as error:
            self._learn(key, KnownQuality(is_sampled=True, triangles_failure=failure_in_words(error)))

    def _learn(self, key: tuple[Hashable, int], sample: KnownQuality) -> None:
        with self._lock:
            _remember(self._samples, key, sample)
        self._post(self._told)

    def _answer(self, question: Question, found: KnownQuality) -> None:
        with self._lock:
            _remember(self._found, question, found)
        self._post(self._told)


def _remember(known: OrderedDict[Any, Any], key: Hashable, value: object) -> None:
    """Remember a value as the latest, and forget the oldest of too many."""
    known[key] = value
    known.move_to_end(key)
    while len(known) > MAX_REMEMBERED:
        known.popitem(last=False)


def _has_question(question: Question, latest: _Request) -> bool:
    return question in latest


def _is_asked_about(about: Hashable, latest: _Distances) -> bool:
    return any(question.about == about for question in latest)
