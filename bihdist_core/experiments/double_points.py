"""Two different points of a surface that a few functions cannot tell apart.

k functions map a surface into k dimensions.  Into the plane no closed surface fits without falling on itself, and into
three dimensions few do: then two different points have the same values, and their distance by these functions is 0.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..surface import Surface

CANDIDATES = 150
"""Pairs of vertices near whose images a double point is sought."""


@dataclass(frozen=True, eq=False)
class DoublePoint:
    """Two places in faces, far apart on the surface, and how far apart their images are.

    faces: (2,).  weights: (2, 3) barycentric.
    """

    faces: IntArray
    weights: FloatArray
    gap: float

    def values(self, surface: Surface, images: FloatArray) -> FloatArray:
        """(2, k) functions (n, k), linear in each face, at both places."""
        values: FloatArray = np.einsum("pc,pck->pk", self.weights, images[surface.faces[self.faces]])
        return values


def double_point(surface: Surface, images: FloatArray, along: FloatArray, apart: float) -> DoublePoint | None:
    """The two places with the nearest images (n, k), among faces near the likeliest pairs of vertices.

    along: (n, n) distances on the surface, of which those of the pair must exceed `apart`.  The images of two faces
    that meet in their planes, not in the faces, are no pair.  None if there is no pair.
    """
    square = np.einsum("ik,ik->i", images, images)
    gaps = square[:, None] + square - 2 * images @ images.T
    gaps[~(along > apart)] = np.inf
    order = np.argpartition(gaps, min(2 * CANDIDATES, gaps.size - 1), axis=None)[: 2 * CANDIDATES]
    i, j = np.unravel_index(order[np.isfinite(gaps.ravel()[order])], gaps.shape)
    around = [np.flatnonzero((surface.faces == v).any(axis=1)) for v in range(len(images))] if len(i) else []
    pairs = {(int(f), int(g)) for a, b in zip(i, j, strict=True) if a < b for f in around[a] for g in around[b]}
    best: DoublePoint | None = None
    if pairs:
        faces = np.array(sorted(pairs))
        weights = _meeting(images[surface.faces[faces[:, 0]]], images[surface.faces[faces[:, 1]]])
        inside = (weights >= 0).all(axis=(1, 2))
        for pair, weight in zip(faces[inside], weights[inside], strict=True):
            one, two = DoublePoint(pair, weight, np.inf).values(surface, images)
            gap = float(np.linalg.norm(one - two))
            if best is None or gap < best.gap:
                best = DoublePoint(pair, weight, gap)
    return best


def _meeting(a: FloatArray, b: FloatArray) -> FloatArray:
    """(m, 2, 3) weights of the nearest places in the planes of triangles (m, 3, k) each, as near the middles as can be.

    With the sides u of a and v of b: a0 + u s = b0 + v t, four unknowns and k equations.
    """
    middle = a.mean(axis=1) - b.mean(axis=1)
    sides = np.concatenate([a[:, 1:] - a[:, :1], b[:, :1] - b[:, 1:]], axis=1)
    steps = np.einsum("mij,mj->mi", np.linalg.pinv(sides.transpose(0, 2, 1)), -middle)
    shares = steps.reshape(-1, 2, 2) + 1 / 3
    return np.concatenate([1 - shares.sum(axis=2, keepdims=True), shares], axis=2)
