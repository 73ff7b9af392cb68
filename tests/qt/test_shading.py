"""Shading in the window, and what stands in for a large surface while the camera moves."""

from dataclasses import replace

import numpy as np
import pytest
from qtpy import QtCore, QtWidgets
from qtpy.QtTest import QTest

import app.qt.panels.shading_cache
import app.scene.stand_in
from app.document.looks import AS_IT_IS, Shading
from app.document.settings import SHADING
from bihdist_core.distances.distance_types import Spec
from tests.app.test_shading import box
from tests.qt.events import send_mouse
from tests.qt.parts import parts
from tests.shapes import bumpy, grid

GEODESIC = Spec.of("geodesic", method="heat")


@pytest.fixture
def loaded(shared_screen):
    return lambda surface: shared_screen(surface, (GEODESIC, GEODESIC))


def differ(one, other):
    return [float(np.abs(a.astype(int) - b).mean()) for a, b in zip(one, other, strict=True)]


# ---------------------------------------------------------------------- shading
def test_menus_shade_all_panels_and_undo_takes_it_back(loaded):
    s = loaded(box(6))
    window = s.window
    usual = s.pictures()
    choices = {action.data(): action for action in window.menus.shading.actions() if action.data()}
    assert choices["auto"].isChecked()
    pictures = {}
    for word in ("smooth", "flat", "creased"):
        choices[word].trigger()
        s.settle(0.05)
        assert s.document.shading == Shading(word)
        assert choices[word].isChecked()
        assert not choices["auto"].isChecked()
        pictures[word] = s.pictures()
    # A box has creases: what is chosen by itself, and what each face's own normal gives.
    assert max(differ(pictures["creased"], usual)) == 0
    assert max(differ(pictures["flat"], usual)) < 1
    assert min(differ(pictures["smooth"], usual)) > 2
    window.actions_by_word["show_edges"].trigger()
    assert s.document.shading == Shading("creased", show_edges=True)
    s.settle(0.05)
    assert min(differ(s.pictures(), usual)) > 0.5
    for _ in range(4):
        window.session.undo()
    s.settle(0.05)
    assert s.document.shading == AS_IT_IS
    assert max(differ(s.pictures(), usual)) == 0
    assert not window.actions_by_word["show_edges"].isChecked()


def test_the_key_w_shows_the_edges_in_new_panels_and_other_colours_too(loaded):
    s = loaded(bumpy(300))
    without, action = s.pictures(), s.window.actions_by_word["show_edges"]
    assert [key.toString() for key in action.shortcuts()] == ["W"]
    action.trigger()
    s.settle(0.1)
    assert s.document.shading.show_edges
    assert min(differ(s.pictures(), without)) > 0.5
    parts(s.window).choices.add_panel()
    s.until(lambda: s.session.is_complete)
    parts(s.window).choices.colour_map("uniform")
    s.settle(0.1)
    wired = s.pictures()
    s.window.actions_by_word["show_edges"].trigger()
    s.settle(0.1)
    assert len(wired) == 3
    assert min(differ(s.pictures(), wired)) > 0.3


def test_an_angle_is_asked_for_and_makes_it_creased(loaded, monkeypatch):
    s = loaded(bumpy(300))
    smooth = s.pictures()
    monkeypatch.setattr(QtWidgets.QInputDialog, "getDouble", lambda *_: (12.5, True))
    s.window.actions_by_word["feature angle"].trigger()
    s.settle(0.1)
    assert s.document.shading == Shading("creased", 12.5)
    assert min(differ(s.pictures(), smooth)) > 0.3


def test_a_flat_surface_raised_is_shaded_as_well(loaded):
    s = loaded(grid(8, 8))
    s.session.show(replace(s.document, warp_factor=0.4))
    s.settle(0.1)
    before = s.pictures()
    parts(s.window).choices.set(SHADING, "flat")
    s.settle(0.1)
    flat = s.pictures()
    assert min(differ(flat, before)) > 0.1
    parts(s.window).choices.set(SHADING, "auto")
    s.settle(0.1)
    assert max(differ(s.pictures(), before)) == 0


