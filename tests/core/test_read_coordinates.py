"""The accuracy of distances counts what is lost of coordinates when they are read, far from the origin above all."""

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, CommuteTimeDistance, DiffusionDistance, Surface
from bihdist_core.distances.accuracy import read_alike
from tests.shapes import bumpy, caps, grid, needles, torus

STEPS = {
    "grid": lambda: (grid(19, 19).vertices * 19, grid(19, 19).faces),
    "bumpy": lambda: stepped(bumpy(200), 30),
    "torus": lambda: stepped(torus(), 30),
    "needles": lambda: stepped(needles(bumpy(100), 1e-2, every=4), 1e4),
    "caps": lambda: stepped(caps(bumpy(100), 1e-2, every=4), 1e4),
}
DISTANCES = {
    "biharmonic": BiharmonicDistance,
    "commute": CommuteTimeDistance,
    "diffusion": lambda surface: DiffusionDistance(surface, t=1),
}


def stepped(surface, per_edge):
    return surface.vertices / surface.mean_edge_length * per_edge, surface.faces


def read_far(whole, faces, digits, origin):
    """A surface of whole numbers of steps, 10^-digits each, at an origin, as Python reads its decimals; and near it."""
    rows = [[int(x) + 10**digits * o for x, o in zip(row, origin, strict=True)] for row in whole.astype(int).tolist()]
    read = [[float(f"{x}e-{digits}") for x in row] for row in rows]
    return Surface(np.array(read), faces, "far"), Surface(whole / 10.0**digits, faces, "near")


@pytest.mark.parametrize("distance", DISTANCES)
@pytest.mark.parametrize("shape", STEPS)
@pytest.mark.parametrize("origin", [(452_000, 5_411_000, 0), (-90_000_000, 1, 70_000_000)])
def test_far_from_the_origin_no_field_is_further_off_than_is_said(shape, distance, origin):
    steps, faces = STEPS[shape]()
    far, near = read_far(np.round(steps), faces, 2 if np.ptp(steps) < 1e4 else 5, origin)
    ids = np.arange(0, far.n_vertices, 3)
    said, fields = (one := DISTANCES[distance](far)).accuracy, one.from_sources(ids)
    exact = DISTANCES[distance](near).from_sources(ids)
    off = float((np.abs(fields - exact).max(axis=0) / exact.max(axis=0)).max())
    assert 1e-10 < off <= said < 500 * off


def test_whole_numbers_and_single_precision_are_read_as_they_are():
    steps, faces = STEPS["bumpy"]()
    shift = np.array([5_411_000.0, 452_000.0, 0.0])
    for x in (np.round(steps) + 2.0**40, (steps + np.array([5000, 0, 0])).astype(np.float32)):
        assert read_alike(BiharmonicDistance(Surface(x, faces)).laplacian.components[0], 3) == []
    component = BiharmonicDistance(Surface(steps / 100 + shift, faces)).laplacian.components[0]
    near, *others = read_alike(component, 3)
    assert len(others) == 3
    np.testing.assert_array_equal(near.vertices, component.surface.vertices - component.surface.vertices[0])
    for other in others:
        moved = np.abs(other.vertices - near.vertices)
        assert 0 < moved.max() <= np.spacing(shift[0]) / 2


def test_near_the_origin_nothing_is_lost():
    for surface in (bumpy(300), torus(), needles(bumpy(60), 1e-2, every=4)):
        assert read_alike(BiharmonicDistance(surface).laplacian.components[0], 3) == []
