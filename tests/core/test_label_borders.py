"""Borders between labels against regions of fields, which are traced by other means."""

import numpy as np
import pytest

from bihdist_core.analysis.label_borders import LEAST_WEIGHT, label_borders, label_weights
from bihdist_core.analysis.region_boundaries import region_boundaries
from bihdist_core.analysis.regions import voronoi_regions
from tests.shapes import bumpy, grid


def length(surface, border):
    corners, shares, closed = border
    points = np.einsum("kc,kcx->kx", shares, surface.vertices[corners])
    points = np.concatenate([points, points[:1]]) if closed else points
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


@pytest.mark.parametrize("surface", [bumpy(600), grid(9, 7)])
@pytest.mark.parametrize("flipped", [0, 40])
def test_borders_are_those_of_the_regions_where_a_label_has_most_weight(surface, flipped):
    random = np.random.default_rng(3)
    n = len(surface.vertices)
    middles = surface.vertices[random.choice(n, 6, replace=False)]
    labels = np.linalg.norm(surface.vertices[:, None] - middles, axis=2).argmin(axis=1) - 1  # one of them is none
    some = random.choice(n, min(flipped, n), replace=False)
    labels[some] = random.integers(-1, 5, len(some))
    weights = label_weights(labels, surface.faces)
    assert weights.min() >= LEAST_WEIGHT
    assert weights.max() == 1 or flipped
    has = labels[:, None] == np.arange(-1, 5)
    regions = voronoi_regions(surface, np.where(has, -weights[:, None], 0))
    borders = label_borders(labels, surface.faces)
    known = region_boundaries(surface, regions)
    assert sorted(round(length(surface, border), 9) for border in borders) == sorted(round(c.length, 9) for c in known)
    assert sum(closed for _, _, closed in borders) == sum(c.closed for c in known)


def test_one_label_has_no_borders():
    surface = grid(4, 4)
    assert label_borders(np.zeros(len(surface.vertices), np.int64), surface.faces) == []
    assert (label_weights(np.zeros(len(surface.vertices), np.int64), surface.faces) == 1).all()
