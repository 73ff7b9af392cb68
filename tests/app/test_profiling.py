"""The path of a profile, computed in the background: it follows its places, and is exact once they rest."""

import queue

import pytest

from app.tools.profile import paths
from app.tools.profile.paths import PathWanted, PathWorker
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from tests.shapes import bumpy


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
        seen.append(worker.told.get(timeout=60))
    return seen


def test_paths_follow_their_places_and_are_exact_at_rest(worker, surface, monkeypatch):
    first = PathWanted(surface, (3, 200), "auto")
    worker.ask(first)
    assert [found.method for _, found in until(worker, first, "exact")] == ["exact"]
    monkeypatch.setattr(paths, "REST", 60.0)  # longer than this test: nothing rests but the last
    for vertex in (201, 202, 203):
        moved = PathWanted(surface, (3, vertex), "auto")
        worker.ask(moved)
        ((_, found),) = until(worker, moved, "straightened")
        assert found.points[-1] == pytest.approx(surface.vertices[vertex])
    monkeypatch.setattr(paths, "REST", 0.01)
    last = PathWanted(surface, (3, 204), "auto")
    worker.ask(last)
    *_, (_, found) = until(worker, last, "exact")
    assert found.length == pytest.approx(GeodesicPaths(surface).path([3, 204], "exact").length, rel=1e-12)


def test_a_newer_place_does_not_keep_paths_from_being_told(worker, surface):
    for k in range(20):
        last = PathWanted(surface, (3, 100 + k), "straightened")
        worker.ask(last)
    seen = until(worker, last, "straightened")
    # In their order, and none of another way.
    ends = [wanted.places[1] for wanted, _ in seen]
    assert ends == sorted(ends)
    other = PathWanted(surface, (3, 119), "edges")
    worker.ask(other)
    assert [found.method for _, found in until(worker, other, "edges")] == ["edges"]


def test_what_fails_is_told_only_while_it_is_wanted(worker, surface):
    wrong = PathWanted(surface, (3, 3), "auto")
    worker.ask(wrong)
    wanted, said = worker.told.get(timeout=60)
    assert wanted is wrong
    assert "3" in said
    worker.ask(PathWanted(surface, (3, 3), "edges"))
    right = PathWanted(surface, (3, 5), "edges")
    worker.ask(right)
    assert until(worker, right, "edges")[-1][1].length > 0
    worker.ask(None)
