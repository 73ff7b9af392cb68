"""In the window: which way is up by keys, kept for each mesh, turntables, no perspective, cameras as text."""

import json
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from qtpy import QtCore, QtWidgets

from app.document.camera import Camera
from app.document.camera_text import camera_text
from app.qt import remembered
from app.samples import mesh_path
from app.scene.camera import Projection, frame
from bihdist_core import read_surface
from bihdist_core.analysis.upright import axis_of
from bihdist_core.distances.distance_types import Spec
from tests.qt.parts import parts
from tests.shapes import bumpy

pytestmark = pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed")

ONE = (Spec.of("geodesic", method="dijkstra"),)


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    return tmp_path


@pytest.fixture
def hare(shared_screen, home):
    return shared_screen(mesh_path("hare"), ONE, source=None)


def seen_up(s):
    """(3,) what is up in the picture."""
    return frame(s.window.grid.camera_controller.seen)[:, 1]


def press(s, key):
    """A real key."""
    window = int(s.window.winId())
    subprocess.run(["xdotool", "windowfocus", "--sync", str(window), "key", key], check=True)
    s.settle(0.15)


def ticked(menu):
    return [action.text() for action in menu.actions() if action.isChecked()]


def test_a_scan_stands_and_its_source_is_its_highest_vertex(hare):
    s = hare
    assert s.document.up == "z"
    assert seen_up(s) @ axis_of("z") > 0.9
    heights = s.session.mesh().surface.vertices[:, 2]
    assert s.source == heights[s.session.mesh().surface.component_of_vertex == 0].argmax() or heights[
        s.source
    ] > 0.9 * max(heights)
    assert ticked(s.window.menus.up) == ["z"]


def test_a_key_turns_another_axis_up_and_it_can_be_undone(hare):
    s = hare
    press(s, "u")
    assert s.document.up == "x"
    press(s, "u")
    assert s.document.up == "y"
    press(s, "shift+u")
    assert s.document.up == "-y"
    assert seen_up(s) @ axis_of("-y") > 0.9
    assert ticked(s.window.menus.up) == ["−y"]
    s.panels[0].view.turn_by(1, 1)
    s.session.undo()
    # All of it was one step, and what was seen under another sky is not seen askew.
    assert (s.document.up, s.document.camera) == ("z", "home")
    assert seen_up(s) @ axis_of("z") > 0.9
    s.session.redo()
    assert s.document.up == "-y"


def test_what_was_chosen_for_a_mesh_is_kept_for_it(screen, home, mesh_file):
    path, other = mesh_file(bumpy(150), "one.off"), mesh_file(bumpy(160), "two.off")
    s = screen(ONE)
    s.window.context.remembers = True
    s.open(path)
    parts(s.window).views.set_up_axis("-x")
    sha256 = s.document.surfaces[0].sha256
    assert remembered.up_of(sha256) == "-x"
    s.open(other)
    assert s.document.up == "y"
    s.open(path)
    assert s.document.up == "-x"
    assert seen_up(s) @ axis_of("-x") > 0.9
    (remembered.folder() / "up.json").write_text(json.dumps({sha256: "sideways"}))
    assert remembered.up_of(sha256) == ""
    (remembered.folder() / "up.json").write_text("[1, 2")
    assert remembered.up_of(sha256) == ""
    remembered.remember_up("another", "z")
    assert remembered.up_of("another") == "z"


def test_the_ups_chosen_longest_ago_are_forgotten(home, application, monkeypatch):
    monkeypatch.setattr(remembered, "MOST_UPS", 3)
    for k in range(5):
        remembered.remember_up(str(k), "z")
    remembered.remember_up("2", "x")
    remembered.remember_up("5", "x")
    assert [remembered.up_of(str(k)) for k in range(6)] == ["", "", "x", "", "z", "x"]


