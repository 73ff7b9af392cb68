"""The sample `part`: a spur gear as CAD programs tessellate it; millimetres, axis along z, the hub's foot on z = 0.

Degenerate faces have corners on their outlines only, walls and chamfers are strips of long triangles: angles go down to
about 0.8 degrees.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from scipy.spatial import Delaunay

from .domain import inside

TEETH, MODULE, PRESSURE_ANGLE = 32, 4.0, np.radians(20)

HUB, RIM, WEB = (0.0, 40.0), (8.0, 32.0), (16.0, 24.0)
"""Lowest and highest z."""

HUB_RADIUS, RIM_RADIUS = 26.0, 50.0
BORE_RADIUS, KEYWAY_WIDTH, KEYWAY_TOP = 13.0, 8.0, 16.5
BOLTS, BOLT_RADIUS, BOLT_CIRCLE = 6, 2.75, 20.0
WINDOWS, WINDOW_RADII, WINDOW_CORNER, RIB = 6, (31.0, 45.0), 4.0, 8.0
"""The web's lightening holes; the ribs between them are `RIB` wide."""

CHAMFER = 0.75

Ring = np.ndarray
"""(k,) ids of points at one height, the solid to the left as one goes round and looks down."""


def part() -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) points and (m, 3) faces, facing outwards."""
    solid = Solid()
    bevel = (CHAMFER, CHAMFER)
    teeth = solid.walls(_teeth(), RIM, bevel)
    rim = [solid.walls(_circle(RIM_RADIUS, 180)[::-1], heights) for heights in ((RIM[0], WEB[0]), (WEB[1], RIM[1]))]
    foot = solid.walls(_circle(HUB_RADIUS, 120), (HUB[0], WEB[0]), (CHAMFER, 0))
    head = solid.walls(_circle(HUB_RADIUS, 120), (WEB[1], HUB[1]), (0, CHAMFER))
    holes = [solid.walls(hole[::-1], HUB, bevel) for hole in (_bore(), *_bolt_holes())]
    windows = [solid.walls(window[::-1], WEB) for window in _windows()]
    solid.flat([teeth[0], rim[0][0]], up=False)
    solid.flat([teeth[1], rim[1][1]], up=True)
    solid.flat([rim[0][1], foot[1], *(low for low, _ in windows)], up=False)
    solid.flat([rim[1][0], head[0], *(high for _, high in windows)], up=True)
    solid.flat([foot[0], *(low for low, _ in holes)], up=False)
    solid.flat([head[1], *(high for _, high in holes)], up=True)
    return np.concatenate(solid.points), np.concatenate(solid.faces)


class Solid:
    """Points and faces so far."""

    def __init__(self) -> None:
        self.points: list[np.ndarray] = []
        self.faces: list[np.ndarray] = []

    def walls(
        self, outline: np.ndarray, heights: tuple[float, float], bevel: tuple[float, float] = (0, 0)
    ) -> tuple[Ring, Ring]:
        """Walls on an outline (k, 2) between two heights; `bevel` is the chamfer's size at either. Its end rings."""
        (low, high), (below, above) = heights, bevel
        levels = [(0.0, low + below), (0.0, high - above)]
        levels = ([(below, low)] if below else []) + levels + ([(above, high)] if above else [])
        rings = [self._ring(_moved_in(outline, by), z) for by, z in levels]
        for a, b in pairwise(rings):
            a1, b1 = np.roll(a, -1), np.roll(b, -1)
            self.faces += [np.stack([a, a1, b1], 1), np.stack([a, b1, b], 1)]
        return rings[0], rings[-1]

    def flat(self, rings: Sequence[Ring], up: bool) -> None:
        """The degenerate face between rings at one height."""
        ids, space = np.concatenate(rings), np.concatenate(self.points)
        edges = np.stack([ids, np.concatenate([np.roll(ring, -1) for ring in rings])], 1)
        plane = space[ids, :2]
        corners = Delaunay(plane).simplices.astype(np.int64)
        corners = corners[inside(plane[corners].mean(axis=1), space[edges, :2])]
        wrong = (np.linalg.det(plane[corners[:, 1:]] - plane[corners[:, :1]]) > 0) != up
        corners[wrong] = corners[wrong][:, ::-1]
        faces = ids[corners]
        if not np.array_equal(_border(faces), np.unique(np.sort(edges, axis=1), axis=0)):
            raise ValueError(f"an outline at z = {space[ids[0], 2]} is too coarse for its neighbours")
        self.faces.append(faces)

    def _ring(self, outline: np.ndarray, z: float) -> Ring:
        first = sum(map(len, self.points))
        self.points.append(np.c_[outline, np.full(len(outline), z)])
        return first + np.arange(len(outline))


