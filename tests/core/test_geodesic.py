"""Which geodesic method is taken when, and that the heat method keeps its promise on bad triangles."""

import threading
from pathlib import Path

import numpy as np
import pytest

import bihdist_core.distances.geodesic as geodesic
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
from bihdist_core.kernel import library
from tests.shapes import bumpy, fin, needs_kernel, two_pieces

MESHES = Path(__file__).parents[2].parent / "shared" / "meshes"


@needs_kernel
def test_auto_is_exact_up_to_some_work_on_any_surface(monkeypatch):
    for surface in (bumpy(100), fin(), two_pieces()):
        assert GeodesicDistance(surface).label == "geodesic, exact"
    monkeypatch.setattr(geodesic, "MOST_WINDOWS", 99**1.5)
    assert GeodesicDistance(bumpy(100)).label == "geodesic, heat method"


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
    monkeypatch.setattr(geodesic, "takes_long", lambda *_: True)
    assert GeodesicDistance(surface).method == "heat"
    assert GeodesicDistance(surface, radius=1.0).method == "exact"
    for method in ("heat", "dijkstra"):
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
    """Needles over a tenth of the height only, where no probe happens to lie, and that vertex."""
    s = bumpy(3000)
    z = s.vertices[:, 2]
    thin = np.where(z > 0.9 * z.max(), 1, 0)
    points = s.vertices * np.stack([np.where(thin, 0.02, 1), np.ones_like(z), np.ones_like(z)], 1)
    return Surface(points, s.faces, "slivers"), int(z.argmax())


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
        assert gate.wait(60)
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
def test_auto_changes_to_heat_where_the_exact_method_gives_up(monkeypatch):
    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_AT_LEAST", 0)
    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_PER_VERTEX", 0)
    surface = bumpy(300)
    auto, heat = GeodesicDistance(surface), GeodesicDistance(surface, "heat")
    assert auto.label == "geodesic, exact"
    assert np.array_equal(auto.from_source(5), heat.from_source(5))
    assert (auto.method, auto.label, auto.is_symmetric) == ("heat", heat.label, False)
    assert auto.error_estimate().text
    with pytest.raises(SolverError, match="was given up after"):
        GeodesicDistance(surface, "exact").from_source(5)


def test_auto_asks_the_heat_method_once_where_that_fails(monkeypatch):
    auto, asked = GeodesicDistance(bumpy(300)), []

    def fails(*_):
        asked.append(1)
        raise SolverError("the heat method fails")

    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_AT_LEAST", 0)
    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.MOST_PER_VERTEX", 0)
    monkeypatch.setattr("bihdist_core.distances.heat_times.HeatTimes.distances", fails)
    for times in (1, 2):
        with pytest.raises(SolverError, match="the heat method fails"):
            auto.from_source(5)
        assert (auto.method, len(asked)) == ("heat", times)
