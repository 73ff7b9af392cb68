"""The window's behaviour with Qt's own events; `test_mouse` repeats the most important with a real pointer."""

import ctypes
import os
import subprocess
import sys
from collections import deque
from string import ascii_lowercase

import numpy as np
import pytest
from qtpy import QtCore, QtGui
from qtpy.QtTest import QTest

from app.document.edits import move_source
from app.document.quantities import DistanceFrom
from app.drawing.numbers import coordinates, number, share
from app.drawing.painters.qt import number_width
from app.qt.acts import ALL
from app.qt.look.look import LOOK
from app.qt.main_window import DISCARDED
from bihdist_core import Surface
from bihdist_core.distances.distance_types import Spec
from tests.programs import ROOT, run_python
from tests.qt.painting import pixels_of
from tests.qt.parts import parts
from tests.shapes import bumpy, grid, two_pieces

LEFT = QtCore.Qt.MouseButton.LeftButton


def highest(screen):
    """The vertex nearest to the eye."""
    return int(screen.session.mesh().surface.vertices[:, 2].argmax())


def seen(screen):
    """What the views show, (height, width, 4) each, with what lies over the surface."""
    return [pixels_of(panel.view.grab().toImage()) for panel in screen.panels]


def differ(before, after, share=0.0):
    """Whether more than a share of the pixels of each picture are others."""
    return all((a != b).mean() > share for a, b in zip(before, after, strict=True))


def are_equal(before, after):
    return all(np.array_equal(a, b) for a, b in zip(before, after, strict=True))


def entry(menu, word):
    """An entry of a menu as it opens."""
    menu.aboutToShow.emit()
    return next(action for action in menu.actions() if action.text() == word)


# ---------------------------------------------------------------------- what is shown
def test_shows_the_same_source_in_three_different_panels(shared_screen):
    s = shared_screen(bumpy(800))
    labels = [panel.answer.label for panel in s.panels]
    assert labels == ["biharmonic, exact", "geodesic, exact", "diffusion, t = 1"]
    assert [panel.head.name.text() for panel in s.panels] == ["Biharmonic", "Geodesic", "Diffusion"]
    for panel, label in zip(s.panels, labels, strict=True):
        assert label.lower() in panel.head.info.toolTip().lower()
        assert panel.head.shows.hint.lower() in panel.head.info.toolTip().lower()
    first, second, third = s.pictures()
    assert first.std() > 20
    assert differ([first, first], [second, third], 0.01)
    assert s.completions[-1] == 5


def test_what_is_not_connected_is_grey_and_said_to_be(screen, mesh_file):
    s = screen()
    s.open(mesh_file(two_pieces()), 0)
    s.window.grid.pointing.show(0, 62)
    assert all("not connected to the source" in panel.bar.accessibleDescription() for panel in s.panels)
    # The small piece alone has no colour: its red, green and blue are nearly equal.
    for picture, panel in zip(s.pictures(), s.panels, strict=True):
        ratio, point = panel.view.devicePixelRatioF(), s.point_of(panel, 64)
        x, y = round(point.x() * ratio), round(point.y() * ratio)
        patch = picture[y - 1 : y + 4, x - 1 : x + 2].reshape(-1, 3).astype(int)
        assert np.ptp(patch, axis=1).min() <= 8
    chip = s.window.status.notes
    assert chip.isVisible()
    assert chip.words == "2 notes"
    assert any("2 components" in sentence for sentence in chip.sentences)
    assert "1 vertex without a face" in chip.sentences


def test_isolines_can_be_changed_and_left_out(shared_screen):
    s = shared_screen(bumpy(800), source=None)

    def white():
        return sum((picture > 250).all(axis=2).sum() for picture in s.pictures())

    counts = []
    for word in ("None", "About 20"):
        entry(s.window.menus.isolines, word).trigger()
        counts.append(white())
    parts(s.window).isolines.steps(60)
    assert counts[0] < counts[1] < white()
    assert s.window.tool_bar.buttons["isolines"].accessibleDescription() == "60"


