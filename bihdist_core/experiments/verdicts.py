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
VERDICTS: tuple[Verdict, Verdict, Verdict] = ("holds", "partly", "does not hold")
HOLDS, PARTLY, FAILS = VERDICTS

MOST = 0.9
"""The share of random sources that must meet a limit, beside the pictured one, for a statement to hold."""
MAJORITY = 0.5
"""More than this share of them make it hold partly."""
CONFIDENCE = 0.95
"""The confidence level of the intervals of estimates."""
SPREAD = 0.02
"""The share of its limit that a number moves by with another circle, draw or refinement: nearer it is not told apart.
Isotropy ratios move by 0.1 % with another circle, changes by noise on each coordinate by 2 % with another draw."""
SURE = 3.0
"""Standard deviations of the numbers from five sources that most others are within, nearly surely: the tolerance factor
of 90 % with the confidence 0.9 is 2.7."""
RESAMPLES = 2000
"""How often measurements are drawn anew, with repetition, for an interval."""


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

    def side(self, low: float, high: float) -> int:
        """Return 1 if all numbers from `low` to `high` are within, -1 if none is, 0 if some are."""
        if self.meets(low) and self.meets(high):
            return 1
        beyond = high <= self.low or low >= self.high if self.strict else high < self.low or low > self.high
        return -1 if beyond else 0

    def side_of(self, number: float) -> int:
        """Return 1 for a number within, -1 for one beyond, and 0 for one within `SPREAD` of an end."""
        spread = SPREAD * max(abs(end) for end in (self.low, self.high) if np.isfinite(end))
        return self.side(number - spread, number + spread)

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
    """Return the mean of numbers (k,), such as paired differences, with its interval by resampling them.

    Raises ParameterError if there is none.
    """
    x = np.asarray(numbers, np.float64).ravel()
    if not len(x):
        raise ParameterError("There is no mean of no numbers.")
    drawn = np.random.default_rng(0).integers(len(x), size=(RESAMPLES, len(x)))
    return estimate(float(x.mean()), x[drawn].mean(axis=1), len(x))


