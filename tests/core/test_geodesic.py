"""Geodesic distance: the choice among its methods, along edges, and on meshes pressed onto a line."""

import threading
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components, dijkstra

import bihdist_core.distances.geodesic_solvers as geodesic_solvers
import bihdist_core.distances.heat_geodesic as heat_geodesic
import bihdist_core.distances.heat_times as heat_times
from bihdist_core import (
    Cancelled,
    GeodesicDistance,
    ParameterError,
    SolverError,
    Surface,
    SurfacePoint,
    read_surface,
)
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.errors import VertexError
from bihdist_core.kernel import library
from tests.core.nasty_meshes import nasty_mesh
from tests.shapes import (
    ORACLE,
    ORACLE_NAMES,
    bumpy,
    fin,
    grid,
    needs_kernel,
    needs_oracle,
    oracle_surface,
    torus,
    two_pieces,
)
from tests.waiting import PATIENCE

MESHES = Path(__file__).parents[2].parent / "shared" / "meshes"


@needs_kernel
def test_auto_is_exact_up_to_some_work_on_any_surface(monkeypatch):
    for surface in (bumpy(100), fin(), two_pieces()):
        assert GeodesicDistance(surface).label == "geodesic, exact"
    monkeypatch.setattr(geodesic_solvers, "QUICK_WINDOWS", 99**1.5)
    assert GeodesicDistance(bumpy(100)).label == "geodesic, approximate"


def test_without_the_compiled_kernel_auto_is_heat_and_exact_says_why_not(monkeypatch):
    monkeypatch.setattr(library, "library", lambda: None)
    assert GeodesicDistance(bumpy(100)).label == "geodesic, heat method"
    with pytest.raises(SolverError, match=r"needs the compiled kernel( \(.*\))?; use the heat method"):
        GeodesicDistance(bumpy(100), "exact")


@needs_kernel
def test_a_radius_ends_what_the_exact_method_does(monkeypatch):
    surface, place = two_pieces(), SurfacePoint.of(30, 0.2, 0.5)
    whole, near = GeodesicDistance(surface), GeodesicDistance(surface, radius=1.0)

    def check(found, full):
        assert np.array_equal(found, np.where(full > 1, np.inf, full), equal_nan=True)

    check(near.from_sources([0, 30]), whole.from_sources([0, 30]))
    check(near.from_source(place), whole.from_source(place))
    check(near.from_source("3+40"), whole.from_source("3+40"))
    check(near.pairwise([0, 7, 62]), whole.pairwise([0, 7, 62]))
    away = whole.from_source(0)
    for targets in ([int(np.nanargmax(away))], np.flatnonzero(away > 0)):  # few of a source, and many
        pairs = np.column_stack([np.zeros(len(targets), int), targets])
        assert (whole.of_pairs(pairs) > 1).any()
        check(near.of_pairs(pairs), whole.of_pairs(pairs))
    places = [0, place, SurfacePoint.of(30, 0.4, 0.1), SurfacePoint.of(90, 0.2, 0.2), SurfacePoint.of(1, 0.3, 0.3)]
    full = whole.pairwise(places)
    assert (full[0] > 1).any()
    check(near.pairwise(places), full)
    assert np.isinf(GeodesicDistance(surface, radius=1e-3).pairwise(places[1:3])[0, 1])
    monkeypatch.setattr(geodesic_solvers, "is_slow", lambda *_: True)
    assert GeodesicDistance(surface).method == "virtual-sources"
    assert GeodesicDistance(surface, radius=1.0).method == "exact"
    for method in ("virtual-sources", "heat", "dijkstra"):
        with pytest.raises(ParameterError, match=f"Only the exact method has a radius, not {method}"):
            GeodesicDistance(surface, method, radius=1.0)
    for radius in (-1, np.nan):
        with pytest.raises(ParameterError, match=f"A radius is a length of at least 0, not {radius}"):
            GeodesicDistance(surface, radius=radius)


