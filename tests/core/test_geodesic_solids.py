"""Exact geodesic distances on surfaces that are flat but at some points, against formulas in the plane.

From a vertex, a place in a face, a straight piece and a set of all three, at all vertices and at places in faces; and
the paths to them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np
import pytest

from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.sources.pieces import Pieces
from bihdist_core.surface import Surface
from tests.core.edge_ways import from_segment
from tests.shapes import divided, glued

ROUNDING = 1e-13
"""Of the largest distance: roundings of positions, and of some dozens of edges that a path crosses."""

PLACES = 30
JITTER = 0.2
"""Of a cell."""


@dataclass(frozen=True)
class Solid:
    """A surface, the coordinates (m, 3, d) of each face's corners in its chart, and distances by a formula.

    lengths(face, p, q, faces, y): (k,) of points y (k, d) in charts of faces (k,), from the segment between p and q
    (d,) in the chart of one.
    """

    surface: Surface
    charts: np.ndarray
    lengths: Callable[..., np.ndarray]

    def expected(self, sources, points, offsets):
        """(k,) from the nearest of some pieces, at which distances begin with offsets."""
        y = self.at(points.faces, points.start)
        ends = self.at(sources.faces, sources.start), self.at(sources.faces, sources.stop)
        each = [self.lengths(face, p, q, points.faces, y) for face, p, q in zip(sources.faces, *ends, strict=True)]
        return (np.array(each) + np.reshape(offsets, (-1, 1))).min(axis=0)

    def at(self, faces, weights):
        return np.einsum("kc,kcd->kd", weights, self.charts[faces])

    def pieces(self, faces, start, stop=None):
        stop = start if stop is None else stop
        return Pieces(faces, self.surface.faces[faces], start, stop, (start != stop).any(axis=1))

    def of_vertices(self):
        """All of them, in a face each."""
        face = np.zeros(len(self.surface.vertices), int)
        face[self.surface.faces.ravel()] = np.repeat(np.arange(len(self.surface.faces)), 3)
        return self.pieces(face, (self.surface.faces[face] == np.arange(len(face))[:, None]).astype(float))


def joined(*pieces):
    names = ("faces", "corners", "start", "stop", "along")
    return Pieces(*(np.concatenate([getattr(each, name) for each in pieces]) for name in names))


# ---------------------------------------------------------------------- how they are made
def cells(columns, rows, rng):
    """(m, 3, 2) lattice points of faces, each cell cut along any of its diagonals."""
    corner = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), -1).reshape(-1, 1, 2)
    squares = corner + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    turned = rng.random(len(squares)) < 0.5
    squares[turned] = np.roll(squares[turned], 1, axis=1)
    return np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])


def shifted(lattice, size, rng, straight=((), ()), jitter=JITTER):
    """The lattice points of a rectangle moved at random, but not off its sides, nor off some straight lines."""
    shift = rng.uniform(-jitter, jitter, (size[0] + 1, size[1] + 1, 2))
    shift[[0, -1]] = shift[:, [0, -1]] = 0
    shift[list(straight[0]), :, 0] = shift[:, list(straight[1]), 1] = 0
    return lattice + shift[lattice[..., 0], lattice[..., 1]]


# ---------------------------------------------------------------------- what they are
def box(sizes, counts, rng, jitter=JITTER):
    """Of six rectangles.  No way through faces turned into one plane is shorter than the shortest."""
    walls = list(product(range(3), (0, 1)))
    keys, charts = [], []
    for axis, side in walls:
        others = [a for a in range(3) if a != axis]
        cells_each = np.array(counts)[others]
        lattice = cells(*cells_each, rng)
        key, chart = (
            np.full((*lattice.shape[:2], 3), side * counts[axis]),
            np.full((*lattice.shape[:2], 3), float(side)),
        )
        key[..., others] = lattice
        chart[..., others] = shifted(lattice, cells_each, rng, jitter=jitter) / cells_each
        keys.append(key), charts.append(chart * sizes)
    wall_of_face = np.repeat(np.arange(6), [len(key) for key in keys])
    keys, charts = np.concatenate(keys), np.concatenate(charts)

    def lengths(face, p, q, faces, y):
        found = np.full(len(y), np.inf)

        def turn(rolled, wall, walls_left):
            """rolled: what brings points of a wall into the first one's plane."""
            here = wall_of_face[faces] == wall
            if here.any():
                found[here] = np.minimum(found[here], from_segment(rolled(y[here]), p, q))
            for other in walls_left:
                if walls[other][0] != walls[wall][0]:
                    turn(lambda z, f=wall, g=other: rolled(over_edge(z, f, g)), other, walls_left - {other})

        turn(lambda z: z, wall_of_face[face], set(range(6)) - {wall_of_face[face]})
        return found

    def over_edge(z, f, g):
        """Points of wall g, or of its plane, turned about its edge with f into the plane of f."""
        (a, side), (b, other) = walls[f], walls[g]
        turned = z.copy()
        turned[:, a] = side * sizes[a]
        turned[:, b] = other * sizes[b] + (2 * other - 1) * (side * sizes[a] - z[:, a]) * (2 * side - 1)
        return turned

    return Solid(glued(keys, charts), charts, lengths)


