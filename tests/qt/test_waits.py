"""What the window says while something is computed, and that it can be stopped."""

import threading
from math import nan

import pytest

from app.document.edits import move_source
from app.document.quantities import DistanceFrom
from app.session.lane import Lane
from app.session.opened import Opened
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy, fin

pytest.importorskip("qtpy")

from qtpy import QtCore
from qtpy.QtTest import QTest

LEFT = QtCore.Qt.MouseButton.LeftButton
ONE = (Spec.of("biharmonic"),)


@pytest.fixture
def gate(monkeypatch):
    """Answers wait until it is set, whatever the machine's speed, and can be stopped meanwhile."""
    gate, answer = threading.Event(), Opened.answer

    def held(opened, question, progress=None, at_once=None):
        while not gate.wait(0.01):
            if progress is not None:
                progress(0.5, "columns: solving")
        return answer(opened, question, progress, at_once)

    monkeypatch.setattr(Opened, "answer", held)
    yield gate
    gate.set()


def pretend(screen, *progress):
    """Let the panels be at work, each at a share of something."""
    screen.session._answering.progress.update(enumerate(progress))
    screen.window.progress_changed()


def test_a_mesh_being_read_is_told_in_the_status_bar(screen):
    s = screen()
    progress = s.window.status.progress
    s.session._surfaces.progress = (0.5, "reading mesh.off")
    s.window.progress_changed()
    s.until(lambda: progress.text)
    s.settle()
    assert progress.text == "Reading mesh.off 50 %"
    assert progress.width() >= progress.sizeHint().width(), "and can be seen"
    s.session._surfaces.progress = None
    s.window.progress_changed()
    assert progress.text == ""


def test_a_panel_tells_what_it_waits_for_and_can_be_stopped(screen, mesh_file, gate):
    s = screen(ONE)
    s.window.open(mesh_file(bumpy(800)), 0)
    (panel,) = s.panels
    s.until(lambda: panel.waiting.isVisible() and panel.waiting.text.startswith("Columns"))
    assert "no values" in panel.bar.accessibleDescription()
    panel.waiting.stop.click()
    s.until(lambda: not panel.waiting.isVisible())
    assert s.session.is_stopped
    assert panel.view.over.sentence == "Stopped. Click a point to ask again."


def test_what_was_stopped_is_asked_again_by_a_click(screen, mesh_file, gate):
    s = screen(ONE)
    s.window.open(mesh_file(bumpy(800)), 0)
    (panel,) = s.panels
    s.until(panel.waiting.isVisible)
    s.window.cancel()
    assert not panel.waiting.isVisible()
    QTest.mouseClick(panel.view, LEFT, pos=panel.view.rect().center())
    s.until(panel.waiting.isVisible)
    assert panel.view.over.sentence == "", "it is not stopped any more"
    gate.set()
    s.until(lambda: s.session.is_complete)
    assert not panel.waiting.isVisible()
    assert panel.view.over.sentence == ""
    assert "no values" not in panel.bar.accessibleDescription()


def test_what_failed_and_is_computed_in_another_way_says_nothing_of_the_failure(screen, mesh_file):
    s = screen((Spec.of("geodesic", method="exact"),))
    s.open(mesh_file(fin()), 0)
    (panel,) = s.panels
    assert "is not manifold" in panel.view.over.sentence
    panel.head.changed.emit(DistanceFrom(Spec.of("biharmonic")))
    assert panel.view.over.sentence == ""
    s.until(lambda: s.session.is_complete)
    s.session.undo()
    s.until(lambda: s.session.is_complete)
    assert "is not manifold" in panel.view.over.sentence


def test_many_reports_of_progress_are_one_change_of_the_window_and_the_end_shows_at_once(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)))
    waiting, told = s.panels[0].waiting, []
    waiting.show_progress = lambda *progress: told.append(progress) or type(waiting).show_progress(waiting, *progress)
    for percent in range(50):
        pretend(s, (percent / 100, "solving"))
    assert told == []
    s.until(lambda: told)
    assert told == [(0.49, "Checking the accuracy")]
    assert waiting.text == "Checking the accuracy, 49 %"
    s.session._answering.progress.clear()
    s.window.progress_changed()
    assert not waiting.isVisible()


def test_quick_answers_change_no_panel_s_words(screen, mesh_file, monkeypatch):
    monkeypatch.setattr(Lane.progress, "__defaults__", (60.0,))
    s = screen()
    s.window.waits._late_soon.setInterval(60_000)  # quick on any machine
    s.open(mesh_file(bumpy(800)))
    told = []
    for panel in s.panels:
        panel.waiting.show_progress = lambda *progress: told.append(progress)
        panel.view.dim = lambda is_dimmed: told.append("dimmed") if is_dimmed else None
    s.session.show(move_source(s.document, 0, 42))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert told == []


def test_each_panel_tells_what_it_waits_for_and_how_far_that_is(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(800)))
    s.settle()
    del s.session.shown[1], s.session.shown[2]
    pretend(s, (0.2, "biharmonic"), (nan, "eigenpairs: solving"))
    s.until(s.panels[0].waiting.isVisible)
    # The first has its answer, and only finds out how accurate that is.
    said = ["Checking the accuracy, 20 %", "Eigenpairs…", "Waiting…"]
    assert [panel.waiting.text for panel in s.panels] == said
    assert ["no values" in panel.bar.accessibleDescription() for panel in s.panels] == [False, True, True]


def test_a_panel_s_words_do_not_change_the_size_of_its_picture(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(800)))
    before = [panel.view.size() for panel in s.panels]
    s.window.grid.pointing.show(0, 5)
    s.panels[1].show_waiting((0.3, "Factoring " * 30))
    s.panels[2].show_stopped()
    s.settle()
    assert [panel.view.size() for panel in s.panels] == before


def test_closing_while_computing_ends_the_threads(screen, mesh_file):
    import threading

    s = screen()
    s.window.open(mesh_file(bumpy(12000)))
    s.until(lambda: s.session.progress)
    s.window.close()
    assert not [t for t in threading.enumerate() if t.name.startswith(("panel", "load")) and t.is_alive()]
