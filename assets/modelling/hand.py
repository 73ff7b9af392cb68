"""A relaxed right hand: wrist at the origin, fingers up, thumb towards +x, palm towards -y; 1.9 from wrist to tip.

The same field serves the sample `hand` and, smaller, the person's hands.
"""

from dataclasses import dataclass

import numpy as np

from .fields import Field, ellipsoid, tube
from .joins import carve, join
from .sculpture import Sculpture, ramp

REACH = 0.5

WRIST_CUT = -0.62
"""Height of the sample's open rim."""


@dataclass(frozen=True)
class Finger:
    """Where the knuckle lies, how the finger leaves it (degrees), its three bones' lengths and its half-width."""

    knuckle: tuple[float, float, float]
    fan: float
    curl: tuple[float, float, float]
    bones: tuple[float, float, float]
    radius: float


FINGERS = {
    "index": Finger((0.352, 0.03, 0.90), 12, (2, 14, 10), (0.42, 0.26, 0.19), 0.098),
    "middle": Finger((0.118, 0.045, 0.95), 3, (6, 17, 12), (0.46, 0.30, 0.20), 0.101),
    "ring": Finger((-0.115, 0.035, 0.91), -6, (10, 20, 14), (0.42, 0.28, 0.20), 0.096),
    "little": Finger((-0.325, 0.005, 0.81), -18, (12, 22, 16), (0.34, 0.21, 0.18), 0.084),
}

# Rows: x, y, z, half-width, half-depth.
FOREARM = [
    (0.00, 0.00, -1.20, 0.330, 0.285),
    (0.00, 0.00, -0.70, 0.290, 0.235),
    (0.00, 0.00, -0.35, 0.260, 0.190),
]
PALM = [
    (0.00, 0.00, -0.10, 0.250, 0.160),
    (0.00, 0.00, 0.10, 0.270, 0.148),
    (0.02, 0.02, 0.45, 0.370, 0.125),
    (0.01, 0.03, 0.80, 0.400, 0.105),
]

# Share of a bone, counted from the knuckle, and the finger's width and depth there in radii.
PROFILE = [
    (-0.55, 0.90, 0.95),
    (0.0, 1.00, 1.12),
    (0.5, 0.93, 1.00),
    (1.0, 1.00, 1.00),  # middle joint
    (1.5, 0.93, 0.92),
    (2.0, 0.94, 0.88),  # end joint
    (2.5, 0.88, 0.80),
    (2.85, 0.72, 0.62),
]


def hand(spread: float = 1.0, with_forearm: bool = False) -> Field:
    """The hand's field; `spread` multiplies the fan of the fingers, the forearm reaches down to z = -1.2."""
    fingers = [_finger(finger, spread) for finger in FINGERS.values()]
    return join(0.05, join(0.13, *_palm(with_forearm), _thumb()), join(0, *fingers))


def sculpture() -> Sculpture:
    """The sample `hand`; its rim is cut afterwards."""
    edge = 0.0315
    return Sculpture(
        field=hand(with_forearm=True),
        low=(-0.8, -0.7, -1.6),
        high=(1.1, 0.5, 2.1),
        grid=0.02,
        edge=edge,
        wanted=lambda p: edge * ramp(-p[:, 2], -0.6, 0.2, 0.82),
    )


def _palm(with_forearm: bool) -> list[Field]:
    body = tube((FOREARM if with_forearm else []) + PALM, reach=REACH)
    thumb_ball = ellipsoid((0.24, -0.09, 0.33), (0.135, 0.11, 0.27), right=(1, 0, -0.45), up=(0.45, 0, 1), reach=REACH)
    little_ball = ellipsoid((-0.24, -0.065, 0.36), (0.12, 0.095, 0.30), reach=REACH)
    below_fingers = tube(
        [(0.27, -0.03, 0.80, 0.07, 0.10), (0.10, -0.03, 0.83, 0.07, 0.10), (-0.28, -0.04, 0.72, 0.07, 0.10)],
        side=(0, 1, 0),
        reach=REACH,
    )
    hollow = ellipsoid((0.0, -0.245, 0.55), (0.13, 0.135, 0.20), reach=REACH)
    knuckles = [
        ellipsoid(np.add(f.knuckle, (0, 0.05, -0.04)), (0.075, 0.06, 0.13), reach=REACH) for f in FINGERS.values()
    ]
    wrist_bone = ellipsoid((-0.165, 0.07, -0.18), (0.08, 0.085, 0.13), reach=REACH)
    return [carve(0.15, join(0.16, body, thumb_ball, little_ball, below_fingers), hollow), *knuckles, wrist_bone]


def _thumb() -> Field:
    return tube(
        [
            # x, y, z, half-width, half-depth
            (0.17, -0.05, 0.16, 0.13, 0.13),
            (0.31, -0.10, 0.38, 0.145, 0.13),
            (0.455, -0.14, 0.585, 0.128, 0.122),  # knuckle
            (0.54, -0.165, 0.70, 0.108, 0.104),
            (0.625, -0.19, 0.82, 0.110, 0.100),  # end joint
            (0.675, -0.215, 0.92, 0.108, 0.090),
            (0.705, -0.235, 1.00, 0.092, 0.072),
        ],
        side=(0.7, 0.5, -0.4),
        reach=REACH,
    )


def _finger(finger: Finger, spread: float) -> Field:
    """A tube through the joints; each bends further towards the palm."""
    fan, bend = np.radians(spread * finger.fan), np.radians(np.cumsum(finger.curl))
    ahead = np.stack([np.sin(fan) * np.cos(bend), -np.sin(bend), np.cos(fan) * np.cos(bend)], 1)
    joints = np.cumsum(np.r_[[finger.knuckle], ahead * np.array(finger.bones)[:, None]], axis=0)
    rows = []
    for share, width, depth in PROFILE:
        bone = int(np.clip(share, 0, 2))
        place = joints[bone] + (share - bone) * finger.bones[bone] * ahead[bone]
        place = place + min(share, 0) * np.array([0, 0.06, 0])  # the root sinks into the palm
        rows.append([*place, finger.radius * width, finger.radius * depth])
    return tube(rows, side=(np.cos(fan), 0, -np.sin(fan)), reach=REACH)
