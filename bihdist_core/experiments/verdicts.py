"""How a statement is judged: limits fixed beforehand, numbers with their spread, and one function that compares them.

A number never stands alone.  It is taken from the pictured source and from random ones (`BySource`), or it is an
estimate with the interval that it is known within (`Estimate`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..errors import ParameterError

Verdict = Literal["holds", "partly", "does not hold"]
HOLDS, PARTLY, FAILS = VERDICTS = ("holds", "partly", "does not hold")

MOST = 0.9
"""The share of random sources that must meet a limit, beside the pictured one, for a statement to hold."""
MAJORITY = 0.5
"""More than this share of them make it hold partly."""
CONFIDENCE = 0.95
"""The confidence level of the intervals of estimates."""


RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Limit:
    """The numbers from `low` to `high`, without the ends if `strict`; `unit` is "%" for fractions, else ""."""

    low: float = -np.inf
    high: float = np.inf
    unit: str = ""
    strict: bool = False

    def meets(self, number: float) -> bool:
        """Return whether a number is within; NaN is not."""
        if self.strict:
            return bool(self.low < number < self.high)
        return bool(self.low <= number <= self.high)

    def formatted(self, number: float) -> str:
        """Return a number in the limit's unit."""
        text, _, power = f"{100 * number if self.unit == '%' else number:.3g}".partition("e")
        if power:
            text = f"{text} × 10{str(int(power)).translate(RAISED)}".removeprefix("1 × ")
        text = f"−{text[1:]}" if text.startswith("-") else text
        return f"{text} %" if self.unit == "%" else text

    @property
    def words(self) -> str:
        """The limit in words: "at most 5 %"."""
        if np.isinf(self.low):
            return f"{'below' if self.strict else 'at most'} {self.formatted(self.high)}"
        if np.isinf(self.high):
            return f"{'above' if self.strict else 'at least'} {self.formatted(self.low)}"
        if self.low == self.high:
            return f"just {self.formatted(self.low)}"
        return f"between {self.formatted(self.low)} and {self.formatted(self.high)}"


def at_most(high: float, unit: str = "") -> Limit:
    """Return the limit of numbers up to `high`, which is still good."""
    return Limit(high=high, unit=unit)


def at_least(low: float, unit: str = "") -> Limit:
    """Return the limit of numbers from `low` on, which is still good."""
    return Limit(low=low, unit=unit)


def above(low: float, unit: str = "") -> Limit:
    """Return the limit of numbers greater than `low`: a tie is not enough."""
    return Limit(low=low, unit=unit, strict=True)


def between(low: float, high: float, unit: str = "") -> Limit:
    """Return the limit of numbers from `low` to `high`, both still good."""
    return Limit(low, high, unit)


@dataclass(frozen=True)
class BySource:
    """A number from each pictured source (one for each shape), and from each random one; NaN for 0/0."""

    pictured: tuple[float, ...]
    random: tuple[float, ...] = ()

    @property
    def known(self) -> BySource:
        """The measurements without NaN."""
        return BySource(*(tuple(x for x in each if not np.isnan(x)) for each in (self.pictured, self.random)))


@dataclass(frozen=True)
class Estimate:
    """A number, the interval that it is known within, and how many measurements it comes from.

    Without ends it has no spread: it is computed, not sampled.
    """

    value: float
    low: float = np.nan
    high: float = np.nan
    count: int = 1

    def __post_init__(self) -> None:
        for end in ("low", "high"):
            if np.isnan(getattr(self, end)):
                object.__setattr__(self, end, self.value)


Numbers = BySource | Estimate


def number_of(numbers: Numbers) -> float:
    """Return the one number that stands for them: the estimate, or the median of the pictured sources, or of the
    others."""
    if isinstance(numbers, Estimate):
        return numbers.value
    known = numbers.known
    return float(np.median(known.pictured or known.random or (np.nan,)))


def ends_of(numbers: Numbers) -> tuple[float, float]:
    """Return the interval of an estimate; the least and the greatest of all sources' numbers."""
    if isinstance(numbers, Estimate):
        return numbers.low, numbers.high
    known = numbers.known
    every = (*known.pictured, *known.random) or (np.nan,)
    return float(min(every)), float(max(every))


def mean_estimate(numbers: npt.ArrayLike) -> Estimate:
    """Return the mean of numbers (k,), such as paired differences, with its Student interval.

    Of one number it is unbounded. Raises ParameterError if there is none.
    """
    x = np.asarray(numbers, np.float64).ravel()
    if not len(x):
        raise ParameterError("There is no mean of no numbers.")
    if len(x) == 1:
        return Estimate(float(x[0]), -np.inf, np.inf)
    return _student(float(x.mean()), float(x.std(ddof=1) / np.sqrt(len(x))), len(x) - 1, len(x))


def exponent_estimate(x: npt.ArrayLike, y: npt.ArrayLike) -> Estimate:
    """Return the exponent p of y ~ x^p by least squares of the logarithms of x and y (k,), with its Student interval.

    Of two points it is unbounded. Raises ParameterError for fewer, or for numbers that are not positive.
    """
    a, b = np.asarray(x, np.float64), np.asarray(y, np.float64)
    if len(a) != len(b) or len(a) < 2 or not ((a > 0).all() and (b > 0).all()):
        raise ParameterError("An exponent is fitted to at least two pairs of positive numbers.")
    a, b = np.log(a), np.log(b)
    off = a - a.mean()
    slope = float(off @ b / (off @ off))
    if len(a) == 2:
        return Estimate(slope, -np.inf, np.inf, 2)
    rest = b - b.mean() - slope * off
    error = np.sqrt(float(rest @ rest) / (len(a) - 2) / float(off @ off))
    return _student(slope, float(error), len(a) - 2, len(a))