def test_a_panel_that_fails_says_so_in_its_own_place(screen, mesh_file, no_exact_geodesics):
    s = screen((Spec.of("geodesic", method="exact"), Spec.of("biharmonic")))
    s.open(mesh_file(bumpy(300)), source=0)
    failed, answered = s.panels
    assert "no room for windows" in failed.answer.failure
    assert "no values" in failed.bar.accessibleDescription()
    assert "no values" not in answered.bar.accessibleDescription()
    assert failed.view.size() == answered.view.size()

    def words():
        """Where they stand: rows and columns of pixels."""
        before = seen(s)[0]
        failed.view.over.say("")
        found = np.nonzero((before != seen(s)[0]).any(axis=2))
        failed.view.over.say(failed.answer.failure)
        return found

    high = np.ptp(words()[0])
    s.window.resize(700, 500)
    s.settle()
    rows, columns = words()
    assert np.ptp(rows) > high, "on more lines"
    assert columns.min() > 0
    assert columns.max() < failed.view.pixels[0] - 1
    failed.head.changed.emit(DistanceFrom(Spec.of("geodesic", method="heat")))
    s.until(lambda: s.session.is_complete)
    assert words()[0].size == 0
    assert "no values" not in failed.bar.accessibleDescription()


# ---------------------------------------------------------------------- the source and the pointer
def test_a_click_selects_the_vertex_under_the_pointer(shared_screen):
    s = shared_screen(bumpy(800), source=None)
    target, before = highest(s), s.pictures()
    QTest.mouseClick(s.panels[1].view, LEFT, pos=s.point_of(s.panels[1], target))
    s.until(lambda: s.session.is_complete and s.source == target)
    assert parts(s.window).typed_source.box.value() == target
    assert parts(s.window).typed_source.box.text() == str(target)
    assert differ(before, s.pictures(), 0.01)


def test_far_from_the_origin_a_click_finds_the_vertex_and_its_position_is_whole(shared_screen):
    near = bumpy(800)
    far = Surface(0.1 * near.vertices + np.array([452000.123, 5411000.456, 0.0]), near.faces, name="far")
    s = shared_screen(far)
    target = highest(s)
    QTest.mouseMove(s.panels[2].view, s.point_of(s.panels[2], target))
    s.until(lambda: parts(s.window).gestures.hovered == target)
    s.settle()
    place = s.window.status.place
    x, y, _ = place.text.split("  ")
    edge = far.mean_edge_length
    assert [float(text.replace(",", "")) for text in (x, y)] == pytest.approx(far.vertices[target, :2], abs=edge / 20)
    assert place.fitting == place.text, "nothing is cut off"
    QTest.mouseClick(s.panels[2].view, LEFT, pos=s.point_of(s.panels[2], target))
    s.until(lambda: s.source == target)
    QTest.mouseMove(s.panels[2].view, QtCore.QPoint(3, 3))


def test_a_click_beside_the_surface_does_nothing(shared_screen):
    s = shared_screen(bumpy(800))
    QTest.mouseClick(s.panels[0].view, LEFT, pos=QtCore.QPoint(3, 3))
    s.settle()
    assert s.source == 5


def test_pointing_shows_the_values_of_the_same_vertex_everywhere_and_draws_no_surface_again(shared_screen):
    s = shared_screen(bumpy(800))
    target, before, drawn = highest(s), seen(s), s.window.grid.offscreen.pictures
    QTest.mouseMove(s.panels[2].view, s.point_of(s.panels[2], target))
    s.until(lambda: parts(s.window).gestures.hovered == target)
    s.settle()
    assert s.window.status.vertex.text == f"vertex {target}"
    surface = s.session.mesh().surface
    assert s.window.status.place.text == coordinates(surface.vertices[target], surface.mean_edge_length)
    for panel, answer in zip(s.panels, s.answers, strict=True):
        value = answer.field[target]
        assert f": {number(value)} " in panel.bar.accessibleDescription()
        assert f"{share(value / answer.maximum)} of {number(answer.maximum)}" in panel.bar.accessibleDescription()
    assert differ(before, seen(s)), "a ring in each"
    QTest.mouseMove(s.panels[2].view, QtCore.QPoint(3, 3))
    s.settle()
    assert s.window.status.vertex.text == s.window.status.place.text == ""
    assert are_equal(before, seen(s))
    assert s.window.grid.offscreen.pictures == drawn


