"""Which geodesic method is taken when, and that the heat method keeps its promise on bad triangles."""

import numpy as np
import pytest

import bihdist_core.distances.geodesic as geodesic
from bihdist_core import GeodesicDistance, ParameterError, Surface
from tests.shapes import bumpy, fin


def test_auto_is_exact_on_small_manifold_surfaces_only(monkeypatch):
    assert GeodesicDistance(bumpy(100)).label == "geodesic, exact"
    assert GeodesicDistance(fin()).label == "geodesic, heat method"
    monkeypatch.setattr(geodesic, "EXACT_UP_TO", 99)
    assert GeodesicDistance(bumpy(100)).label == "geodesic, heat method"


def test_exact_refuses_what_is_not_manifold_and_says_what_to_do():
    with pytest.raises(ParameterError, match="heat"):
        GeodesicDistance(fin(), "exact")


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
    monkeypatch.setattr(geodesic, "TIME_FACTORS", (1.0,))
    assert heat_error(needles()) > 0.1  # what would happen if the flow were not made longer
