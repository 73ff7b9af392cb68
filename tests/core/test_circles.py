"""Isotropy on geodesic circles that shrink around a source."""

import numpy as np
import pytest

from bihdist_core import Laplacian, Surface
from bihdist_core.analysis.isoline_tracing import isolines
from bihdist_core.distances.geodesic import GeodesicDistance
from bihdist_core.experiments.circles import LARGEST, RADII, _is_local, circles
from bihdist_core.experiments.result import Gathered
from bihdist_core.experiments.verdicts import BySource
from tests.shapes import bumpy, grid, two_pieces

KINDS = ("biharmonic", "diffusion t = 1")


@pytest.fixture(scope="module")
def strip():
    """A flat rectangle four times as long as wide."""
    flat = grid(40, 10)
    width, height = np.ptp(flat.vertices[:, 0]), np.ptp(flat.vertices[:, 1])
    return Surface(flat.vertices * [4 / width, 1 / height, 1], flat.faces, "strip")


def test_biharmonic_circles_become_round_like_one_over_a_logarithm_and_diffusions_stay(strip):
    x = strip.vertices
    middle = int(np.linalg.norm(x - [1.3, 0.5, 0], axis=1).argmin())
    found = circles(strip, [middle], KINDS)
    biharmonic, diffusion = (found.ratios[kind][0] for kind in KINDS)
    assert (np.diff(biharmonic) < 0).all()
    # d^2 = r^2 / (4 pi) (ln 1/r + c): the square of the ratio is (ln 1/r + a) / (ln 1/r + b), so that the inverse of
    # its excess over 1 is linear in ln 1/r.
    inverse = 1 / (biharmonic**2 - 1)
    slopes = np.diff(inverse) / np.log(2)
    assert slopes == pytest.approx(slopes.mean(), rel=0.1)
    assert (slopes > 0).all()
    assert diffusion[1:] == pytest.approx(diffusion[-1], rel=0.1)
    assert diffusion[-1] > 2
    assert found.trend()[0] < 0.75
    assert found.trend("diffusion t = 1")[0] == pytest.approx(1, abs=0.2)
    assert found.are_local[0]


def test_circles_that_a_boundary_cuts_say_nothing_of_the_trend(strip):
    edge = int(np.linalg.norm(strip.vertices - [2, 0, 0], axis=1).argmin())
    middle = int(np.linalg.norm(strip.vertices - [2, 0.5, 0], axis=1).argmin())
    found = circles(strip, [middle, edge], KINDS)
    assert found.are_local.tolist() == [True, False]
    assert np.isfinite(found.ratios["biharmonic"]).all()


def test_a_closed_curve_round_a_limb_is_no_local_circle(strip):
    limb = Surface(bumpy(800).vertices * [0.2, 3, 0.2], bumpy(800).faces, "limb")
    tip = int(limb.vertices[:, 1].argmax())
    lengths = GeodesicDistance(Laplacian(limb), "exact").from_source(tip)
    # 1.5 along the limb, which is some 1.2 round.
    (curve,) = isolines(limb, lengths, [1.5])
    assert curve.closed
    assert not _is_local(limb, lengths, 1.5)
    middle = int(np.linalg.norm(strip.vertices - [2, 0.5, 0], axis=1).argmin())
    assert _is_local(strip, GeodesicDistance(Laplacian(strip), "exact").from_source(middle), 0.3)


def test_what_hangs_by_a_vertex_beyond_the_largest_circle_changes_little(strip):
    """Not the circles, though the surface is not manifold any more, and the field by less than a hundredth."""
    x = strip.vertices
    middle = int(np.linalg.norm(x - [2, 0.5, 0], axis=1).argmin())
    hangs = [x[middle + 2] + out for out in ([0.05, 0.02, 0.3], [0.05, -0.02, 0.3])]
    faces = np.concatenate([strip.faces, [[middle + 2, len(x), len(x) + 1]]])
    surface = Surface(np.concatenate([x, hangs]), faces, "strip")
    assert not surface.is_manifold
    sound, other = (circles(each, [middle], ("biharmonic",)) for each in (strip, surface))
    assert other.are_local[0]
    np.testing.assert_allclose(other.ratios["biharmonic"], sound.ratios["biharmonic"], rtol=0.01)


def test_a_piece_smaller_than_its_circles_has_none():
    surface = two_pieces()
    found = circles(
        Surface(
            np.where(surface.vertices > 4, 5 + (surface.vertices - 5) / 100, surface.vertices),
            surface.faces,
            "two pieces",
        ),
        [*range(30), 61],
        ("diffusion t = 1",),
    )
    assert np.isfinite(found.ratios["diffusion t = 1"][:30]).all()
    assert np.isnan(found.ratios["diffusion t = 1"][30]).all()
    assert "There is no geodesic circle of radius" in found.failure


def test_charts_have_a_curve_for_each_distance():
    found = circles(bumpy(500), [3, 4], KINDS)
    chart = found.chart("isotropy", 1)
    assert [s.name for s in chart.series] == list(KINDS)
    np.testing.assert_array_equal(chart.series[0].x, found.radii)
    assert found.radii == pytest.approx(LARGEST * RADII)
    np.testing.assert_array_equal(chart.series[0].y, found.ratios["biharmonic"][1])


def test_numbers_are_gathered_by_the_names_of_parts():
    found = Gathered()
    for k, depth in enumerate((0.0, 0.02, 0.03)):
        found.add("deepest other minimum, biharmonic, of the range", depth, not k)
    claim = found.claim("fig1-1", "a note")
    assert list(claim.numbers.values()) == [BySource((0.0,), (0.02, 0.03))]
    assert claim.verdict == "does not hold"
    assert found.claim("fig6-5").numbers == {}
    assert found.claim("fig6-5").verdict is None
