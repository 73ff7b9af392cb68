"""Vertices in one place made one on request: `Surface.merged`."""

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, MeshError, ParameterError, Surface
from bihdist_core.coincident_points import least_apart, merged_within
from tests.shapes import bumpy, grid


def torn(surface, seed=0, apart=0.0):
    """Each face with corners of its own, some way from where they were."""
    rng = np.random.default_rng(seed)
    corners = surface.vertices[surface.faces].reshape(-1, 3)
    step = rng.normal(size=corners.shape)
    return Surface(
        corners + apart * step / np.linalg.norm(step, axis=1)[:, None], np.arange(len(corners)).reshape(-1, 3)
    )


def test_corners_in_one_place_make_the_surface_again():
    surface = bumpy(300)
    whole, ids = torn(surface).merged()
    assert (whole.n_vertices, whole.n_faces, whole.n_components) == (300, surface.n_faces, 1)
    assert whole.facts == (f"{len(ids) - 300:,} vertices merged with others within 0",)
    # Numbered as they first appear.
    order = surface.faces.ravel()[np.unique(ids, return_index=True)[1]]
    np.testing.assert_array_equal(whole.vertices, surface.vertices[order])
    np.testing.assert_allclose(
        BiharmonicDistance(whole).from_source(0), BiharmonicDistance(surface).from_source(order[0])[order], rtol=1e-9
    )


@pytest.mark.parametrize("tolerance", [0.0, 0.01, 0.05, 0.3])
def test_no_vertex_moves_farther_and_those_left_are_farther_apart(tolerance):
    surface = torn(bumpy(300), apart=0.004)
    result, ids = surface.merged(tolerance)
    moved = np.linalg.norm(result.vertices[ids] - surface.vertices, axis=1)
    assert moved.max() <= tolerance
    kept = result.vertices
    apart = np.linalg.norm(kept[:, None] - kept, axis=2) + 1e9 * np.eye(len(kept))
    assert apart.min() > tolerance
    # That with the least id stays where it is.
    first = np.unique(ids, return_index=True)[1]
    np.testing.assert_array_equal(surface.vertices[first], kept)
    assert (np.diff(first) > 0).all()


def test_found_as_by_looking_at_all_pairs():
    points = np.random.default_rng(1).random((200, 3))
    kept, place = merged_within(points, 0.2)
    expected, standing = [], []
    for point in points:
        near = [k for k, other in enumerate(expected) if np.linalg.norm(other - point) <= 0.2]
        standing.append(near[0] if near else len(expected))
        expected += [] if near else [point]
    np.testing.assert_array_equal(points[kept], expected)
    np.testing.assert_array_equal(place, standing)


def test_how_far_the_nearest_two_are_apart():
    points = np.random.default_rng(2).random((50, 3))
    apart = np.linalg.norm(points[:, None] - points, axis=2) + 9 * np.eye(50)
    assert least_apart(points) == pytest.approx(apart.min())
    assert least_apart(points[:1]) == np.inf


def test_faces_that_collapse_are_dropped_and_said():
    surface = Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1.01, 0]], [[0, 1, 2], [1, 3, 2], [0, 1, 3]], repairs=["x"])
    result, ids = surface.merged(0.02)
    assert (result.faces.tolist(), ids.tolist()) == ([[0, 1, 2]], [0, 1, 2, 2])
    assert result.repairs == ("x", "1 face with a repeated vertex dropped", "1 face that repeated another dropped")
    assert result.facts == ("1 vertex merged with others within 0.02",)


def test_a_surface_with_nothing_to_merge_is_itself():
    surface = grid(4, 4)
    result, ids = surface.merged(1e-9)
    assert result is surface
    np.testing.assert_array_equal(ids, np.arange(surface.n_vertices))


def test_both_zeros_are_one_place():
    surface = Surface([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-0.0, 0, 0], [0, -1, 0]], [[0, 1, 2], [3, 4, 1]])
    assert surface.merged()[1].tolist() == [0, 1, 2, 0, 3]


@pytest.mark.parametrize("tolerance", [-1, np.nan, np.inf])
def test_a_tolerance_is_a_length(tolerance):
    with pytest.raises(ParameterError, match="0 or more, not"):
        grid(4, 4).merged(tolerance)


def test_a_tolerance_that_leaves_no_face_is_refused():
    with pytest.raises(MeshError, match="every face names a vertex twice"):
        grid(4, 4).merged(100)
