"""The sample `elephant`: an elephant feeding, its trunk to its mouth; 1.5 at the withers, z up, head towards -y."""

import numpy as np

from .fields import Field, ellipsoid, tube, within_reach
from .joins import both_sides, carve, join, join_by, standing_on
from .sculpture import Sculpture, ramp

EDGE = 0.0565


def sculpture() -> Sculpture:
    """Finer triangles on head, trunk, ears, feet and tail."""
    return Sculpture(
        elephant(), low=(-0.85, -1.65, -0.05), high=(0.85, 1.15, 2.0), grid=0.016, edge=EDGE, wanted=wanted_edge
    )


def wanted_edge(points: np.ndarray) -> np.ndarray:
    """(n,) edge lengths."""
    x, y, z = np.abs(points[:, 0]), points[:, 1], points[:, 2]
    head = ramp(y, -0.75, -0.35, 0.48)
    feet = ramp(z, 0.09, 0.36, 0.40)
    tail = ramp(-y, -0.92, -0.80, 0.42)
    ears = ramp(-x, -0.42, -0.32, 0.48)
    eyes = ramp(np.hypot(x - 0.176, np.hypot(y + 0.96, z - 1.42)), 0.06, 0.14, 0.25)
    return EDGE * np.minimum(np.minimum(np.minimum(head, eyes), feet), np.minimum(tail, np.where(y < -0.1, ears, 1)))


def elephant() -> Field:
    """Body, legs, head with trunk, ears and tail, joined."""
    body = join(0.15, _body(), _legs())
    whole = join(0.06, join(0.11, body, _head()), both_sides(_ear()))
    # The trunk flows into itself only where its end meets its root.
    trunk = join_by(lambda p: 1e-3 + 0.08 * ramp(p[:, 2], 0.80, 0.98, 0), *_trunk())
    return join(0.04, join(0.06, whole, trunk), both_sides(_tusk()), _tail())


def _body() -> Field:
    barrel = tube(
        [
            # x, y, z, half-width, half-height
            (0, -0.52, 1.14, 0.20, 0.26),
            (0, -0.40, 1.10, 0.29, 0.35),  # shoulder
            (0, -0.20, 1.04, 0.345, 0.385),
            (0, 0.05, 1.01, 0.385, 0.395),
            (0, 0.28, 1.04, 0.375, 0.390),
            (0, 0.50, 1.09, 0.315, 0.350),  # hips
            (0, 0.66, 1.08, 0.20, 0.27),
        ],
        reach=0.3,
        steps=12,
    )
    spine = tube(
        [
            (0, -0.50, 1.42, 0.09, 0.07),
            (0, -0.36, 1.45, 0.10, 0.08),
            (0, -0.10, 1.385, 0.09, 0.07),
            (0, 0.15, 1.365, 0.08, 0.07),
            (0, 0.38, 1.415, 0.10, 0.08),
            (0, 0.56, 1.365, 0.11, 0.08),
            (0, 0.72, 1.24, 0.09, 0.07),
        ],
        reach=0.3,
        steps=12,
    )
    return join(0.14, barrel, spine)


def _legs() -> Field:
    """The left fore foot and the right hind foot are ahead of the others."""
    legs = [_fore_leg(0.215, -0.13), _fore_leg(-0.215, 0.04), _hind_leg(0.20, 0.06), _hind_leg(-0.20, -0.13)]
    return standing_on(0.0, join(0.02, *legs), 0.03)


def _fore_leg(x: float, ahead: float) -> Field:
    """`ahead` is how far the foot is moved along y."""
    side, y = np.sign(x), -0.40
    leg = tube(
        [
            # x, y, z, half-width, half-depth
            (x - 0.02 * side, y, 1.10, 0.13, 0.20),
            (x, y + 0.15 * ahead, 0.85, 0.145, 0.18),
            (x, y + 0.35 * ahead, 0.65, 0.125, 0.142),
            (x, y + 0.60 * ahead - 0.01, 0.48, 0.112, 0.122),  # wrist
            (x, y + 0.80 * ahead, 0.30, 0.102, 0.106),
            (x, y + 0.95 * ahead, 0.14, 0.112, 0.118),
            (x, y + ahead - 0.012, 0.03, 0.132, 0.142),
        ],
        reach=0.3,
        steps=10,
    )
    shoulder = ellipsoid((x - 0.03 * side, y - 0.01, 1.08), (0.12, 0.19, 0.27), up=(0, 0.3, 1), reach=0.3)
    return join(0.02, join(0.08, leg, shoulder), *_toenails(x, y + ahead - 0.012, 0.136, 0.146))


def _hind_leg(x: float, ahead: float) -> Field:
    side, y = np.sign(x), 0.52
    leg = tube(
        [
            (x - 0.01 * side, y - 0.02, 1.05, 0.15, 0.23),
            (x + 0.01 * side, y - 0.02 + 0.2 * ahead, 0.82, 0.155, 0.215),
            (x, y - 0.03 + 0.4 * ahead, 0.64, 0.132, 0.165),
            (x, y + 0.01 + 0.5 * ahead, 0.48, 0.112, 0.125),  # heel, high above the sole
            (x, y + 0.035 + 0.75 * ahead, 0.30, 0.098, 0.105),
            (x, y + 0.03 + 0.95 * ahead, 0.14, 0.106, 0.114),
            (x, y + 0.01 + ahead, 0.03, 0.122, 0.138),
        ],
        reach=0.3,
        steps=10,
    )
    return join(0.02, leg, *_toenails(x, y + 0.01 + ahead, 0.126, 0.142))


