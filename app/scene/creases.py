"""Normals of what is drawn: one at each vertex, or several where faces meet at a crease."""

from dataclasses import dataclass

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray
from bihdist_core.surface import connected, dots

from .winding import Winding

NEARLY = 0.75
"""Of the angle of a crease, from where on edges are nearly creases."""

GAP = 2.5
"""How many times longer the creases of a made thing are than the edges that are nearly creases.  On what has grown or
been scanned there are as many of the one as of the other: up to 1.5 times on such meshes, 3.2 times and more on parts,
a car and an aeroplane."""


@dataclass(frozen=True, eq=False)
class Split:
    """Faces with copies of vertices on each side of creases.

    Attributes
    ----------
    faces
        (m, 3) points of what is drawn; those from n on are copies.
    copies
        (k,) vertices that are copied.
    """

    faces: IntArray
    copies: IntArray


def face_normals(vertices: FloatArray, faces: IntArray) -> list[FloatArray]:
    """Return the x, y and z (m,) of normals that are twice as long as the faces' areas."""
    x = np.ascontiguousarray(vertices.T)
    p, q, r = (x.take(faces[:, k], axis=1) for k in range(3))
    a, b = q - p, r - p
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def point_normals(normals: list[FloatArray], faces: IntArray, n: int) -> AnyArray:
    """Return unit normals (n, 3) float32 along the mean of those of a vertex' faces; 0 for a vertex of no face."""
    corners = np.ascontiguousarray(faces.T)
    sums = [np.zeros(n) for _ in normals]
    for ids in corners:
        for total, x in zip(sums, normals, strict=True):
            total += np.bincount(ids, x, n)
    to_length_one(sums)
    return np.stack(sums, axis=1, dtype=np.float32)


def bends(normals: list[FloatArray], wound: Winding) -> FloatArray:
    """Return the cosines (e,) of the angles at which two faces meet; 1 where one has no area.

    The normals are of unit length, of the faces as they are to be wound.
    """
    m = len(wound.turn)
    f, g = wound.left % m, wound.right % m
    cosine = dots([x.take(f) for x in normals], [x.take(g) for x in normals])
    cosine[wound.is_turned] *= -1
    is_flat = dots(normals, normals) == 0
    if is_flat.any():
        cosine[is_flat[f] | is_flat[g]] = 1
    return cosine


def has_creases(surface: Surface, edges: IntArray, cosines: FloatArray, crease: float) -> bool:
    """Return whether edges (e,) with cosines (e,) are those of a made thing.

    It has creases of more than so many degrees, and few edges that are nearly creases.
    """
    bent = np.flatnonzero(cosines < np.cos(np.radians(NEARLY * crease)))
    i, j = surface.edges[edges[bent]].T
    lengths = np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)
    is_sharp = cosines[bent] < np.cos(np.radians(crease))
    sharp = float(lengths[is_sharp].sum())
    return sharp > 0 and sharp > GAP * float(lengths[~is_sharp].sum())


def split(surface: Surface, wound: Winding, is_cut: BoolArray) -> Split:
    """Return the surface's faces with separate vertices on each side of the edges (e,) that are cut.

    At an end of a cut, faces that can be reached from each other without crossing one stay together.
    """
    faces, m, n, ends = surface.faces, len(surface.faces), len(surface.vertices), surface.edges
    cut = ends[is_cut]
    at_cut = np.zeros(n, bool)
    at_cut[cut.ravel()] = True
    corner = faces.T.ravel()
    loose = np.flatnonzero(at_cut.take(corner))
    if not len(loose):
        return Split(faces, np.empty(0, np.int64))
    place = np.full(3 * m, -1)
    place[loose] = np.arange(len(loose))
    whole = np.flatnonzero(~is_cut[wound.edges] & at_cut[ends[wound.edges]].any(axis=1))
    left, right = wound.left[whole], wound.right[whole]
    pairs = []
    for a, b in zip(_ends(left, corner, m), _ends(right, corner, m), strict=True):
        both = np.stack([place[a], place[b]])
        pairs.append(both[:, both[0] >= 0])
    fan = connected(np.concatenate(pairs, axis=1), len(loose))
    vertex = np.empty(int(fan.max()) + 1, np.int64)
    vertex[fan] = corner[loose]
    # The first of a vertex' fans keeps its id.
    keeps = np.empty(n, np.int64)
    keeps[vertex[::-1]] = np.arange(len(vertex))[::-1]
    is_copy = keeps[vertex] != np.arange(len(vertex))
    ids = np.where(is_copy, n - 1 + np.cumsum(is_copy), vertex)
    corner = corner.copy()
    corner[loose] = ids[fan]
    return Split(np.ascontiguousarray(corner.reshape(3, m).T), vertex[is_copy])


def _ends(side: IntArray, corner: IntArray, m: int) -> tuple[IntArray, IntArray]:
    """Return the corners (face + m * corner) at the two ends of sides, that of the smaller vertex first."""
    a, b = side, side % m + (side // m + 1) % 3 * m
    swap = corner.take(a) > corner.take(b)
    return np.where(swap, b, a), np.where(swap, a, b)


def to_length_one(vectors: list[FloatArray]) -> None:
    """Divide vectors, three arrays of coordinates, by their lengths, in place; those of no length stay 0."""
    length = np.sqrt(dots(vectors, vectors))
    for x in vectors:
        np.divide(x, length, out=x, where=length > 0)
