"""Which faces meet at an edge."""

from threading import Lock
from weakref import WeakKeyDictionary

import numpy as np

from ..arrays import IntArray
from ..surface import Surface

_known: WeakKeyDictionary[Surface, "EdgeFaces"] = WeakKeyDictionary()
_lock = Lock()


class EdgeFaces:
    """The faces of a surface by the ends of their edges."""

    def __init__(self, surface: Surface) -> None:
        self._count, self._faces = len(surface.vertices), surface.faces
        tail, head = surface.faces.T.ravel(), surface.faces[:, [1, 2, 0]].T.ravel()
        key = np.minimum(tail, head) * self._count + np.maximum(tail, head)
        self._order = key.argsort(kind="stable")
        self._key = key[self._order]

    def at(self, i: int, j: int) -> list[int]:
        """Return the faces with an edge between two vertices, ascending."""
        key = min(i, j) * self._count + max(i, j)
        first, last = np.searchsorted(self._key, [key, key + 1])
        return sorted(int(face) for face in self._order[first:last] % len(self._faces))

    def one_at(self, edges: IntArray) -> tuple[IntArray, IntArray]:
        """Return (k,) a face at each of the edges (k, 2), and (k, 2) which of its corners the ends are."""
        keys = edges.min(axis=1) * self._count + edges.max(axis=1)
        faces = self._order[np.searchsorted(self._key, keys)] % len(self._faces)
        return faces, np.argmax(self._faces[faces][:, None, :] == edges[:, :, None], axis=2)


def edge_faces(surface: Surface) -> EdgeFaces:
    """Return the edges' faces of a surface, found once: sorting takes longer than a curve on it."""
    with _lock:
        if surface not in _known:
            _known[surface] = EdgeFaces(surface)
        return _known[surface]
