"""The beast's bones and its second pose: a crouching stride, an arm raised, head and tail turned."""

from .skeleton import Bone, skeleton

_MIDDLE = {
    "pelvis": Bone(None, (0, 0.050, 0.36), (0, 0.040, 0.42), 0.17),
    "belly": Bone("pelvis", (0, 0.035, 0.46), (0, 0.035, 0.58), 0.19),
    "chest": Bone("belly", (0, 0.040, 0.62), (0, 0.020, 0.78), 0.18),
    "head": Bone("chest", (0, -0.040, 0.87), (0, -0.250, 0.91), 0.14, rigid="all"),
    "crown": Bone("head", (0, -0.050, 0.96), (0, 0.030, 1.12), 0.14, rigid="all"),
    "tail root": Bone("pelvis", (0, 0.140, 0.33), (0, 0.310, 0.175), 0.12),
    "tail": Bone("tail root", (0, 0.310, 0.175), (0, 0.520, 0.065), 0.08),
    "tail tip": Bone("tail", (0, 0.520, 0.065), (0, 0.800, 0.090), 0.045),
}
_LEFT = {
    "upper arm": Bone("chest", (0.170, 0.015, 0.735), (0.348, 0.033, 0.622), 0.07),
    "forearm": Bone("upper arm", (0.348, 0.033, 0.622), (0.458, -0.082, 0.552), 0.058),
    "hand": Bone("forearm", (0.458, -0.082, 0.552), (0.558, -0.242, 0.512), 0.05, rigid="all"),
    "thigh": Bone("pelvis", (0.125, 0.020, 0.36), (0.186, -0.025, 0.22), 0.13),
    "shin": Bone("thigh", (0.186, -0.025, 0.22), (0.180, 0.005, 0.07), 0.075),
    "foot": Bone("shin", (0.180, 0.005, 0.055), (0.190, -0.180, 0.03), 0.06, rigid="all"),
}

BONES = skeleton(_MIDDLE, _LEFT)

SECOND_POSE = {
    # Turn at the joint, as a rotation vector in degrees in the standing pose's axes.
    "pelvis": (14, 8, 0),
    "belly": (5, -4, -9),
    "chest": (6, -4, -10),
    "head": (-12, 0, 30),
    "tail root": (-14, 0, -12),
    "tail": (2, 0, -24),
    "tail tip": (2, 0, -28),
    "left upper arm": (-5, -46, 24),
    "left forearm": (-34, -40, 0),
    "left hand": (-10, -15, 0),
    "right upper arm": (28, -8, 0),
    "right forearm": (-25, 0, 0),
    "left thigh": (-48, 0, 8),
    "left shin": (35, 0, 0),
    "left foot": (-1, -6, 0),
    "right thigh": (8, 0, 0),
    "right shin": (25, 0, 0),
    "right foot": (-26, 0, 0),
}
