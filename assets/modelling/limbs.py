"""The person's left arm and leg in the person's axes: metres, z up, face towards -y, the sole on z = 0."""

import numpy as np

from .fields import Field, ellipsoid, tube
from .hand import hand
from .joins import carve, join, placed, standing_on

ARM = (0.58, 0.03, -0.81)
"""Down the upper arm."""

FOREARM = (0.51, -0.13, -0.85)


def arm() -> Field:
    upper_and_fore = tube(
        [
            # x, y, z, half-width across the arm's plane, half-width in it
            (0.178, 0.016, 1.402, 0.050, 0.048),  # shoulder
            (0.222, 0.018, 1.348, 0.047, 0.047),
            (0.268, 0.020, 1.285, 0.041, 0.042),
            (0.315, 0.024, 1.220, 0.037, 0.038),
            (0.352, 0.026, 1.168, 0.036, 0.036),  # elbow
            (0.385, 0.018, 1.118, 0.038, 0.037),
            (0.420, 0.010, 1.058, 0.037, 0.034),
            (0.455, 0.000, 0.998, 0.032, 0.028),
            (0.482, -0.008, 0.950, 0.029, 0.0235),  # wrist
        ],
        side=(0.3, -1, 0),
    )
    deltoid = ellipsoid((0.208, 0.014, 1.368), (0.044, 0.056, 0.098), right=(1, 0, 0.65), up=(-0.62, 0, 1))
    biceps = ellipsoid((0.281, -0.008, 1.262), (0.026, 0.026, 0.072), right=(0.8, 0, 0.57), up=ARM)
    triceps = ellipsoid((0.272, 0.048, 1.288), (0.030, 0.024, 0.080), right=(0.8, 0, 0.57), up=ARM)
    extensors = ellipsoid((0.392, 0.016, 1.118), (0.034, 0.030, 0.075), right=(0.8, 0, 0.57), up=FOREARM)
    flexors = ellipsoid((0.372, -0.008, 1.108), (0.026, 0.024, 0.072), right=(0.8, 0, 0.57), up=FOREARM)
    elbow = ellipsoid((0.352, 0.055, 1.168), (0.015, 0.013, 0.020), up=ARM)
    inner_knob = ellipsoid((0.330, 0.026, 1.158), (0.012, 0.012, 0.013))
    wrist_knob = ellipsoid((0.484, 0.016, 0.962), (0.011, 0.010, 0.013))
    muscles = join(0.022, upper_and_fore, deltoid, biceps, triceps, extensors, flexors)
    return join(0.02, join(0.016, muscles, elbow, inner_knob, wrist_knob), _placed_hand())


def _placed_hand() -> Field:
    return placed(
        hand(spread=1.9), (0.485, -0.009, 0.945), right=(0.25, -1, -0.1), up=(0.47, -0.13, -0.85), scale=0.108
    )


def leg() -> Field:
    limb = join(0.03, _bones(), *_thigh(), *_lower_leg())
    limb = carve(0.02, limb, *_leg_hollows())
    return standing_on(0.0, join(0.035, limb, _foot()), 0.012)


def _bones() -> Field:
    return tube(
        [
            # x, y, z, half-width, half-depth
            (0.070, 0.012, 1.000, 0.050, 0.060),
            (0.084, 0.012, 0.920, 0.072, 0.078),
            (0.097, 0.006, 0.830, 0.075, 0.083),
            (0.104, 0.000, 0.720, 0.066, 0.073),
            (0.105, -0.002, 0.620, 0.056, 0.062),
            (0.105, -0.004, 0.545, 0.049, 0.053),
            (0.105, -0.004, 0.500, 0.047, 0.049),  # knee
            (0.105, 0.004, 0.440, 0.043, 0.046),
            (0.107, 0.014, 0.365, 0.045, 0.048),  # calf
            (0.107, 0.020, 0.280, 0.040, 0.043),
            (0.107, 0.024, 0.190, 0.031, 0.034),
            (0.107, 0.026, 0.120, 0.0285, 0.032),
            (0.107, 0.026, 0.075, 0.031, 0.036),  # ankle
        ]
    )


