"""The regions of the pins by panels' distances, divided in the background; fields are kept, so that a pin that is moved
costs one.

`ask` and `divided` are called on the view's thread.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from bihdist_core.analysis.region_boundaries import Boundary, region_boundaries
from bihdist_core.analysis.regions import Regions, voronoi_regions
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import Cancelled
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ...document.document import Document, MeshFile
from ...document.shared_parts.pins import Pins
from ...session.latest_request_worker import LatestRequestWorker
from ...session.loaded_mesh import LoadedMesh
from .part import DividedPanels

MEMORY = 512_000_000
"""Bytes of pins' fields that are kept: 640 of 100,000 vertices."""


@dataclass(frozen=True)
class RegionsQuestion:
    """Which part of a surface is nearest to each of some places, by a distance; equal questions have equal answers."""

    mesh: MeshFile
    areas: str
    spec: Spec
    places: tuple[Source, ...]

    @property
    def about(self) -> Hashable:
        """All but from where."""
        return (self.mesh, self.areas, self.spec)


@dataclass(frozen=True, eq=False)
class Divided:
    """The answer: regions, in the order of the places, their boundaries, and the fields (n, k) that they are the
    regions of; or why there are none."""

    question: RegionsQuestion
    regions: Regions | None = None
    boundaries: tuple[Boundary, ...] = ()
    columns: FloatArray | None = None
    failure: str = ""


def regions_questions(document: Document) -> dict[int, RegionsQuestion]:
    """By panel, of those that show the regions of the pins on their surface."""
    found = {}
    for panel in document.panels:
        places = tuple(at for at in pinned(document, panel.surface) if at is not None)
        if panel.id in document[DividedPanels].regions and places and panel.shows.is_distance:
            mesh = document.mesh(panel.surface)
            found[panel.id] = RegionsQuestion(mesh, document.areas, panel.shows.specs[0], places)
    return found


def regions_of(question: RegionsQuestion, loaded: LoadedMesh) -> Regions:
    """The answer, waited for; of each surface, the last of each distance is kept.  BihdistError where there is none."""
    kept = _last.setdefault(loaded, {})
    known = kept.get(question.about)
    if known is None or known[0] != question:
        distance = loaded.distances(question.areas).get(question.spec)
        known = question, voronoi_regions(loaded.surface, distance.from_sources(list(question.places)))
        kept[question.about] = known
    return known[1]


_last: WeakKeyDictionary[LoadedMesh, dict[Hashable, tuple[RegionsQuestion, Regions]]] = WeakKeyDictionary()


def pinned(document: Document, surface: str) -> list[Source | None]:
    """Where the pins of a surface are, in their order."""
    points = [document.point(pin.point) for pin in document[Pins].pins]
    return [point.at for point in points if point.surface == surface]


_Request = Mapping[int, tuple[RegionsQuestion, LoadedMesh]]


class Dividing:
    """See the module.  `told(panel)` is called on the view's thread when there are other regions for it, or none."""

    def __init__(self, post: Callable[[Callable[[], None]], None], told: Callable[[int], None]) -> None:
        self._post, self._told = post, told
        self._asked: dict[int, RegionsQuestion] = {}
        self._divided: dict[int, Divided] = {}
        self._fields: OrderedDict[Hashable, FloatArray] = OrderedDict()
        self._worker: LatestRequestWorker[_Request] | None = None

    def ask(self, asked: Mapping[int, tuple[RegionsQuestion, LoadedMesh]]) -> None:
        """Of these panels, and no others."""
        before, self._asked = self._asked, {id: question for id, (question, _) in asked.items()}
        for id in [id for id in self._divided if not self._is_about(id, self._divided[id].question)]:
            del self._divided[id]
            self._told(id)
        if self._asked == before:
            return
        if self._worker is None and asked:
            self._worker = LatestRequestWorker("regions", self._divide, lambda *_: None, _unheard)
        if self._worker is not None:
            self._worker.submit(dict(asked) or None)

    def divided(self, panel: int) -> Divided | None:
        """What is shown of a panel: the answer to its question, or, while that is on its way, to the one before."""
        return self._divided.get(panel)

    def is_answered(self, panel: int) -> bool:
        """Whether that is the answer to its present question."""
        known = self._divided.get(panel)
        return known is not None and known.question == self._asked.get(panel)

    @property
    def is_complete(self) -> bool:
        """Whether the regions of all panels are known."""
        return all(self.is_answered(panel) for panel in self._asked)

    def close(self) -> None:
        """Stop, and wait for it."""
        if self._worker is not None:
            self._worker.close()

    def _is_about(self, panel: int, question: RegionsQuestion) -> bool:
        return panel in self._asked and self._asked[panel].about == question.about

    # ------------------------------------------------------------------ on the lane
    def _divide(self, request: _Request, worker: LatestRequestWorker[_Request]) -> None:
        # Panels with the same distance have the same regions.
        known: dict[RegionsQuestion, Divided] = {}
        for id, (question, loaded) in request.items():
            if question not in known:
                # A pin that is dragged is elsewhere before this is done; what is late is shown.
                known[question] = self._answer(question, loaded, _wanted(worker, question.about))
            self._deliver(id, known[question])

    def _answer(self, question: RegionsQuestion, loaded: LoadedMesh, progress: Progress) -> Divided:
        try:
            columns = self._columns(question, loaded, progress)
            regions = voronoi_regions(loaded.surface, columns)
            return Divided(question, regions, tuple(region_boundaries(loaded.surface, regions)), columns)
        except Cancelled:
            raise
        except Exception as error:
            return Divided(question, failure=failure_in_words(error))

    def _columns(self, question: RegionsQuestion, loaded: LoadedMesh, progress: Progress) -> FloatArray:
        """(n, k) the fields from the places."""
        keys = [(question.about, at) for at in question.places]
        missing = [at for key, at in zip(keys, question.places, strict=True) if key not in self._fields]
        if missing:
            progress(0.0, "regions")
            distance = loaded.distances(question.areas).get(question.spec, progress)
            fields = distance.from_sources(missing, progress)
            for at, field in zip(missing, fields.T, strict=True):
                self._fields[question.about, at] = np.ascontiguousarray(field)
        for key in keys:
            self._fields.move_to_end(key)
        columns = np.stack([self._fields[key] for key in keys], axis=1)
        most = max(len(keys), MEMORY // columns[:, 0].nbytes)
        while len(self._fields) > most:
            self._fields.popitem(last=False)
        return columns

    def _deliver(self, panel: int, divided: Divided) -> None:
        self._post(lambda: self._arrived(panel, divided))

    def _arrived(self, panel: int, divided: Divided) -> None:
        if self._is_about(panel, divided.question):
            self._divided[panel] = divided
            self._told(panel)


def _wanted(worker: LatestRequestWorker[_Request], about: Hashable) -> Progress:
    return worker.progress(lambda latest: any(question.about == about for question, _ in latest.values()))


def _unheard(request: _Request, error: Exception) -> None:
    """What goes wrong is caught where it does, and told."""
