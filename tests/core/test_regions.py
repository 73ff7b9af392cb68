"""Voronoi regions: against the least of values interpolated at many points, and what must hold of boundaries."""

import json

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, GeodesicDistance, ParameterError, Surface, read_surface
from bihdist_core.analysis.clipping import clipped, polygon_fractions
from bihdist_core.analysis.region_boundaries import region_boundaries, write_boundaries
from bihdist_core.analysis.region_mesh import region_mesh
from bihdist_core.analysis.regions import voronoi_regions
from bihdist_core.formats.field_output import write_fields
from tests.shapes import MESHES, bumpy, fin, grid, needs_meshes, two_pieces


def finely(surface, fields, times):
    """Areas of the regions, each face cut into times ** 2 equal ones, of which the middle decides."""
    steps = [(i, j) for i in range(times) for j in range(times - i)]
    middles = [((3 * i + 1) / (3 * times), (3 * j + 1) / (3 * times)) for i, j in steps]
    middles += [((3 * i + 2) / (3 * times), (3 * j + 2) / (3 * times)) for i, j in steps if i + j < times - 1]
    b = np.array([(p, q, 1 - p - q) for p, q in middles])
    assert len(b) == times**2
    areas = np.zeros(fields.shape[1])
    for weights in b:
        least = np.einsum("c,mck->mk", weights, fields[surface.faces]).argmin(axis=1)
        areas += np.bincount(least, surface.face_areas / times**2, minlength=len(areas))
    return areas


def check(surface, fields, found):
    """Along each segment its two fields are equal and no other is less; ends lie in the face."""
    assert found.areas.sum() == pytest.approx(surface.face_areas.sum(), rel=1e-12)
    at = fields[surface.faces[found.faces]]
    scale = np.abs(fields).max()
    for t in (0, 0.3, 1):
        weights = (1 - t) * found.weights[:, 0] + t * found.weights[:, 1]
        assert weights.min(initial=0) >= 0
        values = np.einsum("sc,sck->sk", weights, at)
        i, j = np.take_along_axis(values, found.between, axis=1).T
        assert np.allclose(i, j, 0, 1e-12 * scale)
        assert (i <= values.min(axis=1) + 1e-12 * scale).all()
    assert (found.between[:, 0] < found.between[:, 1]).all()


@pytest.mark.parametrize("k", [2, 5, 40])
def test_areas_are_those_of_a_fine_subdivision(k):
    surface = bumpy(300)
    pins = np.random.default_rng(k).choice(300, k, replace=False)
    fields = BiharmonicDistance(surface).from_sources(pins)
    found = voronoi_regions(surface, fields)
    check(surface, fields, found)
    assert np.array_equal(found.labels, fields.argmin(axis=1))
    # The middle decides wrongly only in small faces that a boundary crosses; halves of them at random.
    assert np.allclose(found.areas, finely(surface, fields, 24), 0, 1e-3 * surface.face_areas.sum())
    assert len(found.meetings) > 0 or k == 2


def test_random_fields_have_regions_that_no_vertex_is_in():
    surface = bumpy(60)
    fields = np.random.default_rng(0).random((60, 8))
    fields[:, 7] = 0.28
    found = voronoi_regions(surface, fields)
    check(surface, fields, found)
    assert np.allclose(found.areas, finely(surface, fields, 64), 0, 1e-3 * surface.face_areas.sum())
    # At a meeting the three fields are equal: three segments end there.
    ends = found.segments.reshape(-1, 3)
    for point in found.meetings:
        assert (np.linalg.norm(ends - point, axis=1) < 1e-9).sum() >= 3


def test_boundaries_are_closed_curves_that_meet_in_threes():
    surface = bumpy(300)
    found = voronoi_regions(surface, BiharmonicDistance(surface).from_sources([3, 50, 120, 200, 260]))
    ends = np.round(found.segments.reshape(-1, 3), 9)
    _, count = np.unique(ends, axis=0, return_counts=True)
    assert set(count) == {2, 3}
    assert (count == 3).sum() == len(found.meetings)
    # On a sphere: corners less edges plus regions is 2, three edges a corner.
    assert len(found.meetings) == 2 * 5 - 4


@pytest.mark.parametrize("k", [2, 5, 20])
def test_segments_make_curves_from_meeting_to_meeting(k):
    surface = bumpy(300)
    pins = np.random.default_rng(k).choice(300, k, replace=False)
    found = voronoi_regions(surface, BiharmonicDistance(surface).from_sources(pins))
    curves = region_boundaries(surface, found)
    assert sum(curve.length for curve in curves) == pytest.approx(found.lengths.sum(), rel=1e-12)
    for curve in curves:
        if not curve.closed:
            for end in curve.points[[0, -1]]:
                assert np.linalg.norm(found.meetings - end, axis=1).min() < 1e-9
    assert 2 * sum(not curve.closed for curve in curves) == 3 * len(found.meetings)
    if k == 2:
        assert [curve.closed for curve in curves] == [True]


