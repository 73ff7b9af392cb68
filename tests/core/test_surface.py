import pickle

import numpy as np
import pytest

from bihdist_core import MeshError, Surface, VertexError
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
