"""What the heat method is off by on a mesh, measured against exact fields."""

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, Cancelled, GeodesicDistance, Laplacian, SolverError, Surface
from bihdist_core.distances import geodesic_accuracy
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from bihdist_core.distances.geodesic_accuracy import below_straight_line
from bihdist_core.kernel.library import library
from bihdist_core.sources.pieces import pieces_of
from bihdist_core.sources.source import BoundaryLoop
from tests.shapes import bumpy, grid

pytestmark = pytest.mark.skipif(library() is None, reason="exact geodesics need the compiled kernel")


@pytest.fixture(scope="module")
def laplacian():
    return Laplacian(bumpy(600))


def test_errors_are_those_against_exact_fields(laplacian):
    heat, exact = GeodesicDistance(laplacian, "heat"), GeodesicDistance(laplacian, "exact")
    assert not heat.has_error_estimate(0)
    estimate = heat.error_estimate()
    assert heat.has_error_estimate(0)
    everywhere = np.arange(len(laplacian.surface.vertices))
    true, found = exact.from_sources(everywhere), heat.from_sources(everywhere)
    off = np.abs(found - true) / true.max(axis=0)
    assert estimate.is_poor
    # From eight vertices: not the worst of all, and no less than half of it.
    assert estimate.sources == 8
    assert 0.5 * off.max() <= estimate.share <= off.max() + 1e-12
    assert (
        f"{100 * estimate.share:.2g} % at the worst from 8 vertices; from others it may be further off" in estimate.text
    )
    mean = float(estimate.short.partition(" %")[0]) / 100
    assert 0.5 * off.mean() < mean < 2 * off.mean()


@pytest.mark.parametrize("shear", [-2.5, -4])
def test_fields_and_errors_do_not_depend_on_how_vertices_are_numbered(shear):
    """On a square whose last rows are sheared into long faces, where a short flow is negative from some vertices."""
    square, fields, estimates = grid(20, 20), [], []
    x = square.vertices + np.maximum(0, square.vertices[:, 1] - 18)[:, None] * [shear, 0, 0]
    for seed in range(6):
        order = np.random.default_rng(seed).permutation(len(x))
        new = np.argsort(order)
        heat = GeodesicDistance(Surface(x[order], new[square.faces]), "heat")
        fields.append(heat.from_sources(new[[0, 60, 200, 440]])[new])
        estimates.append(heat.error_estimate().share)
    assert np.ptp(fields, axis=0).max() < 1e-9 * np.max(fields)
    assert np.ptp(estimates) < 1e-9


@pytest.mark.parametrize("surface", [grid(40, 40), grid(60, 4)], ids=["square", "strip"])
def test_errors_from_a_boundary_loop_are_those_from_that_loop(surface):
    heat, exact = GeodesicDistance(surface, "heat"), GeodesicDistance(surface, "exact")
    loop = pieces_of(BoundaryLoop(0), surface)
    off = np.abs(heat.from_pieces(loop) - exact.from_pieces(loop)) / exact.from_pieces(loop).max()
    from_vertices = heat.error_estimate([0]).share
    assert abs(off.max() - from_vertices) > 0.01 * from_vertices
    answer = Distances(Laplacian(surface)).answer(Spec.of("geodesic", method="heat"), BoundaryLoop(0))
    for estimate in (heat.error_estimate(pieces=[loop]), answer.error_estimate):
        assert estimate.share == pytest.approx(off.max())
        assert f"{100 * off.max():.2g} % at the worst" in estimate.text
        assert estimate.sources is None
    assert answer.label == f"geodesic, heat method, up to {100 * off.max():.2g} % off"
    both = heat.error_estimate(pieces=[pieces_of(3, surface), loop])
    assert both.share >= off.max() * (1 - 1e-9)


def test_errors_from_a_loop_are_what_is_typical_where_exact_distances_take_long(monkeypatch):
    surface = grid(20, 20)
    heat = GeodesicDistance(surface, "heat")

    def gives_up(*_):
        raise SolverError("too many windows")

    monkeypatch.setattr("bihdist_core.distances.exact_geodesic.ExactGeodesic._field", gives_up)
    estimate = heat.error_estimate(pieces=[pieces_of(BoundaryLoop(0), surface)])
    assert "5 % of the maximum typically from curves and boundary loops" in estimate.text
    assert estimate.is_poor


