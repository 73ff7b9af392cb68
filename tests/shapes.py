"""Small surfaces named for what they are, made here; and where the shared meshes and reference distances lie."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from bihdist_core import Surface
from bihdist_core.kernel.library import library

SHARED = Path(__file__).resolve().parents[2] / "shared"
MESHES = SHARED / "meshes"
ORACLE = SHARED / "oracle"
ORACLE_NAMES = ("hand_lowres_boundary", "pelvis_genus1", "spot", "lilium_boundary")

needs_meshes = pytest.mark.skipif(not MESHES.is_dir(), reason="the shared meshes are not here")
needs_kernel = pytest.mark.skipif(library() is None, reason="there is no compiled kernel")
needs_oracle = pytest.mark.skipif(not ORACLE.is_dir(), reason="the shared reference distances are not here")


def oracle_surface(name: str) -> Surface:
    """The mesh of shared reference distances, read by nothing of ours."""
    words = (ORACLE / f"{name}.off").read_text().split()
    n, m = int(words[1]), int(words[2])
    vertices = np.array(words[4 : 4 + 3 * n], float).reshape(n, 3)
    return Surface(vertices, np.array(words[4 + 3 * n : 4 + 3 * n + 4 * m], int).reshape(m, 4)[:, 1:])


def sphere(n: int, seed: int = 0) -> Surface:
    """Closed, genus 0: n points spread over the unit sphere, slightly irregular, in random order."""
    rng = np.random.default_rng(seed)
    k = np.arange(n) + 0.5
    polar, turn = np.arccos(1 - 2 * k / n), np.pi * (1 + 5**0.5) * k
    x = np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], 1)
    x += 0.3 / np.sqrt(n) * rng.standard_normal((n, 3))
    return _hull(rng.permutation(x / np.linalg.norm(x, axis=1)[:, None]), "sphere")


def bumpy(n: int, seed: int = 0) -> Surface:
    """Closed, genus 0, no symmetry: a sphere whose radius varies."""
    s = sphere(n, seed)
    x, y, z = s.vertices.T
    radius = 1 + 0.2 * np.sin(5 * x) * np.cos(4 * y) + 0.1 * np.sin(7 * z + 2 * x)
    return Surface(s.vertices * radius[:, None], s.faces, "bumpy")


def _hull(x: np.ndarray, name: str) -> Surface:
    faces = ConvexHull(x).simplices
    a, b, c = (x[faces[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a) < 0
    faces[inward] = faces[inward][:, ::-1]
    return Surface(x, faces, name)


def grid(columns: int, rows: int) -> Surface:
    """A flat rectangle of unit squares, each cut along the same diagonal: with boundary, right angles everywhere."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    a, b, c, d = corner, corner + 1, corner + columns + 2, corner + columns + 1
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return Surface(np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], 1), faces, "grid")


def graded(n: int, ratio: float, height: float = 0.1) -> Surface:
    """A wavy square of n x n cells, each a ratio smaller than the one before it towards one corner."""
    at = np.append(0, ratio ** np.arange(n)[::-1])
    x, y = (q.ravel() for q in np.meshgrid(at, at))
    return Surface(np.stack([x, y, height * np.sin(3 * y + x)], 1), grid(n, n).faces, "graded")


def plate(columns: int, rows: int, height: float) -> Surface:
    """A closed box of so many cells and one cell high: its sides are thin faces where the height is small."""
    flat = grid(columns, rows)
    n, x = len(flat.vertices), flat.vertices / columns
    rim = np.concatenate([flat.faces[:, [k, (k + 1) % 3]] for k in range(3)])
    inner = {(b, a) for a, b in rim.tolist()}
    a, b = np.array([side for side in rim.tolist() if tuple(side) not in inner]).T
    sides = np.concatenate([np.stack([a, b, a + n], 1), np.stack([b, b + n, a + n], 1)])
    faces = np.concatenate([flat.faces[:, ::-1], flat.faces + n, sides])
    return Surface(np.concatenate([x, np.add(x, (0, 0, height))]), faces, "plate")


def torus(around: int = 24, across: int = 12) -> Surface:
    """Closed, genus 1."""
    u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
    x = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], -1).reshape(-1, 3)
    i, j = (q.ravel() for q in np.meshgrid(np.arange(around), np.arange(across), indexing="ij"))
    a, b = i * across + j, (i + 1) % around * across + j
    c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
    return Surface(x, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]), "torus")


def tetrahedron() -> Surface:
    """The smallest closed surface."""
    return Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], "tetra")


def two_pieces() -> Surface:
    """A sphere of 60 vertices, a tetrahedron beside it (ids 61 to 64), and vertex 60 that no face uses."""
    s, t = sphere(60), tetrahedron()
    vertices = np.concatenate([s.vertices, [[9.0, 9, 9]], t.vertices + 5])
    return Surface(vertices, np.concatenate([s.faces, t.faces + 61]), "two pieces")


