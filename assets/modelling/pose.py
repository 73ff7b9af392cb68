"""Move a meshed solid into another pose, nearly without stretching it.

The inside is filled with tetrahedra, so that flesh keeps its volume; the core of each bone is carried along rigidly,
and the rest follows as rigidly as possible (Sorkine and Alexa, 2007) over the tetrahedra's edges.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, cKDTree

from .fields import Field
from .skeleton import Bone
from .triangles import adjacency, edge_lengths, edges_and_sides

CORE = 0.35
"""Share of a bone's flesh that is carried rigidly; the rest is free to bulge and stretch."""

HOLD = 300.0
"""Weight of the rigid core against the inner edges, whose weights are 1."""

SKIN = 3.0
"""Weight of the skin's edges against the inner ones: its triangles keep their shape."""

Motion = tuple[np.ndarray, np.ndarray]


def posed(
    points: np.ndarray,
    faces: np.ndarray,
    field: Field,
    bones: Mapping[str, Bone],
    motion: Mapping[str, Motion],
    spacing: float,
    rounds: int = 150,
) -> np.ndarray:
    """(n, 3) points of the same mesh in the other pose; inner points lie about `spacing` apart."""
    nodes = np.concatenate([points, _inner_points(points, field, spacing)])
    skin = edges_and_sides(faces)[0]
    links = _inner_edges(nodes, field, spacing)
    springs = (SKIN * adjacency(skin, len(nodes)) + adjacency(links, len(nodes))).tocsr()
    near = np.stack([_distance_to_bone(nodes, bone) / bone.flesh for bone in bones.values()])
    own = near.argmin(axis=0)
    share = _diffused(springs, own, near.min(axis=0), len(bones))
    moves = [motion[name] for name in bones]
    moved = np.stack([nodes @ rotation.T + shift for rotation, shift in moves])
    start = np.einsum("bn,bni->ni", share.T, moved)
    hold = HOLD * _is_rigid(nodes, list(bones.values()), near.min(axis=0), own)
    target = moved[own, np.arange(len(nodes))]
    return _as_rigid_as_possible(nodes, start, springs, hold, target, rounds)[: len(points)]


def _inner_points(points: np.ndarray, field: Field, spacing: float) -> np.ndarray:
    """(k, 3) jittered grid points at least half a spacing under the surface."""
    low, high = points.min(axis=0), points.max(axis=0)
    axes = [np.arange(a, b, spacing) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    # Points of an exact grid share spheres, which Delaunay cannot tell apart.
    grid = grid + np.random.default_rng(0).uniform(-0.2, 0.2, grid.shape) * spacing
    grid = grid[field(grid) < -0.4 * spacing]
    return grid[cKDTree(points).query(grid)[0] > 0.5 * spacing]


def _inner_edges(nodes: np.ndarray, field: Field, spacing: float) -> np.ndarray:
    """(e, 2) edges of Delaunay tetrahedra that run inside the solid and are not much longer than the spacing."""
    tetrahedra = Delaunay(nodes).simplices
    tetrahedra = tetrahedra[field(nodes[tetrahedra].mean(axis=1)) < 0]
    pairs = np.concatenate([tetrahedra[:, [i, j]] for i in range(4) for j in range(i)])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    # Slivers along straight skin have long edges, which would make flesh stiff far away.
    pairs = pairs[edge_lengths(nodes, pairs) < 2.5 * spacing]
    outside = [field(nodes[pairs[:, 0]] * (1 - share) + nodes[pairs[:, 1]] * share) for share in (0.25, 0.5, 0.75)]
    return pairs[np.max(outside, axis=0) < 0.05 * spacing]


def _distance_to_bone(nodes: np.ndarray, bone: Bone) -> np.ndarray:
    """(n,) distances."""
    start, along = np.array(bone.start), np.subtract(bone.end, bone.start)
    share = np.clip((nodes - start) @ along / (along @ along), 0, 1)
    return np.linalg.norm(nodes - start - share[:, None] * along, axis=1)


def _is_rigid(nodes: np.ndarray, bones: Sequence[Bone], depth: np.ndarray, own: np.ndarray) -> np.ndarray:
    """(n,) whether a node is carried along exactly; `depth` (n,) is its distance from its own bone, in flesh radii."""
    out = np.zeros(len(nodes), bool)
    for number, bone in enumerate(bones):
        along = np.subtract(bone.end, bone.start)
        share = (nodes - bone.start) @ along / (along @ along)
        rigid = {
            "core": (depth < CORE) & (share > 0.2) & (share < 0.8),
            "all": (depth < CORE) | (share > 0.3),
            "nothing": np.zeros(len(nodes), bool),
        }
        out |= (own == number) & rigid[bone.rigid]
    return out


def _diffused(springs: sp.csr_matrix, own: np.ndarray, depth: np.ndarray, count: int) -> np.ndarray:
    """(n, count) shares of the bones at each node, blurred across the joints."""
    pull = 0.2 / np.maximum(depth, 0.1) ** 2
    system = sp.diags_array(np.asarray(springs.sum(axis=1)).ravel() + pull) - springs
    share = splu(system.tocsc()).solve(pull[:, None] * np.eye(count)[own])
    return share / share.sum(axis=1, keepdims=True)


def _as_rigid_as_possible(
    rest: np.ndarray, start: np.ndarray, springs: sp.csr_matrix, hold: np.ndarray, target: np.ndarray, rounds: int
) -> np.ndarray:
    """(n, 3) nodes after alternately fitting a rotation to each node's edges and moving all nodes to suit them."""
    n = len(rest)
    springs = springs.tocoo()
    i, j, weight = springs.row, springs.col, springs.data
    laplacian = sp.diags_array(np.bincount(i, weight, n) + hold) - springs
    solve = splu(laplacian.tocsc()).solve
    sum_at = sp.csr_matrix((weight, (i, np.arange(len(i)))), (n, len(i)))
    edge, x = rest[i] - rest[j], start
    for _ in range(rounds):
        spread = (sum_at @ (edge[:, :, None] * (x[i] - x[j])[:, None, :]).reshape(-1, 9)).reshape(-1, 3, 3)
        u, _, vt = np.linalg.svd(spread)
        # No reflections: a node's flesh must not turn inside out.
        u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
        rotation = np.swapaxes(u @ vt, 1, 2)
        wanted = np.einsum("nij,nj->ni", rotation[i] + rotation[j], edge) / 2
        x = solve(sum_at @ wanted + hold[:, None] * target)
    return x
