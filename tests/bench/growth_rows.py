"""Rows 7 to 9: how set-up grows with the mesh, and how it takes shapes that are harder than a sphere."""

from collections.abc import Iterator
from functools import cache

import numpy as np

from .case import EXACT, Case, difference
from .child import forget_peak, in_child, peak_memory
from .meshes import MAKERS, bumpy_sphere
from .size import Size
from .table import Line
from .timing import alternate, timed


def growth(size: Size) -> Iterator[Line]:
    seconds, _, peaks, vertices, errors = (np.array(column) for column in zip(*grown(size), strict=True))
    slope = np.polyfit(np.log(vertices), np.log(seconds), 1)[0]
    span = f"{vertices[0]:,.0f} to {vertices[-1]:,.0f} vertices"
    yield Line(
        7,
        f"set-up time grows like n^p, {span}",
        value=slope,
        bound=1.25,
        error=errors.max(),
        tolerance=EXACT,
        note=", ".join(f"{s:.2f} s" for s in seconds),
    )
    slope = np.polyfit(np.log(vertices), np.log(peaks), 1)[0]
    yield Line(
        7,
        f"memory grows like n^q, {span}",
        value=slope,
        bound=1.1,
        note=", ".join(f"{peak / 1e6:,.0f} MB" for peak in peaks),
    )


def largest(size: Size) -> Iterator[Line]:
    of_main = grown(size)[2]
    seconds, field, peak, vertices, error = grown(size)[-1]
    name = f"{vertices:,} vertices"
    yield Line(
        8,
        f"set-up, {name}",
        seconds,
        of_main[0],
        seconds / of_main[0],
        bound=16,
        error=error,
        tolerance=EXACT,
        note="peer: our row 1",
    )
    yield Line(8, f"one field, {name}", field, of_main[1], field / of_main[1], bound=12, note="peer: our row 2")
    yield Line(8, f"peak memory in GB, {name}", value=(peak + BARE) / 1e9, bound=6, memory=peak + BARE)


BARE = 100_000_000
"""About what a process has in memory after the imports alone, which row 7 does not count."""


@cache
def grown(size: Size) -> list[tuple[float, float, float, int, float]]:
    """Of each size: seconds of set-up and of one field, bytes beyond the imports, vertices, error."""
    rounds = [[in_child(_grow, n, size) for n in size.growth] for _ in range(max(1, size.rounds - 1))]
    medians = [np.median(runs, axis=0) for runs in zip(*rounds, strict=True)]
    return [(seconds, field, peak, int(vertices), error) for seconds, field, peak, vertices, error in medians]


def _grow(n: int, size: Size) -> tuple[float, float, int, int, float]:
    case = Case(*bumpy_sphere(n), size)
    forget_peak()
    before = peak_memory()
    seconds, distance = timed(case.set_up)
    fields = [timed(lambda: distance.from_source(case.source)) for _ in range(size.repeat)]
    peak = peak_memory() - before
    pairs = np.array([distance.between(case.source, int(v)) for v in case.targets])
    error = difference(fields[0][1][case.targets], pairs)
    return seconds, float(np.median([time for time, _ in fields])), peak, len(case.arrays[0]), error


def shapes(size: Size) -> Iterator[Line]:
    sphere = Case(*bumpy_sphere(size.main), size)
    for name, bound in [("genus 2", 1.5), ("folded sheet", None), ("needle", None)]:
        case = Case(*MAKERS[name](size.main), size)
        result = alternate(case.set_up, sphere.set_up, size.rounds)
        share = len(sphere.arrays[0]) / len(case.arrays[0])
        case.distance = result.answer
        yield Line(
            9,
            f"set-up per vertex, {name}, {case.count}",
            result.our_time,
            result.peer_time,
            result.ratio * share,
            result.effort * share,
            bound,
            error=case.error(result.answer.from_source(case.source)[case.targets]),
            # Slivers cost digits in any operator of theirs.
            tolerance=1e-5,
            note="peer: bumpy sphere",
        )
