"""Dots on isolines through points."""

from dataclasses import replace

import numpy as np

from app.document.document import Point
from app.document.edits import pass_through
from app.document.page import Recipe
from app.drawing.glyphs import DOT
from app.figures.export import compute, figure_of, open_document
from app.figures.layout import lay_out
from app.figures.shots import take_shots
from app.session.array_store import comparison_of_arrays
from bihdist_core import SurfacePoint
from bihdist_core.progress import silent
from tests.shapes import sphere


def test_a_dot_stands_where_the_line_passes_and_is_hidden_with_it():
    ball = sphere(800)
    front, back = (int((ball.vertices @ np.array(way)).argmax()) for way in ((0.4, 0.2, 1), (-0.4, -0.2, -1)))
    document, given = comparison_of_arrays(ball, ["biharmonic"], {}, (int(ball.vertices[:, 1].argmax()),))
    document = pass_through(document, (front, back))
    place = SurfacePoint(int(np.flatnonzero((ball.faces == front).any(axis=1))[0]), (0.2, 0.3, 0.5))
    inside = Point("inside", place)
    lines = replace(document.isolines, through=(*document.isolines.through, "inside"))
    document, surfaces = open_document(
        Recipe(replace(document, points=(*document.points, inside), isolines=lines)), given
    )
    answers = compute(document, surfaces)
    figure = figure_of(Recipe(document), surfaces, answers)
    (panel,) = figure.panels
    dots = [mark for mark in panel.marks if mark.glyph is DOT]
    corners, field = ball.faces[place.face], answers[0].field
    assert panel.through == (field[front], field[back], field[corners] @ place.weights)
    assert np.allclose(dots[2].on(ball.vertices), place.weights @ ball.vertices[corners])
    (shot,) = take_shots(figure, lay_out(figure), silent)
    seen = {k: (x, y) for k, x, y in shot.marks if panel.marks[k].glyph is DOT}
    assert sorted(seen) == [0, 2]  # the one at the back is not, and has no ghost
    assert not any(panel.marks[k].glyph is DOT for k, _, _ in shot.ghosts)
    for k, at in seen.items():
        (line,) = (line for line in shot.isolines if line.value == panel.through[k])
        assert line.is_through
        assert np.hypot(*(np.concatenate([points for points, _ in line.parts]) - at).T).min() < 8
