"""Distances from places in faces, sets, boundary loops and curves: laws, and dense references."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bihdist_core import (
    BiharmonicDistance,
    BoundaryLoop,
    CommuteTimeDistance,
    Curve,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    ParameterError,
    Place,
    PowerDistance,
    SourceSet,
    Surface,
    TruncatedBiharmonicDistance,
    VertexError,
    read_surface,
)
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance import SOURCES, Distance
from bihdist_core.distances.kinds import Spec
from bihdist_core.sources.pieces import pieces_of
from bihdist_core.sources.splitting import split_at
from tests import dense_reference
from tests.shapes import MESHES, bumpy, grid, needs_meshes, two_pieces

SMALL = 1e-9  # rounding of sums of squares, against the largest distance

QUADRATIC = {
    "biharmonic": BiharmonicDistance,
    "commute-time": CommuteTimeDistance,
    "diffusion": lambda s: DiffusionDistance(s, t=0.5),
    "truncated": lambda s: TruncatedBiharmonicDistance(s, k=30),
    "power": lambda s: PowerDistance(s, alpha=1.5, k=30),
}
GEODESIC = {method: lambda s, m=method: GeodesicDistance(s, m) for method in ("exact", "heat", "dijkstra")}
every_quadratic = pytest.mark.parametrize("make", QUADRATIC.values(), ids=QUADRATIC)
every_geodesic = pytest.mark.parametrize("make", GEODESIC.values(), ids=GEODESIC)
every_distance = pytest.mark.parametrize("make", {**QUADRATIC, **GEODESIC}.values(), ids={**QUADRATIC, **GEODESIC})

BUMPY = bumpy(200)
INSIDE, ON_EDGE, CORNER = Place.of(17, 0.2, 0.5), Place.of(17, 0.3, 0.7), Place.of(17, 0, 1)
CURVE = Curve((Place.of(3, 0.2, 0.3), Place.of(40, 0.3, 0.3), Place.of(77, 0.1, 0.2)))


def points(make, surface):
    """(n, k) points whose distances are the distance: all eigenvectors, weighted."""
    values, vectors = dense_reference.full_spectrum(surface)
    if make is QUADRATIC["diffusion"]:
        weights = np.exp(-0.5 * values / values[0])
    else:
        power, count = {
            QUADRATIC["biharmonic"]: (2, None),
            QUADRATIC["commute-time"]: (1, None),
            QUADRATIC["truncated"]: (2, 30),
            QUADRATIC["power"]: (1.5, 30),
        }[make]
        weights = values**-power * (np.arange(len(values)) < (count or len(values)))
    return vectors * np.sqrt(weights)


SLACK = {QUADRATIC["diffusion"]: 2e-6, QUADRATIC["truncated"]: 1e-7, QUADRATIC["power"]: 1e-7}
"""Eigenpairs are found to a tolerance, and diffusion leaves out the last."""


def from_points(of_vertices, samples):
    return np.linalg.norm(of_vertices[:, None] - samples, axis=2).min(axis=1)


# ---------------------------------------------------------------------- places
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
    place = Place.of(face, b0, (1 - b0) * share)
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
        place = Place(17, tuple(float(k == c) for c in range(3)))
        assert np.array_equal(distance.from_source(place), distance.from_source(int(BUMPY.faces[17, k])))


@every_quadratic
def test_a_place_on_an_edge_is_the_same_in_both_faces(make):
    distance = make(BUMPY)
    i, j = BUMPY.edges[50]
    fields = []
    for face in np.flatnonzero(np.isin(BUMPY.faces, [i, j]).sum(axis=1) == 2):
        corners = BUMPY.faces[face]
        weights = np.where(corners == i, 0.25, np.where(corners == j, 0.75, 0.0))
        fields.append(distance.from_source(Place(int(face), tuple(weights))))
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
    place = Place.of(77, 1 / 3, 1 / 3)
    worst, mean = [], []
    for _ in range(3):
        split = split_at(surface, np.array([place.face]), np.array([place.weights]))
        expected = BiharmonicDistance(split.surface).from_source(int(split.vertices[0]))[: len(surface.vertices)]
        apart = np.abs(BiharmonicDistance(surface).from_source(place) - expected) / expected.max()
        worst.append(apart.max())
        mean.append(apart.mean())
        surface, place = in_four(surface), Place.of(3 * len(surface.faces) + place.face, 1 / 3, 1 / 3)
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
        field = distance.from_source(Place(face, tuple(weights.tolist())))
        apart.append(np.abs(field - there).max() / there.max())
    assert apart[0] < 1e-3
    assert apart[1] < 1e-6
    assert apart[2] <= 1e-12


@pytest.mark.parametrize("size", [1e-6, 1e-12])
def test_near_a_corner_the_distance_to_it_has_all_its_digits(size):
    distance = BiharmonicDistance(BUMPY)
    corner, other, _ = BUMPY.faces[17]
    field = distance.from_source(Place.of(17, 1 - size, size))
    assert field[corner] == pytest.approx(size * distance.between(corner, other), rel=1e-3, abs=0)


@needs_meshes
@pytest.mark.parametrize("name", ["spot.obj", "fertility.off", "armadillo_15k.obj"])
def test_dividing_the_face_there_gives_nearly_the_same(name):
    s = read_surface(MESHES / name)
    distance = BiharmonicDistance(s)
    for face in np.random.default_rng(0).integers(len(s.faces), size=3):
        place = Place.of(int(face), 0.3, 0.45)
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
        place = Place.of(face, 0.2, 0.3)
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
    places = [INSIDE, ON_EDGE, Place.of(90, 0.1, 0.1)]
    at = [np.array(p.weights) @ of_vertices[BUMPY.faces[p.face]] for p in places]
    for one, x in zip(places, at, strict=True):
        for other, y in zip(places, at, strict=True):
            expected = np.linalg.norm(x - y)
            assert distance.between(one, other) == pytest.approx(expected, rel=1e-6, abs=1e-12)
        assert distance.between(one, 5) == pytest.approx(distance.from_source(one)[5], rel=1e-12)
        assert distance.between(5, one) == pytest.approx(distance.from_source(one)[5], rel=1e-12)
    nearest = min(distance.between(12, 5), distance.between(40, 5))
    assert distance.between("12+40", 5) == pytest.approx(nearest, rel=1e-9)
    for two in [("12+40", "7+5"), (CURVE, INSIDE)]:
        with pytest.raises(ParameterError, match=r"is not known between .* let one be a vertex"):
            distance.between(*two)


def test_between_places_of_two_components_nothing_is_known():
    s = two_pieces()
    distance = BiharmonicDistance(s)
    assert np.isnan(distance.between(Place.of(0, 0.2, 0.2), Place.of(len(s.faces) - 1, 0.2, 0.2)))


# ---------------------------------------------------------------------- sets
@every_distance
def test_a_set_is_the_nearest_of_its_members(make):
    distance = make(BUMPY)
    members = (5, 80, INSIDE, Place.of(90, 0.1, 0.1))
    expected = distance.from_sources(members).min(axis=1)
    field = distance.from_source(SourceSet(members))
    # The exact method starts from all at once, and the divided faces of others are in its way by rounding.
    assert np.abs(field - expected).max() <= 1e-6 * expected.max()
    assert (field[[5, 80]] == 0).all()
    assert np.array_equal(distance.from_source("5+80"), distance.from_source(SourceSet((5, 80))))


@every_distance
def test_a_large_set_in_blocks(make):
    members = tuple(range(0, 3 * SOURCES, 2))
    distance = make(BUMPY)
    expected = distance.from_sources(members).min(axis=1)
    assert np.abs(distance.from_source(SourceSet(members)) - expected).max() <= SMALL * expected.max()


@every_distance
def test_a_set_reaches_the_components_of_its_members(make):
    s = two_pieces()
    distance, last = make(s), len(s.faces) - 1
    both = distance.from_source(SourceSet((3, Place.of(last, 0.2, 0.2))))
    assert np.array_equal(np.isnan(both), np.arange(65) == 60)
    one = distance.from_source(Place.of(last, 0.2, 0.2))
    assert np.isnan(one[:61]).all()
    assert np.array_equal(both[61:], one[61:])


# ---------------------------------------------------------------------- lines
@every_quadratic
def test_a_line_is_the_nearest_of_all_its_points(make):
    for s, source in [(BUMPY, CURVE), (grid(8, 6), BoundaryLoop(0))]:
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


@pytest.mark.parametrize("place", [Place.of(700, 0.2, 0.5), Place.of(700, 0.3, 0.7)])
def test_geodesics_from_a_place(place):
    expected = straight_from(place)
    assert GeodesicDistance(FLAT, "exact").from_source(place) == pytest.approx(expected, rel=1e-9, abs=1e-5)
    heat = GeodesicDistance(FLAT, "heat").from_source(place)
    assert np.abs(heat - expected).max() <= 1.5  # as from vertices, where it is 1.1 edges off here
    edges = GeodesicDistance(FLAT, "dijkstra").from_source(place)
    assert (edges >= expected - 1e-9).all()
    assert (edges <= 1.5 * expected + 1).all()


def test_geodesics_from_a_line():
    curve = Curve((Place.of(685, 0.3, 0.3), Place.of(705, 0.3, 0.3)))
    y = FLAT.vertices[:, 1]
    start, stop = pieces_of(curve, FLAT).positions(FLAT.vertices)
    x = np.clip(FLAT.vertices[:, 0], start[0, 0], stop[-1, 0])
    expected = np.hypot(FLAT.vertices[:, 0] - x, y - start[0, 1])
    distance = GeodesicDistance(FLAT, "exact")
    exact = distance.from_source(curve)
    # Points a quarter of an edge (of 1.14) apart.
    assert (exact >= expected - 1e-6).all()
    assert (exact - expected <= 0.3**2 / 8 / np.maximum(expected, 0.15) + 1e-6).all()
    assert distance.label_from(pieces_of(curve, FLAT)) == "geodesic, exact, from points along the line"
    assert distance.label_from(pieces_of(SourceSet((3, 4)), FLAT)) == "geodesic, exact"
    assert np.abs(GeodesicDistance(FLAT, "heat").from_source(curve) - expected).max() <= 3


def test_a_curve_that_stays_in_one_place():
    curve = Curve((Place.of(700, 0.3, 0.3), Place.of(700, 0.3, 0.3)))
    for make in (*QUADRATIC.values(), *GEODESIC.values()):
        distance = make(FLAT)
        expected = distance.from_source(Place.of(700, 0.3, 0.3))
        assert np.abs(distance.from_source(curve) - expected).max() <= 1e-6 * expected.max()


# ---------------------------------------------------------------------- what cannot be
class Straight(Distance):
    """Somebody else's, which knows vertices only."""

    label, length_power = "straight", 1.0

    def prepare(self, component, progress=None):
        pass

    def _columns(self, component, index, progress):
        x = component.surface.vertices
        return np.linalg.norm(x[:, None] - x[index], axis=2)