def test_large_surfaces_are_split_on_a_thread_of_its_own(loaded, monkeypatch):
    s = loaded(bumpy(2000))
    smooth = s.pictures()
    monkeypatch.setattr(app.qt.panels.shading_cache, "LARGE", 10)
    parts(s.window).choices.set(SHADING, "flat")  # needs no other mesh
    parts(s.window).choices.set(SHADING, "creased")
    crease = Shading("creased", 8.0)
    s.session.show(replace(s.document, shading=crease))
    meshes = s.session.loaded().prepared.meshes
    s.until(lambda: meshes.ready(crease) is not None)
    s.settle(0.2)
    assert min(differ(s.pictures(), smooth)) > 0.1
    drawn = meshes.ready(crease)
    assert all(panel._drawn is drawn for panel in s.panels)


# ---------------------------------------------------------------------- moving
@pytest.fixture
def large(loaded, monkeypatch):
    """For which something stands in, and that is slow to draw."""
    monkeypatch.setattr(app.scene.stand_in.stand_in, "__defaults__", (400,))
    s = loaded(bumpy(4000))
    monkeypatch.setattr(s.window.grid.motion, "fluent", 0.0)
    s.settle(0.1)
    return s


def standing(s):
    return [panel.view.scene.field_actor.stand_in.is_shown for panel in s.panels]


def drag(s, view, steps=3, let_go=True):
    middle = view.rect().center()
    QTest.mousePress(view, QtCore.Qt.MouseButton.LeftButton, pos=middle)
    for step in range(1, steps + 1):
        place, button = middle + QtCore.QPoint(30 * step, 5), QtCore.Qt.MouseButton.LeftButton
        send_mouse(view, place, button, button)
    if let_go:
        QTest.mouseRelease(view, QtCore.Qt.MouseButton.LeftButton, pos=place)


def test_what_stands_in_is_drawn_while_the_camera_moves_and_never_at_rest(large, monkeypatch):
    s, view = large, large.panels[0].view
    drawn = []
    offscreen = s.window.grid.offscreen
    picture = offscreen.picture

    def draw(scene, size):
        drawn.append(scene.field_actor.stand_in.is_shown)
        return picture(scene, size)

    monkeypatch.setattr(offscreen, "picture", draw)
    drag(s, view, let_go=False)
    assert standing(s) == [True, True]
    for panel in s.panels:
        panel.view.repaint()
    assert drawn
    assert all(drawn)
    drawn.clear()
    QTest.mouseRelease(view, QtCore.Qt.MouseButton.LeftButton, pos=view.rect().center())
    assert standing(s) == [False, False]  # at once
    s.settle(0.1)
    assert drawn
    assert not any(drawn)
    full = s.pictures()
    s.window.grid.redraw()
    assert max(differ(s.pictures(), full)) == 0


def test_a_camera_that_stops_without_being_let_go_is_at_rest_soon(large):
    s, view = large, large.panels[0].view
    view.zoom(1.1)
    assert standing(s) == [True, True]
    s.until(lambda: not any(standing(s)), 5)


def test_screenshots_and_picks_are_of_the_surface_itself(large, tmp_path):
    s, view = large, large.panels[0].view
    s.settle(0.1)
    place = s.point_of(s.panels[0], s.source)
    hit = view.pick(place)
    view.turn_by(1, 0)
    view.turn_by(-1, 0)
    assert any(standing(s))
    again = view.pick(place)
    assert (again.face, again.vertex) == (hit.face, hit.vertex)
    parts(s.window).files.save_screenshot(str(tmp_path / "window.png"))
    assert not any(standing(s))
    view.turn_by(1, 0)
    assert view.shot().any()
    assert not view.scene.field_actor.stand_in.is_shown


def test_quick_drawing_needs_no_stand_in_and_standard_views_neither(large, monkeypatch):
    s, view = large, large.panels[0].view
    parts(s.window).views.reset("front")
    assert standing(s) == [False, False]
    monkeypatch.setattr(s.window.grid.motion, "fluent", 1e9)
    view.turn_by(1, 0)
    assert standing(s) == [False, False]


def test_a_change_of_the_shading_while_moving_is_seen_at_rest(large):
    s, view = large, large.panels[0].view
    view.turn_by(1, 0)
    parts(s.window).choices.set(SHADING, "creased")
    s.until(lambda: not any(standing(s)), 5)
    s.settle(0.3)
    before = s.pictures()
    s.window.grid.redraw()
    assert max(differ(s.pictures(), before)) == 0
    view.turn_by(1, 0)
    assert standing(s) == [True, True]
