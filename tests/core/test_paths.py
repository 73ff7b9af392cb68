"""Paths on a surface: on it, as long as geodesic distance says, and fields read along them exactly."""

import json
from itertools import pairwise

import numpy as np
import pytest

from bihdist_core import (
    GeodesicDistance,
    OutputError,
    ParameterError,
    SolverError,
    SurfacePoint,
    VertexError,
    isolines,
    read_surface,
)
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from bihdist_core.analysis.places import Places
from bihdist_core.analysis.plane_sections import plane_section
from bihdist_core.analysis.surface_paths import write_profile
from bihdist_core.errors import Cancelled
from bihdist_core.kernel import library
from bihdist_core.sources.words import places_from
from tests.shapes import (
    MESHES,
    bumpy,
    caps,
    fin,
    grid,
    needles,
    needs_kernel,
    needs_meshes,
    slivers,
    sphere,
    torus,
    two_pieces,
)

ROUNDING = 1e-12
"""Of lengths."""


def check(surface, path):
    """Each piece lies in its face, the pieces join, and lengths and points are those of the weights."""
    x = surface.vertices
    assert np.array_equal(surface.faces[path.faces], path.corners)
    for weights, points in ((path.begins, path.points[:-1]), (path.ends, path.points[1:])):
        assert weights.min() >= 0
        assert np.allclose(weights.sum(axis=1), 1, 0, 1e-12)
        assert np.allclose(np.einsum("kc,kcx->kx", weights, x[path.corners]), points, 0, 1e-12)
    assert path.arcs[0] == 0
    assert path.length == pytest.approx(np.linalg.norm(np.diff(path.points, axis=0), axis=1).sum(), rel=1e-12)
    assert np.allclose(path.along(x), path.points, 0, 1e-12)


@pytest.fixture(scope="module")
def rough():
    return bumpy(400)


@pytest.fixture(scope="module")
def paths(rough):
    return GeodesicPaths(rough)


@pytest.mark.parametrize("method", ["exact", "edges"])
def test_is_as_long_as_geodesic_distance(rough, paths, method):
    distance = GeodesicDistance(rough, "dijkstra" if method == "edges" else "exact")
    found = [paths.path([3, v], method) for v in range(20, 400, 40)]
    lengths = distance.from_source(3)[20::40]
    for path in found:
        check(rough, path)
        assert (path.method, path.knots.tolist()) == (method, [0, len(path.points) - 1])
    assert np.allclose([p.length for p in found], lengths, ROUNDING, 0)


@pytest.mark.parametrize("method", ["exact", "edges"])
def test_leads_through_places_in_faces_and_on_edges(rough, paths, method):
    places = [5, SurfacePoint.of(10, 0.2, 0.5), SurfacePoint.of(300, 0.5, 0.5), SurfacePoint.of(300, 0.2, 0.2), 77]
    path = paths.path(places, method)
    check(rough, path)
    assert np.allclose(path.points[path.knots], Places.of(rough, places).values(rough.vertices), 0, 1e-12)
    # No more points than crossings: those on the auxiliary edges around a place are left out.
    inner = np.delete(np.arange(len(path.points)), path.knots)
    assert (np.sort(path.places.weights[inner], axis=1)[:, 0] == 0).all()


def test_on_a_plane_the_path_is_the_segment():
    plane = grid(5, 4)
    path = GeodesicPaths(plane).path([SurfacePoint.of(0, 0.3, 0.3), 29], "exact")
    a = Places.of(plane, [SurfacePoint.of(0, 0.3, 0.3)]).values(plane.vertices)[0]
    assert path.length == pytest.approx(np.linalg.norm(plane.vertices[29] - a), rel=ROUNDING)
    # A linear field is linear in arc length.
    assert np.allclose(path.along(plane.vertices[:, 0]), a[0] + path.arcs / path.length * (5 - a[0]), 0, 1e-6)


def test_fields_are_read_exactly_between_the_points_too(rough, paths):
    field = np.sin(7 * rough.vertices @ [1.0, 2.0, 3.0])
    path = paths.path([3, 200], "exact")
    s = np.linspace(0, path.length, 500)
    places = path.at(s)
    assert np.allclose(places.values(field), np.interp(s, path.arcs, path.along(field)), 0, 1e-12)
    gone = np.linalg.norm(np.diff(places.values(rough.vertices), axis=0), axis=1).sum()
    assert gone <= path.length
    assert np.allclose(path.at([-1, 9 * path.length]).values(rough.vertices), path.points[[0, -1]], 0, 1e-12)


