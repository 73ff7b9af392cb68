"""The window's behaviour with Qt's own events; `test_mouse` repeats the most important with a real pointer."""

import numpy as np
import pytest

from app.document.edits import move_source
from app.document.quantities import DistanceFrom
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy, fin, grid, two_pieces

pytest.importorskip("qtpy")


def test_shows_the_same_source_in_three_different_panels(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(800)), 5)
    assert [panel.title.text() for panel in s.panels] == ["biharmonic, exact", "geodesic, exact", "diffusion, t = 1"]
    assert all(panel.hint.text() for panel in s.panels)
    first, second, third = s.pictures()
    assert first.std() > 20
    for other in (second, third):
        assert (first != other).mean() > 0.01
    assert s.completions[-1] == 5


def test_a_click_selects_the_vertex_under_the_pointer(screen, mesh_file):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    s = screen()
    s.open(mesh_file(bumpy(800)))
    target = int(s.session.surface.vertices[:, 2].argmax())
    before = s.pictures()
    QTest.mouseClick(s.panels[1].interactor, Qt.MouseButton.LeftButton, pos=s.point_of(s.panels[1], target))
    s.until(lambda: s.session.is_complete and s.source == target)
    s.settle()
    assert s.window.source_box.value() == target
    assert all((a != b).mean() > 0.01 for a, b in zip(before, s.pictures(), strict=True))


def test_a_click_beside_the_surface_does_nothing(screen, mesh_file):
    from qtpy.QtCore import QPoint, Qt
    from qtpy.QtTest import QTest

    s = screen()
    s.open(mesh_file(bumpy(800)), 5)
    QTest.mouseClick(s.panels[0].interactor, Qt.MouseButton.LeftButton, pos=QPoint(3, 3))
    s.settle()
    assert s.source == 5


def test_pointing_shows_the_values_of_the_same_vertex_everywhere(screen, mesh_file):
    from qtpy.QtTest import QTest

    s = screen()
    s.open(mesh_file(bumpy(800)), 5)
    target = int(s.session.surface.vertices[:, 2].argmax())
    before = s.pictures()
    QTest.mouseMove(s.panels[2].interactor, s.point_of(s.panels[2], target))
    s.until(lambda: s.window._hovered == target)
    s.settle()
    assert f"vertex {target} " in s.window.status.pointer.text()
    for panel, answer in zip(s.panels, s.answers, strict=True):
        assert panel.value.text().startswith(f"{answer.field[target]:.5g} ")
        assert f"{answer.field[target] / answer.maximum:.1%}" in panel.value.text()
    assert all((a != b).any() for a, b in zip(before, s.pictures(), strict=True))


def test_what_is_not_connected_is_grey_and_said_to_be(screen, mesh_file):
    s = screen()
    surface = two_pieces()
    s.open(mesh_file(surface), 0)
    s.window._hover(62)
    assert {panel.value.text() for panel in s.panels} == {"not connected to the source"}
    # The small piece alone has no colour: its red, green and blue are nearly equal.
    for picture, panel in zip(s.pictures(), s.panels, strict=True):
        point = s.point_of(panel, 64)
        patch = picture[point.y() - 1 : point.y() + 4, point.x() - 1 : point.x() + 2].reshape(-1, 3).astype(int)
        assert np.ptp(patch, axis=1).min() <= 8
    assert "2 components" in s.window.status.message.text()
    assert "1 vertices without a face" in s.window.status.message.text()


def test_the_slider_changes_the_diffusion_time(screen, mesh_file):
    from app.qt.controls import step_of_value, value_of_step

    s = screen()
    s.open(mesh_file(bumpy(800)))
    controls = s.panels[2].controls
    time = controls.first.parameters["t"]
    assert time.isVisible()
    time.widget.setValue(step_of_value(time.parameter, 1 / 4))
    s.until(lambda: s.session.is_complete)
    assert s.document.panels[2].shows.spec == Spec.of("diffusion", t=1 / 4)
    assert time._label.text() == "t = 1/4"
    assert s.panels[2].title.text() == "diffusion, t = 0.25"
    assert value_of_step(time.parameter, time.widget.minimum()) == 1 / 15
    assert value_of_step(time.parameter, time.widget.maximum()) == 4


def test_the_menu_changes_the_geodesic_method_and_any_panel_its_distance(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(800)))
    controls = s.panels[1].controls
    method = controls.first.parameters["method"].widget
    method.setCurrentIndex(method.findData("dijkstra"))
    other = s.panels[0].controls.first
    other.distance.setCurrentIndex(other.distance.findData("truncated"))
    assert other.parameters["k"].isVisible()
    other.parameters["k"].widget.setValue(25)
    s.until(lambda: s.session.is_complete)
    assert s.panels[1].title.text() == "geodesic, Dijkstra along edges"
    assert s.panels[0].title.text() == "biharmonic, 25 eigenpairs"


