"""The reference for exact geodesic distances, held to formulas, to laws, and to ways that bend on edges only at points
of a grid; and the meshes that are made to be hard."""

from decimal import Decimal
from fractions import Fraction
from itertools import combinations, product

import numpy as np
import pytest
from scipy.sparse.csgraph import csgraph_from_dense, dijkstra

from tests.core.edge_ways import coordinates, edge_ways, from_segment
from tests.core.geodesic_reference import CONTEXT, FacePoint, FaceSegment, GeodesicReference, Source
from tests.core.nasty_meshes import nasty_mesh, random_origin, random_weights
from tests.shapes import bumpy

ROUNDING = 1e-13
"""Of floats in the formulas."""

EXACT = Decimal("1e-40")
"""`SLIVER`, with room for what one of them becomes behind needles."""


def rectangle(columns, rows, place=lambda x, y: (x, y), holes=()):
    """Unit cells as the grid's coordinates x, y (n, 2), their vertices (n, d) at `place`, and faces (m, 3)."""
    flat = [(x, y) for y in range(rows + 1) for x in range(columns + 1)]
    faces = []
    for x, y in product(range(columns), range(rows)):
        if (x, y) not in holes:
            a, b = y * (columns + 1) + x, (y + 1) * (columns + 1) + x
            faces += [(a, a + 1, b + 1), (a, b + 1, b)] if (x + y) % 2 else [(a, a + 1, b), (a + 1, b + 1, b)]
    return np.array(flat, float), [place(x, y) for x, y in flat], np.array(faces)


def place_of(vertices, faces, point):
    """(d,) the coordinates of a place in a face."""
    return coordinates(np.asarray(vertices, float), faces, point.face, point.weights)


@pytest.mark.parametrize("seed", range(3))
def test_on_a_plane_distances_are_euclidean(seed):
    """On a grid, where many lines meet vertices, and on jittered ones with straight sides."""
    rng = np.random.default_rng(seed)
    _, vertices, faces = rectangle(5, 4)
    if seed:
        inner = np.arange(30)[:, None] % 6 % 5 > 0
        vertices = np.array(vertices) + np.where(inner, rng.integers(-99, 99, (30, 2)) / 512, 0)
        vertices[[*range(6), *range(24, 30)], 1] = [0] * 6 + [4] * 6
    reference, vertices = GeodesicReference(vertices, faces), np.array(vertices)
    points = [FacePoint(int(f), random_weights(rng)) for f in rng.integers(0, len(faces), 8)]
    everything = np.concatenate([vertices, [place_of(vertices, faces, point) for point in points]])
    for origin in (0, 14, points[0], FacePoint(3, (1, 0, 2)), FacePoint(5, (0, 1, 0))):
        x = place_of(vertices, faces, origin) if isinstance(origin, FacePoint) else vertices[origin]
        found = np.array(reference.distances([origin], points), float)
        np.testing.assert_allclose(found, np.linalg.norm(everything - x, axis=1), rtol=0, atol=ROUNDING)
    for _ in range(4):
        start, end = random_weights(rng), random_weights(rng)
        face = int(rng.integers(len(faces)))
        p, q = (place_of(vertices, faces, FacePoint(face, w)) for w in (start, end))
        found = np.array(reference.distances([FaceSegment(face, start, end)], points), float)
        np.testing.assert_allclose(found, from_segment(everything, p, q), rtol=0, atol=ROUNDING)


def test_segments_along_edges():
    flat, vertices, faces = rectangle(4, 4)
    reference = GeodesicReference(vertices, faces)
    for face, corner in product(range(len(faces)), range(3)):
        weights = np.roll([[0, 0.25, 0.75], [0, 1, 0]], corner, axis=1).tolist()
        p, q = (place_of(vertices, faces, FacePoint(face, w)) for w in weights)
        found = np.array(reference.distances([FaceSegment(face, *weights)]), float)
        np.testing.assert_allclose(found, from_segment(flat, p, q), rtol=0, atol=ROUNDING)