def fan(turns, sectors, k):
    """Sectors around an apex, of so many full turns: a cone, a disc or a saddle."""
    angle, azimuth = 2 * np.pi * turns / sectors, 2 * np.pi / sectors
    if turns <= 1:
        low = np.arccos(np.sqrt((1 - np.cos(angle)) / (1 - np.cos(azimuth))))
    else:
        low = np.arccos(np.sqrt((1 + np.cos(angle)) / (1 + np.cos(azimuth)))) * (-1.0) ** np.arange(sectors)
    at, low = azimuth * np.arange(sectors), low * np.ones(sectors)
    rim = np.stack([np.cos(low) * np.cos(at), np.cos(low) * np.sin(at), np.sin(low)], 1)
    ends = 1 + np.stack([np.arange(sectors), (np.arange(sectors) + 1) % sectors], 1)
    surface, weights = divided(
        np.concatenate([np.zeros((1, 3)), rim]), np.column_stack([np.zeros(sectors, int), ends]), k
    )
    charts = weights[..., 1:] / k @ np.array([[1, 0], [np.cos(angle), np.sin(angle)]])

    def lengths(face, p, q, faces, y):
        radius, sector = np.linalg.norm(y, axis=1), faces // k**2 - face // k**2
        found = radius + from_segment(np.zeros((1, 2)), p, q)
        along, size = q - p, max((q - p) @ (q - p), 1e-300)
        for image in range(-2, 3):
            turn = np.arctan2(y[:, 1], y[:, 0]) + angle * (sector + image * sectors)
            z = radius[:, None] * np.stack([np.cos(turn), np.sin(turn)], 1)
            foot = p + np.clip((z - p) @ along / size, 0, 1)[:, None] * along
            sees = np.abs(turn - np.arctan2(foot[:, 1], foot[:, 0])) < np.pi
            found = np.where(sees, np.minimum(found, np.linalg.norm(z - foot, axis=1)), found)
        return found

    return Solid(surface, charts, lengths)