def test_the_view_from_the_source_is_from_outside(hare):
    s = hare
    vertex = 3000
    parts(s.window).typed_source.choose(vertex)
    s.until(lambda: s.session.is_complete)
    press(s, "7")
    view, camera = s.panels[0].view, s.document.camera
    assert isinstance(camera, Camera)
    assert view.sees(s.session.mesh().surface.vertices[vertex])
    # Another source is no reason to look from elsewhere.
    parts(s.window).typed_source.choose(4000)
    s.until(lambda: s.session.is_complete)
    assert s.document.camera == camera


def test_a_document_that_is_seen_from_its_source_follows_it(hare):
    s = hare
    s.session.show(replace(s.document, camera="source"))
    before = s.window.grid.camera_controller.seen
    parts(s.window).typed_source.choose(3000)
    s.until(lambda: s.session.is_complete)
    assert s.document.camera == "source"
    assert s.window.grid.camera_controller.seen != before
    assert s.panels[0].view.sees(s.session.mesh().surface.vertices[3000])


# ---------------------------------------------------------------------- no perspective
def test_without_perspective_clicks_zooms_and_shifts_are_where_they_are_seen(hare):
    s = hare
    press(s, "o")
    assert s.document.parallel_projection
    view, surface = s.panels[0].view, s.session.mesh().surface
    s.settle(0.2)
    largest = np.setdiff1d(np.flatnonzero(surface.component_of_vertex == 0), surface.boundary_edges)
    target = next(int(k) for k in largest[::37] if view.sees(surface.vertices[k]))
    view.centre(surface.vertices[target])
    for _ in range(12):
        # As near as this a camera in perspective would have gone through it.
        view.zoom(1.5)
        s.settle(0.02)
        place = s.point_of(s.panels[0], target)
        hit = view.pick(place)
        assert hit is not None
        assert np.linalg.norm(hit.position - surface.vertices[target]) < 3 * surface.mean_edge_length
    assert view.shot().std() > 1
    at = view.place_of(surface.vertices[target])
    view.zoom(0.1, QtCore.QPoint(10, 10))
    view.zoom(10.0, QtCore.QPoint(10, 10))
    back = view.place_of(surface.vertices[target])
    assert np.allclose([back.x(), back.y()], [at.x(), at.y()], atol=1)
    view.shift_by(1, 0)
    moved = view.place_of(surface.vertices[target])
    assert np.isclose(moved.x() - back.x(), 0.05 * view.height(), atol=1)
    camera = s.window.grid.camera_controller.seen
    s.window.grid.camera_controller.set_view(camera)
    again = view.place_of(surface.vertices[target])
    assert np.allclose([again.x(), again.y()], [moved.x(), moved.y()], atol=0.5)
    press(s, "o")
    assert not s.document.parallel_projection


