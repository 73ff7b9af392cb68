"""A field that is linear on each face, over the area of its surface: mean, quantiles and histogram, all exact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import BoolArray, FloatArray
from ..surface import Surface


@dataclass(frozen=True, eq=False)
class LinearField:
    """A field on m triangles, linear on each, in any unit.

    `low`, `middle` and `high` (m,) are its values at the corners of each triangle, ascending, and `areas` (m,) those of
    the triangles. `ends` (k,) are the values at all corners, ascending; between two of them the area below a value is a
    quadratic polynomial of it.
    """

    low: FloatArray
    middle: FloatArray
    high: FloatArray
    areas: FloatArray
    ends: FloatArray

    @classmethod
    def on(cls, surface: Surface, field: FloatArray) -> LinearField:
        """Make the linear field of (n,) values; faces with a corner that is not finite are left out."""
        corners = field[surface.faces]
        there = np.isfinite(corners).all(axis=1)
        at_vertex = np.zeros(len(field), bool)
        at_vertex[surface.faces[there]] = True
        low, middle, high = np.sort(corners[there], axis=1).astype(np.float64).T
        return cls(low, middle, high, surface.face_areas[there], np.sort(field[at_vertex].astype(np.float64)))

    @property
    def area(self) -> float:
        """Area of the faces, unit length squared."""
        return float(self.areas.sum())

    def mean(self) -> float:
        """Return the exact mean of the field by area, in the field's unit."""
        # From one of the values on, so that rounding leaves a constant field its value.
        start = self.ends[0]
        return float(start + self._mean(((self.low - start) + (self.middle - start) + (self.high - start)) / 3))

    def mean_size(self) -> float:
        """Return the exact mean of the field's absolute value by area."""
        a, b, c = self.low, self.middle, self.high
        sign = np.where(b < 0, -1, 1)
        # The one corner on its side of 0, if there is one: what a change of sign adds is twice a smaller triangle.
        lone = np.maximum(np.where(b < 0, c, -a), 0)
        other = np.where(b < 0, -a, c)
        with np.errstate(divide="ignore", invalid="ignore"):
            corner = lone * (lone / (lone + np.abs(b))) * (lone / (lone + other))
        return self._mean((sign * (a + b + c) + 2 * np.where(lone > 0, corner, 0)) / 3)

    def deviation(self, mean: float) -> float:
        """Return the root of the mean square of the field less a value."""
        a, b, c = self.low - mean, self.middle - mean, self.high - mean
        return float(np.sqrt(self._mean((a * (a + b) + b * (b + c) + c * (c + a)) / 6)))

    def area_below(self, value: float, closed: bool = False) -> float:
        """Return the area on which the field is less than a value, or, closed, at most that.

        Where it is the value on whole triangles the two differ.
        """
        whole = (self.high <= value) if closed else (self.high <= value) & (self.low < value)
        cut = np.flatnonzero((self.low < value) & (value < self.high))
        low, middle, high = self.low[cut], self.middle[cut], self.high[cut]
        # The value cuts a triangle off the lowest corner or the highest.
        lower = value <= middle
        side = np.where(lower, value - low, high - value)
        corner = side / np.where(lower, middle - low, high - middle) * (side / (high - low))
        return float(self.areas @ whole + self.areas[cut] @ np.where(lower, corner, 1 - corner))

    def histogram(self, edges: FloatArray) -> FloatArray:
        """Return (b,) the area between each two of (b + 1,) ends, ascending.

        Triangles on an end count above it, those on the last below it.
        """
        first, last = (np.searchsorted(edges, values, "right") - 1 for values in (self.low, self.high))
        one = (first == last) & (first >= 0) & (first < len(edges) - 1)
        cut = self._part(~one)
        reached = [*map(cut.area_below, edges[:-1]), cut.area_below(edges[-1], closed=True)]
        # Rounding may leave less than nothing between two ends.
        inside = np.bincount(first[one], self.areas[one], len(edges) - 1).astype(float, copy=False)
        return inside + np.maximum(np.diff(reached), 0)

    def quantiles(self, fractions: npt.ArrayLike) -> FloatArray:
        """Return (q,) the least values that the field does not exceed on these fractions (q,), from 0 to 1, of the
        area."""
        area, most = self.area, float(self.ends[-1])
        return np.array([self._value_at(x * area) if x < 1 else most for x in np.asarray(fractions, np.float64)])

    def _value_at(self, area: float) -> float:
        faces, below, ends = self, 0.0, self.ends
        first, last = 0, len(ends) - 1
        while first < last:
            half = (first + last) // 2
            if below + faces.area_below(ends[half], closed=True) >= area:
                last = half
            else:
                first = half + 1
                # What is below in any case is not asked again.
                done = faces.high <= ends[half]
                below += float(faces.areas @ done)
                faces = faces._part(~done)
            faces = faces._part(faces.low <= ends[last])
        upper = float(ends[first])
        if first == 0 or below + faces.area_below(upper) < area:
            return upper
        lower = float(ends[first - 1])
        missing = [below + faces.area_below(value) - area for value in (lower, (lower + upper) / 2, upper)]
        return lower + (upper - lower) * _root(*missing)

    def _part(self, chosen: BoolArray) -> LinearField:
        if chosen.all():
            return self
        return LinearField(self.low[chosen], self.middle[chosen], self.high[chosen], self.areas[chosen], self.ends)

    def _mean(self, of_face: FloatArray) -> float:
        return float(self.areas @ of_face / self.areas.sum())


def _root(start: float, half: float, end: float) -> float:
    """Return the root from 0 to 1 of an ascending quadratic polynomial, given at 0, 1/2 and 1."""
    square = 2 * (start + end - 2 * half)
    linear = max(end - start - square, 0.0)
    discriminant = max(linear**2 - 4 * square * start, 0.0)
    # The form without cancellation, for a linear polynomial too.
    divisor = linear + np.sqrt(discriminant)
    return float(np.clip(-2 * start / divisor, 0, 1)) if divisor > 0 else 1.0