def test_the_nearest_source_counts_with_its_offset():
    _, vertices, faces = rectangle(4, 3)
    reference = GeodesicReference(vertices, faces)
    place, segment = FacePoint(9, (0.25, 0.25, 0.5)), FaceSegment(20, (1, 0, 0), (0, 1, 0))
    origins, offsets, point = [0, place, segment], [1.5, 0.5, 0.0], FacePoint(4, (0.5, 0.25, 0.25))
    single = [np.array(reference.distances([origin], [point]), float) for origin in origins]
    offered = np.stack(single, 1) + offsets
    found = reference.distances([Source(*each) for each in zip(origins, offsets, strict=True)], [point])
    np.testing.assert_allclose(np.array(found, float), offered.min(axis=1), rtol=0, atol=ROUNDING)
    assert set(offered.argmin(axis=1)) == {0, 1, 2}


def test_around_a_hole():
    """By the corners of the hole, where the straight line would cross it."""
    flat, vertices, faces = rectangle(5, 5, holes=list(product((2,), (1, 2, 3))))
    reference = GeodesicReference(vertices, faces)
    corners = np.array([(2, 1), (3, 1), (3, 4), (2, 4)], float)

    def is_free(p, q):
        low, high = 0.0, 1.0  # the part of the segment in the open box
        for x, y, least, most in zip(p, q, corners[0], corners[2], strict=True):
            if x == y:
                if not least < x < most:
                    return True
            else:
                s, t = sorted([(least - x) / (y - x), (most - x) / (y - x)])
                low, high = max(low, s), min(high, t)
        return high - low < 1e-12

    nodes = np.concatenate([flat, corners])
    straight = [[np.linalg.norm(p - q) if is_free(p, q) else np.inf for p in nodes] for q in nodes]
    expected = dijkstra(csgraph_from_dense(np.array(straight), null_value=np.inf))
    used = np.unique(faces)
    for v in (0, 8, 13, 19):
        found = np.array(reference.distances([v]), float)
        np.testing.assert_allclose(found[used], expected[v, used], rtol=0, atol=ROUNDING)
    assert (expected[13, used] > np.linalg.norm(flat[used] - flat[13], axis=1) + 0.1).any()


def box(a, b, c):
    vertices = np.array(list(product((0, a), (0, b), (0, c))), float)
    squares = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
    return vertices, np.array([face for p, q, r, s in squares for face in ((p, q, r), (p, r, s))])


def at(vertices, faces, place):
    """The place in a face at coordinates (3,)."""
    for f, face in enumerate(faces):
        weights, miss, *_ = np.linalg.lstsq(np.vstack([vertices[face].T, np.ones(3)]), np.append(place, 1), rcond=None)
        if miss.sum() < 1e-20 and weights.min() > -1e-12:
            return FacePoint(f, tuple(np.maximum(weights, 0).tolist()))
    raise AssertionError(f"no face has {place}")


def test_boxes():
    cube = GeodesicReference(*box(1, 1, 1))
    expected = np.sqrt([0, 1, 1, 2, 1, 2, 2, 5])
    np.testing.assert_allclose(np.array(cube.distances([0]), float), expected, rtol=0, atol=ROUNDING)
    assert abs(cube.distances([0])[7] - Decimal(5).sqrt(CONTEXT)) < EXACT
    assert float(GeodesicReference(*box(1, 1, 2)).distances([0])[7]) == pytest.approx(8**0.5, abs=ROUNDING)
    # The spider and the fly (H. E. Dudeney, 1903): over five of the six walls.
    room = box(30, 12, 12)
    spider, fly = at(*room, (0, 6, 11)), at(*room, (30, 6, 1))
    assert float(GeodesicReference(*room).distances([spider], [fly])[-1]) == pytest.approx(40, abs=1e-12)


@pytest.mark.parametrize("rise", [0.0, 0.4, 2.5])
def test_fans_around_a_vertex(rise):
    """Cones and saddles: a chord where the angle is below 180 degrees on one side, else by the apex."""
    for zigzag in (False, True):
        turn = 2 * np.pi * np.arange(10) / 10
        height = rise * np.where(np.arange(10) % 2 & zigzag, -1, 1)
        rim = np.stack([np.cos(turn), np.sin(turn), height], 1)
        vertices = np.vstack([[0, 0, 0], rim])
        faces = [(0, k + 1, (k + 1) % 10 + 1) for k in range(10)]
        radius = np.hypot(1, rise)
        angle = 2 * np.arcsin(np.linalg.norm(rim[1] - rim[0]) / radius / 2)
        steps = np.minimum(np.arange(10), 10 - np.arange(10))
        expected = np.where(steps * angle < np.pi, 2 * radius * np.sin(steps * angle / 2), 2 * radius)
        found = np.array(GeodesicReference(vertices, faces).distances([1]), float)
        np.testing.assert_allclose(found[1:], expected, rtol=0, atol=1e-12)