def test_isolines_can_be_changed_and_left_out(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(800)))

    def white():
        return sum((picture > 250).all(axis=2).sum() for picture in s.pictures())

    counts = []
    for number in (0, 20, 60):
        s.window.isolines_box.setValue(number)
        s.settle()
        counts.append(white())
    assert counts[0] < counts[1] < counts[2]


def test_a_bad_file_is_refused_and_nothing_changes(screen, mesh_file, tmp_path):
    s = screen()
    s.open(mesh_file(bumpy(800)), 5)
    before = s.pictures()
    bad = tmp_path / "bad.off"
    bad.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
    s.window.open(str(bad))
    s.until(lambda: s.refusals)
    assert "bad.off" in s.refusals[0]
    assert "7" in s.refusals[0]
    s.settle()
    assert all(np.array_equal(a, b) for a, b in zip(before, s.pictures(), strict=True))


def test_a_typed_vertex_that_cannot_be_a_source_is_refused(screen, mesh_file):
    s = screen()
    s.open(mesh_file(two_pieces()), 3)
    s.window.source_box.setValue(60)
    s.until(lambda: s.refusals)
    assert "vertex 60 belongs to no face" in s.refusals[0]
    assert s.window.source_box.value() == 3


def test_a_typed_vertex_id_is_taken_as_it_was_typed_and_the_keys_go_back_to_the_panels(screen, mesh_file):
    from qtpy.QtTest import QTest

    s = screen()
    s.open(mesh_file(bumpy(800)), 3)
    box, panel = s.window.source_box, s.panels[0].interactor
    s.until(lambda: s.window.focusWidget() is panel)
    for typed, source in (("99999", 3), ("42", 42)):
        box.setFocus()
        box.selectAll()
        QTest.keyClicks(box, typed + "\r")
        s.settle()
        assert s.source == box.value() == source
        assert s.window.focusWidget() is panel
    assert len(s.refusals) == 1
    assert "no vertex 99999" in s.refusals[0]


def test_a_dropped_file_is_opened(screen, mesh_file):
    from qtpy import QtCore, QtGui

    s = screen()
    data = QtCore.QMimeData()
    data.setUrls([QtCore.QUrl.fromLocalFile(mesh_file(grid(6, 6), "dropped.off"))])
    drop = QtGui.QDropEvent(
        QtCore.QPointF(10, 10),
        QtCore.Qt.DropAction.CopyAction,
        data,
        QtCore.Qt.MouseButton.LeftButton,
        QtCore.Qt.KeyboardModifier.NoModifier,
    )
    s.window.dropEvent(drop)
    s.until(lambda: s.session.is_complete)
    assert s.window.windowTitle() == "dropped.off - Biharmonic distance"


def test_views_turn_all_panels_together(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(800)))
    assert len({id(panel.renderer.GetActiveCamera()) for panel in s.panels}) == 1
    before = s.pictures()
    s.window.reset_view("back")
    s.settle()
    assert all((a != b).mean() > 0.01 for a, b in zip(before, s.pictures(), strict=True))


@pytest.mark.parametrize("size", [(1200, 1000), (1100, 380)])
def test_what_was_seen_stays_in_view_when_the_window_changes_its_shape(screen, mesh_file, size):
    s = screen()
    s.open(mesh_file(bumpy(800)))
    camera = s.window.grid.camera
    before = s.window.size(), camera.GetViewAngle(), camera.GetPosition()
    s.window.resize(*size)
    s.settle()
    for panel in s.panels:
        seen = [s.point_of(panel, vertex) for vertex in range(0, 800, 7)]
        assert all(panel.interactor.rect().contains(point) for point in seen)
    s.window.resize(before[0])
    s.settle()
    assert (s.window.size(), camera.GetPosition()) == (before[0], before[2])
    assert camera.GetViewAngle() == pytest.approx(before[1], rel=1e-9)


def test_vtk_keys_do_nothing(screen, mesh_file):
    from qtpy.QtTest import QTest

    s = screen()
    s.open(mesh_file(bumpy(800)))
    before = s.pictures()
    for key in "qewspj":
        QTest.keyClick(s.panels[0].interactor, key)
    s.settle()
    assert s.window.isVisible()
    assert all(np.array_equal(a, b) for a, b in zip(before, s.pictures(), strict=True))


def test_the_screenshot_holds_the_panels(screen, mesh_file, tmp_path):
    from PIL import Image

    s = screen()
    s.open(mesh_file(bumpy(800)))
    path = tmp_path / "window.png"
    s.window.save_screenshot(str(path))
    picture = np.asarray(Image.open(path).convert("RGB"))
    assert picture.shape[:2] == (s.window.height(), s.window.width())
    third = picture.shape[1] // 3
    assert all(np.ptp(picture[:, k * third : (k + 1) * third], axis=2).max() > 100 for k in range(3))


