"""Distances from places in faces and from straight pieces of faces, for distances whose squares are quadratic forms.

d(i, j)^2 = |x_i - x_j|^2 for points x_i that stand for the vertices (for the biharmonic distance, of phi_k / lambda_k).
All functions being linear in a face, the place p with the weights b there stands for sum b_i x_i, hence

    d(p, y)^2 = sum_i b_i d(i, y)^2 - sum_{i < j} b_i b_j d(i, j)^2.

A straight piece from p to q stands for a segment, and the nearest of its points is that of a segment in space: with a
and b the squares from its ends and c that between them, it is a + t (b - a - c) + t^2 c at t = (a + c - b) / 2 c, kept
between 0 and 1.
"""

from collections.abc import Iterator
from typing import TypeVar

import numpy as np

from ..arrays import FloatArray, IntArray
from ..sources.pieces import Pieces

Square = TypeVar("Square", float, FloatArray)


def groups_of_pieces(pieces: Pieces, most: int) -> list[IntArray]:
    """Return the numbers of the pieces in groups, one after another, that touch at most so many vertices each."""
    groups: list[list[int]] = [[]]
    touched: set[int] = set()
    for number, corners in enumerate(pieces.touched.tolist()):
        if len(touched | set(corners)) > most:
            groups.append([])
            touched = set()
        touched |= set(corners)
        groups[-1].append(number)
    return [np.array(group) for group in groups]


def squares_from(
    squares: FloatArray, among: FloatArray, index: IntArray, local: IntArray, pieces: Pieces
) -> Iterator[FloatArray]:
    """Yield the squared distances (m,) of all vertices from each piece.

    `squares` (m, k) are those from the vertices `index` (k,), `among` (k, k) those between these vertices; `local`
    (p, 3) says which of them are the corners of each piece.
    """
    units = np.eye(3)
    for corners, start, stop, along in zip(local, pieces.start, pieces.stop, pieces.along, strict=True):
        sides, of_corners = among[np.ix_(corners, corners)], squares[:, corners]
        apart = form(stop - start, sides) if along else 0.0
        here = of_corners @ start + form(start, sides)
        if apart > 0:
            there = of_corners @ stop + form(stop, sides)
            share = _nearest(here, there, apart)
            here += share * (there - here - apart) + share**2 * apart
        # At the corners themselves nothing need cancel.
        for corner, unit in zip(corners, units, strict=True):
            at = start
            if apart > 0:
                at = start + _nearest(form(start - unit, sides), form(stop - unit, sides), apart) * (stop - start)
            here[index[corner]] = form(at - unit, sides)
        yield here


def form(weights: FloatArray, sides: FloatArray) -> float:
    """Return -sum_{i < j} w_i w_j d(i, j)^2, for weights that add up to 0 a squared length."""
    return float(-weights @ sides @ weights / 2)


def _nearest(here: Square, there: Square, apart: float) -> Square:
    """Return the share of the way from one end of a segment to the other at which it is nearest."""
    share: Square = np.clip((here + apart - there) / (2 * apart), 0, 1)
    return share
