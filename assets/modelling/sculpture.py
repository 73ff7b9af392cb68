"""What one shape's module hands over, and the steps from it to a mesh."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .edits import WorkOrder
from .fields import Field
from .polygonise import polygonise
from .remesh import remesh


@dataclass(frozen=True)
class Sculpture:
    """A solid and how finely to mesh it; all lengths in the solid's own unit.

    `low` and `high` bound it, `grid` is the step of the first polygonisation, `edge` the edge length where nothing
    asks for a finer one, and `wanted(points)` the edge length there, (n,).
    """

    field: Field
    low: Sequence[float]
    high: Sequence[float]
    grid: float
    edge: float
    wanted: WorkOrder

    def mesh(self) -> tuple[np.ndarray, np.ndarray]:
        """(n, 3) points and (m, 3) faces, facing outwards."""
        rough = polygonise(self.field, self.low, self.high, self.grid)
        return remesh(*rough, self.field, self.wanted, self.edge)


def ramp(values: np.ndarray, start: float, stop: float, least: float) -> np.ndarray:
    """(n,) factors that rise from `least` where values are below `start` to 1 above `stop`."""
    return least + (1 - least) * np.clip((values - start) / (stop - start), 0, 1)


def facing_front(points: np.ndarray) -> np.ndarray:
    """(n, 3) points modelled with z up and the face towards -y, as the viewer wants them: y up, facing z."""
    return points[:, [0, 2, 1]] * (1, 1, -1)


def facing_right(points: np.ndarray) -> np.ndarray:
    """(n, 3) points modelled with z up and the head towards -y, as the viewer wants them: y up, the head towards x."""
    return points[:, [1, 2, 0]] * (-1, 1, -1)
