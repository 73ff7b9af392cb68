"""What a tool of somebody else marks is painted in the window."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from app.document import tools
from app.document.edits import move_source
from app.drawing.glyphs import PATH, SOURCE
from app.qt.panels import line_marks
from tests.figures.marked_tool import FLAG, TOOL
from tests.shapes import bumpy


def test_points_lines_and_areas_of_a_tool_are_painted_and_follow_the_answers(screen, mesh_file, monkeypatch):
    entry = SimpleNamespace(name="farthest", load=lambda: TOOL)
    monkeypatch.setattr(tools, "entry_points", lambda group: [entry])
    tools.tools.cache_clear()
    monkeypatch.setattr(line_marks, "FINE", np.inf)
    try:
        s = screen()
        s.open(mesh_file(bumpy(300)), 5)
        for source in (5, 200):
            s.session.show(move_source(s.document, 0, source))
            s.until(lambda: s.session.is_complete)
            s.settle(0.1)
            for panel in s.panels:
                farthest = int(np.nanargmax(panel.answer.field))
                (placed,) = panel.view.over.points.placed("farthest")
                assert (placed.mark.vertex, placed.mark.glyph) == (farthest, FLAG)
                assert np.array_equal(placed.position, panel.positions[farthest])
                assert [text for text, _, _ in panel.view.over.points.texts()] == ["farthest"] * placed.is_seen
                # Lines lie over the surface, as closed as they are said to be.
                faces = s.session.mesh().surface.faces
                near = faces[(faces == farthest).any(axis=1)]
                assert len(panel.view.over.lines.points) == 4 * len(near)
                tint = panel.view.scene.field_actor._tints["selected"]
                assert np.flatnonzero(tint.any(axis=1)).tolist() == np.unique(near).tolist()
    finally:
        tools.tools.cache_clear()


def test_lines_that_pass_beside_the_eye_are_painted_about_the_view_only(shared_screen):
    s = shared_screen()
    view = s.panels[0].view
    eye = np.array(view.camera.GetPosition())
    ahead = np.array(view.camera.GetDirectionOfProjection())
    right = np.cross(ahead, view.camera.GetViewUp())
    view.over.lines.show([("", SOURCE, np.stack([eye + ahead, eye + 1e-7 * ahead + right]))])
    view.redraw()
    s.settle(0.1)
    assert np.nanmax(view.over.lines.pixels) > 1e7
    boxes = [path.boundingRect() for _, strokes in view.over.lines._paths for _, _, path in strokes]
    assert boxes
    for box in boxes:
        assert view.width() / 2 < box.right() <= 2 * view.width()


def test_a_line_behind_a_translucent_surface_is_paler(shared_screen):
    s = shared_screen()
    s.session.show(replace(s.document, opacity=0.4))
    s.settle(0.1)
    view = s.panels[0].view
    ahead = np.array(view.camera.GetDirectionOfProjection())
    points = s.panels[0].positions
    nearest, farthest = points[np.argmin(points @ ahead)], points[np.argmax(points @ ahead)]
    view.over.lines.show([("", PATH, np.stack([nearest, farthest]))])
    view.redraw()
    s.settle(0.1)
    lines = view.over.lines
    assert (lines.is_seen[0], lines.is_seen[-1]) == (True, False)
    ((_, strokes),) = lines._paths
    assert [opacity for _, opacity, _ in strokes] == [0.6, 0.6, 1.0, 1.0]
    assert view.scene.field_actor.opacity == 0.4
