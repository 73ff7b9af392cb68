"""Openings that nobody wants any more: their threads end before they have guessed which way is up."""

import threading

import pytest

from bihdist_core import write_mesh
from bihdist_core.analysis import upright
from tests.shapes import bumpy
from tests.waiting import PATIENCE


def loading():
    return [thread for thread in threading.enumerate() if thread.name == "load"]


@pytest.fixture
def guess(monkeypatch):
    """The ground of the first direction waits for this event; `threads`: of which thread each ground was."""
    gate, ground = threading.Event(), upright._ground
    gate.threads = []

    def held(feet, centre):
        gate.threads.append(threading.current_thread())
        if len(gate.threads) <= gate.holds:
            assert gate.wait(PATIENCE)
        return ground(feet, centre)

    gate.holds = 2
    monkeypatch.setattr(upright, "_ground", held)
    yield gate
    gate.set()


def test_threads_of_openings_that_are_superseded_cancelled_or_closed_end(desk, guess, tmp_path):
    for number in range(3):
        write_mesh(tmp_path / f"{number}.off", bumpy(60 + number))
    before = len(loading())
    d = desk()
    d.show(tmp_path / "0.off")
    d.until(lambda: len(guess.threads) == 1)
    d.show(tmp_path / "1.off")  # while the first guesses
    d.until(lambda: len(guess.threads) == 2)
    d.session.cancel()
    assert len(loading()) == before + 3
    guess.set()
    d.until(lambda: len(loading()) == before + 1)
    first, second = guess.threads[:2]
    # Each asks again before the next direction, whose ground is looked at in two heights.
    assert guess.threads.count(first) <= 2
    assert guess.threads.count(second) <= 2
    guess.clear()
    guess.holds = len(guess.threads) + 1
    d.show(tmp_path / "2.off")
    d.until(lambda: len(guess.threads) == guess.holds)
    last = guess.threads[-1]
    d.session._surfaces.end()
    guess.set()
    d.until(lambda: len(loading()) == before)
    assert guess.threads.count(last) <= 2
