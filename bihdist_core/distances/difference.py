"""The difference of two fields: where one distance is larger than another."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, real_numbers
from ..errors import ParameterError


def difference(minuend: npt.ArrayLike, subtrahend: npt.ArrayLike, raw: bool = False) -> FloatArray:
    """Subtract two fields, each taken as a fraction of its maximum.

    Parameters
    ----------
    minuend, subtrahend : (n,) or (n, k) array_like
        Fields of the same shape; several stand in columns.
    raw : bool
        Whether the values themselves are subtracted, which makes sense for equal units only.

    Returns
    -------
    (n,) or (n, k) float64 ndarray
        Positive where `minuend` is larger, NaN where either is.  Without `raw` between -1 and 1, or -2 and 2 for fields
        with negative values, whose largest absolute value stands for the maximum.

    Raises
    ------
    ParameterError
        If the shapes differ.

    Examples
    --------
    >>> import bihdist
    >>> bihdist.difference([0, 1, 2], [0, 30, 40]).tolist()  # 1/2 - 3/4 in the middle
    [0.0, -0.25, 0.0]
    >>> bihdist.difference([0, 1, 2], [0, 30, 40], raw=True).tolist()
    [0.0, -29.0, -38.0]
    """
    a, b = (real_numbers(field, "Values of a field") for field in (minuend, subtrahend))
    if a.shape != b.shape or a.ndim not in (1, 2):
        raise ParameterError(f"Fields of shapes {a.shape} and {b.shape} cannot be subtracted.")
    return a - b if raw else _shares(a) - _shares(b)


PERCENTAGE_POINTS = "percentage points"
"""The unit of a difference of fractions, each of its own maximum, times 100."""


def scale_of(unit: str) -> float:
    """Return the factor from fractions of a maximum to a field's unit."""
    return 100.0 if unit == PERCENTAGE_POINTS else 1.0


def difference_in_unit(
    minuend: npt.ArrayLike, subtrahend: npt.ArrayLike, units: tuple[str, str] = ("", ""), raw: bool = False
) -> tuple[FloatArray, str]:
    """Return the `difference` of two fields (n,) or (n, k), and its unit: percentage points, or, raw, the unit of the
    fields.

    Of `units`, those of both fields, an empty one, of a field that is no distance, is taken to be that of the other.
    Raises ParameterError for fields of different shapes and, raw, of different units.
    """
    if not raw:
        return 100 * difference(minuend, subtrahend), PERCENTAGE_POINTS
    if all(units) and units[0] != units[1]:
        raise ParameterError(f"Values in {units[0]} and in {units[1]} cannot be subtracted; leave out raw.")
    return difference(minuend, subtrahend, raw=True), units[0] or units[1]


def _shares(field: FloatArray) -> FloatArray:
    top = np.nanmax(np.abs(field), axis=0, initial=0.0)
    return field / np.where(top > 0, top, 1.0)
