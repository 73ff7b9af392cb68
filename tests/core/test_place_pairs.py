"""Distances of pairs of places in faces: against dense points, and against faces that are divided there."""

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    GeodesicDistance,
    ParameterError,
    PowerDistance,
    SurfacePoint,
    VertexError,
)
from bihdist_core.distances.distance import Distance
from bihdist_core.sources.pieces import Pieces, pieces_of
from bihdist_core.sources.splitting import split_at
from tests.core.every_distance import BUMPY, SLACK, SMALL, every_distance, every_geodesic, every_quadratic, points
from tests.shapes import bumpy, two_pieces

AT = (
    5,
    SurfacePoint.of(17, 0.2, 0.5),
    SurfacePoint.of(40, 0.3, 0.3),
    77,
    SurfacePoint.of(17, 0.3, 0.7),
    SurfacePoint.of(90, 0.0, 1.0),
)


@every_quadratic
def test_squares_are_those_of_points_between_the_corners(make):
    of_vertices = points(make, BUMPY)
    pieces = [pieces_of(at, BUMPY) for at in AT]
    x = np.array([each.start[0] @ of_vertices[each.corners[0]] for each in pieces])
    expected = np.linalg.norm(x[:, None] - x, axis=2)
    slack = SLACK.get(make, SMALL)
    assert np.abs(make(BUMPY).pairwise(AT) - expected).max() <= slack * expected.max()


@every_distance
def test_a_matrix_has_what_pairs_have(make):
    distance = make(BUMPY)
    found = distance.pairwise(AT)
    assert (found == found.T).all()
    assert (np.diag(found) == 0).all()
    i, j = np.triu_indices(len(AT), 1)
    pairs = [(AT[a], AT[b]) for a, b in zip(i, j, strict=True)]
    assert np.abs(distance.of_pairs(pairs) - found[i, j]).max() <= 1e-9 * found.max()
    # Also of a distance that is not the same both ways, between a place and a vertex.
    for a, b in ((1, 2), (0, 1), (1, 0)):
        assert distance.between(AT[a], AT[b]) == pytest.approx(found[a, b], rel=1e-9)
    # Vertices among places have the numbers that they have alone; one corner with all the weight is a vertex.
    alone = pytest.approx(distance.of_pairs([[5, 77], [5, int(BUMPY.faces[90][1])]]), rel=1e-11)
    assert [distance.pairwise([5, "f17:0.2,0.5", 77])[0, 2], found[0, 5]] == alone


def test_exact_geodesics_are_those_of_the_divided_surface():
    distance = GeodesicDistance(BUMPY, "exact")
    places = [SurfacePoint.of(17, 0.2, 0.5), SurfacePoint.of(40, 0.3, 0.3), SurfacePoint.of(120, 0.1, 0.8)]
    pieces = _joined([pieces_of(place, BUMPY) for place in places])
    split = split_at(BUMPY, pieces.faces, pieces.start)
    divided, ids = split.surface, split.vertices
    expected = GeodesicDistance(divided, "exact").pairwise(ids)
    found = distance.pairwise(places)
    assert np.abs(found - expected).max() <= 1e-9 * expected.max()
    assert (found <= GeodesicDistance(BUMPY, "dijkstra").pairwise(places) * (1 + 1e-9)).all()


@every_geodesic
def test_progress_is_told_and_may_stop(make):
    distance, told = make(BUMPY), []
    distance.pairwise(AT, lambda share, text: told.append(share))
    assert len(told) > 1
    assert told == sorted(told)
    assert 0 <= told[0] < told[-1] <= 1

    def stop(share, text):
        raise Cancelled("enough")

    for ask in (distance.pairwise, lambda places, progress: distance.of_pairs([places[1:3]], progress)):
        with pytest.raises(Cancelled, match="enough"):
            ask(AT, stop)


@every_geodesic
def test_within_a_face_the_way_is_straight(make):
    one, other = SurfacePoint.of(17, 0.2, 0.5), SurfacePoint.of(17, 0.6, 0.3)
    x, y = (np.array(each.weights) @ BUMPY.vertices[BUMPY.faces[17]] for each in (one, other))
    assert make(BUMPY).between(one, other) == pytest.approx(np.linalg.norm(x - y), rel=1e-12)
    # Also to a corner of it.
    vertex = int(BUMPY.faces[17][0])
    found = make(BUMPY).of_pairs([(one, vertex)])[0]
    assert found == pytest.approx(np.linalg.norm(x - BUMPY.vertices[vertex]), rel=1e-12)


def test_the_heat_method_is_near_the_exact_one():
    places = [SurfacePoint.of(17, 0.2, 0.5), SurfacePoint.of(40, 0.3, 0.3), SurfacePoint.of(120, 0.1, 0.8)]
    finer = bumpy(2000)
    exact, heat = (GeodesicDistance(finer, method).pairwise(places) for method in ("exact", "heat"))
    assert np.abs(heat - exact).max() <= 0.05 * exact.max()  # 0.032, and 0.028 at the nearest vertices


def test_between_components_there_is_none():
    surface = two_pieces()
    other = int(np.flatnonzero(surface.component_of_vertex[surface.faces[:, 0]] == 1)[0])
    places = [SurfacePoint.of(0, 0.2, 0.5), SurfacePoint.of(other, 0.2, 0.5), SurfacePoint.of(other, 0.6, 0.2)]
    for distance in (BiharmonicDistance(surface), GeodesicDistance(surface, "dijkstra")):
        found = distance.pairwise(places)
        assert np.isnan(found[0, 1:]).all()
        assert found[1, 2] > 0


def test_what_is_no_pair_of_points_is_refused():
    distance = BiharmonicDistance(BUMPY)
    with pytest.raises(ParameterError, match="place in a face is one point; loop:0 is not"):
        distance.of_pairs([("loop:0", "f17:0.2,0.5")])
    with pytest.raises(ParameterError, match="two points"):
        distance.of_pairs([("f17:0.2,0.5", 3, 4)])
    with pytest.raises(ParameterError, match="no face 99999"):
        distance.pairwise([SurfacePoint.of(99999, 0.2, 0.5), 3])
    with pytest.raises(VertexError):
        distance.pairwise([SurfacePoint.of(17, 0.2, 0.5), 10**6])


def test_a_distance_of_vertices_only_says_so():
    class Own(PowerDistance):
        is_quadratic = False

    distance: Distance = Own(BUMPY, alpha=1.5)
    with pytest.raises(ParameterError, match="between vertices only"):
        distance.pairwise([SurfacePoint.of(17, 0.2, 0.5), 3])


def _joined(pieces):
    faces, corners, start, stop, along = (
        np.concatenate([getattr(each, name) for each in pieces])
        for name in ("faces", "corners", "start", "stop", "along")
    )
    return Pieces(faces, corners, start, stop, along)
