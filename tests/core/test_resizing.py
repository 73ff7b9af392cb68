"""Meshes made coarser, finer, finer in places, noisy, punched and joined."""

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, Cancelled, GeodesicDistance, ParameterError, Surface, VertexError
from bihdist_core.applications.local_refinement import refined_around
from bihdist_core.applications.perturbation import noisy, punched, welded, with_handle
from bihdist_core.applications.resizing import KEEP_SHAPE, _harmless, at_most, refined, resized, simplified
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.experiments._claims_growth import icosphere, moebius
from tests.shapes import bumpy, fin, grid, sphere, torus


def quality(s):
    """(m,) 1 for an equilateral triangle, 0 for a flat one."""
    x = s.vertices[s.faces]
    return 4 * np.sqrt(3) * s.face_areas / ((x - np.roll(x, 1, axis=1)) ** 2).sum(axis=(1, 2))


@pytest.mark.parametrize("surface", [bumpy(800), torus(40, 20), grid(24, 24)], ids=lambda s: s.name)
def test_simplified_keeps_vertices_topology_and_shape(surface):
    small, ids = simplified(surface, 250)
    assert len(small.vertices) == len(ids) == 250
    np.testing.assert_array_equal(small.vertices, surface.vertices[ids])
    assert (np.diff(ids) > 0).all()
    assert small.is_manifold
    assert (small.genus, small.boundary_loop_count) == (surface.genus, surface.boundary_loop_count)
    # A tenth of an edge of the coarse mesh, of length about 0.2 on the bumpy sphere, changes the area by percents.
    assert small.face_areas.sum() == pytest.approx(surface.face_areas.sum(), rel=0.03)
    assert quality(small).min() >= min(KEEP_SHAPE, quality(surface).min()) - 1e-12