def _border(faces: np.ndarray) -> np.ndarray:
    """(e, 2) edges of one face only, sorted."""
    edges, count = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_counts=True)
    return edges[count == 1]


def _moved_in(outline: np.ndarray, by: float) -> np.ndarray:
    """(k, 2) the outline with each side moved to its left."""
    along = np.roll(outline, -1, axis=0) - outline
    left = np.stack([-along[:, 1], along[:, 0]], 1) / np.linalg.norm(along, axis=1, keepdims=True)
    before = np.roll(left, 1, axis=0)
    return outline + by * (left + before) / (1 + (left * before).sum(axis=1, keepdims=True))


def _polar(radius: np.ndarray | float, angle: np.ndarray | float) -> np.ndarray:
    """(..., 2) points, from radians."""
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], -1)


def _circle(radius: float, count: int) -> np.ndarray:
    """(k, 2) anticlockwise, as all outlines below."""
    return _polar(radius, np.arange(count) * 2 * np.pi / count)


def _teeth() -> np.ndarray:
    """(k, 2) involute flanks down to the base circle, from there fillets."""
    pitch = MODULE * TEETH / 2
    base, tip, root = pitch * np.cos(PRESSURE_ANGLE), pitch + MODULE, pitch - 1.25 * MODULE
    radius = np.linspace(base, tip, 9)
    roll = np.arccos(base / radius)
    half_width = np.pi / (2 * TEETH) + (np.tan(PRESSURE_ANGLE) - PRESSURE_ANGLE) - (np.tan(roll) - roll)
    turn = np.linspace(0, np.pi / 2, 5)[:-1]
    fillet = (base - root) * np.stack([-np.cos(turn), (1 - np.sin(turn)) / root], 1) + (base, half_width[0])
    # Rows of radius and angle; one tooth from the middle of the gap before it.
    rising = np.r_[fillet, np.stack([radius, half_width], 1)] * (1, -1)
    top = [(tip, share * half_width[-1]) for share in (-1 / 3, 1 / 3)]
    rows = np.r_[[(root, -np.pi / TEETH)], rising, top, rising[::-1] * (1, -1)]
    return np.concatenate([_polar(rows[:, 0], rows[:, 1] + k * 2 * np.pi / TEETH) for k in range(TEETH)])


def _bore() -> np.ndarray:
    """(k, 2) with its keyway at the top."""
    start = np.arccos(KEYWAY_WIDTH / 2 / BORE_RADIUS)
    arc = _polar(BORE_RADIUS, np.linspace(np.pi - start, 2 * np.pi + start, 90))
    return np.r_[arc, [(KEYWAY_WIDTH / 2, KEYWAY_TOP), (-KEYWAY_WIDTH / 2, KEYWAY_TOP)]]


def _bolt_holes() -> list[np.ndarray]:
    hole = _circle(BOLT_RADIUS, 32)
    return [hole + middle for middle in _circle(BOLT_CIRCLE, BOLTS)]


def _windows() -> list[np.ndarray]:
    """Rings cut by ribs with parallel sides, their corners rounded."""
    low, high = WINDOW_RADII
    half_turn = np.pi / WINDOWS
    # Polar places of the middles of the upper corners, and the direction square to the rib's side.
    inner, outer = low + WINDOW_CORNER, high - WINDOW_CORNER
    at_inner, at_outer = (half_turn - np.arcsin((RIB / 2 + WINDOW_CORNER) / r) for r in (inner, outer))
    square = half_turn + np.pi / 2
    upper = np.concatenate(
        [
            _polar(high, np.linspace(0, at_outer, 10)),
            _polar(outer, at_outer) + _polar(WINDOW_CORNER, np.linspace(at_outer, square, 9)[1:]),
            _polar(inner, at_inner) + _polar(WINDOW_CORNER, np.linspace(square, np.pi + at_inner, 9)),
            _polar(low, np.linspace(at_inner, 0, 8)[1:]),
        ]
    )
    window = np.r_[upper, upper[-2:0:-1] * (1, -1)]
    turns = np.arange(WINDOWS) * 2 * half_turn
    return [window @ [(np.cos(turn), np.sin(turn)), (-np.sin(turn), np.cos(turn))] for turn in turns]
