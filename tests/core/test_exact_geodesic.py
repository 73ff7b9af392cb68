"""Exact geodesic distance: known shapes, a slow reference in 60 digits, and laws, on sound and on damaged meshes."""

import threading

import numpy as np
import pytest

from bihdist_core.distances import exact_geodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic, FacePath
from bihdist_core.errors import Cancelled, ParameterError, SolverError, VertexError
from bihdist_core.kernel import library
from bihdist_core.sources.pieces import Pieces
from bihdist_core.surface import Surface
from tests.core.geodesic_reference import FacePoint, FaceSegment, GeodesicReference
from tests.core.nasty_meshes import nasty_mesh, random_origin
from tests.shapes import (
    bumpy,
    caps,
    fin,
    grid,
    needles,
    torus,
    two_pieces,
)

NEARLY_LOST = [18, 19, 29, 34, 60, 65, 75, 79, 104, 135, 155, 190, 210, 238, 240, 265, 292]
"""Hard meshes of 60 faces on which the kernel alone loses paths."""

ROUNDING = 1e-13
"""Of the largest distance: some hundred roundings along a path."""


def pieces(surface, face, start, stop=None):
    """One piece of a face, a point without `stop`."""
    begin = np.array([start], float)
    end = begin if stop is None else np.array([stop], float)
    return Pieces(np.array([face]), surface.faces[[face]], begin, end, np.array([stop is not None]))


def error(found, expected):
    return np.abs(found - expected).max() / np.abs(expected).max()


def book(pages, k=3):
    """Squares of k x k cells around a common side."""
    flat = grid(k, k)
    turns = 2 * np.pi * np.arange(pages) / pages
    x = np.concatenate(
        [np.outer(flat.vertices[:, 0], [np.cos(t), np.sin(t), 0]) + flat.vertices[:, [1]] * [0, 0, 1] for t in turns]
    )
    faces = np.concatenate([flat.faces + page * len(flat.vertices) for page in range(pages)])
    _, first, inverse = np.unique(np.round(x, 9), axis=0, return_index=True, return_inverse=True)
    return (
        Surface(x[first], inverse.ravel()[faces]),
        first // len(flat.vertices),
        np.tile(flat.vertices, (pages, 1))[first],
    )


# ---------------------------------------------------------------------- known shapes
@pytest.mark.parametrize("pages", [3, 5])
def test_books_have_flat_pairs_of_pages(pages):
    surface, page, flat = book(pages)
    source = int(np.flatnonzero((page == 1) & (flat[:, 0] == 2) & (flat[:, 1] == 1))[0])
    x = np.where(page == page[source], flat[:, 0], -flat[:, 0])
    field = ExactGeodesic(surface).field(source)
    assert error(field.distances, np.hypot(x - 2, flat[:, 1] - 1)) < ROUNDING
    for target in range(len(x)):
        assert length_of(surface, field.path(target)) == pytest.approx(
            field.distances[target], rel=ROUNDING, abs=ROUNDING
        )


def length_of(surface, path):
    """The length of a path whose pieces join."""
    corners = surface.vertices[surface.faces[path.faces]]
    begins, ends = (np.einsum("kc,kcx->kx", w, corners) for w in (path.begins, path.ends))
    assert np.abs(begins[1:] - ends[:-1]).max(initial=0) < 1e-12
    return np.linalg.norm(ends - begins, axis=1).sum()


# ---------------------------------------------------------------------- the slow reference
def rough_grid(seed):
    flat, rng = grid(4, 3), np.random.default_rng(seed)
    return Surface(flat.vertices + [0, 0, 1] * rng.normal(size=(len(flat.vertices), 1)), flat.faces)


SMALL = [bumpy(20), fin(), book(3, 2)[0], rough_grid(0), rough_grid(1), needles(bumpy(14), 1e-4, 9)]


@pytest.mark.parametrize("surface", SMALL, ids=lambda surface: f"{surface.name}-{len(surface.faces)}")
def test_it_is_what_seventy_digits_give(surface):
    reference, solver = GeodesicReference(surface.vertices, surface.faces), ExactGeodesic(surface)
    place, end = (0.5, 0.2, 0.3), (0.1, 0.8, 0.1)
    for source, origin in (
        (1, 1),
        (pieces(surface, 2, place), FacePoint(2, place)),
        (pieces(surface, 2, place, end), FaceSegment(2, place, end)),
    ):
        expected = np.array(reference.distances([origin]), float)
        assert error(solver.distances(source), expected) < ROUNDING


