"""The place where the point without a partner belongs, and how far the candidates are from it."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore

from bihdist_core.progress import Progress

from ...document.document import Document
from ...qt.context import Context
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import vertex_at
from .answers import candidate_in
from .map_errors import KeptGeodesics, right_places
from .maps import Maps, Truth
from .pairs import other_side, waiting_point
from .quantity import predicts_in


@dataclass(frozen=True, eq=False)
class CandidateErrorRequest:
    """Candidates for a vertex of one of two surfaces, by the ids of panels, and the truth that says where it
    belongs."""

    one: LoadedMesh
    two: LoadedMesh
    areas: str
    truth: Truth
    vertex: int
    is_on_first: bool
    candidates: tuple[tuple[int, int], ...]

    @property
    def about(self) -> tuple[object, ...]:
        """The values that the answer depends on, except the candidates."""
        return id(self.one.surface), id(self.two.surface), self.areas, self.truth, self.vertex, self.is_on_first

    @property
    def there(self) -> LoadedMesh:
        """The surface of the candidates."""
        return self.two if self.is_on_first else self.one


@dataclass(frozen=True, eq=False)
class CandidateErrors:
    """The right vertex and, if it counts, its symmetric partner; and errors over the root of the area, by the ids of
    panels.

    There are no errors as long as they are not known.
    """

    places: tuple[int, ...]
    errors: dict[int, float]


def candidate_request(
    document: Document, one: LoadedMesh, two: LoadedMesh, candidates: dict[int, int]
) -> CandidateErrorRequest | None:
    """Return the request for these candidates, None if no point is without a partner."""
    point = waiting_point(document)
    if point is None or other_side(document, point.surface) is None:
        return None
    is_on_first = point.surface == document.surfaces[0].name
    vertex = vertex_at(point.at, (one if is_on_first else two).surface)
    found = tuple(sorted(candidates.items()))
    return CandidateErrorRequest(one, two, document.areas, document[Maps].truth, vertex, is_on_first, found)


class CandidateErrorWorker:
    """Finds errors of candidates, on one thread; distances are kept as long as the surface stays."""

    def __init__(self) -> None:
        self._kept: KeptGeodesics | None = None

    def errors(self, asked: CandidateErrorRequest, progress: Progress | None = None) -> Iterator[CandidateErrors]:
        """Yield the right places, then the errors of the candidates as well.

        Raises ParameterError for a truth that does not fit the surfaces.
        """
        one, two, there = asked.one.surface, asked.two.surface, asked.there.surface
        places = tuple(right_places(asked.truth, one, two, asked.vertex, asked.is_on_first))
        yield CandidateErrors(places, {})
        if not places or not asked.candidates:
            return
        laplacian = asked.there.distances(asked.areas).laplacian
        if self._kept is None or self._kept.surface is not laplacian.surface:
            self._kept = KeptGeodesics(laplacian, asked.truth.samples or len(one.vertices))
        kept = self._kept
        kept.find(places, progress)
        unit = float(np.sqrt(there.face_areas.sum()))
        nearest = kept.from_sources(np.array(places)).min(axis=1)
        yield CandidateErrors(places, {panel: float(nearest[vertex]) / unit for panel, vertex in asked.candidates})


class CandidateFindings(QtCore.QObject):
    """The errors that are shown at the candidates; `found` is None where there are none."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.found: CandidateErrors | None = None
        self._asked: CandidateErrorRequest | None = None
        self._background = context.background("candidate errors", CandidateErrorWorker().errors, self._take)
        context.document_changed.connect(self.document_changed)
        context.answer_changed.connect(self.document_changed)
        context.panels_cleared.connect(self._show)

    # ------------------------------------------------------------------ what is told
    def document_changed(self, _: object = None) -> None:
        """Ask for the errors of the candidates that are shown now."""
        asked, before = self._wanted(), self._asked
        if asked is None and before is None:
            return
        if asked is not None and before is not None and asked.about == before.about:
            if asked.candidates == before.candidates:
                return
            # The place stays; how far others are from there has still to be found.
            self.found = None if self.found is None else CandidateErrors(self.found.places, {})
        else:
            self.found = None
        self._asked = asked
        self._background.ask(asked)
        self._show()

    # ------------------------------------------------------------------ asking
    def _wanted(self) -> CandidateErrorRequest | None:
        session = self._context.session
        document = session.document
        if not any(map(predicts_in, document.panels)):
            return None
        loaded = [session.loaded(mesh.name) for mesh in document.surfaces[:2]]
        first, second = [*loaded, None, None][:2]
        if first is None or second is None:
            return None
        candidates = {}
        for panel in document.panels:
            found = candidate_in(document, panel, session.answer(panel.id))
            if found is not None and session.is_answered(panel.id):
                candidates[panel.id] = found.vertex
        return candidate_request(document, first, second, candidates)

    def _take(self, asked: CandidateErrorRequest, found: CandidateErrors) -> None:
        before = self.found
        if found.errors or before is None or before.places != found.places:
            self.found = found
            self._show()

    def _show(self) -> None:
        document, found = self._context.document, self.found
        there = {panel.id: panel for panel in document.panels}
        for panel in self._context.grid.panels:
            shown = there.get(panel.id)
            is_here = shown is not None and shown.surface == self._surface_name() and predicts_in(shown)
            self._context.grid.marks.show_found(panel.id, CandidateErrors, found if is_here else None)

    def _surface_name(self) -> str:
        """Return the name of the surface of the candidates."""
        document, asked = self._context.document, self._asked
        if asked is None or len(document.surfaces) < 2:
            return ""
        return document.surfaces[1 if asked.is_on_first else 0].name
