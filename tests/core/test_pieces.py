"""Sources on a surface: boundary loops by their numbers, ways of curves, and faces divided at places."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from bihdist_core import (
    BoundaryLoop,
    Curve,
    ParameterError,
    SourceSet,
    Surface,
    SurfacePoint,
    VertexError,
    read_surface,
)
from bihdist_core.sources.boundary import boundary_loops
from bihdist_core.sources.pieces import pieces_of
from bihdist_core.sources.splitting import split_at
from tests.shapes import MESHES, bumpy, fin, grid, needs_meshes, torus, two_pieces

ROUNDING = 1e-12


def holes() -> Surface:
    """A grid with two holes of one size, a larger one, and its outline."""
    g = grid(12, 6)
    x, y = g.vertices[g.faces].mean(axis=1)[:, :2].T
    small = (x > 1) & (x < 2) & (y > 1) & (y < 2) | (x > 4) & (x < 5) & (y > 3) & (y < 4)
    large = (x > 7) & (x < 10) & (y > 2) & (y < 4)
    return Surface(g.vertices, g.faces[~small & ~large], "holes")


def length(pieces, surface):
    start, stop = pieces.positions(surface.vertices)
    return np.linalg.norm(stop - start, axis=1).sum()


def test_loops_are_numbered_by_length_and_equal_ones_by_their_least_vertex():
    s = holes()
    lengths = [length(pieces_of(BoundaryLoop(k), s), s) for k in range(4)]
    assert lengths == pytest.approx([36, 10, 4, 4], rel=ROUNDING)
    first, second = (s.boundary_edges[edges].min() for edges in boundary_loops(s)[2:])
    assert first < second


def test_the_numbers_do_not_depend_on_how_a_surface_lies():
    s = holes()
    for seed in range(10):
        turn = np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))[0]
        turned = Surface(s.vertices @ turn / 7 + 5, s.faces)
        for one, other in zip(boundary_loops(s), boundary_loops(turned), strict=True):
            assert np.array_equal(one, other)


def test_there_are_as_many_loops_as_are_counted():
    for s in (holes(), grid(3, 3), torus(), fin(), two_pieces()):
        assert len(boundary_loops(s)) == s.boundary_loop_count


def test_what_is_not_there_is_said():
    for s, source, said in [
        (torus(), BoundaryLoop(0), "no boundary loop 0: this mesh is closed"),
        (grid(3, 3), BoundaryLoop(1), "its only one is loop:0"),
        (holes(), SourceSet((1, BoundaryLoop(4))), "from loop:0 to loop:3, the longest first"),
        (grid(3, 3), SurfacePoint.of(18, 0.1, 0.1), "no face 18; faces run from 0 to 17"),
        (
            grid(3, 3),
            Curve((SurfacePoint.of(1, 0, 0), SurfacePoint.of(99, 0, 0))),
            "Point 1 of the curve: grid has no face 99",
        ),
    ]:
        with pytest.raises(ParameterError, match=said):
            pieces_of(source, s)
    for vertex, said in [(70, "has no vertex 70"), (60, "belongs to no face")]:
        with pytest.raises(VertexError, match=said):
            pieces_of(SourceSet((1, vertex)), two_pieces())


# ---------------------------------------------------------------------- ways
def connects(pieces, surface):
    """Whether each piece starts where that before it stops."""
    start, stop = pieces.positions(surface.vertices)
    return np.abs(start[1:] - stop[:-1]).max(initial=0) <= ROUNDING * np.abs(surface.vertices).max()


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.integers(0, 95), st.integers(0, 95), st.floats(0, 0.5), st.floats(0, 0.5))
def test_on_a_flat_surface_a_curve_is_straight(one, other, b0, b1):
    g = grid(8, 6)
    places = (SurfacePoint.of(one, b0, b1), SurfacePoint.of(other, b1, 0.25))
    pieces = pieces_of(Curve(places), g)
    ends = [np.array(p.weights) @ g.vertices[g.faces[p.face]] for p in places]
    assert length(pieces, g) == pytest.approx(np.linalg.norm(ends[1] - ends[0]), rel=1e-9, abs=1e-12)
    assert connects(pieces, g)
    assert (pieces.start >= 0).all()
    assert (pieces.stop >= 0).all()
    assert pieces.along.all()


def test_curves_from_corners_and_edges_and_closed_ones():
    g = grid(8, 6)
    corner, edge, inside = SurfacePoint.of(0, 1, 0), SurfacePoint.of(20, 0.5, 0.5), SurfacePoint.of(60, 0.3, 0.3)
    pieces = pieces_of(Curve((corner, edge, inside), closed=True), g)
    at = [np.array(p.weights) @ g.vertices[g.faces[p.face]] for p in (corner, edge, inside)]
    assert length(pieces, g) == pytest.approx(sum(np.linalg.norm(at[k] - at[k - 1]) for k in range(3)), rel=1e-12)
    start, stop = pieces.positions(g.vertices)
    assert np.abs(start[0] - stop[-1]).max() <= ROUNDING
    assert connects(pieces, g)


def test_a_way_on_a_sphere_is_that_of_a_great_circle():
    s = bumpy(4000)
    s = Surface(s.vertices / np.linalg.norm(s.vertices, axis=1)[:, None], s.faces)
    one, other = SurfacePoint.of(17, 0.3, 0.3), SurfacePoint.of(3000, 0.2, 0.5)
    pieces = pieces_of(Curve((one, other)), s)
    ends = [pieces.positions(s.vertices)[k][at] for k, at in ((0, 0), (1, -1))]
    angle = np.arccos(np.clip(ends[0] @ ends[1] / np.prod([np.linalg.norm(e) for e in ends]), -1, 1))
    assert length(pieces, s) == pytest.approx(angle, rel=2e-3)  # faces lie below the sphere
    assert connects(pieces, s)


def test_places_of_two_components_are_not_joined():
    s = two_pieces()
    last = len(s.faces) - 1
    with pytest.raises(ParameterError, match=r"Points 0 and 1 of the curve \(faces 0 and \d+\) cannot be joined"):
        pieces_of(Curve((SurfacePoint.of(0, 0.3, 0.3), SurfacePoint.of(last, 0.3, 0.3))), s)


@needs_meshes
def test_ways_across_a_real_shape():
    s = read_surface(MESHES / "hand_lowres.obj")
    rng = np.random.default_rng(1)
    for one, other in rng.integers(len(s.faces), size=(30, 2)):
        pieces = pieces_of(Curve((SurfacePoint.of(one, 0.3, 0.3), SurfacePoint.of(other, 0.3, 0.3))), s)
        assert connects(pieces, s)


# ---------------------------------------------------------------------- divided faces
@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.lists(st.tuples(st.integers(0, 7), st.sampled_from([0, 0.2, 0.25, 0.5]), st.sampled_from([0, 0.3, 0.5]))))
def test_a_divided_surface_has_the_same_shape_with_vertices_at_the_places(rows):
    g = grid(2, 2)
    source = SourceSet((0, *(SurfacePoint.of(*row) for row in rows)))
    points = pieces_of(source, g)
    split = split_at(g, points.faces, points.start)
    divided, ids = split.surface, split.vertices
    assert np.abs(divided.vertices[ids] - points.positions(g.vertices)[0]).max() <= ROUNDING
    assert divided.face_areas.sum() == pytest.approx(g.face_areas.sum(), rel=1e-12)
    assert divided.face_areas.min() > 0
    assert divided.is_manifold
    assert (divided.boundary_loop_count, divided.n_components, divided.genus) == (1, 1, 0)
    assert np.array_equal(divided.vertices[:9], g.vertices)
    apart = np.linalg.norm(divided.vertices[:, None] - divided.vertices, axis=2) + np.eye(len(divided.vertices))
    assert apart.min() > 1e-3  # no place twice
