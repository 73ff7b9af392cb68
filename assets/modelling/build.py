"""The samples by name: how each is modelled, and which way it is turned in its file."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import beast, elephant, hand, hare, horse, octopus, person, rings
from .beast_bones import BONES as BEAST_BONES, SECOND_POSE as BEAST_POSE
from .domain import domain
from .part import part
from .pose import posed
from .remesh import cut_open
from .scan import damaged
from .sculpture import facing_front, facing_right
from .skeleton import BONES, SECOND_POSE, motions

Mesh = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Sample:
    """`make` returns points (n, 3) and faces (m, 3), from the mesh of sample `needs` if that is named."""

    make: Callable[..., Mesh]
    turn: Callable[[np.ndarray], np.ndarray] | None = None
    needs: str | None = None


def _hand() -> Mesh:
    shape = hand.sculpture()
    return cut_open(*shape.mesh(), shape.field, shape.wanted, shape.edge, hand.WRIST_CUT)


def _second_pose(figure: Mesh) -> Mesh:
    points, faces = figure
    return posed(points, faces, person.person(), BONES, motions(SECOND_POSE), spacing=1.2 * person.EDGE), faces


def _second_beast(standing: Mesh) -> Mesh:
    points, faces = standing
    motion = motions(BEAST_POSE, BEAST_BONES)
    points = posed(points, faces, beast.beast(), BEAST_BONES, motion, spacing=0.95 * beast.EDGE)
    return points - (0, 0, points[:, 2].min()), faces


def _scan(figure: Mesh) -> Mesh:
    return damaged(*figure, person.EDGE)


SAMPLES = {
    "figure": Sample(lambda: person.sculpture().mesh(), facing_front),
    "figure_pose2": Sample(_second_pose, facing_front, needs="figure"),
    "animal": Sample(lambda: horse.sculpture().mesh(), facing_right),
    "beast": Sample(lambda: beast.sculpture().mesh(), facing_front),
    "beast_pose2": Sample(_second_beast, facing_front, needs="beast"),
    "elephant": Sample(lambda: elephant.sculpture().mesh(), facing_right),
    "octopus": Sample(lambda: octopus.sculpture().mesh(), facing_front),
    "hand": Sample(_hand, facing_front),
    "genus3": Sample(lambda: rings.sculpture().mesh()),
    "domain": Sample(domain),
    "part": Sample(part),
    "scan": Sample(_scan, facing_front, needs="figure"),
    "hare": Sample(hare.scanned),  # left with z up, as many scans are
}


class Workshop:
    """Models samples, each once, however many others start from it."""

    def __init__(self) -> None:
        self._made: dict[str, Mesh] = {}

    def model(self, name: str) -> Mesh:
        """Points and faces of a sample in its modelling axes."""
        if name not in self._made:
            sample = SAMPLES[name]
            self._made[name] = sample.make(*([self.model(sample.needs)] if sample.needs else []))
        return self._made[name]

    def finished(self, name: str) -> Mesh:
        """Points and faces of a sample as its file has them."""
        points, faces = self.model(name)
        turn = SAMPLES[name].turn
        return (turn(points) if turn else points), faces
