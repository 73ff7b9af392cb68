"""Kinds of broken meshes: vertices that no face names, or in one place, and coordinates and ids that cannot be."""

import numpy as np

from .parts import Kinds, Make, Mesh, Rng, a_few, kind_in, whole

KINDS: Kinds = {}
kind = kind_in(KINDS)


def _with_coordinate(value: float) -> Make:
    def make(rng: Rng) -> Mesh:
        x, faces = whole(rng)
        x[a_few(len(x), rng), rng.integers(3)] = value
        return x, faces

    return make


def _scaled(scale: float) -> Make:
    def make(rng: Rng) -> Mesh:
        x, faces = whole(rng)
        return x * scale, faces

    return make


def _with_id(id: int) -> Make:
    """id: of a vertex in place of another, from the end if it is below -1."""

    def make(rng: Rng) -> Mesh:
        x, faces = whole(rng)
        faces[a_few(len(faces), rng), rng.integers(3)] = len(x) if id == 0 else id
        return x, faces

    return make


@kind
def isolated_vertices(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return np.concatenate([x, rng.normal(size=(3, 3))]), faces


@kind
def isolated_vertices_between(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    new = np.sort(rng.choice(2 * len(x), len(x), replace=False))
    more = rng.normal(size=(2 * len(x), 3))
    more[new] = x
    return more, new[faces]


@kind
def isolated_vertices_far_away(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return np.concatenate([x, [[1e30, -1e30, 1e30]]]), faces


@kind
def doubled_vertices(rng: Rng) -> Mesh:
    """The faces around some vertices name one in the same place."""
    x, faces = whole(rng)
    some = a_few(len(faces), rng, 8)
    y = x[faces[some, 0]]
    faces[some, 0] = len(x) + np.arange(len(some))
    return np.concatenate([x, y]), faces


@kind
def vertices_in_one_place(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    some = a_few(len(x), rng, 8)
    x[some] = x[some[0]]
    return x, faces


@kind
def vertices_nearly_in_one_place(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    some = a_few(len(x), rng, 8)
    x[some] = x[some[0]] + 1e-14 * rng.normal(size=(len(some), 3))
    return x, faces


@kind
def an_edge_without_length(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    a, b, _ = faces[rng.integers(len(faces))]
    x[a] = x[b]
    return x, faces


@kind
def noise(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x + rng.normal(size=x.shape), faces


KINDS |= {
    "nan": _with_coordinate(np.nan),
    "infinity": _with_coordinate(-np.inf),
    "a coordinate of 1e40": _with_coordinate(1e40),
    "a coordinate of 1e200": _with_coordinate(1e200),
    "a coordinate of 5e-324": _with_coordinate(5e-324),
    "tiny": _scaled(1e-30),
    "too tiny": _scaled(1e-160),
    "huge": _scaled(1e30),
    "too huge": _scaled(1e160),
    "an id beyond the last": _with_id(0),
    "an id below zero": _with_id(-1),
    "an id of ten digits": _with_id(2**31 - 1),
}