def needles():
    """A closed surface whose triangles are stretched along z: obtuse, with angles down to a few degrees."""
    s = bumpy(1500)
    return Surface(s.vertices * [1, 1, 12], s.faces, "needles")


def heat_error(surface):
    exact = GeodesicDistance(surface, "exact").from_sources([0, 700])
    return np.abs(GeodesicDistance(surface, "heat").from_sources([0, 700]) - exact).mean() / exact.max()


def test_heat_holds_on_bad_triangles(monkeypatch):
    assert heat_error(bumpy(1500)) < 0.02
    assert heat_error(needles()) < 0.05
    with monkeypatch.context() as trusted:
        trusted.setattr(heat_geodesic, "MOST_NEGATIVE", 1.0)
        trusted.setattr(heat_times, "MOST_NEGATIVE", 1.0)
        assert heat_error(needles()) > 0.1  # what would happen if the flow were not made longer
    monkeypatch.setattr(heat_times, "TIME_FACTORS", (1.0,))
    with pytest.raises(SolverError, match="exact and dijkstra"):
        heat_error(needles())


def slivers_at_one_vertex():
    """Needles at one end only, where no probe happens to lie, and the vertex there."""
    s = bumpy(3000)
    x = s.vertices[:, 0]
    points = s.vertices * np.where(x > 0.9 * x.max(), 0.02, 1)[:, None] ** [0, 1, 0]
    return Surface(points, s.faces, "slivers"), int(x.argmax())


def test_each_source_has_the_time_that_serves_it():
    """Of one source among slivers the flow is longer, and those before and after it have theirs."""
    surface, among = slivers_at_one_vertex()
    heat = GeodesicDistance(surface, "heat")
    before = heat.from_source(0)
    field = heat.from_source(among)
    edges = GeodesicDistance(surface, "dijkstra").from_source(among)
    assert np.abs(field - edges).max() < 0.15 * edges.max()
    assert (heat.from_source(0) == before).all()
    assert (GeodesicDistance(surface, "heat").from_source(among) == field).all()


def test_a_longer_flow_is_made_once_and_in_nobodys_way(monkeypatch):
    surface, among = slivers_at_one_vertex()
    wanted = GeodesicDistance(surface, "heat").from_source(among)
    heat = GeodesicDistance(surface, "heat")
    before, flow, gate, made = heat.from_source(0), heat_times.HeatTimes._flow, threading.Event(), []

    def waiting(times, factor, progress):
        made.append(factor)
        progress(0.25, "")
        assert gate.wait(PATIENCE)
        return flow(times, factor, progress)

    def impatient(share, text):
        if "longer flow" in text:
            raise Cancelled

    monkeypatch.setattr(heat_times.HeatTimes, "_flow", waiting)
    for _ in range(2):
        with pytest.raises(Cancelled):
            heat.from_source(among, impatient)
    # Others are answered meanwhile.
    assert (heat.from_source(0) == before).all()
    told = []

    def open_gate(share, text):
        told.append((share, text))
        if "longer flow" in text:
            gate.set()

    assert (heat.from_source(among, open_gate) == wanted).all()
    assert (0.25, "heat method, a longer flow") in told
    assert len(made) == 1


def test_why_there_is_no_longer_flow_is_said_each_time(monkeypatch):
    surface, among = slivers_at_one_vertex()
    heat = GeodesicDistance(surface, "heat")

    def broken(times, factor, progress):
        raise SolverError("no factor")

    monkeypatch.setattr(heat_times.HeatTimes, "_flow", broken)
    for _ in range(2):
        with pytest.raises(SolverError, match="no factor"):
            heat.from_source(among)


