"""How long work takes: processor time, with one BLAS thread, and a warning where the computer was busy otherwise.

Wall time is what other work on the computer makes of it; processor time counts our own threads only.  BLAS' own threads
wait by turning round, which processor time would count as work.
"""

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter, process_time
from typing import TypeVar

import numpy as np

from ..solver.blas import one_blas_thread
from .verdicts import CONFIDENCE, Estimate

Result = TypeVar("Result")

WAITED = 1.15
"""Wall over processor time of work on one thread, from which on the computer is said to be busy."""


@dataclass(frozen=True)
class Time:
    """Seconds of the processor, all our threads together, and by the clock on the wall."""

    processor: float = 0.0
    wall: float = 0.0

    def __add__(self, other: "Time") -> "Time":
        return Time(self.processor + other.processor, self.wall + other.wall)

    def times(self, factor: float) -> "Time":
        """Return the time multiplied by a factor."""
        return Time(factor * self.processor, factor * self.wall)


def timed(work: Callable[[], Result]) -> tuple[Result, Time]:
    """Return the result of the work, and how long it takes."""
    with one_blas_thread():
        wall, processor = perf_counter(), process_time()
        result = work()
        return result, Time(process_time() - processor, perf_counter() - wall)


def median(times: Sequence[Time]) -> Time:
    """Return the median of several repetitions, of each of the two."""
    return Time(float(np.median([t.processor for t in times])), float(np.median([t.wall for t in times])))


def ratio_estimate(above: Sequence[Time], below: Sequence[Time]) -> Estimate:
    """Return the ratio of processor times measured in turns, the geometric mean of two pairs (k,) or more.

    Its interval is Student's: so few repetitions cannot be resampled.
    """
    from scipy.stats import sem, t

    logs = np.log([a.processor / b.processor for a, b in zip(above, below, strict=True)])
    half = float(t.ppf((1 + CONFIDENCE) / 2, len(logs) - 1) * sem(logs))
    value, low, high = np.exp(logs.mean() + half * np.array([0, -1, 1])).tolist()
    return Estimate(value, low, high, len(logs))


def busy(single: Iterable[Time]) -> str:
    """Return a warning if the computer was busy with other work while work on one thread was timed; "" if it was not.

    It was where that waited for a processor, or where more wants to run than there are processors.
    """
    times = list(single)
    waited = sum(t.wall for t in times) / max(1e-9, sum(t.processor for t in times))
    processors = os.cpu_count() or 1
    # There is none on Windows.
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0
    if waited < WAITED and load <= processors:
        return ""
    return (
        f"The computer was busy with other work: a load of {load:.1f} on {processors} processors, and work on one "
        f"thread took {waited:.2f} times its processor time. Processor times can then be too long, too, as programs "
        "share caches and memory; the ratios of methods timed in turns suffer less."
    )
