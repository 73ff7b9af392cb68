"""The difference of two fields: where one distance is larger than another."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray
from ..errors import ParameterError
from ..number_arrays import real_numbers


def difference(minuend: npt.ArrayLike, subtrahend: npt.ArrayLike, raw: bool = False) -> FloatArray:
    """Two fields (n,) or (n, k) as one, positive where the first is larger; NaN where either is.

    Distances have different units, so each field is taken as a share of its own maximum (by column; of the largest
    absolute value, where some are negative): the result lies between -1 and 1, or -2 and 2 with negative values.  raw:
    the values themselves are subtracted, which makes sense for equal units only.  Raises ParameterError for fields of
    different shapes.

    >>> import bihdist
    >>> bihdist.difference([0, 1, 2], [0, 30, 40]).tolist()  # 1/2 - 3/4 in the middle
    [0.0, -0.25, 0.0]
    >>> bihdist.difference([0, 1, 2], [0, 30, 40], raw=True).tolist()
    [0.0, -29.0, -38.0]
    """
    a, b = (real_numbers(field, "Values of a field") for field in (minuend, subtrahend))
    if a.shape != b.shape or a.ndim not in (1, 2):
        raise ParameterError(f"Fields of shapes {a.shape} and {b.shape} have no difference.")
    return a - b if raw else _shares(a) - _shares(b)


PERCENTAGE_POINTS = "percentage points"
"""The unit of a difference of fractions, each of its own maximum, times 100."""


def scale_of(unit: str) -> float:
    """What fractions of a maximum are multiplied by to be in a field's unit."""
    return 100.0 if unit == PERCENTAGE_POINTS else 1.0


def difference_in_unit(
    minuend: npt.ArrayLike, subtrahend: npt.ArrayLike, units: tuple[str, str] = ("", ""), raw: bool = False
) -> tuple[FloatArray, str]:
    """The `difference` of two fields (n,) or (n, k), and its unit: percentage points, or, raw, the unit of the fields.

    units: of both fields; one without, which is no distance, is taken to be in the unit of the other.  Raises
    ParameterError for fields of different shapes and, raw, of different units.
    """
    if not raw:
        return 100 * difference(minuend, subtrahend), PERCENTAGE_POINTS
    if all(units) and units[0] != units[1]:
        raise ParameterError(f"Values in {units[0]} and in {units[1]} have no difference; leave out raw.")
    return difference(minuend, subtrahend, raw=True), units[0] or units[1]


def _shares(field: FloatArray) -> FloatArray:
    top = np.nanmax(np.abs(field), axis=0, initial=0.0)
    return field / np.where(top > 0, top, 1.0)
