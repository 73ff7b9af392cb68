"""What nobody foresaw reaches the user with details to copy, and the next click works."""

import sys
import threading

import pytest

from app.document.edits import move_source
from app.qt.unexpected_errors import UnexpectedErrors, take_all_exceptions
from bihdist_core.unexpected import note_unexpected
from tests.qt.parts import parts
from tests.shapes import bumpy

SAID = "Unexpected error: ZeroDivisionError: once"


pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def told(screen, mesh_file):
    """A window that shows a mesh, and says what it has to say."""
    s = screen()
    s.open(mesh_file(bumpy(300)), 3)
    s.window.context.quiet = False
    yield s
    if message(s) is not None:
        message(s).close()
    s.window.context.quiet = True


def errors_of(s):
    return s.window.context[UnexpectedErrors]


def message(s):
    return errors_of(s).message


def check_told(s):
    """A dialog with the sentence, the details folded away, all of it to copy; then the next click is answered."""
    from qtpy import QtWidgets

    s.until(lambda: message(s) is not None)
    shown = message(s)
    assert shown.sentence.text() == SAID
    assert "Traceback" in shown.details.toPlainText()
    shown.copy.click()
    assert QtWidgets.QApplication.clipboard().text().endswith("ZeroDivisionError: once")
    assert s.window.notice.isHidden()  # not twice
    shown.close()
    s.settle(0.05)
    assert message(s) is None
    vertex = s.source + 1
    s.session.show(move_source(s.document, 0, vertex))
    s.until(lambda: s.session.is_complete)
    assert s.source == vertex
    assert all(answer.field is not None for answer in s.answers)


class Once:
    def __init__(self, there=lambda *arguments, **options: None):
        self._there, self.calls = there, 0

    def __call__(self, *arguments, **options):
        self.calls += 1
        if self.calls == 1:
            raise ZeroDivisionError("once")
        return self._there(*arguments, **options)


def test_an_answer_that_fails(told, monkeypatch):
    from app.session.questions import DistanceQuestion

    fails = Once(DistanceQuestion.answer)
    monkeypatch.setattr(DistanceQuestion, "answer", lambda self, *rest, **options: fails(self, *rest, **options))
    told.session.show(move_source(told.document, 0, 40))
    check_told(told)


def test_a_session_that_fails_while_it_is_read_and_another_mesh_that_fails(told, tmp_path, monkeypatch, mesh_file):
    path = str(tmp_path / "s.json")
    parts(told.window).session_file.save(path)
    with monkeypatch.context() as patch:
        patch.setattr("app.qt.files.session_actions.read_recipe", Once())
        parts(told.window).files.open(path)
        check_told(told)
    errors_of(told)._known.clear()
    with monkeypatch.context() as patch:
        patch.setattr("app.session.surfaces.open_mesh", Once())
        parts(told.window).files.open(mesh_file(bumpy(100), "other.off"))
        check_told(told)
    parts(told.window).files.open(path)
    told.until(lambda: parts(told.window).session_file.path == path and told.session.is_complete)


def test_work_of_an_instrument_that_fails(told):
    def compute(request, progress):
        if request == [1]:
            raise ZeroDivisionError("once")
        yield request

    made, answers, failures = told.window.context.background("a test's", compute), [], []
    made.answered.connect(lambda request, answer: answers.append(answer))
    made.failed.connect(lambda request, sentence: failures.append(sentence))
    made.ask([1])
    check_told(told)
    assert failures == [SAID]
    made.ask([2])
    told.until(lambda: answers == [[2]])


def test_maps_that_cannot_be_judged_say_why_and_stay_so(told, mesh_file, monkeypatch):
    from app.tools.correspondence.map_errors import MapErrorWorker
    from app.tools.correspondence.pairs import add_pairs
    from app.tools.correspondence.quantity import predict

    told.session.open_second_mesh(mesh_file(bumpy(300), "b.off"))
    told.until(lambda: len(told.document.surfaces) == 2 and told.session.is_complete)
    judge, fails = MapErrorWorker.errors, [True]

    def judged(self, *rest):
        if fails:
            raise ZeroDivisionError("once")
        yield from judge(self, *rest)

    monkeypatch.setattr(MapErrorWorker, "errors", judged)
    parts(told.window).docks.toggle("pairs")
    errors = None

    def found():
        nonlocal errors
        from app.tools.correspondence.error_section import ErrorSection

        errors = next(iter(told.window.findChildren(ErrorSection)), None)
        return errors is not None

    told.until(found)
    told.session.show(predict(add_pairs(told.document, [(3, 3), (150, 150), (250, 250)])))
    told.until(lambda: message(told) is not None and errors.note.text() == SAID)
    errors._show()
    assert errors.note.text() == SAID  # not that it goes on
    message(told).close()
    fails.clear()
    told.session.show(predict(add_pairs(told.document, [(90, 90)])))
    told.until(lambda: errors.is_whole)


def test_a_shading_that_fails(told, monkeypatch):
    from app.qt.panels import shading_cache
    from app.scene.prepared import Meshes

    monkeypatch.setattr(shading_cache, "LARGE", 0)
    fails = Once(Meshes.made)
    monkeypatch.setattr(Meshes, "made", lambda self, *rest: fails(self, *rest))
    from dataclasses import replace

    shading = replace(told.document.shading, normals="flat")
    told.session.show(replace(told.document, shading=shading))
    check_told(told)


def test_a_preview_that_fails(told):
    exports, refused, answered = parts(told.window).exports, [], []
    exports.previews.refused.connect(lambda number, sentence: refused.append(sentence))
    exports.previews.answered.connect(lambda number, result: answered.append(result))
    exports.previews._made = Once(exports.previews._made)
    exports.previews.ask("a", abs, -7)
    check_told(told)
    assert refused == [SAID]
    exports.previews.ask("a", abs, -7)
    told.until(lambda: answered == [7])


def test_a_file_that_cannot_be_drawn(told, monkeypatch, tmp_path):
    from app.figures.worker import Worker

    failed, saved = [], []
    exports = parts(told.window).exports
    exports.failed.connect(failed.append)
    exports.saved.connect(saved.append)
    with monkeypatch.context() as patch:
        patch.setattr(Worker, "ask", Once())
        exports.start(abs, str(tmp_path / "a.png"), "Figure")
        check_told(told)
    assert failed == [SAID]


def test_an_exception_of_a_slot_and_of_a_thread(told, monkeypatch):
    printed = []
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: printed.append(str(error)))
    monkeypatch.setattr(threading, "excepthook", threading.excepthook)
    take_all_exceptions()
    told.window.context.post(Once())
    check_told(told)
    errors_of(told)._known.clear()
    threading.Thread(target=Once()).start()
    check_told(told)
    assert printed == ["once", "once"]


def test_what_fails_again_and_again_is_told_once_at_a_time(told):
    for _ in range(50):
        note_unexpected(ZeroDivisionError("once"))
    told.settle()
    first = message(told)
    assert first is not None
    first.close()
    told.settle(0.05)
    note_unexpected(ZeroDivisionError("once"))
    told.settle(0.05)
    assert message(told) is None


def test_a_window_that_says_nothing_only_refuses(told):
    told.window.context.quiet = True
    note_unexpected(ZeroDivisionError("once"))
    told.until(lambda: SAID in told.refusals)
    assert message(told) is None
