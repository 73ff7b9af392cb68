"""The path of a profile, computed in the background: it follows its places, and is exact once they rest."""

import queue

import pytest

from app.session import profiling
from app.session.profiling import PathLane, PathWanted
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from tests.shapes import bumpy


@pytest.fixture(scope="module")
def surface():
    return bumpy(400)


@pytest.fixture
def lane():
    told = queue.Queue()
    lane = PathLane(lambda call: call(), lambda wanted, found: told.put((wanted, found)), lambda text: None)
    lane.told = told
    yield lane
    lane.close()


def until(lane, wanted, method):
    """All that is told until the path of what is wanted, made this way, is."""
    seen = []
    while not seen or seen[-1][0] is not wanted or getattr(seen[-1][1], "method", "") != method:
        seen.append(lane.told.get(timeout=60))
    return seen


def test_paths_follow_their_places_and_are_exact_at_rest(lane, surface, monkeypatch):
    first = PathWanted(surface, (3, 200), "auto")
    lane.ask(first)
    assert [found.method for _, found in until(lane, first, "exact")] == ["exact"]
    monkeypatch.setattr(profiling, "REST", 60.0)  # longer than this test: nothing rests but the last
    for vertex in (201, 202, 203):
        moved = PathWanted(surface, (3, vertex), "auto")
        lane.ask(moved)
        ((_, found),) = until(lane, moved, "straightened")
        assert found.points[-1] == pytest.approx(surface.vertices[vertex])
    monkeypatch.setattr(profiling, "REST", 0.01)
    last = PathWanted(surface, (3, 204), "auto")
    lane.ask(last)
    *_, (_, found) = until(lane, last, "exact")
    assert found.length == pytest.approx(GeodesicPaths(surface).path([3, 204], "exact").length, rel=1e-12)


def test_a_newer_place_does_not_keep_paths_from_being_told(lane, surface):
    for k in range(20):
        last = PathWanted(surface, (3, 100 + k), "straightened")
        lane.ask(last)
    seen = until(lane, last, "straightened")
    # In their order, and none of another way.
    ends = [wanted.places[1] for wanted, _ in seen]
    assert ends == sorted(ends)
    other = PathWanted(surface, (3, 119), "edges")
    lane.ask(other)
    assert [found.method for _, found in until(lane, other, "edges")] == ["edges"]


def test_what_fails_is_told_only_while_it_is_wanted(lane, surface):
    wrong = PathWanted(surface, (3, 3), "auto")
    lane.ask(wrong)
    wanted, said = lane.told.get(timeout=60)
    assert wanted is wrong
    assert "3" in said
    lane.ask(PathWanted(surface, (3, 3), "edges"))
    right = PathWanted(surface, (3, 5), "edges")
    lane.ask(right)
    assert until(lane, right, "edges")[-1][1].length > 0
    lane.ask(None)
