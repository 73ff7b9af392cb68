"""Approximate geodesic distance by virtual sources, beside the exact one."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from bihdist_core import (
    BoundaryLoop,
    Cancelled,
    Curve,
    GeodesicDistance,
    Laplacian,
    SourceSet,
    Surface,
    SurfacePoint,
    read_surface,
)
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from bihdist_core.distances.geodesic import GeodesicDistance as Geodesic
from bihdist_core.sources.pieces import pieces_of
from tests.core.nasty_meshes import nasty_mesh
from tests.shapes import MESHES, bumpy, fin, grid, needs_kernel, needs_meshes, two_pieces

pytestmark = needs_kernel
WORD = "virtual-sources"


def off(surface, source):
    """Return the error in the mean and at most, as fractions of the maximum."""
    field, true = (GeodesicDistance(surface, method).from_source(source) for method in (WORD, "exact"))
    assert np.array_equal(np.isnan(field), np.isnan(true))
    found = np.abs(field - true) / np.nanmax(true)
    return np.nanmean(found), np.nanmax(found)


def star(is_star=True):
    """A disc with a rim like a star, whose points are of uneven density, or a regular square."""
    if not is_star:
        return grid(40, 40)
    rng = np.random.default_rng(0)
    angle = np.sort(2 * np.pi * rng.random(500))
    rim = (1 + 0.35 * np.sin(7 * angle))[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    r, turn = np.sqrt(rng.random(2_500)), 2 * np.pi * rng.random(2_500)
    inside = (0.97 * r * (1 + 0.35 * np.sin(7 * turn)))[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    points = np.concatenate([rim, inside])
    faces = Delaunay(points).simplices
    middle = points[faces].mean(axis=1)
    bound = 1 + 0.35 * np.sin(7 * np.arctan2(middle[:, 1], middle[:, 0]))
    return Surface(np.column_stack([points, np.zeros(len(points))]), faces[np.hypot(*middle.T) < bound], "star")


def test_it_is_exact_on_a_plane():
    surface = grid(12, 9)
    for source in (0, 40, SurfacePoint.of(50, 0.2, 0.5), SurfacePoint.of(50, 0.5, 0.5)):
        assert off(surface, source)[1] < 1e-12


@pytest.mark.parametrize(
    "source", [5, SurfacePoint.of(300, 0.2, 0.3), SourceSet((5, 900, SurfacePoint.of(300, 0.2, 0.3)))]
)
def test_it_is_near_the_exact_distance(source):
    mean, most = off(bumpy(2_000), source)
    assert mean < 0.003
    assert most < 0.02


@pytest.mark.parametrize("surface", [fin(), two_pieces()], ids=["fin", "pieces"])
def test_edges_of_three_faces_and_components(surface):
    assert off(surface, 3)[1] < 0.04


@pytest.mark.parametrize("seed", range(12))
def test_no_distance_is_shorter_than_a_straight_line_or_longer_than_edges(seed):
    """On meshes with degenerate and doubled faces, and vertices in one place, too."""
    surface = Surface(*nasty_mesh(seed, 40, repeated=3))
    source = int(np.flatnonzero(surface.component_of_vertex == 0)[0])
    field = GeodesicDistance(surface, WORD).from_source(source)
    known = np.isfinite(field)
    assert np.array_equal(known, np.isfinite(GeodesicDistance(surface, "exact").from_source(source)))
    straight = np.linalg.norm(surface.vertices - surface.vertices[source], axis=1)
    edges = GeodesicDistance(surface, "dijkstra").from_source(source)
    top = max(edges[known].max(), straight.max())
    assert (field[known] <= edges[known] * (1 + 2e-6) + 1e-12 * top).all()
    assert (field[known] >= 0.9 * straight[known] - 1e-8 * top).all()


@pytest.mark.parametrize("scale", [1e-40, 2.0**-40, 1e40])
def test_it_scales(scale):
    surface = bumpy(300)
    field, there = (
        GeodesicDistance(s, WORD).from_source(5) for s in (surface, Surface(surface.vertices * scale, surface.faces))
    )
    np.testing.assert_allclose(there, field * scale, rtol=1e-9)


def test_pairs_are_the_same_both_ways():
    distance = GeodesicDistance(bumpy(300), WORD)
    place = SurfacePoint.of(30, 0.2, 0.5)
    for u, v in ((5, 200), (place, 7), (place, SurfacePoint.of(90, 0.1, 0.1))):
        assert distance.between(u, v) == distance.between(v, u)
        assert distance.between(u, v) == pytest.approx(GeodesicDistance(bumpy(300), "exact").between(u, v), rel=0.03)
    assert distance.between(place, SurfacePoint.of(30, 0.4, 0.1)) == pytest.approx(
        GeodesicDistance(bumpy(300), "exact").between(place, SurfacePoint.of(30, 0.4, 0.1)), rel=1e-12
    )


def test_the_error_is_that_of_the_source_that_is_shown():
    surface = bumpy(1_000)
    for source in (5, 600, SurfacePoint.of(300, 0.2, 0.3)):
        answer = Distances(Laplacian(surface)).answer(Spec.of("geodesic", method=WORD), source)
        assert answer.error_estimate.share == pytest.approx(off(surface, source)[1])
        assert answer.label == f"geodesic, approximate, up to {100 * off(surface, source)[1]:.2g} % off"


@pytest.mark.parametrize("part", [0.3, 0.05])
def test_of_a_large_surface_the_nearest_part_is_measured(monkeypatch, part):
    surface = bumpy(3_000)
    monkeypatch.setattr("bihdist_core.distances.geodesic.QUICK_WINDOWS", 3_000**1.5 * part**1.5)
    distance = GeodesicDistance(surface, WORD)
    estimate = distance.error_estimate(pieces=[pieces_of(7, surface)])
    assert "judged by the nearest " in estimate.text
    assert estimate.share >= off(surface, 7)[1]


@pytest.mark.parametrize("is_loop", [True, False], ids=["rim", "curve"])
@pytest.mark.parametrize("surface", [star(), star(is_star=False)], ids=["star", "square"])
def test_fields_from_lines_are_within_what_is_stated(surface, is_loop):
    low, size = surface.vertices.min(axis=0), np.ptp(surface.vertices, axis=0)
    middle = (surface.vertices[surface.faces].mean(axis=1) - low)[:, :2] / size[:2]
    faces = [int(np.linalg.norm(middle - at, axis=1).argmin()) for at in ((0.41, 0.47), (0.5, 0.63), (0.61, 0.52))]
    source = BoundaryLoop(0) if is_loop else Curve(tuple(SurfacePoint.of(face, 0.3, 0.3) for face in faces))
    exact = GeodesicDistance(surface, "exact").from_source(source)
    for method, most in ((WORD, 0.03), ("heat", 0.06)):
        distance = Geodesic(surface, method)
        share = distance.error_estimate(pieces=[pieces_of(source, surface)]).share
        assert np.abs(distance.from_source(source) - exact).max() <= share * exact.max() * (1 + 1e-9)
        assert share < most


@needs_meshes
@pytest.mark.parametrize("name", ["spot.obj", "fertility.off", "camelhead.off", "plane_holes.obj", "teapot.obj"])
def test_real_meshes(name):
    surface = read_surface(MESHES / name)
    source = int(np.flatnonzero(surface.component_of_vertex == 0)[0])
    mean, most = off(surface, source)
    assert mean < 0.005
    assert most < 0.03


def test_it_can_be_cancelled():
    surface = bumpy(60_000)
    distance, told = GeodesicDistance(surface, WORD), []

    def stop(share, text):
        told.append(text)
        raise Cancelled

    with pytest.raises(Cancelled):
        distance.from_sources(list(range(0, 60_000, 60)), stop)
    assert told
