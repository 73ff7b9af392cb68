"""Laws of exact geodesic distances, from vertices, places in faces and straight pieces, on surfaces of all kinds."""

import numpy as np
import pytest

from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.sources.pieces import Pieces
from bihdist_core.surface import Surface
from tests.shapes import bumpy, divided, fin, needles, torus

ROUNDING = 1e-13
"""Of the largest distance: some hundred roundings along a path."""

PLACES = 20


def moebius():
    """A strip of one side with a face more on each inner edge, so that all of these have three."""
    turn = np.pi * np.arange(13)[:, None] / 6
    across = np.array([-0.4, 0.4])
    radius = 1 + across * np.cos(turn / 2)
    x = np.stack([radius * np.cos(turn), radius * np.sin(turn), across * np.sin(turn / 2)], 2)[:-1].reshape(-1, 3)
    a = np.arange(12)
    over = a == 11
    low, high = np.where(over, 1, 2 * a + 2), np.where(over, 0, 2 * a + 3)
    faces = np.concatenate([np.stack(each, 1) for each in ((2 * a, low, high), (2 * a, high, 2 * a + 1))])
    fins = np.stack([2 * a, 2 * a + 1, 24 + a], 1)
    return Surface(np.concatenate([x, 1.5 * x[::2] + [0, 0, 0.3]]), np.concatenate([faces, fins]), "finned strip")


SURFACES = [bumpy(80), torus(12, 7), fin(), moebius(), needles(bumpy(40), 1e-3, 7)]
every_surface = pytest.mark.parametrize("surface", SURFACES, ids=[surface.name for surface in SURFACES])


def places_on(surface, count=PLACES, seed=0):
    """Places in faces, the first three on edges."""
    rng = np.random.default_rng(seed)
    faces = rng.integers(len(surface.faces), size=count)
    weights = rng.dirichlet([1, 1, 1], count)
    weights[:3] = np.roll([[0, 0.25, 0.75]], 1, axis=1)
    return points(surface, faces, weights)


def points(surface, faces, weights):
    return Pieces(faces, surface.faces[faces], weights, weights, np.zeros(len(faces), bool))


def line_on(surface):
    return Pieces(
        np.array([2]), surface.faces[[2]], np.array([[0.7, 0.2, 0.1]]), np.array([[0.1, 0.3, 0.6]]), np.ones(1, bool)
    )


def fields(surface, places, sources):
    """(s, n + k) from each of some sources to all vertices and places."""
    solver = ExactGeodesic(surface)
    found = [solver.field(source, places) for source in sources]
    return np.array([np.concatenate([field.distances, field.at_places]) for field in found])


def error(found, expected):
    return np.abs(found - expected).max() / np.abs(expected).max()


@every_surface
def test_a_metric_of_vertices_and_places(surface):
    n, places = len(surface.vertices), places_on(surface)
    some = np.arange(0, n, -(-n // 15))
    d = fields(surface, places, [*some, *(places.select(np.array([k])) for k in range(PLACES))])
    d = d[:, [*some, *range(n, n + PLACES)]]
    slack = ROUNDING * d.max()
    assert np.abs(d - d.T).max() < slack
    assert np.abs(np.diag(d)).max() < slack
    assert (d <= (d[:, :, None] + d[None]).min(axis=1) + slack).all()
    columns = ExactGeodesic(surface).columns(some)
    assert np.array_equal(columns[some].T, d[: len(some), : len(some)])


@every_surface
def test_between_straight_lines_and_edges_and_never_steeper_than_an_edge(surface):
    ids = np.array([1, len(surface.vertices) // 2])
    for sources in (ids[:1], ids):
        d = ExactGeodesic(surface).distances(sources)
        slack = ROUNDING * d.max()
        straight = np.linalg.norm(surface.vertices[:, None] - surface.vertices[sources], axis=2).min(axis=1)
        assert (straight <= d + slack).all()
        assert (d <= EdgeGeodesic(surface).distances(sources).min(axis=1) + slack).all()
    i, j = surface.edges.T
    lengths = np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)
    for row in fields(surface, places_on(surface), [places_on(surface).select(np.array([5])), line_on(surface), ids]):
        assert (np.abs(row[i] - row[j]) <= lengths + slack).all()


@every_surface
@pytest.mark.parametrize("k", [2, 3])
def test_smaller_faces_change_nothing(surface, k):
    """Each face cut into k x k of its own plane; distances at the new vertices are those at places of the old faces."""
    fine, weights = divided(surface.vertices, surface.faces, k)
    face, corner = np.divmod(np.unique(fine.faces, return_index=True)[1], 3)
    places = points(surface, face // k**2, weights[face, corner] / k)
    small, at, which = np.nonzero(weights == k)
    of_old = np.empty(len(surface.vertices), int)
    of_old[surface.faces[small // k**2, which]] = fine.faces[small, at]
    source = len(surface.vertices) // 3
    coarse = fields(surface, places, [source, [0, source]])
    for row, sources in zip(coarse, (of_old[source], of_old[[0, source]]), strict=True):
        found = ExactGeodesic(fine).distances(sources)
        assert error(found, row[len(of_old) :]) < ROUNDING
        assert error(found[of_old], row[: len(of_old)]) < ROUNDING


@every_surface
def test_scales_like_length_and_neither_motion_nor_numbers_change_it(surface, monkeypatch):
    rng, n = np.random.default_rng(3), len(surface.vertices)
    places = places_on(surface)

    def sources(places, line, order):
        return [int(order[2]), order[[0, 5]], places.select(np.array([4])), line]

    expected = fields(surface, places, sources(places, line_on(surface), np.arange(n)))
    assert np.array_equal(
        fields(
            Surface(surface.vertices * 2.0**-40, surface.faces), places, sources(places, line_on(surface), np.arange(n))
        ),
        expected * 2.0**-40,
    )
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    for scale, x in (
        (1e-8, surface.vertices * 1e-8),
        (1e8, surface.vertices * 1e8),
        (1, surface.vertices @ turn),
        (1, surface.vertices + 0.5),
    ):
        found = fields(Surface(x, surface.faces), places, sources(places, line_on(surface), np.arange(n)))
        assert error(found, expected * scale) < ROUNDING
    order, turned = rng.permutation(n), rng.permutation(len(surface.faces))
    number = np.argsort(order)
    shuffled = Surface(surface.vertices[order], np.roll(number[surface.faces][turned], 1, axis=1))
    face = np.argsort(turned)

    def moved(pieces):
        start, stop = (np.roll(weights, 1, axis=1) for weights in (pieces.start, pieces.stop))
        faces = face[pieces.faces]
        return Pieces(faces, shuffled.faces[faces], start, stop, pieces.along)

    expected = expected[:, [*order, *range(n, n + PLACES)]]
    for least in (10**6, 1):  # also in the order of space, as large ones are
        monkeypatch.setattr("bihdist_core.distances.unfolding_mesh.RENUMBERED_FROM", least)
        found = fields(shuffled, moved(places), sources(moved(places), moved(line_on(surface)), number))
        assert error(found, expected) < ROUNDING
