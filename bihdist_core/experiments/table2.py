"""Table II: seconds for the distances of all pairs among M = 2, 100, 400 vertices, N = 2k to 111k.

The paper: Dijkstra is fastest for small M; biharmonic distance pays for its factorization first and is fastest for
large M; diffusion distance hardly depends on M.
"""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from ..arrays import FloatArray, IntArray, unit_columns
from ..distances.diffusion import EigenpairDiffusion
from ..distances.edge_geodesic import EdgeGeodesic
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .parts import Parts
from .result import Chart, Claim, Result, Series, Table
from .shapes import Shapes
from .table1 import METHODS
from .timing import Time, busy, median, ratio_estimate, timed

TITLE = "Time for pairs of a subset"
SIZES = (2_000, 4_000, 8_000, 16_000, 56_000, 111_000)
QUICK_SIZES = SIZES[:3]
SUBSETS = (2, 100, 400)
REPEATS, MOST_REPEATS = 3, 4
"""How often each method is timed, the methods in turns; the latter at the largest size, which is judged."""
LARGE = 20_000
"""Meshes that take long: there a time that is not judged is taken once."""
BLOCK = 64
"""Columns solved for together: wide enough for two threads."""
PAPER = {
    2_000: ((0.05, 0.19, 1.30), (0.01, 0.64, 2.65), 1.22),
    4_000: ((0.15, 0.62, 4.31), (0.03, 1.62, 6.40), 4.09),
    8_000: ((0.27, 1.07, 8.74), (0.06, 2.73, 10.83), 1.38),
    16_000: ((0.64, 2.66, 15.53), (0.12, 6.23, 25.67), 8.80),
    56_000: ((2.07, 9.74, 46.20), (0.2, 10.45, 41.38), 74.22),
    111_000: ((11.18, 37.13, 185.28), (1.05, 52.8, 200.39), 202.20),
}
"""Seconds printed in the paper: biharmonic and Dijkstra for M = 2, 100, 400, diffusion (t = 0.125) for all three."""


