"""How far the heat method is off on a mesh, measured against exact geodesic distances from a few vertices."""

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..counts import counted
from ..errors import SolverError
from ..progress import Progress, part
from ..surface import Surface
from .accuracy import ErrorEstimate
from .exact_geodesic import ExactGeodesic
from .exact_work import expected_windows
from .heat_times import HeatTimes

SOURCES = 8
"""Vertices that errors are measured from, each as far from those before as can be.  The largest error from any other
was up to 1.6 times as large on 28 meshes; from four it was up to 2.7 times as large."""

MOST_WINDOWS = 30_000_000
"""The work up to which errors are measured, some 5 seconds: where one exact field is more, they are not."""


@dataclass(frozen=True)
class HeatErrors:
    """|heat - exact| over the fields from some sources, as fractions of each field's maximum."""

    mean: float
    largest: float
    sources: int

    def estimate(self, below: float = 0.0) -> ErrorEstimate:
        """In words.

        below: a fraction of the maximum by which some field fell below the straight line, which no geodesic distance
        does.
        """
        mean, largest = _percent(self.mean), _percent(max(self.largest, below))
        text = f"accurate to {mean} of the maximum in the mean and {largest} at the worst"
        if below > self.largest:
            text += ", where it falls below the straight line"
        text += f", as measured from {counted(self.sources, 'vertex', 'vertices')}"
        return ErrorEstimate(text, True, max(self.largest, below), f"{mean} off in the mean")


def heat_errors(surface: Surface, heat: HeatTimes, progress: Progress | None = None) -> HeatErrors | None:
    """The errors on a connected surface; None where it is too large for that or exact distances cannot be had."""
    try:
        exact = ExactGeodesic(surface)
        count = min(SOURCES, int(MOST_WINDOWS / expected_windows(exact, part(progress, 0, 0))))
        if not count:
            return None
        nearest = np.full(len(surface.vertices), np.inf)
        means, largest, source = [], 0.0, 0
        for k in range(count):
            field = exact.distances(source, part(progress, k / count, (k + 1) / count))
            off = np.abs(heat.distances(source) - field) / field.max()
            means.append(float(off.mean()))
            largest = max(largest, float(off.max()))
            np.minimum(nearest, field, out=nearest)
            source = int(nearest.argmax())
    except SolverError:
        return None
    return HeatErrors(float(np.mean(means)), largest, count)


def below_straight_line(surface: Surface, source: int, field: FloatArray) -> float:
    """By how much of its maximum a field (n,) from a vertex falls below straight lines at most; 0 where it does not."""
    apart = surface.vertices - surface.vertices[source]
    straight = np.sqrt(np.einsum("ij,ij->i", apart, apart))
    return float(max((straight - field).max(), 0.0) / max(straight.max(), field.max()))


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"
