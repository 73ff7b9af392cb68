"""Kinds of broken meshes: faces of no area, or of next to none."""

from contextlib import suppress

import numpy as np

from tests.core.nasty_meshes import nasty_mesh
from tests.packaging.mutated_meshes import mutated
from tests.shapes import bumpy, caps, folded, needles, spike

from .parts import Kinds, Mesh, Rng, a_few, kind_in, whole

KINDS: Kinds = {}
kind = kind_in(KINDS)


@kind
def a_vertex_named_twice(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    some = a_few(len(faces), rng)
    faces[some, 1] = faces[some, 0]
    return x, faces


@kind
def a_vertex_named_three_times(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    some = a_few(len(faces), rng)
    faces[some] = faces[some][:, :1]
    return x, faces


@kind
def only_faces_that_name_a_vertex_twice(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    faces[:, 1] = faces[:, 0]
    return x, faces


@kind
def zero_faces_in_edges(rng: Rng) -> Mesh:
    s = caps(bumpy(int(rng.integers(10, 40))), 0.0, int(rng.integers(1, 6)))
    return s.vertices, s.faces


@kind
def thin_caps(rng: Rng) -> Mesh:
    s = caps(bumpy(30), 10.0 ** rng.uniform(-16, -3), int(rng.integers(1, 6)), rng.uniform(0.05, 0.95))
    return s.vertices, s.faces


@kind
def thin_needles(rng: Rng) -> Mesh:
    s = needles(bumpy(30), 10.0 ** rng.uniform(-16, -3), int(rng.integers(1, 6)))
    return s.vertices, s.faces


@kind
def thin_folds(rng: Rng) -> Mesh:
    s = folded(bumpy(30), 10.0 ** rng.uniform(-16, -3), int(rng.integers(1, 6)))
    return s.vertices, s.faces


@kind
def a_long_spike(rng: Rng) -> Mesh:
    s = spike(40, 10.0 ** rng.uniform(2, 12))
    return s.vertices, s.faces


@kind
def all_on_a_line(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x * [1, 0, 0], faces


@kind
def all_in_one_place(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return 0 * x + 1, faces


@kind
def flat_in_space(rng: Rng) -> Mesh:
    """A closed surface pressed into a plane: its two sides lie on each other."""
    x, faces = whole(rng)
    return x * [1, 1, 0], faces


@kind
def nearly_flat(rng: Rng) -> Mesh:
    x, faces = whole(rng)
    return x * [1, 1, 10.0 ** rng.uniform(-16, -6)], faces


@kind
def a_fan_of_needles(rng: Rng) -> Mesh:
    n = int(rng.integers(50, 300))
    angle = np.linspace(0, 10.0 ** rng.uniform(-9, 0), n)
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    return np.concatenate([[[0, 0, 0]], ring]), np.array([[0, k, k + 1] for k in range(1, n)])


@kind
def all_at_once(rng: Rng) -> Mesh:
    return nasty_mesh(int(rng.integers(10**6)), 60, 3)


@kind
def several_damages(rng: Rng) -> Mesh:
    """Of the program that feeds sanitizers; what makes no surface at all stays as it was."""
    s = bumpy(40)
    with suppress(ValueError):
        s = mutated(s, rng)
    return s.vertices, s.faces