@pytest.mark.skipif(not MESHES.is_dir(), reason="the shared sample meshes are not there")
@pytest.mark.parametrize(
    ("mesh", "sources"), [("scorpion_50k.obj", [1378, 20_000]), ("lion_pose05.obj", range(0, 5000, 500))]
)
def test_heat_holds_on_real_slivers(mesh, sources):
    """At factor 1, 1378 of scorpion_50k had a maximum of 0.73 where edges give 12.07."""
    surface = read_surface(MESHES / mesh)
    edges = GeodesicDistance(surface, "dijkstra").from_sources(sources)
    heat = GeodesicDistance(surface, "heat").from_sources(sources)
    assert (np.abs(heat - edges).max(axis=0) < 0.15 * edges.max(axis=0)).all()


@needs_kernel
def test_auto_is_approximate_where_the_exact_method_gives_up(monkeypatch):
    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_WINDOWS_AT_LEAST", 0)
    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_WINDOWS_PER_VERTEX", 0)
    surface = bumpy(300)
    auto, other = GeodesicDistance(surface), GeodesicDistance(surface, "virtual-sources")
    assert auto.label == "geodesic, exact"
    assert np.array_equal(auto.from_source(5), other.from_source(5))
    assert (auto.method, auto.label, auto.is_symmetric) == ("virtual-sources", other.label, False)
    assert auto.error_estimate().text
    with pytest.raises(SolverError, match="was given up after"):
        GeodesicDistance(surface, "exact").from_source(5)


def test_auto_asks_once_where_the_other_method_fails(monkeypatch):
    auto, asked = GeodesicDistance(bumpy(300)), []

    def fails(*_, **__):
        asked.append(1)
        raise SolverError("it fails")

    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_WINDOWS_AT_LEAST", 0)
    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_WINDOWS_PER_VERTEX", 0)
    monkeypatch.setattr("bihdist_core.distances.virtual_sources.VirtualSources._field", fails)
    for times in (1, 2):
        with pytest.raises(SolverError, match="it fails"):
            auto.from_source(5)
        assert (auto.method, len(asked)) == ("virtual-sources", times)


# ---------------------------------------------------------------------- geodesic on a line
def reeb_distances(t, faces):
    """(n, n) of vertices at t (n,): what a face has at one place is one point of it."""
    levels, number, same, ways = np.unique(t).tolist(), {}, [], []
    for face in faces.tolist():
        parts = [(v,) for v in face] + [(min(e), max(e)) for e in combinations(face, 2)]

        def at(level, part):
            """The number of an edge's point at a level: of a vertex, or between two."""
            name = next((v for v in part if t[v] == level), (part, level))
            return number.setdefault(name, len(number))

        within = {part: [x for x in levels if min(t[[*part]]) <= x <= max(t[[*part]])] for part in parts}
        for level in levels:
            same += pairwise([at(level, part) for part in parts if level in within[part]])
        ways += [(at(x, part), at(y, part), y - x) for part in parts for x, y in pairwise(within[part])]
    joined = sp.coo_matrix((np.ones(len(same)), np.transpose(same)), shape=(len(number),) * 2)
    count, point = connected_components(joined, directed=False)
    lengths = {(point[i], point[j]): length for i, j, length in ways}
    graph = sp.csr_matrix((list(lengths.values()), np.transpose(list(lengths))), shape=(count, count))
    points = point[[number[v] for v in range(len(t))]]
    return dijkstra(graph, directed=False, indices=points)[:, points]


def pressed(surface, rng, way):
    t = surface.vertices[:, 0] if way != "anywhere" else rng.normal(size=len(surface.vertices))
    return np.round(4 * t) if way == "whole numbers" else t


