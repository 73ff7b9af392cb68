"""Values of a field as they are typed: numbers, or fractions of its maximum."""

import math

from ..errors import ParameterError
from ..scalars import with_decimal_point


def value_from_words(text: str, maximum: float) -> float | None:
    """Read "0.25", or "20 %" of the maximum; return None for nothing. ParameterError for other words."""
    words = with_decimal_point(text)
    if not words:
        return None
    scale = maximum / 100 if words.endswith("%") else 1.0
    try:
        value = float(words.removesuffix("%")) * scale
    except ValueError:
        value = math.nan
    if math.isnan(value):
        raise ParameterError(f"{text.strip()!r} is not a value; type one such as {maximum / 4:.4g}, or 25 %.")
    return value


def region_from_words(text: str, maximum: float) -> tuple[float, float]:
    """Read "0.1:0.25" or "20%:40%"; an end that is left out is infinite. ParameterError for other words."""
    ends = text.split(":")
    if len(ends) != 2 or not text.strip(": "):
        raise ParameterError(f"{text!r} is not a region between two values, such as 0.1:0.2, 20%:40% or 50%:.")
    low, high = (value_from_words(end, maximum) for end in ends)
    return -math.inf if low is None else low, math.inf if high is None else high