def test_boundaries_end_at_the_rim_and_run_along_edges_as_one_curve():
    plane = grid(6, 6)
    x, y = plane.vertices[:, 0], plane.vertices[:, 1]
    (curve,) = region_boundaries(plane, voronoi_regions(plane, np.stack([x, 6 - x], 1)))
    assert (curve.between, curve.closed, curve.length) == ((0, 1), False, pytest.approx(6, rel=1e-12))
    assert sorted(curve.points[[0, -1], 1]) == [0, 6]
    (slanted,) = region_boundaries(plane, voronoi_regions(plane, np.stack([x + 0.3 * y, 6 - x], 1)))
    assert not slanted.closed
    assert sorted(slanted.points[[0, -1], 1]) == [0, 6]


def test_boundaries_are_written_with_the_names_of_their_regions(tmp_path):
    surface = bumpy(300)
    curves = region_boundaries(
        surface, voronoi_regions(surface, BiharmonicDistance(surface).from_sources([3, 50, 120]))
    )
    for name in ("a.csv", "a.obj", "a.vtp", "a.json"):
        write_boundaries(tmp_path / name, curves, [7, 8, 9])
    rows = (tmp_path / "a.csv").read_text().splitlines()
    assert rows[0] == "line,region,other,closed,x,y,z"
    assert rows[1].startswith("0,7,8,")
    assert len(rows) == 1 + sum(len(curve.points) for curve in curves)
    assert json.loads((tmp_path / "a.json").read_text())["boundaries"][0]["points"] == curves[0].points.tolist()
    assert "g 7_8\nl " in (tmp_path / "a.obj").read_text()


@pytest.mark.parametrize("k", [2, 5, 20])
def test_the_mesh_of_regions_is_the_surface_cut_along_the_boundaries(k, tmp_path):
    surface = bumpy(300)
    fields = BiharmonicDistance(surface).from_sources(np.random.default_rng(k).choice(300, k, replace=False))
    found, mesh = voronoi_regions(surface, fields), region_mesh(surface, fields)
    cut, of_face = mesh.surface, mesh.regions[mesh.surface.faces]
    assert (of_face == of_face[:, :1]).all()
    assert np.allclose(np.bincount(of_face[:, 0], cut.face_areas, minlength=k), found.areas, 1e-9, 1e-12)
    values = mesh.along(fields)
    assert np.allclose(values[np.arange(len(values)), mesh.regions], values.min(axis=1), 0, 1e-12)
    assert np.allclose(mesh.along(surface.vertices), cut.vertices, 0, 1e-14)
    # The parts of a region have common vertices, so its rim is the boundary.
    ends = cut.vertices[cut.boundary_edges]
    assert np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum() == pytest.approx(2 * found.lengths.sum(), rel=1e-9)
    write_fields(tmp_path / "a.ply", cut, {"region": mesh.regions})
    assert len(read_surface(tmp_path / "a.ply").faces) == len(cut.faces)


def test_vertices_on_a_boundary_are_there_for_each_region():
    plane = grid(4, 3)
    fields = np.stack([plane.vertices[:, 0], 4 - plane.vertices[:, 0]], 1)
    mesh = region_mesh(plane, fields)
    assert mesh.surface.n_components == 2
    assert np.bincount(mesh.regions).tolist() == [12, 12]
    assert np.bincount(mesh.regions[mesh.surface.faces[:, 0]], mesh.surface.face_areas).tolist() == [6, 6]


def test_where_boundaries_run_along_edges():
    plane = grid(4, 3)
    x = plane.vertices[:, 0]
    found = voronoi_regions(plane, np.stack([x, 4 - x], 1))
    assert found.areas.tolist() == [6, 6]
    assert found.lengths.sum() == pytest.approx(3, rel=1e-12)
    assert np.allclose(found.segments[..., 0], 2, 0, 1e-12)
    assert len(found.segments) == 3
    # A third field is less over the middle two thirds of that line.
    third = 1 + np.abs(plane.vertices[:, 1] - 1.5)
    found = voronoi_regions(plane, np.stack([x, 4 - x, third], 1))
    check(plane, np.stack([x, 4 - x, third], 1), found)
    pair = (found.between == (0, 1)).all(axis=1)
    assert np.allclose(found.areas, finely(plane, np.stack([x, 4 - x, third], 1), 96), 0, 0.02)
    assert found.lengths[pair].sum() == pytest.approx(1, rel=1e-12)


