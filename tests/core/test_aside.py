"""Work in a process of its own: what comes back, what is told on the way, and that it ends."""

import os
import subprocess
import time

import numpy as np
import pytest

from bihdist_core import Cancelled, Laplacian, ParameterError, SolverError, laplacian
from bihdist_core.child_process import ChildProcess
from bihdist_core.solver import aside as aside_module, spectrum
from bihdist_core.solver.aside import _packed, aside
from bihdist_core.solver.spectrum import is_long
from bihdist_core.solver.worker_threads import without_workers
from tests.shapes import bumpy
from tests.waiting import PATIENCE


# ---------------------------------------------------------------------- what is done there
def doubled(x, progress):
    return {"x": 2 * x, "columns": np.asfortranarray(x.reshape(2, -1)), "process": os.getpid()}


def told_for_ever(progress):
    while True:
        progress(0.25, "on my way")
        time.sleep(0.01)


def silent_for_ever(progress):
    time.sleep(10_000)


def refused(progress):
    raise ParameterError("This cannot be.")


def gone(progress):
    os._exit(3)


@pytest.fixture
def children(monkeypatch):
    """The processes that are started."""
    started = []

    class Known(ChildProcess):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            started.append(self.process)

    monkeypatch.setattr(aside_module, "ChildProcess", Known)
    return started


# ---------------------------------------------------------------------- laws
def test_what_is_returned_there_comes_back_from_another_process(children):
    x = np.arange(100_000.0)
    found = aside(doubled, x)
    assert np.array_equal(found["x"], 2 * x)
    assert np.array_equal(found["columns"], x.reshape(2, -1))
    assert found["process"] == children[0].pid != os.getpid()
    found["x"][0] = 1  # an array of one's own, as if it had been made here
    assert children[0].poll() is not None, "it has ended"


def test_what_is_raised_there_is_raised_here(children):
    with pytest.raises(ParameterError, match=r"^This cannot be\.$"):
        aside(refused)
    assert children[0].poll() is not None


def test_a_process_that_dies_is_an_error_in_words():
    with pytest.raises(SolverError, match="A computation was lost: the process that computes it died"):
        aside(gone)


@pytest.mark.parametrize("error", [Cancelled, KeyboardInterrupt])
def test_what_the_progress_raises_ends_the_process_whatever_it_does(children, error):
    def progress(fraction, text):
        raise error

    with pytest.raises(error):
        aside(silent_for_ever, progress=progress)
    assert children[0].poll() is not None


def test_what_the_work_tells_is_told_here():
    told = []

    def progress(fraction, text):
        told.append((fraction, text))
        if (0.25, "on my way") in told:
            raise Cancelled

    with pytest.raises(Cancelled):
        aside(told_for_ever, progress=progress)


def test_the_process_ends_with_its_parent():
    child = ChildProcess("bihdist_core.solver.aside")
    child.ask(_packed((silent_for_ever, ())))
    child.process.stdin.close()
    try:
        child.process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        pytest.fail("it goes on without its parent")
    finally:
        child.end()


def test_one_of_many_processes_starts_no_other(children):
    with without_workers():
        assert aside(doubled, np.zeros(2))["process"] == os.getpid()
    assert children == []


# ---------------------------------------------------------------------- eigenpairs
def test_eigenpairs_found_aside_are_those_found_here(children, monkeypatch):
    here = [Laplacian(bumpy(500)).components[0].spectrum(count) for count in (30, 60)]
    monkeypatch.setattr(laplacian, "is_long", lambda n, count: True)
    component = Laplacian(bumpy(500)).components[0]
    for mine, there in zip(here, [component.spectrum(30), component.spectrum(60)], strict=True):
        assert np.abs(there.eigenvalues - mine.eigenvalues).max() <= 1e-12 * mine.eigenvalues.max()
        assert there.eigenvectors.shape == mine.eigenvectors.shape
    assert len(children) == 2, "the second goes on from the first"


def test_a_large_dense_matrix_is_no_work_of_this_process(monkeypatch):
    sizes, eigh = [], np.linalg.eigh
    monkeypatch.setattr(np.linalg, "eigh", lambda a: sizes.append(len(a)) or eigh(a))
    monkeypatch.setattr(spectrum, "LARGE", 200)
    found = Laplacian(bumpy(260)).components[0].spectrum(220)
    assert len(found.eigenvalues) == 220
    assert max(sizes, default=0) <= 200


@pytest.mark.parametrize(
    ("n", "count", "answer"),
    [(7000, 50, False), (7000, 200, True), (7000, 6999, True), (300, 299, False), (112_000, 20, False)],
)
def test_what_takes_long_steps_is_known_before(n, count, answer):
    assert is_long(n, count) is answer


def test_eigenpairs_given_up_leave_nothing_behind_and_can_be_asked_for_again(children, monkeypatch):
    monkeypatch.setattr(laplacian, "is_long", lambda n, count: True)
    component = Laplacian(bumpy(500)).components[0]

    def progress(fraction, text):
        if children:
            raise Cancelled

    with pytest.raises(Cancelled):
        component.spectrum(30, progress)
    assert children[0].poll() is not None
    assert len(component.spectrum(30).eigenvalues) == 30
