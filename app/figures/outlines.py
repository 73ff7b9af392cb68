"""The outlines of a surface in a picture: where what is seen ends before something farther away, or before nothing."""

from itertools import pairwise
from weakref import WeakKeyDictionary

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from bihdist_core.analysis.chains import chains
from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray

from ..scene.line_clipping import Line
from .hidden_lines import HiddenLineRemoval
from .occlusion import cross

BESIDE = 0.3
"""Pixels from an outline to where what lies behind it is looked for."""

STEP = 0.01
"""Fraction of the surface's extent: an outline stands before what is farther away than this."""

BRIDGED, TICK = 6.0, 3.0
"""Pixels: shorter pieces of a fold that are no outline are drawn between others; shorter outlines are not drawn."""


_found: WeakKeyDictionary[HiddenLineRemoval, list[Line]] = WeakKeyDictionary()


def outlines(sight: HiddenLineRemoval) -> list[Line]:
    """Return the outlines, found once for all that is seen alike, see `_outlines`."""
    if sight not in _found:
        _found[sight] = _outlines(sight)
    return _found[sight]


def _outlines(sight: HiddenLineRemoval) -> list[Line]:
    """Return lines (k, 2) in pixels, each with whether its last point joins its first.

    An outline lies on folds, edges whose faces lie to the same side of them in the picture or that have not two faces.
    Folds within the surface's own roughness, where what lies beside is as near as they are, are none.
    """
    folds, inner = _folds(sight)
    at = sight.lifted(sight.at)
    ends = at[folds]
    hidden, start, stop = sight.occlusion.intervals(ends, np.concatenate([folds, folds], axis=1))
    # Each visible piece joins two nodes: the fold's ends have the vertices' ids, others one of their own.
    edge, low, high = _outside(len(folds), hidden, start, stop)
    count = len(at)
    fresh = count + np.arange(2 * len(edge)).reshape(-1, 2)
    nodes = np.where(np.stack([low == 0, high == 1], 1), folds[edge], fresh)
    places = np.concatenate([at, np.stack([_between(ends[edge], s) for s in (low, high)], 1).reshape(-1, 3)])
    drawn = _is_outline(sight, places[nodes], inner[edge])
    return _lines(nodes, places[:, :2], drawn)


def _folds(sight: HiddenLineRemoval) -> tuple[AnyArray, AnyArray]:
    """Return edges (k, 2) at which the surface turns away, ends, or meets more than one other face, and a vertex of a
    face at each (k,), on the side where the surface is; -1 where that is both sides."""
    f, at = sight.faces, sight.at[:, :2]
    half = np.stack([f, np.roll(f, -1, axis=1)], -1).reshape(-1, 2)
    opposite = np.roll(f, -2, axis=1).ravel()
    half.sort(axis=1)
    key = half[:, 0] * len(at) + half[:, 1]
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.append(True, np.diff(key[order]) != 0))
    count = np.diff(np.append(first, len(order)))
    edges = half[order[first]]
    two = count == 2
    a, b = (at[edges[two, k]] for k in range(2))
    one, other = (at[opposite[order[first[two] + k]]] for k in range(2))
    fold = ~two
    fold[two] = cross(b - a, one - a) * cross(b - a, other - a) >= 0
    fold &= np.isfinite(at[edges]).all(axis=(1, 2))
    inner = np.where(count > 2, -1, opposite[order[first]])
    return edges[fold], inner[fold]


def _outside(count: int, edge: AnyArray, start: AnyArray, stop: AnyArray) -> tuple[AnyArray, ...]:
    """Return edges (k,) of `count`, and from where to where (k,) each is outside of intervals, which are in order."""
    edges = np.concatenate([np.arange(count), edge])
    lows, order = np.concatenate([np.zeros(count), stop]), np.argsort(edges, kind="stable")
    ends = np.concatenate([edge, np.arange(count)])
    highs, behind = np.concatenate([start, np.ones(count)]), np.argsort(ends, kind="stable")
    edges, lows, highs = edges[order], lows[order], highs[behind]
    kept = highs > lows
    return edges[kept], lows[kept], highs[kept]


def _is_outline(sight: HiddenLineRemoval, pieces: FloatArray, inner: IntArray) -> BoolArray:
    """Return whether pieces (k, 2, 3) of folds stand well before what is seen beside them, (k,)."""
    a, b = pieces[:, 0], pieces[:, 1]
    middle, way = (a + b) / 2, b[:, :2] - a[:, :2]
    length = np.linalg.norm(way, axis=1)
    out = np.stack([way[:, 1], -way[:, 0]], 1) / np.maximum(length, 1e-300)[:, None]
    arm = sight.at[inner, :2] - middle[:, :2]
    out *= -np.sign((out * arm).sum(axis=1))[:, None]
    beside = sight.occlusion.nearest(middle[:, :2] + BESIDE * out)
    behind = sight.depth(beside) - sight.depth(middle[:, 2])
    is_outline: BoolArray = (inner < 0) | (np.abs(behind) > STEP * sight.extent)
    return is_outline


def _between(ends: FloatArray, share: FloatArray) -> FloatArray:
    places: FloatArray = ends[:, 0] + share[:, None] * (ends[:, 1] - ends[:, 0])
    return places


def _lines(nodes: AnyArray, places: FloatArray, drawn: AnyArray) -> list[Line]:
    """Put segments (k, 2) of nodes at places (n, 2) end to end, without those that are not to be drawn (k,).

    Gaps are bridged, and ticks left out.
    """
    found = {frozenset(pair): bool(d) for pair, d in zip(nodes.tolist(), drawn.tolist(), strict=True)}
    kept: list[AnyArray] = []
    for chain, closed in chains(nodes):
        ring = np.append(chain, chain[0]) if closed else chain
        length = np.linalg.norm(np.diff(places[ring], axis=0), axis=1)
        is_drawn = np.array(
            [found[frozenset(pair)] for pair in zip(ring[:-1].tolist(), ring[1:].tolist(), strict=True)]
        )
        is_drawn = _bridged(is_drawn, length)
        kept.append(np.stack([ring[:-1], ring[1:]], 1)[is_drawn])
    segments = np.concatenate(kept) if kept else np.empty((0, 2), int)
    if not len(segments):
        return []
    segments = segments[_long_enough(segments, places)]
    return [(places[chain], closed) for chain, closed in chains(segments)]


def _bridged(drawn: AnyArray, length: AnyArray) -> AnyArray:
    """Return which segments (k,) of these lengths are drawn, with short gaps between others filled."""
    bounds = np.flatnonzero(np.diff(drawn)) + 1
    total = np.append(0.0, np.cumsum(length))
    result = drawn.copy()
    for a, b in pairwise(bounds):
        if not drawn[a] and total[b] - total[a] < BRIDGED:
            result[a:b] = True
    return result


def _long_enough(segments: IntArray, places: FloatArray) -> BoolArray:
    """Return whether the connected piece that each segment (k, 2) is part of is long enough, (k,)."""
    ids, index = np.unique(segments, return_inverse=True)
    pair = index.reshape(-1, 2)
    graph = coo_array((np.ones(len(pair)), (pair[:, 0], pair[:, 1])), shape=(len(ids), len(ids)))
    _, part = connected_components(graph, directed=False)
    length = np.linalg.norm(places[segments[:, 1]] - places[segments[:, 0]], axis=1)
    is_long: BoolArray = np.bincount(part[pair[:, 0]], length)[part[pair[:, 0]]] >= TICK
    return is_long
