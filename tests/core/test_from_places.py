"""Distances from places in faces: laws, and dense references."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from bihdist_core import (
    BiharmonicDistance,
    Laplacian,
    ParameterError,
    Surface,
    SurfacePoint,
    read_surface,
)
from bihdist_core.sources.splitting import split_at
from tests.core.every_distance import (
    BUMPY,
    CORNER,
    CURVE,
    INSIDE,
    ON_EDGE,
    SLACK,
    SMALL,
    every_distance,
    every_quadratic,
    from_points,
    points,
)
from tests.shapes import MESHES, bumpy, grid, needs_meshes, two_pieces


@every_quadratic
@pytest.mark.parametrize("place", [INSIDE, ON_EDGE, CORNER], ids=["inside", "on an edge", "at a corner"])
def test_a_place_stands_where_the_eigenfunctions_interpolated_are(make, place):
    of_vertices = points(make, BUMPY)
    at = np.array(place.weights) @ of_vertices[BUMPY.faces[place.face]]
    expected = from_points(of_vertices, at[None])
    slack = SLACK.get(make, SMALL)
    assert np.abs(make(BUMPY).from_source(place) - expected).max() <= slack * expected.max()


@every_quadratic
@settings(max_examples=25, deadline=None, derandomize=True)
@given(face=st.integers(0, 100), b0=st.floats(0, 1), share=st.floats(0, 1))
def test_the_formula(make, face, b0, share):
    distance = _KNOWN.setdefault(make, make(BUMPY))
    place = SurfacePoint.of(face, b0, (1 - b0) * share)
    b, corners = np.array(place.weights), BUMPY.faces[face]
    squares = distance.from_sources(corners) ** 2
    expected = squares @ b - b @ distance.pairwise(corners) ** 2 @ b / 2
    field = distance.from_source(place)
    assert np.abs(field**2 - expected).max() <= SMALL * expected.max()
    # 0 at the place alone.
    assert (field > 0).sum() == len(field) - (b == 1).sum()


_KNOWN: dict = {}


@every_distance
def test_a_place_at_a_corner_is_the_vertex(make):
    distance = make(BUMPY)
    for k in range(3):
        place = SurfacePoint(17, tuple(float(k == c) for c in range(3)))
        assert np.array_equal(distance.from_source(place), distance.from_source(int(BUMPY.faces[17, k])))


@every_quadratic
def test_a_place_on_an_edge_is_the_same_in_both_faces(make):
    distance = make(BUMPY)
    i, j = BUMPY.edges[50]
    fields = []
    for face in np.flatnonzero(np.isin(BUMPY.faces, [i, j]).sum(axis=1) == 2):
        corners = BUMPY.faces[face]
        weights = np.where(corners == i, 0.25, np.where(corners == j, 0.75, 0.0))
        fields.append(distance.from_source(SurfacePoint(int(face), tuple(weights))))
    assert len(fields) == 2
    assert np.abs(fields[0] - fields[1]).max() <= SMALL * fields[0].max()


@pytest.mark.parametrize("shape", ["closed", "with a boundary"])
def test_the_difference_from_a_divided_face_is_that_of_the_discretization(shape):
    """A vertex more in a face bends functions there as no linear one can: at the worst place, next to the source, by
    something that halves as edges do, and on the mean by a quarter.

    Measured on real meshes (the largest of 12 places): 1.4e-3 of the maximum at 810 vertices, then 6.1e-4, 2.8e-4 and
    1.6e-4 where each face is divided in four; 1.0e-3, 4.5e-4, 2.1e-4 from 3,301 on.
    """
    surface = bumpy(500) if shape == "closed" else grid(21, 21)
    place = SurfacePoint.of(77, 1 / 3, 1 / 3)
    worst, mean = [], []
    for _ in range(3):
        split = split_at(surface, np.array([place.face]), np.array([place.weights]))
        expected = BiharmonicDistance(split.surface).from_source(int(split.vertices[0]))[: len(surface.vertices)]
        apart = np.abs(BiharmonicDistance(surface).from_source(place) - expected) / expected.max()
        worst.append(apart.max())
        mean.append(apart.mean())
        surface, place = in_four(surface), SurfacePoint.of(3 * len(surface.faces) + place.face, 1 / 3, 1 / 3)
    assert worst[0] < 1e-2
    assert np.all(np.divide(worst[1:], worst[:-1]) < 0.6)
    assert np.all(np.divide(mean[1:], mean[:-1]) < 0.4)


def in_four(surface):
    """The same shape with every edge divided in two; the middle one of the four parts of face f is face 3 m + f."""
    faces, count = surface.faces, len(surface.vertices)
    sides = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, number = np.unique(sides, axis=0, return_inverse=True)
    a, b, c = count + number.reshape(3, -1)
    i, j, k = faces.T
    parts = np.concatenate([np.column_stack(part) for part in ((i, a, c), (a, j, b), (c, b, k), (a, b, c))])
    return Surface(np.concatenate([surface.vertices, surface.vertices[edges].mean(axis=1)]), parts)


@pytest.mark.parametrize("corner", [0, 1, 2])
def test_towards_a_corner_a_place_becomes_the_vertex(corner):
    distance, face = BiharmonicDistance(BUMPY), 17
    there = distance.from_source(int(BUMPY.faces[face][corner]))
    apart = []
    for share in (1e-3, 1e-6, 0.0):
        weights = np.full(3, share / 2)
        weights[corner] = 1 - share
        field = distance.from_source(SurfacePoint(face, tuple(weights.tolist())))
        apart.append(np.abs(field - there).max() / there.max())
    assert apart[0] < 1e-3
    assert apart[1] < 1e-6
    assert apart[2] <= 1e-12


@pytest.mark.parametrize("size", [1e-6, 1e-12])
def test_near_a_corner_the_distance_to_it_has_all_its_digits(size):
    distance = BiharmonicDistance(BUMPY)
    corner, other, _ = BUMPY.faces[17]
    field = distance.from_source(SurfacePoint.of(17, 1 - size, size))
    assert field[corner] == pytest.approx(size * distance.between(corner, other), rel=1e-3, abs=0)


@needs_meshes
@pytest.mark.parametrize("name", ["spot.obj", "fertility.off", "armadillo_15k.obj"])
def test_dividing_the_face_there_gives_nearly_the_same(name):
    s = read_surface(MESHES / name)
    distance = BiharmonicDistance(s)
    for face in np.random.default_rng(0).integers(len(s.faces), size=3):
        place = SurfacePoint.of(int(face), 0.3, 0.45)
        split = split_at(s, np.array([place.face]), np.array([place.weights]))
        divided, ids = split.surface, split.vertices
        expected = BiharmonicDistance(divided).from_source(int(ids[0]))[: len(s.vertices)]
        assert np.abs(distance.from_source(place) - expected).max() <= 1e-3 * expected.max()


@needs_meshes
def test_the_certificate_holds_for_places_too():
    """Against |y|_A of L y = sum b_i e_i - e_j, which cancels nothing, also in the thinnest face."""
    s = read_surface(MESHES / "camelhead.off")
    distance = BiharmonicDistance(Laplacian(s))
    component = distance.laplacian.components[0]
    for face in (int(s.face_heights.argmin()), 5000):
        place = SurfacePoint.of(face, 0.2, 0.3)
        field = distance.from_source(place)
        targets = np.unique([*s.faces[face], *np.argsort(field)[:20], *range(0, len(field), 999)])
        b = np.zeros((len(field), len(targets)))
        b[s.faces[face]] += np.array(place.weights)[:, None]
        b[targets, np.arange(len(targets))] -= 1
        y = component.centred(component.solve(b))
        expected = np.sqrt(component.areas @ y**2)
        assert np.abs(field[targets] - expected).max() <= distance.accuracy * field.max()


@every_quadratic
def test_between_places(make):
    distance, of_vertices = make(BUMPY), points(make, BUMPY)
    places = [INSIDE, ON_EDGE, SurfacePoint.of(90, 0.1, 0.1)]
    at = [np.array(p.weights) @ of_vertices[BUMPY.faces[p.face]] for p in places]
    for one, x in zip(places, at, strict=True):
        for other, y in zip(places, at, strict=True):
            expected = np.linalg.norm(x - y)
            assert distance.between(one, other) == pytest.approx(expected, rel=1e-6, abs=1e-12)
        assert distance.between(one, 5) == pytest.approx(distance.from_source(one)[5], rel=1e-11)
        assert distance.between(5, one) == pytest.approx(distance.from_source(one)[5], rel=1e-11)
    nearest = min(distance.between(12, 5), distance.between(40, 5))
    assert distance.between("12+40", 5) == pytest.approx(nearest, rel=1e-9)
    for two in [("12+40", "7+5"), (CURVE, INSIDE)]:
        with pytest.raises(ParameterError, match=r"is not known between .* one must be a vertex"):
            distance.between(*two)


def test_between_places_of_two_components_nothing_is_known():
    s = two_pieces()
    distance = BiharmonicDistance(s)
    assert np.isnan(distance.between(SurfacePoint.of(0, 0.2, 0.2), SurfacePoint.of(len(s.faces) - 1, 0.2, 0.2)))
