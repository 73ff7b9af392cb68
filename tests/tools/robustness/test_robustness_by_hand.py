"""Robustness in the window: the mesh changed by brush and files."""

import pytest

from bihdist_core import BiharmonicDistance, GeodesicDistance, Surface
from bihdist_core.applications.changes import Perturbation, count_of
from tests.qt.events import send_mouse
from tests.shapes import bumpy

pytest.importorskip("qtpy")
from qtpy import QtCore, QtTest, QtWidgets

from app.document.shared_parts.selections import Selections
from app.tools.robustness.perturbed_documents import perturb_mesh
from tests.qt.parts import parts
from tests.tools.robustness.changing import change_of, check, complete, dock_of, open_it, press, seen

LEFT, KEYS = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.Key
KINDS = (BiharmonicDistance, GeodesicDistance)


@pytest.fixture
def loaded(shared_screen):
    return open_it(shared_screen)


def move(view, place, keys=QtCore.Qt.KeyboardModifier.NoModifier):
    send_mouse(view, place, LEFT, LEFT, keys)


def stroke(s, panel, start, stop):
    view = s.panels[panel].view
    QtTest.QTest.mousePress(view, LEFT, pos=start)
    for k in range(1, 6):
        move(view, start + (stop - start) * k / 5)
    s.settle(0.1)
    QtTest.QTest.mouseRelease(view, LEFT, pos=stop)
    s.settle(0.1)
    complete(s)


def test_faces_are_cut_out_by_brush_and_come_back(loaded, monkeypatch):
    s, dock = loaded, dock_of(loaded)
    press(s, dock.cut.button)
    assert parts(s.window).brushing.cuts
    s.until(lambda: parts(s.window).brushing._brush is not None)
    _, middle = seen(s)
    stroke(s, 0, middle, middle + QtCore.QPoint(40, 0))
    cut = change_of(s).cut
    assert count_of(cut) > 2
    check(s, Perturbation(cut=cut))
    _, middle = seen(s, 3)
    stroke(s, 3, middle + QtCore.QPoint(0, 30), middle + QtCore.QPoint(30, 30))
    more = change_of(s).cut
    assert count_of(more) > count_of(cut)
    assert dock.cut.note.text() == f"{count_of(more)} faces"
    ctrl = QtCore.Qt.KeyboardModifier.ControlModifier
    monkeypatch.setattr(QtWidgets.QApplication, "keyboardModifiers", staticmethod(lambda: ctrl))
    stroke(s, 3, middle + QtCore.QPoint(0, 30), middle + QtCore.QPoint(30, 30))
    assert count_of(change_of(s).cut) < count_of(more)
    monkeypatch.undo()
    assert not s.document[Selections].selections
    s.window.actions_by_word["stop"].trigger()  # Esc
    assert not parts(s.window).brushing.cuts
    press(s, dock.cut.cross)
    assert change_of(s) is None


def test_a_weld_of_a_file_is_said_and_kept(loaded):
    s, dock = loaded, dock_of(loaded)
    s.session.apply(lambda document: perturb_mesh(document, Perturbation(weld=(3, 200))))
    complete(s)
    assert dock.hint.text().endswith("With weld 3:200.")
    dock.seed.setValue(4)
    dock.noise.box.setText("0.1")
    dock.noise.box.setModified(True)
    dock.noise.box.editingFinished.emit()
    complete(s)
    check(s, Perturbation(weld=(3, 200), noise=0.1, seed=4))


def test_another_pose_is_read_and_what_is_none_is_refused(loaded, mesh_file):
    s, dock = loaded, dock_of(loaded)
    ball = bumpy(400)
    pose = mesh_file(Surface(ball.vertices * (1, 1.4, 0.7), ball.faces), "pose.off")
    dock.take_pose(pose)
    complete(s)
    check(s, Perturbation(pose=pose))
    assert change_of(s).pose_sha256
    assert dock.pose.note.text() == "pose.off"
    dock.take_pose(mesh_file(bumpy(300), "other.off"))
    s.until(lambda: s.refusals)
    assert "300 vertices" in s.refusals[0]
    complete(s)
    assert change_of(s).pose == pose
    assert dock.settings.pose == pose
    press(s, dock.pose.cross)
    assert change_of(s) is None
