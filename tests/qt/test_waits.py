"""What the window says while something is computed, and that it can be stopped."""

import re
import threading
import time
from dataclasses import replace
from math import nan
from random import Random

import pytest
from qtpy import QtCore, QtWidgets
from qtpy.QtTest import QTest

from app.document.edits import move_source
from app.document.quantities import DistanceFrom
from app.session.latest_request_worker import LatestRequestWorker
from app.session.loaded_mesh import open_mesh
from app.session.questions import DistanceQuestion
from bihdist_core.distances import distance_types, geodesic_solvers
from bihdist_core.distances.distance_types import Spec
from tests.qt.parts import parts
from tests.shapes import bumpy

LEFT = QtCore.Qt.MouseButton.LeftButton
ONE = (Spec.of("biharmonic"),)


@pytest.fixture
def gate(monkeypatch):
    """Answers wait until it is set, whatever the machine's speed, and can be stopped meanwhile."""
    gate, answer = threading.Event(), DistanceQuestion.answer

    def held(question, loaded, progress=None, at_once=None):
        while not gate.wait(0.01):
            if progress is not None:
                progress(0.5, "columns: solving")
        return answer(question, loaded, progress, at_once)

    monkeypatch.setattr(DistanceQuestion, "answer", held)
    yield gate
    gate.set()


def opened_menu(button):
    """The actions of a button's menu, as it opens."""
    button.menu().aboutToShow.emit()
    return button.menu().actions()


def pretend(screen, *progress):
    """Let the panels be at work, each at a share of something."""
    screen.session._answering.progress.update(enumerate(progress))
    screen.window.progress_changed()


def test_the_status_bar_says_how_long_fields_took(shared_screen):
    s = shared_screen()
    status = s.window.status
    assert re.fullmatch(r"3 fields in (\d+ ms|[\d.]+ s)", status.time.text)
    s.session.show(move_source(s.document, 0, 9))
    assert status.time.text == ""
    s.until(lambda: status.time.text)
    assert status.time.text.startswith("3 fields in ")
    # Other isolines ask for no field.
    s.until(lambda: s.session.is_complete)
    took = status.time.text
    s.session.show(replace(s.document, isolines=12))
    assert status.time.text == took


def test_the_time_of_fields_counts_from_when_they_were_asked_for(screen, mesh_file, gate, monkeypatch):
    gate.set()
    s, now = screen(ONE), [100.0]
    s.open(mesh_file(bumpy(200)), 5)
    gate.clear()
    monkeypatch.setattr("app.qt.progress_display.monotonic", lambda: now[0])
    s.session.show(move_source(s.document, 0, 9))
    now[0] = 109.0
    s.session.show(replace(s.document, isolines=12))
    now[0] = 110.0
    gate.set()
    s.until(lambda: s.window.status.time.text)
    assert s.window.status.time.text == "1 field in 10 s"


def test_a_mesh_being_read_is_told_in_the_status_bar(screen):
    s = screen()
    progress = s.window.status.progress
    s.session._surfaces.progress = (0.5, "reading mesh.off")
    s.window.progress_changed()
    s.until(lambda: progress.text)
    s.settle()
    assert progress.text == "Reading mesh.off, 50 %"
    assert progress.width() >= progress.sizeHint().width(), "and can be seen"
    s.session._surfaces.progress = None
    s.window.progress_changed()
    assert progress.text == ""


@pytest.fixture
def reading(monkeypatch):
    """Meshes are read once it is set, whatever the machine's speed."""
    gate = threading.Event()

    def held(*given, **named):
        gate.wait()
        return open_mesh(*given, **named)

    monkeypatch.setattr("app.session.surfaces.open_mesh", held)
    yield gate
    gate.set()


