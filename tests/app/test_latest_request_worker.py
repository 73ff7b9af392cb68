"""A lane's thread: what may be seen of it from outside."""

import os
import sys
import threading

import pytest

from app.session.latest_request_worker import NICE, LatestRequestWorker
from bihdist_core import Cancelled
from tests.waiting import PATIENCE


@pytest.mark.skipif(sys.platform != "linux", reason="threads have priorities of their own on Linux only")
def test_a_lane_and_the_threads_it_starts_stand_back():
    nice, done = [], threading.Event()

    def work(request, worker):
        def note():
            nice.append(os.getpriority(os.PRIO_PROCESS, threading.get_native_id()))

        started = threading.Thread(target=note)
        started.start()
        started.join()
        note()
        done.set()

    before = os.getpriority(os.PRIO_PROCESS, threading.get_native_id())
    worker = LatestRequestWorker("lane", work, lambda *_: None, lambda *_: None)
    worker.submit("anything")
    assert done.wait(PATIENCE)
    worker.close()
    assert nice == [min(before + NICE, 19)] * 2
    assert os.getpriority(os.PRIO_PROCESS, threading.get_native_id()) == before


# ---------------------------------------------------------------------- work that is given up
class Told:
    """A lane, what it tells, and work that goes on until its gate is open."""

    def __init__(self, asks=False):
        self.gates = {word: threading.Event() for word in ("first", "second")}
        self.begun = {word: threading.Event() for word in self.gates}
        self.ended = {word: threading.Event() for word in self.gates}
        self.outcome, self.reports, self.failures, self._asks = {}, [], [], asks
        self.quiet = threading.Event()
        self.worker = LatestRequestWorker(
            "lane", self._work, self._report, lambda *told: self.failures.append(told), leaves=True
        )

    def _report(self, fraction, text):
        self.reports.append(text)
        if fraction is None:
            self.quiet.set()

    def _work(self, word, worker):
        progress = worker.progress(lambda latest: latest == word, quiet=0)
        self.begun[word].set()
        try:
            assert self.gates[word].wait(PATIENCE)
            progress(0.5, word)
            self.outcome[word] = "done"
        except Cancelled:
            self.outcome[word] = "given up"
            raise ZeroDivisionError from None
        finally:
            self.ended[word].set()

    def close(self):
        for gate in self.gates.values():
            gate.set()
        self.worker.close(60)


@pytest.fixture
def told():
    told = Told()
    yield told
    told.close()


@pytest.mark.parametrize("between", [[], [None]], ids=["by another request", "by a stop"])
def test_the_next_request_does_not_wait_for_work_that_is_given_up_and_asks_nobody(told, between):
    told.worker.submit("first")
    assert told.begun["first"].wait(PATIENCE)
    for request in (*between, "second"):
        told.worker.submit(request)
    told.gates["second"].set()
    assert told.ended["second"].wait(PATIENCE)
    assert told.outcome == {"second": "done"}, "while the first goes on"


def test_work_that_is_given_up_is_not_heard_of_any_more(told):
    told.worker.submit("first")
    assert told.begun["first"].wait(PATIENCE)
    told.worker.submit(None)
    assert told.quiet.wait(PATIENCE), "nothing is going on, though the first has not noticed"
    told.gates["first"].set()
    assert told.ended["first"].wait(PATIENCE)
    told.close()
    assert (told.outcome, told.failures) == ({"first": "given up"}, [])
    assert "first" not in told.reports


def test_work_goes_on_for_a_request_that_wants_it(told):
    told.worker.submit("first")
    assert told.begun["first"].wait(PATIENCE)
    told.worker.submit("first")
    told.gates["first"].set()
    assert told.ended["first"].wait(PATIENCE)
    assert told.outcome == {"first": "done"}
    assert len(told.worker._threads) == 1
