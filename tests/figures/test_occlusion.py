"""What is hidden, against rays to every face; what is drawn of isolines, against what is seen."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from app.figures.hidden_lines import Curve, HiddenLineRemoval
from app.figures.occlusion import Occlusion
from app.scene.camera import Camera, Projection, standard_camera
from bihdist_core import Surface, read_surface
from bihdist_core.analysis.isoline_tracing import isolines
from tests.figures.hidden_line_reference import seen_by_rays
from tests.shapes import MESHES, bumpy, fin, needs_meshes, sphere, torus

SIDE = 500.0


def rough(surface, amount, seed=1):
    """The surface with vertices displaced by so many mean edge lengths."""
    a, b = surface.vertices[surface.edges.T]
    step = amount * np.linalg.norm(a - b, axis=1).mean()
    shift = np.random.default_rng(seed).standard_normal(surface.vertices.shape)
    return Surface(surface.vertices + step * shift, surface.faces)


def two_rings():
    """That pass through each other."""
    one = torus(60, 30)
    turned = one.vertices @ np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]).T + [1.3, 0.1, 0.2]
    return Surface(np.concatenate([one.vertices, turned]), np.concatenate([one.faces, one.faces + len(turned)]))


def holes():
    """A third of a ring's faces, with all sides of the others free."""
    ring = torus(60, 30)
    return Surface(ring.vertices, ring.faces[::3])


def missing_and_extra(surface, field, levels=15, samples=4000):
    """Shares of what is seen of isolines: what is not drawn of it, and by how much more is drawn in all."""
    camera = standard_camera(surface.vertices, 1.0)
    sight = HiddenLineRemoval(surface, Projection(camera, 1.0, surface.vertices), (SIDE, SIDE))
    low, high = field.min(), field.max()
    lines = isolines(surface, field, np.linspace(low, high, levels + 2)[1:-1])
    drawn = sight.visible(Curve(line.points, line.edges, line.closed) for line in lines)
    rng, seen_length, missing, whole, total = np.random.default_rng(0), 0.0, 0.0, 0.0, 0.0
    for line, parts in zip(lines, drawn, strict=True):
        ring = np.concatenate([line.points, line.points[:1]]) if line.closed else line.points
        lengths = np.linalg.norm(np.diff(sight.pixels(ring)[:, :2], axis=0), axis=1)
        total += lengths.sum()
        count = max(int(samples / len(lines)), 10)
        k = rng.choice(len(lengths), count, p=lengths / lengths.sum())
        points = ring[k] + rng.random(count)[:, None] * (ring[k + 1] - ring[k])
        seen = seen_by_rays(surface, np.array(camera.position), points)
        each = lengths.sum() / count
        seen_length += each * seen.sum()
        if not parts:
            missing += each * seen.sum()
            continue
        dense = np.concatenate([along(p, closed) for p, closed in parts])
        off = cKDTree(dense).query(sight.pixels(points[seen])[:, :2])[0] if seen.any() else np.empty(0)
        missing += each * (off > 0.1).sum()
        whole += sum(length(p, closed) for p, closed in parts)
    return missing / seen_length, whole / seen_length - 1


def length(points, closed):
    ring = np.concatenate([points, points[:1]]) if closed else points
    return np.linalg.norm(np.diff(ring, axis=0), axis=1).sum()


def along(points, closed, step=0.05):
    ring = np.concatenate([points, points[:1]]) if closed else points
    at = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(ring, axis=0), axis=1)))
    where = np.linspace(0, at[-1], int(at[-1] / step) + 2)
    return np.stack([np.interp(where, at, ring[:, k]) for k in (0, 1)], 1)


@pytest.mark.parametrize(
    ("surface", "most"),
    [
        (sphere(3000), 0.001),
        (torus(60, 30), 0.001),
        (two_rings(), 0.001),
        (holes(), 0.001),
        (rough(bumpy(3000), 0.3), 0.01),
        (rough(torus(80, 40), 0.5), 0.01),
    ],
    ids=["sphere", "ring", "two rings", "holes", "rough", "rougher"],
)
def test_what_is_seen_of_isolines_is_drawn_and_no_more(surface, most):
    missing, extra = missing_and_extra(surface, surface.vertices @ np.array([0.3, 1.0, 0.2]))
    assert missing <= most
    # The length that is seen is known from 4000 samples only, of which a third to a half is seen.
    assert abs(extra) < 0.05