@pytest.mark.parametrize("seed", range(40))
def test_on_hard_meshes_too(seed):
    surface = Surface(*nasty_mesh(seed, 40))
    reference, solver = GeodesicReference(surface.vertices, surface.faces), ExactGeodesic(surface)
    for source in random_sources(surface, seed):
        expected = np.array(reference.distances([source]), float)
        found = solver.distances(as_pieces(surface, source))
        reached = np.isfinite(expected) & (surface.component_of_vertex >= 0)
        assert np.array_equal(np.isfinite(found), reached)
        assert np.abs(found - expected)[reached].max() < 1e-12 * expected[reached].max()


def test_a_straight_path_through_the_vertex_of_a_needle():
    """Of 1.3e-6 rad, from a vertex 5e-13 of an edge before another one: both are on the line, and so is the target."""
    surface = Surface(*nasty_mesh(260, 30))
    source, target = 8, 9
    x = surface.vertices
    found = ExactGeodesic(surface).distances(source)
    assert abs(found[target] - np.linalg.norm(x[source] - x[target])) < 1e-12 * np.nanmax(found)


@pytest.mark.parametrize(
    ("seed", "origin"),
    [
        # Past flat faces beside each other, all of which are taken out.
        (1783, FacePoint(20, (0.12890625, 0.08203125, 0.7890625))),
        # On an edge as short as rounding, a window is not nearer than one that came from elsewhere, and sees more.
        (3891, FacePoint(30, (0.0634765625, 0.0654296875, 0.87109375))),
    ],
)
def test_distances_from_places_on_the_hardest_meshes(seed, origin):
    """In fractions of the maximum."""
    surface = Surface(*nasty_mesh(seed, 40))
    expected = np.array(GeodesicReference(surface.vertices, surface.faces).distances([origin]), float)
    found = ExactGeodesic(surface).distances(as_pieces(surface, origin))
    reached = np.isfinite(expected)
    assert np.abs(found - expected)[reached].max() < 1e-12 * expected[reached].max()


def test_a_segment_in_a_face_of_parts_without_height_stays_where_it_is():
    """One of them is an edge, to which rounding would bring a piece that is 7e-8 beside the segment."""
    surface = Surface(*nasty_mesh(1762, 40))
    origin = FaceSegment(14, (0.4931640625, 0.423828125, 0.0830078125), (0.4609375, 0.5390625, 0.0))
    expected = np.array(GeodesicReference(surface.vertices, surface.faces).distances([origin]), float)
    found = ExactGeodesic(surface).distances(as_pieces(surface, origin))
    reached = np.isfinite(expected)
    assert np.abs(found - expected)[reached].max() < 1e-12 * expected[reached].max()


@pytest.mark.parametrize("seed", NEARLY_LOST)
def test_paths_are_as_long_as_distances_where_vertices_nearly_meet(seed):
    surface = Surface(*nasty_mesh(seed, 60))
    solver = ExactGeodesic(surface)
    for source in random_sources(surface, seed):
        field = solver.field(as_pieces(surface, source))
        size = np.nanmax(field.distances)
        for target in np.flatnonzero(np.isfinite(field.distances)):
            path = field.path(int(target))
            assert abs(length_of(surface, path) - field.distances[target]) < 1e-12 * size
            if len(path.faces):
                ends = np.einsum("kc,kcx->kx", path.begins[:1], surface.vertices[surface.faces[path.faces[:1]]])
                assert np.abs(ends - surface.vertices[target]).max() < 1e-12 * size
                assert min(path.begins.min(), path.ends.min()) > -1e-12


@pytest.mark.parametrize("surface", [bumpy(60), torus(12, 7), fin(), book(3, 2)[0], needles(bumpy(40), 1e-3, 7)])
def test_the_search_for_paths_finds_what_the_kernel_does(surface):
    """From vertices, places and lines, with offsets, to vertices and places."""
    solver, n = ExactGeodesic(surface), len(surface.vertices)
    faces, weights = np.array([1, 4, 2]), np.array([[0.2, 0.3, 0.5], [0.5, 0.5, 0], [0, 0.25, 0.75]])
    places = Pieces(faces, surface.faces[faces], weights, weights, np.zeros(3, bool))
    for source, offsets in (
        (3, None),
        ([2, 6], [0.3, 0.2]),
        (pieces(surface, 2, [0.5, 0.2, 0.3]), None),
        (pieces(surface, 2, [0.5, 0.5, 0]), [0.25]),
        (pieces(surface, 2, [0.7, 0.2, 0.1], [0.1, 0.3, 0.6]), None),
    ):
        field = solver.field(source, places, offsets=offsets)
        for target in range(n + 3):
            expected = field.path(target) if target < n else field.path_to_place(target - n)
            if not len(expected.faces):
                continue
            found = FacePath(*solver._mesh.outside(*field._searched(target)))
            assert length_of(surface, found) == pytest.approx(length_of(surface, expected), rel=ROUNDING)
            one, other = (path.begins[0] @ surface.vertices[surface.faces[path.faces[0]]] for path in (found, expected))
            assert np.abs(one - other).max() < ROUNDING