def test_simplified_keeps_the_orientation_and_the_outline():
    s = grid(24, 24)
    small, _ = simplified(s, 200)
    a, b, c = (small.vertices[small.faces[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    assert small.face_areas.sum() == pytest.approx(24 * 24)


def test_a_collapse_that_turns_a_face_over_is_seen():
    # A ring around vertex 0 with a dent beside vertex 1: from there the face behind the dent is seen from below.
    ring = [[3, 0, 0], [0.5, 0.5, 0], [1, 2, 0], [-1, 2, 0], [-2, 0, 0], [-1, -2, 0], [1, -2, 0], [0.5, -0.5, 0]]
    x = np.array([[0.0, 0, 0], *ring])
    faces = np.array([[0, 1 + k, 1 + (k + 1) % 8] for k in range(8)])
    assert not _harmless(x, faces, np.array([0]), np.array([1]))[0]
    # The fan of a hexagon may be drawn onto any corner.
    turn = np.arange(6) * np.pi / 3
    x = np.array([[0, 0, 0], *np.stack([np.cos(turn), np.sin(turn), 0 * turn], 1)])
    faces = np.array([[0, 1 + k, 1 + (k + 1) % 6] for k in range(6)])
    assert _harmless(x, faces, np.zeros(6, int), np.arange(1, 7)).all()


def test_simplified_fields_stay():
    s = bumpy(1500)
    small, ids = simplified(s, 500)
    fine, coarse = BiharmonicDistance(s).from_source(int(ids[7])), BiharmonicDistance(small).from_source(7)
    # Linear elements: the error goes with the square of the edge, here 2 % of the size of the shape.
    assert np.abs(coarse - fine[ids]).max() < 0.02 * fine.max()


def test_simplified_is_the_same_every_time_and_reports():
    said = []
    one, ids = simplified(bumpy(400), 200, lambda share, text: said.append(share))
    other, again = simplified(bumpy(400), 200)
    np.testing.assert_array_equal(ids, again)
    np.testing.assert_array_equal(one.faces, other.faces)
    assert said == sorted(said)
    assert said[-1] == 1

    def stop(share, text):
        raise Cancelled("enough")

    with pytest.raises(Cancelled):
        simplified(bumpy(400), 200, stop)


def test_simplified_refuses_what_it_cannot_do():
    with pytest.raises(ParameterError, match="has 400 vertices and cannot be simplified to 401"):
        simplified(bumpy(400), 401)
    with pytest.raises(ParameterError, match="cannot be simplified to 3"):
        simplified(bumpy(400), 3)
    # No torus has fewer than seven vertices.
    with pytest.raises(ParameterError, match=r"torus cannot be simplified below \d+ vertices without damage"):
        simplified(torus(12, 8), 6)


def test_thin_triangles_do_not_stop_simplification_and_get_no_thinner():
    ball = bumpy(800)
    thin = Surface(ball.vertices * [12, 1, 1], ball.faces)
    small, _ = simplified(thin, 200)
    assert quality(thin).min() < 0.2 * KEEP_SHAPE
    assert quality(small).min() >= quality(thin).min()
    assert small.is_manifold
    assert small.genus == 0
    assert small.face_areas.sum() == pytest.approx(thin.face_areas.sum(), rel=0.1)


def test_simplified_leaves_no_vertex_without_a_face():
    # A fan of single triangles that meet in one vertex, another triangle apart from it, and a vertex of no face.
    turn = 2 * np.pi * np.arange(8) / 8
    fan = grid(12, 12)
    x = np.concatenate([fan.vertices, np.stack([20 + np.cos(turn), np.sin(turn), 0 * turn], 1), [[20, 0, 0]]])
    n = len(fan.vertices)
    single = [[n + 2 * k, n + 2 * k + 1, n + 8] for k in range(4)]
    x = np.concatenate([x, [[40, 0, 0], [41, 0, 0], [40, 1, 0], [60, 0, 0]]])
    surface = Surface(x, np.concatenate([fan.faces, single, [[n + 9, n + 10, n + 11]]]))
    small, ids = simplified(surface, 60)
    assert len(ids) == 60
    assert small.unreferenced_count == 0
    assert small.n_components == surface.n_components == 3
    assert surface.unreferenced_count == 1
    with pytest.raises(ParameterError, match="has 181 vertices and cannot be simplified to 182"):
        simplified(surface, 182)
    least = at_most(surface, 4)
    assert 12 < len(least.vertices) < 60
    assert least.unreferenced_count == 0
    assert at_most(surface, 182) is surface


def test_refined_halves_the_edges_and_keeps_the_surface():
    for s in (bumpy(150), grid(5, 4), fin()):
        fine = refined(s)
        assert len(fine.vertices) == len(s.vertices) + len(s.edges)
        assert len(fine.faces) == 4 * len(s.faces)
        np.testing.assert_array_equal(fine.vertices[: len(s.vertices)], s.vertices)
        assert fine.face_areas.sum() == pytest.approx(s.face_areas.sum())
        assert (fine.genus, fine.boundary_loop_count) == (s.genus, s.boundary_loop_count)
        assert fine.nonmanifold_edge_count == 2 * s.nonmanifold_edge_count


@pytest.mark.parametrize("count", [120, 150, 200, 400, 1000, 5000])
@pytest.mark.parametrize("surface", [bumpy(150), grid(12, 10)], ids=lambda s: s.name)
def test_resized_has_the_count_asked_for(surface, count):
    s = resized(surface, count)
    assert len(s.vertices) == count
    assert s.is_manifold
    assert s.boundary_loop_count == surface.boundary_loop_count
    assert s.face_areas.sum() == pytest.approx(surface.face_areas.sum(), rel=0.1)


def test_noise_has_the_size_it_says_and_is_the_same_every_time():
    s = sphere(2000)
    shift = noisy(s, 0.4).vertices - s.vertices
    assert shift.std() == pytest.approx(0.4 * s.mean_edge_length, rel=0.03)
    np.testing.assert_array_equal(noisy(s, 0.4).vertices, s.vertices + shift)
    assert noisy(s, 0.4, seed=1).vertices[0, 0] != noisy(s, 0.4).vertices[0, 0]


def test_punched_holes_are_where_they_should_be():
    s = grid(20, 20)
    centres = [5 * 21 + 5, 14 * 21 + 14]
    lengths = EdgeGeodesic(s).distances(centres)
    holed = punched(s, lengths, 2.5)
    assert holed.boundary_loop_count == 3
    np.testing.assert_array_equal(holed.vertices, s.vertices)
    assert (holed.component_of_vertex[centres] < 0).all()
    # Cut off along a row, the smaller part goes too.
    row = np.where(s.vertices[:, 1] // 1 % 20 == 5, 0.0, 9.0)
    below = punched(s, np.minimum(row, np.roll(row, 21))[:, None], 1)
    assert below.n_components == 1
    assert below.vertices[below.faces].min(axis=(0, 1))[1] >= 6


@pytest.mark.parametrize("edit", [welded, with_handle])
def test_joining_two_parts_adds_a_handle(edit):
    s = bumpy(600)
    a = int(np.argmax(s.vertices[s.faces, 2].mean(axis=1)))
    b = int(np.argmin(s.vertices[s.faces, 2].mean(axis=1)))
    joined = edit(s, a, b)
    assert joined.is_manifold
    assert (joined.genus, joined.n_components, joined.boundary_loop_count) == (1, 1, 0)
    # Oriented as a whole: every edge is run once in each direction.
    f = joined.faces
    sides = np.concatenate([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]])
    assert len(np.unique(sides, axis=0)) == len(sides)
    # A shortcut from end to end.
    start = int(s.faces[a, 0])
    before, after = (GeodesicDistance(t, "dijkstra").from_source(start)[s.faces[b]] for t in (s, joined))
    if edit is welded:
        assert np.isnan(after).all()
    else:
        assert np.nanmax(after) < 0.85 * before.min()
        assert quality(joined).min() > 0.05


def test_a_weld_makes_one_of_two_triangles_halfway():
    s = bumpy(600)
    a, b = int(np.argmax(s.vertices[s.faces, 2].mean(axis=1))), int(np.argmin(s.vertices[s.faces, 2].mean(axis=1)))
    w = welded(s, a, b)
    assert len(w.faces) == len(s.faces) - 2
    middle = (s.vertices[s.faces[a]].mean(axis=0) + s.vertices[s.faces[b]].mean(axis=0)) / 2
    assert w.vertices[s.faces[a]].mean(axis=0) == pytest.approx(middle)


@pytest.mark.parametrize("edit", [welded, with_handle])
def test_faces_that_touch_cannot_be_joined(edit):
    s = bumpy(600)
    beside = int(np.flatnonzero((s.faces == s.faces[0, 0]).any(axis=1))[1])
    with pytest.raises(ParameterError, match="too close to each other"):
        edit(s, 0, beside)


def test_icospheres():
    for times in (0, 1, 3):
        s = icosphere(times)
        assert len(s.vertices) == 10 * 4**times + 2
        assert np.linalg.norm(s.vertices, axis=1) == pytest.approx(1)
        a, b, c = (s.vertices[s.faces[:, k]] for k in range(3))
        assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a) > 0).all()
        assert s.genus == 0


def test_moebius_transformations_keep_the_sphere_and_its_angles():
    s = icosphere(5)
    image = moebius(s, 3.0)
    assert np.linalg.norm(image.vertices, axis=1) == pytest.approx(1)
    assert moebius(image, 1 / 3.0).vertices == pytest.approx(s.vertices)

    def angles(t):
        x = t.vertices[t.faces]
        one, two = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]
        cosine = np.einsum("ij,ij->i", one, two) / np.linalg.norm(one, axis=1) / np.linalg.norm(two, axis=1)
        return np.degrees(np.arccos(cosine))

    # Angles of chords, not of arcs: equal up to the edges' length, at most 0.1 in the image.
    assert np.abs(angles(s) - angles(image)).max() < 6
    assert Surface(image.vertices, image.faces).face_areas.max() > 4 * s.face_areas.max()


