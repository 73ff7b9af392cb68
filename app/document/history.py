"""Undo and redo: the documents that were shown before, and those that were taken back."""

from collections import deque
from dataclasses import replace
from typing import Generic, TypeVar

from .document import Document, Point, content, starting_points

LONGEST = 1_000
"""Steps that are kept; a document takes a kilobyte, and many where curves are drawn or vertices selected."""


class History:
    """Steps from one document to the next.

    Steps with the same key in a row are one: a drag, a slider.  The camera belongs to the document, but its moves are
    no steps: undo and redo leave it where it is, except that another mesh is seen as it was seen last.  Nor are docks
    that are opened and closed, and snapping and the link of two cameras, which are switched.
    """

    def __init__(self, document: Document) -> None:
        self.present = document
        self._past: deque[Document] = deque(maxlen=LONGEST)
        self._future: list[Document] = []
        self._key = ""

    @property
    def can_undo(self) -> bool:
        """Whether there is a document before this one."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Whether a document has been left by undo."""
        return bool(self._future)

    def change(self, document: Document, key: str = "") -> Document:
        """Make this the present: a step, unless only camera, docks or snapping differ.

        The present itself without a key ends a row of equal ones; a camera or a dock that moves meanwhile does not.
        """
        if content(document) != content(self.present):
            self._future.clear()
            if not key or key != self._key:
                self._past.append(self.present)
                self._key = key
            elif self._past and content(document) == content(self._past[-1]):
                # Back where the row of changes began: nothing is left of the step.
                self._past.pop()
                self._key = ""
        elif not key and document == self.present:
            self._key = ""  # a drag is over: the next is a step of its own
        self.present = document
        return document

    def at(self, steps: int) -> Document | None:
        """What is so many steps on, or back if below 0; None where there is nothing."""
        found, way = self.present, range(1, abs(steps) + 1)
        for step in way:
            if step > len(self._past if steps < 0 else self._future):
                return None
            found = _seen_from((self._past if steps < 0 else self._future)[-step], found)
        return found

    def trail_of_points(self) -> "Trail[tuple[Point, ...]]":
        """Where the points that fields start from have been, step by step, on the present surfaces."""
        trail: Trail[tuple[Point, ...]] = Trail()
        for document in (*self._past, self.present):
            if document.surfaces == self.present.surfaces:
                trail.visit(starting_points(document))
        return trail

    def undo(self) -> Document:
        """One step back; nothing where there is none."""
        return self.go(-1)

    def redo(self) -> Document:
        """One step forward again; nothing where there is none."""
        return self.go(1)

    def go(self, steps: int) -> Document:
        """So many steps on, or back if below 0; nothing where there are not so many."""
        if self.at(steps) is not None:
            start, end = (self._past, self._future) if steps < 0 else (self._future, self._past)
            for _ in range(abs(steps)):
                document = start.pop()
                end.append(self.present)
                self.present, self._key = _seen_from(document, self.present), ""
        return self.present


Place = TypeVar("Place")


class Trail(Generic[Place]):
    """Places that were visited, to go back and on among them; a new one follows the present one."""

    def __init__(self) -> None:
        self._places: list[Place] = []
        self._at = -1

    def visit(self, place: Place) -> None:
        """The same place again is no other visit."""
        if self._at < 0 or self._places[self._at] != place:
            self._places = [*self._places[: self._at + 1], place][-LONGEST:]
            self._at = len(self._places) - 1

    def is_first(self, place: Place) -> bool:
        """Whether nothing was visited before this place, which may be new."""
        return self._at < 0 or (self._at == 0 and self._places[0] == place)

    def is_last(self, place: Place) -> bool:
        """Whether nothing was visited after it."""
        return self._at == len(self._places) - 1 or self._places[self._at] != place

    def back(self) -> Place | None:
        """The place before; None at the first."""
        return self._go(-1)

    def on(self) -> Place | None:
        """The place after; None at the last."""
        return self._go(1)

    def _go(self, step: int) -> Place | None:
        if not 0 <= self._at + step < len(self._places):
            return None
        self._at += step
        return self._places[self._at]


def _seen_from(document: Document, present: Document) -> Document:
    document = replace(document, docks=present.docks, dock_places=present.dock_places)
    document = replace(document, snap=present.snap, linked=present.linked)
    if document.surfaces[:1] == present.surfaces[:1]:
        document = replace(document, camera=present.camera)
    cameras = {each.surface: each.camera for each in present.beside}
    if document.surfaces != present.surfaces:
        return document
    beside = tuple(replace(each, camera=cameras.get(each.surface, each.camera)) for each in document.beside)
    return replace(document, beside=beside)
