"""Biharmonic and commute-time distances in extended precision: dense, of all pairs, for small connected surfaces."""

from collections.abc import Sequence

import numpy as np
import pytest

from bihdist_core import Surface

EXTENDED = np.longdouble
HAS_DIGITS = bool(np.finfo(EXTENDED).eps < 1e-18)
"""Whether this machine's `long double` has more digits than a double: 64 bits on x86."""

needs_digits = pytest.mark.skipif(not HAS_DIGITS, reason="extended precision has no more digits here")


class ExtendedReference:
    """Distances computed from a surface's coordinates, which are taken as exact."""

    def __init__(self, surface: Surface) -> None:
        stiffness, areas = _operators(surface)
        pin = int(areas.argmax())
        keep = np.delete(np.arange(len(areas)), pin)
        self._green = np.zeros_like(stiffness)
        self._green[np.ix_(keep, keep)] = _inverse(stiffness[np.ix_(keep, keep)])
        centred = self._green - areas @ self._green / areas.sum()
        self._points = np.sqrt(areas)[:, None] * centred

    def biharmonic(self) -> np.ndarray:
        """(n, n) distances between vertices."""
        return np.stack([self._from(point) for point in self._points.T], axis=1)

    def commute_time(self) -> np.ndarray:
        """(n, n) distances between vertices."""
        diagonal = self._green.diagonal()
        return np.sqrt(np.maximum(diagonal[:, None] + diagonal - 2 * self._green, 0))

    def biharmonic_from_segment(
        self, corners: Sequence[int], start: Sequence[float], end: Sequence[float]
    ) -> np.ndarray:
        """(n,) distances from a segment of a face, between points with these weights (3,) at the face's corners."""
        first, last = (self._points[:, corners] @ np.asarray(weights, EXTENDED) for weights in (start, end))
        along = last - first
        length = along @ along
        to_each = self._points - first[:, None]
        share = np.clip(along @ to_each / length, 0, 1) if length else np.zeros(to_each.shape[1])
        return np.sqrt(((to_each - share * along[:, None]) ** 2).sum(axis=0))

    def _from(self, point: np.ndarray) -> np.ndarray:
        return np.sqrt(((self._points - point[:, None]) ** 2).sum(axis=0))


def _operators(surface: Surface) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness matrix (n, n) and mixed Voronoi areas (n,)."""
    n, faces = len(surface.vertices), surface.faces
    x = surface.vertices.astype(EXTENDED)[faces]
    sides = [x[:, (k + 2) % 3] - x[:, (k + 1) % 3] for k in range(3)]
    squares = [(side**2).sum(axis=1) for side in sides]
    twice = np.sqrt((np.cross(sides[0], sides[1]) ** 2).sum(axis=1))
    cotangents = [-(sides[(k + 1) % 3] * sides[(k + 2) % 3]).sum(axis=1) / twice for k in range(3)]
    obtuse = np.stack(cotangents) < 0
    stiffness, areas = np.zeros((n, n), EXTENDED), np.zeros(n, EXTENDED)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        for a, b in ((faces[:, i], faces[:, j]), (faces[:, j], faces[:, i])):
            np.subtract.at(stiffness, (a, b), cotangents[k] / 2)
        voronoi = (cotangents[i] * squares[i] + cotangents[j] * squares[j]) / 8
        area = np.where(obtuse.any(axis=0), np.where(obtuse[k], twice / 4, twice / 8), voronoi)
        np.add.at(areas, faces[:, k], area)
    np.fill_diagonal(stiffness, 0)
    np.fill_diagonal(stiffness, -stiffness.sum(axis=1))
    return stiffness, areas


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Of a symmetric positive definite matrix, by Gauss-Jordan elimination; numpy.linalg has doubles only."""
    inverse = matrix.copy()
    for k in range(len(inverse)):
        pivot, column = inverse[k, k], inverse[:, k].copy()
        row = inverse[k] / pivot
        column[k] = 0
        inverse -= np.outer(column, row)
        inverse[:, k] = -column / pivot
        inverse[k] = row
        inverse[k, k] = 1 / pivot
    return inverse