def test_a_path_that_is_not_as_long_as_its_distance_is_refused(monkeypatch):
    solver = ExactGeodesic(bumpy(60))
    field = solver.field(0)
    monkeypatch.setattr(exact_geodesic, "LENGTH_TOLERANCE", -1.0)
    with pytest.raises(SolverError, match="The path to vertex 9 of bumpy was lost"):
        field.path(9)


def random_sources(surface, seed):
    """A vertex, a place and a piece of a line."""
    rng = np.random.default_rng(seed)
    found = {}
    while len(found) < 3:
        origin = random_origin(rng, surface.faces)
        found.setdefault(type(origin), origin)
    return list(found.values())


def as_pieces(surface, origin):
    if isinstance(origin, FacePoint):
        return pieces(surface, origin.face, *normalised(origin.weights))
    if isinstance(origin, FaceSegment):
        return pieces(surface, origin.face, *normalised(origin.start, origin.end))
    return int(origin)


def normalised(*weights):
    return [np.array([float(w) for w in each]) / float(sum(each)) for each in weights]


def damaged(seed):
    """A mesh with needles, caps, doubled vertices, and faces of no area, turned over or gone."""
    rng = np.random.default_rng(seed)
    surface = [bumpy(40), grid(4, 4), fin(), rough_grid(seed), book(4, 2)[0]][rng.integers(5)]
    x, faces = surface.vertices.copy(), surface.faces.copy()
    for _ in range(3):
        few = rng.integers(len(faces), size=2)
        a, b, c = faces[few].T
        match rng.integers(6):
            case 0:
                x[a] = x[b] + (x[a] - x[b]) * 10.0 ** rng.integers(-14, -1)
            case 1:
                x[a] = (x[b] + x[c]) / 2 + (x[a] - (x[b] + x[c]) / 2) * rng.choice([0, 1e-13, 1e-9, 1e-5])
            case 2:
                x = np.concatenate([x, x[a]])
                faces[few, 0] = np.arange(len(x) - 2, len(x))
            case 3:
                x = np.concatenate([x, (x[a] + x[b]) / 2])
                faces = np.concatenate([faces, np.stack([a, b, np.arange(len(x) - 2, len(x))], 1)])
            case 4:
                faces[few] = faces[few][:, ::-1]
            case 5:
                faces = np.delete(faces, few, axis=0)
    return Surface(x, faces), rng


@pytest.mark.parametrize("seed", range(40))
def test_nothing_is_left_out_on_damaged_meshes(seed, monkeypatch):
    surface, rng = damaged(seed)
    solver, face = ExactGeodesic(surface), int(rng.integers(len(surface.faces)))
    source = pieces(surface, face, rng.dirichlet([1, 1, 1]), rng.dirichlet([1, 1, 1]) if seed % 2 else None)
    field = solver.field(source)
    d, size = field.distances, np.ptp(surface.vertices)
    i, j = surface.edges.T
    edges = np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)
    assert np.nanmax(np.abs(d[i] - d[j]) - edges) < 1e-11 * size
    reached = np.flatnonzero(np.isfinite(d))
    assert set(surface.component_of_vertex[reached]) == {surface.component_of_vertex[surface.faces[face, 0]]}
    for target in rng.choice(reached, 5):
        assert length_of(surface, field.path(int(target))) == pytest.approx(d[target], abs=2e-12 * size)
    monkeypatch.setattr(exact_geodesic, "MOST_WINDOWS_AT_LEAST", 100_000)
    everything = solver.field(source, radius=np.nanmax(d) * (1 + 1e-9), everything=True).distances
    assert np.abs(everything - d)[reached].max() < 1e-12 * size


# ---------------------------------------------------------------------- laws
def test_places_are_vertices_of_a_divided_face():
    surface, weights = torus(), np.array([0.2, 0.5, 0.3])
    a, b, c = surface.faces[9]
    middle, n = weights @ surface.vertices[[a, b, c]], len(surface.vertices)
    faces = np.concatenate([np.delete(surface.faces, 9, axis=0), [[a, b, n], [b, c, n], [c, a, n]]])
    divided = ExactGeodesic(Surface(np.concatenate([surface.vertices, [middle]]), faces)).distances(n)
    solver, place = ExactGeodesic(surface), pieces(surface, 9, weights)
    assert error(solver.distances(place), divided[:n]) < ROUNDING
    assert solver.places(40, place)[0] == pytest.approx(divided[40], rel=ROUNDING)
    assert length_of(surface, solver.path(pieces(surface, 100, [1, 0, 0]), place)) == pytest.approx(
        divided[surface.faces[100, 0]]
    )