def test_while_a_file_is_read_the_old_surface_stays_dimmed_and_the_title_changes_with_the_picture(
    screen, mesh_file, reading
):
    s = screen(ONE * 2)
    reading.set()
    s.open(mesh_file(bumpy(300)), 5)
    s.until(lambda: s.window.windowTitle().startswith("mesh.off"))
    before, document = s.pictures(), s.document
    reading.clear()
    s.window.context.open(mesh_file(bumpy(200), "other.off"))
    s.until(lambda: all(panel.waiting.isVisible() for panel in s.panels))
    assert [panel.waiting.text for panel in s.panels] == ["Reading other.off…"] * 2
    assert all(panel.view._is_dimmed for panel in s.panels)
    assert all((a == b).all() for a, b in zip(before, s.pictures(), strict=True))
    assert s.window.windowTitle().startswith("mesh.off")
    QTest.mouseClick(s.panels[1].waiting.stop, LEFT)
    assert not s.session.is_opening
    reading.set()
    s.until(lambda: not any(panel.waiting.isVisible() or panel.view._is_dimmed for panel in s.panels))
    assert s.document == document
    s.settle()
    drawn, seen = [panel.view.pictures for panel in s.panels], []

    def note(title):
        seen.append((title, [panel.view.pictures > count for panel, count in zip(s.panels, drawn, strict=True)]))

    s.window.windowTitleChanged.connect(note)
    s.window.context.open(mesh_file(bumpy(200), "other.off"))
    s.until(lambda: seen)
    assert seen == [("other.off[*] - Biharmonic distance", [True, True])]
    assert {panel.loaded.surface.name for panel in s.panels} == {"other.off"}


def test_a_mesh_that_comes_beside_dims_nothing(screen, mesh_file, reading):
    s = screen(ONE)
    reading.set()
    s.open(mesh_file(bumpy(300)), 5)
    reading.clear()
    s.session.open_second_mesh(mesh_file(bumpy(200), "other.off"))
    s.until(lambda: s.window.status.progress.text == "Reading other.off…")
    assert not s.panels[0].view._is_dimmed
    reading.set()
    s.until(lambda: len(s.document.surfaces) == 2)


def test_the_first_mesh_is_told_in_the_middle_until_it_is_there(screen, mesh_file, reading):
    s = screen(ONE)
    pages = s.window.centralWidget().findChild(QtWidgets.QStackedWidget)
    start = pages.currentWidget()
    s.window.context.open(mesh_file(bumpy(300)))
    s.until(lambda: isinstance(pages.currentWidget(), QtWidgets.QLabel))
    s.until(lambda: pages.currentWidget().text() == "Reading mesh.off…")
    assert s.window.windowTitle() == "Biharmonic distance[*]"
    s.window.context.actions["stop"].trigger()
    reading.set()
    s.until(lambda: pages.currentWidget() is start)
    s.open(mesh_file(bumpy(300)))
    assert pages.currentWidget().isAncestorOf(s.window.grid)


def test_a_panel_tells_what_it_waits_for_and_can_be_stopped(screen, mesh_file, gate):
    s = screen(ONE)
    s.window.context.open(mesh_file(bumpy(800)), 0)
    (panel,) = s.panels
    s.until(lambda: panel.waiting.isVisible() and panel.waiting.text.startswith("Columns"))
    assert "no values" in panel.bar.accessibleDescription()
    panel.waiting.stop.click()
    s.until(lambda: not panel.waiting.isVisible())
    assert s.session.is_stopped
    assert panel.stopped.is_saying("Stopped. Nothing is shown.")


def test_what_was_stopped_is_asked_again_by_a_click(screen, mesh_file, gate):
    s = screen(ONE)
    s.window.context.open(mesh_file(bumpy(800)), 0)
    (panel,) = s.panels
    s.until(panel.waiting.isVisible)
    s.window.context.actions["stop"].trigger()
    assert not panel.waiting.isVisible()
    assert panel.stopped.isVisible()
    QTest.mouseClick(panel.view, LEFT, pos=panel.view.rect().center())
    s.until(panel.waiting.isVisible)
    assert not panel.stopped.isVisible(), "it is not stopped any more"
    gate.set()
    s.until(lambda: s.session.is_complete)
    assert not panel.waiting.isVisible()
    assert not panel.stopped.isVisible()
    assert "no values" not in panel.bar.accessibleDescription()


