"""Distances from sets, boundary loops and curves, and what cannot be asked: laws, and dense references."""

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    BoundaryLoop,
    Curve,
    GeodesicDistance,
    Laplacian,
    ParameterError,
    SourceSet,
    Surface,
    SurfacePoint,
    VertexError,
)
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance import Distance
from bihdist_core.distances.distance_types import Spec
from bihdist_core.distances.source_questions import SOURCES_PER_BLOCK
from bihdist_core.sources.pieces import pieces_of
from tests.core.every_distance import (
    BUMPY,
    CORNER,
    CURVE,
    GEODESIC,
    INSIDE,
    QUADRATIC,
    SMALL,
    every_distance,
    every_quadratic,
    from_points,
    points,
)
from tests.shapes import grid, needs_kernel, two_pieces


# ---------------------------------------------------------------------- sets
@every_distance
def test_a_set_is_the_nearest_of_its_members(make):
    distance = make(BUMPY)
    members = (5, 80, INSIDE, SurfacePoint.of(90, 0.1, 0.1))
    expected = distance.from_sources(members).min(axis=1)
    field = distance.from_source(SourceSet(members))
    # The exact method starts from all at once, and the divided faces of others are in its way by rounding.
    assert np.abs(field - expected).max() <= 1e-6 * expected.max()
    assert (field[[5, 80]] == 0).all()
    assert np.array_equal(distance.from_source("5+80"), distance.from_source(SourceSet((5, 80))))


@every_distance
def test_a_large_set_in_blocks(make):
    members = tuple(range(0, 3 * SOURCES_PER_BLOCK, 2))
    distance = make(BUMPY)
    expected = distance.from_sources(members).min(axis=1)
    assert np.abs(distance.from_source(SourceSet(members)) - expected).max() <= SMALL * expected.max()


@every_distance
def test_a_set_reaches_the_components_of_its_members(make):
    s = two_pieces()
    distance, last = make(s), len(s.faces) - 1
    both = distance.from_source(SourceSet((3, SurfacePoint.of(last, 0.2, 0.2))))
    assert np.array_equal(np.isnan(both), np.arange(65) == 60)
    one = distance.from_source(SurfacePoint.of(last, 0.2, 0.2))
    assert np.isnan(one[:61]).all()
    assert np.array_equal(both[61:], one[61:])


# ---------------------------------------------------------------------- lines
@every_quadratic
def test_a_line_is_the_nearest_of_all_its_points(make):
    # Of a grid whose eigenvalues are all different about the 30th: of equal ones some would be cut off.
    for s, source in [(BUMPY, CURVE), (grid(9, 6), BoundaryLoop(0))]:
        of_vertices, pieces = points(make, s), pieces_of(source, s)
        t = np.linspace(0, 1, 50)[:, None]
        samples = np.concatenate(
            [
                (a + t * (b - a)) @ of_vertices[corners]
                for corners, a, b in zip(pieces.corners, pieces.start, pieces.stop, strict=True)
            ]
        )
        expected = from_points(of_vertices, samples)
        field = make(s).from_source(source)
        # Samples miss the nearest point by a hundredth of a piece.
        assert np.abs(field - expected).max() <= 2e-3 * expected.max()
        assert (field - expected).max() <= 2e-6 * expected.max()


@every_distance
def test_a_boundary_loop_is_0_along_itself(make):
    g = grid(8, 6)
    field = make(g).from_source("loop:0")
    assert np.array_equal(field == 0, np.isin(np.arange(len(g.vertices)), g.boundary_edges))


@every_distance
def test_a_line_in_a_set(make):
    g = grid(8, 6)
    distance = make(g)
    expected = distance.from_sources([31, BoundaryLoop(0)]).min(axis=1)
    field = distance.from_source(SourceSet((31, BoundaryLoop(0))))
    assert np.abs(field - expected).max() <= 1e-6 * expected.max()


# ---------------------------------------------------------------------- geodesics, on a flat rectangle
FLAT = grid(40, 30)


def straight_from(place, surface=FLAT):
    at = np.array(place.weights) @ surface.vertices[surface.faces[place.face]]
    return np.linalg.norm(surface.vertices - at, axis=1)


@pytest.mark.parametrize("place", [SurfacePoint.of(700, 0.2, 0.5), SurfacePoint.of(700, 0.3, 0.7)])
def test_geodesics_from_a_place(place):
    expected = straight_from(place)
    assert GeodesicDistance(FLAT, "exact").from_source(place) == pytest.approx(expected, rel=1e-9, abs=1e-5)
    heat = GeodesicDistance(FLAT, "heat").from_source(place)
    assert np.abs(heat - expected).max() <= 1.5  # as from vertices, where it is 1.1 edges off here
    edges = GeodesicDistance(FLAT, "dijkstra").from_source(place)
    assert (edges >= expected - 1e-9).all()
    assert (edges <= 1.5 * expected + 1).all()