@pytest.mark.parametrize("shape", [bumpy(30), grid(5, 4), torus(8, 5), "nasty"], ids=lambda s: getattr(s, "name", s))
@pytest.mark.parametrize("way", ["along an axis", "anywhere", "whole numbers"])
def test_all_on_a_line(shape, way):
    """Many places are those of several vertices, or all but the line's own rounding apart."""
    for seed in range(4):
        rng = np.random.default_rng(seed)
        surface = Surface(*nasty_mesh(seed, 40)) if shape == "nasty" else shape
        used, faces = np.unique(surface.faces, return_inverse=True)
        surface = Surface(surface.vertices[used], faces.reshape(-1, 3))
        t, direction = pressed(surface, rng, way), rng.normal(size=3)
        expected = reeb_distances(t, surface.faces) * np.linalg.norm(direction)
        for line in (direction, np.linalg.norm(direction) * np.eye(3)[0]):
            solver = ExactGeodesic(Surface(t[:, None] * line, surface.faces))
            found = np.stack([solver.distances(v) for v in range(len(t))])
            np.testing.assert_allclose(
                np.nan_to_num(found, nan=np.inf), expected, rtol=0, atol=1e-13 * expected[np.isfinite(expected)].max()
            )


# ---------------------------------------------------------------------- edge geodesic
ROUNDING = 1e-12
"""Relative: sums of at most some hundred lengths."""


def strip(k):
    """Two rows of k + 1 vertices, side 1, diagonals from lower left to upper right."""
    x = np.repeat(np.arange(k + 1.0), 2)
    a = 2 * np.arange(k)
    faces = np.concatenate([np.stack([a, a + 2, a + 3], 1), np.stack([a, a + 3, a + 1], 1)])
    return Surface(np.stack([x, np.tile([0.0, 1.0], k + 1), 0 * x], 1), faces)


def test_path_lengths_on_a_strip():
    d = EdgeGeodesic(strip(20)).distances(0)
    np.testing.assert_allclose(d[::2], np.arange(21), rtol=ROUNDING)
    np.testing.assert_allclose(d[3::2], np.arange(20) + np.sqrt(2), rtol=ROUNDING)
    assert d[1] == 1


def test_block_equals_single_and_is_symmetric():
    solver = EdgeGeodesic(strip(9))
    block = solver.distances([3, 0, 11])
    assert block.shape == (20, 3)
    for column, source in enumerate([3, 0, 11]):
        assert np.array_equal(block[:, column], solver.distances(source))
    everything = solver.distances(np.arange(20))
    np.testing.assert_allclose(everything, everything.T, rtol=ROUNDING)
    assert not np.diag(everything).any()


def test_scales_like_length_and_is_no_shorter_than_a_straight_line():
    surface = strip(7)
    d = EdgeGeodesic(surface).distances(4)
    scaled = EdgeGeodesic(Surface(surface.vertices * 3, surface.faces)).distances(4)
    np.testing.assert_allclose(scaled, 3 * d, rtol=ROUNDING)
    assert (d >= np.linalg.norm(surface.vertices - surface.vertices[4], axis=1) * (1 - ROUNDING)).all()


def test_nonmanifold_edge_and_coincident_vertices():
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 1, 0]]
    surface = Surface(vertices, [[0, 1, 2], [0, 1, 3], [0, 1, 4], [0, 2, 5]])
    np.testing.assert_allclose(EdgeGeodesic(surface).distances(2), [1, np.sqrt(2), 0, 2, 2, 0], rtol=ROUNDING)


def test_refuses_ids_that_do_not_exist():
    with pytest.raises(VertexError):
        EdgeGeodesic(strip(2)).distances(6)
    with pytest.raises(VertexError):
        EdgeGeodesic(strip(2)).distances([0, -1])


@needs_oracle
@pytest.mark.parametrize("name", ORACLE_NAMES)
def test_reference_values(name):
    expected = np.load(ORACLE / f"{name}_dijkstra_scipy.npy")
    sources = np.loadtxt(ORACLE / f"{name}_sources0.txt", dtype=int)
    got = EdgeGeodesic(oracle_surface(name)).distances(sources)
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12 * expected.max())


def test_from_vertices_with_offsets():
    edges = EdgeGeodesic(strip(20))
    expected = np.minimum(edges.distances(3) + 1, edges.distances(30) + 2)
    found = edges.distances_with(np.array([3, 30, 3, 30]), np.array([5.0, 2, 1, 7]))
    np.testing.assert_allclose(found, expected, rtol=ROUNDING)
