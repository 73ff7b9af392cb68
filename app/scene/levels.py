"""Which values have an isoline, and which of them stand out: the same for surfaces, pictures and colour bars."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core.arrays import BoolArray, FloatArray

from ..document.looks import MOST_ISOLINES, Isolines

BOLD = 2.0
"""Width of bold lines in those of the others."""

ZERO = 1.1
"""Width of the line at 0 of a signed field, which stands out by its colour and must not blot where it winds."""


@dataclass(frozen=True, eq=False)
class Levels:
    """Values that have an isoline.

    Attributes
    ----------
    values
        (k,) in order.
    is_bold, is_through
        (k,) whether a line is bold, and whether it passes through a point.
    wanted
        Number of lines but for those through points; where a spacing makes too many, there are none.
    step
        From one line to the next; 0 for given values.
    """

    values: FloatArray
    is_bold: BoolArray
    is_through: BoolArray
    wanted: int
    step: float = 0.0

    @property
    def widths(self) -> FloatArray:
        """The widths (k,) of the lines in those of a usual line."""
        return np.where(self.is_bold | self.is_through, BOLD, 1.0)


def levels(
    isolines: Isolines, maximum: float, own: float, signed: bool = False, through: Sequence[float] = ()
) -> Levels:
    """Return the isolines of a field that goes up to `own`, from 0 or, if signed, from -own.

    Multiples of a step lie above 0 and below the field's own maximum.  If signed, 0 has a line, which is bold, and
    equal
    steps from -maximum to maximum are an even number.

    Parameters
    ----------
    maximum
        Upper end of the colour bar.
    through
        Values of the field at points, NaN for none.
    """
    if not (maximum > 0 and own > 0):
        return _merged(np.empty(0), np.empty(0, bool), np.empty(0), 0)
    # A millionth of a step: at the farthest point itself a line would be a blot.
    low, high, step = (-own if signed else 0.0), own, 0.0
    if isolines.values:
        values = np.array(isolines.values)
        number = np.arange(1, len(values) + 1)
        inside = (values > low + 1e-6 * own) & (values < high - 1e-6 * own)
        values, number = values[inside], number[inside]
        wanted = len(values)
    else:
        step = isolines.spacing or 0.0
        if isolines.spacing is None and isolines.count:
            steps = steps_to_top(isolines, signed)
            step = round_step(maximum, steps) if isolines.round else maximum / steps
        last = int(min(np.ceil(own / step - 1e-6) - 1, 1e9)) if step else 0
        wanted = 2 * last + 1 if signed and step else last
        if isolines.spacing is None:
            last = min(last, MOST_ISOLINES)  # of a field that goes far beyond its colour bar
        elif wanted > MOST_ISOLINES:
            step = 0.0
        number = np.arange(-last if signed else 1, last + 1) if step else np.empty(0, int)
        # 0.15 and not 0.15000000000000002.
        values = (
            np.array([float(f"{v:.12g}") for v in step * number]) if isolines.round else step * number.astype(float)
        )
    is_bold = number % isolines.bold == 0 if isolines.bold else np.zeros(len(number), bool)
    if signed:
        is_bold |= values == 0
    passed = np.array([v for v in through if low < v < high], float)
    return replace(_merged(values, is_bold, passed, wanted), step=float(step))


def _merged(values: FloatArray, is_bold: BoolArray, through: FloatArray, wanted: int) -> Levels:
    through = np.unique(through)
    kept = ~np.isin(values, through)
    values, is_bold = values[kept], is_bold[kept]
    both = np.concatenate([values, through])
    order = np.argsort(both, kind="stable")
    is_through = np.arange(len(both)) >= len(values)
    bold = np.append(is_bold, np.zeros(len(through), bool))
    return Levels(both[order], bold[order], is_through[order], wanted)


def width_of(isolines: Isolines, is_bold: bool, is_zero: bool) -> float:
    """Return the width of a line in those of a usual one; `is_zero` is true for the line at 0 of a signed field."""
    if is_zero and not isolines.bold:
        return ZERO
    return BOLD if is_bold else 1.0


ROUND = (1.0, 2.0, 2.5, 5.0)
"""Times powers of ten: round steps."""

SMALLEST = 1e-290
"""Below it, powers of ten are no longer exact."""


def round_step(top: float, steps: int) -> float:
    """Return the round step of which so many lead from 0 to the top as nearly as can be, in proportion."""
    size = top / steps
    if size < SMALLEST:
        return size
    power = math.floor(math.log10(size))
    found = [float(f"{digits}e{power + k}") for k in (0, 1) for digits in ROUND]
    # No more than are drawn, so that none is missing at the top.
    return min((s for s in found if top / s <= MOST_ISOLINES), key=lambda step: abs(math.log(size / step)))


def in_unit(isolines: Isolines, scale: float, in_shares: bool, signed: bool) -> Isolines:
    """Return a document's isolines as those of a field in which its fractions are `scale` times as large.

    If `in_shares`, round values are percentages of the maximum, which divide it into equal steps.
    """
    isolines = isolines.scaled(scale)
    if not (in_shares and isolines.round and isolines.count):
        return isolines
    steps = max(round(1 / round_step(1.0, steps_to_top(isolines, signed))), 1)
    return replace(isolines, count=min(2 * steps if signed else steps, MOST_ISOLINES), round=False)


def with_kept_step(isolines: Isolines, step: float, maximum: float, own: float, signed: bool) -> Isolines:
    """Return isolines at the step they had before, unless that makes less than half or more than twice as many.

    While the maximum changes a little at a time, the lines then do not jump back and forth between two round steps.
    """
    if isolines.spacing is not None or isolines.values or not (isolines.round and isolines.count and step > 0):
        return isolines
    is_near = 0.5 <= maximum / step / steps_to_top(isolines, signed) <= 2
    return replace(isolines, spacing=step) if is_near and 2 * own / step <= MOST_ISOLINES else isolines


def steps_to_top(isolines: Isolines, signed: bool) -> int:
    """Return the number of steps that are wanted from 0 to the maximum."""
    return max(1, round(isolines.count / 2)) if signed else isolines.count


def too_many(found: Levels, isolines: Isolines, own: float) -> str:
    """Return a sentence where a spacing makes more lines than are drawn; "" where it does not."""
    if isolines.spacing is None or found.wanted <= MOST_ISOLINES:
        return ""
    return (
        f"A spacing of {isolines.spacing:g} makes {found.wanted:,} isolines up to {own:.4g}; "
        f"up to {MOST_ISOLINES:,} are drawn. Choose a spacing of {own / MOST_ISOLINES:.2g} or more."
    )
