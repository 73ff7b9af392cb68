"""A lane's thread: what may be seen of it from outside."""

import os
import sys
import threading

import pytest

from app.session.lane import NICE, Lane


@pytest.mark.skipif(sys.platform != "linux", reason="threads have priorities of their own on Linux only")
def test_a_lane_and_the_threads_it_starts_stand_back():
    nice, done = [], threading.Event()

    def work(request, lane):
        def note():
            nice.append(os.getpriority(os.PRIO_PROCESS, threading.get_native_id()))

        started = threading.Thread(target=note)
        started.start()
        started.join()
        note()
        done.set()

    before = os.getpriority(os.PRIO_PROCESS, threading.get_native_id())
    lane = Lane("lane", work, lambda *_: None, lambda *_: None)
    lane.submit("anything")
    assert done.wait(10)
    lane.close()
    assert nice == [min(before + NICE, 19)] * 2
    assert os.getpriority(os.PRIO_PROCESS, threading.get_native_id()) == before