def test_a_book_of_pages():
    """From page to page as if both were the two halves of a plane; points of the spine are on all of them."""
    page, _, cells = rectangle(2, 4)
    spine = page[:, 0] == 0
    directions = np.array([(1, 0), (0, 1), (-1, 0), (1, 0), (0.6, 0.8)])  # two pages are at the same place
    vertices, faces, ids = [(0, y, 0) for y in page[spine, 1]], [], []
    for dx, dz in directions:
        new = np.where(spine, np.cumsum(spine) - 1, len(vertices) + np.cumsum(~spine) - 1)
        vertices += [(x * dx, y, x * dz) for x, y in page[~spine]]
        faces += new[cells].tolist()
        ids.append(new)
    reference = GeodesicReference(vertices, faces)
    for v in (1, 10):
        found = np.array(reference.distances([ids[1][v]]), float)
        for k, mirror in enumerate([-1, 1, -1, -1, -1]):
            expected = np.linalg.norm(page * [mirror, 1] - page[v], axis=1)
            np.testing.assert_allclose(found[ids[k]], expected, rtol=0, atol=ROUNDING)


def test_a_strip_folded_onto_itself():
    flat, vertices, faces = rectangle(6, 2, lambda x, y: (x % 2, y, 0))
    found = np.array(GeodesicReference(vertices, faces).distances([9]), float)
    np.testing.assert_allclose(found, np.linalg.norm(flat - flat[9], axis=1), rtol=0, atol=ROUNDING)


