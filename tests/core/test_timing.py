"""Timings are processor times, judged by intervals; the clock on the wall decides nothing but the warning."""

import itertools

import numpy as np
import pytest
from scipy import stats

from bihdist_core import Laplacian
from bihdist_core.experiments import Parts, _claims_growth, table1, table2, timing
from bihdist_core.experiments.shapes import Shapes
from bihdist_core.experiments.timing import Time, busy, median, ratio_estimate, timed
from tests.shapes import bumpy


@pytest.fixture
def clocks(monkeypatch):
    """Clocks that a test sets: seconds of the processor and of the wall that pass from one look to the next."""

    def set_clocks(processor, wall):
        for name, steps in (("process_time", processor), ("perf_counter", wall)):
            times = itertools.accumulate(itertools.cycle(steps))
            monkeypatch.setattr(timing, name, lambda times=times: next(times))

    return set_clocks


def test_work_is_timed_by_both_clocks(clocks):
    clocks([2.0], [5.0])
    assert timed(lambda: "done") == ("done", Time(2.0, 5.0))
    assert Time(1, 2) + Time(3, 4) == Time(4, 6)
    assert Time(1, 2).times(3) == Time(3, 6)
    assert median([Time(1, 9), Time(5, 1), Time(2, 3)]) == Time(2, 3)


def test_a_ratio_has_the_students_interval_of_its_logarithms():
    rng = np.random.default_rng(0)
    above, below = (rng.uniform(1, 2, 7) for _ in range(2))
    found = ratio_estimate([Time(x, 100 * x) for x in above], [Time(x, 1) for x in below])
    logs = np.log(above / below)
    low, high = np.exp(stats.t.interval(0.95, 6, logs.mean(), stats.sem(logs)))
    assert (found.value, found.low, found.high) == pytest.approx((stats.gmean(above / below), low, high))
    assert found.count == 7
    # Paired: what slows both alike leaves the ratio as it is.
    slowed = rng.uniform(1, 3, 7)
    again = ratio_estimate([Time(x, 1) for x in above * slowed], [Time(x, 1) for x in below * slowed])
    assert (again.low, again.high) == pytest.approx((found.low, found.high))


def test_a_busy_computer_is_said_to_be_one(monkeypatch):
    monkeypatch.setattr(timing.os, "getloadavg", lambda: (1.0, 1.0, 1.0), raising=False)
    monkeypatch.setattr(timing.os, "cpu_count", lambda: 4)
    assert busy([Time(1.0, 1.02), Time(2.0, 2.1)]) == ""
    assert "took 1.50 times its processor time" in busy([Time(1.0, 1.5)])
    monkeypatch.setattr(timing.os, "getloadavg", lambda: (6.5, 1.0, 1.0), raising=False)
    assert "a load of 6.5 on 4 processors" in busy([Time(1.0, 1.02)])


@pytest.mark.parametrize("module", [table1, table2])
def test_verdicts_on_times_do_not_depend_on_the_wall(module, clocks, monkeypatch):
    monkeypatch.setattr(module, "QUICK_SIZES", (400, 500, 600))
    monkeypatch.setattr(table1, "JUDGED", 600)
    # What is timed takes no time of its own here.
    nothing = {
        table1: ("_columns", lambda *_: lambda ids: np.zeros((1, len(ids)))),
        table2: ("_set_up", lambda *_: lambda ids: None),
    }
    monkeypatch.setattr(module, *nothing[module])
    shapes = Shapes({"figure": bumpy(600)})
    processor = [1.0, 3.0, 2.0, 7.0, 4.0]
    numbers = []
    for wall in ([1.0], [50.0, 1.0, 300.0]):
        clocks(processor, wall)
        result = module.compute(shapes, quick=True)
        numbers.append([(claim.numbers, claim.verdict) for claim in result.claims])
    assert numbers[0] == numbers[1]
    # The last run waited for its processor.
    assert all("busy" in claim.warning for claim in result.claims)


def test_table1_is_not_judged_below_the_papers_largest_size(clocks, monkeypatch):
    monkeypatch.setattr(table1, "_columns", lambda *_: lambda ids: np.zeros((1, len(ids))))
    monkeypatch.setattr(table1, "QUICK_SIZES", (200, 300))
    clocks([1.0, 2.0, 7.0], [1.0])
    result = table1.compute(Shapes({"figure": bumpy(300)}), quick=True)
    claim = result.claims[0]
    assert (claim.verdict, claim.numbers, result.not_done) == (None, {}, ())
    assert claim.failure == "Not judged at this size, 300 vertices, but at 16,000."
    assert "at 300 vertices" in claim.note
    assert result.claims[1].numbers


def test_a_few_blocks_of_sources_stand_for_all(clocks):
    clocks([1.0], [1.0])
    # Blocks of 256, 256 and 20 of the 1,300 sources, and the set-up, a second each.
    assert table1.all_pairs(bumpy(1300), "Dijkstra").processor == pytest.approx(1 + 3 * 1300 / 532)
    # One block is all there is.
    for method in table1.METHODS:
        assert table1.all_pairs(bumpy(200), method).processor == pytest.approx(2)


def test_the_set_up_counts_for_every_subset(clocks):
    clocks([1.0], [1.0])
    for method in table2.METHODS:
        times = table2.subset_times(bumpy(200), [np.array([0, 5]), np.arange(9)], method)
        assert times == [Time(2, 2)] * 2


def test_the_cost_is_counted_and_its_times_are_the_processors(clocks, monkeypatch):
    monkeypatch.setattr(_claims_growth, "QUICK_SIZES", (300, 450, 600))
    shapes = Shapes({"figure": bumpy(600)})
    clocks([1.0], [40.0])
    made = _claims_growth.cost(shapes, "figure", True, Parts(), lambda *_: None)
    tables, claims = made.tables, made.claims
    assert tables[0].values("one column, processor seconds") == [1.0] * 3
    counts = np.array(tables[0].values("operations, factorization"), float)
    found = claims[0].numbers["exponent of N, operations of the factorization"]
    assert found.value == pytest.approx(np.polyfit(np.log([300, 450, 600]), np.log(counts), 1)[0])
    assert "busy" in claims[0].warning


def test_operations_of_one_front_are_those_of_a_dense_matrix():
    # So small a surface is one front: all its vertices are pivots, and it has no boundary.
    tree = Laplacian(bumpy(12)).components[0].tree()
    assert [size.tolist() for size in tree.sizes] == [[12], [0]]
    assert _claims_growth.operations(tree) == (2 * 12**3, 2 * 2 * 12**2)
