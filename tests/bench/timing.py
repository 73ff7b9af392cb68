"""Timing two things against each other on a machine that does other things besides."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Comparison:
    """Seconds of each round, the processors' seconds of all of them, and what the last round returned."""

    ours: list[float]
    peer: list[float]
    our_effort: float
    peer_effort: float
    answer: Any
    peer_answer: Any

    @property
    def our_time(self) -> float:
        return statistics.median(self.ours)

    @property
    def peer_time(self) -> float:
        return statistics.median(self.peer)

    @property
    def ratio(self) -> float:
        """The median of the rounds' ratios: what slows the machine down for a while slows both."""
        return statistics.median(a / b for a, b in zip(self.ours, self.peer, strict=True))

    @property
    def effort(self) -> float:
        """The ratio of the processors' seconds, all threads together: hardly depends on what else is running."""
        return self.our_effort / max(self.peer_effort, 1e-9)


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds and the result."""
    start = time.perf_counter()
    answer = work()
    return time.perf_counter() - start, answer


def alternate(ours: Callable[[], Any], peer: Callable[[], Any], rounds: int, repeat: int = 1) -> Comparison:
    """Time both in turn, `rounds` times; of `repeat` runs within a round the median counts."""
    times: tuple[list[float], list[float]] = [], []
    answers: list[Any] = [None, None]
    efforts = [0.0, 0.0]
    for _ in range(rounds):
        for which, work in enumerate((ours, peer)):
            runs, before = [], time.process_time()
            for _ in range(repeat):
                answers[which] = None  # the last answer may be as large as what is measured
                seconds, answers[which] = timed(work)
                runs.append(seconds)
            efforts[which] += time.process_time() - before
            times[which].append(statistics.median(runs))
    return Comparison(*times, *efforts, *answers)
