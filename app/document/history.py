"""Undo and redo: the documents that were shown before, and those that were taken back."""

import sys
from collections import Counter, deque
from dataclasses import fields, is_dataclass, replace
from itertools import pairwise
from typing import Any, Generic, NamedTuple, TypeVar

from .document import Document, Point, content, starting_points

LONGEST = 1_000
"""Steps that are kept."""

MOST_BYTES = 256_000_000
"""Bytes of the documents that are kept, what they share counted once.  Most take a kilobyte or two; where curves are
drawn or vertices selected, on a large mesh, it may be megabytes."""


class Step(NamedTuple):
    """A document, and the number of the mesh or file that was opened for it: edits keep that number."""

    document: Document
    origin: int


class History:
    """The steps from one document to the next.

    Consecutive steps with the same key, such as those of a drag or a slider, are one. The camera belongs to the
    document, but its moves are no steps: undo and redo leave it where it is, except that another mesh is seen as it was
    seen last. Opening and closing docks, snapping and the link of two cameras are no steps either.

    Attributes
    ----------
    present
        The document that is shown.
    discarded
        The number of oldest steps that were dropped, as there were more than LONGEST or MOST_BYTES.
    """

    def __init__(self, document: Document) -> None:
        self.present = document
        self.origin = 0
        self.discarded = 0
        self._newest = 0
        self._past: deque[Step] = deque()
        self._sizes: deque[int] = deque()  # of each, without what it shares with the one before
        self._future: list[Step] = []
        self._key = ""

    @property
    def closed(self) -> list[Step]:
        """Documents that were left for another mesh, the last first: only undo leads back to them."""
        steps = [*self._past, Step(self.present, self.origin)]
        left = (one for one, other in pairwise(steps) if one.origin != other.origin or _loses_mesh(one, other))
        return [step for step in left if step.document.surfaces][::-1]

    @property
    def can_undo(self) -> bool:
        """Return whether there is a document before this one."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Return whether a document has been left by undo."""
        return bool(self._future)

    def change(self, document: Document, key: str = "", is_opened: bool = False) -> Document:
        """Make this the present document: a step, unless only camera, docks or snapping differ.

        Passing the present document without a key ends a sequence of steps with equal keys; moving the camera or a dock
        in between does not. With `is_opened` the document comes from a mesh or a file that was opened, and is no edit
        of the present one, unless it has the same content.
        """
        if content(document) != content(self.present):
            before = Step(self.present, self.origin)
            if is_opened:
                self._newest += 1
                self.origin, key = self._newest, ""
            self._future.clear()
            if not key or key != self._key:
                self._push(before)
                self._key = key
            elif self._past and content(document) == content(self._past[-1].document):
                # Back where the row of changes began: nothing is left of the step.
                self._pop()
                self._key = ""
        elif not key and document == self.present:
            self._key = ""  # a drag is over: the next is a step of its own
        self.present = document
        return document

    def at(self, steps: int) -> Document | None:
        """Return the document so many steps forward, or back if below 0; None where there is none."""
        found, way = self.present, range(1, abs(steps) + 1)
        for step in way:
            if step > len(self._past if steps < 0 else self._future):
                return None
            found = _seen_from((self._past if steps < 0 else self._future)[-step].document, found)
        return found

    def point_history(self) -> "NavigationHistory[tuple[Point, ...]]":
        """Return the places of the points that fields start from, step by step, on the present surfaces."""
        found: NavigationHistory[tuple[Point, ...]] = NavigationHistory()
        for document in (*(step.document for step in self._past), self.present):
            if document.surfaces == self.present.surfaces:
                found.visit(starting_points(document))
        return found

    def undo(self) -> Document:
        """Go one step back; nothing happens where there is none."""
        return self.go(-1)

    def take_back(self) -> Document:
        """Go one step back, without a way to redo it."""
        if self.can_undo:
            self.undo()
            self._future.pop()
        return self.present

    def redo(self) -> Document:
        """Go one step forward again; nothing happens where there is none."""
        return self.go(1)

    def go(self, steps: int) -> Document:
        """Go so many steps forward, or back if below 0; nothing happens where there are not so many."""
        if self.at(steps) is not None:
            for _ in range(abs(steps)):
                now = Step(self.present, self.origin)
                if steps < 0:
                    document, self.origin = self._pop()
                    self._future.append(now)
                else:
                    document, self.origin = self._future.pop()
                    self._push(now)
                self.present, self._key = _seen_from(document, self.present), ""
        return self.present

    def _push(self, step: Step) -> None:
        self._sizes.append(_bytes_beyond(step.document, self._past[-1].document if self._past else None))
        self._past.append(step)
        while len(self._past) > LONGEST or (len(self._past) > 1 and sum(self._sizes) > MOST_BYTES):
            self._past.popleft()
            self._sizes.popleft()
            if self._past:
                self._sizes[0] = _bytes_beyond(self._past[0].document, None)
            self.discarded += 1

    def _pop(self) -> Step:
        self._sizes.pop()
        return self._past.pop()


