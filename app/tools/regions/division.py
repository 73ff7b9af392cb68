"""The regions of the pins by panels' distances, divided in the background; fields are kept, so that a pin that is moved
costs one.

`ask` and `divided` are called on the view's thread.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from functools import partial
from weakref import WeakKeyDictionary

import numpy as np

from bihdist_core.analysis.region_boundaries import Boundary, region_boundaries
from bihdist_core.analysis.regions import Regions, voronoi_regions
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import Cancelled
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source

from ...document.document import Document, MeshFile
from ...document.shared_parts.pins import Pins
from ...session.latest_request_worker import LatestRequestWorker
from ...session.loaded_mesh import LoadedMesh
from .part import DividedPanels

MAX_KEPT_BYTES = 512_000_000
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
        """The values that the answer depends on, except the pins."""
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
    """Return the questions of the panels that show the regions of the pins, by panel."""
    found = {}
    for panel in document.panels:
        places = tuple(at for at in pinned(document, panel.surface) if at is not None)
        if panel.id in document[DividedPanels].regions and places and panel.shows.is_distance:
            mesh = document.mesh(panel.surface)
            found[panel.id] = RegionsQuestion(mesh, document.areas, panel.shows.specs[0], places)
    return found


def regions_of(question: RegionsQuestion, loaded: LoadedMesh) -> Regions:
    """Return the regions, computed if necessary; the last of each distance is kept for each surface.

    Raises BihdistError if there are none.
    """
    kept = _last.setdefault(loaded, {})
    known = kept.get(question.about)
    if known is None or known[0] != question:
        distance = loaded.distances(question.areas).get(question.spec)
        known = question, voronoi_regions(loaded.surface, distance.from_sources(list(question.places)))
        kept[question.about] = known
    return known[1]


_last: WeakKeyDictionary[LoadedMesh, dict[Hashable, tuple[RegionsQuestion, Regions]]] = WeakKeyDictionary()


def pinned(document: Document, surface: str) -> list[Source | None]:
    """Return the places of the pins of a surface, in their order."""
    points = [document.point(pin.point) for pin in document[Pins].pins]
    return [point.at for point in points if point.surface == surface]


_Request = Mapping[int, tuple[RegionsQuestion, LoadedMesh]]


class Dividing:
    """Divides surfaces among pins in the background; `told(panel)` is called on the view's thread when regions
    change."""

    def __init__(self, post: Callable[[Callable[[], None]], None], told: Callable[[int], None]) -> None:
        self._post, self._told = post, told
        self._asked: dict[int, RegionsQuestion] = {}
        self._divided: dict[int, Divided] = {}
        self._fields: OrderedDict[Hashable, FloatArray] = OrderedDict()
        self._worker: LatestRequestWorker[_Request] = LatestRequestWorker("regions", self._divide)

    def ask(self, asked: Mapping[int, tuple[RegionsQuestion, LoadedMesh]]) -> None:
        """Ask for the regions of these panels only."""
        before, self._asked = self._asked, {id: question for id, (question, _) in asked.items()}
        for id in [id for id in self._divided if not self._is_about(id, self._divided[id].question)]:
            del self._divided[id]
            self._told(id)
        if self._asked != before:
            self._worker.submit(dict(asked) or None)

    def divided(self, panel: int) -> Divided | None:
        """Return the regions of a panel: the answer to its question, or to the one before while that is on its way."""
        return self._divided.get(panel)

    def is_answered(self, panel: int) -> bool:
        """Return whether a panel's regions answer its present question."""
        known = self._divided.get(panel)
        return known is not None and known.question == self._asked.get(panel)

    @property
    def is_complete(self) -> bool:
        """Return whether the regions of all panels are known."""
        return all(self.is_answered(panel) for panel in self._asked)

    def close(self) -> None:
        """Stop, and wait until the work has ended."""
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
                progress = worker.progress(partial(_is_asked_about, question.about))
                known[question] = self._answer(question, loaded, progress)
            self._post(partial(self._arrived, id, known[question]))

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
        """Return the fields (n, k) from the places."""
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
        most = max(len(keys), MAX_KEPT_BYTES // columns[:, 0].nbytes)
        while len(self._fields) > most:
            self._fields.popitem(last=False)
        return columns

    def _arrived(self, panel: int, divided: Divided) -> None:
        if self._is_about(panel, divided.question):
            self._divided[panel] = divided
            self._told(panel)


def _is_asked_about(about: Hashable, latest: _Request) -> bool:
    return any(question.about == about for question, _ in latest.values())
