"""The benchmark's meshes: made here, in seconds at any size, the same every time.

Each maker takes about how many vertices to make and returns (vertices (n, 3) float64, faces (m, 3) int64).  Vertex
numbers are shuffled where the construction would give them an order that a solver could profit from.
"""

from collections.abc import Callable

import numpy as np

from app.scene.picking import z_order

Arrays = tuple[np.ndarray, np.ndarray]


def bumpy_sphere(n: int, seed: int = 0) -> Arrays:
    """Closed, genus 0, irregular: a jittered icosphere with points added in some of its faces, its edges flipped
    until they are Delaunay, its radius varied."""
    x, faces = _icosphere(max(1, round(np.sqrt(n / 15))))
    random = np.random.default_rng(seed)
    x += 0.9 / np.sqrt(len(x)) * random.uniform(-1, 1, x.shape)
    split = random.random(len(faces)) < 0.25
    a, b, c = faces[split].T
    new = len(x) + np.arange(len(a))
    faces = np.concatenate(
        [faces[~split], *(np.stack(corners, 1) for corners in [(a, b, new), (b, c, new), (c, a, new)])]
    )
    x = np.concatenate([x, x[a] + x[b] + x[c]])
    x /= np.linalg.norm(x, axis=1)[:, None]
    for _ in range(10):
        if _flip_edges(x, faces) < len(faces) / 1000:
            break
    a, b, c = x.T
    x *= (1 + 0.2 * np.sin(5 * a) * np.cos(4 * b) + 0.1 * np.sin(7 * c + 2 * a))[:, None]
    return _shuffled(x, faces, random)


def genus_two(n: int) -> Arrays:
    """Closed, genus 2, ten times as long as wide, with triangles stretched up to 1 : 20: an inflated plate with two
    holes."""
    rows = max(9, round(np.sqrt(n / 5.4)) | 1)
    columns = 3 * rows
    solid = np.ones((rows, columns), bool)
    third, thin = rows // 3, columns // 7
    for start in (2 * thin, 4 * thin):
        solid[third : rows - third, start : start + thin] = False
    # Columns crowd towards one end.
    along = np.cumsum(0.2 + 3 * np.linspace(0, 1, columns + 1) ** 2)
    flat = np.stack(np.meshgrid(10 * along / along[-1], np.linspace(0, 1, rows + 1)), -1)
    inside = np.pad(solid, 1)
    touching = inside[:-1, :-1].astype(int) + inside[1:, :-1] + inside[:-1, 1:] + inside[1:, 1:]
    depth = np.minimum(_steps_to(touching < 4), 8) / 8
    used, inner = touching > 0, touching == 4
    top = np.full(touching.shape, -1)
    top[used] = np.arange(used.sum())
    bottom = top.copy()
    bottom[inner] = used.sum() + np.arange(inner.sum())
    height = 0.15 * np.sqrt(depth)
    x = np.concatenate([np.c_[flat[used], height[used]], np.c_[flat[inner], -height[inner]]])
    r, q = np.nonzero(solid)
    # Other diagonals below than above, or a corner would have the same face on both sides.
    faces = np.concatenate([_cells(top, r, q), _cells(bottom, r, q, parity=1)[:, ::-1]])
    random = np.random.default_rng(0)
    x[:, 1] += 0.15 / rows * random.standard_normal(len(x))
    return _shuffled(x, faces, random)


def folded_sheet(n: int, layers: int = 40) -> Arrays:
    """With boundary: a strip folded to 40 layers, far apart along the sheet and close in space."""
    across = max(4, round(np.sqrt(n / layers)))
    along = layers * across
    u, v = np.meshgrid(np.arange(along + 1), np.arange(across + 1), indexing="ij")
    layer, inside = np.divmod(u / across, 1)
    x = np.where(layer % 2 == 0, inside, 1 - inside)
    random = np.random.default_rng(0)
    shape = np.stack([x, v / across, 0.02 * u / across], -1).reshape(-1, 3)
    shape[:, :2] += 0.15 / across * random.standard_normal((len(shape), 2))
    number = np.arange(u.size).reshape(u.shape)
    r, q = (k.ravel() for k in np.meshgrid(np.arange(along), np.arange(across), indexing="ij"))
    return _shuffled(shape, _cells(number, r, q), random)