def test_values_that_are_missing_beside_the_path_do_not_count():
    plane = grid(4, 1)
    field = np.append(np.arange(5.0), np.full(5, np.nan))
    path = GeodesicPaths(plane).path([0, 4], "edges")
    assert path.along(field).tolist() == [0, 1, 2, 3, 4]


def test_a_split_surface_is_the_same_shape(rough):
    places = Places.of(
        rough,
        [
            4,
            SurfacePoint.of(7, 0.2, 0.3),
            SurfacePoint.of(7, 0.5, 0.5),
            SurfacePoint.of(7, 0.1, 0.1),
            SurfacePoint.of(7, 0.2, 0.3),
            SurfacePoint.of(9, 0, 0.25),
        ],
    )
    split = places.split(rough)
    assert split.vertices.tolist() == [4, 400, 401, 402, 400, 403]
    assert split.surface.is_manifold
    assert split.surface.genus == 0
    # A place on an edge splits the faces on both sides.
    assert split.surface.boundary_loop_count == 0
    assert split.surface.face_areas.sum() == pytest.approx(rough.face_areas.sum(), rel=1e-12)
    areas = np.bincount(split.parents, split.surface.face_areas)
    assert np.allclose(areas, rough.face_areas, 1e-9, 0)
    assert np.allclose(split.surface.vertices[split.vertices], places.values(rough.vertices), 0, 1e-14)


def test_profiles_are_written_and_read_back(rough, paths, tmp_path):
    path, field = paths.path([3, SurfacePoint.of(10, 0.2, 0.5), 200]), rough.vertices[:, 0]
    for name in ("a.csv", "a.npy", "a.json", "a.vtp"):
        write_profile(tmp_path / name, path, {"x of it": field})
    table = np.loadtxt(tmp_path / "a.csv", delimiter=",", skiprows=1)
    assert (tmp_path / "a.csv").read_text().startswith("arc,x,y,z,face,b0,b1,b2,x of it\n")
    assert np.array_equal(table, np.load(tmp_path / "a.npy"))
    assert np.array_equal(table[:, 0], path.arcs)
    assert np.array_equal(table[:, 8], path.along(field))
    said = json.loads((tmp_path / "a.json").read_text())
    again = Places.of(rough, places_from(said["points"], "points"))
    assert np.allclose(again.values(rough.vertices), path.points, 0, 1e-12)
    assert said["fields"]["x of it"] == path.along(field).tolist()
    io = pytest.importorskip("vtkmodules.vtkIOXML", reason="VTK is not installed")
    reader = io.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "a.vtp"))
    reader.Update()
    assert reader.GetOutput().GetCell(0).GetNumberOfPoints() == len(path.points)
    write_profile(tmp_path / "a.obj", path, {"x of it": field})
    *rows, group, line = (row.split() for row in (tmp_path / "a.obj").read_text().splitlines())
    assert np.array_equal(np.array([row[1:] for row in rows], float), path.points)
    assert (group, line) == (["g", repr(path.length)], ["l", *(str(k + 1) for k in range(len(rows)))])
    with pytest.raises(ParameterError, match="a profile needs one"):
        write_profile(tmp_path / "b.csv", path, {"all": rough.vertices})
    with pytest.raises(OutputError, match=r"\.csv, \.npy, \.vtp, \.json"):
        write_profile(tmp_path / "b.txt", path)


@needs_kernel
def test_auto_is_exact_where_there_is_the_compiled_kernel(monkeypatch, rough):
    for surface in (rough, fin()):
        assert GeodesicPaths(surface).path([0, 4]).label == "shortest geodesic, exact"
    monkeypatch.setattr(library, "library", lambda: None)
    assert GeodesicPaths(rough).path([0, 9]).label == "shortest path along edges"
    with pytest.raises(SolverError, match="needs the compiled kernel"):
        GeodesicPaths(rough).path([0, 9], "exact")


