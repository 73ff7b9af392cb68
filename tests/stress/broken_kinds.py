"""Kinds of broken meshes by name, each a function of a random generator to vertices (n, 3) and faces (m, 3).

The arrays are as a file would have them: with coordinates that are no numbers and with ids that do not exist.
"""

from collections.abc import Callable
from contextlib import suppress

import numpy as np

from tests.core.nasty_meshes import nasty_mesh
from tests.core.test_geodesic_laws import moebius
from tests.packaging.mutated_meshes import mutated
from tests.shapes import bumpy, caps, fin, folded, grid, needles, sphere, spike, tetrahedron, torus, two_pieces

Rng = np.random.Generator
Mesh = tuple[np.ndarray, np.ndarray]
KINDS: dict[str, Callable[[Rng], Mesh]] = {}


def kind(make: Callable[[Rng], Mesh]) -> Callable[[Rng], Mesh]:
    """Put a function among the kinds, called by its name."""
    KINDS[make.__name__.replace("_", " ")] = make
    return make


def _whole(rng: Rng) -> Mesh:
    """A sound mesh, closed or with boundary, of a random size."""
    n = int(rng.integers(20, 60))
    surface = [bumpy(n, int(rng.integers(9))), grid(n // 8, 5), torus(n // 6 + 3, 5)][rng.integers(3)]
    return surface.vertices.copy(), surface.faces.copy()


def _some(count: int, rng: Rng, at_most: int = 4) -> np.ndarray:
    """Different numbers below a count."""
    return rng.choice(count, min(count, int(rng.integers(1, at_most + 1))), replace=False)


def _joined(*meshes: Mesh) -> Mesh:
    """Meshes beside each other, with nothing in common."""
    starts = np.cumsum([0, *(len(x) for x, _ in meshes)])
    return np.concatenate([x for x, _ in meshes]), np.concatenate(
        [faces + start for (_, faces), start in zip(meshes, starts, strict=False)]
    )


def _with_coordinate(value: float) -> Callable[[Rng], Mesh]:
    def make(rng: Rng) -> Mesh:
        x, faces = _whole(rng)
        x[_some(len(x), rng), rng.integers(3)] = value
        return x, faces

    return make


def _scaled(scale: float) -> Callable[[Rng], Mesh]:
    def make(rng: Rng) -> Mesh:
        x, faces = _whole(rng)
        return x * scale, faces

    return make


def _with_id(id: int) -> Callable[[Rng], Mesh]:
    """id: of a vertex in place of another, from the end if it is below -1."""

    def make(rng: Rng) -> Mesh:
        x, faces = _whole(rng)
        faces[_some(len(faces), rng), rng.integers(3)] = len(x) if id == 0 else id
        return x, faces

    return make


# ---------------------------------------------------------------------- holes and edges
@kind
def one_hole(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return x, np.delete(faces, rng.integers(len(faces)), axis=0)


@kind
def many_holes(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return x, faces[rng.random(len(faces)) < 0.6]


@kind
def a_vertex_cut_out(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return x, faces[(faces != rng.integers(len(x))).all(axis=1)]


@kind
def a_half(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return x, faces[(x[faces, 0] <= np.median(x[:, 0])).all(axis=1)]


@kind
def cut_along_edges(rng: Rng) -> Mesh:
    """The two sides have vertices of their own in the same places."""
    x, faces = _whole(rng)
    side = x[faces].mean(axis=1)[:, 0] > np.median(x[:, 0])
    faces[side] += len(x)
    return np.concatenate([x, x]), faces


@kind
def all_faces_apart(rng: Rng) -> Mesh:
    """Each has vertices of its own: what a file of corners is."""
    x, faces = _whole(rng)
    return x[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)


@kind
def three_faces_at_an_edge(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    a, b, _ = faces[rng.integers(len(faces))]
    return np.concatenate([x, [1.5 * x[a] + 0.1]]), np.concatenate([faces, [[a, b, len(x)]]])


@kind
def many_faces_at_an_edge(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
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
    (x, faces), (y, more) = _whole(rng), _whole(rng)
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
    x, faces = _whole(rng)
    return x, np.concatenate([faces, rng.integers(len(x), size=(10, 3))])


@kind
def faces_at_random(rng: Rng) -> Mesh:
    return rng.normal(size=(20, 3)), rng.integers(20, size=(60, 3))


@kind
def all_faces_of_a_few_vertices(rng: Rng) -> Mesh:
    n = int(rng.integers(5, 9))
    triples = [(i, j, k) for i in range(n) for j in range(i) for k in range(j)]
    return rng.normal(size=(n, 3)), np.array(triples)


# ---------------------------------------------------------------------- faces that are there twice or turned
@kind
def doubled_faces(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return x, np.concatenate([faces, faces[_some(len(faces), rng)]])


@kind
def all_faces_doubled_and_turned(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return x, np.concatenate([faces, faces[:, ::-1]])


@kind
def flipped_faces(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    some = rng.random(len(faces)) < 0.3
    faces[some] = faces[some][:, ::-1]
    return x, faces


@kind
def inside_out(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
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


# ---------------------------------------------------------------------- faces without area
@kind
def a_vertex_named_twice(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    some = _some(len(faces), rng)
    faces[some, 1] = faces[some, 0]
    return x, faces


@kind
def a_vertex_named_three_times(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    some = _some(len(faces), rng)
    faces[some] = faces[some][:, :1]
    return x, faces


@kind
def only_faces_that_name_a_vertex_twice(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
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
    x, faces = _whole(rng)
    return x * [1, 0, 0], faces


@kind
def all_in_one_place(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return 0 * x + 1, faces


@kind
def flat_in_space(rng: Rng) -> Mesh:
    """A closed surface pressed into a plane: its two sides lie on each other."""
    x, faces = _whole(rng)
    return x * [1, 1, 0], faces


@kind
def nearly_flat(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
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


# ---------------------------------------------------------------------- vertices
@kind
def isolated_vertices(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return np.concatenate([x, rng.normal(size=(3, 3))]), faces


@kind
def isolated_vertices_between(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    new = np.sort(rng.choice(2 * len(x), len(x), replace=False))
    more = rng.normal(size=(2 * len(x), 3))
    more[new] = x
    return more, new[faces]


@kind
def isolated_vertices_far_away(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return np.concatenate([x, [[1e30, -1e30, 1e30]]]), faces


@kind
def doubled_vertices(rng: Rng) -> Mesh:
    """The faces around some vertices name one in the same place."""
    x, faces = _whole(rng)
    some = _some(len(faces), rng, 8)
    y = x[faces[some, 0]]
    faces[some, 0] = len(x) + np.arange(len(some))
    return np.concatenate([x, y]), faces


@kind
def vertices_in_one_place(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    some = _some(len(x), rng, 8)
    x[some] = x[some[0]]
    return x, faces


@kind
def vertices_nearly_in_one_place(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    some = _some(len(x), rng, 8)
    x[some] = x[some[0]] + 1e-14 * rng.normal(size=(len(some), 3))
    return x, faces


@kind
def an_edge_without_length(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    a, b, _ = faces[rng.integers(len(faces))]
    x[a] = x[b]
    return x, faces


@kind
def noise(rng: Rng) -> Mesh:
    x, faces = _whole(rng)
    return x + rng.normal(size=x.shape), faces


# ---------------------------------------------------------------------- pieces
@kind
def two_components(_: Rng) -> Mesh:
    return two_pieces().vertices, two_pieces().faces


@kind
def many_components(rng: Rng) -> Mesh:
    return _joined(*[(tetrahedron().vertices + rng.normal(size=3), tetrahedron().faces) for _ in range(30)])


@kind
def components_of_one_face(rng: Rng) -> Mesh:
    return rng.normal(size=(60, 3)), np.arange(60).reshape(-1, 3)


@kind
def one_inside_another(rng: Rng) -> Mesh:
    s = sphere(40)
    return _joined((s.vertices, s.faces), (0.5 * s.vertices, s.faces[:, ::-1]))


@kind
def two_in_the_same_place(rng: Rng) -> Mesh:
    mesh = _whole(rng)
    return _joined(mesh, mesh)


@kind
def pieces_of_unlike_size(rng: Rng) -> Mesh:
    (x, faces), (y, more) = _whole(rng), _whole(rng)
    return _joined((x, faces), (y * 10.0 ** rng.uniform(-12, 12), more))


@kind
def through_itself(rng: Rng) -> Mesh:
    (x, faces), (y, more) = _whole(rng), _whole(rng)
    return _joined((x, faces), (y + 0.3, more))


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
    x, faces = _whole(rng)
    return x + 10.0 ** rng.uniform(4, 14), faces


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
