"""How numbers are written, the same everywhere: four significant digits, a true minus, digits of equal width."""

import math
from functools import lru_cache

from qtpy import QtCore, QtGui

from bihdist_core.distances.difference import PERCENTAGE_POINTS

DIGITS = 4
MINUS = "−"
TICK_STEPS = (1.0, 2.0, 2.5, 5.0)
"""Times powers of ten: what lies between two ticks."""


def number(value: float, signed: bool = False) -> str:
    """ "0.3567", "1.157", "12,345", "−0.02300", "1.200e−7"; signed: with a plus, too."""
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


def share(value: float, signed: bool = False) -> str:
    """Of a maximum: "77.6 %"."""
    return "–" if math.isnan(value) else f"{100 * value:{'+' if signed else ''}.1f} %".replace("-", MINUS)


def percent(unit: str) -> str:
    """What follows numbers in a unit, so that they can be read without it: " %" for percentage points."""
    return " %" if unit == PERCENTAGE_POINTS else ""


def tick(value: float) -> str:
    """As short as it goes."""
    return f"{value:.6g}".replace("-", MINUS)


def ticks(low: float, high: float, most: int) -> list[float]:
    """Round values from low to high, at most so many (two if fewer cannot be)."""
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


# ---------------------------------------------------------------------- digits of equal width
def paint_number(painter: QtGui.QPainter, x: float, baseline: float, text: str) -> float:
    """Write a text at (x, baseline), each digit in the widest one's cell; gives where it ends.

    Qt 5 cannot ask a font for figures of equal width, so numbers that change would jump.
    """
    metrics = QtGui.QFontMetricsF(painter.font())
    cell = _cell(painter.font().toString())
    for run, is_digit in _runs(text):
        if not is_digit:
            painter.drawText(QtCore.QPointF(x, baseline), run)
            x += metrics.horizontalAdvance(run)
            continue
        for digit in run:
            painter.drawText(QtCore.QPointF(x + (cell - metrics.horizontalAdvance(digit)) / 2, baseline), digit)
            x += cell
    return x


def number_width(font: QtGui.QFont, text: str) -> float:
    """How wide `paint_number` writes it."""
    metrics, cell = QtGui.QFontMetricsF(font), _cell(font.toString())
    return sum(cell * len(run) if is_digit else metrics.horizontalAdvance(run) for run, is_digit in _runs(text))


@lru_cache(maxsize=64)
def _cell(font: str) -> float:
    """The width of the widest digit."""
    known = QtGui.QFont()
    known.fromString(font)
    metrics = QtGui.QFontMetricsF(known)
    return float(max(metrics.horizontalAdvance(digit) for digit in "0123456789"))


def _runs(text: str) -> list[tuple[str, bool]]:
    """Digits and what is between them."""
    found: list[tuple[str, bool]] = []
    for letter in text:
        is_digit = letter in "0123456789"
        if found and found[-1][1] == is_digit:
            found[-1] = (found[-1][0] + letter, is_digit)
        else:
            found.append((letter, is_digit))
    return found