def test_what_was_stopped_is_asked_again_by_its_button_in_that_panel_alone(screen, mesh_file, gate):
    s = screen((Spec.of("biharmonic"), Spec.of("commute-time")))
    s.window.context.open(mesh_file(bumpy(300)), 0)
    one, other = s.panels
    s.until(lambda: one.waiting.isVisible() and other.waiting.isVisible())
    s.activate()
    s.settle()
    QTest.keyClick(one.view, QtCore.Qt.Key.Key_Escape)
    s.until(lambda: one.stopped.isVisible() and other.stopped.isVisible())
    one.stopped.button.setFocus()
    s.window.progress_changed()
    assert one.stopped.button.hasFocus(), "news of others do not take the keys from it"
    QTest.keyClick(one.stopped.button, QtCore.Qt.Key.Key_Space)
    assert (one.stopped.isVisible(), one.waiting.isVisible()) == (False, True)
    gate.set()
    s.until(lambda: s.session.is_answered(0))
    s.settle()
    assert (one.stopped.isVisible(), one.view._is_dimmed, other.stopped.isVisible()) == (False, False, True)
    assert s.session.is_stopped_at(1)
    QTest.mouseClick(other.stopped.button, LEFT)
    s.until(lambda: s.session.is_complete)
    assert not s.session.is_stopped


def test_the_time_of_a_field_that_is_asked_again_counts_from_then(screen, mesh_file, gate, monkeypatch):
    s, now = screen(ONE), [100.0]
    monkeypatch.setattr("app.qt.progress_display.monotonic", lambda: now[0])
    s.window.context.open(mesh_file(bumpy(300)), 0)
    (panel,) = s.panels
    s.until(lambda: panel.waiting.isVisible())
    s.activate()
    s.settle()
    QTest.keyClick(panel.view, QtCore.Qt.Key.Key_Escape)
    s.until(lambda: panel.stopped.isVisible())
    now[0] = 150.0
    QTest.mouseClick(panel.stopped.button, LEFT)
    now[0] = 152.0
    gate.set()
    s.until(lambda: s.window.status.time.text)
    assert s.window.status.time.text == "1 field in 2 s"


def test_what_was_stopped_says_what_is_shown(screen, mesh_file, gate):
    gate.set()
    s = screen((Spec.of("truncated", k=20),))
    s.open(mesh_file(bumpy(300)), 12)
    (panel,) = s.panels
    gate.clear()
    panel.head.changed.emit(DistanceFrom(Spec.of("truncated", k=250)))
    s.until(panel.waiting.isVisible)
    panel.waiting.stop.click()
    s.until(lambda: panel.stopped.is_saying("Stopped. Shown: biharmonic, 20 eigenpairs, from vertex 12."))
    assert (panel.view._is_dimmed, "no values" in panel.bar.accessibleDescription()) == (True, True)
    assert panel.stopped.geometry().bottom() < panel.view.height()
    s.session.undo()
    s.settle()
    assert (panel.stopped.isVisible(), panel.view._is_dimmed) == (False, False)


def test_a_quick_look_stays_when_the_exact_answer_is_stopped(screen, mesh_file, monkeypatch):
    monkeypatch.setattr(distance_types, "FRAME_VERTICES", 0)  # as on a large mesh
    monkeypatch.setattr(geodesic_solvers, "QUICK_WINDOWS", 0)
    gate, answer = threading.Event(), DistanceQuestion.answer

    def held(question, loaded, progress=None, at_once=None):
        while question.spec["method"] == "exact" and question.at == 9 and not gate.wait(0.01):
            progress(0.5, "exact geodesic")
        return answer(question, loaded, progress, at_once)

    monkeypatch.setattr(DistanceQuestion, "answer", held)
    s = screen((Spec.of("geodesic", method="exact"),))
    s.open(mesh_file(bumpy(300)), 5)
    (panel,) = s.panels
    s.session.show(move_source(s.document, 0, 9))
    s.until(lambda: s.session.is_preview(0) and panel.waiting.isVisible())
    (method,) = panel.head.controls
    assert method.text() == "exact, now approximate"
    panel.waiting.stop.click()
    s.until(lambda: panel.stopped.is_saying("Stopped. Shown: geodesic, approximate, from vertex 9."))
    assert (panel.view._is_dimmed, "no values" in panel.bar.accessibleDescription()) == (False, False)
    gate.set()
    panel.stopped.button.click()
    s.until(lambda: s.session.is_complete)
    assert (panel.answer.label, method.text()) == ("geodesic, exact", "exact")


