"""Closing the window: what would be lost is asked about and seen in the title; after a crash it is offered again."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest

from app.document.document import comparison
from app.document.edits import move_source
from app.document.file import read_recipe, recipe_text
from app.document.page import Recipe
from app.document.shared_parts.pins import add_pins
from app.document.shared_parts.selections import select
from app.qt import remembered
from app.qt.files.session_actions import SessionFile, offer_lost_state
from app.tools.correspondence.pairs import place_point
from app.tools.interpolation.part import add_anchor
from app.tools.robustness.perturbed_documents import perturb_mesh
from bihdist_core.applications.changes import Perturbation
from bihdist_core.sources.source import Curve, SurfacePoint
from tests.qt.parts import parts
from tests.shapes import bumpy

ROOT = Path(__file__).resolve().parents[2]


pytestmark = pytest.mark.usefixtures("own_folder")


class Asked(list):
    """The questions that are asked on closing, each answered by a word."""

    def answering(self, word):
        return lambda question: self.append(question) or word


def title(window):
    """As the desktop shows it, and whether with the sign of change."""
    return window.windowTitle(), window.isWindowModified()


WORK = {
    "pins": lambda document: add_pins(document, [7]),
    "anchors": lambda document: add_anchor(document, 7, 1.0)[0],
    "selections": lambda document: select(document, "ear", np.arange(9)),
    "drawn sources": lambda document: move_source(document, 0, curve()),
    "changes to the mesh": lambda document: perturb_mesh(document, Perturbation(noise=0.1)),
}


def question(window):
    """The one that is open."""
    from app.qt.pages.messages import Question

    return next(box for box in window.findChildren(Question) if box.isVisible())


def answer(window, words):
    """Press a button of the question that is open, by its words."""
    question(window).words[words].click()


def curve():
    return Curve(tuple(SurfacePoint.of(0, *weights) for weights in ((0.2, 0.3), (0.6, 0.3))))


def test_closing_asks_where_work_would_be_lost_that_was_never_saved(screen, mesh_file, tmp_path):
    s, asked = screen(), Asked()
    s.open(mesh_file(bumpy(300)), 5)
    file = parts(s.window).session_file
    s.session.show(move_source(s.document, 0, 6))
    assert file.may_close(asked.answering("cancel"))
    s.until(lambda: title(s.window) == ("mesh.off[*] - Biharmonic distance", False))
    for word, add in WORK.items():
        s.session.show(add(s.document))
        s.until(lambda: not s.session.is_opening)
        assert not file.may_close(asked.answering("cancel"))
        assert asked.pop() == f"The {word} have not been saved."
        assert s.window.isWindowModified()
        s.session.undo()
        s.until(lambda: not s.session.is_opening and not s.window.isWindowModified())
        assert file.may_close(asked.answering("cancel"))
    for word in ("pins", "anchors", "drawn sources"):
        s.session.show(WORK[word](s.document))
    assert not file.may_close(asked.answering("cancel"))
    assert asked.pop() == "The pins, anchors and drawn sources have not been saved."
    parts(s.window).curve_files.save(curve(), str(tmp_path / "curve.json"))
    assert not file.may_close(asked.answering("cancel"))
    assert asked.pop() == "The pins and anchors have not been saved."
    assert file.may_close(asked.answering("discard"))


def test_what_was_given_from_outside_is_not_asked_about_until_there_is_more(screen, mesh_file):
    s, asked = screen(), Asked()
    s.window.show_document(add_pins(comparison(mesh_file(bumpy(300)), sources=(curve(),)), [7, 8]))
    s.until(lambda: s.session.is_complete)
    assert parts(s.window).session_file.may_close(asked.answering("cancel"))
    assert not s.window.isWindowModified()
    s.session.show(add_pins(s.document, [9]))
    assert not parts(s.window).session_file.may_close(asked.answering("cancel"))
    assert asked == ["The pins have not been saved."]


def test_what_is_found_once_the_window_is_closed_is_dropped(screen, mesh_file):
    s, ran = screen(), []
    s.open(mesh_file(bumpy(120)), 5)
    s.window.context.post(lambda: ran.append("open"))
    s.until(lambda: ran == ["open"])
    s.window.context.quiet = True
    s.window.close()
    s.window.context.post(lambda: ran.append("closed"))
    s.settle(0.1)
    assert ran == ["open"]


def test_the_window_is_gone_before_its_threads_have_ended(screen, mesh_file, monkeypatch):
    s, visible = screen(), []
    s.open(mesh_file(bumpy(120)), 5)
    s.window.actions_by_word["dock statistics"].trigger()
    s.settle(0.1)
    close = s.session.close
    monkeypatch.setattr(s.session, "close", lambda: (visible.append(s.window.isVisible()), close()))
    s.window.close()
    assert visible == [False]


def test_pairs_are_asked_about(screen, mesh_file):
    s, asked = screen(), Asked()
    s.open(mesh_file(bumpy(120)), 5)
    s.session.open_second_mesh(mesh_file(bumpy(120), "other.off"))
    s.until(lambda: s.session.is_complete and len(s.document.surfaces) == 2)
    s.session.show(place_point(s.document, "A", 7))
    assert not parts(s.window).session_file.may_close(asked.answering("cancel"))
    assert asked == ["The pairs have not been saved."]
    s.until(lambda: title(s.window) == ("mesh.off, other.off[*] - Biharmonic distance", True))


def test_closing_asks_where_a_session_has_changed_since_it_was_saved(screen, mesh_file, tmp_path):
    s, asked = screen(), Asked()
    s.open(mesh_file(bumpy(300)), 5)
    file = parts(s.window).session_file
    file.save(str(tmp_path / "s [*].json"))
    s.until(lambda: title(s.window) == ("s [*][*].json[*] - mesh.off - Biharmonic distance", False))
    parts(s.window).views.reset("top")
    assert file.may_close(asked.answering("cancel"))
    assert not asked
    s.session.show(move_source(s.document, 0, 7))
    assert s.window.isWindowModified()
    s.session.undo()
    assert not s.window.isWindowModified()
    s.session.redo()
    assert not file.may_close(asked.answering("cancel"))
    assert file.may_close(asked.answering("discard"))
    assert file.may_close(asked.answering("save"))
    assert asked == ["The session s [*].json has unsaved changes."] * 3
    assert read_recipe(tmp_path / "s [*].json").document.sources == (7,)
    assert not s.window.isWindowModified()
    assert file.may_close(asked.answering("cancel"))
    assert len(asked) == 3


@pytest.mark.parametrize("was_saved", [False, True])
def test_what_is_shown_again_after_a_crash_is_unsaved(screen, mesh_file, tmp_path, was_saved):
    s, saved = screen(), tmp_path / "s.json"
    s.window.context.remembers = True
    s.open(mesh_file(bumpy(300)), 5)
    if was_saved:
        parts(s.window).session_file.save(str(saved))
    s.session.show(replace(move_source(s.document, 0, 9), isolines=12))
    s.until(lambda: s.session.is_complete)
    parts(s.window).session_file.keep()
    assert remembered.own_state().exists()
    assert remembered.lost_states() == []  # this process is there
    # Another process keeps its state, and ends without a word once it is told to.
    code = "import os; from app.qt import remembered as r; text = input(); session = input() or None; "
    code += "r.keep_state(lambda p: p.write_text(text), session); "
    command = [sys.executable, "-c", f"{code}print(r.own_state()); print(flush=True); input(); os._exit(1)"]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, cwd=ROOT, **pipes) as process:
        process.stdin.write(json.dumps(json.loads(remembered.own_state().read_text())) + "\n")
        process.stdin.write((remembered.session_of(remembered.own_state()) or "") + "\n")
        process.stdin.flush()
        lost = Path(process.stdout.readline().strip())
        process.stdout.readline()
        assert lost.exists()
        assert remembered.lost_states() == []
        process.stdin.write("\n")
        process.stdin.flush()
        process.wait()
    assert remembered.lost_states() == [lost]
    other, asked = screen(), Asked()
    other.window.context.remembers = True
    offer_lost_state(other.window.context)
    answer(other.window, "Restore")
    other.until(lambda: other.session.is_complete)
    assert other.document == s.document
    # It is kept by the other window from now on.
    assert remembered.lost_states() == []
    file = parts(other.window).session_file
    name = "s.json[*] - mesh.off" if was_saved else "mesh.off[*]"
    other.until(lambda: title(other.window) == (f"{name} - Biharmonic distance", True))
    assert not file.may_close(asked.answering("cancel"))
    lost = "The session s.json has unsaved changes." if was_saved else "The recovered session is not saved."
    assert asked == [lost]
    file.save(None if was_saved else str(saved))
    assert read_recipe(saved).document.sources == (9,)
    other.until(lambda: title(other.window) == ("s.json[*] - mesh.off - Biharmonic distance", False))
    assert file.may_close(asked.answering("cancel"))
    s.window.close()
    assert not remembered.own_state().exists()
    assert list(remembered.folder().glob("open-*.session")) == []


def test_only_what_a_crash_would_lose_is_kept(screen, mesh_file, tmp_path):
    s = screen()
    s.window.context.remembers = True
    file = parts(s.window).session_file

    def is_kept():
        return file.keep(), *(each.exists() for each in (remembered.own_state(), lock))

    lock = Path(f"{remembered.own_state()}.lock")
    s.open(mesh_file(bumpy(120)), 5)
    assert is_kept() == (False, False, False)
    s.session.show(move_source(s.document, 0, 7))
    assert is_kept() == (True, True, True)
    s.session.undo()
    assert is_kept() == (False, False, False)
    s.session.redo()
    assert is_kept() == (True, True, True)
    file.save(str(tmp_path / "s.json"))
    assert not remembered.own_state().exists()
    s.session.show(move_source(s.document, 0, 9))
    assert is_kept() == (True, True, True)
    file.open(str(tmp_path / "s.json"))
    s.until(lambda: s.document.sources == (7,))
    assert is_kept() == (False, True, True)  # the change that only undo leads back to


def test_what_is_shown_again_stays_where_it_was_kept_if_it_cannot_be_kept_anew(screen, mesh_file, monkeypatch):
    from bihdist_core import OutputError

    def write(*_, **__):
        raise OutputError("The disk is full.")

    s = screen()
    s.window.context.remembers = True
    remembered.folder().mkdir(parents=True)
    lost = remembered.folder() / "open-999999.json"
    lost.write_text(recipe_text(Recipe(comparison(mesh_file(bumpy(60)))), "9"))
    monkeypatch.setattr(SessionFile, "_write", write)
    offer_lost_state(s.window.context)
    answer(s.window, "Restore")
    s.until(lambda: s.session.is_complete)
    assert remembered.lost_states() == [lost]


def test_what_cannot_be_shown_again_is_offered_the_next_time(screen, mesh_file):
    s = screen()
    remembered.folder().mkdir(parents=True)
    lost = remembered.folder() / "open-999999.json"
    lost.write_text(recipe_text(Recipe(comparison(str(lost.parent / "gone.off"))), "9"))
    offer_lost_state(s.window.context)
    answer(s.window, "Restore")
    assert "gone.off was not found" in s.refusals[-1]
    assert remembered.lost_states() == [lost]
    s.settle(0.05)
    offer_lost_state(s.window.context)
    answer(s.window, "Start fresh")
    assert remembered.lost_states() == []


def test_what_can_be_restored_is_named_and_esc_does_not_throw_it_away(screen, mesh_file, tmp_path):
    from qtpy import QtCore, QtTest

    s = screen()
    remembered.folder().mkdir(parents=True)
    lost = remembered.folder() / "open-999999.json"
    lost.write_text(recipe_text(Recipe(comparison(mesh_file(bumpy(60), "cat.off"))), "9"))
    now = datetime.now().replace(hour=14, minute=2)
    os.utime(lost, (now.timestamp(), now.timestamp()))
    lost.with_suffix(remembered.SESSION).write_text(str(tmp_path / "cats.json"))
    offer_lost_state(s.window.context)
    box = question(s.window)
    assert box.text() == (
        "bihdist closed unexpectedly. Restore the last session?\n\ncats.json (cat.off), today at 14:02"
    )
    QtTest.QTest.keyClick(box, QtCore.Qt.Key.Key_Escape)
    s.settle(0.05)
    assert lost.exists()
    answer(s.window, "Start fresh")
    assert not lost.exists()
    s.settle(0.05)
    old = remembered.folder() / "open-999998.json"
    old.write_text("{}")
    then = now.replace(year=2020, month=3, day=5)
    os.utime(old, (then.timestamp(), then.timestamp()))
    offer_lost_state(s.window.context)
    box = question(s.window)
    assert box.text().endswith("\n\n5 March 2020 at 14:02")
    answer(s.window, "Start fresh")
