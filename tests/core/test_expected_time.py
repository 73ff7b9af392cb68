"""How long work is expected to take: what is said of it, and that the machine's own speed is learned."""

import time

import pytest

from bihdist_core import GeodesicDistance, expected_time
from bihdist_core.distances.exact_geodesic import ExactGeodesic, expected_windows
from bihdist_core.expected_time import Expected, duration_in, duration_words, expected_seconds
from bihdist_core.progress import part, silent
from bihdist_core.solver.factor import share_of_ordering
from tests.shapes import bumpy, grid


@pytest.fixture(autouse=True)
def fresh(monkeypatch):
    monkeypatch.setattr(expected_time, "_slowness", 1.0)
    monkeypatch.setitem(expected_time.SECONDS, "factor", 1e-3)


def told(work, text="Factoring the matrix", cores=1):
    texts = []
    with Expected("factor", work, cores, lambda fraction, text: texts.append(text)) as it:
        it.progress(0.5, text)
    return texts


def test_a_duration_is_as_exact_as_a_guess_may_be():
    seconds = (9.9, 10, 44, 94, 96, 30 * 60, 5000, 6000, 90_000)
    words = ["", "10 s", "40 s", "90 s", "2 min", "30 min", "83 min", "2 h", "25 h"]
    assert [duration_words(each) for each in seconds] == [f"about {each}" if each else "" for each in words]


def test_long_work_says_in_its_progress_how_long_it_is_expected_to_take():
    assert told(9_000) == ["Factoring the matrix"]
    assert told(41_000) == ["Factoring the matrix: about 40 s"]
    assert told(41_000, "eigenpairs: solving") == ["eigenpairs: about 40 s"]
    assert told(82_000, cores=2) == ["Factoring the matrix: about 40 s"]
    assert duration_in("Factoring the matrix: about 40 s") == "about 40 s"
    assert duration_in("eigenpairs: solving") == duration_in("Factoring the matrix") == ""


def test_silence_stays_silent():
    for progress in (None, silent):
        assert Expected("factor", 1e9, 1, progress).progress is silent
    assert part(silent, 0, 1) is silent


def test_what_work_took_tells_of_the_machine_and_what_was_little_or_stopped_does_not(monkeypatch):
    now = 0.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    with Expected("factor", 1000, 2, None):
        now += 1.5  # instead of half a second
    assert expected_seconds("factor", 1000, 2) == pytest.approx(1.5)
    assert expected_seconds("ordering", 1e6) == pytest.approx(3e6 * expected_time.SECONDS["ordering"])
    with Expected("factor", 1e9, 1, None):
        now += expected_time.TELLING_S / 2
    with Expected("factor", 1, 1, None):
        now += 3600.0  # held up by something else
    stopped = Expected("factor", 1e9, 1, None)
    now += 1.0
    stopped.__exit__(KeyboardInterrupt)
    assert expected_seconds("factor", 1000, 2) == pytest.approx(1.5)
    with Expected("factor", 1e9, 1, None) as it:
        it.done = 1000  # less than expected
        now += 1.0
    assert expected_seconds("factor", 1000) == pytest.approx(1.0)


def test_the_share_of_the_ordering_falls_with_the_vertices_and_with_what_is_factored():
    few, many = share_of_ordering(10_000, False), share_of_ordering(1_000_000, False)
    assert 1 > few > many > share_of_ordering(1_000_000, True) > 0


def test_a_geodesic_field_is_expected_to_take_what_the_last_one_took(monkeypatch):
    monkeypatch.setitem(expected_time.SECONDS, "windows", 1.0)
    monkeypatch.setattr(expected_time, "TELLING_S", 1e9)
    exact, texts = ExactGeodesic(bumpy(30_000)), []
    assert expected_windows(exact) == exact.expected
    taken = exact.field(7).windows
    assert exact.expected == taken
    assert expected_windows(exact) == taken
    exact.field(7, progress=lambda _, text: texts.append(text))
    assert texts[-1] == f"exact geodesic: {duration_words(taken)}"
    # How long less than a whole one takes nobody knows.
    exact.field(7, progress=lambda _, text: texts.append(text), radius=0.1)
    assert texts[-1] == "exact geodesic"
    assert exact.expected == taken


def test_a_large_exact_geodesic_is_tried_before_its_first_field():
    surface = grid(320, 320)
    distance = GeodesicDistance(surface, "exact")
    expected = distance._solver._made[0].expected
    assert expected == pytest.approx(distance._solver._made[0].field(0).windows, rel=1)