def test_stays_on_its_component_and_keeps_the_ids():
    both = two_pieces()
    path = GeodesicPaths(both).path([61, 63], "exact")
    check(both, path)
    assert set(path.corners.ravel()) <= {61, 62, 63, 64}
    with pytest.raises(ParameterError, match="joins 0 and 63: they are on different components"):
        GeodesicPaths(both).path([0, 63])
    with pytest.raises(ParameterError, match=r"joins f0:0\.2,0\.2 and 63: they are on different components"):
        plane_section(both, ["f0:0.2,0.2", 63], [0, 0, 1])
    with pytest.raises(VertexError, match="vertex 60"):
        GeodesicPaths(both).path([0, 60])


def test_bad_requests_are_refused(paths):
    for places, match in [
        ([3], "two places or more; 1"),
        ([], "two places or more; 0"),
        ([3, 5, 5], "places 1 and 2 of a path are the same, 5"),
        ([3, (1, 0.5)], "A source is a vertex id, a SurfacePoint"),
        ([3, "loop:0"], "one point; loop:0 is not"),
        ([3, SurfacePoint.of(99999, 0.2, 0.2)], "no face 99999"),
        ([3, "f0:0.7,0.7"], "0.7 and 0.7 leave -0.4"),
        ([3, "f17:0.2,0.5", SurfacePoint.of(17, 0.2, 0.5)], "places 1 and 2 of a path are the same, f17:0.2,0.5"),
    ]:
        with pytest.raises(ParameterError, match=match):
            paths.path(places)
    with pytest.raises(ParameterError, match="no path method 'best'"):
        paths.path([3, 4], "best")


def test_is_cancelled_and_goes_on():
    paths = GeodesicPaths(sphere(30_000))

    def cancel(_fraction, _text):
        raise Cancelled

    with pytest.raises(Cancelled):
        paths.path([0, 1], "exact", cancel)
    assert paths.path([0, 1], "exact").length > 0


@pytest.mark.parametrize("shape", [slivers(), caps(bumpy(100), 1e-9, 7), needles(bumpy(100), 1e-4, 9)])
def test_flat_faces_are_no_obstacle(shape):
    paths, x = GeodesicPaths(shape), shape.vertices
    for a, b in np.random.default_rng(0).choice(len(x), (12, 2)):
        if a != b:
            path, edges = paths.path([int(a), int(b)]), paths.path([int(a), int(b)], "edges")
            check(shape, path)
            assert np.linalg.norm(x[a] - x[b]) * (1 - ROUNDING) <= path.length <= edges.length * (1 + ROUNDING)


@needs_kernel
def test_a_vertex_of_a_flat_face_is_reached_through_its_side():
    shape = slivers()
    path = GeodesicPaths(shape).path([11, 16])
    check(shape, path)
    apart = shape.vertices[11] - shape.vertices[16]
    assert path.length == pytest.approx(np.linalg.norm(apart), rel=ROUNDING)


def test_a_section_lies_in_its_plane_and_ends_in_its_places(rough):
    places = [SurfacePoint.of(8, 0.2, 0.3), 250]
    path = plane_section(rough, places, [0.3, 0.2, 1])
    check(rough, path)
    ends = Places.of(rough, places).values(rough.vertices)
    assert np.allclose(path.points[[0, -1]], ends, 0, 1e-12)
    normal = np.cross(ends[1] - ends[0], [0.3, 0.2, 1])
    normal /= np.linalg.norm(normal)
    assert np.abs((path.points - ends[0]) @ normal).max() < 1e-12
    # It is part of the whole section, and not longer than the rest of it.
    whole = sum(line.length for line in isolines(rough, (rough.vertices - ends[0]) @ normal, [0.0]))
    assert path.length <= whole / 2 * (1 + 1e-12)


def test_a_section_through_vertices_of_a_plane():
    plane = grid(4, 4)
    path = plane_section(plane, [0, 24], [0, 0, 1])
    check(plane, path)
    assert path.length == pytest.approx(np.sqrt(32), rel=1e-12)
    # Along the rim all other vertices are above the plane, from one of its sides.
    for places in ([0, 4], [4, 0]):
        assert plane_section(plane, places, [0, 0, 1]).length == pytest.approx(4, rel=1e-12)


