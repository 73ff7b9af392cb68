"""Surfaces, factors and distances are freed as soon as nobody refers to them, without the garbage collector."""

import gc
import threading
import weakref
from contextlib import suppress

import numpy as np
import pytest

from bihdist_core import Cancelled, Laplacian, ParameterError, SolverError
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance_types import Spec
from bihdist_core.distances.heat_geodesic import TIME_FACTORS
from bihdist_core.distances.heat_times import HeatTimes
from bihdist_core.solver.aside import aside
from bihdist_core.solver.worker_threads import Job, side_by_side, without_workers
from bihdist_core.sources.source import checked_source
from tests.core.every_distance import every_distance
from tests.garbage import garbage_of
from tests.shapes import bumpy, two_pieces

SPECS = ("biharmonic", "truncated(k=20)", "power", "commute-time", "diffusion", "geodesic(method=exact)",
         "geodesic(method=heat)", "geodesic(method=dijkstra)")  # fmt: skip


def test_circles_are_found():
    class Owner:
        pass

    Owner.__module__ = "bihdist_core.nowhere"

    def circle():
        owner = Owner()
        owner.itself = owner

    assert list(garbage_of(circle)) == ["bihdist_core.nowhere:test_circles_are_found.<locals>.Owner"]
    assert not garbage_of(Owner)


@every_distance
def test_a_factor_is_freed_with_the_last_distance(make):
    gc.disable()
    try:
        with without_workers():  # whose threads may hold what they have done a moment longer
            laplacian = Laplacian(bumpy(300))
            component = laplacian.components[0]
            of_factor = weakref.ref(component.factor(diagonals=True))
            of_surface = weakref.ref(laplacian.surface)
            distance = make(laplacian)
            distance.from_sources([0, 5])
            _ = distance.accuracy
            del laplacian, component, distance
        assert of_factor() is None
        assert of_surface() is None
    finally:
        gc.enable()


@pytest.mark.parametrize("words", SPECS)
@pytest.mark.parametrize("shape", [bumpy(600), two_pieces()], ids=["one piece", "two pieces"])
def test_questions_leave_no_circles(words, shape):
    def ask():
        distances = Distances(Laplacian(shape))
        answer = distances.answer(Spec.parse(words), 3, at_once=lambda first: None)
        assert answer.field is not None
        distance = distances.get(Spec.parse(words))
        distance.from_sources(np.arange(40), lambda *_: None)
        distance.pairwise([1, 5, 9])
        distance.between(0, 5)
        for source in ("3+7", "f3:0.2,0.5"):
            distances.answer(Spec.parse(words), checked_source(source))
        distances.preview(Spec.parse(words))
        distances.keep([])

    assert not garbage_of(ask)


@pytest.mark.parametrize("words", SPECS)
@pytest.mark.parametrize("reports", [0, 1, 2, 4, 8, 16])
def test_cancelled_questions_leave_no_circles(words, reports, monkeypatch):
    monkeypatch.setattr("bihdist_core.expected_time.LONG_S", 0.0)  # all work says how long it takes

    def ask():
        distances, left = Distances(Laplacian(bumpy(600))), reports

        def cancel(fraction, text):
            nonlocal left
            left -= 1
            if left < 0:
                raise Cancelled("enough")

        with suppress(Cancelled):
            distances.answer(Spec.parse(words), 3, cancel)
        with suppress(Cancelled):
            distances.get(Spec.parse(words)).from_sources(np.arange(40), cancel)

    assert not garbage_of(ask)


class Failing:
    """Work on something large, which fails in a worker thread, and elsewhere waits for that."""

    __module__ = "bihdist_core.nowhere"

    def __init__(self):
        self.has_failed = threading.Event()

    def __call__(self, item):
        if threading.current_thread() is threading.main_thread():
            self.has_failed.wait()
            return
        self.has_failed.set()
        raise SolverError(f"no {item}")


def job():
    work = Failing()
    with pytest.raises(SolverError):
        Job(lambda *_: None, "working", 1).run(work, [1])


def side():
    work = Failing()
    with pytest.raises(SolverError):
        side_by_side(work, [1, 2])


def in_a_process():
    work = Laplacian(bumpy(60))
    with pytest.raises(ParameterError):
        aside(_fail, work)


def _fail(laplacian, progress):
    laplacian.check_eigenpairs(-1, 1)


def not_built():
    distances = Distances(Laplacian(bumpy(60)))
    for _ in range(2):
        with pytest.raises(ParameterError):
            distances.get(Spec.parse("truncated(k=1000)"))


def no_flow():
    class NoFlow(HeatTimes):
        def _flow(self, factor, progress):
            if factor == TIME_FACTORS[0]:
                return super()._flow(factor, progress)
            raise SolverError("no flow")

    component = Laplacian(bumpy(60)).components[0]
    times = NoFlow(component)
    times._times = list(TIME_FACTORS[1:])
    for _ in range(2):
        with pytest.raises(SolverError, match="no flow"):
            times.distances(0)


@pytest.mark.parametrize("fail", [job, side, in_a_process, not_built, no_flow], ids=lambda f: f.__name__)
def test_failures_leave_no_circles(fail, monkeypatch):
    monkeypatch.setattr("bihdist_core.solver.worker_threads.WORKERS", 2)  # also on a machine with one core
    assert not garbage_of(fail)
