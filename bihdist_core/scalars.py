"""Single numbers as they come from anywhere, checked; no numpy is imported here."""

import operator
from typing import Any

from .errors import ParameterError


def whole_number(value: Any, what: str) -> int:
    """Return a whole number as Python's, also from NumPy; ParameterError for anything else."""
    try:
        if isinstance(value, bool):
            raise TypeError
        return operator.index(value)
    except TypeError:
        raise ParameterError(f"{what} is a whole number, not {value!r}.") from None


def real_number(value: Any, what: str) -> float:
    """Return a number as Python's float, also from NumPy; ParameterError for anything else, such as a text or an
    array."""
    # Of NumPy's scalars and arrays without axes.
    kind = getattr(getattr(value, "dtype", None), "kind", "f")
    try:
        if isinstance(value, str | bytes | bool) or kind not in "iuf" or getattr(value, "ndim", 0) > 0:
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise ParameterError(f"{what} is a number, not {value!r}.") from None