def test_a_distance_that_knows_vertices_only_says_so():
    distance = Straight(BUMPY)
    assert np.array_equal(distance.from_source("5+80"), distance.from_sources([5, 80]).min(axis=1))
    assert np.array_equal(distance.from_source(CORNER), distance.from_source(int(BUMPY.faces[17, 1])))
    for source in (INSIDE, CURVE, SourceSet((5, INSIDE))):
        with pytest.raises(ParameterError, match="straight is known between vertices only; let it start from some"):
            distance.from_source(source)


@every_distance
def test_sources_that_are_not_there(make):
    distance = make(two_pieces())
    for source, error, said in [
        (Place.of(10**6, 0, 0), ParameterError, "has no face 1000000"),
        ("loop:0", ParameterError, "is closed"),
        ("3+60", VertexError, "belongs to no face"),
        ("lop:0", ParameterError, "did you mean"),
        (2.5, VertexError, "not a vertex id"),
    ]:
        with pytest.raises(error, match=said):
            distance.from_source(source)


# ---------------------------------------------------------------------- answers
def test_answers_have_the_words_and_the_certificate_of_all_components():
    s = two_pieces()
    distances, last = Distances(Laplacian(s)), len(s.faces) - 1
    source = SourceSet((3, Place.of(last, 0.2, 0.2)))
    answer = distances.answer(Spec.of("biharmonic"), source)
    distance = distances.get(Spec.of("biharmonic"))
    assert answer.certificate == distance.certificate([0, 1])
    assert np.array_equal(answer.field, distance.from_source(source), equal_nan=True)
    loop = Distances(Laplacian(grid(3, 3))).answer(Spec.of("geodesic", method="exact"), BoundaryLoop(0))
    assert loop.label == "geodesic, exact, from points along the line"


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
    assert pieces_of(INSIDE, s) is pieces_of(Place(*(INSIDE.face, INSIDE.weights)), s)
    known = weakref.ref(s)
    del s
    gc.collect()
    assert known() is None