def test_a_typed_vertex_that_cannot_be_a_source_is_refused(screen, mesh_file):
    s = screen()
    s.open(mesh_file(two_pieces()), 3)
    box = parts(s.window).typed_source.box
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, "60\r")
    assert "vertex 60 belongs to no face" in s.refusals[0]
    assert box.wrong.isVisible()
    assert box.wrong.text() == s.refusals[0]
    assert (s.source, box.value()) == (3, 3)


def test_a_typed_vertex_id_is_taken_as_it_was_typed_and_the_keys_go_back_to_the_panels(shared_screen):
    s = shared_screen(bumpy(800), source=3)
    box, view = parts(s.window).typed_source.box, s.panels[0].view
    s.until(lambda: s.window.focusWidget() is view)
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, "99999\r")
    assert box.wrong.isVisible()
    assert "No vertex 99999 here: 0 to 799" in box.wrong.text()
    assert (s.source, s.window.focusWidget()) == (3, box), "to be typed again"
    QTest.keyClicks(box, "42")
    assert not box.wrong.isVisible()
    QTest.keyClicks(box, "\r")
    assert s.source == box.value() == 42
    assert s.window.focusWidget() is view


# ---------------------------------------------------------------------- what is chosen in a head
def test_the_slider_changes_the_diffusion_time(shared_screen):
    from app.qt.panels.number_box import step_of_value

    s = shared_screen(bumpy(800), source=None)
    panel = s.panels[2]
    (time,) = panel.head.controls
    assert time.slider.isVisible()
    time.slider.setValue(step_of_value(time.parameter, 1 / 4))
    s.until(lambda: s.session.is_complete)
    assert s.document.panels[2].shows.spec == Spec.of("diffusion", t=1 / 4)
    assert time.button.text() == "1/4"
    assert panel.answer.label == "diffusion, t = 0.25"


def test_the_menu_changes_the_geodesic_method_and_any_panel_its_distance(shared_screen):
    s = shared_screen(bumpy(800), source=None)
    (method,) = s.panels[1].head.controls
    entry(method.menu(), "Dijkstra").trigger()
    head = s.panels[0].head
    entry(head.name.menu(), "Biharmonic, truncated").trigger()
    (k,) = head.controls
    assert k.isVisible()
    k.open_under(k)
    k.pop_up.box.setText("25")
    QTest.keyClick(k.pop_up.box, QtCore.Qt.Key.Key_Return)
    s.until(lambda: s.session.is_complete)
    assert s.panels[1].answer.label == "geodesic, Dijkstra along edges"
    assert s.panels[0].answer.label == "biharmonic, 25 eigenpairs"


# ---------------------------------------------------------------------- files
def test_a_bad_file_is_refused_and_nothing_changes(shared_screen, tmp_path):
    s = shared_screen(bumpy(800))
    before = s.pictures()
    bad = tmp_path / "bad.off"
    bad.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
    s.window.context.open(str(bad))
    s.until(lambda: s.refusals)
    assert "bad.off" in s.refusals[0]
    assert "7" in s.refusals[0]
    s.settle()
    assert are_equal(before, s.pictures())


def test_a_dropped_file_is_opened(screen, mesh_file):
    s = screen()
    data = QtCore.QMimeData()
    data.setUrls([QtCore.QUrl.fromLocalFile(mesh_file(grid(6, 6), "dropped.off"))])
    drop = QtGui.QDropEvent(
        QtCore.QPointF(10, 10),
        QtCore.Qt.DropAction.CopyAction,
        data,
        LEFT,
        QtCore.Qt.KeyboardModifier.NoModifier,
    )
    parts(s.window).files.eventFilter(s.window, drop)
    s.until(lambda: s.session.is_complete)
    s.until(lambda: s.window.windowTitle() == "dropped.off[*] - Biharmonic distance")