def strip(closes, flips, is_ring, rng, scale=(1.1, 0.7)):
    """A rectangle whose left side may be joined to the right, and its lower side, upside down, to the upper.

    closes: left to right; is_ring: below to above; flips: with left and right exchanged.  It is folded flat where that
    makes it fit into space: a torus, a Klein bottle and a Moebius strip have their halves at one place.
    """
    columns, rows, corners = 6, 8, 4
    lattice = cells(columns, rows, rng)
    folds, bends = (3,) if closes or flips else (), range(0, rows, rows // corners) if is_ring else ()
    st = shifted(lattice, (columns, rows), rng, (folds, bends))
    i, j = lattice[..., 0], lattice[..., 1]
    over = is_ring & (j == rows)
    i = np.where(over & flips, columns - i, i)
    keys = np.stack([i % columns if closes else i, np.where(over, 0, j)], -1)
    charts, (s, t) = st * scale, np.moveaxis(st, 2, 0)
    y, z = t, 0 * t
    if is_ring:
        turn = 2 * np.pi / corners * np.arange(corners + 1)
        radius = rows / corners / 2 / np.sin(np.pi / corners)
        y, z = (np.interp(t, np.linspace(0, rows, corners + 1), radius * f(turn)) for f in (np.cos, np.sin))
    x = np.abs(s - 3) if closes or flips else s
    width, height = columns * scale[0], rows * scale[1]

    def lengths(face, p, q, faces, y):
        each = []
        for m, n in product(range(-2, 3) if closes else (0,), range(-2, 3) if is_ring else (0,)):
            s = width - y[:, 0] if flips and n % 2 else y[:, 0]
            each.append(from_segment(np.stack([s + m * width, y[:, 1] + n * height], 1), p, q))
        return np.min(each, axis=0)

    return Solid(glued(keys, np.stack([x * scale[0], y * scale[1], z * scale[1]], -1)), charts, lengths)


def disphenoid(p, q, r, k):
    """Of four equal triangles, every other corner of a box: the plane, where points are one that are point images of
    each other.  With r = 0 it is a rectangle on both sides."""
    vertices = np.array([[0, 0, 0], [p, q, 0], [p, 0, r], [0, q, r]], float)
    u = np.array([np.hypot(p, q), 0])
    x = (p * p) / u[0]
    v = np.array([x, np.sqrt(p * p + r * r - x * x)])
    faces = np.array([[0, 1, 2], [1, 2, 3], [0, 1, 3], [0, 2, 3]])
    plane = np.array([[0 * u, u, v], [u, v, u + v], [0 * u, u, u - v], [0 * u, v, v - u]])
    surface, weights = divided(vertices, faces, k)
    charts = weights / k @ np.repeat(plane, k * k, axis=0)

    def lengths(face, p, q, faces, y):
        images = product((1, -1), range(-3, 4), range(-3, 4))
        return np.min([from_segment(sign * y + 2 * m * u + 2 * n * v, p, q) for sign, m, n in images], axis=0)

    return Solid(surface, charts, lengths)


def frame(rng):
    """A rectangle with a rectangular hole, around whose corners paths bend."""
    low, high, size = np.array([3, 2]), np.array([5, 5]), (9, 7)
    lattice = cells(*size, rng)
    lattice = lattice[((lattice < low).any(axis=2) | (lattice > high).any(axis=2)).any(axis=1)]
    charts = shifted(lattice, size, rng, ((3, 5), (2, 5)))
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]], float)

    def is_free(p, q):
        """(k,) whether segments do not cross the hole; along its sides they do not."""
        way, inside = q - p, 1e-9
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = (np.stack([low + inside, high - inside])[:, None] - p) / way
        begins, stops = ends.min(axis=0), ends.max(axis=0)
        flat = np.abs(way) < inside
        between = (p > low + inside) & (p < high - inside)
        begins = np.where(flat, np.where(between, -np.inf, np.inf), begins).max(axis=1)
        stops = np.where(flat, np.where(between, np.inf, -np.inf), stops).min(axis=1)
        return np.maximum(begins, 0) >= np.minimum(stops, 1)

    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)
    round_ = np.abs(np.subtract.outer(np.cumsum(sides), np.cumsum(sides)))
    between = np.minimum(round_, sides.sum() - round_)

    def straight(z, y):
        return np.where(is_free(z, y), np.linalg.norm(z - y, axis=1), np.inf)

    def foot(y, p, q):
        way = q - p
        return p + np.clip((y - p) @ way / max(way @ way, 1e-300), 0, 1)[:, None] * way

    def lengths(face, p, q, faces, y):
        to_corners = (straight(foot(corners, p, q), corners)[:, None] + between).min(axis=0)
        ways = [to_corners[c] + straight(np.broadcast_to(corners[c], y.shape), y) for c in range(4)]
        return np.min([straight(foot(y, p, q), y), *ways], axis=0)

    return Solid(glued(lattice, np.concatenate([charts, 0 * charts[..., :1]], axis=2)), charts, lengths)


RNG = np.random.default_rng
SOLIDS = {
    "rectangle": lambda: strip(False, False, False, RNG(1)),
    "tube": lambda: strip(False, False, True, RNG(2)),
    "Moebius strip": lambda: strip(False, True, True, RNG(3)),
    "torus": lambda: strip(True, False, True, RNG(4)),
    "Klein bottle": lambda: strip(True, True, True, RNG(5)),
    "thin torus": lambda: strip(True, False, True, RNG(1), (1, 1e-3)),
    "torus as thin as a hair": lambda: strip(True, False, True, RNG(1), (1, 1e-5)),
    "frame": lambda: frame(RNG(6)),
    "cube": lambda: box((1, 1, 1), (4, 4, 4), RNG(7)),
    "the spider's room": lambda: box((30, 12, 12), (5, 3, 4), RNG(8)),
    "disphenoid": lambda: disphenoid(1, 1.3, 0.8, 6),
    "a rectangle's both sides": lambda: disphenoid(1, 1.3, 0, 5),
    **{f"fan of {turns} turns": lambda turns=turns: fan(turns, 8, 4) for turns in (0.1, 0.5, 0.8, 1, 1.2, 2, 3.5)},
}


