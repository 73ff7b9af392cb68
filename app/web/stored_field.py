"""A field of the user's own as a page holds it: in single precision, the same from every source."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bihdist_core.arrays import FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class StoredField:
    """Values (n,) as multiples of a power of two, so that none is too large or too small; NaN where undefined.

    error: how far rounding moves a value at most, as a fraction of the largest.
    """

    multiples: npt.NDArray[np.float32]
    scale: float
    error: float

    @classmethod
    def of(cls, values: FloatArray, ids: IntArray) -> StoredField:
        """ids (n,): whose values stand one after another."""
        largest = float(np.nanmax(np.abs(values), initial=0.0))
        exponent = int(np.frexp(largest)[1]) - 1
        exact = np.ldexp(values[ids], -exponent)
        multiples = exact.astype(np.float32)
        error = float(np.nanmax(np.abs(multiples - exact), initial=0.0))
        return cls(multiples, float(np.ldexp(1.0, exponent)), error / float(np.ldexp(largest, -exponent) or 1.0))

    @property
    def packed(self) -> bytes:
        """The scale, then the first bytes of all numbers, then all second ones, and so on."""
        planes = self.multiples.astype("<f4").view(np.uint8).reshape(-1, 4).T
        return np.array(self.scale, "<f8").tobytes() + planes.tobytes()
