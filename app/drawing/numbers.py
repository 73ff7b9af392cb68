"""Numbers as text, the same in the window, in figures and on pages: four significant digits and a true minus."""

import math
from collections.abc import Iterable

from bihdist_core.distances.difference import PERCENTAGE_POINTS

DIGITS = 4
MINUS = "−"
TICK_STEPS = (1.0, 2.0, 2.5, 5.0)
"""Steps from one tick to the next, times a power of ten."""


def number(value: float, signed: bool = False) -> str:
    """Return a value as "0.3567", "12,345", "−0.02300" or "1.200e−7"; one that is signed has a plus, too."""
    if math.isnan(value) or math.isinf(value):
        return "–"
    plus = "+" if signed and value else ""
    size = abs(value)
    if not value:
        text = "0"
    elif 1e-4 <= size < 1e7:
        places = max(DIGITS - 1 - math.floor(math.log10(float(f"{size:.{DIGITS - 1}e}"))), 0)
        text = f"{value:{plus},.{places}f}"
    else:
        mantissa, _, power = f"{value:{plus}.{DIGITS - 1}e}".partition("e")
        text = f"{mantissa}e{int(power)}"
    return text.replace("-", MINUS)


def coordinates(position: Iterable[float], edge: float) -> str:
    """Return a position as text, with as many digits as tell a tenth of the mean edge, and no fewer than `number`."""
    return "  ".join(_coordinate(float(x), edge / 10) for x in position)


def _coordinate(x: float, step: float) -> str:
    is_coarse = x and step > 0 and 10.0 ** (math.floor(math.log10(abs(x))) - DIGITS + 1) > step
    places = max(math.ceil(-math.log10(step)), 0) if is_coarse else 0
    return f"{x:,.{places}f}".replace("-", MINUS) if is_coarse else number(x)


def share(value: float, signed: bool = False) -> str:
    """Return a fraction of a maximum as "77.6 %"."""
    return "–" if math.isnan(value) else f"{100 * value:{'+' if signed else ''}.1f} %".replace("-", MINUS)


def percent(unit: str) -> str:
    """Return " %" for percentage points, whose numbers are read without their unit then; "" for any other unit."""
    return " %" if unit == PERCENTAGE_POINTS else ""


def tick(value: float) -> str:
    """Return a round value in as few digits as it has."""
    return f"{value:.6g}".replace("-", MINUS)


def ticks(low: float, high: float, most: int) -> list[float]:
    """Return round values from low to high, at most so many, or two where fewer cannot be."""
    if not (math.isfinite(low) and math.isfinite(high)) or high <= low:
        return []
    size = (high - low) / max(most, 1)
    power = 10.0 ** math.floor(math.log10(size))
    for factor in (1.0, 10.0, 100.0):
        for step in TICK_STEPS:
            found = _multiples(low, high, step * power * factor)
            if len(found) <= max(most, 2):
                return found
    return []


def _multiples(low: float, high: float, step: float) -> list[float]:
    slack = 1e-9
    first, last = math.ceil(low / step - slack), math.floor(high / step + slack)
    return [k * step for k in range(first, last + 1)]


def runs_of_digits(text: str) -> list[tuple[str, bool]]:
    """Return runs of digits and of what is between them, each with whether it is digits."""
    found: list[tuple[str, bool]] = []
    for letter in text:
        is_digit = letter in "0123456789"
        if found and found[-1][1] == is_digit:
            found[-1] = (found[-1][0] + letter, is_digit)
        else:
            found.append((letter, is_digit))
    return found


def progress_share(fraction: float) -> str:
    """Write the percentage that is done, 1 % to 99 %; "" before that and where it is not known."""
    percent = min(int(100 * fraction + 1e-9), 99) if 0.0 <= fraction <= 1.0 else 0
    return f"{percent} %" if percent else ""


def progress_words(fraction: float, text: str) -> str:
    """Write the progress of something as a sentence: "Factorization, 40 %"."""
    return f"{text[:1].upper()}{text[1:]}, {100 * fraction:.0f} %"
