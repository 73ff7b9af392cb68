"""Fields in numbers: against sums over a subdivided mesh, SciPy, and what is known."""

import numpy as np
import pytest
from scipy.spatial import Delaunay
from scipy.stats import spearmanr

from bihdist_core import (
    BiharmonicDistance,
    GeodesicDistance,
    Laplacian,
    ParameterError,
    PointCloud,
    Surface,
    TetrahedralMesh,
    TruncatedBiharmonicDistance,
    VertexError,
    band,
)
from bihdist_core.analysis.field_statistics import field_agreement, field_statistics, rank_correlation
from bihdist_core.analysis.truncation import truncation_loss
from bihdist_core.applications.resizing import refined
from tests.shapes import grid, two_pieces


def test_known_numbers_on_a_plane():
    plane = grid(10, 10)
    x = plane.vertices[:, 0]
    found = field_statistics(plane, x - 2, bins=[-2, 0, 4.5, 8])
    assert found.mean == pytest.approx(3, rel=1e-12)
    assert (found.least, found.greatest, found.largest) == (-2, 8, 8)
    assert (found.least_at, found.greatest_at) == (0, 10)
    # x is uniform on [0, 10].
    assert found.quantiles == pytest.approx([-1.5, 0.5, 3, 5.5, 7.5], abs=1e-12)
    assert found.areas == pytest.approx([20, 45, 35], rel=1e-12)
    assert found.mean_size == pytest.approx((2**2 + 8**2) / 20, rel=1e-12)
    assert found.deviation == pytest.approx(10 / np.sqrt(12), rel=1e-12)
    # The same where 0 is inside faces, and where two corners are below it.
    assert field_statistics(plane, x - 2.3).mean_size == pytest.approx((2.3**2 + 7.7**2) / 20, rel=1e-12)
    assert field_statistics(plane, 2.3 - x).mean_size == pytest.approx((2.3**2 + 7.7**2) / 20, rel=1e-12)


def test_a_finer_mesh_changes_nothing_of_a_linear_field(rough, field):
    fine = refined(refined(rough))
    values = field - field.mean()
    for surface in (rough, refined(rough)):
        values = np.concatenate([values, values[surface.edges].mean(axis=1)])
    one, other = field_statistics(rough, field - field.mean()), field_statistics(fine, values)
    assert one.areas.sum() == pytest.approx(rough.face_areas.sum(), rel=1e-12)
    for name in ("mean", "mean_size", "deviation", "quantiles", "areas"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-9, abs=1e-9 * one.greatest), name


def test_quantiles_and_bins_cover_what_bands_do(rough, field):
    machine_part = Surface(*_long_faces())
    by_angle = np.arctan2(machine_part.vertices[:, 1], machine_part.vertices[:, 0])
    for surface, values, is_level in (
        (rough, field, False),
        (machine_part, by_angle, False),
        (rough, field.round(1), True),
    ):
        total = surface.face_areas.sum()
        found = field_statistics(surface, values, bins=7, fractions=[0, 0.25, 0.5, 0.75, 1])
        for share, value in zip(found.fractions[1:-1], found.quantiles[1:-1], strict=True):
            # Between them where the field is the value on whole faces, both of them elsewhere.
            least, most = (band(surface, values, high=x).area / total for x in (np.nextafter(value, -np.inf), value))
            assert least - 1e-10 <= share <= most + 1e-10
            assert is_level or most - least < 1e-10
        assert found.quantiles[[0, -1]].tolist() == [values.min(), values.max()]
        bands = [band(surface, values, *ends).area for ends in zip(found.bins[:-1], found.bins[1:], strict=True)]
        assert found.areas == pytest.approx(bands, abs=1e-10 * total)


