"""The sample `figure`: a standing person of 1.80 m; metres, z up, face towards -y, soles on z = 0."""

import numpy as np

from .fields import Field
from .head import head
from .joins import both_sides, join
from .limbs import arm, leg
from .sculpture import Sculpture, ramp
from .trunk import trunk

EDGE = 0.0187


def sculpture() -> Sculpture:
    """Finer triangles on hands, face, toes and navel."""
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
    x, y, z = np.abs(points[:, 0]), points[:, 1], points[:, 2]
    hands = ramp(np.hypot(x - 0.53, z - 0.86), 0.11, 0.24, 0.334)
    head = ramp(-z, -1.57, -1.47, 0.74)
    face = ramp(np.linalg.norm((points - (0, -0.10, 1.65)) / (0.055, 0.05, 0.05), axis=1), 0.8, 2.2, 0.29)
    ears = ramp(np.linalg.norm(np.stack([x, y, z], 1) - (0.085, 0.02, 1.67), axis=1), 0.03, 0.07, 0.32)
    toes = ramp(np.maximum(y + 0.12, z - 0.04), 0.0, 0.10, 0.43)
    feet = ramp(z, 0.05, 0.16, 0.88)
    eyes = ramp(np.linalg.norm(np.stack([x, y, z], 1) - (0.032, -0.08, 1.686), axis=1), 0.018, 0.045, 0.24)
    mouth = ramp(np.linalg.norm(points - (0, -0.1, 1.616), axis=1), 0.024, 0.05, 0.25)
    navel = ramp(np.linalg.norm(points - (0, -0.09, 1.066), axis=1), 0.016, 0.08, 0.4)
    return EDGE * np.min([hands, head, face, eyes, mouth, ears, toes, feet, navel], axis=0)


def person() -> Field:
    """Trunk, legs, arms and head, joined."""
    trunk_and_legs = join(0.065, trunk(), both_sides(leg(), 0.012))
    return join(0.03, join(0.035, trunk_and_legs, both_sides(arm())), head())
