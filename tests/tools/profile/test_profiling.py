"""The path of a profile, computed in the background: it follows its places."""

import queue
import threading

import pytest

from app.tools.profile import paths
from app.tools.profile.paths import PathWanted, PathWorker
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from tests.shapes import bumpy
from tests.waiting import PATIENCE


@pytest.fixture(scope="module")
def surface():
    return bumpy(400)


@pytest.fixture
def worker():
    told = queue.Queue()
    worker = PathWorker(lambda call: call(), lambda wanted, found: told.put((wanted, found)), lambda text: None)
    worker.told = told
    yield worker
    worker.close()


def until(worker, wanted, method):
    """All that is told until the path of what is wanted, made this way, is."""
    seen = []
    while not seen or seen[-1][0] is not wanted or getattr(seen[-1][1], "method", "") != method:
        seen.append(worker.told.get(timeout=PATIENCE))
    return seen


def test_paths_follow_their_places_and_are_exact(worker, surface):
    for vertex in (201, 202, 203):
        moved = PathWanted(surface, (3, vertex), "auto")
        worker.ask(moved)
        ((_, found),) = until(worker, moved, "exact")
        assert found.points[-1] == pytest.approx(surface.vertices[vertex])
    assert found.length == pytest.approx(GeodesicPaths(surface).path([3, 203], "exact").length, rel=1e-12)


def test_a_path_that_takes_long_is_given_up_for_the_next(worker, surface, monkeypatch):
    begun, make = threading.Event(), worker._maker.path

    def slow(wanted, progress):
        while wanted.places[1] == 200:
            begun.set()
            progress(0.5, "path")
        return make(wanted, progress)

    monkeypatch.setattr(paths, "SLOW_PATH_S", 0.0)
    monkeypatch.setattr(worker._maker, "path", slow)
    worker.ask(PathWanted(surface, (3, 200), "exact"))
    assert begun.wait(PATIENCE)
    last = PathWanted(surface, (3, 201), "exact")
    worker.ask(last)
    assert [wanted for wanted, _ in until(worker, last, "exact")] == [last]


def test_a_newer_place_does_not_keep_paths_from_being_told(worker, surface):
    for k in range(20):
        last = PathWanted(surface, (3, 100 + k), "exact")
        worker.ask(last)
    seen = until(worker, last, "exact")
    # In their order, and none of another way.
    ends = [wanted.places[1] for wanted, _ in seen]
    assert ends == sorted(ends)
    other = PathWanted(surface, (3, 119), "edges")
    worker.ask(other)
    assert [found.method for _, found in until(worker, other, "edges")] == ["edges"]


def test_what_fails_is_told_only_while_it_is_wanted(worker, surface):
    wrong = PathWanted(surface, (3, 3), "auto")
    worker.ask(wrong)
    wanted, said = worker.told.get(timeout=PATIENCE)
    assert wanted is wrong
    assert "3" in said
    worker.ask(PathWanted(surface, (3, 3), "edges"))
    right = PathWanted(surface, (3, 5), "edges")
    worker.ask(right)
    assert until(worker, right, "edges")[-1][1].length > 0
    worker.ask(None)