def fin() -> Surface:
    """Not manifold: three faces on one edge, and two fans that touch in one vertex (id 5)."""
    x = [[0, 0, 0], [0, 0, 1], [1, 0, 0.5], [-1, 0.3, 0.5], [-0.2, 1, 0.5], [1, 1, 2], [2, 1, 2], [2, 2, 2]]
    return Surface(x, [[0, 1, 2], [0, 1, 3], [0, 1, 4], [1, 2, 5], [5, 6, 7]], "fin")


def slivers() -> Surface:
    """A grid with a face of no area glued in (vertex in the middle of an edge) and one that is nearly so."""
    g = grid(3, 3)
    vertices = np.concatenate([g.vertices, [[0.5, 0, 0], [1.5, -1e-6, 0]]])
    return Surface(vertices, np.concatenate([g.faces, [[0, 16, 1], [1, 17, 2]]]), "slivers")


def caps(s: Surface, height: float, every: int, at: float = 0.5) -> Surface:
    """Beside every so-manieth face abc an obtuse one: a vertex over ab, at a share of it and of a height in edges."""
    x, faces = [*s.vertices], [tuple(f) for f in s.faces]
    for q in range(0, len(s.faces), every):
        a, b, c = s.faces[q]
        i = len(x)
        x.append(_over(s.vertices, a, b, c, at, height))
        faces[q] = (a, i, c)
        faces += [(i, b, c), (a, b, i)]
    return Surface(np.array(x), faces, "caps")


def folded(s: Surface, height: float, every: int) -> Surface:
    """Two obtuse faces on one edge, one beside the other: the way from a to b goes through two vertices."""
    x, faces = [*s.vertices], [tuple(f) for f in s.faces]
    for q in range(0, len(s.faces), every):
        a, b, c = s.faces[q]
        i = len(x)
        x += [_over(s.vertices, a, b, c, 0.4, height), _over(s.vertices, a, b, c, 0.65, 2 * height)]
        faces[q] = (a, i, c)
        faces += [(i, i + 1, c), (i + 1, b, c), (a, b, i), (i, b, i + 1)]
    return Surface(np.array(x), faces, "folded")


def needles(s: Surface, height: float, every: int) -> Surface:
    """In every so-manieth face abc a vertex close to a, at a share of the way to the middle of bc."""
    x, faces = [*s.vertices], [tuple(f) for f in s.faces]
    for q in range(0, len(s.faces), every):
        a, b, c = s.faces[q]
        i = len(x)
        x.append(x[a] + height * ((x[b] + x[c]) / 2 - x[a]))
        faces[q] = (i, b, c)
        faces += [(a, b, i), (a, i, c)]
    return Surface(np.array(x), faces, "needles")


def _over(x: np.ndarray, a: int, b: int, c: int, at: float, height: float) -> np.ndarray:
    along = x[b] - x[a]
    across = x[c] - x[a]
    across = across - along * (across @ along) / (along @ along)
    return x[a] + at * along + height * np.linalg.norm(along) * across / np.linalg.norm(across)


def glued(keys: np.ndarray, x: np.ndarray, name: str = "glued") -> Surface:
    """Faces (m,) with their corners at x (m, 3, 3), which are one vertex where their keys (m, 3, k) are equal."""
    _, first, inverse = np.unique(keys.reshape(-1, keys.shape[2]), axis=0, return_index=True, return_inverse=True)
    return Surface(x.reshape(-1, 3)[first], inverse.reshape(-1, 3), name)


def divided(vertices: np.ndarray, faces: np.ndarray, k: int) -> tuple[Surface, np.ndarray]:
    """Each face (m, 3) cut into k x k, one after the other, and the new corners (k k m, 3, 3) as k times their weights
    in the face."""
    i, j = np.array([(i, j) for i in range(k) for j in range(k - i)]).T
    inner = i + j < k - 1
    up = np.stack([i, j], 1)[:, None] + [[0, 0], [1, 0], [0, 1]]
    down = np.stack([i[inner], j[inner]], 1)[:, None] + [[1, 0], [1, 1], [0, 1]]
    ij = np.concatenate([up, down])
    weights = np.tile(np.concatenate([k - ij.sum(axis=2, keepdims=True), ij], axis=2), (len(faces), 1, 1))
    old = np.repeat(faces, k * k, axis=0)
    # A new vertex is known by the old ones that it lies between, and its weights there.
    between = np.where(weights > 0, old[:, None], -1)
    order = between.argsort(axis=2)
    keys = np.concatenate([np.take_along_axis(each, order, axis=2) for each in (between, weights)], axis=2)
    return glued(keys, np.einsum("qcw,qwx->qcx", weights, vertices[old]) / k, "divided"), weights


def spike(n: int, length: float) -> Surface:
    """A bumpy sphere with one vertex, 7, far away."""
    s = bumpy(n)
    x = s.vertices.copy()
    x[7] *= length
    return Surface(x, s.faces, "spike")


def components_apart(s: Surface) -> list[np.ndarray]:
    """The vertex ids of each component."""
    return [np.flatnonzero(s.component_of_vertex == k) for k in range(s.n_components)]