def _long_faces():
    """A tube whose ends alone have vertices, and one of them many more: areas of vertices say little."""
    many, few = (np.linspace(0, 2 * np.pi, k, endpoint=False) for k in (90, 6))
    vertices = [(np.cos(a), np.sin(a), z) for angles, z in ((many, 0), (few, 9)) for a in angles]
    near = 90 + (np.arange(90) * 6 // 90)
    faces = [(i, (i + 1) % 90, near[i]) for i in range(90)]
    faces += [(near[i], (i + 1) % 90, near[(i + 1) % 90]) for i in range(90) if near[i] != near[(i + 1) % 90]]
    return vertices, faces


def test_where_the_field_is_level_the_quantile_is_its_value():
    plane = grid(10, 10)
    x = np.clip(plane.vertices[:, 0], 3, 6)
    found = field_statistics(plane, x, bins=[3, 4, 6], fractions=[0.1, 0.3, 0.31, 0.5, 0.59, 0.61, 0.9])
    assert found.quantiles == pytest.approx([3, 3, 3.1, 5, 5.9, 6, 6], abs=1e-12)
    assert found.areas == pytest.approx([40, 60], rel=1e-12)


def test_faces_without_a_value_are_left_out_as_from_a_band():
    plane = grid(10, 10)
    x = plane.vertices[:, 0].copy()
    x[plane.vertices[:, 1] > 7.5] = np.nan
    found = field_statistics(plane, x)
    assert found.areas.sum() == pytest.approx(70, rel=1e-12) == band(plane, x).area
    assert found.mean == pytest.approx(5, rel=1e-12)
    assert found.quantiles == pytest.approx([0.5, 2.5, 5, 7.5, 9.5], rel=1e-12)
    agreement = field_agreement(plane, x, 0 * x + 4)
    assert agreement.mean == pytest.approx((4**2 + 6**2) / 20, rel=1e-12)


def test_vertices_without_a_value_are_left_out():
    both = two_pieces()
    field = BiharmonicDistance(both).from_source(0)
    part = both.component(0)[0]
    one, other = field_statistics(both, field), field_statistics(part, field[:60])
    assert one.count == 60
    assert one.mean == pytest.approx(other.mean, rel=1e-12)
    with pytest.raises(ParameterError, match="not finite on any face"):
        field_statistics(both, np.full(len(both.vertices), np.nan))


@pytest.mark.parametrize("value", [0.0, 2.0, 1e-300, -1e100])
def test_a_constant_field_is_a_histogram_too(rough, value):
    # But for rounding, too: ends of bins between the two values are no numbers.
    for field in (np.full(300, value), np.where(np.arange(300) % 2, value, value + np.spacing(value))):
        found = field_statistics(rough, field, bins=50)
        assert found.mean == pytest.approx(value, rel=1e-12, abs=1e-12)
        assert found.deviation <= np.spacing(abs(value))
        assert (np.diff(found.bins) > 0).all()
        assert found.areas.sum() == pytest.approx(rough.face_areas.sum(), rel=1e-12)


def test_rank_correlation_is_scipys():
    rng = np.random.default_rng(0)
    a = rng.random(500)
    for b in (a**3, -np.exp(a), a + rng.random(500), rng.integers(5, size=500).astype(float)):
        assert rank_correlation(a, b) == pytest.approx(spearmanr(a, b).statistic, abs=1e-12)
    # A weight is as so many points.
    times = rng.integers(1, 6, size=500)
    b = np.round(a + rng.random(500), 1)
    repeated = spearmanr(np.repeat(a, times), np.repeat(b, times)).statistic
    assert rank_correlation(a, b, times) == pytest.approx(repeated, abs=1e-12)
    # Of a constant there is none, whatever rounding makes of the mean of ranks.
    for weights in (None, times, rng.random(500), a < 0.1):
        assert np.isnan(rank_correlation(a, np.ones(500), weights))
        assert np.isnan(rank_correlation(np.full(500, 0.3), a, weights))
    assert 0 < rank_correlation([1, 2, 3], [1, 2, 2], [1e-9, 1, 1]) < 1e-4
    assert np.isnan(rank_correlation([1, 2, 3], [1, 2, 2], [0, 1, 1]))


def test_agreement_of_distances(rough, field):
    geodesic = GeodesicDistance(rough, "exact").from_source(7)
    found = field_agreement(rough, field, geodesic, normalised=True)
    apart = np.abs(field / field.max() - geodesic / geodesic.max())
    assert found.largest == apart.max()
    assert found.largest_at == apart.argmax()
    assert found.spearman == pytest.approx(spearmanr(field, geodesic).statistic, abs=1e-12)
    assert 0.9 < found.by_area < 1
    same = field_agreement(rough, field, 2 * field, normalised=True)
    assert (same.spearman, same.mean, same.largest) == pytest.approx((1, 0, 0), abs=1e-12)
    assert field_agreement(rough, field, 2 * field).largest == field.max()


def test_points_and_tetrahedra_are_weighted_by_their_masses():
    x = np.random.default_rng(1).normal(size=(60, 3))
    for shape in (PointCloud(x / np.linalg.norm(x, axis=1)[:, None]), TetrahedralMesh(x, Delaunay(x).simplices)):
        one, other, masses = x[:, 0], x[:, 0] + x[:, 1] ** 2, shape.matrices[1]
        found = field_agreement(shape, one, other)
        assert found.mean == pytest.approx((masses * x[:, 1] ** 2).sum() / masses.sum(), rel=1e-12)
        assert found.by_area == rank_correlation(one, other, masses) != found.spearman


def test_bad_input_is_refused(rough, field):
    for bins in (0, 2.5, [1, 1], [3, 2, 1], [1]):
        with pytest.raises(ParameterError, match="bins"):
            field_statistics(rough, field, bins)
    with pytest.raises(ParameterError, match="Fractions of the area"):
        field_statistics(rough, field, fractions=[1.5])
    with pytest.raises(ParameterError, match="each of 300 vertices"):
        field_statistics(rough, field[:-1])
    with pytest.raises(ParameterError, match=r"each of 300 vertices, not an array of shape \(299,\)"):
        field_agreement(rough, field, field[:-1])
    with pytest.raises(ParameterError, match="0 throughout"):
        field_agreement(rough, field, 0 * field, normalised=True)
    with pytest.raises(ParameterError, match="common vertices"):
        field_agreement(rough, field, field * np.nan)
    with pytest.raises(ParameterError, match="cannot be correlated"):
        rank_correlation([1, 2], [1, 2, 3])
    with pytest.raises(ParameterError, match="finite values"):
        rank_correlation([1, 2], [1, np.inf])


def test_what_truncation_loses_is_that_of_the_truncated_distance(rough, field):
    laplacian = Laplacian(rough)
    loss = truncation_loss(laplacian, 7, most=40)
    assert loss.counts.tolist() == list(range(1, 41))
    for k in (1, 5, 17, 40):
        apart = np.abs(TruncatedBiharmonicDistance(laplacian, k).from_source(7) - field) / field.max()
        assert loss.largest[k - 1] == pytest.approx(apart.max(), rel=1e-6)
        assert loss.at[k - 1] == apart.argmax()
        assert loss.means[k - 1] == pytest.approx(field_statistics(laplacian.surface, apart).mean, rel=1e-6)
    # More terms are never further from the exact sum.
    assert (np.diff(loss.largest) <= 1e-9).all()
    some = truncation_loss(laplacian, 7, counts=[5, 17])
    assert some.means == pytest.approx(loss.means[[4, 16]], rel=1e-12)


def test_truncation_on_small_and_other_components():
    both = two_pieces()
    loss = truncation_loss(both, 62, most=100)
    assert loss.counts.tolist() == [1, 2, 3]
    assert loss.largest[-1] < 1e-9
    assert set(loss.at) <= {61, 62, 63, 64}
    with pytest.raises(VertexError, match="vertex 60"):
        truncation_loss(both, 60)
    for counts in ([], [2, 1], [0, 1], [1.5]):
        with pytest.raises(ParameterError, match="ascending"):
            truncation_loss(both, 0, counts=counts)
    with pytest.raises(ParameterError, match="3 eigenpairs at vertex 62"):
        truncation_loss(both, 62, counts=[7])


@pytest.mark.parametrize("words", ["7+90+3", "f31:0.2,0.5", "f31:0.2,0.5+12", "loop:0", "7+loop:0"])
def test_truncation_from_sources_of_other_kinds(words):
    surface = grid(12, 10)
    laplacian = Laplacian(surface)
    exact = BiharmonicDistance(laplacian).from_source(words)
    loss = truncation_loss(laplacian, words, most=40)
    assert loss.counts[-1] == 40
    assert len(loss.counts) == 40 or "loop" in words
    for k in (0, 5, len(loss.counts) - 1):
        truncated = TruncatedBiharmonicDistance(laplacian, int(loss.counts[k])).from_source(words)
        apart = np.abs(truncated - exact) / exact.max()
        assert loss.largest[k] == pytest.approx(apart.max(), rel=1e-6)
        assert loss.at[k] == apart.argmax()
        assert loss.means[k] == pytest.approx(field_statistics(laplacian.surface, apart).mean, rel=1e-6)


def test_truncation_from_a_set_on_two_components():
    both = two_pieces()
    laplacian = Laplacian(both)
    loss = truncation_loss(laplacian, "62+3", most=20)
    exact = BiharmonicDistance(laplacian).from_source("62+3")
    assert np.isfinite(exact).sum() > 60
    apart = np.abs(TruncatedBiharmonicDistance(laplacian, 20).from_source("62+3") - exact) / np.nanmax(exact)
    assert loss.largest[-1] == pytest.approx(np.nanmax(apart), rel=1e-6)
