"""Meshes that are finer around some of their vertices."""

import numpy as np
import pytest

from bihdist_core import ParameterError, Surface, VertexError
from bihdist_core.applications.local_refinement import refined_around
from tests.shapes import bumpy, grid


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
