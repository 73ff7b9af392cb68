"""What is done to pairs on panels that predict: put, accepted, chosen, dragged, removed."""

from contextlib import suppress
from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError

from ...document.document import Document
from ...qt.context import Context
from ...qt.dragging import Dragging
from ...qt.gesture import Gesture
from ...qt.panels.events import Click
from .candidate_errors import CandidateErrors
from .pair_locations import Candidate, candidate_in
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
from .prediction import predicts_in

if TYPE_CHECKING:
    from ...scene.picking import Hit


class PairGestures(Gesture):
    """See `Gesture`; beside them how far candidates are from the truth is found."""

    tool, follows = "pairs", True
    chosen = QtCore.Signal(str)  # a point of the pair that stands out from now on, "" for none

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._grid = context.grid
        self.errors = CandidateErrors(context)
        self._grid.activated.connect(self.show_meant)
        context.answer_changed.connect(self.show_meant)
        self._is_dragging = False

    @property
    def _document(self) -> Document:
        return self.context.document

    def is_on(self, panel: int) -> bool:
        """Whether a panel predicts, so that what is done there is done to pairs."""
        return predicts_in(self._document.panel(panel)) and len(self._document.surfaces) > 1

    # ------------------------------------------------------------------ points
    def click(self, panel: int, click: Click) -> None:
        self.put(panel, click.hit.vertex)

    def put(self, panel: int, vertex: int) -> None:
        """A point that waits for its partner, or the partner of the one that waits.

        Where a pair has its point already, that pair is chosen.
        """
        document, surface = self._document, self._document.panel(panel).surface
        waiting = waiting_point(document)
        there = self._pair_at(surface, vertex)
        if there is not None and (waiting is None or waiting.surface == surface):
            self.choose(there.points[0])
            return
        try:
            changed = place_point(document, surface, vertex)
        except ParameterError as error:
            self.context.fail(error)
            return
        self.context.edit(changed)
        self.choose("")

    def follow(self, panel: int, hit: "Hit") -> None:
        """The point that waits is where the pointer is, unless it waits for a partner on this surface."""
        document, surface = self._document, self._document.panel(panel).surface
        waiting = waiting_point(document)
        if (waiting is None or waiting.surface == surface) and self._pair_at(surface, hit.vertex) is None:
            with suppress(ParameterError):  # there are too many, which a click says
                self.context.edit(place_point(document, surface, hit.vertex), key="live", live=True)

    def _pair_at(self, surface: str, vertex: int) -> Pair | None:
        document = self._document
        for pair in whole_pairs(document):
            points = [document.point(name) for name in pair.points]
            if any((point.surface, point.at) == (surface, vertex) for point in points):
                return pair
        return None

    def candidate(self, may_be_late: bool = False) -> tuple[int, Candidate] | None:
        """That of the active panel, or else of the first that has one, with the panel's id.

        may_be_late: of where the point was, while it is dragged.
        """
        session, active = self.context.session, self._grid.active
        panels = sorted(self._document.panels, key=lambda panel: panel.id != active)
        for panel in panels:
            shown = session.shown.get(panel.id)
            found = candidate_in(self._document, panel, None if shown is None else shown.answer)
            if found is not None and (may_be_late or session.is_answered(panel.id)):
                return panel.id, found
        return None

    def show_meant(self, *_: object) -> None:
        """Let the candidate stand out that Enter takes."""
        found = self.candidate(may_be_late=True)
        for panel in self._grid.panels:
            panel.view.over.points.mean(found is not None and panel.id == found[0])

    def accept(self) -> None:
        """The best candidate is the partner."""
        found = self.candidate()
        if found is not None:
            self.put(found[0], found[1].vertex)

    def put_down(self) -> bool:
        """Without the point that waits; whether there was one, on panels that predict."""
        document = self._document
        if half_pair(document) is None or not any(map(predicts_in, document.panels)):
            return False
        self.context.edit(drop_half(document))
        return True

    def remove(self, pairs: list[Pair]) -> None:
        """Remove these pairs."""
        self.context.edit(remove_pairs(self._document, pairs))

    def remove_chosen(self) -> bool:
        lit = self._grid.marks.lit(self.tool)
        found = [pair for pair in self._document[Pairs].pairs if pair.points[0] in lit]
        if found:
            self.choose("")
            self.remove(found)
        return bool(found)

    def choose(self, point: str) -> None:
        """Let the pair of a point stand out, in the list, too."""
        points = next((pair.points for pair in self._document[Pairs].pairs if point in pair.points), ())
        self._grid.marks.light(self.tool, points)
        self.chosen.emit(point)

    def offer(self, menu: QtWidgets.QMenu, panel: int, hit: "Hit") -> None:
        """In a menu: what can be done with the place."""
        document = self._document
        pair, half = self._pair_at(document.panel(panel).surface, hit.vertex), half_pair(document)
        if pair is not None:
            number = document[Pairs].pairs.index(pair) + 1
            menu.addAction(f"Remove pair {number}", lambda: self.remove([pair]))
            return
        waiting = waiting_point(document)
        is_partner = waiting is not None and waiting.surface != document.panel(panel).surface
        words = (
            f"The partner of point {len(document[Pairs].pairs)} is here" if is_partner else "A point of a pair is here"
        )
        menu.addAction(f"{words}\tClick", lambda: self.put(panel, hit.vertex))
        if half is not None and self.candidate() is not None:
            menu.addAction("Accept the candidate\tEnter", self.accept)
        if half is not None:
            menu.addAction(f"Give point {len(document[Pairs].pairs)} up\tEsc", self.put_down)

    # ------------------------------------------------------------------ drops
    def click_mark(self, panel: int, number: int, has_ctrl: bool) -> None:
        """A candidate is accepted, another drop stands out, or no longer."""
        document = self._document
        pair, surface = document[Pairs].pairs[number - 1], document.panel(panel).surface
        if not self._has_point(pair, surface):
            shown = self.context.session.shown.get(panel)
            found = candidate_in(document, document.panel(panel), None if shown is None else shown.answer)
            if found is not None:
                self.put(panel, found.vertex)
            return
        name = pair.points[0]
        self.choose("" if name in self._grid.marks.lit(self.tool) else name)

    def _has_point(self, pair: Pair, surface: str) -> bool:
        return any(self._document.point(name).surface == surface for name in pair.points)

    def drag(self, panel: int, number: int, hit: "Hit") -> None:
        """All the way is one step; a place that another pair has is passed."""
        session, document = self.context.session, self._document
        surface, pair = document.panel(panel).surface, document[Pairs].pairs[number - 1]
        names = [name for name in pair.points if document.point(name).surface == surface]
        if not names or document.point(names[0]).at == hit.vertex or self._pair_at(surface, hit.vertex) is not None:
            return
        if not self._is_dragging:
            self._is_dragging = self.context[Dragging].is_on = True
            self.context[Dragging].set_off()
        session.show(move_pair_point(document, names[0], hit.vertex), key=f"drag of {names[0]}", live=True)

    def release(self) -> None:
        if self._is_dragging:
            self._is_dragging = self.context[Dragging].is_on = False
            self.context[Dragging].rest()
