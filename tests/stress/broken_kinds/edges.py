"""Kinds of broken meshes: holes, edges of many faces and vertices that several sheets share."""

import numpy as np

from tests.shapes import fin

from .parts import Kinds, Mesh, Rng, kind_in, whole

KINDS: Kinds = {}
kind = kind_in(KINDS)


@kind
def one_hole(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x, np.delete(faces, rng.integers(len(faces)), axis=0)


@kind
def many_holes(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x, faces[rng.random(len(faces)) < 0.6]


@kind
def a_vertex_cut_out(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x, faces[(faces != rng.integers(len(x))).all(axis=1)]


@kind
def a_half(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x, faces[(x[faces, 0] <= np.median(x[:, 0])).all(axis=1)]


@kind
def cut_along_edges(rng: Rng) -> Mesh:
    """The two sides have vertices of their own in the same places."""
    x, faces = whole(rng)
    side = x[faces].mean(axis=1)[:, 0] > np.median(x[:, 0])
    faces[side] += len(x)
    return np.concatenate([x, x]), faces


@kind
def all_faces_apart(rng: Rng) -> Mesh:
    """Each has vertices of its own: what a file of corners is."""
    x, faces = whole(rng)
    return x[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)


@kind
def three_faces_at_an_edge(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    a, b, _ = faces[rng.integers(len(faces))]
    return np.concatenate([x, [1.5 * x[a] + 0.1]]), np.concatenate([faces, [[a, b, len(x)]]])


@kind
def many_faces_at_an_edge(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    a, b, _ = faces[rng.integers(len(faces))]
    tips = x[a] + rng.normal(size=(30, 3))
    more = [[a, b, len(x) + k] for k in range(30)]
    return np.concatenate([x, tips]), np.concatenate([faces, more])


@kind
def fins(_: Rng) -> Mesh:
    return fin().vertices, fin().faces


@kind
def bow_tie(rng: Rng) -> Mesh:
    """Two pieces with one vertex in common."""
    (x, faces), (y, more) = whole(rng), whole(rng)
    more = more + len(x)
    more[more == len(x)] = 0
    return np.concatenate([x, y + x[0] - y[0]]), np.concatenate([faces, more])


@kind
def chain_of_bow_ties(rng: Rng) -> Mesh:
    n = int(rng.integers(3, 20))
    x = rng.normal(size=(2 * n + 1, 3))
    return x, np.array([[2 * k, 2 * k + 1, 2 * k + 2] for k in range(n)])


@kind
def inner_walls(rng: Rng) -> Mesh:
    """Faces between random vertices."""
    x, faces = whole(rng)
    return x, np.concatenate([faces, rng.integers(len(x), size=(10, 3))])


@kind
def faces_at_random(rng: Rng) -> Mesh:
    return rng.normal(size=(20, 3)), rng.integers(20, size=(60, 3))


@kind
def all_faces_of_a_few_vertices(rng: Rng) -> Mesh:
    n = int(rng.integers(5, 9))
    triples = [(i, j, k) for i in range(n) for j in range(i) for k in range(j)]
    return rng.normal(size=(n, 3)), np.array(triples)
