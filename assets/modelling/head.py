"""The person's head in the person's axes: metres, z up, face towards -y; the chin at z = 1.57, the crown at 1.80."""

import numpy as np

from .fields import Field, ellipsoid, tube, unit
from .joins import blend, both_sides, carve, join


def head() -> Field:
    """Skull, face, ears and hair, to be joined to a neck."""
    skull = join(0.03, join(0.05, *_skull()), *_cheeks())
    sockets = both_sides(ellipsoid((0.032, -0.102, 1.688), (0.021, 0.022, 0.013), right=(1, 0.35, 0)))
    below_lip = ellipsoid((0, -0.106, 1.5985), (0.014, 0.010, 0.005))
    face = join(0.014, carve(0.02, skull, sockets), *_features())
    face = carve(0.006, join(0.004, face, _lips(), both_sides(_eye())), _mouth(), below_lip)
    return join(0.006, join(0.008, face, _hair()), both_sides(_ear()))


def _skull() -> list[Field]:
    cranium = ellipsoid((0, 0.022, 1.694), (0.073, 0.092, 0.094))
    # From the brow down to the chin, wide at the cheekbones.
    front = tube(
        [
            # x, y, z, half-width, half-depth
            (0, -0.018, 1.720, 0.062, 0.062),
            (0, -0.026, 1.680, 0.062, 0.063),
            (0, -0.031, 1.640, 0.054, 0.060),
            (0, -0.038, 1.605, 0.041, 0.053),
            (0, -0.044, 1.584, 0.030, 0.040),
        ]
    )
    jaw = both_sides(
        tube([(0.056, 0.004, 1.655, 0.015), (0.050, -0.006, 1.612, 0.015), (0.020, -0.066, 1.583, 0.015)]), 0.01
    )
    return [cranium, front, jaw]


def _features() -> list[Field]:
    brow = both_sides(
        tube([(0.010, -0.083, 1.703, 0.007), (0.030, -0.080, 1.7075, 0.0075), (0.050, -0.061, 1.701, 0.006)])
    )
    nose = tube(
        [
            (0, -0.086, 1.700, 0.0080, 0.010),
            (0, -0.095, 1.682, 0.0070, 0.010),
            (0, -0.103, 1.662, 0.0085, 0.011),
            (0, -0.1080, 1.650, 0.0105, 0.010),  # tip
            (0, -0.098, 1.644, 0.0075, 0.007),
        ]
    )
    wings = both_sides(ellipsoid((0.0128, -0.0975, 1.6465), (0.0068, 0.0110, 0.0068)))
    return [brow, nose, wings]


def _cheeks() -> list[Field]:
    """Cheek bones and cheeks, the mound the teeth make, and the chin."""
    cheek_bones = both_sides(ellipsoid((0.046, -0.052, 1.661), (0.016, 0.020, 0.012), right=(1, 0.8, 0)))
    cheeks = both_sides(ellipsoid((0.033, -0.056, 1.632), (0.022, 0.022, 0.030), right=(1, 0.8, 0)))
    teeth = ellipsoid((0, -0.072, 1.617), (0.027, 0.022, 0.019))
    chin = ellipsoid((0, -0.082, 1.583), (0.017, 0.015, 0.013))
    return [cheek_bones, cheeks, teeth, chin]


def _eye() -> Field:
    """The ball under two lids."""
    ball = ellipsoid((0.0315, -0.0725, 1.6850), (0.0135, 0.0130, 0.0120))
    upper = tube(
        [(0.0170, -0.0810, 1.6850, 0.0040), (0.0310, -0.0855, 1.6935, 0.0052), (0.0465, -0.0750, 1.6855, 0.0042)]
    )
    lower = tube(
        [(0.0180, -0.0800, 1.6820, 0.0035), (0.0315, -0.0830, 1.6765, 0.0045), (0.0455, -0.0745, 1.6825, 0.0035)]
    )
    return join(0.002, ball, upper, lower)


def _lips() -> Field:
    upper = tube(
        [
            (-0.0245, -0.0840, 1.6165, 0.0030),
            (-0.0085, -0.0950, 1.6212, 0.0062),
            (0, -0.0958, 1.6205, 0.0058),
            (0.0085, -0.0950, 1.6212, 0.0062),
            (0.0245, -0.0840, 1.6165, 0.0030),
        ],
        side=(0, 0, 1),
    )
    lower = tube(
        [(-0.0220, -0.0840, 1.6145, 0.0030), (0, -0.0942, 1.6080, 0.0072), (0.0220, -0.0840, 1.6145, 0.0030)],
        side=(0, 0, 1),
    )
    return join(0.001, upper, lower)


def _mouth() -> Field:
    return tube(
        [(-0.0265, -0.0870, 1.6155, 0.0024), (0, -0.1020, 1.6145, 0.0036), (0.0265, -0.0870, 1.6155, 0.0024)],
        side=(0, 0, 1),
    )


def _ear() -> Field:
    shell = ellipsoid((0.079, 0.022, 1.671), (0.0110, 0.022, 0.033), right=(1, 0.55, 0.1), up=(0.15, 0.2, 1))
    root = ellipsoid((0.072, 0.016, 1.668), (0.010, 0.014, 0.022))
    lobe = ellipsoid((0.074, 0.010, 1.644), (0.009, 0.010, 0.010), right=(1, 0.55, 0))
    bowl = ellipsoid((0.094, 0.012, 1.671), (0.010, 0.0115, 0.019), right=(1, 0.55, 0.1), up=(0.15, 0.2, 1))
    return carve(0.004, join(0.006, shell, root, lobe), bowl)


HAIRLINE = [(0, -0.078, 1.748), (0, 0.106, 1.615)]
"""At the forehead and at the nape."""


def _hair() -> Field:
    """A mass combed back from the hairline, in locks."""
    mass = join(
        0.03,
        ellipsoid((0, 0.026, 1.700), (0.084, 0.104, 0.100)),
        ellipsoid((0.010, -0.038, 1.750), (0.054, 0.045, 0.031)),
    )
    front, nape = np.array(HAIRLINE)
    away = unit(np.cross(nape - front, (1, 0, 0)))
    away *= np.sign(away[2])

    def field(points: np.ndarray) -> np.ndarray:
        x, y, height = points[:, 0], points[:, 1], points[:, 2] - 1.68
        # Locks part at the whorl at the back, where they fade out.
        locks = 0.0030 * np.sin(13 * np.arctan2(x, height) + 0.9 * np.sin(30 * y))
        locks *= np.clip(np.hypot(x, height) / 0.08, 0, 1)
        line = (points - front) @ away + 1.2 * np.maximum(np.abs(x) - 0.03, 0) ** 2
        return -blend(-(mass(points) + locks), line, 0.005)

    return field
