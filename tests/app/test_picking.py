"""What lies under the pointer, against looking at every face in turn."""

import numpy as np
import pytest
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (makes render windows)
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from app.document.looks import Clip
from app.scene.clipping import clip_plane
from app.scene.picking import BLOCK, BLOCKS_AT_ONCE, FaceBlocks, Picker
from bihdist_core import Surface
from tests.shapes import bumpy, fin, grid, slivers, sphere, torus, two_pieces

SIZE = 300
"""Pixels of the picture, across and up."""


def first_hit(surface, start, end):
    """The face met first and the point, by solving start + t way = a + u (b - a) + v (c - a) for each face."""
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    way = np.broadcast_to(end - start, a.shape)
    matrix = np.stack([way, a - b, a - c], axis=2)
    solvable = np.flatnonzero(np.abs(np.linalg.det(matrix)) > 1e-14)
    t, u, v = np.linalg.solve(matrix[solvable], (a - start)[solvable, :, None])[..., 0].T
    hit = np.flatnonzero((u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0) & (t <= 1))
    if not len(hit):
        return None
    best = hit[t[hit].argmin()]
    return int(solvable[best]), start + t[best] * (end - start)


def ways(surface, count, seed=0):
    """(count, 2, 3) ends of ways in all directions, most of them through the surface."""
    rng = np.random.default_rng(seed)
    x = surface.vertices[surface.faces].reshape(-1, 3)
    low, high = x.min(axis=0), x.max(axis=0)
    through = rng.uniform(low, high + 0.1, (count, 3))
    direction = rng.standard_normal((count, 3)) * np.linalg.norm(high - low)
    return np.stack([through - 2 * direction, through + 2 * direction], axis=1)


@pytest.mark.parametrize("surface", [bumpy(800), torus(), grid(4, 6), fin(), two_pieces(), slivers()], ids=str)
def test_a_way_meets_the_face_that_looking_at_all_of_them_finds(surface):
    blocks = FaceBlocks(surface)
    hit = 0
    for start, end in ways(surface, 300):
        expected, found = first_hit(surface, start, end), blocks.first_hit(start, end)
        assert (found is None) == (expected is None)
        if found:
            hit += 1
            assert found[0] == expected[0]
            # Rounding, made larger where a way only just is not along the face.
            assert np.allclose(found[2], expected[1], rtol=0, atol=1e-9)
            assert np.allclose(found[1] @ surface.vertices[surface.faces[found[0]]], found[2])
    assert hit > 10


def test_the_order_of_the_faces_does_not_matter():
    surface = sphere(10_000)
    assert len(surface.faces) > BLOCK * BLOCKS_AT_ONCE
    order = np.random.default_rng(1).permutation(len(surface.faces))
    one, other = FaceBlocks(surface), FaceBlocks(Surface(surface.vertices, surface.faces[order]))
    for start, end in ways(surface, 50):
        found, again = one.first_hit(start, end), other.first_hit(start, end)
        assert (found is None) == (again is None)
        if found:
            assert found[0] == order[again[0]]
            assert np.array_equal(found[2], again[2])


@pytest.mark.parametrize(("size", "away"), [(1.0, 0.0), (1e-9, 0.0), (1e9, 0.0), (1.0, 1e6)])
def test_no_way_slips_through_at_vertices_and_edges(size, away):
    shape = bumpy(300)
    surface = Surface(size * shape.vertices + away, shape.faces)
    blocks, middle = FaceBlocks(surface), np.full(3, away)
    edges = surface.vertices[surface.edges]
    # Seen from its middle every point of the surface is in front.
    for target in [*surface.vertices, *edges.mean(axis=1), *(0.3 * edges[:, 0] + 0.7 * edges[:, 1])]:
        *_, where = blocks.first_hit(middle, middle + 3 * (target - middle))
        # Rounding of the coordinates, which the surface may be far away with.
        assert np.linalg.norm(where - target) <= 1e-14 * (100 * size + 10 * away)


def test_a_way_ends_at_its_end_and_faces_edge_on_are_not_met():
    blocks = FaceBlocks(grid(3, 3))
    start = np.array([0.6, 0.3, 1.0])
    assert blocks.first_hit(start, start * [1, 1, 0.01]) is None
    assert blocks.first_hit(start, start) is None
    face, _, where = blocks.first_hit(start, start * [1, 1, -0.01])
    assert face == 0
    assert np.allclose(where, [0.6, 0.3, 0], rtol=0, atol=1e-15)
    assert blocks.first_hit(np.array([-1.0, 0.5, 0]), np.array([9.0, 0.7, 0])) is None