def test_several_sources_offsets_and_a_radius():
    solver, ids = ExactGeodesic(bumpy(300)), np.array([3, 77, 200])
    columns = solver.columns(ids)
    assert error(solver.distances(ids), columns.min(axis=1)) < ROUNDING
    offsets = np.array([0, 0.1, 0.3])
    assert error(solver.distances(ids, offsets=offsets), (columns + offsets).min(axis=1)) < ROUNDING
    near, full = solver.distances(3, radius=0.5), columns[:, 0]
    assert np.array_equal(near, np.where(full <= 0.5, full, np.inf))


def test_other_components_and_loose_vertices_are_not_reached():
    both = two_pieces()
    d = ExactGeodesic(both).distances(3)
    assert np.array_equal(np.isnan(d), both.component_of_vertex != both.component_of_vertex[3])


def test_what_is_left_of_a_needle_is_an_edge():
    x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [5, 0, 1e-15]])
    surface = Surface(x, [[0, 1, 2], [1, 3, 4]])
    assert ExactGeodesic(surface).distances(0) == pytest.approx([0, 1, 1, 5, 5], abs=ROUNDING)
    place = pieces(surface, 1, [0.5, 0.25, 0.25])
    path = ExactGeodesic(surface).path(pieces(surface, 0, [1, 0, 0]), place)
    assert length_of(surface, path) == pytest.approx(3)


# ---------------------------------------------------------------------- work and refusals
def test_many_threads_get_the_same():
    solver, found = ExactGeodesic(bumpy(300)), {}
    threads = [
        threading.Thread(target=lambda v=v: found.__setitem__(v, solver.distances(v))) for v in range(0, 300, 40)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8
    assert all(np.array_equal(field, solver.distances(v)) for v, field in found.items())


@pytest.mark.parametrize("make", [lambda: bumpy(3_000), lambda: grid(40, 30), lambda: damaged(5)[0]])
def test_parts_on_any_number_of_threads_get_the_same(make, monkeypatch):
    surface = make()
    whole = ExactGeodesic(surface).field(0)
    monkeypatch.setattr(exact_geodesic, "DIVIDED_FROM", 0)
    monkeypatch.setattr(exact_geodesic, "PART", 4)
    monkeypatch.setattr(exact_geodesic, "FIRST_WINDOWS", 16)
    found = []
    for threads in (1, 3):
        monkeypatch.setattr(exact_geodesic, "WORKERS", threads)
        found.append(ExactGeodesic(surface).field(0))
    assert np.array_equal(found[0].distances, found[1].distances, equal_nan=True)
    top = np.nanmax(whole.distances)
    np.testing.assert_allclose(found[0].distances, whole.distances, rtol=0, atol=ROUNDING * top)
    for target in np.flatnonzero(np.isfinite(whole.distances))[1::500].tolist():
        assert length_of(surface, found[1].path(target)) == pytest.approx(whole.distances[target], abs=1e-11 * top)
        assert length_of(surface, found[1].path(target)) == length_of(surface, found[0].path(target))


def test_it_stops_and_goes_on():
    def stop(fraction, text):
        assert text.partition(":")[0] == "exact geodesic"  # on a slow machine with how long it will take
        raise Cancelled("enough")

    solver = ExactGeodesic(grid(150, 150))
    with pytest.raises(Cancelled):
        solver.columns(range(50), stop)
    assert solver.distances(0)[-1] == pytest.approx(np.linalg.norm(solver.surface.vertices[-1]))


def test_refusals(monkeypatch):
    solver = ExactGeodesic(grid(3, 3))
    with pytest.raises(VertexError):
        solver.distances(99)
    with pytest.raises(ParameterError, match="A radius is a length of at least 0, not nan"):
        solver.distances(0, radius=np.nan)
    with pytest.raises(ParameterError, match="Offsets are 2 finite numbers"):
        solver.distances([0, 1], offsets=[1, np.inf])
    with pytest.raises(ParameterError, match="There is no place 0; 0 were asked for"):
        solver.field(0).path_to_place(0)
    with pytest.raises(ParameterError, match="No path from the source to vertex 15"):
        solver.field(0, radius=1).path(15)
    monkeypatch.setattr(exact_geodesic, "MOST_WINDOWS_AT_LEAST", 0)
    monkeypatch.setattr(exact_geodesic, "MOST_WINDOWS_PER_VERTEX", 1)
    with pytest.raises(SolverError, match="was given up after"):
        solver.distances(0)
    monkeypatch.setattr(library, "library", lambda: None)
    with pytest.raises(SolverError, match="needs the compiled kernel; use the heat method"):
        ExactGeodesic(grid(3, 3))


def test_caps_do_no_harm():
    shape = caps(bumpy(100), 1e-9, 7)
    sound = ExactGeodesic(bumpy(100)).distances(5)
    assert np.abs(ExactGeodesic(shape).distances(5)[:100] - sound).max() < 1e-8 * sound.max()
