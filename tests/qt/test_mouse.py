"""A real pointer moved by xdotool over the real program."""

import json
import re
import shutil
import subprocess
import time

import numpy as np
import pytest

from app.document.edits import move_source
from app.version import version
from bihdist_core.distances import distance_types
from tests.programs import ROOT, run_app
from tests.qt.parts import parts
from tests.shapes import bumpy

pytestmark = pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed")


def run(*words):
    return subprocess.run(["xdotool", *map(str, words)], check=True, capture_output=True, text=True).stdout


def drag(x, y, by, held=lambda: None):
    """By so many pixels to the right and eight down; held: what happens before the button is let go of."""
    run("mousemove", x, y)
    run("mousedown", 1)
    for step in range(1, 9):
        run("mousemove", x + by * step // 8, y + step)
        time.sleep(0.02)
    held()
    run("mouseup", 1)


def corner(panel):
    from qtpy.QtCore import QPoint

    point = panel.view.mapToGlobal(QPoint(0, 0))
    return point.x(), point.y()


@pytest.fixture
def loaded(shared_screen):
    s = shared_screen(bumpy(800))
    s.window.move(20, 40)
    s.settle(0.5)
    return s


def test_click_selects_and_drag_only_rotates_all_panels(loaded):
    s, panel = loaded, loaded.panels[0]
    x0, y0 = corner(panel)
    target = int(s.session.mesh().surface.vertices[:, 2].argmax())
    point = s.point_of(panel, target)
    run("mousemove", x0 + point.x(), y0 + point.y())
    run("click", 1)
    s.until(lambda: s.session.is_complete and s.source == target)
    s.settle()

    for panel in s.panels:
        before, camera = s.pictures(), np.array(panel.view.camera.GetPosition())
        x0, y0 = corner(panel)
        middle = x0 + panel.view.width() // 2, y0 + panel.view.height() // 2
        drag(*middle, 90)
        s.settle(0.5)
        assert s.source == target
        assert np.linalg.norm(np.array(panel.view.camera.GetPosition()) - camera) > 0.1
        assert all((a != b).mean() > 0.01 for a, b in zip(before, s.pictures(), strict=True))


def test_dragging_the_mark_moves_the_source_and_not_the_view(loaded, monkeypatch):
    monkeypatch.setattr(distance_types, "FRAME_VERTICES", 0)  # as on a large mesh
    s, panel = loaded, loaded.panels[0]
    front = int(s.session.mesh().surface.vertices[:, 2].argmax())
    s.session.show(move_source(s.document, 0, front))
    s.until(lambda: s.session.is_complete)
    s.settle()
    x0, y0 = corner(panel)
    point, camera = s.point_of(panel, front), panel.view.camera.GetPosition()
    labels, heads, tell = [], {}, s.window.answer_changed

    def note(id):
        labels.append(s.session.shown[1].answer.label)
        tell(id)
        heads[s.panels[1].answer.label] = s.panels[1].head.controls[0].text()

    s.window.answer_changed = note
    drag(x0 + point.x(), y0 + point.y(), 70, lambda: s.until(lambda: "geodesic, approximate" in labels))
    s.until(lambda: s.session.is_complete and s.source != front)
    assert panel.view.camera.GetPosition() == camera
    there = s.point_of(panel, s.source)
    assert abs(there.x() - point.x() - 70) < 25
    assert abs(there.y() - point.y() - 8) < 25
    assert labels[-1] == "geodesic, exact"
    assert heads == {"geodesic, approximate": "auto: approximate", "geodesic, exact": "auto: exact"}
    s.session.undo()
    assert s.source == front


def test_the_mark_behind_the_surface_is_not_taken_hold_of(loaded):
    s, panel = loaded, loaded.panels[0]
    back = int(s.session.mesh().surface.vertices[:, 2].argmin())
    parts(s.window).views.reset("front")
    s.session.show(move_source(s.document, 0, back))
    s.until(lambda: s.session.is_complete)
    s.settle()
    x0, y0 = corner(panel)
    point, camera = s.point_of(panel, back), panel.view.camera.GetPosition()
    drag(x0 + point.x(), y0 + point.y(), 70)
    s.settle(0.5)
    assert s.source == back
    assert panel.view.camera.GetPosition() != camera


def test_a_hand_that_trembles_still_clicks(loaded):
    s, panel = loaded, loaded.panels[1]
    x0, y0 = corner(panel)
    target = int(s.session.mesh().surface.vertices[:, 2].argmax())
    point = s.point_of(panel, target)
    camera = panel.view.camera.GetPosition()
    run("mousemove", x0 + point.x(), y0 + point.y())
    run("mousedown", 1)
    run("mousemove_relative", 2, 1)
    run("mouseup", 1)
    s.until(lambda: s.session.is_complete and s.source == target)
    assert panel.view.camera.GetPosition() == camera


def test_the_wheel_zooms_all_panels(loaded):
    s = loaded
    x0, y0 = corner(s.panels[2])
    before, camera = s.pictures(), s.panels[2].view.camera
    distance = camera.GetDistance()
    run("mousemove", x0 + 150, y0 + 200)
    run("click", "--repeat", 3, "--delay", 50, 4)
    s.until(lambda: camera.GetDistance() < 0.8 * distance)
    s.settle(0.5)
    assert all((a != b).mean() > 0.01 for a, b in zip(before, s.pictures(), strict=True))


def test_view_saves_a_picture_of_the_finished_window_and_exits(mesh_file, tmp_path):
    from PIL import Image

    picture = tmp_path / "window.png"
    mesh = mesh_file(bumpy(800))
    done = run_app("view", mesh, "--sources", 12, "--screenshot", picture, "--json", "--quiet")
    assert done.returncode == 0, done.stderr
    said = json.loads(done.stdout)
    assert said == {
        "command": "view", "version": version(), "exit_status": 0, "notes": [],
        "meshes": [{"mesh": mesh}], "outputs": [str(picture)],
    }  # fmt: skip
    assert np.asarray(Image.open(picture).convert("RGB")).std() > 20


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["no-such-mesh.off", "--screenshot", "out.png"], r"no-such-mesh\.off"),
        (["figure", "--sources", "9999999", "--screenshot", "out.png"], "no vertex 9999999"),
        (["figure", "--screenshot", "missing-folder/out.png"], "missing-folder"),
    ],
)
def test_view_refuses_with_a_sentence(arguments, words):
    done = run_app("view", *arguments)
    assert done.returncode == 2
    assert re.search(words, done.stderr)
    assert "Traceback" not in done.stderr
    assert not (ROOT / "out.png").exists()
