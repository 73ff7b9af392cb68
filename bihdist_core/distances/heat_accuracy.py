"""How far the heat method is off on a mesh, measured against exact geodesic distances from a few vertices."""

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..counts import counted
from ..errors import SolverError
from ..progress import Progress, part
from ..surface import Surface
from .accuracy import ErrorEstimate
from .exact_geodesic import ExactGeodesic, expected_windows
from .heat_times import HeatTimes, farthest, spread_vertices

ERROR_SOURCES = 8
"""Vertices that errors are measured from, in turn the farthest from those before and that where they were off the most.

From others the largest error was up to 1.7 times as large on 39 meshes.
"""

TIE_TOLERANCE = 1e-9
"""Distances and errors nearer to each other than this share of themselves are equal but for rounding."""

FROM_LINES = ErrorEstimate(
    "accurate to 10 % of the maximum typically from curves and boundary loops, and far worse on narrow or coarse "
    "meshes",
    True,
)
"""Where errors from lines cannot be measured: from half of 14 loops they were more than 7.5 %, from one 230 %."""

MOST_WINDOWS = 30_000_000
"""The work up to which errors are measured, some 5 seconds: where one exact field is more, they are not."""


@dataclass(frozen=True)
class HeatErrors:
    """|heat - exact| over the fields from some sources, as fractions of each field's maximum."""

    mean: float
    largest: float
    sources: int

    def estimate(self, below: float = 0.0) -> ErrorEstimate:
        """Word the errors with the number of sources, as they are no bound.

        `below` is the fraction of the maximum by which some field fell below the straight line, as no geodesic
        distance does.
        """
        mean, largest = _percent(self.mean), _percent(max(self.largest, below))
        vertices = counted(self.sources, "vertex", "vertices")
        if below > self.largest:
            text = (
                f"accurate to {mean} of the maximum in the mean from {vertices}; one is {largest} below a straight line"
            )
        else:
            text = (
                f"accurate to {mean} of the maximum in the mean and {largest} at the worst from {vertices}; from "
                "others it may be further off"
            )
        return ErrorEstimate(text, True, max(self.largest, below), f"{mean} off in the mean", self.sources)

    def estimate_from_lines(self) -> ErrorEstimate:
        """Say it in words, of the very lines that it was measured from."""
        mean, largest = _percent(self.mean), _percent(self.largest)
        text = f"accurate to {mean} of the maximum in the mean and {largest} at the worst"
        return ErrorEstimate(text, True, self.largest, f"up to {largest} off")


def heat_errors(surface: Surface, heat: HeatTimes, progress: Progress | None = None) -> HeatErrors | None:
    """Measure the errors on a connected surface; None where it is too large or has no exact distances."""
    try:
        exact = ExactGeodesic(surface)
        count = min(ERROR_SOURCES, int(MOST_WINDOWS / expected_windows(exact, part(progress, 0, 0))))
        if not count:
            return None
        nearest, worst = np.full(len(surface.vertices), np.inf), np.zeros(len(surface.vertices))
        means, largest, source = [], 0.0, int(spread_vertices(surface.vertices, 1)[0])
        for k in range(count):
            field = exact.distances(source, part(progress, k / count, (k + 1) / count))
            off = np.abs(heat.distances(source) - field) / field.max()
            means.append(float(off.mean()))
            largest = max(largest, float(off.max()))
            np.minimum(nearest, field, out=nearest)
            np.maximum(worst, off, out=worst)
            worst[nearest == 0] = 0
            source = farthest(worst if k % 2 else nearest, surface.vertices, TIE_TOLERANCE)
    except SolverError:
        return None
    return HeatErrors(float(np.mean(means)), largest, count)


def below_straight_line(surface: Surface, source: int, field: FloatArray) -> float:
    """Measure how far a field (n,) from a vertex falls below straight lines, as a fraction of its maximum."""
    apart = surface.vertices - surface.vertices[source]
    straight = np.sqrt(np.einsum("ij,ij->i", apart, apart))
    return float(max((straight - field).max(), 0.0) / max(straight.max(), field.max()))


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"