def test_insets_are_seen_without_perspective_too(hare):
    from app.document.document import Inset

    s = hare
    press(s, "o")
    before = s.pictures()[0]
    s.session.show(replace(s.document, insets=(Inset(s.source, 4.0, "bottom right"),)))
    s.settle(0.2)
    corner = np.s_[-s.panels[0].view.height() // 4 : -12, -s.panels[0].view.height() // 4 : -12]
    assert (s.pictures()[0][corner] != before[corner]).any()


# ---------------------------------------------------------------------- turning
def test_a_drag_on_the_turntable_keeps_what_is_up_upright(hare):
    from qtpy.QtCore import QPoint

    s, view = hare, hare.panels[0].view
    s.window.move(20, 40)
    s.settle(0.3)
    s.window.actions_by_word["turntable"].trigger()
    assert s.window.context.preferences.turntable

    def drag(dx, dy):
        start = view.mapToGlobal(QPoint(view.width() // 2, 30))
        words = ["mousemove", start.x(), start.y(), "mousedown", "1"]
        for k in range(1, 9):
            words += ["mousemove", start.x() + dx * k // 8, start.y() + dy * k // 8, "sleep", "0.02"]
        subprocess.run(["xdotool", *map(str, words), "mouseup", "1"], check=True)
        s.settle(0.3)

    before = frame(s.window.grid.camera_controller.seen)
    drag(120, 40)
    turned = frame(s.window.grid.camera_controller.seen)
    assert not np.allclose(before, turned, atol=0.1)
    assert abs(turned[:, 0] @ axis_of("z")) < 1e-6
    drag(0, 400)
    drag(0, 400)
    steep = frame(s.window.grid.camera_controller.seen)
    assert np.isclose(np.degrees(np.arcsin(steep[:, 2] @ axis_of("z"))), 89, atol=0.01)
    assert steep[:, 1] @ axis_of("z") > 0
    s.window.actions_by_word["turntable"].trigger()
    drag(90, -200)
    assert abs(frame(s.window.grid.camera_controller.seen)[:, 0] @ axis_of("z")) > 1e-3


def test_a_turntable_starts_from_the_poles_without_a_jump(hare):
    s, view = hare, hare.panels[0].view
    s.window.actions_by_word["turntable"].trigger()
    for name, sign in (("top", 1), ("bottom", -1)):
        parts(s.window).views.reset(name)
        before = frame(s.window.grid.camera_controller.seen)
        view.turn_by(1, 0)
        level = frame(s.window.grid.camera_controller.seen)
        assert np.isclose(level[:, 2] @ axis_of("z"), sign)
        assert np.isclose(np.degrees(np.arccos(level[:, 1] @ before[:, 1])), 15, atol=0.1)
        parts(s.window).views.reset(name)
        view.turn_by(0, sign)
        tilted = frame(s.window.grid.camera_controller.seen)
        assert tilted[:, 1] @ before[:, 1] > 0.9
        assert 0.9 < sign * tilted[:, 2] @ axis_of("z") < 0.99


# ---------------------------------------------------------------------- axes and text
def test_axes_stand_in_a_corner(hare):
    s, view = hare, hare.panels[0].view
    plain = view.grab().toImage()
    drawn = view.shot()
    press(s, "x")
    assert s.document.axes
    crossed = view.grab().toImage()
    height = crossed.height()
    changed = [
        (x, y) for x in range(0, 80) for y in range(height - 80, height) if plain.pixel(x, y) != crossed.pixel(x, y)
    ]
    assert 20 < len(changed) < 1500
    assert (view.shot() == drawn).all()  # the surface is not drawn again for it
    press(s, "x")
    assert view.grab().toImage() == plain


def test_a_camera_is_copied_and_pasted(hare):
    s, clipboard = hare, QtWidgets.QApplication.clipboard()
    s.panels[0].view.turn_by(1, 1)
    camera = s.document.camera
    s.window.actions_by_word["copy camera"].trigger()
    assert clipboard.text() == camera_text(camera)
    parts(s.window).views.reset("left")
    s.window.actions_by_word["paste camera"].trigger()
    assert np.allclose(s.document.camera.position, camera.position)
    assert np.allclose(s.window.grid.camera_controller.seen.position, camera.position)
    clipboard.setText("--cpos top")
    s.window.actions_by_word["paste camera"].trigger()
    assert s.document.camera == "top"
    clipboard.setText("no camera at all")
    s.window.actions_by_word["paste camera"].trigger()
    assert "'no camera at all' is not a camera" in s.refusals[-1]
    assert s.document.camera == "top"


def test_a_session_without_perspective_is_seen_as_its_figure(hare, tmp_path):
    """The window and a figure of its document put a vertex in the same share of their pictures."""
    s = hare
    press(s, "o")
    s.panels[0].view.turn_by(2, -1)
    s.settle(0.1)
    view, aspect = s.panels[0].view, s.window.grid.camera_controller.aspect
    surface = read_surface(mesh_path("hare"))
    seen = Projection(s.document.camera, aspect, surface.vertices, 0.05, is_parallel=True)
    for vertex in (10, 3000, 8000):
        x, y, _ = seen(surface.vertices[[vertex]])[0]
        place = view.place_of(surface.vertices[vertex])
        assert np.isclose(place.x(), (x + 1) / 2 * view.width(), atol=1)
        assert np.isclose(place.y(), (1 - y) / 2 * view.height(), atol=1)
