"""Kinds of broken meshes: several pieces, one face, or none."""

import numpy as np

from tests.shapes import sphere, tetrahedron, two_pieces

from .parts import Kinds, Mesh, Rng, joined, kind_in, whole

KINDS: Kinds = {}
kind = kind_in(KINDS)


@kind
def two_components(_: Rng) -> Mesh:
    return two_pieces().vertices, two_pieces().faces


@kind
def many_components(rng: Rng) -> Mesh:
    return joined(*[(tetrahedron().vertices + rng.normal(size=3), tetrahedron().faces) for _ in range(30)])


@kind
def components_of_one_face(rng: Rng) -> Mesh:
    return rng.normal(size=(60, 3)), np.arange(60).reshape(-1, 3)


@kind
def one_inside_another(rng: Rng) -> Mesh:
    s = sphere(40)
    return joined((s.vertices, s.faces), (0.5 * s.vertices, s.faces[:, ::-1]))


@kind
def two_in_the_same_place(rng: Rng) -> Mesh:
    mesh = whole(rng)
    return joined(mesh, mesh)


@kind
def pieces_of_unlike_size(rng: Rng) -> Mesh:
    (x, faces), (y, more) = whole(rng), whole(rng)
    return joined((x, faces), (y * 10.0 ** rng.uniform(-12, 12), more))


@kind
def through_itself(rng: Rng) -> Mesh:
    (x, faces), (y, more) = whole(rng), whole(rng)
    return joined((x, faces), (y + 0.3, more))


@kind
def one_face(rng: Rng) -> Mesh:
    return rng.normal(size=(3, 3)), np.array([[0, 1, 2]])


@kind
def two_faces(rng: Rng) -> Mesh:
    return rng.normal(size=(4, 3)), np.array([[0, 1, 2], [0, 2, 3]])


@kind
def no_face(rng: Rng) -> Mesh:
    return rng.normal(size=(9, 3)), np.empty((0, 3), int)


@kind
def nothing(_: Rng) -> Mesh:
    return np.empty((0, 3)), np.empty((0, 3), int)


@kind
def far_from_the_origin(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x + 10.0 ** rng.uniform(4, 14), faces
