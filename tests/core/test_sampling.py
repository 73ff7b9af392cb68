import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    DiffusionDistance,
    GeodesicDistance,
    ParameterError,
    VertexError,
    farthest_points,
)
from tests.shapes import bumpy, grid, two_pieces


def test_each_point_is_the_farthest_from_those_before():
    distance = BiharmonicDistance(bumpy(200))
    points = farthest_points(distance, start=7, count=12)
    assert points[0] == 7
    fields = distance.from_sources(points)
    for k in range(1, 12):
        nearest = fields[:, :k].min(axis=1)
        assert nearest[points[k]] == nearest.max()


def test_corners_of_a_square_come_first():
    points = farthest_points(GeodesicDistance(grid(6, 6), "dijkstra"), start=0, count=4)
    assert set(points) == {0, 6, 42, 48}


def test_stays_on_the_component_of_the_start():
    distance = BiharmonicDistance(two_pieces())
    assert set(farthest_points(distance, start=62, count=4)) == {61, 62, 63, 64}
    with pytest.raises(ParameterError, match="5 points asked for; the component of vertex 62 has 4"):
        farthest_points(distance, start=62, count=5)


def test_bad_starts_and_counts_are_refused():
    distance = BiharmonicDistance(two_pieces())
    with pytest.raises(VertexError, match="vertex 60"):
        farthest_points(distance, start=60)
    with pytest.raises(ParameterError, match="count is 0"):
        farthest_points(distance, count=0)


def test_is_the_same_every_time():
    first, second = (farthest_points(BiharmonicDistance(bumpy(200)), count=8) for _ in range(2))
    assert np.array_equal(first, second)


@pytest.mark.parametrize("make", [BiharmonicDistance, DiffusionDistance, lambda s: GeodesicDistance(s, "heat")])
def test_takes_any_distance(make):
    distance = make(bumpy(200))
    points = farthest_points(distance, start=150, count=5)
    fields = distance.from_sources(points)
    for k in range(1, 5):
        assert points[k] == fields[:, :k].min(axis=1).argmax()


def test_several_starts_come_first():
    distance = BiharmonicDistance(bumpy(200))
    points = farthest_points(distance, start=[7, 3, 90], count=6)
    assert points[:3].tolist() == [7, 3, 90]
    nearest = distance.from_sources(points[:3]).min(axis=1)
    assert points[3] == nearest.argmax()
    assert farthest_points(distance, start=[7, 3], count=2).tolist() == [7, 3]
    apart = BiharmonicDistance(two_pieces())
    for starts, said in [([0, 62], "one component"), ([3, 3], "different"), ([1, 2, 3], "3 starts"), ([], "0 starts")]:
        with pytest.raises(ParameterError, match=said):
            farthest_points(apart, start=starts, count=2)


def test_progress_is_reported_and_stops_it():
    distance, shares = BiharmonicDistance(bumpy(200)), []
    farthest_points(distance, count=5, progress=lambda share, _: shares.append(share))
    assert shares == sorted(shares)
    assert shares[-1] == 1

    def cancel(share, _):
        if share > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        farthest_points(distance, count=5, progress=cancel)


def test_points_are_chosen_among_some():
    distance, among = BiharmonicDistance(bumpy(200)), np.arange(200) % 2 == 0
    points = farthest_points(distance, start=7, count=12, among=among)
    assert points[0] == 7
    fields = np.where(among[:, None], distance.from_sources(points), -1)
    for k in range(1, 12):
        nearest = fields[:, :k].min(axis=1)
        assert nearest[points[k]] == nearest.max()
    with pytest.raises(ParameterError, match="the component of vertex 7 has 1"):
        farthest_points(distance, start=7, count=2, among=np.zeros(200, bool))
