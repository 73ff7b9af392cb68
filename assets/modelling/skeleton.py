"""Bones, and the person's for the second pose: where they lie in the standing pose and how each turns at its joint."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class Bone:
    """A straight bone from its joint `start` to `end`, carried by its `parent`; `flesh` is the radius round it.

    `rigid` says what moves exactly with the bone: the "core" of its flesh away from the joints, "all" but what is
    next to its first joint, or "nothing".
    """

    parent: str | None
    start: tuple[float, float, float]
    end: tuple[float, float, float]
    flesh: float
    rigid: Literal["core", "all", "nothing"] = "core"


_MIDDLE = {
    "pelvis": Bone(None, (0, 0.01, 0.93), (0, 0.006, 1.00), 0.13),
    "belly": Bone("pelvis", (0, 0.004, 1.03), (0, 0, 1.15), 0.13),
    "chest": Bone("belly", (0, 0, 1.17), (0, 0.02, 1.42), 0.15),
    "head": Bone("chest", (0, 0.026, 1.51), (0, 0.01, 1.74), 0.09, rigid="all"),
}
_LEFT = {
    "clavicle": Bone("chest", (0.05, 0.024, 1.42), (0.160, 0.018, 1.405), 0.055, rigid="nothing"),
    "upper arm": Bone("clavicle", (0.185, 0.016, 1.400), (0.352, 0.026, 1.168), 0.05),
    "forearm": Bone("upper arm", (0.352, 0.026, 1.168), (0.482, -0.008, 0.950), 0.036),
    "hand": Bone("forearm", (0.482, -0.008, 0.950), (0.565, -0.031, 0.80), 0.04, rigid="all"),
    "thigh": Bone("pelvis", (0.090, 0.010, 0.90), (0.105, -0.004, 0.50), 0.08),
    "shin": Bone("thigh", (0.105, -0.004, 0.50), (0.107, 0.025, 0.10), 0.045),
    "foot": Bone("shin", (0.107, 0.025, 0.08), (0.124, -0.14, 0.02), 0.04, rigid="all"),
}


def skeleton(middle: dict[str, Bone], left: dict[str, Bone]) -> dict[str, Bone]:
    """The bones in the middle, and those of the left on both sides."""
    return {**middle, **_side("left", left, 1, middle), **_side("right", left, -1, middle)}


def _side(name: str, bones: dict[str, Bone], sign: int, middle: dict[str, Bone]) -> dict[str, Bone]:
    """The bones of one side, which hang on those in the middle; `sign` -1 mirrors them."""

    def place(p: tuple[float, float, float]) -> tuple[float, float, float]:
        return sign * p[0], p[1], p[2]

    out = {}
    for part, bone in bones.items():
        parent = bone.parent if bone.parent in middle else f"{name} {bone.parent}"
        out[f"{name} {part}"] = replace(bone, parent=parent, start=place(bone.start), end=place(bone.end))
    return out


BONES = skeleton(_MIDDLE, _LEFT)

SECOND_POSE = {
    # Turn at the joint, as a rotation vector in degrees in the standing pose's axes.
    "belly": (0, 0, 10),
    "chest": (0, 0, 8),
    "head": (0, 0, -20),
    "left clavicle": (0, -12, 0),
    "left upper arm": (-10, -42, 0),
    "left forearm": (-12, -84, 0),
    "left hand": (0, 8, 0),
    "right upper arm": (14, -4, 0),
    "right forearm": (30, 0, 0),
    "right thigh": (-42, 0, 0),
    "right shin": (66, 0, 0),
    "right foot": (8, 0, 0),
}


def motions(
    turns: Mapping[str, tuple[float, float, float]], bones: Mapping[str, Bone] = BONES
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """For each bone, listed after its parent, the (3, 3) rotation and (3,) shift that put its points into the pose."""
    out: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    for name, bone in bones.items():
        turn, joint = Rotation.from_rotvec(turns.get(name, (0, 0, 0)), degrees=True).as_matrix(), np.array(bone.start)
        rotation, shift = out[bone.parent] if bone.parent else (np.eye(3), np.zeros(3))
        out[name] = rotation @ turn, rotation @ joint + shift - rotation @ turn @ joint
    return out