def test_both_ways_of_a_section_make_the_whole(rough):
    places = [SurfacePoint.of(8, 0.2, 0.3), 250]
    short, long, whole = (plane_section(rough, places, [0.3, 0.2, 1], part) for part in ("shorter", "longer", "whole"))
    ends = Places.of(rough, places).values(rough.vertices)
    normal = np.cross(ends[1] - ends[0], [0.3, 0.2, 1])
    for path in (short, long, whole):
        check(rough, path)
        assert np.abs((path.points - ends[0]) @ normal).max() < 1e-12 * np.linalg.norm(normal)
        assert np.allclose(path.points[path.knots], ends if path is not whole else ends[[0, 1, 0]], 0, 1e-12)
    assert short.length < long.length
    assert whole.arcs[whole.knots] == pytest.approx([0, short.length, short.length + long.length], rel=1e-12)
    lines = isolines(rough, (rough.vertices - ends[0]) @ normal, [0.0])
    assert min(abs(line.length - whole.length) for line in lines) < 1e-9 * whole.length


def test_the_whole_of_an_open_section_goes_from_end_to_end():
    plane = grid(4, 4)
    for places in ([6, 18], [18, 6], [0, 18], [18, 24], [0, 24]):
        path = plane_section(plane, places, [0, 0, 1], "whole")
        check(plane, path)
        assert path.length == pytest.approx(np.sqrt(32), rel=1e-12)
        assert np.allclose(path.points[path.knots], plane.vertices[places])
        assert path.knots[0] < path.knots[1]


def test_sections_are_led_from_place_to_place(rough):
    places, d = [3, SurfacePoint.of(8, 0.2, 0.3), 250, 120], [0.3, 0.2, 1]
    path = plane_section(rough, places, d)
    check(rough, path)
    assert np.allclose(path.points[path.knots], Places.of(rough, places).values(rough.vertices), 0, 1e-12)
    parts = [plane_section(rough, pair, d).length for pair in pairwise(places)]
    assert np.diff(path.arcs[path.knots]) == pytest.approx(parts, rel=1e-9)


def test_sections_that_do_not_join_are_refused(rough):
    with pytest.raises(ParameterError, match="make no plane"):
        plane_section(rough, [0, 9], rough.vertices[9] - rough.vertices[0])
    with pytest.raises(ParameterError, match="three finite numbers"):
        plane_section(rough, [0, 9], [0, 0, np.nan])
    with pytest.raises(ParameterError, match="joins two places or more; 1"):
        plane_section(rough, [0], [0, 0, 1])
    with pytest.raises(ParameterError, match="through two places; 3"):
        plane_section(rough, [0, 9, 7], [0, 0, 1], "whole")
    with pytest.raises(ParameterError, match="places 1 and 2 of a section are the same, 9"):
        plane_section(rough, [0, 9, 9], [0, 0, 1])
    with pytest.raises(ParameterError, match="no part 'half'; choose one of shorter, longer, whole"):
        plane_section(rough, [0, 9], [0, 0, 1], "half")
    with pytest.raises(ParameterError, match="joins 0 and 24 in one way only"):
        plane_section(grid(4, 4), [0, 24], [0, 0, 1], "longer")
    ring = torus()
    across = [0, int(ring.vertices[:, 0].argmin())]
    with pytest.raises(ParameterError, match=r"does not join 0 and \d+; turn"):
        plane_section(ring, across, [0, 1e-3, 1])


@needs_meshes
@pytest.mark.parametrize("name", ["camelhead.off", "bunny_raw.obj", "fertility.off"])
def test_real_meshes(name):
    surface = read_surface(MESHES / name)
    paths = GeodesicPaths(surface)
    used = np.flatnonzero(surface.component_of_vertex == 0)
    a, b = np.random.default_rng(1).choice(used, 2).tolist()
    shortest, edges = (paths.path([a, b], m) for m in ("exact", "edges"))
    for path in (shortest, edges):
        check(surface, path)
    assert shortest.length == pytest.approx(GeodesicDistance(surface, "exact").between(a, b), rel=ROUNDING)
    assert shortest.length <= edges.length


def test_a_section_along_vertices_goes_through_them():
    plane = grid(8, 8)
    for start, stop in ((70, 10), (10, 70), (0, 80)):
        # Across the diagonal, heights of the vertices on it are rounding.
        path = plane_section(plane, [start, stop], [0, 0, 1])
        check(plane, path)
        assert path.length == pytest.approx(np.linalg.norm(plane.vertices[start] - plane.vertices[stop]), rel=1e-12)