def _thigh() -> list[Field]:
    front = ellipsoid((0.110, -0.040, 0.715), (0.034, 0.038, 0.140), up=(0, 0.06, 1))
    outer = ellipsoid((0.142, -0.012, 0.665), (0.028, 0.044, 0.120), up=(0.12, 0, 1))
    inner_drop = ellipsoid((0.080, -0.026, 0.575), (0.023, 0.026, 0.050), up=(-0.25, 0, 1))
    hamstrings = [
        ellipsoid((0.126, 0.040, 0.690), (0.030, 0.032, 0.130)),
        ellipsoid((0.086, 0.040, 0.690), (0.030, 0.032, 0.130)),
        tube([(0.132, 0.034, 0.600, 0.014), (0.136, 0.024, 0.480, 0.009)]),
        tube([(0.082, 0.036, 0.600, 0.014), (0.078, 0.022, 0.460, 0.009)]),
    ]
    return [front, outer, inner_drop, *hamstrings]


def _lower_leg() -> list[Field]:
    kneecap = ellipsoid((0.105, -0.046, 0.508), (0.023, 0.014, 0.028))
    below_kneecap = tube([(0.105, -0.043, 0.480, 0.010), (0.104, -0.036, 0.440, 0.012)])
    shin = tube(
        [
            (0.104, -0.034, 0.440, 0.011),
            (0.100, -0.028, 0.360, 0.010),
            (0.099, -0.016, 0.280, 0.009),
            (0.099, 0.002, 0.170, 0.007),
        ]
    )
    calves = [
        ellipsoid((0.088, 0.046, 0.372), (0.029, 0.031, 0.085), up=(-0.05, 0, 1)),
        ellipsoid((0.127, 0.044, 0.388), (0.028, 0.029, 0.078)),
    ]
    outer = ellipsoid((0.138, 0.006, 0.350), (0.016, 0.028, 0.100))
    achilles = tube([(0.107, 0.050, 0.240, 0.016), (0.107, 0.056, 0.150, 0.010), (0.107, 0.062, 0.060, 0.012)])
    ankles = [
        ellipsoid((0.081, 0.018, 0.088), (0.012, 0.015, 0.016)),
        ellipsoid((0.137, 0.026, 0.076), (0.012, 0.014, 0.018)),
    ]
    return [kneecap, below_kneecap, shin, *calves, outer, achilles, *ankles]


def _leg_hollows() -> list[Field]:
    """Behind the knee, and beside the heel's tendon."""
    knee = ellipsoid((0.106, 0.066, 0.505), (0.016, 0.012, 0.045))
    return [knee, *(ellipsoid((x, 0.056, 0.105), (0.012, 0.012, 0.035)) for x in (0.079, 0.135))]


TOES = [
    # The ball's x and y, the tip's x and y, height of the ball and half-width.
    ((0.104, -0.118), (0.1040, -0.178), 0.0170, 0.0145),
    ((0.119, -0.124), (0.1255, -0.182), 0.0140, 0.0105),
    ((0.132, -0.118), (0.1420, -0.171), 0.0130, 0.0100),
    ((0.144, -0.108), (0.1565, -0.156), 0.0120, 0.0095),
    ((0.153, -0.094), (0.1690, -0.136), 0.0110, 0.0095),
]


def _foot() -> Field:
    foot = tube(
        [
            (0.106, 0.056, 0.032, 0.031, 0.034),  # heel
            (0.108, 0.020, 0.044, 0.032, 0.044),
            (0.113, -0.035, 0.042, 0.034, 0.040),
            (0.121, -0.080, 0.027, 0.040, 0.029),
            (0.127, -0.115, 0.018, 0.041, 0.021),  # ball
        ]
    )
    toes = [
        tube(
            [
                (*ball, height, width),
                (*np.mean([ball, tip], axis=0), height + 0.003, width),
                (*tip, height * 0.65, width * 0.88),
            ]
        )
        for ball, tip, height, width in TOES
    ]
    arch = ellipsoid((0.082, -0.035, 0.000), (0.022, 0.045, 0.022))
    return carve(0.02, join(0.012, foot, join(0.003, *toes)), arch)
