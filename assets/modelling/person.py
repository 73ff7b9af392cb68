"""The sample `figure`: a standing person of 1.80 m; metres, z up, face towards -y, soles on z = 0."""

import numpy as np

from .fields import Field, ellipsoid, tube
from .hand import hand
from .head import head
from .joins import both_sides, join, placed, standing_on
from .sculpture import Sculpture, ramp

EDGE = 0.0187


def sculpture() -> Sculpture:
    """Finer triangles on hands, head and feet."""
    return Sculpture(
        field=person(),
        low=(-0.75, -0.25, -0.05),
        high=(0.75, 0.2, 1.95),
        grid=0.008,
        edge=EDGE,
        wanted=wanted_edge,
    )


def wanted_edge(points: np.ndarray) -> np.ndarray:
    """(n,) edge lengths, metres."""
    x, z = np.abs(points[:, 0]), points[:, 2]
    hands = ramp(np.hypot(x - 0.53, z - 0.86), 0.11, 0.24, 0.347)
    face = ramp(-z, -1.57, -1.47, 0.48)
    feet = ramp(z, 0.05, 0.16, 0.7)
    return EDGE * np.minimum(np.minimum(hands, face), feet)


def person() -> Field:
    """Trunk, legs, arms and head, joined."""
    trunk_and_legs = join(0.08, _trunk(), both_sides(_leg(), 0.012))
    return join(0.04, join(0.065, trunk_and_legs, both_sides(_arm())), head())


def _trunk() -> Field:
    core = tube(
        [
            # x, y, z, half-width, half-depth
            (0, 0.018, 0.850, 0.030, 0.048),
            (0, 0.015, 0.885, 0.070, 0.072),
            (0, 0.011, 0.930, 0.118, 0.087),
            (0, 0.006, 0.980, 0.146, 0.094),  # hips
            (0, 0.000, 1.030, 0.144, 0.093),
            (0, -0.004, 1.075, 0.136, 0.089),
            (0, -0.006, 1.120, 0.129, 0.086),  # waist
            (0, -0.002, 1.200, 0.138, 0.096),
            (0, 0.004, 1.280, 0.151, 0.106),
            (0, 0.012, 1.350, 0.150, 0.103),  # chest
            (0, 0.020, 1.410, 0.118, 0.082),
            (0, 0.024, 1.460, 0.066, 0.060),
        ]
    )
    neck = tube([(0, 0.034, 1.430, 0.062, 0.060), (0, 0.028, 1.510, 0.053, 0.056), (0, 0.018, 1.600, 0.052, 0.058)])
    trapezius = tube(
        [
            (0.020, 0.045, 1.520, 0.040, 0.034),
            (0.065, 0.040, 1.460, 0.042, 0.040),
            (0.120, 0.030, 1.440, 0.036, 0.042),
            (0.180, 0.018, 1.427, 0.034, 0.046),
        ],
        side=(0, 0, 1),
    )
    chest_muscle = ellipsoid((0.076, -0.062, 1.338), (0.085, 0.034, 0.060), right=(1, 0.40, 0.25))
    broad_back = ellipsoid((0.094, 0.034, 1.285), (0.060, 0.058, 0.175), right=(1, 0.4, 0), up=(0.22, 0, 1))
    shoulder_blade = ellipsoid((0.088, 0.078, 1.365), (0.060, 0.030, 0.075), right=(1, -0.35, 0))
    buttock = ellipsoid((0.074, 0.066, 0.895), (0.076, 0.064, 0.080))
    hip = ellipsoid((0.110, 0.010, 0.940), (0.062, 0.075, 0.090))
    muscles = join(0.07, trapezius, chest_muscle, broad_back, shoulder_blade)
    seat = join(0.06, buttock, hip)
    return join(0.075, core, neck, both_sides(muscles, 0.010), both_sides(seat, 0.006))


def _arm() -> Field:
    upper_and_fore = tube(
        [
            # x, y, z, half-width across the arm's plane, half-width in it
            (0.178, 0.016, 1.402, 0.052, 0.050),  # shoulder
            (0.222, 0.018, 1.348, 0.051, 0.051),
            (0.268, 0.020, 1.285, 0.048, 0.049),
            (0.315, 0.024, 1.220, 0.042, 0.042),
            (0.352, 0.026, 1.168, 0.040, 0.038),  # elbow
            (0.385, 0.018, 1.118, 0.044, 0.041),
            (0.420, 0.010, 1.058, 0.041, 0.037),
            (0.455, 0.000, 0.998, 0.034, 0.029),
            (0.482, -0.008, 0.950, 0.029, 0.0235),  # wrist
        ],
        side=(0.3, -1, 0),
    )
    deltoid = ellipsoid((0.202, 0.016, 1.372), (0.046, 0.055, 0.100), right=(1, 0, 0.6), up=(-0.6, 0, 1))
    return join(0.02, join(0.04, upper_and_fore, deltoid), _placed_hand())


def _placed_hand() -> Field:
    return placed(
        hand(spread=1.9), (0.485, -0.009, 0.945), right=(0.25, -1, -0.1), up=(0.47, -0.13, -0.85), scale=0.108
    )


def _leg() -> Field:
    limb = tube(
        [
            # x, y, z, half-width, half-depth
            (0.070, 0.012, 1.000, 0.050, 0.060),
            (0.084, 0.012, 0.920, 0.072, 0.080),
            (0.097, 0.006, 0.830, 0.077, 0.088),
            (0.105, 0.000, 0.720, 0.070, 0.080),
            (0.106, -0.002, 0.620, 0.060, 0.069),
            (0.105, -0.004, 0.545, 0.053, 0.059),
            (0.105, -0.006, 0.500, 0.050, 0.055),  # knee
            (0.106, 0.004, 0.440, 0.047, 0.050),
            (0.108, 0.014, 0.365, 0.051, 0.056),  # calf
            (0.108, 0.020, 0.280, 0.045, 0.049),
            (0.107, 0.022, 0.190, 0.034, 0.037),
            (0.107, 0.024, 0.120, 0.0305, 0.035),
            (0.107, 0.026, 0.075, 0.034, 0.039),  # ankle
        ]
    )
    kneecap = ellipsoid((0.105, -0.040, 0.505), (0.028, 0.022, 0.036))
    calf = ellipsoid((0.113, 0.040, 0.370), (0.040, 0.036, 0.085))
    foot = tube(
        [
            (0.106, 0.056, 0.034, 0.033, 0.036),  # heel
            (0.108, 0.020, 0.044, 0.034, 0.044),
            (0.113, -0.035, 0.040, 0.037, 0.040),
            (0.119, -0.090, 0.026, 0.043, 0.028),
            (0.124, -0.130, 0.019, 0.043, 0.021),  # ball
            (0.127, -0.160, 0.014, 0.034, 0.015),
        ]
    )
    big_toe = tube([(0.108, -0.110, 0.018, 0.020, 0.018), (0.106, -0.165, 0.014, 0.016, 0.014)])
    return standing_on(0.0, join(0.05, join(0.04, limb, kneecap, calf), join(0.02, foot, big_toe)), 0.02)
