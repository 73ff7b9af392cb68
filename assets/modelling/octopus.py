"""The sample `octopus`: an octopus at rest, its arms 0.75 m long; metres, z up, eyes towards -y, the floor at z = 0."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.spatial import cKDTree

from .fields import Field, ellipsoid, tube, within_reach
from .joins import both_sides, carve, join, join_by
from .sculpture import Sculpture, ramp

EDGE = 0.0142

BASE, TIP = 0.041, 0.0068
"""An arm's radius where it leaves the web, and near its end."""

STEPS = 160
"""Straight pieces an arm is made of."""


@dataclass(frozen=True)
class Arm:
    """Where it leaves the body (degrees from +x towards +y), its length, and how it winds.

    A row of `course`: share of the length, degrees turned to the left so far, degrees pointing upwards.
    """

    leaves: float
    length: float
    course: list[tuple[float, float, float]]
    suckers: bool = False


ARMS = [
    # From the right of the front round to the left, seen from above against the clock.
    Arm(-115, 0.74, [(0, 0, -10), (0.2, 0, -4), (0.36, 12, 35), (0.55, 20, 95), (0.74, 25, 185), (1, 35, 425)], True),
    Arm(-65, 0.70, [(0, 0, -14), (0.2, 8, -6), (0.36, 22, 40), (0.54, 30, 80), (0.78, 50, 20), (1, 60, -60)], True),
    Arm(-24, 0.74, [(0, 0, -30), (0.2, 0, -8), (0.45, -30, 0), (0.58, 15, 0), (0.76, 105, 0), (1, 270, 4)]),
    Arm(22, 0.80, [(0, 0, -30), (0.2, 0, -8), (0.45, 30, 0), (0.7, -40, 5), (0.85, -60, 45), (1, -80, 160)]),
    Arm(68, 0.74, [(0, 0, -30), (0.2, 0, -8), (0.4, -20, 0), (0.65, 30, 0), (0.82, 100, 5), (1, 320, 5)]),
    Arm(112, 0.72, [(0, 0, -30), (0.2, 0, -8), (0.45, 40, 0), (0.7, -20, 0), (0.85, -60, 12), (1, -170, 60)]),
    Arm(158, 0.76, [(0, 0, -30), (0.2, 10, -8), (0.4, 10, 0), (0.58, -55, 0), (0.76, -150, 0), (1, -350, 4)]),
    Arm(-158, 0.80, [(0, 0, -30), (0.2, -12, -8), (0.45, -40, 0), (0.7, 30, 0), (0.85, 60, 0), (1, 150, 20)]),
]


def sculpture() -> Sculpture:
    """Finer triangles along the arms, the finest at their tips, and on the eyes."""
    return Sculpture(
        octopus(), low=(-0.8, -0.8, -0.02), high=(0.8, 0.8, 0.5), grid=0.004, edge=EDGE, wanted=wanted_edge
    )


def wanted_edge(points: np.ndarray) -> np.ndarray:
    """(n,) edge lengths, metres."""
    x, y, z = points.T
    eyes = ramp(np.hypot(np.abs(x) - 0.060, np.hypot(y + 0.02, z - 0.232)), 0.042, 0.07, 0.42)
    siphon = ramp(np.linalg.norm(points - (0.128, 0.018, 0.172), axis=1), 0.03, 0.06, 0.5)
    away, nearest = _NEAREST.query(points)
    radii = _RADII[nearest]
    below = ((points - _NEAREST.data[nearest]) * _DOWN[nearest]).sum(axis=1) / radii
    share = np.where(_SUCKERS[nearest], ramp(-below, -0.7, -0.2, 0.44), 1) * 0.75
    arms = np.where(away < 2 * BASE, share * radii / EDGE, 1)
    return EDGE * np.minimum(np.minimum(eyes, siphon), np.minimum(arms, 1))


def octopus() -> Field:
    """Mantle, head and arms; the arms flow into each other only in the web round the mouth."""
    body = join(0.03, join(0.05, _mantle(), _head()), _siphon())
    arms = [_arm(course) for course in COURSES]
    crown = ellipsoid((0, 0, 0.090), (0.110, 0.110, 0.060))

    def web(points: np.ndarray) -> np.ndarray:
        return 1e-3 + 0.11 * ramp(-np.hypot(points[:, 0], points[:, 1]), -0.27, -0.13, 0)

    return join(0.06, join_by(web, crown, *arms), body)


def _mantle() -> Field:
    neck = tube([(0, 0.0, 0.175, 0.060), (0.006, 0.07, 0.215, 0.060), (0.014, 0.14, 0.25, 0.066)], steps=20)
    bag = ellipsoid((0.026, 0.205, 0.275), (0.108, 0.142, 0.096), right=(1, -0.14, 0), up=(0, -0.12, 1))
    end = ellipsoid((0.044, 0.310, 0.262), (0.066, 0.086, 0.058), right=(1, -0.14, 0), up=(0, 0.25, 1))
    return join(0.07, join(0.08, bag, end), neck)


