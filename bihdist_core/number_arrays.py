"""Arrays of numbers as they come from anywhere: what NumPy would let pass, or refuse in its own words, is refused."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .arrays import AnyArray, FloatArray
from .errors import ParameterError


def array_of(values: npt.ArrayLike | Sequence[object], what: str) -> AnyArray:
    """Values as an array; ParameterError, which begins with what they are, for rows of different lengths."""
    try:
        return np.asarray(values)
    except ValueError:
        raise ParameterError(f"{what} are no array: their rows differ in length.") from None


def real_numbers(values: npt.ArrayLike, what: str) -> FloatArray:
    """Values as float64; ParameterError, which begins with what they are, for complex numbers, texts and the like."""
    array = array_of(values, what)
    try:
        if array.dtype.kind not in "biufO":
            raise TypeError
        return array.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise ParameterError(f"{what} are real numbers, and these have the type {array.dtype}.") from None