def test_what_auto_stood_for_on_another_mesh_is_not_said_after_a_stop(screen, mesh_file, gate):
    gate.set()
    s = screen((Spec.of("geodesic"),))
    s.open(mesh_file(bumpy(300)), 5)
    (panel,) = s.panels
    (method,) = panel.head.controls
    assert method.text() == "auto: exact"
    gate.clear()
    s.window.context.open(mesh_file(bumpy(400), "other.off"))
    s.until(lambda: panel.waiting.isVisible() and not s.session.is_opening)
    s.window.context.actions["stop"].trigger()
    s.until(panel.stopped.isVisible)
    assert method.text() == "auto"
    gate.set()
    panel.stopped.button.click()
    s.until(lambda: s.session.is_complete)
    assert method.text() == "auto: exact"


def test_k_is_bounded_by_the_mesh_that_is_shown(screen, mesh_file):
    s = screen(ONE)
    s.open(mesh_file(bumpy(100)), 5)
    (panel,) = s.panels
    entry = next(a for a in opened_menu(panel.head.name) if a.text() == "Biharmonic, truncated")
    entry.trigger()
    s.until(lambda: s.session.is_complete)
    assert panel.answer.label == "biharmonic, 99 eigenpairs", "as many as there are of the usual 200"
    (k,) = panel.head.controls
    box, slider = k.pop_up.box, k.pop_up.slider
    k.open_under(k)
    box.setText("99999")
    QTest.keyClick(box, QtCore.Qt.Key.Key_Return)
    assert k.pop_up.complaint.text() == "k must be a whole number above 0 and at most 99, not 99999."
    k.pop_up.close()
    slider.setValue(slider.maximum())
    assert s.document.panel(0).shows.spec["k"] == 99
    s.open(mesh_file(bumpy(300), "larger.off"), 5)
    (k,) = panel.head.controls
    assert (k.parameter.at_most, k.parameter.shown) == (299, (1, 299))


def test_more_eigenpairs_than_another_mesh_has_fail_in_their_panel_alone(screen, mesh_file):
    s = screen((Spec.of("truncated", k=250), Spec.of("biharmonic")))
    s.open(mesh_file(bumpy(300)), 5)
    s.open(mesh_file(bumpy(100), "small.off"), 5)
    one, other = s.panels
    said = "small.off has 99 eigenpairs besides the constant, and k is 250; choose k from 1 to 99."
    assert (one.view.over.sentence, other.view.over.sentence) == (said, "")
    assert other.answer.field is not None
    assert not s.session.is_stopped


def test_what_failed_and_is_computed_in_another_way_says_nothing_of_the_failure(screen, mesh_file, no_exact_geodesics):
    s = screen((Spec.of("geodesic", method="exact"),))
    s.open(mesh_file(bumpy(300)), 0)
    (panel,) = s.panels
    assert "no room for windows" in panel.view.over.sentence
    panel.head.changed.emit(DistanceFrom(Spec.of("biharmonic")))
    assert panel.view.over.sentence == ""
    s.until(lambda: s.session.is_complete)
    s.session.undo()
    s.until(lambda: s.session.is_complete)
    assert "no room for windows" in panel.view.over.sentence


def test_many_reports_of_progress_are_one_change_of_the_window_and_the_end_shows_at_once(shared_screen, monkeypatch):
    s = shared_screen()
    del s.session.shown[0]
    waiting, told = s.panels[0].waiting, []

    def show_progress(*progress):
        told.append(progress)
        type(waiting).show_progress(waiting, *progress)

    monkeypatch.setattr(waiting, "show_progress", show_progress)
    for percent in range(50):
        pretend(s, (percent / 100, "solving"))
    assert told == []
    s.until(lambda: told)
    assert told == [(0.49, "Solving")]
    assert waiting.text == "Solving, 49 %"


