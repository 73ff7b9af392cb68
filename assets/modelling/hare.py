"""The animal in the sample `hare`: a hare sitting up; metres, z up, head towards -y, feet on z = 0."""

import numpy as np

from .fields import Field, ellipsoid, tube
from .joins import both_sides, carve, join, placed, standing_on
from .polygonise import polygonise
from .remesh import remesh
from .scanner import Scanners

LOW, HIGH = (-0.14, -0.24, -0.02), (0.14, 0.27, 0.53)
"""A box round it."""

SCANNERS = [(-0.42, -0.72, 0.38), (0.85, -0.46, 0.38), (-0.42, 1.10, 0.66), (0.20, -0.10, 1.40)]
"""The first is close to the head; none looks from below."""


def scanned() -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) points and (m, 3) faces: what the scanners bring home."""
    solid = hare()
    fine = polygonise(solid, LOW, HIGH, 0.003)
    scanners = Scanners(SCANNERS, *fine)
    wanted = scanners.wanted(step=0.0045, finest=0.0036, coarsest=0.0115)
    return scanners.scan(*remesh(*fine, solid, wanted, 0.005), solid, seed=3)


def hare() -> Field:
    """Trunk in its fur, limbs, tail and head, joined."""
    body = join(0.020, join(0.030, join(0.025, _trunk(), both_sides(_haunch(), 0.01)), both_sides(_foreleg())), _tail())
    furred = _in_fur(join(0.012, body, both_sides(_hind_foot())))
    return standing_on(0.0, join(0.028, furred, _head()), 0.005)


def _trunk() -> Field:
    spine = tube(
        [
            # x, y, z, half-width, half-height
            (0, 0.158, 0.066, 0.050, 0.056),  # rump
            (0, 0.122, 0.092, 0.072, 0.084),
            (0, 0.070, 0.116, 0.079, 0.098),
            (0, 0.010, 0.140, 0.072, 0.092),
            (0, -0.042, 0.170, 0.060, 0.076),  # ribs
            (0, -0.072, 0.208, 0.050, 0.060),  # shoulders
            (0, -0.084, 0.246, 0.042, 0.051),
            (0, -0.091, 0.286, 0.034, 0.042),  # nape
            (0, -0.098, 0.322, 0.028, 0.034),
        ]
    )
    breast = ellipsoid((0, -0.098, 0.182), (0.046, 0.042, 0.066), up=(0, 0.2, 1))
    ruff = ellipsoid((0, -0.118, 0.245), (0.032, 0.027, 0.040), up=(0, 0.2, 1))
    return join(0.04, spine, breast, ruff)


def _haunch() -> Field:
    thigh = ellipsoid((0.063, 0.082, 0.082), (0.042, 0.086, 0.076), right=(1, 0.12, 0), up=(0, -0.30, 1))
    knee = ellipsoid((0.078, 0.014, 0.066), (0.026, 0.040, 0.050), up=(0, -0.25, 1))
    hock = ellipsoid((0.070, 0.112, 0.030), (0.028, 0.042, 0.032))
    return join(0.03, thigh, knee, hock)


def _hind_foot() -> Field:
    sole = tube(
        [
            (0.076, 0.115, 0.020, 0.018, 0.019),  # heel
            (0.082, 0.075, 0.017, 0.016, 0.018),
            (0.088, 0.010, 0.016, 0.018, 0.017),
            (0.090, -0.035, 0.013, 0.021, 0.014),
        ]
    )
    toes = [
        tube([(0.090 + x, -0.030, 0.013, 0.009, 0.011), (0.091 + 1.3 * x, y, 0.008, 0.0075, 0.008)])
        for x, y in [(-0.0135, -0.058), (0, -0.066), (0.0135, -0.058)]
    ]
    return join(0.008, sole, join(0.002, *toes))


def _foreleg() -> Field:
    leg = tube(
        [
            # x, y, z, half-width, half-depth
            (0.040, -0.062, 0.190, 0.022, 0.042),
            (0.042, -0.082, 0.145, 0.021, 0.031),
            (0.040, -0.098, 0.105, 0.0165, 0.021),  # elbow
            (0.037, -0.104, 0.065, 0.0135, 0.0155),
            (0.035, -0.108, 0.030, 0.0125, 0.0140),
            (0.035, -0.122, 0.013, 0.0145, 0.0135),
        ]
    )
    toes = [
        tube([(0.035 + x, -0.122, 0.013, 0.0075, 0.011), (0.035 + 1.3 * x, y, 0.008, 0.0065, 0.008)])
        for x, y in [(-0.009, -0.146), (0.001, -0.151), (0.010, -0.145)]
    ]
    return join(0.008, leg, join(0.002, *toes))


def _tail() -> Field:
    """Small, and turned up against the rump."""
    return tube(
        [
            (0, 0.178, 0.050, 0.022, 0.022),
            (0.003, 0.202, 0.056, 0.026, 0.024),
            (0.005, 0.214, 0.078, 0.024, 0.021),
            (0.006, 0.214, 0.100, 0.014, 0.013),
        ]
    )


def _head() -> Field:
    """Turned a little to its left; modelled round the middle of the skull, the nose towards -y."""
    ears = join(0.002, _ear(1, lean=0.16, back=0.30, turn=-0.5), _ear(-1, lean=0.26, back=0.52, turn=-0.9))
    whole = join(0.010, _face(), ears)
    return placed(whole, (0.002, -0.116, 0.322), right=(1, 0.28, 0), up=(0.02, -0.16, 1), scale=1.18)


def _face() -> Field:
    skull = tube(
        [
            (0, 0.032, -0.006, 0.0200, 0.0230),
            (0, 0.010, 0.003, 0.0265, 0.0295),
            (0, -0.018, 0.003, 0.0255, 0.0300),  # brow
            (0, -0.040, -0.004, 0.0220, 0.0270),
            (0, -0.057, -0.009, 0.0190, 0.0225),
            (0, -0.068, -0.011, 0.0140, 0.0165),
        ]
    )
    cheek = both_sides(ellipsoid((0.0165, -0.012, -0.019), (0.0155, 0.027, 0.0205)), 0.004)
    whiskers = both_sides(ellipsoid((0.0100, -0.0605, -0.0175), (0.0095, 0.0150, 0.0110)), 0.001)
    nose = ellipsoid((0, -0.0775, -0.0070), (0.0085, 0.0050, 0.0050), up=(0, 0.5, 1))
    chin = ellipsoid((0, -0.056, -0.0315), (0.0095, 0.0150, 0.0065))
    socket = both_sides(ellipsoid((0.0320, -0.0245, 0.0085), (0.0080, 0.0165, 0.0130)))
    eye = both_sides(ellipsoid((0.0225, -0.0245, 0.0080), (0.0068, 0.0120, 0.0108)))
    brow = both_sides(
        tube([(0.0200, -0.008, 0.0180, 0.004), (0.0200, -0.023, 0.0215, 0.004), (0.0180, -0.037, 0.0180, 0.003)])
    )
    mouth = both_sides(tube([(0, -0.0740, -0.0290, 0.0030), (0.0100, -0.0640, -0.0295, 0.0030)]))
    mouth_corner = both_sides(tube([(0.0100, -0.0640, -0.0295, 0.0030), (0.0190, -0.0470, -0.0265, 0.0026)]))
    face = join(0.010, join(0.022, skull, cheek), whiskers, chin)
    face = carve(0.003, carve(0.006, face, socket), mouth, mouth_corner)
    return join(0.002, join(0.007, face, brow, nose), eye)


def _ear(side: int, lean: float, back: float, turn: float) -> Field:
    """On the given side (1 the left), leaning outwards and back; `turn` is how far its hollow looks to the side."""
    shell = tube(
        [
            (0, 0.000, -0.012, 0.0115, 0.0115),
            (0, 0.000, 0.014, 0.0145, 0.0115),
            (0, 0.002, 0.045, 0.0215, 0.0105),
            (0, 0.001, 0.080, 0.0230, 0.0088),
            (0, -0.003, 0.108, 0.0170, 0.0068),
            (0, -0.008, 0.136, 0.0050, 0.0042),
        ]
    )
    hollow = tube(
        [
            (0, -0.0125, 0.014, 0.0060, 0.0060),
            (0, -0.0105, 0.045, 0.0145, 0.0092),
            (0, -0.0095, 0.080, 0.0160, 0.0080),
            (0, -0.0105, 0.108, 0.0100, 0.0055),
        ]
    )
    origin = (0.0135 * side, 0.016, 0.020)
    return placed(carve(0.004, shell, hollow), origin, right=(1, turn * side, 0), up=(lean * side, back, 1))


def _in_fur(body: Field, depth: float = 0.0017, size: float = 0.017) -> Field:
    """The body with tufts of about `size`, at most `depth` high; the feet stay smooth."""
    rng = np.random.default_rng(4)
    waves = rng.normal(size=(24, 3)) / size * 1.9
    shifts = rng.uniform(0, 2 * np.pi, 24)

    def furred(points: np.ndarray) -> np.ndarray:
        out = body(points)
        near = np.abs(out) < 4 * depth
        p = points[near]
        relief = np.tanh(np.sin(p @ waves.T + shifts).sum(axis=1) / 3.5)
        covered = np.clip((p[:, 2] - 0.035) / 0.04, 0, 1)
        out[near] -= depth * relief * covered
        return out

    return furred
