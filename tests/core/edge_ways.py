"""Upper bounds of geodesic distances that come close to them, found without unfolding: ways that bend on edges only.

A shortest way between fixed points of edges, over the straight lines in faces, gives the edges that a path passes; then
its bends slide along these edges, until the path is as short as they allow.
"""

from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise

import numpy as np
import numpy.typing as npt
from scipy.sparse.csgraph import csgraph_from_dense, dijkstra

from tests.core.geodesic_reference import FacePoint, FaceSegment, Origin, Weights

Floats = npt.NDArray[np.float64]

_NEAR_END = 0.25 ** np.arange(12, 1, -1)
POSITIONS = np.concatenate([_NEAR_END, np.arange(1, 8) / 8, 1 - _NEAR_END[::-1]])
"""Of the fixed points of an edge from 0 to 1: close together at its ends, so that a way can pass close to a vertex."""
_GAPS = np.diff(np.concatenate([[0], POSITIONS, [1]]))
STEPS = np.maximum(_GAPS[:-1], _GAPS[1:])


def edge_ways(vertices: Floats, faces: npt.NDArray[np.int64], origin: Origin, points: Sequence[FacePoint]) -> Floats:
    """(n + k,) lengths of ways from the origin to all vertices (n, 3) and points, infinite where there is none.

    No face (m, 3) may name a vertex twice.
    """
    pieces = [
        (x, x, 0.0, 0.0) for x in vertices
    ]  # ends of what a bend slides along, its position from 0 to 1, its step
    inside = [list(face) for face in faces]
    on_edge: dict[tuple[int, int], range] = {}
    for face, nodes in zip(faces.tolist(), inside, strict=True):
        for a, b in combinations(sorted(face), 2):
            if (a, b) not in on_edge:
                on_edge[a, b] = range(len(pieces), len(pieces) + len(POSITIONS))
                pieces += [(vertices[a], vertices[b], *each) for each in zip(POSITIONS, STEPS, strict=True)]
            nodes += on_edge[a, b]
    targets = [*range(len(vertices)), *range(len(pieces), len(pieces) + len(points))]
    for point in points:
        inside[point.face].append(len(pieces))
        x = coordinates(vertices, faces, point.face, point.weights)
        pieces.append((x, x, 0.0, 0.0))
    start = len(pieces)
    if isinstance(origin, FaceSegment):
        ends = [coordinates(vertices, faces, origin.face, weights) for weights in (origin.start, origin.end)]
    elif isinstance(origin, FacePoint):
        ends = [coordinates(vertices, faces, origin.face, origin.weights)] * 2
    else:
        ends = [vertices[origin]] * 2
    pieces.append((ends[0], ends[1], 0.5, 0.5))
    low, high, at, step = (np.array(column) for column in zip(*pieces, strict=True))
    x = low + at[:, None] * (high - low)
    lengths = np.full((start + 1, start + 1), np.inf)
    for nodes in inside:
        lengths[np.ix_(nodes, nodes)] = np.linalg.norm(x[nodes][:, None] - x[nodes], axis=2)
    if isinstance(origin, FacePoint | FaceSegment):
        nodes = inside[origin.face]
        lengths[start, nodes] = from_segment(x[nodes], *ends)
    else:
        lengths[start, origin] = 0
    graph = csgraph_from_dense(lengths, null_value=np.inf)
    found, before = dijkstra(graph, indices=start, return_predecessors=True)
    for target in targets:
        if np.isfinite(found[target]):
            way = list(_way(target, start, before))
            found[target] = _straightened(low[way], high[way], at[way], step[way])
    return np.asarray(found[targets], float)


def coordinates(vertices: Floats, faces: npt.NDArray[np.int64], face: int, weights: Weights) -> Floats:
    """(d,) those of a place in a face."""
    return np.asarray(np.array(weights, float) @ vertices[faces[face]] / float(sum(weights)))


def from_segment(points: Floats, p: Floats, q: Floats) -> Floats:
    """(k,) Euclidean distances of points (k, d) from the segment between p and q (d,), which may be the same."""
    along = q - p
    t = np.clip((points - p) @ along / (along @ along), 0, 1) if along.any() else np.zeros(len(points))
    return np.asarray(np.linalg.norm(points - p - t[:, None] * along, axis=1))


def _way(node: int, start: int, before: npt.NDArray[np.int32]) -> Iterator[int]:
    while node != start:
        yield node
        node = before[node]
    yield start


def _straightened(low: Floats, high: Floats, at: Floats, steps: Floats) -> float:
    """The least length of a chain of points between low and high (k, d), sought by steps (k,) around positions at (k,).

    The length is a convex function of the positions.  In each round the best of nine at each point are chosen.
    """
    shortest = np.inf
    for _ in range(30):
        tried = np.clip(at[:, None] + steps[:, None] * np.linspace(-1, 1, 9), 0, 1)
        x = low[:, None] + tried[:, :, None] * (high - low)[:, None]
        cost, choices = np.zeros(9), []
        for here, there in pairwise(x):
            through = cost[:, None] + np.linalg.norm(here[:, None] - there, axis=2)
            choices.append(through.argmin(axis=0))
            cost = through.min(axis=0)
        k = int(cost.argmin())
        shortest, chosen = min(shortest, float(cost[k])), [k]
        for choice in reversed(choices):
            chosen.append(int(choice[chosen[-1]]))
        at, steps = tried[np.arange(len(at)), chosen[::-1]], 0.6 * steps
    return shortest
