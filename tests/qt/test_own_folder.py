"""The folder of small drawings goes with its process, however that ends."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from app.qt.look.own_folder import own_folder, remove_own_folder
from tests.programs import ROOT, run_app
from tests.shapes import bumpy

pytestmark = pytest.mark.usefixtures("application")


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """A folder for temporary ones, of our own and of processes that are started."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setenv("TMPDIR", str(folder))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setattr(tempfile, "tempdir", None)
    from app.qt.look import own_folder

    monkeypatch.setattr(own_folder, "_kept", [])
    yield folder
    own_folder.remove_own_folder()


def ours(folder):
    return sorted(folder.glob("bihdist-look-*"))


def test_a_window_that_ends_leaves_nothing(temporary, mesh_file, tmp_path):
    assert run_app(mesh_file(bumpy(100)), "--screenshot", tmp_path / "a.png").returncode == 0
    assert (tmp_path / "a.png").exists()
    assert ours(temporary) == []


def test_the_next_sweeps_the_folder_of_one_that_was_killed_and_of_nobody_else(temporary):
    words = "from app.qt.look.own_folder import own_folder; print(own_folder(), flush=True); input()"
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", words], cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        for _ in range(2)
    ]
    killed, lives = (Path(process.stdout.readline().strip()) for process in processes)
    processes[0].send_signal(signal.SIGKILL)
    processes[0].communicate()
    (temporary / "bihdist-look-new").mkdir()
    (temporary / "other").mkdir()
    before = time.time() - 3600
    for folder in (killed, lives, temporary / "other"):
        os.utime(folder, (before, before))
    mine = own_folder()
    assert ours(temporary) == sorted([lives, mine, temporary / "bihdist-look-new"])
    assert (temporary / "other").exists()
    processes[1].communicate("\n")
    remove_own_folder()
    assert ours(temporary) == [temporary / "bihdist-look-new"]


def test_a_folder_that_was_taken_away_is_made_again(temporary):
    own_folder().joinpath("lock").unlink(missing_ok=True)
    own_folder().rmdir()
    assert own_folder().is_dir()
