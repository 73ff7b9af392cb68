"""Vertices cut out of a surface: `Surface.without`."""

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, GeodesicDistance, MeshError, ParameterError, Surface, VertexError
from tests.shapes import bumpy, grid


def by_hand(surface, gone):
    """The mesh that is left, with no other vertices than those of its faces; and what these were."""
    faces = np.array([face for face in surface.faces.tolist() if not set(face) & set(gone)])
    ids = sorted({vertex for face in faces.tolist() for vertex in face})
    new = {vertex: k for k, vertex in enumerate(ids)}
    return Surface(surface.vertices[ids], [[new[v] for v in face] for face in faces.tolist()]), ids


def test_ids_stay_and_what_is_gone_has_no_face():
    surface = bumpy(300)
    gone = [7, 100, 7, 204]
    cut = surface.without(gone)
    np.testing.assert_array_equal(cut.vertices, surface.vertices)
    assert cut.unreferenced_count == 3
    assert cut.boundary_loop_count == 3
    assert cut.repairs == (f"3 vertices cut out, with {surface.n_faces - cut.n_faces} faces",)
    apart = np.linalg.norm(surface.vertices - surface.vertices[100], axis=1)
    apart[gone] = np.inf
    with pytest.raises(VertexError, match=f"vertex 100 belongs to no .*; the nearest that does is {apart.argmin()}\\."):
        cut.check_vertex(100)
    # The others keep their faces, in their order.
    np.testing.assert_array_equal(cut.faces, [f for f in surface.faces.tolist() if not set(f) & set(gone)])


@pytest.mark.parametrize("kind", [BiharmonicDistance, GeodesicDistance])
def test_distances_are_those_of_a_mesh_cut_by_hand(kind):
    surface = bumpy(400)
    gone = np.flatnonzero(surface.vertices[:, 2] > 0.6)
    cut, (alone, ids) = surface.without(gone), by_hand(surface, gone.tolist())
    fields, expected = kind(cut).from_sources([ids[0], ids[40]]), kind(alone).from_sources([0, 40])
    np.testing.assert_allclose(fields[ids], expected, rtol=1e-9, atol=1e-12)
    assert np.isnan(np.delete(fields, ids, axis=0)).all()


@pytest.mark.parametrize("gone", [[], [2, 5], (2, 5), np.array([2, 5], np.uint8), np.arange(12) == 5])
def test_ids_and_booleans_mean_the_same(gone):
    surface = grid(3, 2)
    ids = np.flatnonzero(gone) if np.asarray(gone).dtype.kind == "b" else np.array(gone, int)
    touched = np.isin(surface.faces, ids).any(axis=1)
    np.testing.assert_array_equal(surface.without(gone).faces, surface.faces[~touched])


def test_it_can_be_done_again_and_nothing_is_said_of_nothing():
    surface = bumpy(300)
    assert surface.without([]) is surface
    cut = surface.without([3])
    assert cut.without([3]) is cut
    assert len(cut.without([50]).repairs) == 2


@pytest.mark.parametrize(
    ("gone", "error", "said"),
    [
        ([0, 12], VertexError, "surface has no vertex 12; ids run from 0 to 11."),
        ([-1], VertexError, "no vertex -1"),
        ([0.5], ParameterError, "no float64 array of shape (1,)"),
        (["a"], ParameterError, "ids (k,), or booleans for all 12"),
        ([[0, 1]], ParameterError, "no int64 array of shape (1, 2)"),
        ([True, False], ParameterError, "no bool array of shape (2,)"),
        ([[0], [1, 2]], ParameterError, "Vertices are not an array"),
        (range(12), MeshError, "surface: no face is left without 12 vertices."),
    ],
)
def test_refused(gone, error, said):
    surface = grid(3, 2)
    with pytest.raises(error) as told:
        Surface(surface.vertices, surface.faces).without(gone)
    assert said in str(told.value)