def test_geodesics_from_a_line():
    curve = Curve((SurfacePoint.of(685, 0.3, 0.3), SurfacePoint.of(705, 0.3, 0.3)))
    y = FLAT.vertices[:, 1]
    start, stop = pieces_of(curve, FLAT).positions(FLAT.vertices)
    x = np.clip(FLAT.vertices[:, 0], start[0, 0], stop[-1, 0])
    expected = np.hypot(FLAT.vertices[:, 0] - x, y - start[0, 1])
    distance = GeodesicDistance(FLAT, "exact")
    exact = distance.from_source(curve)
    assert np.abs(exact - expected).max() < 1e-13 * expected.max()
    assert distance.label_from(pieces_of(curve, FLAT)) == "geodesic, exact"
    assert distance.label_from(pieces_of(SourceSet((3, 4)), FLAT)) == "geodesic, exact"
    assert np.abs(GeodesicDistance(FLAT, "heat").from_source(curve) - expected).max() <= 3


def test_a_curve_that_stays_in_one_place():
    curve = Curve((SurfacePoint.of(700, 0.3, 0.3), SurfacePoint.of(700, 0.3, 0.3)))
    for make in (*QUADRATIC.values(), *GEODESIC.values()):
        distance = make(FLAT)
        expected = distance.from_source(SurfacePoint.of(700, 0.3, 0.3))
        assert np.abs(distance.from_source(curve) - expected).max() <= 1e-6 * expected.max()


# ---------------------------------------------------------------------- what cannot be
class Straight(Distance):
    """Somebody else's, which knows vertices only."""

    label, length_power = "straight", 1.0

    def prepare(self, component, progress=None):
        pass

    def compute_columns(self, component, index, progress):
        x = component.surface.vertices
        return np.linalg.norm(x[:, None] - x[index], axis=2)


def test_a_distance_that_knows_vertices_only_says_so():
    distance = Straight(BUMPY)
    assert np.array_equal(distance.from_source("5+80"), distance.from_sources([5, 80]).min(axis=1))
    assert np.array_equal(distance.from_source(CORNER), distance.from_source(int(BUMPY.faces[17, 1])))
    for source in (INSIDE, CURVE, SourceSet((5, INSIDE))):
        with pytest.raises(ParameterError, match="straight is known between vertices only; start from vertices"):
            distance.from_source(source)


@every_distance
def test_sources_that_are_not_there(make):
    distance = make(two_pieces())
    for source, error, said in [
        (SurfacePoint.of(10**6, 0, 0), ParameterError, "has no face 1000000"),
        ("loop:0", ParameterError, "is closed"),
        ("3+60", VertexError, "belongs to no face"),
        ("lop:0", ParameterError, "did you mean"),
        (2.5, VertexError, "not a vertex id"),
    ]:
        with pytest.raises(error, match=said):
            distance.from_source(source)


# ---------------------------------------------------------------------- answers
@needs_kernel
def test_answers_have_the_words_and_the_certificate_of_all_components():
    s = two_pieces()
    distances, last = Distances(Laplacian(s)), len(s.faces) - 1
    source = SourceSet((3, SurfacePoint.of(last, 0.2, 0.2)))
    answer = distances.answer(Spec.of("biharmonic"), source)
    distance = distances.get(Spec.of("biharmonic"))
    assert answer.error_estimate == distance.error_estimate([0, 1])
    assert np.array_equal(answer.field, distance.from_source(source), equal_nan=True)
    loop = Distances(Laplacian(grid(3, 3))).answer(Spec.of("geodesic", method="exact"), BoundaryLoop(0))
    assert loop.label == "geodesic, exact"


def test_an_answer_that_cannot_be_from_a_place_can_be_from_a_vertex(monkeypatch):
    monkeypatch.setattr(BiharmonicDistance, "is_quadratic", False)
    distances = Distances(Laplacian(BUMPY))
    for _ in range(2):
        assert "vertices only" in distances.answer(Spec.of("biharmonic"), INSIDE).failure
    assert distances.answer(Spec.of("biharmonic"), SourceSet((5, 80))).failure == ""
    assert distances.answer(Spec.of("biharmonic"), 5).failure == ""


def test_a_source_that_is_not_on_the_surface_is_an_error_and_no_answer():
    with pytest.raises(ParameterError, match="is closed"):
        Distances(Laplacian(BUMPY)).answer(Spec.of("biharmonic"), BoundaryLoop(0))


def test_surfaces_are_not_kept_for_their_sources():
    import gc
    import weakref

    s = Surface(BUMPY.vertices, BUMPY.faces)
    assert pieces_of(INSIDE, s) is pieces_of(SurfacePoint(*(INSIDE.face, INSIDE.weights)), s)
    known = weakref.ref(s)
    del s
    gc.collect()
    assert known() is None