@needs_meshes
@pytest.mark.parametrize("name", ["bunny_raw.obj", "suzanne.obj", "camelhead.off"])
def test_real_scans(name):
    surface = read_surface(MESHES / name)
    used = surface.component_of_vertex >= 0
    surface = Surface(surface.vertices[used], (np.cumsum(used) - 1)[surface.faces])
    missing, extra = missing_and_extra(surface, surface.vertices @ np.array([0.3, 1.0, 0.2]), 8, 1500)
    assert missing <= 0.003
    assert abs(extra) < 0.1


def test_faces_that_pass_the_eye_hide_what_is_behind_them():
    # A floor that reaches from before the eye to behind it, and a wall under it.
    floor = [[-9.0, -1, -20], [9, -1, -20], [9, -1, 20], [-9, -1, 20]]
    wall = [[-1.0, -4, -10], [1, -4, -10], [1, 0, -10], [-1, 0, -10]]
    both = Surface(np.array(floor + wall), np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]))
    camera = Camera((0, 0, 0), (0, 0, -1), (0, 1, 0), (0.5, 0.5))
    sight = HiddenLineRemoval(both, Projection(camera, 1.0, both.vertices), (SIDE, SIDE))
    line = Curve(np.array([[0.0, -4, -10], [0, 0, -10]]), np.array([[4, 5], [6, 7]]))
    (((part, closed),),) = sight.visible([line])
    assert not closed
    # The wall is seen from its upper end, straight ahead, down to the floor 1 below the eye and 10 away.
    assert part[[0, -1], 1] == pytest.approx([SIDE / 2 * (1 + 1 / 5), SIDE / 2])
    assert (sight.sees(np.array([0, -0.9, -10.0])), sight.sees(np.array([0, -1.1, -10.0]))) == (True, False)


def test_intervals_of_random_triangles_are_where_one_is_nearer():
    rng = np.random.default_rng(4)
    corners = rng.random((200, 3, 3)) * [1, 1, 1]
    corners[:, 1:, :2] = corners[:, :1, :2] + 0.4 * (corners[:, 1:, :2] - 0.5)
    ends = rng.random((40, 2, 3))
    occlusion = Occlusion(corners, np.arange(600).reshape(-1, 3))
    segment, start, stop = occlusion.intervals(ends, np.full((40, 4), -1))
    for k, (p, q) in enumerate(ends):
        mine = segment == k
        assert (start[mine][1:] > stop[mine][:-1]).all()
        for t in rng.random(12):
            at = p + t * (q - p)
            found = bool(((start[mine] < t) & (t < stop[mine])).any())
            assert found == any(is_before(triangle, at) for triangle in corners)
            assert found == bool(occlusion.nearest(at[None, :2])[0] > at[2])


def is_before(triangle, at):
    weights = np.linalg.solve(np.vstack([triangle[:, :2].T, np.ones(3)]), [*at[:2], 1])
    return (weights >= 0).all() and weights @ triangle[:, 2] > at[2]


def test_edges_of_three_faces_hide_and_are_seen():
    surface = fin()
    camera = standard_camera(surface.vertices, 1.0)
    sight = HiddenLineRemoval(surface, Projection(camera, 1.0, surface.vertices), (SIDE, SIDE))
    points = 0.6 * surface.vertices[surface.faces[:, 0]] + 0.2 * surface.vertices[surface.faces[:, 1:]].sum(axis=1)
    expected = seen_by_rays(surface, np.array(camera.position), points)
    assert [sight.sees(point) for point in points] == expected.tolist()


def test_beside_the_shape_nothing_is_hidden():
    # Two triangles far apart: between them are cells of the grid without any.
    one = np.array([[0.0, 0, 1], [10, 0, 1], [0, 10, 1]])
    occlusion = Occlusion(np.stack([one, one + np.array([400, 400, 0])]), np.arange(6).reshape(2, 3))
    assert occlusion.nearest(np.array([[200.0, 200.0]])).tolist() == [-np.inf]
    assert occlusion.nearest(np.array([[200.0, 200.0], [2.0, 2.0]])).tolist() == [-np.inf, 1.0]
    ends = np.array([[[200.0, 200, 0.5], [220, 200, 0.5]]])
    assert [len(each) for each in occlusion.intervals(ends, np.full((1, 4), -1))] == [0, 0, 0]