@pytest.mark.parametrize(
    ("fraction", "said"), [(0.0, "Checking the accuracy…"), (0.496, "Checking the accuracy, 49 %")]
)
def test_what_is_found_out_of_a_field_that_is_there_is_said_beside_it(shared_screen, fraction, said):
    s = shared_screen()
    bar = s.window.status.progress
    pretend(s, (fraction, "solving"), (1.0, "solving"))
    s.until(lambda: bar.text == said)
    assert not any(panel.waiting.isVisible() for panel in s.panels)
    pretend(s, (1.0, "solving"), (1.0, "solving"))
    s.until(lambda: not bar.text)


@pytest.mark.parametrize(
    ("fraction", "said"),
    [(0.0, "Starting a process…"), (0.004, "Starting a process…"), (0.996, "Starting a process, 99 %")],
)
def test_nothing_is_0_or_100_percent_done_while_it_is_waited_for(shared_screen, fraction, said):
    s = shared_screen()
    s.panels[0].show_waiting((fraction, "Starting a process"))
    assert s.panels[0].waiting.text == said


def test_quick_answers_change_no_panel_s_words(screen, mesh_file, monkeypatch):
    monkeypatch.setattr(LatestRequestWorker.progress, "__defaults__", (60.0,))
    s = screen()
    parts(s.window).progress_display._late_soon.setInterval(60_000)  # quick on any machine
    s.open(mesh_file(bumpy(800)))
    told = []
    for panel in s.panels:
        panel.waiting.show_progress = lambda *progress: told.append(progress)
        panel.view.dim = lambda is_dimmed: told.append("dimmed") if is_dimmed else None
    s.session.show(move_source(s.document, 0, 42))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert told == []


def test_each_panel_tells_what_it_waits_for_and_how_far_that_is(shared_screen):
    s = shared_screen()
    s.settle()
    del s.session.shown[1], s.session.shown[2]
    pretend(s, (0.2, "biharmonic"), (nan, "eigenpairs: solving"))
    s.until(lambda: s.panels[1].waiting.text == "Eigenpairs…")
    # The first has its answer, and only finds out how accurate that is.
    assert [panel.waiting.isVisible() for panel in s.panels] == [False, True, True]
    assert [panel.waiting.text for panel in s.panels[1:]] == ["Eigenpairs…", "Waiting…"]
    assert ["no values" in panel.bar.accessibleDescription() for panel in s.panels] == [False, True, True]


def test_a_panel_s_words_do_not_change_the_size_of_its_picture(shared_screen):
    s = shared_screen()
    before = [panel.view.size() for panel in s.panels]
    s.window.grid.pointing.show(0, 5)
    s.panels[1].show_waiting((0.3, "Factoring " * 30))
    s.panels[2].show_stopped()
    s.settle()
    assert [panel.view.size() for panel in s.panels] == before


def test_closing_while_computing_ends_the_threads(screen, mesh_file):
    before, s = {*threading.enumerate()}, screen()
    s.window.context.open(mesh_file(bumpy(12000)))
    s.until(lambda: s.session.progress)
    s.window.close()
    assert not [t for t in {*threading.enumerate()} - before if t.name.startswith(("panel", "load")) and t.is_alive()]


def test_after_esc_the_window_is_free_whenever_that_was(screen, mesh_file):
    """Random moments of reading, of set-up and of answers; the window is as it was, and the next click is answered."""
    s, random, took = screen(), Random(3), []
    meshes = [mesh_file(bumpy(6000, seed), f"{seed}.off") for seed in (1, 2)]
    s.open(meshes[0], 5)
    for k in range(12):
        if k % 3:
            areas = "barycentric" if s.document.areas == "voronoi" else "voronoi"
            s.session.show(replace(s.document, areas=areas))
        else:
            s.window.context.open(meshes[k % 2], 7)
        s.settle(random.uniform(0, 0.6))
        begun = time.monotonic()
        s.window.actions_by_word["stop"].trigger()
        s.application.processEvents()
        took.append(time.monotonic() - begun)
        assert not s.session.is_opening
        s.until(lambda: not s.session.progress)
    # Once, another program may have had the processor.
    assert sorted(took)[-2] < 0.5
    s.session.show(move_source(s.document, 0, 9))
    s.until(lambda: s.session.is_complete)
    assert s.source == 9
    assert not s.refusals
