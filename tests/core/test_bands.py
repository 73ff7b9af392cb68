"""The part of a surface between two values: its area, its rim, and the fields on it."""

from itertools import pairwise

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, ParameterError, isolines, read_surface
from bihdist_core.analysis.bands import band
from bihdist_core.formats.field_output import write_fields
from tests.shapes import MESHES, fin, grid, needs_meshes, two_pieces


def test_on_a_plane_the_area_is_known():
    plane = grid(5, 4)
    x, y = plane.vertices[:, 0], plane.vertices[:, 1]
    assert band(plane, x, 0.3, 1.7).area == pytest.approx(4 * 1.4, rel=1e-12)
    assert band(plane, x, 1, 3).area == pytest.approx(8, rel=1e-12)
    assert band(plane, x + y, high=0.5).area == pytest.approx(0.125, rel=1e-12)
    assert band(plane, x + y, low=8.5).area == pytest.approx(0.125, rel=1e-12)
    assert band(plane, x - y, -0.25, 0.25).surface.is_manifold


def test_it_and_the_rest_are_the_whole(rough, field):
    low, high = 0.3 * field.max(), 0.7 * field.max()
    parts = [band(rough, field, *ends) for ends in ((-np.inf, low), (low, high), (high, np.inf))]
    assert sum(part.area for part in parts) == pytest.approx(rough.face_areas.sum(), rel=1e-12)
    assert np.array_equal(np.sort(np.concatenate([part.vertices for part in parts])), np.arange(300))
    assert sum(len(part.faces) for part in parts) < len(rough.faces)
    assert np.array_equal(parts[1].vertices, np.flatnonzero((field >= low) & (field <= high)))


def test_its_rim_is_the_isolines(rough, field):
    low, high = 0.3 * field.max(), 0.7 * field.max()
    part = band(rough, field, low, high)
    assert part.surface.is_manifold
    assert not part.surface.unreferenced_count
    rim = part.surface.vertices[part.surface.boundary_edges]
    lines = sum(line.length for line in isolines(rough, field, [low, high]))
    assert np.linalg.norm(rim[:, 0] - rim[:, 1], axis=1).sum() == pytest.approx(lines, rel=1e-12)
    assert part.surface.boundary_loop_count == len(isolines(rough, field, [low, high]))


def test_fields_are_interpolated_and_faces_keep_their_sense(rough, field):
    low, high = 0.3 * field.max(), 0.7 * field.max()
    part = band(rough, field, low, high)
    values = part.along(field)
    assert values.min() == pytest.approx(low, rel=1e-12)
    assert values.max() == pytest.approx(high, rel=1e-12)
    assert np.allclose(part.along(rough.vertices), part.surface.vertices, 0, 1e-14)

    def normals(surface, faces):
        a, b, c = (surface.vertices[faces[:, k]] for k in range(3))
        return np.cross(b - a, c - a)

    mine, whole = normals(part.surface, part.surface.faces), normals(rough, rough.faces[part.parents])
    sizes = np.linalg.norm(mine, axis=1) * np.linalg.norm(whole, axis=1)
    assert np.allclose(np.einsum("ij,ij->i", mine, whole), sizes, 0, 1e-9 * sizes.max())


def test_values_at_vertices_make_no_flat_faces():
    plane = grid(4, 4)
    part = band(plane, plane.vertices[:, 0] - plane.vertices[:, 1], -1, 2)
    assert not len(part.surface.degenerate_faces)
    assert not part.surface.repairs
    assert (part.parameters == 0).all()


def test_missing_values_and_any_mesh():
    both = two_pieces()
    field = BiharmonicDistance(both).from_source(0)
    part = band(both, field, high=np.nanmax(field) / 2)
    assert part.vertices.max() < 60
    strange = fin()
    assert band(strange, strange.vertices[:, 2], 0.2, 1.5).area < strange.face_areas.sum()


def test_is_written_as_a_mesh_with_the_field(tmp_path, rough, field):
    part = band(rough, field, 0.2, 0.3)
    write_fields(tmp_path / "part.ply", part.surface, {"biharmonic": part.along(field)})
    again = read_surface(tmp_path / "part.ply")
    assert np.array_equal(again.faces, part.surface.faces)


def test_bad_values_are_refused(rough, field):
    with pytest.raises(ParameterError, match="the smaller first, not 2 and 1"):
        band(rough, field, 2, 1)
    with pytest.raises(ParameterError, match="not nan and 1"):
        band(rough, field, np.nan, 1)
    with pytest.raises(ParameterError, match="nowhere between 5e"):
        band(rough, field, 5e6, 6e6)
    with pytest.raises(ParameterError, match="each of 300 vertices"):
        band(rough, field[:-1], 0, 1)


@needs_meshes
@pytest.mark.parametrize("name", ["bunny_raw.obj", "suzanne.obj", "camelhead.off"])
def test_real_meshes(name):
    surface = read_surface(MESHES / name)
    source = int(np.flatnonzero(surface.component_of_vertex == 0)[0])
    field = BiharmonicDistance(surface).from_source(source)
    levels = np.nanmax(field) * np.array([0, 0.2, 0.5, 1])
    areas = [band(surface, field, *pair).area for pair in pairwise(levels)]
    mine = np.isfinite(field[surface.faces]).all(axis=1)
    assert sum(areas) == pytest.approx(surface.face_areas[mine].sum(), rel=1e-9)