# ---------------------------------------------------------------------- local refinement
def angles(surface):
    x = surface.vertices[surface.faces]
    found = []
    for k in range(3):
        a, b = x[:, (k + 1) % 3] - x[:, k], x[:, (k + 2) % 3] - x[:, k]
        found.append(np.arccos((a * b).sum(1) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)))
    return np.array(found)


@pytest.mark.parametrize("surface", [bumpy(500), grid(8, 8)], ids=["closed", "with a boundary"])
def test_the_surface_stays_and_is_fine_where_it_should_be(surface):
    source, other = 7, 40
    least, reach = 0.02, 0.3
    fine = refined_around(surface, [source, other], least, reach, edges=5)
    n = len(surface.vertices)
    np.testing.assert_array_equal(fine.vertices[:n], surface.vertices)
    assert fine.face_areas.sum() == pytest.approx(surface.face_areas.sum(), rel=1e-12)
    # No vertex hangs in an edge: boundaries and topology are as before.
    assert fine.is_manifold
    assert fine.genus == surface.genus
    assert fine.boundary_loop_count == surface.boundary_loop_count
    ends = fine.vertices[fine.edges]
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    away = np.min([np.linalg.norm(ends - surface.vertices[v], axis=2).min(axis=1) for v in (source, other)], axis=0)
    near = away < reach
    assert (length[near] <= np.maximum(away[near], least) / 5 * (1 + 1e-9)).all()
    # Rivara's bisection: no angle is less than about half the least there was.
    assert angles(fine).min() > 0.45 * angles(surface).min()
    # Orientation stays: normals of new faces point as before.
    assert np.sign(volume(fine)) == np.sign(volume(surface))
    assert volume(fine) == pytest.approx(volume(surface), abs=1e-12)


def volume(surface: Surface) -> float:
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def test_what_is_fine_enough_stays_as_it_is():
    surface = bumpy(500)
    assert refined_around(surface, [3], 0.5, 1.0, edges=0.1) is surface


def test_bad_sources_and_sizes_are_refused():
    with pytest.raises(VertexError):
        refined_around(bumpy(100), [100], 0.1, 0.2)
    with pytest.raises(ParameterError, match=r"from 0\.3 to 0\.2"):
        refined_around(bumpy(100), [1], 0.3, 0.2)