def _bytes_beyond(value: Any, known: Any) -> int:
    """Bytes of a value of a document, without the parts that it shares with another."""
    if value is known:
        return 0
    size = sys.getsizeof(value)
    if is_dataclass(value):
        size += sys.getsizeof(vars(value))
        for field in fields(value):
            size += _bytes_beyond(getattr(value, field.name), getattr(known, field.name, None))
    elif isinstance(value, tuple):
        others = known if isinstance(known, tuple) else ()
        shared = set(map(id, others))
        for k, part in enumerate(value):
            if id(part) not in shared:
                size += _bytes_beyond(part, others[k] if k < len(others) else None)
    return size


Place = TypeVar("Place")


class NavigationHistory(Generic[Place]):
    """Places that were visited, to go back and on among them; a new one follows the present one."""

    def __init__(self) -> None:
        self._places: list[Place] = []
        self._at = -1

    def visit(self, place: Place) -> None:
        """Add a place; the present one again is no other visit."""
        if self._at < 0 or self._places[self._at] != place:
            self._places = [*self._places[: self._at + 1], place][-LONGEST:]
            self._at = len(self._places) - 1

    def is_first(self, place: Place) -> bool:
        """Return whether nothing was visited before this place, which may be new."""
        return self._at < 0 or (self._at == 0 and self._places[0] == place)

    def is_last(self, place: Place) -> bool:
        """Return whether nothing was visited after it."""
        return self._at == len(self._places) - 1 or self._places[self._at] != place

    def back(self) -> Place | None:
        """Return the place before; None at the first."""
        return self._go(-1)

    def forward(self) -> Place | None:
        """Return the place after; None at the last."""
        return self._go(1)

    def _go(self, step: int) -> Place | None:
        if not 0 <= self._at + step < len(self._places):
            return None
        self._at += step
        return self._places[self._at]


def _loses_mesh(before: Step, after: Step) -> bool:
    """Return whether a surface is gone that is not just made from another one."""
    return bool(_opened_meshes(before) - _opened_meshes(after))


def _opened_meshes(step: Step) -> Counter[str]:
    return Counter(mesh.sha256 for mesh in step.document.surfaces if mesh.change is None)


def _seen_from(document: Document, present: Document) -> Document:
    document = replace(document, docks=present.docks, dock_places=present.dock_places)
    document = replace(document, snap=present.snap, linked=present.linked)
    if document.surfaces[:1] == present.surfaces[:1]:
        document = replace(document, camera=present.camera)
    cameras = {each.surface: each.camera for each in present.second_views}
    if document.surfaces != present.surfaces:
        return document
    second_views = tuple(replace(each, camera=cameras.get(each.surface, each.camera)) for each in document.second_views)
    return replace(document, second_views=second_views)
