"""A source on a surface: points in faces and straight pieces across them, as arrays."""

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass
from threading import Lock
from weakref import WeakKeyDictionary

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import ParameterError
from ..surface import Surface, with_faces
from .boundary import boundary_loops
from .edge_faces import edge_faces
from .plane_walk import PlaneWalk, joined
from .source import BoundaryLoop, Curve, Source, SourceSet, SurfacePoint, checked_source
from .words import short_words_of

Rows = tuple[IntArray, FloatArray, FloatArray, bool]
"""Faces, weights at both ends, and whether they are parts of a line."""

MOST_CACHED = 16
"""Sources that are kept for each surface."""
_found: WeakKeyDictionary[Surface, OrderedDict[Source, "Pieces"]] = WeakKeyDictionary()
_lock = Lock()


@dataclass(frozen=True, eq=False)
class Pieces:
    """Straight pieces of faces, some of them points.

    Attributes
    ----------
    faces : (k,) ndarray
        The face in which each lies.
    corners : (k, 3) ndarray
        The vertices of these faces.
    start, stop : (k, 3) ndarray
        The corners' weights at both ends, which are the same for a point.
    along : (k,) bool ndarray
        True for pieces of a line.
    """

    faces: IntArray
    corners: IntArray
    start: FloatArray
    stop: FloatArray
    along: BoolArray

    def __len__(self) -> int:
        return len(self.faces)

    def select(self, which: IntArray | BoolArray) -> "Pieces":
        """Return the pieces with these numbers, or where a mask is true."""
        return Pieces(self.faces[which], self.corners[which], self.start[which], self.stop[which], self.along[which])

    @property
    def vertices(self) -> IntArray | None:
        """The vertices' ids (k,), each once, if all pieces are vertices; else None."""
        if self.along.any() or not (self.start == 1).any(axis=1).all():
            return None
        return np.unique(self.corners[self.start == 1])

    @property
    def touched(self) -> IntArray:
        """The corners (k, 3) that have a weight, at any end; those without are replaced by one that has."""
        has = (self.start > 0) | (self.stop > 0)
        some = np.take_along_axis(self.corners, has.argmax(axis=1)[:, None], axis=1)
        return np.where(has, self.corners, some)

    @property
    def ends(self) -> "Pieces":
        """The points where pieces start and stop, each once."""
        weights = np.concatenate([self.start, self.stop[self.along]])
        at = np.concatenate([np.arange(len(self)), np.flatnonzero(self.along)])
        keys: dict[tuple[tuple[int, float], ...], int] = {}
        for k, (corners, w) in enumerate(zip(self.corners[at], weights, strict=True)):
            keys.setdefault(tuple(sorted((int(c), float(x)) for c, x in zip(corners, w, strict=True) if x > 0)), k)
        which = np.array(list(keys.values()), np.int64)
        points = weights[which]
        return Pieces(self.faces[at][which], self.corners[at][which], points, points, np.zeros(len(which), bool))

    @property
    def points(self) -> "Pieces":
        """The pieces that are points."""
        return self.select(np.flatnonzero(~self.along))

    @property
    def lines(self) -> "Pieces":
        """The pieces that are parts of lines."""
        return self.select(np.flatnonzero(self.along))

    def positions(self, vertices: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (k, 3) both ends of each, of a surface whose vertices are at (n, 3)."""
        at = vertices[self.corners]
        return np.einsum("kc,kcx->kx", self.start, at), np.einsum("kc,kcx->kx", self.stop, at)


def pieces_of(source: Source, surface: Surface) -> Pieces:
    """Return a source on a surface, found once for whoever asks.

    Raises VertexError for a vertex that does not exist or belongs to no face, ParameterError for a face or a boundary
    loop that does not exist, and for a curve whose points cannot be joined.
    """
    source = checked_source(source)
    with _lock:
        known = _found.setdefault(surface, OrderedDict())
        pieces = known.pop(source, None)
    if pieces is None:
        pieces = _pieces(source, surface)
        for array in (pieces.faces, pieces.corners, pieces.start, pieces.stop, pieces.along):
            array.flags.writeable = False
    with _lock:
        known[source] = pieces
        while len(known) > MOST_CACHED:
            known.popitem(last=False)
    return pieces


def points_on(surface: Surface, points: Sequence[Source | str]) -> Pieces:
    """Vertices and places in faces, or their words, each for itself.

    Raises VertexError and ParameterError for what is not on the surface, or is more than a point.
    """
    found = []
    for each in points:
        source = checked_source(each)
        if not isinstance(source, int | SurfacePoint):
            raise ParameterError(f"A vertex or a place in a face is one point; {short_words_of(source)} is not.")
        found.append(pieces_of(source, surface))
    faces, corners, weights = (
        np.concatenate([getattr(each, name) for each in found]) for name in ("faces", "corners", "start")
    )
    return Pieces(faces, corners, weights, weights, np.zeros(len(found), bool))


def _pieces(source: Source, surface: Surface) -> Pieces:
    members = source.members if isinstance(source, SourceSet) else (source,)
    rows: list[Rows] = []
    vertices = [each for each in members if not isinstance(each, SurfacePoint | BoundaryLoop | Curve)]
    if vertices:
        ids = surface.check_vertices(vertices)
        if not len(surface.faces):
            weights = np.eye(3)[np.zeros(len(ids), int)]
            return Pieces(ids, np.repeat(ids[:, None], 3, axis=1), weights, weights, np.zeros(len(ids), bool))
        # Any face of each: the last that is written.
        face = np.zeros(len(surface.vertices), np.int64)
        face[surface.faces.ravel()] = np.repeat(np.arange(len(surface.faces)), 3)
        weights = (surface.faces[face[ids]] == ids[:, None]).astype(float)
        rows.append((face[ids], weights, weights, False))
    loops = None
    for member in members:
        if isinstance(member, SurfacePoint):
            _check_face(member, surface)
            at = np.array([member.weights])
            rows.append((np.array([member.face]), at, at, False))
        elif isinstance(member, BoundaryLoop):
            loops = boundary_loops(surface) if loops is None else loops
            rows.append(_loop(member, loops, surface))
        elif isinstance(member, Curve):
            rows.append(_curve(member, surface))
    faces = np.concatenate([row[0] for row in rows])
    start, stop = (np.concatenate([row[k] for row in rows]) for k in (1, 2))
    along = np.concatenate([np.full(len(row[0]), row[3]) for row in rows])
    return Pieces(faces, surface.faces[faces], start, stop, along)


def _check_face(place: SurfacePoint, surface: Surface) -> None:
    count = len(with_faces(surface, "places in faces").faces)
    if place.face >= count:
        raise ParameterError(f"{surface.name} has no face {place.face}; faces run from 0 to {count - 1}.")


def _loop(loop: BoundaryLoop, loops: list[IntArray], surface: Surface) -> Rows:
    if not len(with_faces(surface, "boundary loops").faces) or not loops:
        raise ParameterError(f"{surface.name} has no boundary loop {loop.number}: this mesh is closed.")
    if loop.number >= len(loops):
        known = "its only one is loop:0" if len(loops) == 1 else f"they run from loop:0 to loop:{len(loops) - 1}"
        raise ParameterError(f"{surface.name} has no boundary loop {loop.number}; {known}, the longest first.")
    face, corner = edge_faces(surface).one_at(surface.boundary_edges[loops[loop.number]])
    ends = np.eye(3)
    return face, ends[corner[:, 0]], ends[corner[:, 1]], True


def _curve(curve: Curve, surface: Surface) -> Rows:
    for number, place in enumerate(curve.places):
        try:
            _check_face(place, surface)
        except ParameterError as error:
            raise ParameterError(f"Point {number} of the curve: {error}") from None
    walk = PlaneWalk(surface)
    legs = list(zip(curve.places, curve.places[1:], strict=False))
    legs += [(curve.places[-1], curve.places[0])] if curve.closed else []
    steps = [
        step
        for number, (start, stop) in enumerate(legs)
        for step in joined(walk, start, stop, f"Points {number} and {(number + 1) % len(curve.places)} of the curve")
    ]
    faces, start, stop = (np.array(each) for each in zip(*steps, strict=True))
    return faces, start, stop, True
