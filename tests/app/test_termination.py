"""SIGTERM ends commands as Ctrl-C does, with an exit status of its own."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from app import main as program
from app.commands.termination import Terminated, termination_raised
from bihdist_core import write_mesh
from tests.shapes import bumpy

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
    while not list(tmp_path.glob(".all-*.part")) and run.poll() is None and time.monotonic() - begin < 60:
        time.sleep(0.01)
    time.sleep(0.2)
    run.send_signal(signal.SIGTERM)
    _, said = run.communicate(timeout=60)
    assert run.returncode == 143
    assert "What is done is kept: " in said
    assert said.endswith("bihdist: ended by SIGTERM.\n")
    assert not out.exists()