def _head() -> Field:
    skull = tube(
        [(0, -0.005, 0.10, 0.075, 0.070), (0, -0.02, 0.16, 0.064, 0.060), (0, -0.01, 0.20, 0.05, 0.05)], steps=20
    )
    orbit = both_sides(ellipsoid((0.046, -0.022, 0.214), (0.032, 0.038, 0.034), right=(1, -0.3, 0.2)), 0.004)
    eyeball = both_sides(ellipsoid((0.068, -0.030, 0.222), (0.015, 0.023, 0.019), right=(1, -0.35, 0.1)))
    slit = both_sides(ellipsoid((0.086, -0.036, 0.222), (0.010, 0.018, 0.005), right=(1, -0.35, 0.1)))
    horn = both_sides(tube([(0.050, -0.012, 0.238, 0.017), (0.057, -0.006, 0.266, 0.0105)]))
    return carve(0.005, join(0.012, join(0.03, skull, orbit, horn), eyeball), slit)


def _siphon() -> Field:
    pipe = tube([(0.060, 0.035, 0.175, 0.030), (0.095, 0.034, 0.168, 0.025), (0.128, 0.018, 0.172, 0.020)])
    return carve(0.008, pipe, ellipsoid((0.146, 0.006, 0.175), (0.013, 0.013, 0.013)))


@dataclass(frozen=True)
class Course:
    """An arm's middle (k, 3), its radii (k,), and at each place the way to its underside and to its left (k, 3)."""

    places: np.ndarray
    radii: np.ndarray
    down: np.ndarray
    left: np.ndarray
    suckers: bool


def _course(arm: Arm) -> Course:
    share = np.linspace(0, 1, STEPS + 1)
    rows = np.array(arm.course, float)
    turned, pitch = np.radians(PchipInterpolator(rows[:, 0], rows[:, 1:])(share).T)
    towards = np.radians(arm.leaves) + turned
    flat = np.stack([np.cos(towards), np.sin(towards), np.zeros(STEPS + 1)], 1)
    rise = np.array([0, 0, 1.0])
    ahead = flat * np.cos(pitch)[:, None] + rise * np.sin(pitch)[:, None]
    down = flat * np.sin(pitch)[:, None] - rise * np.cos(pitch)[:, None]
    way = np.cumsum(np.r_[np.zeros((1, 3)), (ahead[1:] + ahead[:-1]) / 2 * arm.length / STEPS], axis=0)
    radii = TIP + (BASE - TIP) * (1 - share) ** 1.15
    places = way + 0.055 * flat[0]
    # It thins on the floor, not above it.
    places[:, 2] += radii - places[:, 2].min()
    return Course(places, radii, down, np.cross(rise, flat), arm.suckers)


def _arm(course: Course) -> Field:
    """Straight pieces with round ends; each point looks at the two pieces nearest to it."""
    places, radii = course.places, course.radii
    piece, thinner = np.diff(places, axis=0), np.diff(radii)
    squared = (piece**2).sum(axis=1)
    tree = cKDTree(places)
    along = np.r_[0, np.cumsum(np.sqrt(squared) / radii[1:])]

    def distance(points: np.ndarray) -> np.ndarray:
        nearest = np.clip(tree.query(points)[1], 1, STEPS - 1)
        out, count = np.full(len(points), np.inf), np.zeros(len(points))
        for k in (nearest - 1, nearest):
            share = np.clip(((points - places[k]) * piece[k]).sum(axis=1) / squared[k], 0, 1)
            gap = np.linalg.norm(points - places[k] - share[:, None] * piece[k], axis=1)
            gap -= radii[k] + share * thinner[k]
            count = np.where(gap < out, along[k] + share * (along[k + 1] - along[k]), count)
            out = np.minimum(out, gap)
        if course.suckers:
            away = points - places[nearest]
            angle = np.arctan2((away * course.left[nearest]).sum(axis=1), (away * course.down[nearest]).sum(axis=1))
            fade = np.clip(1.6 - np.abs(nearest / STEPS - 0.42) / 0.19, 0, 1)
            out -= fade * radii[nearest] * _relief(count, angle)
        return out

    return within_reach(distance, places.min(axis=0) - BASE, places.max(axis=0) + BASE, 0.12)


def _relief(along: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """(n,) heights of two rows of suckers, in radii: `along` the arm, `angle` from the middle of its underside."""
    out = np.zeros(len(along))
    for side in (-1, 1):
        beside = along / 1.2 + side / 4
        across = np.hypot(1.2 * (beside - np.round(beside)), angle - 0.58 * side) / 0.56
        out = np.maximum(out, 0.34 * np.clip(1 - across**2, 0, 1) ** 1.5)
    return out


COURSES = [_course(arm) for arm in ARMS]
_NEAREST = cKDTree(np.concatenate([course.places for course in COURSES]))
_RADII = np.concatenate([course.radii for course in COURSES])
_DOWN = np.concatenate([course.down for course in COURSES])
_SUCKERS = np.concatenate([course.suckers & (np.abs(np.linspace(0, 1, STEPS + 1) - 0.42) < 0.29) for course in COURSES])
