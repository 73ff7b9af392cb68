"""Distances of pairs of points that may be anywhere in faces."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from typing import TypeGuard

import numpy as np

from ..arrays import AnyArray, BoolArray, FloatArray, IntArray, array_of
from ..errors import ParameterError
from ..sources.pieces import Pieces
from ..sources.source import Source, SurfacePoint
from ..surface import Surface

Point = Source | str
Pair = tuple[Point, Point]
Many = Sequence[Point] | AnyArray


PointKey = frozenset[tuple[int, float]]
"""Of a point in a face: the corners that it has weight at, with the weights."""


def has_places(points: object) -> TypeGuard[Sequence[Point]]:
    """Return whether a sequence of points holds other than vertex ids: places in faces, or words."""
    return isinstance(points, Sequence) and any(isinstance(each, SurfacePoint | str) for each in points)


def are_of_places(pairs: object) -> TypeGuard[Sequence[Pair]]:
    """Return whether some of a sequence's pairs hold other than vertex ids: places in faces, or words.

    Raises ParameterError for a pair that is not two.
    """
    if not (isinstance(pairs, Sequence) and any(map(has_places, pairs))):
        return False
    if any(len(pair) != 2 for pair in pairs):
        raise ParameterError("Each pair must have two points.")
    return True


def are_many(points: object) -> TypeGuard[Many]:
    """Return whether these are points in an array or a list, and no single one."""
    return (isinstance(points, np.ndarray) and points.ndim > 0) or (
        isinstance(points, Sequence) and not isinstance(points, str)
    )


def paired(u: object, v: object) -> Sequence[Pair] | AnyArray:
    """Pairs (k, 2) of the points u and v (k,); ParameterError unless both are as many."""
    if not (are_many(u) and are_many(v) and len(u) == len(v)):
        of_u, of_v = (f"{len(each):,} points" if are_many(each) else repr(each) for each in (u, v))
        raise ParameterError(f"Pairs are between as many points on both sides, not between {of_u} and {of_v}.")
    if has_places(u) or has_places(v):
        return list(zip(u, v, strict=True))
    return np.column_stack([array_of(each, "Vertices") for each in (u, v)])


def squares_of_pairs(u: Pieces, v: Pieces, of_pairs: Callable[[IntArray], FloatArray]) -> FloatArray:
    """Return (k,) squared distances of k pairs of points, for squares that are quadratic forms (see `in_faces`).

    `of_pairs` computes the distances of pairs of vertices (m, 2).
    """
    corners = np.concatenate([u.corners, v.corners], axis=1)
    weights = np.concatenate([u.start, -v.start], axis=1)
    a, b = np.array(list(combinations(range(6), 2))).T
    ends = np.sort(np.stack([corners[:, a], corners[:, b]], axis=2), axis=2)
    share = -weights[:, a] * weights[:, b]
    used = (share != 0) & (ends[..., 0] != ends[..., 1])
    squares = np.zeros(share.shape)
    if used.any():
        pairs, place = np.unique(ends[used], axis=0, return_inverse=True)
        squares[used] = of_pairs(pairs)[place.ravel()] ** 2
    return np.asarray((share * squares).sum(axis=1))


def are_same(u: Pieces, v: Pieces) -> BoolArray:
    """Return (k,) whether both points of a pair are one, in whichever faces."""
    return np.array([one == other for one, other in zip(_keys(u), _keys(v), strict=True)], bool)


def straight(u: Pieces, v: Pieces, surface: Surface) -> FloatArray:
    """Return (k,) the lengths of the straight ways of pairs of points in one face; infinite for others."""
    holds = np.array([_in_face(u, v, k) or _in_face(v, u, k) for k in range(len(u))], bool)
    lengths = np.linalg.norm(u.positions(surface.vertices)[0] - v.positions(surface.vertices)[0], axis=1)
    return np.where(holds, lengths, np.inf)


def by_start(u: Pieces) -> Iterator[tuple[Pieces, IntArray]]:
    """Yield each point of u once, with the numbers of the pairs that start there."""
    rows: dict[PointKey, list[int]] = {}
    for k, key in enumerate(_keys(u)):
        rows.setdefault(key, []).append(k)
    for mine in rows.values():
        yield u.select(np.array(mine[:1])), np.array(mine)


def _in_face(u: Pieces, v: Pieces, k: int) -> bool:
    """Return whether the face of one point holds the other, too."""
    return set(v.corners[k][v.start[k] > 0].tolist()) <= set(u.corners[k].tolist())


def _keys(points: Pieces) -> list[PointKey]:
    return [
        frozenset((c, w) for c, w in zip(corners, weights, strict=True) if w > 0)
        for corners, weights in zip(points.corners.tolist(), points.start.tolist(), strict=True)
    ]