def test_a_failed_screenshot_leaves_the_old_file(screen, mesh_file, tmp_path):
    from bihdist_core import OutputError

    s = screen()
    s.open(mesh_file(bumpy(800)))
    with pytest.raises(OutputError, match="no folder"):
        s.window.save_screenshot(str(tmp_path / "missing" / "x.png"))
    with pytest.raises(OutputError, match=r"\.jpg"):
        s.window.save_screenshot(str(tmp_path / "x.jpg"))


def test_progress_and_cancel_are_shown_while_something_is_computed(screen, mesh_file):
    s = screen((Spec.of("diffusion", t=1 / 15),))
    s.window.open(mesh_file(bumpy(12000)))
    s.until(lambda: s.window.status.progress.isVisible() and s.window.status.doing.text())
    assert s.window.status.cancel.isVisible()
    s.window.status.cancel.click()
    s.until(lambda: not s.window.status.progress.isVisible(), seconds=5)
    assert s.panels[0].hint.text() == "stopped; click a point to ask again"


def test_many_reports_of_progress_are_one_change_of_the_window_and_the_end_shows_at_once(screen):
    s = screen()
    window = s.window
    for percent in range(50):
        window.session._answering.progress[7] = (percent / 100, "solving")
        window.progress_changed()
    assert window.status.doing.text() == ""
    s.until(lambda: window.status.doing.text() == "solving 49%")
    assert window.status.progress.value() == 490
    window.session._answering.progress.clear()
    window.progress_changed()
    assert window.status.doing.text() == ""
    assert not window.status.progress.isVisible()


def test_quick_answers_change_no_panel_s_words(screen, mesh_file, monkeypatch):
    s = screen()
    s.open(mesh_file(bumpy(800)))
    notes = []
    for panel in s.panels:
        monkeypatch.setattr(panel, "show_note", notes.append)
    s.session.show(move_source(s.document, 0, 42))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert set(notes) == {""}


def test_the_status_bar_tells_how_far_everything_is_and_a_panel_what_it_waits_for(screen, mesh_file):
    s = screen()
    window = s.window
    s.open(mesh_file(bumpy(800)))
    del window.session.shown[2]
    window.session._answering.progress.update({0: (0.2, "Factoring"), 1: (0.4, "eigenpairs: solving")})
    window.progress_changed()
    s.until(window.status.doing.text)
    assert window.status.doing.text() == "Factoring 20%   ·   eigenpairs: solving 40%"
    assert window.status.progress.value() == 300
    assert [panel.hint.text() for panel in s.panels] == ["Factoring …", "eigenpairs …", "waiting …"]


def test_a_panel_s_words_do_not_change_the_size_of_its_picture(screen, mesh_file):
    s = screen()
    s.settle()
    before = [panel.interactor.size() for panel in s.panels]
    s.open(mesh_file(bumpy(800)))
    s.panels[0].show_value(5)
    s.settle()
    assert [panel.interactor.size() for panel in s.panels] == before
    assert all(panel.title.text() and panel.hint.text() for panel in s.panels)


def test_closing_while_computing_ends_the_threads(screen, mesh_file):
    import threading

    s = screen()
    s.window.open(mesh_file(bumpy(12000)))
    s.until(lambda: s.session.progress)
    s.window.close()
    assert not [t for t in threading.enumerate() if t.name.startswith(("panel", "load")) and t.is_alive()]


def test_samples_are_listed_with_their_pictures_and_open(screen):
    from app.samples import sample_names

    s = screen()
    file = s.window.menuBar().actions()[0].menu()
    samples = next(action.menu() for action in file.actions() if action.menu())
    actions = {action.text(): action for action in samples.actions()}
    assert list(actions) == [name.replace("_", " ") for name in sample_names()]
    assert not any(action.icon().isNull() for action in actions.values())
    actions["genus3"].trigger()
    s.until(lambda: s.session.is_complete)
    assert s.window.windowTitle().startswith("genus3.ply")


def test_a_panel_that_fails_says_so_in_its_own_place(screen, mesh_file):
    s = screen((Spec.of("geodesic", method="exact"), Spec.of("biharmonic")))
    s.open(mesh_file(fin()), source=0)
    failed, answered = s.panels
    assert "is not manifold" in " ".join(failed.scene._failure.GetInput().split())
    assert not failed.scene._bar.GetVisibility()
    assert answered.scene._failure.GetInput() == ""
    assert failed.interactor.height() == answered.interactor.height()
    lines = failed.scene._failure.GetInput().splitlines()
    s.window.resize(700, 500)
    s.settle()
    assert len(failed.scene._failure.GetInput().splitlines()) > len(lines)
    failed.controls.changed.emit(DistanceFrom(Spec.of("geodesic", method="heat")))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert failed.scene._failure.GetInput() == ""
    assert failed.scene._bar.GetVisibility()


def test_long_words_do_not_make_the_window_wider(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(200)))
    width = s.window.width()
    s.window.say("repaired " * 200)
    s.settle()
    assert s.window.width() == width