def estimate(value: float, resampled: npt.ArrayLike, count: int) -> Estimate:
    """Return a number with the interval of what it is (b,) when its `count` measurements are resampled."""
    low, high = np.nanquantile(np.asarray(resampled, np.float64), [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return Estimate(value, float(low), float(high), count)


def exponent(x: npt.ArrayLike, y: npt.ArrayLike) -> float:
    """Return the exponent p of y ~ x^p by least squares of the logarithms of x and y (k,).

    Raises ParameterError for fewer than two, or for numbers that are not positive.
    """
    a, b = np.asarray(x, np.float64), np.asarray(y, np.float64)
    if len(a) != len(b) or len(a) < 2 or not ((a > 0).all() and (b > 0).all()):
        raise ParameterError("An exponent is fitted to at least two pairs of positive numbers.")
    off = np.log(a) - np.log(a).mean()
    return float(off @ np.log(b) / (off @ off))


def exponent_estimate(x: npt.ArrayLike, repeated: Sequence[npt.ArrayLike]) -> Estimate:
    """Return the exponent p of y ~ x^p, x (k,), from repeated measurements of each y.

    It is fitted to the least ones; its interval is by resampling the k meshes, and of each one of its repetitions.
    """
    x, every = np.asarray(x, np.float64), [np.asarray(each, np.float64) for each in repeated]
    value = exponent(x, [each.min() for each in every])
    rng = np.random.default_rng(0)
    resampled = []
    for _ in range(RESAMPLES):
        chosen = rng.integers(len(x), size=len(x))
        if len(np.unique(chosen)) > 1:
            resampled.append(exponent(x[chosen], [rng.choice(every[k]) for k in chosen]))
    return estimate(value, resampled, len(x))


def _span(limit: Limit, low: float, high: float) -> str:
    first, last = limit.formatted(low), limit.formatted(high)
    return first if first == last else f"{first.removesuffix(' %')} to {last}"


@dataclass(frozen=True)
class Part:
    """One number of a statement and its limit.

    `by` is "sources" (pictured first, random ones as a distribution), "everywhere" (each source of them, as a single
    counterexample refutes it), "interval" (an estimate with its interval) or "once" (a number that is computed, not
    sampled); `of` says what is random: "sources", "starts", or "meshes", of
    which none is pictured. Without a part that is `needed` the statement does not
    hold at all; without another one it holds partly.
    """

    name: str
    limit: Limit
    by: Literal["sources", "everywhere", "interval", "once"] = "sources"
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
        if self.by == "everywhere":
            return f"{rule}, everywhere"
        if self.of == "meshes":
            return f"{rule}, {100 * MOST:g} % of the meshes"
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
            ranges.append("undefined pictured")
        if known.random:
            ranges.append(f"{_span(self.limit, min(known.random), max(known.random))} {self._from(len(known.random))}")
        if missing := len(numbers.random) - len(known.random):
            ranges.append(f"undefined {self._from(missing)}")
        return "; ".join(ranges)

    def _from(self, count: int) -> str:
        random = "" if self.of == "meshes" else "random "
        return f"from {count} {random}{self.of if count > 1 else self.of[:-1]}"

    def judge(self, numbers: Numbers | None, surely: bool = False) -> Verdict | None:
        """Return the verdict of the numbers; None where there are none, or only 0/0 from the pictured sources.

        With `surely` it is None too, unless more sources would hardly change it: numbers and `SURE` standard deviations
        are on one side of the limit, or one number is a counterexample.

        Raises ParameterError for numbers of the other sort.
        """
        if numbers is None:
            return None
        if isinstance(numbers, Estimate) != (self.by in ("interval", "once")):
            raise ParameterError(f"{self.name} is judged by {self.by}, which {type(numbers).__name__} is not for.")
        if isinstance(numbers, Estimate):
            once = self.by == "once"
            side = self.limit.side_of(numbers.value) if once else self.limit.side(numbers.low, numbers.high)
            return None if surely and not side else VERDICTS[1 - side]
        known = numbers.known
        if not known.pictured and (numbers.pictured or not known.random):
            return None
        pictured, random = ([self.limit.side_of(x) for x in each] for each in (known.pictured, known.random))
        if self.by == "everywhere":
            worst = min(pictured + random)
            return None if surely and worst >= 0 and self.of != "meshes" else VERDICTS[1 - worst]
        if surely and self.of != "meshes":
            every = np.array([*known.pictured, *known.random])
            with np.errstate(invalid="ignore"):
                spread = SURE * every.std(ddof=min(1, len(every) - 1))
            low, high = min(every.min(), every.mean() - spread), max(every.max(), every.mean() + spread)
            side = self.limit.side(float(low), float(high))
            return VERDICTS[1 - side] if side else None
        met, not_missed = random.count(1) / max(1, len(random)), 1 - random.count(-1) / max(1, len(random))
        least = min(pictured, default=-1)
        # Of many meshes none is the pictured one.
        if met >= MOST and (least == 1 or self.of == "meshes"):
            return HOLDS
        return PARTLY if least >= 0 or (random and not_missed > MAJORITY) else FAILS

    def is_close(self, numbers: Numbers | None) -> bool:
        """Return whether the number that decides is within its own spread of the limit."""
        if numbers is None:
            return False
        if isinstance(numbers, Estimate):
            return self.judge(numbers) == PARTLY
        return any(self.limit.side_of(x) == 0 for x in numbers.known.pictured)


@dataclass(frozen=True)
class Statement:
    """A statement, whose it is, and the rule that judges it.

    `words` is "paper" where the paper says so, in these or nearly these words, "ours" where we put into words what its
    figure shows or what follows from it; `where` is the place in the paper. `whole` is True where the quick version
    has smaller meshes or fewer shapes than it is about, and does not judge it.
    """

    id: str
    text: str
    words: Literal["paper", "ours"]
    where: str
    parts: tuple[Part, ...]
    whole: bool = False
    names: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(part.name for part in self.parts))

    def part(self, name: str) -> Part:
        """Return the part of that name; ParameterError if there is none."""
        for part in self.parts:
            if part.name == name:
                return part
        raise ParameterError(f"{self.id} has no part {name!r} but {', '.join(self.names)}.")

    @property
    def is_universal(self) -> bool:
        """Whether a single counterexample refutes it."""
        return any(part.by == "everywhere" for part in self.parts)

    def judge(self, numbers: Mapping[str, Numbers], quick: bool = False) -> Verdict | None:
        """Return the verdict by the numbers of its parts; None if those that are needed, or all, were not measured.

        Of a `quick` measurement it is None unless it is sure to be that of the whole one.

        Raises ParameterError for a part that it does not have.
        """
        for name in numbers:
            self.part(name)
        found = {part: part.judge(numbers.get(part.name), quick) for part in self.parts}
        needed = [verdict for part, verdict in found.items() if part.needed]
        if None in needed or not any(found.values()) or (quick and self.whole):
            return None
        if FAILS in needed:
            return FAILS
        if quick and None in found.values():
            return None
        if all(verdict in (FAILS, None) for verdict in found.values()):
            return FAILS
        return "holds" if all(verdict == HOLDS for verdict in found.values()) else "partly"
