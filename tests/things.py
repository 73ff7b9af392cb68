"""Surfaces of things as programs for modelling write them, with y up and their front towards z."""

import numpy as np

from bihdist_core import Surface

Piece = tuple[np.ndarray, np.ndarray]
"""Vertices (n, 3) and faces (m, 3)."""


def box(low, high, n=2) -> Piece:
    """From one corner to the other, each side n x n squares."""
    t = np.linspace(0, 1, n + 1)
    a, b = (x.ravel() for x in np.meshgrid(t, t, indexing="ij"))
    points, faces = [], []
    for k in range(3):
        for side in (0, 1):
            square = np.zeros((len(a), 3))
            square[:, (k + 1) % 3], square[:, (k + 2) % 3], square[:, k] = a, b, side
            quads = sheet_faces(n + 1, n + 1)
            faces.append((quads if side else quads[:, ::-1]) + len(a) * len(points))
            points.append(square)
    unique, places = np.unique(np.round(np.concatenate(points), 9), axis=0, return_inverse=True)
    low = np.array(low, float)
    return low + unique * (np.array(high) - low), places.ravel()[np.concatenate(faces)]


def wheel(centre, radius, width, axis=0, n=48) -> Piece:
    """A closed cylinder along an axis."""
    a, across = np.arange(n) * 2 * np.pi / n, [(axis + 1) % 3, (axis + 2) % 3]
    ring, along = np.zeros((n, 3)), np.eye(3)[axis] * width / 2
    ring[:, across] = radius * np.stack([np.cos(a), np.sin(a)], 1)
    i, j, middle = np.arange(n), (np.arange(n) + 1) % n, np.zeros(n, int) + 2 * n
    faces = [[i, j, j + n], [i, j + n, i + n], [j, i, middle], [i + n, j + n, middle + 1]]
    points = np.concatenate([ring - along, ring + along, [-along, along]]) + centre
    return points, np.concatenate([np.stack(each, 1) for each in faces])


def joined(*pieces: Piece) -> Surface:
    """One surface of many components."""
    starts = np.cumsum([0, *(len(points) for points, _ in pieces)])
    faces = [faces + start for (_, faces), start in zip(pieces, starts, strict=False)]
    return Surface(np.concatenate([points for points, _ in pieces]), np.concatenate(faces))


def truck() -> Surface:
    """A box truck; below it the exhaust pipe hangs lower than the wheels, and its wheels have most of the vertices."""
    return joined(
        box((-1.2, 0.9, -4), (1.2, 3.6, 1.5), 4),
        box((-1.1, 0.6, 1.6), (1.1, 2.6, 3.2)),
        box((-0.9, 0.5, -4), (0.9, 0.8, 3.2)),
        box((-1.2, 0.5, 3.2), (1.2, 0.75, 3.4)),
        box((1.1, -0.3, 1.3), (1.2, 0.5, 1.5)),
        *(wheel((x, 0.5, z), 0.5, 0.35, n=80) for x in (-1, 1) for z in (-3.0, -1.8, 2.3)),
    )


def chair() -> Surface:
    """A seat and a back of few vertices on legs of many."""
    legs = [wheel((x, 0.25, z), 0.04, 0.5, 1) for x in (-0.45, 0.45) for z in (-0.45, 0.45)]
    return joined(box((-0.5, 0.5, -0.5), (0.5, 0.58, 0.5)), box((-0.5, 0.58, -0.5), (0.5, 1.3, -0.44), 1), *legs)


def guitar() -> Surface:
    """A closed plate across z, its neck up."""
    y, u = np.linspace(0, 5, 121)[:, None], np.linspace(-1, 1, 13)
    body = 0.95 * np.sqrt(np.clip(1 - ((y - 1.0) / 1.02) ** 2, 0, 1)) * (1 - 0.25 * np.exp(-(((y - 1.25) / 0.25) ** 2)))
    x = np.maximum(body, np.where(y < 4.4, 0.14, 0.24)) * u
    one = np.stack([x, y + 0 * x, 0.08 + 0 * x], -1).reshape(-1, 3)
    count, faces, ids = len(one), sheet_faces(*x.shape)[:, ::-1], np.arange(x.size).reshape(x.shape)
    rim = np.concatenate([ids[0, :-1], ids[:-1, -1], ids[-1, :0:-1], ids[:0:-1, 0]])
    after = np.roll(rim, -1)
    sides = [np.stack([rim, rim + count, after + count], 1), np.stack([rim, after + count, after], 1)]
    return Surface(np.concatenate([one, one * [1, 1, -1]]), np.concatenate([faces, faces[:, ::-1] + count, *sides]))


def strip(n=160, across=10) -> Surface:
    """A Moebius strip about the z axis."""
    a, u = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.linspace(-0.35, 0.35, across), indexing="ij")
    radius = 1 + u * np.cos(a / 2)
    points = np.stack([radius * np.cos(a), radius * np.sin(a), u * np.sin(a / 2)], -1).reshape(-1, 3)
    ids = np.concatenate([np.arange(n * across), np.arange(across)[::-1]])  # it closes upside down
    return Surface(points, ids[sheet_faces(n + 1, across)])


def pizza(n=96) -> Surface:
    """An open disc across y with a rim, its outside up."""
    radii = np.linspace(0, 1, 25)[1:, None]
    heights, a = 0.08 * np.exp(-(((radii - 0.92) / 0.05) ** 2)), np.arange(n + 1) * 2 * np.pi / n
    rings = np.stack([radii * np.cos(a), heights + 0 * a, -radii * np.sin(a)], -1)[:, :-1].reshape(-1, 3)
    ids = np.arange(len(rings)).reshape(-1, n)
    faces = np.concatenate([ids, ids[:, :1]], 1).ravel()[sheet_faces(len(radii), n + 1)]
    i = np.arange(n)
    middle = np.stack([np.full(n, len(rings)), i, (i + 1) % n], 1)
    return Surface(np.concatenate([rings, np.zeros((1, 3))]), np.concatenate([faces, middle]))


def sheet_faces(rows, columns) -> np.ndarray:
    """(m, 3) the triangles of a grid, numbered row by row."""
    ids = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (each.ravel() for each in (ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]))
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