def test_a_flat_torus_in_four_dimensions():
    """The product of the outlines of two unit squares."""
    loop = [(0, 0), (1, 0), (1, 1), (0, 1)]
    vertices = [p + q for p, q in product(loop, loop)]
    faces = []
    for i, j in product(range(4), range(4)):
        a, b, c, d = (((i + k) % 4) * 4 + (j + m) % 4 for k, m in ((0, 0), (1, 0), (1, 1), (0, 1)))
        faces += [(a, b, c), (a, c, d)]
    reference = GeodesicReference(vertices, faces)
    place = np.array(list(product(range(4), range(4))))
    offset = np.abs(place - place[6])
    expected = np.linalg.norm(np.minimum(offset, 4 - offset), axis=1)
    np.testing.assert_allclose(np.array(reference.distances([6]), float), expected, rtol=0, atol=ROUNDING)
    # From a place and a segment of the torus, as of the plane with all its copies.
    x, y = np.array([0.5, 0.25]), np.array([0.75, 0.5])
    copies = (place[:, None] + 4 * np.array(list(product((-1, 0, 1), repeat=2)))).reshape(-1, 2)
    point, segment = FacePoint(0, (0.5, 0.25, 0.25)), FaceSegment(0, (0.5, 0.25, 0.25), (0.25, 0.25, 0.5))
    for origin, end in ((point, x), (segment, y)):
        expected = from_segment(copies, x, end).reshape(16, 9).min(axis=1)
        np.testing.assert_allclose(np.array(reference.distances([origin]), float), expected, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("gap", [0.0, 2.0**-120, -(2.0**-120)])
def test_faces_of_height_0_join_what_they_touch(gap):
    """A square whose left half has one edge at x = 0, its right half four: caps and a needle lie between them."""
    left = [(0, 0), (0, 4), (-4, 0), (-4, 4)]
    right = [(gap, 1), (gap, 2), (gap, 3), (4, 0), (4, 4), (0, 0)]
    vertices = np.array(left + right)
    halves = [(0, 1, 2), (2, 1, 3), (9, 4, 7), (4, 5, 7), (5, 6, 8), (5, 7, 8), (6, 1, 8)]
    between = [(0, 1, 5), (0, 5, 4), (5, 1, 6), (0, 9, 4)]
    faces = np.array(between + halves)
    reference = GeodesicReference(vertices, faces)
    points = [FacePoint(0, (0.25, 0.25, 0.5)), FacePoint(2, (0, 0.5, 0.5)), FacePoint(1, (0.5, 0.25, 0.25))]
    everything = np.concatenate([vertices, [place_of(vertices, faces, point) for point in points]])
    for origin in (*range(10), *points):
        x = place_of(vertices, faces, origin) if isinstance(origin, FacePoint) else vertices[origin]
        found = np.array(reference.distances([origin], points), float)
        np.testing.assert_allclose(found, np.linalg.norm(everything - x, axis=1), rtol=0, atol=ROUNDING)
    segment = FaceSegment(0, (0.5, 0.25, 0.25), (0.125, 0.75, 0.125))
    p, q = (place_of(vertices, faces, FacePoint(0, w)) for w in (segment.start, segment.end))
    found = np.array(reference.distances([segment], points), float)
    np.testing.assert_allclose(found, from_segment(everything, p, q), rtol=0, atol=ROUNDING)


def test_what_is_joined():
    """By faces, edges of length 0 and single vertices; not by being at one place, nor by faces with a vertex twice."""
    vertices = [(0, 0), (1, 0), (0, 1), (1, 0), (1, 1), (2, 0), (1, 1), (5, 5)]
    faces = [(0, 1, 2), (0, 2, 1), (1, 3, 1), (3, 5, 4), (3, 7, 3)]
    found = GeodesicReference(vertices, faces).distances([0])
    assert [float(d) for d in found] == [0, 1, 1, *[np.inf] * 5]
    found = GeodesicReference(vertices, [*faces, (6, 3, 1)]).distances([0])
    assert [float(d) for d in found[:4]] == [0, 1, 1, 1]
    assert [float(d) for d in found[4:]] == [1 + 1, 1 + 1, 1 + 1, np.inf]
    inside = [FacePoint(0, (1, 1, 1)), FacePoint(1, (1, 1, 1))]
    sheets = GeodesicReference(vertices, faces).distances([inside[0]], inside)
    assert [float(d) for d in sheets[-2:]] == pytest.approx([0, 2**0.5 / 3])  # by the middle of the longest edge


# ---------------------------------------------------------------------- laws, on meshes that are made to be hard
def split(vertices, faces, rng):
    """The surface in smaller faces, with exact coordinates: places in faces, and on edges, become vertices."""
    vertices = [[Fraction(c) for c in vertex] for vertex in vertices.tolist()]
    faces = [tuple(face) for face in faces.tolist()]

    def add(*parts):
        vertices.append([sum(w * vertices[v][k] for v, w in parts) for k in range(3)])
        return len(vertices) - 1

    for _ in range(6):
        i, j, k = faces.pop(rng.integers(len(faces)))
        new = add((i, Fraction(1, 3)), (j, Fraction(1, 6)), (k, Fraction(1, 2)))
        faces += [(i, j, new), (j, k, new), (k, i, new)]
        a, b, _ = rng.permutation(faces[rng.integers(len(faces))]).tolist()
        new = add((a, Fraction(1, 3)), (b, Fraction(2, 3)))
        for face in [face for face in faces if a in face and b in face]:
            faces.remove(face)
            faces += [tuple(new if v == end else v for v in face) for end in (a, b)]
    return vertices, faces


@pytest.mark.parametrize("seed", range(6))
def test_smaller_faces_change_nothing(seed):
    vertices, faces = nasty_mesh(seed, 30)
    rng = np.random.default_rng(seed)
    whole, parts = GeodesicReference(vertices, faces), GeodesicReference(*split(vertices, faces, rng))
    for v in rng.integers(0, len(vertices), 5):
        for d, e in zip(whole.distances([int(v)]), parts.distances([int(v)]), strict=False):
            assert d == e or abs(d - e) < EXACT


@pytest.mark.parametrize("seed", range(6))
def test_distances_are_symmetric_and_know_no_order(seed):
    vertices, faces = nasty_mesh(seed, 30)
    rng = np.random.default_rng(seed)
    points = [FacePoint(int(f), random_weights(rng)) for f in rng.integers(0, len(faces), 5)]
    n, reference = len(vertices), GeodesicReference(vertices, faces)
    matrix = [reference.distances([v], points) for v in [*range(n), *points]]
    for i, j in combinations(range(n + 5), 2):
        assert matrix[i][j] == matrix[j][i] or abs(matrix[i][j] - matrix[j][i]) < EXACT
    order = rng.permutation(n)
    turned = np.array([rng.permutation(np.argsort(order)[face]) for face in faces])
    again = GeodesicReference(vertices[order], rng.permutation(turned))
    for i in range(5):
        for d, j in zip(again.distances([i]), order, strict=True):
            assert d == matrix[order[i]][j] or abs(d - matrix[order[i]][j]) < EXACT


class Unpruned(GeodesicReference):
    """Follows all windows that have rays."""

    def _is_useless(self, window, bound):
        return super()._is_useless(window, [Decimal("Infinity")] * len(bound))


@pytest.mark.parametrize("seed", range(6))
def test_pruning_loses_nothing(seed):
    vertices, faces = nasty_mesh(seed, 14)
    rng = np.random.default_rng(seed)
    pruned, whole = GeodesicReference(vertices, faces), Unpruned(vertices, faces)
    for origin in [*range(len(vertices)), *(random_origin(rng, faces) for _ in range(6))]:
        for d, e in zip(pruned.distances([origin]), whole.distances([origin]), strict=True):
            assert d == e or abs(d - e) < EXACT


def test_ways_over_edges_come_close_from_above():
    """Most of them are as short; some stop at a vertex that a shorter one would go around."""
    excess = []
    for seed in range(8):
        vertices, faces = nasty_mesh(seed, 24)
        rng = np.random.default_rng(seed)
        origin = random_origin(rng, faces)
        points = [FacePoint(int(f), random_weights(rng)) for f in rng.integers(0, len(faces), 3)]
        found = np.array(GeodesicReference(vertices, faces).distances([origin], points), float)
        above = edge_ways(vertices, faces, origin, points)
        reached = np.isfinite(found)
        assert (np.isfinite(above) == reached).all()
        excess += (above[reached] - found[reached]).tolist()
    assert min(excess) > -ROUNDING
    assert np.quantile(excess, 0.8) < 1e-8
    assert max(excess) < 0.01


def test_what_pygeodesic_finds():
    geodesic = pytest.importorskip("pygeodesic.geodesic")
    for n in (20, 50):
        surface = bumpy(n, seed=n)
        expected, _ = geodesic.PyGeodesicAlgorithmExact(surface.vertices, surface.faces).geodesicDistances([3], None)
        found = np.array(GeodesicReference(surface.vertices, surface.faces).distances([3]), float)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("place", [FacePoint(2, (1, 1, 1)), FacePoint(-1, (1, 1, 1)), FacePoint(1, (1, 1, 1))])
def test_places_in_no_face_are_refused(place):
    with pytest.raises(ValueError, match=f"no face {place.face}"):
        GeodesicReference(np.eye(3), [(0, 1, 2), (0, 1, 0)]).distances([place])


@pytest.mark.parametrize("weights", [(1, 1), (0, 0, 0), (1, 1, -0.5)])
def test_weights_that_are_none_are_refused(weights):
    with pytest.raises(ValueError, match="no weights"):
        GeodesicReference(np.eye(3), [(0, 1, 2)]).distances([0], [FacePoint(0, weights)])


def test_hard_meshes_have_what_is_hard():
    found = set()
    for seed in range(6):
        vertices, faces = nasty_mesh(seed, 60, repeated=2)
        again = nasty_mesh(seed, 60, repeated=2)
        assert (vertices == again[0]).all()
        assert (faces == again[1]).all()
        proper = np.array([face for face in faces if len(set(face)) == 3])
        assert (len(faces), len(proper), faces.min() >= 0, faces.max() < len(vertices)) == (62, 60, True, True)
        assert len({frozenset(face) for face in proper.tolist()}) == 60
        edges = np.sort(np.concatenate([proper[:, :2], proper[:, 1:], proper[:, ::2]]), axis=1)
        ends, count = np.unique(edges, axis=0, return_counts=True)
        found |= {f"edge of {k} faces" for k in count}
        lengths = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
        found |= {"edge of length 0"} if (lengths == 0).any() else set()
        x = vertices[proper]
        area = np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1)
        height = area / np.maximum(np.ptp(x, axis=1).max(axis=1) ** 2, 1e-300)
        found |= {"height 0"} if (height == 0).any() else set()
        found |= {f"height 1e{k}" for k in np.log10(height[height > 0]).astype(int)}
        reached = np.isfinite(np.array(GeodesicReference(vertices, faces).distances([int(proper[0, 0])]), float))
        found |= {"components"} if not reached[proper].all() else set()
    wanted = {"edge of length 0", "height 0", "components", *(f"height 1e-{k}" for k in (1, 3, 6, 9, 11, 12))}
    assert found >= wanted | {f"edge of {k} faces" for k in (1, 2, 3, 4)}
