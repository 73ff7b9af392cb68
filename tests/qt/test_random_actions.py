"""Random hands on the real window: no exception, nothing old in a panel at the end, no memory that is lost.

BIHDIST_ACTIONS: how many actions there are; BIHDIST_SEED: which.
"""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from qtpy import QtCore, QtWidgets

from tests.programs import run_python
from tests.qt.parts import parts
from tests.waiting import PATIENCE

ACTIONS, SEED = int(os.environ.get("BIHDIST_ACTIONS", 300)), int(os.environ.get("BIHDIST_SEED", 1))
FIRST = 50
"""Actions after which all that is made once and kept (menus, dialogs' modules, answers) is mostly there."""

pytestmark = [
    pytest.mark.skipif(shutil.which("xdotool") is None, reason="xdotool is not installed"),
    pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is read from /proc"),
]


def test_random_actions_leave_true_panels_and_no_exception(application, tmp_path):
    words = ["-m", "tests.qt.random_actions", SEED, ACTIONS, tmp_path]
    done = run_python(*words, timeout=PATIENCE + 10 * ACTIONS, XDG_DATA_HOME=str(tmp_path))
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["errors"] == []
    assert found["faults"] == [], f"{found['last']}\n{found['document']}"
    assert found["freed"] == [], "a loop that no key ended"
    assert found["widest"] <= found["screen"]
    assert len(found["rss"]) == ACTIONS
    thirds = [float(np.median(part)) for part in np.array_split(found["rss"][FIRST:], 3)]
    # In the first third much is imported and made for the first time, and then kept.
    assert thirds[-1] - thirds[1] < 40, f"MB: {thirds}"


def test_dialogs_that_are_closed_are_gone(screen):
    from app.qt.pages.palette import Palette

    s = screen()
    for kind, open_it in (
        (Palette, parts(s.window).guide.show_commands),
        (QtWidgets.QDialog, parts(s.window).choices.ask_preferences),
    ):
        open_it()
        s.settle(0.05)
        (dialog,) = s.window.findChildren(kind)
        dialog.close()
        s.application.sendPostedEvents(None, QtCore.QEvent.Type.DeferredDelete)
        assert s.window.findChildren(kind) == []


def test_a_dialog_that_asks_for_a_path_is_gone_once_it_is_answered(screen, monkeypatch):
    from app.qt.files.saving import ask_path

    s = screen()
    for answer in (0, 1):
        monkeypatch.setattr(QtWidgets.QFileDialog, "exec", lambda dialog, answer=answer: answer)
        assert bool(ask_path(s.window.context, "Save", "name", [".csv"])) == bool(answer)
        s.application.sendPostedEvents(None, QtCore.QEvent.Type.DeferredDelete)
        assert s.window.findChildren(QtWidgets.QFileDialog) == []
