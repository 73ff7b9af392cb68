"""One field against another: densities as NumPy's histograms, polygons as the slow way round."""

import numpy as np
import pytest

from bihdist_core import ParameterError, field_scatter
from tests.shapes import bumpy


@pytest.fixture(scope="module")
def fields():
    surface = bumpy(500)
    random = np.random.default_rng(3)
    n = len(surface.vertices)
    return surface, random.uniform(0, 2, n), random.normal(size=n)


def test_densities_are_numpys_histograms(fields):
    surface, a, b = fields
    scatter = field_scatter(surface, a, b)
    across, up = (0.1, 1.7), (-1.0, 2.0)
    expected, _, _ = np.histogram2d(b, a, (30, 40), (up, across))
    assert (scatter.density(40, 30, across, up) == expected).all()
    ends = scatter.ends
    assert scatter.density(7, 5, *ends).sum() == len(a)  # the greatest value is in the last cell
    assert ends == ((0, a.max()), (b.min(), b.max()))


def test_shares_are_of_the_largest_size_and_what_is_undefined_is_left_out(fields):
    surface, a, b = fields
    a = a.copy()
    a[[4, 9]] = np.nan, np.inf
    scatter = field_scatter(surface, a, b, normalised=True)
    assert (scatter.ids == np.delete(np.arange(len(a)), [4, 9])).all()
    assert scatter.x.max() == np.abs(scatter.y).max() == 1
    assert np.allclose(scatter.y, b[scatter.ids] / np.abs(b[scatter.ids]).max(), rtol=1e-15)


def test_a_lasso_has_the_points_it_goes_round_an_odd_number_of_times(fields):
    surface, a, b = fields
    scatter = field_scatter(surface, a, b)
    random = np.random.default_rng(5)
    polygon = np.stack([random.uniform(0, 2, 23), random.normal(size=23)], 1)  # crosses itself many times
    expected = []
    for vertex, (x, y) in enumerate(zip(a, b, strict=True)):
        crossings = 0
        for (x0, y0), (x1, y1) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
            if (y0 <= y) != (y1 <= y):
                crossings += x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
        if crossings % 2:
            expected.append(vertex)
    assert 50 < len(expected) < 450
    assert scatter.inside(polygon).tolist() == expected
    assert scatter.inside(polygon[::-1]).tolist() == expected


def test_what_cannot_be_shown_is_refused(fields):
    surface, a, b = fields
    for one, other, words in ((a[:3], b, "for each of"), (a * np.nan, b, "common vertices")):
        with pytest.raises(ParameterError, match=words):
            field_scatter(surface, one, other)
    with pytest.raises(ParameterError, match="0 throughout"):
        field_scatter(surface, a, 0 * b, normalised=True)
    scatter = field_scatter(surface, a, b)
    for polygon in (np.zeros((2, 2)), np.zeros((4, 3)), [[0, 0], [1, 1], [np.nan, 2]]):
        with pytest.raises(ParameterError, match="three corners"):
            scatter.inside(polygon)
    with pytest.raises(ParameterError, match="0 by 3 cells"):
        scatter.density(0, 3, (0, 1), (0, 1))