def needle(n: int, around: int = 24) -> Arrays:
    """With boundary: a tube of 24 vertices around, as long as it takes."""
    along = max(2, n // around)
    u, v = np.meshgrid(np.arange(along), np.arange(around), indexing="ij")
    turn = 2 * np.pi * (v + u / 2) / around
    edge = 2 * np.sin(np.pi / around)
    x = np.stack([np.cos(turn), np.sin(turn), u * edge * np.sqrt(3) / 2], -1).reshape(-1, 3)
    random = np.random.default_rng(0)
    x += 0.1 * edge * random.standard_normal(x.shape)
    number = np.pad(np.arange(u.size).reshape(u.shape), ((0, 0), (0, 1)), mode="wrap")
    r, q = (k.ravel() for k in np.meshgrid(np.arange(along - 1), np.arange(around), indexing="ij"))
    return _shuffled(x, _cells(number, r, q), random)


MAKERS: dict[str, Callable[[int], Arrays]] = {
    "bumpy sphere": bumpy_sphere,
    "genus 2": genus_two,
    "folded sheet": folded_sheet,
    "needle": needle,
}


def along_curve(x: np.ndarray, faces: np.ndarray) -> Arrays:
    """The same mesh, its vertices numbered along Morton's curve and its faces sorted by their first one."""
    cells = ((x - x.min(axis=0)) / np.ptp(x, axis=0).max() * 1023).astype(np.int64)
    order = np.argsort(z_order(cells.T, 10), kind="stable")
    new = np.empty_like(order)
    new[order] = np.arange(len(x))
    faces = new[faces]
    return x[order], faces[np.argsort(faces.min(axis=1), kind="stable")]


def _shuffled(x: np.ndarray, faces: np.ndarray, random: np.random.Generator) -> Arrays:
    new = random.permutation(len(x))
    result = np.empty_like(x)
    result[new] = x
    return result, random.permutation(new[faces])


def _cells(number: np.ndarray, r: np.ndarray, q: np.ndarray, parity: int = 0) -> np.ndarray:
    """(2k, 3) two triangles for each cell (r, q) of a grid of vertex numbers; the diagonals alternate."""
    a, b, c, d = number[r, q], number[r + 1, q], number[r + 1, q + 1], number[r, q + 1]
    even = (r + q) % 2 == parity
    first = np.where(even, [a, b, c], [a, b, d])
    second = np.where(even, [a, c, d], [b, c, d])
    return np.concatenate([first.T, second.T]).astype(np.int64)


def _steps_to(goal: np.ndarray, most: int = 8) -> np.ndarray:
    """Grid steps to the nearest true entry, at most `most`."""
    steps, reached = np.where(goal, 0, most), goal
    for step in range(1, most):
        grown = np.pad(reached, 1)
        grown = grown[1:-1, 1:-1] | grown[:-2, 1:-1] | grown[2:, 1:-1] | grown[1:-1, :-2] | grown[1:-1, 2:]
        steps[grown & ~reached] = step
        reached = grown
    return steps


def _icosphere(frequency: int) -> Arrays:
    """The unit icosahedron, each edge cut into `frequency`: 10 frequency^2 + 2 vertices."""
    golden = (1 + 5**0.5) / 2
    corners = np.array([[0, i, j * golden] for i in (-1, 1) for j in (-1, 1)])
    corners = np.concatenate([np.roll(corners, k, axis=1) for k in range(3)])
    near = np.linalg.norm(corners[:, None] - corners, axis=2) < 2.1
    triples = [
        (a, b, c) for a in range(12) for b in range(a) for c in range(b) if near[a, b] and near[b, c] and near[a, c]
    ]
    f = frequency
    i, j = (k.ravel() for k in np.meshgrid(np.arange(f + 1), np.arange(f + 1), indexing="ij"))
    i, j = i[i + j <= f], j[i + j <= f]
    place = np.zeros((f + 2, f + 2), np.int64)
    place[i, j] = np.arange(len(i))
    up, down = i + j < f, i + j < f - 1
    patch = np.concatenate(
        [
            np.stack([place[i, j], place[i + 1, j], place[i, j + 1]], 1)[up],
            np.stack([place[i + 1, j], place[i + 1, j + 1], place[i, j + 1]], 1)[down],
        ]
    )
    points, faces = [], []
    for t, (a, b, c) in enumerate(triples):
        outward = np.linalg.det(corners[[a, b, c]]) > 0
        b, c = (b, c) if outward else (c, b)
        points.append(((f - i - j)[:, None] * corners[a] + i[:, None] * corners[b] + j[:, None] * corners[c]) / f)
        faces.append(patch + t * len(i))
    x = np.concatenate(points)
    # The patches share the vertices of their rims, up to rounding.
    key = np.round(x * (1e5, 1e5, 1e5)).astype(np.int64) @ (1, 1 << 20, 1 << 40)
    _, first, same = np.unique(key, return_index=True, return_inverse=True)
    x = x[first]
    return x / np.linalg.norm(x, axis=1)[:, None], same[np.concatenate(faces)]


def _flip_edges(x: np.ndarray, faces: np.ndarray) -> int:
    """Flip edges of a closed surface round the origin that are not Delaunay, each face at most once; how many."""
    n, m = len(x), len(faces)
    a, b = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    forth = a < b
    key = np.where(forth, a * n + b, b * n + a)
    order = np.argsort(key, kind="stable")
    one, two = order[0::2], order[1::2]
    f, g = one // 3, two // 3
    p, q = faces[f, one % 3], faces[f, (one + 1) % 3]
    r, s = faces[f, (one + 2) % 3], faces[g, (two + 2) % 3]

    def angle(apex: np.ndarray) -> np.ndarray:
        u, v = x[p] - x[apex], x[q] - x[apex]
        return np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v))

    def outward(i: np.ndarray, j: np.ndarray, k: np.ndarray) -> np.ndarray:
        return np.einsum("ij,ij->i", np.cross(x[i], x[j]), x[k]) > 0

    bad = (angle(r) + angle(s) > np.pi) & outward(r, p, s) & outward(s, q, r)
    bad = np.flatnonzero(bad)
    # An edge is flipped if it is the first of both its faces.
    first = np.full(m, len(f))
    np.minimum.at(first, f[bad], bad)
    np.minimum.at(first, g[bad], bad)
    bad = bad[(first[f[bad]] == bad) & (first[g[bad]] == bad)]
    faces[f[bad]] = np.stack([r[bad], p[bad], s[bad]], 1)
    faces[g[bad]] = np.stack([s[bad], q[bad], r[bad]], 1)
    return len(bad)
