"""Undo and redo: the documents that were shown before, and those that were taken back."""

from collections import deque
from dataclasses import replace

from .document import Document, without_camera

LONGEST = 10_000
"""Steps that are kept; a document takes some kilobytes."""


class History:
    """Steps from one document to the next.

    Steps with the same key in a row are one: a drag, a slider.  The camera belongs to the document, but its moves are
    no steps: undo and redo leave it where it is, except that another mesh is seen as it was seen last.
    """

    def __init__(self, document: Document) -> None:
        self.present = document
        self._past: deque[Document] = deque(maxlen=LONGEST)
        self._future: list[Document] = []
        self._key = ""

    @property
    def can_undo(self) -> bool:
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        return bool(self._future)

    def change(self, document: Document, key: str = "") -> Document:
        """Make this the present: a step, unless only the camera differs.  Without a key a row of equal ones ends."""
        if without_camera(document) != without_camera(self.present):
            if not key or key != self._key:
                self._past.append(self.present)
            self._future.clear()
            self._key = key
        elif not key:
            self._key = ""  # a drag is over: the next is a step of its own
        self.present = document
        return document

    def before(self) -> Document | None:
        """What `undo` would show."""
        return _seen_from(self._past[-1], self.present) if self._past else None

    def after(self) -> Document | None:
        """What `redo` would show."""
        return _seen_from(self._future[-1], self.present) if self._future else None

    def undo(self) -> Document:
        """One step back; nothing where there is none."""
        document = self.before()
        if document is not None:
            self._past.pop()
            self._future.append(self.present)
            self.present, self._key = document, ""
        return self.present

    def redo(self) -> Document:
        """One step forward again; nothing where there is none."""
        document = self.after()
        if document is not None:
            self._future.pop()
            self._past.append(self.present)
            self.present, self._key = document, ""
        return self.present


def _seen_from(document: Document, present: Document) -> Document:
    return replace(document, camera=present.camera) if document.surfaces == present.surfaces else document
