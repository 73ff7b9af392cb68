"""Kinds of broken meshes: faces that are there twice or turned, and surfaces without an inside."""

import numpy as np

from tests.core.test_geodesic_laws import moebius

from .parts import Kinds, Mesh, Rng, a_few, kind_in, whole

KINDS: Kinds = {}
kind = kind_in(KINDS)


@kind
def doubled_faces(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x, np.concatenate([faces, faces[a_few(len(faces), rng)]])


@kind
def all_faces_doubled_and_turned(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x, np.concatenate([faces, faces[:, ::-1]])


@kind
def flipped_faces(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    some = rng.random(len(faces)) < 0.3
    faces[some] = faces[some][:, ::-1]
    return x, faces


@kind
def inside_out(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x, faces[:, ::-1]


@kind
def moebius_strip(_: Rng) -> Mesh:
    return moebius().vertices, moebius().faces


@kind
def klein_bottle(rng: Rng) -> Mesh:
    """Glued without an inside, and through itself."""
    n, m = 12, 8
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    r = 2 + np.cos(u / 2) * np.sin(v) - np.sin(u / 2) * np.sin(2 * v)
    z = np.sin(u / 2) * np.sin(v) + np.cos(u / 2) * np.sin(2 * v)
    x = np.stack([r * np.cos(u), r * np.sin(u), z], -1).reshape(-1, 3)

    def at(i: int, j: int) -> int:
        return (i % n) * m + ((-j if i >= n else j) % m)

    quads = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(n) for j in range(m)]
    return x, np.array([face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])
