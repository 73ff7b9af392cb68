"""Types of NumPy arrays, by what their entries are, and arrays of numbers as they come from anywhere, checked.

Shapes stand in docstrings. What NumPy would let pass, or refuse in its own words, is refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from .errors import ParameterError

FloatArray: TypeAlias = npt.NDArray[np.float64]
IntArray: TypeAlias = npt.NDArray[np.int64]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
ByteArray: TypeAlias = npt.NDArray[np.uint8]
AnyArray: TypeAlias = npt.NDArray[Any]
"""Whole numbers, or floats, of whatever width a caller or a file has."""


def unit_columns(n: int, index: IntArray) -> FloatArray:
    """Return (n, k) columns with a 1 each, in the rows `index` (k,)."""
    columns = np.zeros((n, len(index)))
    columns[index, np.arange(len(index))] = 1
    return columns


def array_of(values: npt.ArrayLike | Sequence[object], what: str) -> AnyArray:
    """Convert values to an array; ParameterError, which begins with `what`, for rows of different lengths."""
    try:
        return np.asarray(values)
    except ValueError:
        raise ParameterError(f"{what} are not an array: their rows differ in length.") from None


def real_numbers(values: npt.ArrayLike, what: str) -> FloatArray:
    """Convert values to float64; ParameterError, which begins with `what`, for complex numbers, texts and the like."""
    array = array_of(values, what)
    try:
        if array.dtype.kind not in "biufO":
            raise TypeError
        return array.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise ParameterError(f"{what} are real numbers, and these have the type {array.dtype}.") from None
