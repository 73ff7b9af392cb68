"""Clicks, drags and keys on panels that predict: they place, accept, choose, move and remove the points of pairs."""

from contextlib import suppress

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError

from ...qt.context import Context
from ...qt.dragging import Dragging
from ...qt.gesture import Gesture
from ...qt.panels.events import Click
from ...scene.picking import Hit
from .answers import Candidate, candidate_in
from .candidate_errors import CandidateErrorRequest, CandidateErrors, CandidateErrorWorker, candidate_request
from .pairs import (
    Pair,
    Pairs,
    drop_half,
    half_pair,
    move_pair_point,
    place_point,
    remove_pairs,
    waiting_point,
    whole_pairs,
)
from .quantity import predicts_in


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


class PairGestures(Gesture):
    """Places and moves the points of pairs; its `errors` are those of the candidates."""

    tool, follows = "pairs", True
    chosen = QtCore.Signal(str)  # a point of the pair that stands out from now on, "" for none

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._grid = context.grid
        self.errors = CandidateFindings(context)
        self._grid.activated.connect(self.highlight_candidate)
        context.answer_changed.connect(self.highlight_candidate)
        self._is_dragging = False

    def is_on(self, panel: int) -> bool:
        """Return whether a panel predicts."""
        return predicts_in(self.document.panel(panel)) and len(self.document.surfaces) > 1

    # ------------------------------------------------------------------ points
    def click(self, panel: int, click: Click) -> None:
        self.put(panel, click.hit.vertex)

    def put(self, panel: int, vertex: int) -> None:
        """Place a point, or the partner of the point that has none yet.

        A pair that has a point there already is chosen instead.
        """
        document, surface = self.document, self.document.panel(panel).surface
        waiting = waiting_point(document)
        there = self._pair_at(surface, vertex)
        if there is not None and (waiting is None or waiting.surface == surface):
            self.choose(there.points[0])
            return
        with self.context.errors_shown():
            self.context.session.show(place_point(document, surface, vertex))
            self.choose("")

    def follow(self, panel: int, hit: Hit) -> None:
        """Move the point without a partner to the pointer, unless its partner is placed on this surface."""
        document, surface = self.document, self.document.panel(panel).surface
        waiting = waiting_point(document)
        if (waiting is None or waiting.surface == surface) and self._pair_at(surface, hit.vertex) is None:
            with suppress(ParameterError):  # there are too many, which a click says
                self.context.session.show(place_point(document, surface, hit.vertex), key="live", live=True)

    def _pair_at(self, surface: str, vertex: int) -> Pair | None:
        document = self.document
        for pair in whole_pairs(document):
            points = [document.point(name) for name in pair.points]
            if any((point.surface, point.at) == (surface, vertex) for point in points):
                return pair
        return None

    def candidate(self, may_be_late: bool = False) -> tuple[int, Candidate] | None:
        """Return the candidate of the active panel, or of the first that has one, with the panel's id.

        With `may_be_late` it may be that of where the point was, while it is dragged.
        """
        session, active = self.context.session, self._grid.active
        panels = sorted(self.document.panels, key=lambda panel: panel.id != active)
        for panel in panels:
            found = candidate_in(self.document, panel, session.answer(panel.id))
            if found is not None and (may_be_late or session.is_answered(panel.id)):
                return panel.id, found
        return None

    def highlight_candidate(self, *_: object) -> None:
        """Highlight the candidate that Enter takes."""
        found = self.candidate(may_be_late=True)
        for panel in self._grid.panels:
            panel.view.over.points.show_as_target(found is not None and panel.id == found[0])

    def accept(self) -> None:
        """Take the best candidate as the partner."""
        found = self.candidate()
        if found is not None:
            self.put(found[0], found[1].vertex)

    def cancel(self) -> bool:
        """Remove the point without a partner; return whether there was one, on panels that predict."""
        document = self.document
        if half_pair(document) is None or not any(map(predicts_in, document.panels)):
            return False
        self.context.session.show(drop_half(document))
        return True

    def remove(self, pairs: list[Pair]) -> None:
        """Remove these pairs."""
        self.context.session.show(remove_pairs(self.document, pairs))

    def remove_chosen(self) -> bool:
        highlighted = self._grid.marks.highlighted(self.tool)
        found = [pair for pair in self.document[Pairs].pairs if pair.points[0] in highlighted]
        if found:
            self.choose("")
            self.remove(found)
        return bool(found)

    def choose(self, point: str) -> None:
        """Highlight the pair of a point, in the list, too."""
        points = next((pair.points for pair in self.document[Pairs].pairs if point in pair.points), ())
        self._grid.marks.highlight(self.tool, points)
        self.chosen.emit(point)

    def offer(self, menu: QtWidgets.QMenu, panel: int, hit: Hit) -> None:
        """Add what can be done at a place to a menu."""
        document = self.document
        pair, half = self._pair_at(document.panel(panel).surface, hit.vertex), half_pair(document)
        if pair is not None:
            number = document[Pairs].pairs.index(pair) + 1
            menu.addAction(f"Remove pair {number}", lambda: self.remove([pair]))
            return
        waiting = waiting_point(document)
        is_partner = waiting is not None and waiting.surface != document.panel(panel).surface
        words = (
            f"Place the partner of point {len(document[Pairs].pairs)} here"
            if is_partner
            else "Place a point of a pair here"
        )
        menu.addAction(f"{words}\tClick", lambda: self.put(panel, hit.vertex))
        if half is not None and self.candidate() is not None:
            menu.addAction("Accept the candidate\tEnter", self.accept)
        if half is not None:
            menu.addAction(f"Discard point {len(document[Pairs].pairs)}\tEsc", self.cancel)

    # ------------------------------------------------------------------ drops
    def click_mark(self, panel: int, number: int, has_ctrl: bool) -> None:
        """Accept a candidate; let another pin marker stand out, or no longer."""
        document = self.document
        pair, surface = document[Pairs].pairs[number - 1], document.panel(panel).surface
        if all(document.point(name).surface != surface for name in pair.points):
            found = candidate_in(document, document.panel(panel), self.context.session.answer(panel))
            if found is not None:
                self.put(panel, found.vertex)
            return
        name = pair.points[0]
        self.choose("" if name in self._grid.marks.highlighted(self.tool) else name)

    def drag(self, panel: int, number: int, hit: Hit) -> None:
        """Move a point as one step of the history, past places that another pair has."""
        session, document = self.context.session, self.document
        surface, pair = document.panel(panel).surface, document[Pairs].pairs[number - 1]
        names = [name for name in pair.points if document.point(name).surface == surface]
        if not names or document.point(names[0]).at == hit.vertex or self._pair_at(surface, hit.vertex) is not None:
            return
        if not self._is_dragging:
            self._is_dragging = self.context[Dragging].is_on = True
            self.context[Dragging].begin()
        session.show(move_pair_point(document, names[0], hit.vertex), key=f"drag of {names[0]}", live=True)

    def release(self) -> None:
        if self._is_dragging:
            self._is_dragging = self.context[Dragging].is_on = False
            self.context[Dragging].end()