def _toenails(x: float, y: float, width: float, depth: float) -> list[Field]:
    nails = []
    for turn in np.radians([-48, -16, 16, 48]):
        place = (x + width * np.sin(turn), y - depth * np.cos(turn), 0.045)
        nails.append(ellipsoid(place, (0.034, 0.022, 0.040), right=(np.cos(turn), np.sin(turn), 0)))
    return nails


def _head() -> Field:
    neck = tube(
        [(0, -0.45, 1.20, 0.20, 0.26), (0, -0.62, 1.30, 0.185, 0.25), (0, -0.78, 1.36, 0.17, 0.22)], reach=0.3, steps=10
    )
    skull = ellipsoid((0, -0.85, 1.44), (0.205, 0.205, 0.255), up=(0, 0.35, 1), reach=0.3)
    domes = both_sides(ellipsoid((0.062, -0.82, 1.605), (0.090, 0.125, 0.090), reach=0.3), 0.03)
    face = tube(
        [(0, -0.90, 1.50, 0.165, 0.13), (0, -1.00, 1.34, 0.150, 0.12), (0, -1.06, 1.20, 0.128, 0.105)],
        reach=0.3,
        steps=10,
    )
    cheek = both_sides(ellipsoid((0.125, -0.88, 1.30), (0.075, 0.13, 0.12), reach=0.3), 0.01)
    jaw = tube(
        [(0, -0.80, 1.20, 0.125, 0.10), (0, -0.88, 1.08, 0.088, 0.070), (0, -0.93, 1.01, 0.050, 0.042)],
        reach=0.3,
        steps=10,
    )
    temple = both_sides(ellipsoid((0.245, -0.90, 1.475), (0.06, 0.07, 0.07), reach=0.3))
    brow = both_sides(tube([(0.172, -0.90, 1.490, 0.024), (0.182, -0.96, 1.462, 0.022), (0.172, -1.01, 1.42, 0.020)]))
    eye = both_sides(ellipsoid((0.184, -0.968, 1.408), (0.026, 0.034, 0.026), right=(1, -0.35, 0)))
    head = carve(0.08, join(0.10, skull, domes, face, cheek), temple)
    head = join(0.08, neck, join(0.06, head, jaw))
    return join(0.012, join(0.04, head, brow), eye)


def _trunk() -> list[Field]:
    """Down and forwards, then back up; its end is held in the mouth and closes the ring."""
    rows = [
        (0, -1.02, 1.30, 0.130, 0.120),
        (0, -1.11, 1.17, 0.118, 0.112),
        (0, -1.220, 1.01, 0.106, 0.102),
        (0, -1.310, 0.84, 0.096, 0.093),
        (0, -1.340, 0.69, 0.087, 0.085),
        (0, -1.290, 0.565, 0.079, 0.077),
        (0, -1.185, 0.520, 0.073, 0.071),
        (0, -1.085, 0.565, 0.068, 0.066),
        (0, -1.020, 0.670, 0.064, 0.062),
        (0, -0.998, 0.790, 0.061, 0.059),
        (0, -1.000, 0.910, 0.058, 0.057),
        (0, -0.990, 1.020, 0.056, 0.056),
        (0, -0.950, 1.120, 0.056, 0.056),
    ]
    return [tube(part, reach=0.3, steps=12) for part in (rows[:8], rows[6:])]


def _tusk() -> Field:
    return tube(
        [
            (0.105, -1.02, 1.20, 0.046),
            (0.175, -1.09, 1.08, 0.043),
            (0.225, -1.17, 0.985, 0.039),
            (0.245, -1.27, 0.935, 0.033),
        ],
        reach=0.2,
    )


def _ear() -> Field:
    """A sheet with a round rim, wide at the top and pointed below, flared from the head and waved at the back."""
    root, out, thick = np.array([0.165, -0.85, 0]), np.array([0.80, 0.60, 0]), 0.036
    ahead = np.array([0.60, -0.80, 0])
    # Drawn in the plane of (along the sheet, 0, z).
    wide = tube([(0.275, 0, 1.45, 0.265), (0.26, 0, 1.25, 0.225), (0.22, 0, 1.05, 0.125), (0.185, 0, 0.91, 0.055)])
    lobe = tube([(0.10, 0, 1.58, 0.115), (0.10, 0, 1.40, 0.13), (0.10, 0, 1.20, 0.11)])
    corner = tube([(0.28, 0, 1.53, 0.19), (0.37, 0, 1.55, 0.14)])
    outline = join(0.10, wide, lobe, corner)

    def sheet(points: np.ndarray) -> np.ndarray:
        from_root = points - root
        along, off, z = from_root @ out, from_root @ ahead, points[:, 2]
        late = np.clip((along - 0.1) / 0.4, 0, 1)
        off = off + 0.9 * (along - 0.25) ** 2 * np.sign(along - 0.25) + 0.022 * late * np.sin(15 * z - 4 * along)
        rim = outline(np.stack([along, np.zeros(len(points)), z], 1)) + thick
        return 0.9 * (np.hypot(np.maximum(rim, 0), off) - thick)

    return within_reach(sheet, np.array([0.05, -0.95, 0.8]), np.array([0.65, -0.3, 1.8]), 0.3)


def _tail() -> Field:
    return tube(
        [
            (0.00, 0.74, 1.22, 0.060),
            (0.00, 0.85, 1.14, 0.044),
            (0.02, 0.93, 1.00, 0.036),
            (0.05, 0.97, 0.84, 0.032),
            (0.08, 0.98, 0.70, 0.032),
            (0.10, 0.97, 0.58, 0.044),
            (0.11, 0.96, 0.48, 0.026),
        ],
        reach=0.2,
        steps=10,
    )
