import numpy as np
import pytest
import scipy.sparse as sp

from bihdist_core import BiharmonicDistance, ParameterError, Surface
from bihdist_core.operators import AREAS, operators, stiffness, vertex_areas
from tests.shapes import bumpy, fin, grid, slivers, tetrahedron, two_pieces

SURFACES = [bumpy(200), grid(4, 3), tetrahedron(), fin(), slivers(), two_pieces()]


@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
def test_stiffness_is_symmetric_semi_definite_and_its_kernel_is_the_constants(surface):
    stiff = stiffness(surface).toarray()
    assert np.array_equal(stiff, stiff.T)
    values = np.linalg.eigvalsh(stiff)
    kernel = surface.n_components + surface.unreferenced_count
    rounding = 1e-12 * values[-1]  # eigvalsh is backward stable
    assert np.abs(values[:kernel]).max() < rounding
    assert values[kernel] > 1e-9 * values[-1]


def test_stiffness_measures_the_gradient_of_a_linear_function():
    g = grid(4, 3)
    f = 2 * g.vertices[:, 0] - 3 * g.vertices[:, 1]
    assert f @ stiffness(g) @ f == pytest.approx(13 * 12)  # |grad f|^2 times the area


def test_weights_of_a_right_angle_square():
    stiff = stiffness(grid(1, 1)).toarray()
    # Sides lie opposite to one angle of 45 degrees: weight cot(45)/2; the diagonal opposite to right angles: 0.
    assert stiff == pytest.approx(
        np.array([[1, -0.5, -0.5, 0], [-0.5, 1, 0, -0.5], [-0.5, 0, 1, -0.5], [0, -0.5, -0.5, 1]])
    )


@pytest.mark.parametrize("kind", AREAS)
@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
def test_vertex_areas_are_positive_and_sum_to_the_area(surface, kind):
    areas = vertex_areas(surface, kind)
    with_area = np.zeros(len(areas), bool)
    with_area[np.delete(surface.faces, surface.degenerate_faces, axis=0)] = True
    assert (areas[with_area] > 0).all()
    assert (areas[~with_area] == 0).all()
    assert areas.sum() == pytest.approx(surface.face_areas.sum(), rel=1e-12)


def test_mixed_voronoi_areas_of_known_triangles():
    equilateral = Surface([[0, 0, 0], [1, 0, 0], [0.5, 3**0.5 / 2, 0]], [[0, 1, 2]])
    assert vertex_areas(equilateral) == pytest.approx(np.full(3, 3**0.5 / 12))
    obtuse = Surface([[0, 0, 0], [4, 0, 0], [1, 1, 0]], [[0, 1, 2]])
    assert vertex_areas(obtuse) == pytest.approx([0.5, 0.5, 1])  # half the area at the obtuse corner
    right = Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    assert vertex_areas(right) == pytest.approx([0.25, 0.125, 0.125])


def test_a_flat_face_leaves_the_others_as_they_are():
    with_flat, without = slivers(), Surface(slivers().vertices, np.delete(slivers().faces, 18, axis=0))
    difference = stiffness(with_flat) - stiffness(without)
    touched = np.unique(difference.tocoo().row[difference.tocoo().data != 0])
    assert touched.tolist() == [0, 1, 16]


def test_all_points_in_one_place_still_give_a_proper_operator():
    s = Surface(np.concatenate([grid(1, 1).vertices, np.zeros((2, 3))]), [[0, 1, 2], [1, 3, 2], [0, 4, 5]])
    assert np.isfinite(stiffness(s).data).all()
    assert (vertex_areas(s)[:4] > 0).all()
    # Vertices 4 and 5 lie where vertex 0 lies.
    field = BiharmonicDistance(s).from_source(1)
    assert field[[4, 5]] == pytest.approx(field[[0, 0]], rel=1e-6)
    nothing_else = Surface(np.zeros((3, 3)), [[0, 1, 2]])
    assert (vertex_areas(nothing_else) > 0).all()


def test_unknown_areas_are_refused():
    with pytest.raises(ParameterError, match="no 'mixed' vertex areas; choose one of voronoi, barycentric"):
        vertex_areas(tetrahedron(), "mixed")


@pytest.mark.parametrize("kind", AREAS)
@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
def test_operators_are_as_without_the_kernel(surface, kind, monkeypatch):
    # Vertices of no face before, between and behind the others; a face alone has no edge in common with another.
    lone = len(surface.vertices)
    x = np.concatenate([[[9.0, 9, 9]], surface.vertices, np.eye(3) + 7, [[8.0, 9, 9]]])
    faces = np.concatenate([surface.faces + 1, [[lone + 3, lone + 1, lone + 2]]])
    with_kernel = Surface(x, faces)
    matrix, areas = operators(with_kernel, kind)
    for module in ("operators", "surface"):
        monkeypatch.setattr(f"bihdist_core.{module}.library", lambda: None)
    plain = Surface(x, faces)
    expected, expected_areas = operators(plain, kind)
    assert np.array_equal(with_kernel.component_of_vertex, plain.component_of_vertex)
    assert sp.csr_matrix((matrix.data, matrix.indices, matrix.indptr)).has_canonical_format
    assert abs(matrix - expected).max() <= 1e-12 * abs(expected).max()
    assert np.abs(areas - expected_areas).max() <= 1e-12 * expected_areas.max()
    assert np.abs(with_kernel.face_heights - plain.face_heights).max() <= 1e-12