def test_of_equal_fields_the_first_has_the_region():
    plane = grid(3, 3)
    x = plane.vertices[:, 0]
    found = voronoi_regions(plane, np.stack([x, x, 3 - x, x], 1))
    assert np.allclose(found.areas, [4.5, 0, 4.5, 0], 0, 1e-12)
    assert set(map(tuple, found.between.tolist())) == {(0, 2)}
    assert np.array_equal(voronoi_regions(plane, x[:, None]).areas, [9])


@pytest.mark.parametrize("step", [1, 0.1, 1e-200])
def test_where_several_boundaries_coincide_there_is_one(step):
    surface = bumpy(300)
    fields = step * np.random.default_rng(5).integers(0, 4, (300, 6))
    found, cut = voronoi_regions(surface, fields), region_mesh(surface, fields).surface
    check(surface, fields, found)
    ends = cut.vertices[cut.boundary_edges]
    assert np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum() == pytest.approx(2 * found.lengths.sum(), rel=1e-9)


def test_no_face_need_be_in_one_region():
    face = Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    found = voronoi_regions(face, np.eye(3) * -1)
    check(face, np.eye(3) * -1, found)
    assert found.areas == pytest.approx([1 / 6] * 3, rel=1e-12)


def test_a_field_that_is_not_finite_has_no_region_there():
    plane = grid(4, 3)
    x = plane.vertices[:, 0]
    whole = voronoi_regions(plane, np.stack([x, 4 - x], 1))
    for nothing in (np.nan, np.inf, -np.inf):
        fields = np.stack([x, np.full(len(x), nothing), 4 - x, np.where(x == 4, nothing, 0)], 1)
        found = voronoi_regions(plane, fields[:, :3])
        assert np.array_equal(found.areas, whole.areas[[0, 0, 1]] * [1, 0, 1])
        assert set(found.labels) == {0, 2}
        assert voronoi_regions(plane, fields).areas.tolist() == [0, 0, 3, 9]
        assert np.isfinite(region_mesh(plane, fields).along(fields[:, 2])).all()


def test_components_without_a_pin_belong_to_none():
    both = two_pieces()
    found = voronoi_regions(both, BiharmonicDistance(both).from_sources([0, 30]))
    assert (found.labels[60:] == -1).all()
    assert (found.labels[:60] >= 0).all()
    assert found.areas.sum() == pytest.approx(both.component(0)[0].face_areas.sum(), rel=1e-12)
    each = voronoi_regions(both, BiharmonicDistance(both).from_sources([0, 30, 62]))
    assert (each.labels[61:] == 2).all()
    assert each.areas.sum() == pytest.approx(both.face_areas.sum(), rel=1e-12)
    assert np.allclose(each.areas[:2], found.areas, 1e-12, 0)


def test_numbers_of_the_pins_do_not_matter():
    surface = bumpy(200)
    fields = GeodesicDistance(surface, "dijkstra").from_sources([3, 50, 120, 180])
    turn = [2, 0, 3, 1]
    one, other = voronoi_regions(surface, fields), voronoi_regions(surface, fields[:, turn])
    assert np.allclose(one.areas[turn], other.areas, 1e-12, 0)
    assert one.lengths.sum() == pytest.approx(other.lengths.sum(), rel=1e-9)


def test_any_mesh_and_bad_input():
    strange = fin()
    fields = BiharmonicDistance(strange).from_sources([2, 3, 7])
    check(strange, fields, voronoi_regions(strange, fields))
    for bad in (fields[:, 0], fields[:-1], fields[:, :0]):
        with pytest.raises(ParameterError, match=r"fields \(n, k\) of 8 vertices"):
            voronoi_regions(strange, bad)


def test_clipping_a_triangle():
    whole, sizes = np.eye(3)[None], np.array([3])
    for values, share in [([1, 1, 1], 1), ([-1, -1, 0], 0), ([1, -1, -1], 0.25), ([-1, 1, 1], 0.75), ([1, 0, -1], 0.5)]:
        polygons, counts = clipped(whole, sizes, np.array([values], float))
        assert polygon_fractions(polygons, counts)[0] == pytest.approx(share, abs=1e-15)


@needs_meshes
def test_on_a_real_mesh_the_regions_are_those_of_a_fine_subdivision():
    surface = read_surface(MESHES / "hand_lowres.obj")
    fields = BiharmonicDistance(surface).from_sources([5, 100, 300, 500, 700])
    found = voronoi_regions(surface, fields)
    check(surface, fields, found)
    assert np.allclose(found.areas, finely(surface, fields, 16), 0, 1e-3 * surface.face_areas.sum())


def test_one_region_has_no_boundaries():
    surface = grid(4, 4)
    columns = surface.vertices[:, :1]
    assert region_boundaries(surface, voronoi_regions(surface, columns)) == []