PairwiseDistances = Callable[[IntArray], FloatArray]
Found = dict[tuple[int, int, str], list[Time]]


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Time the way from a bare mesh to the (M, M) distances (quick: N = 2k, 4k, 8k)."""
    (name,) = shapes.names("figure")
    parts = Parts()
    sizes = shapes.sizes(name, QUICK_SIZES if quick else SIZES, parts, part(progress, 0, 0.2))
    warm = shapes.at_most(name, 500)
    for method in METHODS:
        subset_times(warm, [np.array([0, 1])], method)
    found: Found = {}
    for size, n in enumerate(sizes):
        at = sum(sizes[:size]) / sum(sizes)
        step = part(progress, 0.2 + 0.8 * at, 0.2 + 0.8 * (at + n / sum(sizes)))
        surface = shapes.sized(name, n)
        subsets = [np.random.default_rng(0).choice(n, m, replace=False) for m in SUBSETS]
        repeats = MOST_REPEATS if n == sizes[-1] else REPEATS if n < LARGE else 1
        for repeat in range(repeats):
            # The ends of the range are judged.
            chosen = [0, len(SUBSETS) - 1] if repeat and n >= LARGE else range(len(SUBSETS))
            for q, method in enumerate(METHODS):
                done = (repeat + q / len(METHODS)) / repeats
                step(done, f"{n:,} vertices, {method}, {repeat + 1} of {repeats} times")
                for k, time in zip(chosen, subset_times(surface, [subsets[k] for k in chosen], method), strict=True):
                    found.setdefault((n, SUBSETS[k], method), []).append(time)
    rows = []
    for (n, m, method), times in found.items():
        every = [t.processor for t in times]
        printed = _printed(n, SUBSETS.index(m), METHODS.index(method))
        rows.append((n, m, method, median(times).processor, min(every), max(every), median(times).wall, printed))
    columns = ("vertices", "M", "method", "processor seconds", "least", "most", "wall seconds", "paper, seconds")
    table = Table("times", columns, tuple(sorted(rows, key=lambda row: (row[0], row[1], METHODS.index(row[2])))))
    return Result(
        "table2",
        TITLE,
        "Each time is that from a mesh to the distances among M random vertices (seed 0): the set-up, which is done "
        "once in each repetition for all M, and the work for M. Biharmonic: factorization and M wide solves, without "
        "the diagonal. Dijkstra: SciPy's, from M sources. Diffusion: eigenpairs until the weight falls to 1e-8 of "
        f"the first. Times are processor times of all threads, with one BLAS thread, of {REPEATS} repetitions "
        f"({MOST_REPEATS} at the largest size; above {LARGE:,} vertices, what is not judged is timed once) in which "
        "the methods take turns. A ratio is the geometric mean over the repetitions, with Student's interval. Tables "
        "and charts show medians.",
        charts=tuple(_chart(table, sizes, m) for m in SUBSETS),
        tables=(table,),
        claims=_claims(found, sizes),
        not_done=tuple(parts.not_done),
    )


def subset_times(surface: Surface, subsets: Sequence[IntArray], method: str) -> list[Time]:
    """Time the distances among the vertices of each subset, each from nothing."""
    among, set_up = timed(partial(_set_up, surface, method))
    return [set_up + timed(partial(among, vertices))[1] for vertices in subsets]


def distances_among(surface: Surface, vertices: IntArray, method: str) -> FloatArray:
    """Return (m, m) distances among some vertices (m,) of one connected surface, as quickly as each method can."""
    return _set_up(surface, method)(vertices)


def _set_up(surface: Surface, method: str) -> PairwiseDistances:
    """Prepare a surface, and return a function for the (m, m) distances among vertices (m,)."""
    if method == "Dijkstra":
        edges = EdgeGeodesic(surface)
        return lambda vertices: edges.distances(vertices)[vertices]
    if method != "biharmonic":
        return EigenpairDiffusion(Laplacian(surface), 0.125).pairwise
    component = Laplacian(surface).components[0]
    component.factor()
    root = np.sqrt(component.areas)

    def among(vertices: IntArray) -> FloatArray:
        half = np.empty((len(vertices), len(root)))
        # In blocks, as several copies of all columns would fill the memory.
        for start in range(0, len(vertices), BLOCK):
            block = vertices[start : start + BLOCK]
            b = unit_columns(len(root), block)
            half[start : start + BLOCK] = component.centred(component.solve(b)).T * root
        green = half @ half.T
        diagonal = np.diag(green)
        return np.sqrt(np.maximum(diagonal + diagonal[:, None] - 2 * green, 0))

    return among


def _printed(n: int, q: int, r: int) -> float | None:
    if n not in PAPER:
        return None
    entry = PAPER[n][r]
    return entry if isinstance(entry, float) else entry[q]


def _chart(table: Table, sizes: Sequence[int], m: int) -> Chart:
    series = tuple(
        Series(method, np.array(sizes), np.array(table.values("processor seconds", M=m, method=method), float))
        for method in METHODS
    )
    return Chart(f"{m} vertices", "vertices", "processor seconds", series, log_x=True, log_y=True)


def _claims(found: Found, sizes: Sequence[int]) -> tuple[Claim, ...]:
    n = sizes[-1]
    warning = busy(t for (_, _, method), times in found.items() if method == "Dijkstra" for t in times)

    def times_at(m: int) -> str:
        times = ", ".join(f"{method} {median(found[n, m, method]).processor:.3g} s" for method in METHODS)
        return f"At N = {n:,}, M = {m}: {times}."

    def over(m: int, best: str) -> Claim:
        ratios = {
            f"processor time at M = {m}, {other} over {best}": ratio_estimate(found[n, m, other], found[n, m, best])
            for other in METHODS
            if other != best
        }
        return Claim("table2-1" if m == SUBSETS[0] else "table2-2", ratios, times_at(m), warning)

    few, many = (found[n, m, METHODS[2]] for m in (SUBSETS[0], SUBSETS[-1]))
    return (
        over(SUBSETS[0], "Dijkstra"),
        over(SUBSETS[-1], "biharmonic"),
        Claim(
            "table2-3",
            {"processor time, M = 400 over M = 2, diffusion t = 0.125": ratio_estimate(many, few)},
            f"At N = {n:,}: {median(few).processor:.3g} and {median(many).processor:.3g} s.",
            warning,
        ),
    )
