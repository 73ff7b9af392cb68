"""How far approximate geodesic distances are off, measured against exact ones."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..arrays import FloatArray
from ..counts import counted
from ..errors import SolverError
from ..progress import Progress, part
from ..surface import Surface
from .accuracy import ErrorEstimate
from .exact_geodesic import QUICK_WINDOWS, ExactGeodesic, expected_windows
from .heat_times import farthest, spread_vertices

ERROR_SOURCES = 8
"""Vertices that errors are measured from, in turn the farthest from those before and that where they were off the most.

From others the largest error was up to 1.7 times as large on 39 meshes.
"""

TIE_TOLERANCE = 1e-9
"""Distances and errors nearer to each other than this share of themselves are equal but for rounding."""

BEYOND = 1.25
"""See `MeasuredErrors.of`: judged by 5, 12 and 30 % of the vertices of 13 meshes, what is stated was 1.2 to 46 times
the largest error."""

FROM_LINES = ErrorEstimate(
    "accurate to 5 % of the maximum typically from curves and boundary loops, and worse on narrow or coarse meshes",
    True,
)
"""Where errors from lines cannot be measured: from half of 20 loops they were more than 3 %, on a strip four faces wide
16 %."""


class Approximate(Protocol):
    """A method that is not exact."""

    def distances(self, source: int, /) -> FloatArray:
        """Return (n,) distances from a vertex."""


@dataclass(frozen=True)
class MeasuredErrors:
    """|approximate - exact| over fields from some sources, as fractions of each field's maximum.

    `nearest` counts the vertices that were compared, from the source outwards, where these are not all.
    """

    mean: float
    largest: float
    sources: int = 1
    nearest: int | None = None

    @classmethod
    def of(cls, field: FloatArray, true: FloatArray) -> "MeasuredErrors":
        """Compare a field (n,) with the exact one, which is finite as far as it goes.

        Where it ends early, what lies beyond is judged by the fractions of their distance by which vertices are off
        that are not among the nearest, times `BEYOND` and the root of how many times as many vertices there are.
        """
        known = np.isfinite(true)
        count, top, off = int(known.sum()), true[known].max(), np.abs(field - true)[known]
        more = np.isfinite(field).sum() / count
        if more == 1:
            return cls(float(off.mean() / top), float(off.max() / top))
        is_far = true[known] >= top / 4
        shares = off[is_far] / true[known][is_far]
        return cls(float(shares.mean()), float(shares.max() * BEYOND * np.sqrt(more)), nearest=count)

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

    def of_this_field(self) -> ErrorEstimate:
        """Say it in words, of the very field that was measured."""
        mean, largest = _percent(self.mean), _percent(self.largest)
        text = f"accurate to {mean} of the maximum in the mean and {largest} at the worst"
        if self.nearest is None:
            return ErrorEstimate(text, True, self.largest, f"up to {largest} off")
        text += f", judged by the nearest {counted(self.nearest, 'vertex', 'vertices')}"
        return ErrorEstimate(text, True, self.largest, f"{mean} off in the mean")


def sampled_errors(surface: Surface, made: Approximate, progress: Progress | None = None) -> MeasuredErrors | None:
    """Measure the errors on a connected surface; None where it is too large or has no exact distances."""
    try:
        exact = ExactGeodesic(surface)
        count = min(ERROR_SOURCES, int(QUICK_WINDOWS / expected_windows(exact, part(progress, 0, 0))))
        if not count:
            return None
        nearest, worst = np.full(len(surface.vertices), np.inf), np.zeros(len(surface.vertices))
        means, largest, source = [], 0.0, int(spread_vertices(surface.vertices, 1)[0])
        for k in range(count):
            field = exact.distances(source, part(progress, k / count, (k + 1) / count))
            off = np.abs(made.distances(source) - field) / field.max()
            means.append(float(off.mean()))
            largest = max(largest, float(off.max()))
            np.minimum(nearest, field, out=nearest)
            np.maximum(worst, off, out=worst)
            worst[nearest == 0] = 0
            source = farthest(worst if k % 2 else nearest, surface.vertices, TIE_TOLERANCE)
    except SolverError:
        return None
    return MeasuredErrors(float(np.mean(means)), largest, count)


def below_straight_line(surface: Surface, source: int, field: FloatArray) -> float:
    """Measure how far a field (n,) from a vertex falls below straight lines, as a fraction of its maximum."""
    apart = surface.vertices - surface.vertices[source]
    straight = np.sqrt(np.einsum("ij,ij->i", apart, apart))
    return float(max((straight - field).max(), 0.0) / max(straight.max(), field.max()))


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"
