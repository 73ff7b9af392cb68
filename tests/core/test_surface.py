"""Surfaces: what they are made of, their components and edges, and what is to be known of them."""

import pickle

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from bihdist_core import MeshError, Surface, VertexError, read_surface
from bihdist_core.analysis.surface_notes import SurfaceNotes, surface_notes
from bihdist_core.surface import connected
from tests.shapes import bumpy, fin, grid, slivers, tetrahedron, torus, two_pieces

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]


def test_arrays_are_read_only_copies():
    vertices, faces = np.array(SQUARE, float), np.array([[0, 1, 2], [0, 2, 3]])
    s = Surface(vertices, faces)
    vertices[0], faces[0] = 7, 3
    assert s.vertices[0, 0] == 0
    assert s.faces[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        s.vertices[0] = 1


@pytest.mark.parametrize(
    ("vertices", "faces", "words"),
    [
        ([[0, 0], [1, 0], [1, 1]], [[0, 1, 2]], r"shape \(n, 3\), not \(3, 2\)"),
        ("abc", [[0, 1, 2]], "not an array of numbers"),
        ([[0, 0, 0], [1, np.nan, 0], [1, 1, 0]], [[0, 1, 2]], r"vertex 1 has the coordinates \(1, nan, 0\)"),
        (SQUARE, [[0, 1, 4]], r"face 0 has the vertices \(0, 1, 4\); ids run from 0 to 3"),
        (SQUARE, [[0, 1, 2], [0, -1, 2]], r"face 1 has the vertices \(0, -1, 2\)"),
        (SQUARE, [[0, 1, 2.5]], r"face 0 has the vertices \(0, 1, 2.5\)"),
        (SQUARE, np.empty((0, 3), int), "has no faces"),
        (SQUARE, [[0, 1, 2, 3]], r"shape \(m, 3\), not \(1, 4\)"),
        (SQUARE, [["a", "b", "c"]], "not an array of vertex ids"),
        (SQUARE, [[0, 1, 1]], "every face names a vertex twice"),
    ],
)
def test_what_cannot_be_a_surface_is_refused_with_its_place(vertices, faces, words):
    with pytest.raises(MeshError, match=words):
        Surface(vertices, faces, "thing")


def test_faces_that_say_nothing_are_dropped_and_counted():
    s = Surface(SQUARE, [[0, 1, 2], [2, 0, 1], [0, 2, 1], [0, 2, 3], [3, 3, 0]], repairs=["read"])
    assert s.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert s.repairs == ("read", "1 face with a repeated vertex dropped", "2 faces that repeated another dropped")


@pytest.mark.parametrize("vertex", [65, -1, 1.5, "3", True])
def test_a_vertex_that_does_not_exist_is_an_error(vertex):
    with pytest.raises(VertexError, match="two pieces"):
        two_pieces().check_vertex(vertex)


def test_a_vertex_without_a_face_is_an_error():
    with pytest.raises(VertexError, match="vertex 60 belongs to no face"):
        two_pieces().check_vertex(60)


def test_components_are_numbered_by_size_and_cut_out_with_their_ids():
    s = two_pieces()
    assert s.n_components == 2
    assert s.component_of_vertex.tolist() == [0] * 60 + [-1] + [1] * 4
    small, ids = s.component(1)
    assert ids.tolist() == [61, 62, 63, 64]
    assert np.array_equal(small.vertices, s.vertices[ids])
    assert np.array_equal(ids[small.faces], s.faces[-4:])


@pytest.mark.parametrize("kernel", ["compiled", "plain"])
@pytest.mark.parametrize("surface", [tetrahedron(), bumpy(300), grid(3, 2), fin(), two_pieces()])
def test_each_edge_is_listed_once_and_known_to_its_sides(surface, kernel, monkeypatch):
    if kernel == "plain":
        monkeypatch.setattr("bihdist_core.surface.library", lambda: None)
    s = Surface(surface.vertices, surface.faces)
    ends = np.sort(np.concatenate([s.faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    assert np.array_equal(s.edges[s.edge_of_side], ends)
    assert [tuple(edge) for edge in s.edges.tolist()] == sorted({tuple(edge) for edge in ends.tolist()})


def test_faces_that_share_one_vertex_are_connected():
    assert fin().n_components == 1


@pytest.mark.parametrize(
    ("surface", "loops", "genus", "bad_edges", "bad_vertices"),
    [(tetrahedron(), 0, 0, 0, 0), (torus(), 0, 1, 0, 0), (bumpy(300), 0, 0, 0, 0), (grid(3, 2), 1, 0, 0, 0)],
)
def test_topology_of_known_shapes(surface, loops, genus, bad_edges, bad_vertices):
    assert surface.boundary_loop_count == loops
    assert surface.genus == genus
    assert surface.nonmanifold_edge_count == bad_edges
    assert surface.nonmanifold_vertex_count == bad_vertices


def test_what_is_not_manifold_is_counted_and_has_no_genus():
    s = fin()
    assert s.nonmanifold_edge_count == 1
    assert s.nonmanifold_vertex_count == 1
    assert s.genus is None
    assert not s.is_manifold


def test_flat_faces_are_found_and_thin_ones_are_not():
    assert slivers().degenerate_faces.tolist() == [18]


def test_measures():
    assert grid(3, 2).face_areas.sum() == pytest.approx(6)
    assert grid(1, 1).mean_edge_length == pytest.approx((4 + 2**0.5) / 5)


def test_a_surface_from_a_pickle_is_as_it_was():
    surface = pickle.loads(pickle.dumps(slivers()))
    assert surface.degenerate_faces.tolist() == [18]
    for array in (surface.vertices, surface.faces):
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 1


# ---------------------------------------------------------------------- components
def _path(n):
    return np.stack([np.arange(n - 1), np.arange(1, n)])


def _star(n):
    """The last vertex joined to all others, which come in pairs: faces around one point."""
    return np.stack([np.r_[np.arange(0, n - 1, 2), np.arange(1, n - 1, 2)], np.full(n - 1, n - 1)])


@pytest.mark.parametrize("seed", range(5))
def test_components_are_those_of_scipy(seed):
    rng = np.random.default_rng(seed)
    n = 3000
    # From nearly no edges to nearly one component.
    for count in (0, 5, n // 4, n // 2, n, 4 * n):
        edges = rng.integers(0, n, (2, count))
        graph = sp.coo_array((np.ones(count), edges), shape=(n, n))
        assert np.array_equal(connected(edges, n), connected_components(graph, directed=False)[1])


@pytest.mark.parametrize("kernel", ["compiled", "plain"])
def test_faces_connect_as_their_sides_do(kernel, monkeypatch):
    if kernel == "plain":
        monkeypatch.setattr("bihdist_core.surface.library", lambda: None)
    for count in (0, 100, 600, 3000):
        faces = np.random.default_rng(count).integers(0, 2000, (3, count))
        assert np.array_equal(connected(faces, 2000), connected(np.hstack([faces[:2], faces[1:]]), 2000))


@pytest.mark.parametrize("edges", [_path(100_001), _star(100_001)], ids=["path", "star"])
@pytest.mark.parametrize("order", ["ascending", "descending", "random"])
def test_long_ways_and_large_stars_take_a_few_rounds(edges, order):
    n = 100_001
    number = {"ascending": np.arange(n), "descending": np.arange(n)[::-1]}.get(order)
    if number is None:
        number = np.random.default_rng(0).permutation(n)
    # One vertex a round would take minutes.
    assert not connected(number[edges], n).any()


def test_components_are_ranked_by_size_then_by_their_first_vertex():
    triangles = np.array([[9, 8, 7], [2, 1, 11], [4, 5, 6], [6, 5, 3]])
    s = Surface(np.random.default_rng(0).standard_normal((13, 3)), triangles)
    assert s.component_of_vertex.tolist() == [-1, 1, 1, 0, 0, 0, 0, 2, 2, 2, -1, 1, -1]


@pytest.mark.parametrize("surface", [bumpy(300), torus(), fin(), two_pieces(), slivers()], ids=str)
def test_each_edge_is_there_once_with_its_faces(surface):
    faces = surface.faces.tolist()
    sides = [tuple(sorted((face[k], face[(k + 1) % 3]))) for k in range(3) for face in faces]
    assert [tuple(edge) for edge in surface.edges.tolist()] == sorted(set(sides))
    assert surface.faces_per_edge.tolist() == [sides.count(edge) for edge in sorted(set(sides))]
    edges, of_side = surface._sides
    assert [tuple(edge) for edge in edges[of_side].tolist()] == sides


# ---------------------------------------------------------------------- surface notes
CORNERS = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
QUADS = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


def off(vertices, faces) -> str:
    lines = [" ".join(map(str, row)) for row in vertices] + [" ".join(map(str, (len(f), *f))) for f in faces]
    return "\n".join(["OFF", f"{len(vertices)} {len(faces)} 0", *lines]) + "\n"


def test_a_closed_mesh_of_triangles_has_none():
    assert surface_notes(bumpy(200)) == SurfaceNotes()


def test_coordinates_too_far_from_the_origin_for_their_digits_are_warned_of():
    s = bumpy(200)
    for far, digits in ((1e12, "rounded to steps of 0.00012"), (1e4, "")):
        notes = surface_notes(Surface(s.vertices + np.array([far, 0, 0]), s.faces))
        assert [digits in text for text in notes.warnings] == [True] * bool(digits)
    single = (s.vertices + np.array([1e4, 0, 0])).astype(np.float32)
    (text,) = surface_notes(Surface(single, s.faces)).warnings
    edge = Surface(single, s.faces).mean_edge_length
    assert text.startswith(
        f"coordinates up to 1e+04 are rounded to steps of 0.00098, {2**-10 / edge:.2g} of the mean edge"
    )
    # Whole numbers are as they are, however large.
    whole = Surface(np.round(1e3 * s.vertices) + 2.0**50, s.faces)
    assert surface_notes(whole) == SurfaceNotes()
    assert surface_notes(Surface(1e45 * s.vertices, s.faces)) == SurfaceNotes()


def test_a_cube_of_quads_needs_no_repair(tmp_path):
    path = tmp_path / "cube.off"
    path.write_text(off(CORNERS, QUADS))
    assert surface_notes(read_surface(path)) == SurfaceNotes(facts=("6 quads divided into 12 triangles",))


def test_what_was_dropped_is_a_repair_and_what_is_odd_a_warning(tmp_path):
    # Two pieces: three faces at one edge, a face twice, a face without area, and vertices of no face.
    walls = [[0, 1, 2], [0, 2, 3], [0, 1, 5], [0, 5, 4], [0, 1, 6]]
    away = [[a + 8, b + 8, c + 8] for a, b, c in [[0, 1, 2], [0, 2, 3]]]
    flat = [[8, 16, 9]]
    vertices = np.concatenate([CORNERS, CORNERS + 5, [[5.5, 5, 5], [9, 9, 9]]])
    path = tmp_path / "odd.off"
    path.write_text(off(vertices, [*walls, *away, *flat, [2, 1, 0]]))
    notes = surface_notes(read_surface(path))
    assert notes.repairs == ("1 face that repeated another dropped",)
    assert [sentence.split(" ")[0] for sentence in notes.facts] == ["2", "6"]
    edges, flats, parts = notes.warnings
    assert edges.startswith("1 edge with more than two faces")
    assert flats.startswith("1 face of almost no area")
    assert parts.startswith("2 components, with no distance")


def test_a_vertex_between_two_fans_is_a_warning():
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    notes = surface_notes(Surface(vertices, [[0, 1, 2], [0, 3, 4]]))
    assert notes.warnings == ("1 vertex where faces touch in a point",)
