"""The quality of what panels show, found out in the background: what is cheap first, each once.

`ask` and `found` are called on the view's thread.  There are two lanes: triangles take as long as dozens of fields, and
say the same of a distance wherever it starts.
"""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core.analysis.diagnostics import TriangleSample
from bihdist_core.analysis.quality import FieldQuality, OtherExtrema, field_quality, other_extrema, triangle_sample
from bihdist_core.distances.answers import Answer, failure_in_words
from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import Cancelled
from bihdist_core.progress import Progress

from .lane import Lane
from .opened import Opened
from .questions import DistanceQuestion, source_at, vertex_at

GEODESIC = Spec.of("geodesic")

KEPT = 256
"""Of so many answers it is remembered what was found."""


@dataclass(frozen=True, eq=False)
class Found:
    """What is known of an answer so far, None for what is not.

    extrema: those away from the source; whole: with circles and kinks; triangles: of the distance, from anywhere.
    failure, triangles_failure: why there is no more.
    """

    extrema: OtherExtrema | None = None
    whole: FieldQuality | None = None
    triangles: TriangleSample | None = None
    failure: str = ""
    triangles_failure: str = ""

    @property
    def is_whole(self) -> bool:
        return self.whole is not None or bool(self.failure)

    @property
    def is_complete(self) -> bool:
        return self.is_whole and (self.triangles is not None or bool(self.triangles_failure))


@dataclass(frozen=True, eq=False)
class _Judgeable:
    """A question's surface and field (n,)."""

    question: DistanceQuestion
    opened: Opened
    field: np.ndarray


_Request = Mapping[DistanceQuestion, _Judgeable]


class Quality:
    """See the module.  `told()` is called on the view's thread whenever more is known."""

    def __init__(self, post: Callable[[Callable[[], None]], None], told: Callable[[], None]) -> None:
        self._post, self._told = post, told
        self._found: OrderedDict[DistanceQuestion, Found] = OrderedDict()
        self._triangles: dict[Hashable, TriangleSample | str] = {}
        self._near: tuple[DistanceQuestion, np.ndarray] | None = None
        self._lock = threading.Lock()
        self._fields: Lane[_Request] = Lane("quality", self._judge, _silent, _unheard)
        self._samples: Lane[_Request] = Lane("triangles", self._sample, _silent, _unheard)

    def ask(self, asked: Mapping[DistanceQuestion, tuple[Opened, Answer]]) -> None:
        """Find out about these answers, and about no others."""
        request = {
            question: _Judgeable(question, opened, answer.field)
            for question, (opened, answer) in asked.items()
            if answer.field is not None
        }
        for lane in (self._fields, self._samples):
            lane.submit(request or None)

    def found(self, question: DistanceQuestion) -> Found:
        """What is known of an answer."""
        with self._lock:
            found = self._found.get(question, Found())
            triangles = self._triangles.get(question.about)
        if isinstance(triangles, str):
            return replace(found, triangles_failure=triangles)
        return replace(found, triangles=triangles)

    def close(self) -> None:
        """Stop, and wait for it."""
        for lane in (self._fields, self._samples):
            lane.end()
        for lane in (self._fields, self._samples):
            lane.close()

    # ------------------------------------------------------------------ on the lanes
    def _judge(self, request: _Request, lane: Lane[_Request]) -> None:
        for stage in (self._find_extrema, self._find_whole):
            for each in request.values():
                stage(each, request, _wanted(lane, each.question))

    def _find_extrema(self, each: _Judgeable, request: _Request, progress: Progress) -> None:
        found = self.found(each.question)
        if found.extrema is not None or found.failure:
            return
        progress(0.0, "extrema")
        surface = each.opened.surface
        try:
            found = Found(other_extrema(surface, each.field, source_at(each.question.at, surface)))
        except Exception as error:
            found = Found(failure=failure_in_words(error))
        self._remember(each.question, found)

    def _find_whole(self, each: _Judgeable, request: _Request, progress: Progress) -> None:
        found = self.found(each.question)
        if found.is_whole:
            return
        progress(0.0, "circles and kinks")
        surface = each.opened.surface
        try:
            near = self._nearness(each, request, progress)
            whole = field_quality(surface, each.field, near, source_at(each.question.at, surface))
            found = replace(found, whole=whole)
        except Cancelled:
            raise
        except Exception as error:
            found = replace(found, failure=failure_in_words(error))
        self._remember(each.question, found)

    def _nearness(self, each: _Judgeable, request: _Request, progress: Progress) -> np.ndarray:
        """(n,) geodesic distances from the same source; BihdistError where there are none."""
        asked = replace(each.question, spec=GEODESIC)
        if asked in request:
            return request[asked].field
        if self._near is None or self._near[0] != asked:
            distance = each.opened.distances(asked.areas).get(GEODESIC, progress)
            self._near = (asked, distance.from_source(source_at(asked.at, each.opened.surface), progress))
        return self._near[1]

    def _sample(self, request: _Request, lane: Lane[_Request]) -> None:
        # Exact geodesic distances are slow.
        for each in sorted(request.values(), key=lambda each: each.question.spec.word == "geodesic"):
            about = each.question.about
            if about in self._triangles:
                continue
            wanted = _wanted_about(lane, about)
            wanted(0.0, "triangles")
            surface = each.opened.surface
            component = int(surface.component_of_vertex[vertex_at(each.question.at, surface)])
            sampled: TriangleSample | str
            try:
                distance = each.opened.distances(each.question.areas).get(each.question.spec, wanted)
                sampled = triangle_sample(distance, component=component, progress=wanted)
            except Cancelled:
                raise
            except Exception as error:
                sampled = failure_in_words(error)
            with self._lock:
                self._triangles[about] = sampled
            self._post(self._told)

    def _remember(self, question: DistanceQuestion, found: Found) -> None:
        with self._lock:
            self._found[question] = found
            while len(self._found) > KEPT:
                self._found.popitem(last=False)
        self._post(self._told)


def _wanted(lane: Lane[_Request], question: DistanceQuestion) -> Progress:
    """Work on a question goes on as long as it is among those asked last."""
    return lane.progress(lambda latest: question in latest)


def _wanted_about(lane: Lane[_Request], about: Hashable) -> Progress:
    return lane.progress(lambda latest: any(question.about == about for question in latest))


def _silent(fraction: float | None, text: str) -> None:
    """What is not known yet is told by the table's empty cells."""


def _unheard(request: _Request, error: Exception) -> None:
    """What goes wrong is caught where it does, and told."""
