"""What is drawn on a surface becomes curves, parted where no way on the surface joins what was drawn."""

import numpy as np

from app.tools.source.gestures import source_from_strokes
from bihdist_core import Curve, SourceSet, Surface, SurfacePoint
from bihdist_core.sources.pieces import pieces_of
from tests.shapes import grid, two_pieces


def centre(face):
    return SurfacePoint.of(face, 0.3, 0.3)


def test_a_stroke_is_a_curve_and_a_dot_a_place():
    surface = grid(9, 9)
    stroke = [centre(face) for face in (0, 40, 90)]
    assert source_from_strokes([stroke], surface) == Curve(tuple(stroke))
    assert source_from_strokes([stroke], surface, is_closed=True) == Curve(tuple(stroke), closed=True)
    assert source_from_strokes([[centre(4)]], surface) == centre(4)
    corner = SurfacePoint(7, (0.0, 1.0, 0.0))
    assert source_from_strokes([[corner]], surface) == surface.faces[7][1]


def test_where_the_pointer_left_the_surface_curves_are_parted():
    surface = grid(9, 9)
    one, two = [centre(0), centre(20)], [centre(60), centre(90)]
    drawn = source_from_strokes([one, two, [centre(100)]], surface, is_closed=True)
    assert drawn == SourceSet((Curve(tuple(one)), Curve(tuple(two)), centre(100)))


def test_a_stroke_over_two_bodies_is_a_curve_on_each():
    surface = two_pieces()
    label = surface.component_of_vertex[surface.faces[:, 0]]
    bodies = [np.flatnonzero(label == k)[[0, 1]] for k in (0, 1)]
    places = [[centre(int(face)) for face in body] for body in bodies]
    drawn = source_from_strokes([places[0] + places[1]], surface)
    assert drawn == SourceSet(tuple(Curve(tuple(each)) for each in places))
    pieces_of(drawn, surface)


def test_from_a_fold_to_what_is_behind_it_curves_are_parted():
    """A strip that is folded back over itself: near in space, far on the surface."""
    flat = grid(41, 3)
    x, y = flat.vertices[:, 0] / flat.vertices[:, 0].max(), flat.vertices[:, 1] / flat.vertices[:, 1].max()
    folded = np.column_stack([np.minimum(x, 1 - x), 0.1 * y, np.where(x > 0.5, 0.02, 0.0)])
    surface = Surface(folded, flat.faces)
    centres = folded[flat.faces].mean(axis=1)
    below = np.flatnonzero((centres[:, 2] == 0) & (centres[:, 0] < 0.2))
    above = np.flatnonzero(centres[:, 2] == 0.02)
    one, two, three = (centre(int(face)) for face in below[[0, 4, 8]])
    over = [int(above[np.linalg.norm(centres[above, :2] - centres[below[k], :2], axis=1).argmin()]) for k in (0, 8)]
    behind = [centre(face) for face in over]
    drawn = source_from_strokes([[one, two, three, *behind]], surface)
    assert drawn == SourceSet((Curve((one, two, three)), Curve(tuple(behind))))


def test_a_leap_through_a_hole_parts_a_stroke_and_a_leap_along_the_surface_does_not():
    """Around a bend, twice as far as straight: near places are joined there, far ones only where the way is direct."""
    flat = grid(41, 5)
    x, y = flat.vertices[:, 0] / flat.vertices[:, 0].max(), flat.vertices[:, 1] / flat.vertices[:, 1].max()
    turn = np.pi * x
    surface = Surface(np.column_stack([np.cos(turn), 0.3 * y, np.sin(turn)]), flat.faces)
    centres = surface.vertices[surface.faces].mean(axis=1)
    level = np.flatnonzero(np.abs(centres[:, 1] - 0.14) < 0.03)
    along = level[np.argsort(-centres[level, 0])]
    small = [centre(int(face)) for face in along[:8]]
    opposite, near = centre(int(along[-1])), centre(int(along[25]))
    assert source_from_strokes([[*small, opposite]], surface) == SourceSet((Curve(tuple(small)), opposite))
    assert source_from_strokes([[*small, near]], surface) == Curve((*small, near))