def test_samples_are_listed_with_their_pictures_and_open(screen):
    from app.samples import sample_names, sample_title

    s = screen()
    file = s.window.menuBar().actions()[0].menu()
    samples = next(action.menu() for action in file.actions() if action.text() == "Sam&ples")
    actions = {action.text(): action for action in samples.actions()}
    assert list(actions) == [sample_title(name) for name in sample_names()]
    assert not any(action.icon().isNull() for action in actions.values())
    actions["Genus 3"].trigger()
    s.until(lambda: s.session.is_complete)
    s.until(lambda: s.window.windowTitle().startswith("genus3.ply"))


def test_the_screenshot_holds_the_panels(shared_screen, tmp_path):
    from PIL import Image

    s = shared_screen(bumpy(800), source=None)
    path = tmp_path / "window.png"
    parts(s.window).files.save_screenshot(str(path))
    picture = np.asarray(Image.open(path).convert("RGB"))
    ratio = s.window.devicePixelRatioF()
    assert picture.shape[:2] == (round(s.window.height() * ratio), round(s.window.width() * ratio))
    third = picture.shape[1] // 3
    assert all(np.ptp(picture[:, k * third : (k + 1) * third], axis=2).max() > 100 for k in range(3))


def test_a_failed_screenshot_leaves_the_old_file(shared_screen, tmp_path):
    from bihdist_core import OutputError

    s = shared_screen(bumpy(800), source=None)
    with pytest.raises(OutputError, match="no folder"):
        parts(s.window).files.save_screenshot(str(tmp_path / "missing" / "x.png"))
    with pytest.raises(OutputError, match=r"\.jpg"):
        parts(s.window).files.save_screenshot(str(tmp_path / "x.jpg"))


# ---------------------------------------------------------------------- the camera and the window's shape
def test_views_turn_all_panels_together(shared_screen):
    s = shared_screen(bumpy(800), source=None)
    assert len({id(panel.view.camera) for panel in s.panels}) == 1
    before = s.pictures()
    parts(s.window).views.reset("back")
    assert differ(before, s.pictures(), 0.01)


@pytest.mark.parametrize("size", [(1200, 960), (1100, 380)])
def test_what_was_seen_stays_in_view_when_the_window_changes_its_shape(shared_screen, size):
    s = shared_screen(bumpy(800), source=None)
    camera = s.window.grid.camera_controller.camera
    before = s.window.size(), camera.GetViewAngle(), camera.GetPosition()
    s.window.resize(*size)
    s.settle()
    for panel in s.panels:
        places = [s.point_of(panel, vertex) for vertex in range(0, 800, 7)]
        assert all(panel.view.rect().contains(place) for place in places)
    s.window.resize(before[0])
    s.settle()
    assert (s.window.size(), camera.GetPosition()) == (before[0], before[2])
    assert camera.GetViewAngle() == pytest.approx(before[1], rel=1e-9)


def test_letters_without_a_meaning_do_nothing(shared_screen):
    s = shared_screen(bumpy(800), source=None)
    s.activate()
    s.settle()
    before, done = seen(s), []
    for action in s.window.actions():
        action.triggered.connect(lambda *_, action=action: done.append(action.text()))
    free = set(ascii_lowercase) - {key.lower() for act in ALL for key in act.keys}
    assert free
    for key in sorted(free):
        QTest.keyClick(s.panels[0].view, key)
    s.settle()
    assert s.window.isVisible()
    assert done == []
    assert are_equal(before, seen(s))
    QTest.keyClick(s.panels[0].view, "r")
    assert done == ["Hom&e"]


