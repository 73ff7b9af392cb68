"""SIGTERM and interruptions: what commands keep, and how the next run goes on."""

import ctypes
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from app import main as program
from app.commands.termination import Terminated, termination_raised
from app.main import main
from bihdist_core import BiharmonicDistance, write_mesh
from tests.commands import ran
from tests.shapes import bumpy
from tests.waiting import PATIENCE

ROOT = Path(__file__).parents[2]


def test_a_second_one_does_not_disturb_what_is_being_written_down():
    done = []

    def work():
        try:
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(5)
        finally:
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(0.05)
            done.append(True)

    with pytest.raises(Terminated), termination_raised():
        work()
    assert done
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_one_that_was_lost_may_be_sent_again():
    """Some library may have caught it, as what is imported, or called back, does now and then."""
    now = [0.0]

    def work():
        for now[0] in (5.0, 7.0):  # the second, two seconds after the first
            try:
                os.kill(os.getpid(), signal.SIGTERM)
                time.sleep(0.05)
                survived.append(now[0])
            except Terminated:
                pass
        now[0] = 16.0
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(5)

    survived = []
    with pytest.raises(Terminated), termination_raised(lambda: now[0]):
        work()
    assert survived == [7.0]


class Converted:
    """An argument for C during whose conversion a signal arrives: ctypes makes what is raised then an ArgumentError."""

    def __init__(self, number):
        self.number = number

    def from_param(self, value):
        signal.raise_signal(self.number)
        return value


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_one_waits_where_it_would_become_another_error(number):
    call = ctypes.PYFUNCTYPE(ctypes.c_long, ctypes.py_object)(("PyLong_AsLong", ctypes.pythonapi))
    call.argtypes = [Converted(number)]

    def work():
        assert call(ctypes.py_object(7)) == 7
        time.sleep(PATIENCE)

    with pytest.raises(KeyboardInterrupt) as raised, termination_raised():
        work()
    assert isinstance(raised.value, Terminated) == (number == signal.SIGTERM)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_one_waits_for_the_end_of_an_import(number, tmp_path, monkeypatch):
    (tmp_path / "catches_all.py").write_text(
        f"import signal\ntry:\n    signal.raise_signal({int(number)})\nexcept BaseException:\n    pass\nloaded = True\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "catches_all", raising=False)

    def work():
        import catches_all

        assert catches_all.loaded
        time.sleep(PATIENCE)

    with pytest.raises(KeyboardInterrupt), termination_raised():
        work()


def test_who_listens_for_it_already_goes_on_to():
    heard = []
    before = signal.signal(signal.SIGTERM, lambda *_: heard.append(True))
    try:
        with termination_raised():
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(0.05)
    finally:
        signal.signal(signal.SIGTERM, before)
    assert heard == [True]


def test_other_threads_leave_signals_alone(capsys):
    statuses = []
    thread = threading.Thread(target=lambda: statuses.append(program.main(["info", "--solver"])))
    thread.start()
    thread.join()
    assert statuses == [0]


def test_all_pairs_that_are_ended_keep_what_is_done(tmp_path):
    write_mesh(tmp_path / "mesh.off", bumpy(4000))
    out = tmp_path / "all.npy"
    words = ["pairs", str(tmp_path / "mesh.off"), "--sources", "all", "--memory", "1", "-o", str(out)]
    command = [sys.executable, "-m", "app", *words]
    run = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    begin = time.monotonic()
    while not list(tmp_path.glob(".all-*.part")) and run.poll() is None and time.monotonic() - begin < PATIENCE:
        time.sleep(0.01)
    time.sleep(0.2)
    run.send_signal(signal.SIGTERM)
    _, said = run.communicate(timeout=PATIENCE)
    assert run.returncode == 143, said
    assert "Finished rows are kept: " in said
    assert said.endswith("bihdist: ended by SIGTERM.\n")
    assert not out.exists()


# ---------------------------------------------------------------------- interrupted pairs
@pytest.fixture
def mesh(mesh_file):
    return mesh_file(bumpy(200))


def interrupted(mesh, out, monkeypatch, error, after):
    """Begin all pairs, and let the computation end with an error after so many blocks of 20 rows."""
    ask, blocks = BiharmonicDistance.from_sources, []

    def from_sources(self, ids, *rest, **how):
        if len(blocks) == after:
            raise error
        blocks.append(ids)
        return ask(self, ids, *rest, **how)

    with monkeypatch.context() as patch:
        patch.setattr(BiharmonicDistance, "from_sources", from_sources)
        return main(["pairs", mesh, "--sources", "all", "--memory", "0.16", "-o", str(out)])


@pytest.mark.parametrize(("error", "status"), [(KeyboardInterrupt(), 130), (MemoryError(), 2)])
def test_an_interrupted_run_says_what_it_leaves_and_the_next_goes_on(
    mesh, tmp_path, capsys, monkeypatch, error, status
):
    out = tmp_path / "all.npy"
    assert interrupted(mesh, out, monkeypatch, error, 2) == status
    (partial,) = tmp_path.glob(".all-*.npy.part")
    known = f"{partial}, 40 of 200 rows (0.06 MB)"
    assert f"Finished rows are kept: {known}." in capsys.readouterr().err
    assert main(["pairs", mesh, "--sources", "all", "--dtype", "float32", "-o", str(tmp_path / "all.npy")]) == 0
    assert f"{partial} (0.06 MB) is left over from another mesh" in capsys.readouterr().err
    assert partial.exists()
    assert main(["pairs", mesh, "--sources", "all", "-o", str(out)]) == 0
    assert f"Resuming from {known}; --fresh starts again." in capsys.readouterr().err
    assert not partial.exists()
    assert ran(capsys, "pairs", mesh, "--sources", "all", "-o", out).err == ""


def test_what_an_interrupted_run_has_left_may_be_discarded(mesh, tmp_path, capsys, monkeypatch):
    out = tmp_path / "all.npy"
    assert interrupted(mesh, out, monkeypatch, KeyboardInterrupt(), 2) == 130
    (partial,) = tmp_path.glob(".all-*.npy.part")
    with partial.open("r+b") as file:
        file.seek(200)
        file.write(100 * b"\0")  # what --fresh must not use
    capsys.readouterr()
    assert main(["pairs", mesh, "--sources", "all", "--fresh", "-o", str(out)]) == 0
    assert f"Discarding {partial}, 40 of 200 rows" in capsys.readouterr().err
    assert (np.load(out)[0, 1:] > 0).all()
    assert not partial.exists()


def test_an_interruption_before_the_first_row_leaves_nothing_to_tell(mesh, tmp_path, capsys, monkeypatch):
    assert interrupted(mesh, tmp_path / "all.npy", monkeypatch, KeyboardInterrupt(), 0) == 130
    assert capsys.readouterr().err == "bihdist: interrupted.\n"
