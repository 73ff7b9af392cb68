"""The tips of shapes, and extrema of interpolants that are at no anchor."""

import numpy as np
import pytest

from app.samples import mesh_path
from bihdist_core import (
    BiharmonicDistance,
    Laplacian,
    ShepardInterpolant,
    SourceSet,
    Surface,
    at_tips,
    other_extrema,
    read_surface,
    tips,
)
from tests.shapes import bumpy, components_apart, two_pieces


def test_the_eccentricity_is_the_mean_of_squared_distances():
    laplacian = Laplacian(bumpy(150))
    (component,) = laplacian.components
    distances = BiharmonicDistance(laplacian).from_sources(np.arange(150))
    mean = component.areas @ distances**2 / component.areas.sum()
    assert component.biharmonic_eccentricity == pytest.approx(np.sqrt(mean), rel=1e-9)


@pytest.mark.parametrize(("sample", "count"), [("hand", 6), ("figure", 5), ("octopus", 9)])
def test_tips_are_the_ends_of_limbs(sample, count):
    """Five fingers and the wrist; head, hands and feet; eight arms and the head."""
    surface = read_surface(mesh_path(sample))
    found = tips(Laplacian(surface))
    assert len(found) == count
    away = np.linalg.norm(surface.vertices[found][:, None] - surface.vertices[found], axis=2)
    assert away[~np.eye(count, dtype=bool)].min() > 0.1 * np.sqrt(surface.face_areas.sum())


def test_tips_are_found_on_each_component():
    s = two_pieces()
    found = tips(Laplacian(s))
    assert all(np.isin(found, part).any() for part in components_apart(s))


def test_extrema_at_tips_are_told_from_others():
    """The interpolant of two anchors in the palm has one extremum at most of the fingers."""
    surface = read_surface(mesh_path("hand"))
    laplacian = Laplacian(surface)
    ends = tips(laplacian)
    middle = np.argsort(laplacian.components[0].biharmonic_eccentricity)[[0, 400]]
    field = ShepardInterpolant(BiharmonicDistance(laplacian), middle, [0.0, 1.0]).evaluate()
    stray = other_extrema(surface, field, SourceSet(tuple(middle))).vertices
    assert not np.isin(stray, middle).any()
    assert at_tips(surface, stray, ends).sum() >= 4
    assert at_tips(surface, ends, ends).all()
    assert not at_tips(surface, middle, ends).any()


def test_a_single_vertex_has_no_tip():
    s = bumpy(60)
    lonely = Surface(np.concatenate([s.vertices, [[9.0, 9, 9]]]), s.faces)
    assert 60 not in tips(Laplacian(lonely))