@pytest.mark.parametrize("make", SOLIDS.values(), ids=SOLIDS)
def test_distances_and_paths_are_those_of_the_plane(make):
    solid, rng = make(), np.random.default_rng(9)
    surface, solver = solid.surface, ExactGeodesic(solid.surface)
    weights = rng.dirichlet([1, 1, 1], PLACES)
    weights[:5, 0] = 0  # on edges
    weights[:5] /= weights[:5].sum(axis=1, keepdims=True)
    places = solid.pieces(rng.integers(len(surface.faces), size=PLACES), weights)
    vertices = solid.of_vertices()
    targets = joined(vertices, places)
    line = solid.pieces(rng.integers(len(surface.faces), size=1), *rng.dirichlet([1, 1, 1], (2, 1)))
    some = joined(places.select(np.array([7])), line, vertices.select(np.array([11])))
    single = [vertices.select(rng.integers(len(vertices), size=1)) for _ in range(2)]
    questions = [(sources, np.zeros(len(sources))) for sources in (*single, some.select([0]), line, some)]
    size = solid.expected(some, targets, np.zeros(3)).max()
    for sources, offsets in (*questions, (some, rng.uniform(0, 0.2 * size, 3))):
        expected = solid.expected(sources, targets, offsets)
        ids = sources.vertices
        field = solver.field(sources if ids is None else ids, places, offsets=offsets)
        found = np.concatenate([field.distances, field.at_places])
        assert np.abs(found - expected).max() < ROUNDING * expected.max()
        slack, n = ROUNDING * expected.max(), len(vertices)
        chosen = np.flatnonzero(expected > slack + offsets.max())[:: 1 + len(targets) // 12].tolist()
        paths = [field.path(k) if k < n else field.path_to_place(k - n) for k in chosen]
        ends = solid.pieces(*(np.array([getattr(path, name)[-1] for path in paths]) for name in ("faces", "ends")))
        begun = solid.expected(sources, ends, offsets)
        assert np.abs(begun[:, None] - offsets).min(axis=1).max() < slack
        for path, k, offset in zip(paths, chosen, begun, strict=True):
            check_path(solid, path, targets.select([k]), slack)
            assert abs(length(solid.surface, path) + offset - expected[k]) < slack


def ends_of(surface, path):
    """(p, 3) twice, where its pieces begin and end."""
    corners = surface.vertices[surface.faces[path.faces]]
    return [np.einsum("kc,kcx->kx", weights, corners) for weights in (path.begins, path.ends)]


def length(surface, path):
    begins, ends = ends_of(surface, path)
    return np.linalg.norm(ends - begins, axis=1).sum()


def check_path(solid, path, target, slack):
    """It begins at the target, and goes on from face to face at points that both share."""
    corners, (begins, ends) = solid.surface.faces[path.faces], ends_of(solid.surface, path)
    for weights in (path.begins, path.ends):
        assert weights.min() > -ROUNDING
        assert np.abs(weights.sum(axis=1) - 1).max() < ROUNDING
    assert np.linalg.norm(begins[0] - target.positions(solid.surface.vertices)[0]) < slack
    assert np.abs(begins[1:] - ends[:-1]).max(initial=0) < slack
    for k in range(len(corners) - 1):
        shared = set(corners[k]) & set(corners[k + 1])
        assert set(corners[k][path.ends[k] > ROUNDING]) <= shared
        assert set(corners[k + 1][path.begins[k + 1] > ROUNDING]) <= shared


def test_the_spider_goes_forty_feet():
    """Over five of the six walls (H. E. Dudeney, 1903)."""
    solid = box((30, 12, 12), (1, 2, 12), RNG(0), jitter=0)
    spider, fly = (int(np.linalg.norm(solid.surface.vertices - at, axis=1).argmin()) for at in ([0, 6, 11], [30, 6, 1]))
    assert ExactGeodesic(solid.surface).distances(spider)[fly] == pytest.approx(40, abs=1e-12)
