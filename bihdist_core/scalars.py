"""Single numbers as they come from anywhere, checked; no numpy is imported here."""

import operator
import re
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


def with_decimal_point(text: str) -> str:
    """Return a typed number as `float` reads it: a true minus, a comma for the decimal point, and commas between
    thousands as the program writes them ("12,345.6"), are understood."""
    text = text.strip().replace("\N{MINUS SIGN}", "-")
    is_decimal = (
        text.count(",") == 1 and "." not in text and not re.match(r"[-+]?[1-9][0-9]{0,2},[0-9]{3}(?![0-9])", text)
    )
    return text.replace(",", "." if is_decimal else "")