@pytest.fixture
def renderer():
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetSize(SIZE, SIZE)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1.5, 3, 6)
    camera.SetParallelScale(3.2)
    camera.SetViewAngle(50)
    camera.SetClippingRange(0.1, 20)
    yield renderer
    window.Finalize()


def ray(renderer, x, y):
    ends = []
    for depth in (0.0, 1.0):
        renderer.SetDisplayPoint(x, y, depth)
        renderer.DisplayToWorld()
        ends.append(np.array(renderer.GetWorldPoint()[:3]) / renderer.GetWorldPoint()[3])
    return ends


@pytest.mark.parametrize("parallel", [False, True])
def test_a_pixel_has_the_nearest_corner_of_the_face_in_front(renderer, parallel):
    renderer.GetActiveCamera().SetParallelProjection(parallel)
    surface = torus(40, 20)
    picker = Picker(surface)
    beside = 0
    # Everywhere in the picture: through the hole, at the rims, where one side of the ring hides the other.
    for x, y in np.random.default_rng(0).uniform(0, SIZE, (400, 2)):
        found, hit = picker.pick(renderer, x, y), first_hit(surface, *ray(renderer, x, y))
        if hit is None:
            beside += 1
            assert found is None
        else:
            corners = surface.faces[hit[0]]
            distances = np.linalg.norm(surface.vertices[corners] - hit[1], axis=1)
            assert found.vertex == corners[distances.argmin()]
            assert found.face == hit[0]
            assert np.allclose(found.position, hit[1], atol=1e-9)
            assert found.weights.min() >= 0
            assert np.isclose(found.weights.sum(), 1)
            assert np.allclose(found.weights @ surface.vertices[corners], found.position)
    assert 100 < beside < 300


@pytest.mark.parametrize("parallel", [False, True])
def test_what_is_cut_away_is_not_hit_but_what_is_seen_behind_it(renderer, parallel):
    renderer.GetActiveCamera().SetParallelProjection(parallel)
    surface = torus(40, 20)
    picker = Picker(surface)
    # Of the ring's front, and of all that is on one side.
    for clip in (Clip((0.2, 0.3, 1.0), 0.5), Clip((1.0, 0.0, 0.0), 0.3)):
        plane = clip_plane(clip, surface)
        behind = beside = 0
        for x, y in np.random.default_rng(0).uniform(0, SIZE, (300, 2)):
            ends = ray(renderer, x, y)
            # The slow way: from hit to hit, until one is of what is left.
            hit = first_hit(surface, *ends)
            was = hit
            while hit is not None and plane.depths(hit[1]) < 0:
                hit = first_hit(surface, hit[1] + 1e-7 * (ends[1] - ends[0]), ends[1])
            found = picker.pick(renderer, x, y, plane)
            assert (found is None) == (hit is None)
            if found is None:
                beside += was is not None
                continue
            behind += hit is not was
            assert found.face == hit[0]
            corners = surface.faces[hit[0]]
            left = plane.depths(surface.vertices[corners]) >= 0
            assert plane.depths(surface.vertices[found.vertex]) >= 0 or not left.any()
            assert picker.sees(renderer, found.position, plane)
            if hit is not was:
                assert not picker.sees(renderer, was[1], plane)
        assert behind + beside > 30


def test_a_vertex_in_front_is_found_where_it_is_seen_and_one_behind_is_not(renderer):
    surface = bumpy(800)
    picker = Picker(surface)
    position = np.array(renderer.GetActiveCamera().GetPosition())
    in_front = behind = 0
    for vertex, point in enumerate(surface.vertices):
        renderer.SetWorldPoint(*point, 1)
        renderer.WorldToDisplay()
        x, y, _ = renderer.GetDisplayPoint()
        hit = picker.pick(renderer, x, y)
        found = hit and hit.vertex
        _, where = first_hit(surface, position, position + 0.999 * (point - position)) or (0, point)
        if np.linalg.norm(where - point) > 0.01 or not _faces_towards(surface, vertex, position).any():
            behind += 1
            assert found != vertex
        elif _faces_towards(surface, vertex, position).all():
            in_front += 1
            assert found == vertex
    assert in_front > 200
    assert behind > 300


def _faces_towards(surface, vertex, position):
    """(k,) whether each of the vertex' faces shows its outer side."""
    a, b, c = np.moveaxis(surface.vertices[surface.faces[(surface.faces == vertex).any(axis=1)]], 1, 0)
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), position - a) > 0