def test_long_words_do_not_make_the_window_wider(shared_screen):
    s = shared_screen(bumpy(200), source=None)
    width = s.window.width()
    s.window.context.tell("repaired " * 200)
    s.settle()
    assert s.window.width() == width
    assert s.window.status.message.toolTip() == s.window.status.message.text


def test_a_single_one_of_something_is_not_many(screen, tmp_path):
    (tmp_path / "one.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    s = screen()
    s.open(str(tmp_path / "one.off"))
    assert (s.window.status._vertices, s.window.status._faces) == ("3 vertices", "1 face")
    rate = parts(s.window).dragging.rate
    rate._begun, rate._shown = 0.0, deque([10.0])
    assert rate._words(10.0) == "Live: 1 field a second"


def test_what_is_said_of_a_drag_fits_a_small_window_and_what_does_not_ends_in_dots(screen, mesh_file):
    s = screen()
    s.window.resize(900, 600)
    s.open(mesh_file(bumpy(200)))
    message = s.window.status.message
    s.window.status.show_rate("Live: 12 fields a second; geodesic, heat method")
    s.settle()
    assert (message.fitting, message.toolTip()) == (message.text, "")
    for text in ("1" * 400, "wide words " * 40):
        s.window.context.tell(text)
        s.settle()
        assert message.fitting.endswith("…")
        assert number_width(LOOK.font(12.5), message.fitting) <= message.width()
        assert message.toolTip() == text


def test_a_window_that_is_closed_takes_no_other_colours(screen, mesh_file, monkeypatch):
    s = screen()
    s.open(mesh_file(bumpy(200)))
    s.window.close()
    failures, before = [], LOOK.choice
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: failures.append(error))
    for word in ("dark", "light", before):
        LOOK.choose(word)
    assert failures == []


CLOSED_AND_FORGOTTEN = """
import gc
from app.qt.application import application
from app.qt.main_window import MainWindow
app = application()
for _ in range(2):
    window = MainWindow()
    window.context.quiet, window.context.remembers = True, False
    window.show()
    window.build_panels()
    app.processEvents()
    window.close()
    del window
    gc.collect()
"""


def test_a_window_that_is_closed_and_forgotten_does_not_end_the_process(application):
    done = run_python("-c", CLOSED_AND_FORGOTTEN)
    assert done.returncode == 0, done.stderr


def test_the_user_is_told_once_when_the_oldest_steps_go(screen, mesh_file, monkeypatch):
    monkeypatch.setattr("app.document.history.LONGEST", 2)
    s, told = screen([Spec.of("biharmonic")]), []
    s.open(mesh_file(bumpy(60)))
    monkeypatch.setattr(s.window.context, "tell", lambda text, holds=None: told.append(text))
    for vertex in range(10, 12):
        s.session.show(move_source(s.document, 0, vertex))
    assert told == []
    for vertex in range(12, 15):
        s.session.show(move_source(s.document, 0, vertex))
    assert told == [DISCARDED]


MAPPED = """
import ctypes

from app.qt.start import set_up_allocation


class Info(ctypes.Structure):
    _fields_ = [(f"number_{k}", ctypes.c_size_t) for k in range(10)]


library = ctypes.CDLL(None)
library.mallinfo2.restype = Info
library.malloc.restype = ctypes.c_void_p
library.malloc.argtypes = (ctypes.c_size_t,)
library.free.argtypes = (ctypes.c_void_p,)
set_up_allocation()
library.free(library.malloc(16 << 20))
before = library.mallinfo2().number_3
library.malloc(2 << 20)
print(library.mallinfo2().number_3 - before)
"""


@pytest.mark.skipif(
    sys.platform != "linux" or not hasattr(ctypes.CDLL(None), "mallinfo2"), reason="the C library is another"
)
def test_large_blocks_are_mapped_by_themselves_however_large_those_before_were():
    own = {key: value for key, value in os.environ.items() if not key.startswith("MALLOC_")}
    done = subprocess.run([sys.executable, "-c", MAPPED], env=own, cwd=ROOT, capture_output=True, text=True)
    assert done.stdout == "1\n", done.stderr