def _span(limit: Limit, low: float, high: float) -> str:
    first, last = limit.formatted(low), limit.formatted(high)
    return first if first == last else f"{first.removesuffix(' %')} to {last}"


def _student(value: float, error: float, freedom: int, count: int) -> Estimate:
    from scipy.stats import t

    half = float(t.ppf((1 + CONFIDENCE) / 2, freedom)) * error
    return Estimate(value, value - half, value + half, count)


@dataclass(frozen=True)
class Part:
    """One number of a statement and its limit.

    `by` is "sources" (pictured first, random ones as a distribution), "interval" (an estimate with its interval) or
    "once" (a number without spread); `of` says what is random, "sources" or "starts". Without a part that is `needed`
    the statement does not hold at all; without another one it holds partly.
    """

    name: str
    limit: Limit
    by: Literal["sources", "interval", "once"] = "sources"
    needed: bool = False
    of: str = "sources"

    @property
    def rule(self) -> str:
        """The rule in words."""
        rule = self.limit.words
        if self.by == "once":
            return rule
        if self.by == "interval":
            return f"{rule}, the whole {100 * CONFIDENCE:g} % interval"
        return f"{rule}, pictured {self.of} and {100 * MOST:g} % of random ones"

    def counts(self, numbers: Numbers) -> tuple[int, int | None]:
        """Count the random sources or measurements that tell something, and the sources that meet the limit."""
        if isinstance(numbers, Estimate):
            return numbers.count, None
        random = numbers.known.random
        return len(random), sum(self.limit.meets(number) for number in random)

    def formatted(self, numbers: Numbers) -> str:
        """Return the numbers with their spread, in words: "2.1 % pictured; 1.8 to 3 % from 24 random sources"."""
        if isinstance(numbers, Estimate):
            if self.by == "once" or numbers.low == numbers.high:
                return self.limit.formatted(numbers.value)
            if np.isinf(numbers.high - numbers.low):
                return f"{self.limit.formatted(numbers.value)} (no interval)"
            value, ends = self.limit.formatted(numbers.value), _span(self.limit, numbers.low, numbers.high)
            return value if ends == value else f"{value} ({ends})"
        ranges = []
        known = numbers.known
        if known.pictured:
            ranges.append(f"{_span(self.limit, min(known.pictured), max(known.pictured))} pictured")
        elif numbers.pictured:
            ranges.append("0/0 pictured")
        if known.random:
            ranges.append(f"{_span(self.limit, min(known.random), max(known.random))} {self._from(len(known.random))}")
        if missing := len(numbers.random) - len(known.random):
            ranges.append(f"0/0 {self._from(missing)}")
        return "; ".join(ranges)

    def _from(self, count: int) -> str:
        return f"from {count} random {self.of if count > 1 else self.of[:-1]}"

    def judge(self, numbers: Numbers | None) -> Verdict | None:
        """Return the verdict of the numbers; None where there are none, or only 0/0 from the pictured sources.

        Raises ParameterError for numbers of the other sort.
        """
        if numbers is None:
            return None
        if isinstance(numbers, Estimate) == (self.by == "sources"):
            raise ParameterError(f"{self.name} is judged by {self.by}, which {type(numbers).__name__} is not for.")
        if isinstance(numbers, Estimate):
            sure = self.by == "once" or numbers.count > 1
            if sure and all(self.limit.meets(x) for x in (numbers.low, numbers.value, numbers.high)):
                return "holds"
            return "partly" if self.limit.meets(numbers.value) else "does not hold"
        known = numbers.known
        if not known.pictured and (numbers.pictured or not known.random):
            return None
        shown = bool(known.pictured) and self.share(known.pictured) == 1
        share = self.share(known.random)
        if shown and share >= MOST:
            return "holds"
        return "partly" if shown or share > MAJORITY else "does not hold"

    def share(self, numbers: Sequence[float]) -> float:
        """Return the share of numbers that meet the limit, 0 of none."""
        return sum(self.limit.meets(number) for number in numbers) / max(1, len(numbers))


@dataclass(frozen=True)
class Statement:
    """A statement, whose it is, and the rule that judges it.

    `words` is "paper" where the paper says so, in these or nearly these words, "ours" where we put into words what its
    figure shows or what follows from it; `where` is the place in the paper. `before` is the verdict of the version
    before,
    "yes" or "no", "" if it had none, and `changed` tells how and why its protocol differs from that version's.
    """

    id: str
    text: str
    words: Literal["paper", "ours"]
    where: str
    parts: tuple[Part, ...]
    before: str = ""
    changed: str = ""
    names: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(part.name for part in self.parts))

    def part(self, name: str) -> Part:
        """Return the part of that name; ParameterError if there is none."""
        for part in self.parts:
            if part.name == name:
                return part
        raise ParameterError(f"{self.id} has no part {name!r} but {', '.join(self.names)}.")

    def judge(self, numbers: Mapping[str, Numbers]) -> Verdict | None:
        """Return the verdict by the numbers of its parts; None if those that are needed, or all, were not measured.

        Raises ParameterError for a part that it does not have.
        """
        for name in numbers:
            self.part(name)
        found = {part: part.judge(numbers.get(part.name)) for part in self.parts}
        needed = [verdict for part, verdict in found.items() if part.needed]
        if None in needed or not any(found.values()):
            return None
        if FAILS in needed or all(verdict in (FAILS, None) for verdict in found.values()):
            return "does not hold"
        return "holds" if all(verdict == HOLDS for verdict in found.values()) else "partly"
