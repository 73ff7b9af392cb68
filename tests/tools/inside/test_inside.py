"""The dock by which one sees inside: what it says of the document, and what panels then show and hit."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.edits import put_point
from app.document.looks import Clip
from app.document.shared_parts.pins import add_pins
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import Curve, SurfacePoint
from tests.qt.parts import parts
from tests.shapes import bumpy, grid

pytest.importorskip("qtpy")

GEODESIC = Spec.of("geodesic", method="heat")


@pytest.fixture
def opened(shared_screen):
    def made(surface):
        s = shared_screen(surface, (GEODESIC, GEODESIC))
        s.window.actions_by_word["dock inside"].trigger()
        return s, parts(s.window).docks._docks["inside"].content

    return made


def press(dock, word):
    dock.direction.buttons[word].click()


def on_ground(s):
    """The fraction of each picture that is the ground of its panel."""
    return [float((picture == picture[0, 0]).all(axis=-1).mean()) for picture in s.pictures()]


def test_axes_slider_and_side_cut_all_panels_and_a_drag_is_one_step(opened):
    s, dock = opened(bumpy(600))
    whole, none = s.pictures(), on_ground(s)
    assert not dock.kept.isEnabled()
    press(dock, "x")
    assert s.document.clip == Clip()
    for step in (400, 300, 250):
        dock.kept.slider.setValue(step)
    s.settle(0.1)
    assert s.document.clip == Clip(kept=0.25)
    assert dock.kept.box.text() == "25"
    quarter = on_ground(s)
    assert min(quarter) > max(none) + 0.1
    dock.flip.click()
    s.settle(0.1)
    assert s.document.clip == Clip((-1.0, 0.0, 0.0), 0.75)
    assert dock.direction.choice() == "x"
    assert max(none) < min(on_ground(s)) < min(quarter)
    s.session.undo()
    s.session.undo()
    assert s.document.clip == Clip()
    s.session.undo()
    s.settle(0.1)
    assert s.document.clip is None
    assert dock.direction.choice() == "none"
    for one, other in zip(s.pictures(), whole, strict=True):
        np.testing.assert_array_equal(one, other)


def test_the_line_of_sight_opens_what_is_seen(opened):
    s, dock = opened(bumpy(600))
    press(dock, "view")
    towards = -np.array(s.window.grid.panels[0].view.camera.GetDirectionOfProjection())
    np.testing.assert_allclose(s.document.clip.normal, towards, atol=1e-3)
    assert dock.direction.choice() == "view"
    press(dock, "none")
    assert s.document.clip is None


def test_a_click_hits_what_is_seen_and_marks_that_are_cut_away_are_gone(opened):
    s, dock = opened(bumpy(600))
    surface = s.window.session.loaded().surface
    panel = s.window.grid.panels[0]
    middle = panel.view.rect().center()
    before = panel.view.pick(middle)
    s.session.apply(lambda document: add_pins(document, [before.vertex]))
    assert any(each.stands for each in panel.view.over.points.placed("pins"))
    press(dock, "view")
    s.settle(0.1)
    hit, plane = panel.view.pick(middle), panel.view.clip
    eye = np.array(panel.view.camera.GetPosition())
    assert np.linalg.norm(hit.position - eye) > np.linalg.norm(before.position - eye) + 0.5
    assert plane.depths(surface.vertices[[hit.vertex]])[0] >= 0
    assert not panel.view.sees(surface.vertices[before.vertex])
    assert panel.view.over.points.placed("pins") == []
    source = panel.marks.source
    assert plane.depths(surface.vertices[[source]])[0] < 0
    cut_away = panel.view.over.cut_away
    assert cut_away()[0] == f"Vertex {source} and 1 other mark are cut away by the clip plane."
    dock.flip.click()
    s.settle(0.1)
    assert cut_away() == ()


def test_a_curve_that_is_cut_away_is_named(opened):
    s, _ = opened(bumpy(600))
    surface = s.window.session.loaded().surface
    far = int(surface.vertices[surface.faces][:, :, 0].min(axis=1).argmax())
    curve = Curve((SurfacePoint(far, (0.8, 0.1, 0.1)), SurfacePoint(far, (0.1, 0.8, 0.1))))
    s.session.apply(lambda document: put_point(document, document.points[0].name, curve))
    s.settle(0.1)
    over = s.window.grid.panels[0].view.over
    assert over.cut_away() == ()
    s.session.show(replace(s.document, clip=Clip()))
    assert over.cut_away()[0] == "The curve of 2 points is cut away by the clip plane."
    s.session.show(replace(s.document, clip=Clip((-1.0, 0.0, 0.0))))
    assert over.cut_away() == ()


def test_a_height_field_is_cut_as_it_is_drawn(opened):
    s, _ = opened(grid(10, 10))
    s.session.show(replace(s.document, warp_factor=0.5, clip=Clip((0.0, 0.0, 1.0), 0.5)))
    s.settle(0.1)
    panel = s.window.grid.panels[0]
    heights = panel.shape.vertices[:, 2]
    assert np.ptp(heights) > 0
    assert panel.view.clip.offset == pytest.approx((heights.min() + heights.max()) / 2)


def test_through_what_is_translucent_pins_behind_it_are_seen(opened):
    s, dock = opened(bumpy(600))
    view = s.window.grid.panels[0].view
    surface = s.window.session.loaded().surface
    along = surface.vertices @ np.array(view.camera.GetDirectionOfProjection())
    s.session.apply(lambda document: add_pins(document, [int(along.argmax())]))
    s.settle(0.1)
    before = s.pictures()
    assert [each.is_seen for each in view.over.points.placed("pins")] == [False]
    for step in (700, 500, 400):
        dock.opacity.slider.setValue(step)
    s.settle(0.1)
    assert s.document.opacity == 0.4
    assert [each.is_seen for each in view.over.points.placed("pins")] == [True]
    assert min(float(np.abs(a.astype(int) - b).mean()) for a, b in zip(s.pictures(), before, strict=True)) > 2
    dock.opacity.slider.setValue(0)
    assert s.document.opacity == 0.05
    s.session.undo()
    s.settle(0.1)
    assert s.document.opacity == 1
    for one, other in zip(s.pictures(), before, strict=True):
        np.testing.assert_array_equal(one, other)