def test_that_of_a_difference_names_the_vertices_too(laplacian):
    heat = GeodesicDistance(laplacian, "heat").error_estimate()
    both = ErrorEstimate.of_difference(heat, BiharmonicDistance(laplacian).error_estimate())
    assert both.sources == 8
    assert "of both maxima from 8 vertices; from others it may be further off" in both.text


def test_its_measuring_can_be_cancelled_and_is_done_when_it_is_asked_for_again(laplacian):
    heat, told = GeodesicDistance(laplacian, "heat"), []

    def stop(share, text):
        told.append(share)
        if share > 0.3:
            raise Cancelled

    with pytest.raises(Cancelled):
        heat.error_estimate(progress=stop)
    assert len(told) > 2
    assert not heat.has_error_estimate(0)
    assert heat.error_estimate().share > 0
    assert heat.error_estimate(progress=stop).share > 0, "which is known"


def test_an_answer_is_there_before_its_accuracy_whose_measuring_can_be_cancelled(laplacian):
    told, there = [], []

    def stop(share, text):
        told.append(share)
        if there and len(told) > there[0] + 1:
            raise Cancelled

    with pytest.raises(Cancelled):
        Distances(laplacian).answer(
            Spec.of("geodesic", method="heat"), 3, stop, at_once=lambda answer: there.append(len(told))
        )
    assert told == sorted(told), "it never goes back"


def test_what_falls_below_the_straight_line_is_said(laplacian):
    surface = laplacian.surface
    exact = GeodesicDistance(laplacian, "exact").from_source(3)
    assert below_straight_line(surface, 3, exact) == 0
    assert below_straight_line(surface, 3, 0.5 * exact) > 0.1
    heat = GeodesicDistance(laplacian, "heat")
    before = heat.error_estimate()
    heat._solver._made[0].distances = lambda source, progress: 0.25 * exact  # as a flow that is led astray
    heat.from_source(3)
    after = heat.error_estimate()
    assert after.share > max(0.3, before.share)
    assert "below a straight line" in after.text


def test_a_large_mesh_has_fewer_sources_and_a_larger_one_what_is_typical(laplacian, monkeypatch):
    count = len(laplacian.surface.vertices)
    monkeypatch.setattr(geodesic_accuracy, "QUICK_WINDOWS", count**1.5)
    assert "at the worst from 1 vertex;" in GeodesicDistance(laplacian, "heat").error_estimate().text
    monkeypatch.setattr(geodesic_accuracy, "QUICK_WINDOWS", count**1.5 - 1)
    assert "typically" in GeodesicDistance(laplacian, "heat").error_estimate().text


def test_the_worst_of_the_components_counts(laplacian):
    x, f = laplacian.surface.vertices, laplacian.surface.faces
    flat = x * [1, 1, 0.02] + [9, 0, 0]
    both = GeodesicDistance(Surface(np.concatenate([x, flat]), np.concatenate([f, f + len(x)])), "heat")
    one, other = both.error_estimate([0]), both.error_estimate([1])
    assert one.share != other.share
    assert both.error_estimate([0, 1]).share == max(one.share, other.share)


def test_answers_say_it_unless_nobody_waits(laplacian):
    spec, distances, first = Spec.of("geodesic", method="heat"), Distances(laplacian), []
    rough = distances.answer(spec, 3, at_once=lambda answer: True)
    assert rough.label == "geodesic, heat method"
    assert not rough.is_final
    answer = distances.answer(spec, 3, at_once=first.append)
    assert [each.label for each in first] == [rough.label]
    assert answer.is_final
    assert answer.label.startswith("geodesic, heat method, ")
    assert answer.label.endswith(" % off")
    assert distances.answer(Spec.of("geodesic", method="exact"), 3).label == "geodesic, exact"
