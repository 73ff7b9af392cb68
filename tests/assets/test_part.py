"""What makes the sample `part` a machine part: planes, sharp edges, long triangles, nothing else."""

import numpy as np
import pytest

from bihdist_core import GeodesicDistance, Surface
from tests.assets.test_samples import corner_angles, edge_lengths, sample, volume

HEIGHTS = [0, 8, 16, 24, 32, 40]
"""Hub, rim, web, web, rim, hub: where its degenerate faces lie."""


def slopes(surface: Surface) -> np.ndarray:
    """(m,) z of the faces' unit normals."""
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    return normals[:, 2] / np.linalg.norm(normals, axis=1)


def edge_angles(surface: Surface) -> tuple[np.ndarray, np.ndarray]:
    """(e,) degrees by which the surface turns at each edge, and (e, 2) the faces there."""
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    ends = np.sort(surface.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    pairs = np.lexsort(ends.T).reshape(-1, 2) // 3
    sine = np.linalg.norm(np.cross(normals[pairs[:, 0]], normals[pairs[:, 1]]), axis=1)
    return np.degrees(np.arctan2(sine, (normals[pairs[:, 0]] * normals[pairs[:, 1]]).sum(axis=1))), pairs


def test_faces_are_level_upright_or_chamfers() -> None:
    slope = slopes(sample("part"))
    level, upright = np.abs(slope) == 1, slope == 0
    # Chamfers go down at 45 degrees, but for what single precision moves their corners by.
    assert np.abs(slope[~level & ~upright]) == pytest.approx(np.sqrt(0.5), abs=1e-4)
    assert min(level.sum(), upright.sum(), (~level & ~upright).sum()) > 1_000


def test_flat_faces_are_exactly_flat_and_have_no_inner_vertices() -> None:
    surface = sample("part")
    level = surface.faces[np.abs(slopes(surface)) == 1]
    z = surface.vertices[level][:, :, 2]
    assert np.all(z == z[:, :1])
    assert np.unique(z).tolist() == HEIGHTS
    assert set(level.ravel()) <= set(surface.faces[np.abs(slopes(surface)) < 1].ravel())


def test_sharp_edges_have_right_angles() -> None:
    surface = sample("part")
    turn, pairs = edge_angles(surface)
    slope = np.abs(slopes(surface))[pairs]
    square = (slope.max(axis=1) == 1) & (slope.min(axis=1) == 0)
    assert square.sum() > 1_000
    assert turn[square] == pytest.approx(90, abs=1e-9)
    beveled = (slope.max(axis=1) == 1) & (slope.min(axis=1) < 1) & ~square
    assert beveled.sum() > 1_000
    assert turn[beveled] == pytest.approx(45, abs=0.01)
    # Round walls are so finely cut that between them and the sharp edges there is a gap.
    smooth = turn < 30
    assert np.all((turn[~smooth] > 30) & (turn[~smooth] < 91))
    assert turn[(slope == 1).all(axis=1)].max() == 0


def test_triangles_are_long() -> None:
    surface = sample("part")
    assert len(surface.edges) == 3 * len(surface.faces) // 2
    sides = np.linalg.norm(
        surface.vertices[surface.faces] - surface.vertices[np.roll(surface.faces, 1, axis=1)], axis=2
    )
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    ratio = sides.max(axis=1) ** 2 / np.linalg.norm(np.cross(b - a, c - a), axis=1)  # longest side over its height
    assert np.median(ratio) > 4
    assert np.quantile(ratio, 0.9) > 20
    assert (corner_angles(surface).min(axis=1) < 5).mean() > 0.15
    assert edge_lengths(surface).max() / edge_lengths(surface).min() > 50


def test_it_is_as_large_as_a_gear_of_32_teeth_of_module_4() -> None:
    surface = sample("part")
    radius = np.hypot(*surface.vertices[:, :2].T)
    assert radius.max() == pytest.approx((32 + 2) * 4 / 2)
    # A disc of the pitch radius, less the pockets beside the web and the hub's bore, is a bound.
    assert 150_000 < volume(surface) < np.pi * 64**2 * 24


def test_it_is_rebuilt_alike() -> None:
    modelled = pytest.importorskip("assets.modelling.part", reason="the modelling script needs pyvista")
    points, faces = modelled.part()
    assert np.array_equal(faces, sample("part").faces)
    assert np.array_equal(points.astype("f4"), sample("part").vertices.astype("f4"))


def test_an_outline_cut_by_its_neighbours_triangles_is_refused() -> None:
    modelled = pytest.importorskip("assets.modelling.part", reason="the modelling script needs pyvista")
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1.0)])
    slot, hole = (square * (8, 0.2) + (1, 5))[::-1], (square * 0.2 + (4.9, 5.4))[::-1]
    solid = modelled.Solid()
    rings = [solid.walls(outline, (0.0, 7.0))[1] for outline in (10 * square, slot, hole)]
    with pytest.raises(ValueError, match=r"z = 7\.0 is too coarse"):
        solid.flat(rings, up=True)


@pytest.mark.parametrize(
    ("name", "heat", "dijkstra"), [("figure", (0.007, 0.03), (0.04, 0.06)), ("part", (0.03, 0.08), (0.1, 0.18))]
)
def test_geodesics_that_are_not_exact_are_off_by_what_is_said(name, heat, dijkstra) -> None:
    # The means that `GeodesicDistance` names; from single sources they differ by half.
    exact = GeodesicDistance(sample(name), "exact").from_source(100)
    there = exact > 0
    for method, (least, most) in (("heat", heat), ("dijkstra", dijkstra)):
        found = GeodesicDistance(sample(name), method).from_source(100)
        assert least < float((np.abs(found - exact)[there] / exact[there]).mean()) < most, method
