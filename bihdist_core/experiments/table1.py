"""Table I: seconds for the distances of all pairs of vertices, N = 2k to 16k.

The paper (2.2 GHz Opteron): biharmonic distance is about twice as fast as Dijkstra's algorithm, diffusion distance
much faster; times grow like N^2, N^2 log N and N^1.5.
"""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..distances.biharmonic import BiharmonicDistance
from ..distances.diffusion import EigenpairDiffusion
from ..distances.edge_geodesic import EdgeGeodesic
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .parts import Parts
from .result import STATEMENTS, Cell, Chart, Claim, Result, Series, Table
from .shapes import Shapes
from .timing import Time, busy, median, ratio_estimate, timed
from .verdicts import exponent_estimate

TITLE = "Time for all pairs of vertices"
SIZES = (2_000, 4_300, 8_000, 12_000, 16_000)
JUDGED = SIZES[-1]
QUICK_SIZES = (1_000, 1_500, 2_000, 4_000, 6_000)
PAPER = {
    2_000: (6.3, 14.4, 1.2),
    4_300: (40.3, 74.8, 4.11),
    8_000: (131.6, 233.3, 8.8),
    12_000: (472.7, 610.7, 13.0),
    16_000: (607.6, 1098.5, 37.2),
}
"""Seconds printed in the paper: biharmonic, Dijkstra, diffusion with t = 0.125."""
METHODS = ("biharmonic", "Dijkstra", "diffusion t = 0.125")
BLOCK = 256
BLOCKS = 3
"""Blocks of sources that are timed, spread evenly; they count for all of them."""
REPEATS, MOST_REPEATS = 3, 5
"""How often each method is timed, the methods in turns; the latter at the largest size, which is judged alone."""
Columns = Callable[[IntArray], FloatArray]


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Time the way from a bare mesh to an (N, N) float32 array of distances (quick: N = 1k to 6k)."""
    (name,) = shapes.names("figure")
    parts = Parts()
    sizes = shapes.sizes(name, QUICK_SIZES if quick else SIZES, parts, part(progress, 0, 0.1))
    # Libraries are loaded, and threads started, before anything is timed.
    warm = shapes.at_most(name, 500)
    for method in METHODS:
        all_pairs(warm, method)
    found: dict[tuple[int, str], list[Time]] = {}
    for k, n in enumerate(sizes):
        surface = shapes.sized(name, n)
        repeats = MOST_REPEATS if n == sizes[-1] else REPEATS
        for repeat in range(repeats):
            done = (sum(sizes[:k]) + n * repeat / repeats) / sum(sizes)
            part(progress, 0.1, 1)(done, f"{n:,} vertices, {repeat + 1} of {repeats} times")
            for method in METHODS:
                found.setdefault((n, method), []).append(all_pairs(surface, method))
    rows = []
    for (n, method), times in found.items():
        every = [t.processor for t in times]
        printed = PAPER[n][METHODS.index(method)] if n in PAPER else None
        rows.append((n, method, median(times).processor, min(every), max(every), median(times).wall, printed))
    columns = ("vertices", "method", "processor seconds", "least", "most", "wall seconds", "paper, seconds")
    table = Table("times", columns, tuple(rows))
    return Result(
        "table1",
        TITLE,
        "Each time is that from a mesh (without operators, factor or spectrum) to the array of all N × N distances "
        f"in single precision, in blocks of {BLOCK} sources. Of more than {BLOCKS} blocks, {BLOCKS} spread evenly are "
        "timed and stand for the rest. Biharmonic: factorization and diagonal, then wide solves on two threads. "
        "Dijkstra: SciPy's, on one thread, from all sources. Diffusion: eigenpairs until the weight falls to 1e-8 of "
        "the first, then distances of points. Times are processor times of all threads, with one BLAS thread, of "
        f"{REPEATS} repetitions ({MOST_REPEATS} at the largest size) in which the methods take turns. A ratio is the "
        "geometric mean over the repetitions, with Student's interval; an exponent is fitted to the least times, "
        "with the interval of resampled sizes and repetitions. Tables and charts show medians.",
        charts=(
            Chart(
                "all pairs",
                "vertices",
                "processor seconds",
                tuple(Series(method, np.array(sizes), _column(table, method)) for method in METHODS),
                log_x=True,
                log_y=True,
            ),
        ),
        tables=(table, Table("ratios", ("vertices", "ratio", "here", "low", "high", "paper"), _ratios(sizes, found))),
        claims=_claims(sizes, found),
        not_done=tuple(parts.not_done),
    )


def all_pairs(surface: Surface, method: str) -> Time:
    """Time all pairs of one surface, from nothing."""
    n = len(surface.vertices)

    def set_up() -> tuple[AnyArray, Columns]:
        return np.empty((n, n), np.float32), _columns(surface, method)

    (result, columns), total = timed(set_up)
    starts = np.arange(0, n, BLOCK)
    chosen = starts[np.unique(np.linspace(0, len(starts) - 1, BLOCKS).round().astype(int))]
    blocks, covered = Time(), 0

    def write(start: int) -> int:
        # A distance is symmetric: columns are rows, and rows are written in one piece.
        block = columns(np.arange(start, min(start + BLOCK, n))).T
        result[start : start + BLOCK] = block
        return len(block)

    for start in chosen.tolist():
        count, seconds = timed(partial(write, start))
        blocks, covered = blocks + seconds, covered + count
    return total + blocks.times(n / covered)


def _columns(surface: Surface, method: str) -> Columns:
    if method == "Dijkstra":
        return EdgeGeodesic(surface).distances
    laplacian = Laplacian(surface)
    distance = BiharmonicDistance(laplacian) if method == "biharmonic" else EigenpairDiffusion(laplacian, 0.125)
    # What is computed when it is first needed belongs to the set-up.
    distance.from_source(int(surface.faces[0, 0]))
    return distance.from_sources


def _column(table: Table, method: str) -> FloatArray:
    return np.array(table.values("processor seconds", method=method), float)


def _ratios(sizes: Sequence[int], found: dict[tuple[int, str], list[Time]]) -> tuple[tuple[Cell, ...], ...]:
    rows = []
    for n in sizes:
        for q, over in ((1, "Dijkstra"), (2, "diffusion t = 0.125")):
            printed = PAPER[n][q] / PAPER[n][0] if n in PAPER else None
            here = ratio_estimate(found[n, over], found[n, "biharmonic"])
            rows.append((n, f"{over} / biharmonic", here.value, here.low, here.high, printed))
    return tuple(rows)


def _claims(sizes: Sequence[int], found: dict[tuple[int, str], list[Time]]) -> tuple[Claim, ...]:
    warning = busy(t for (_, method), times in found.items() if method == "Dijkstra" for t in times)
    # Ratios change with the size: those of a smaller one tell nothing of the statements.
    is_judged = sizes[-1] >= JUDGED

    def over(id: str, slow: str, fast: str) -> Claim:
        ratios = [ratio_estimate(found[n, slow], found[n, fast]) for n in sizes]
        in_paper = PAPER[SIZES[-1]][METHODS.index(slow)] / PAPER[SIZES[-1]][METHODS.index(fast)]
        return Claim(
            id,
            dict(zip(STATEMENTS[id].names, ratios[-1:], strict=True)) if is_judged else {},
            f"{', '.join(f'{r.value:.2f} at {n:,}' for r, n in zip(ratios, sizes, strict=True))} vertices; "
            f"the paper: {in_paper:.3g} at {SIZES[-1]:,}.",
            warning,
            "" if is_judged else f"Not judged at this size, {sizes[-1]:,} vertices, but at {JUDGED:,}.",
        )

    return (
        over("table1-1", "Dijkstra", "biharmonic"),
        Claim(
            "table1-2",
            {
                f"exponent of N, {m}": exponent_estimate(sizes, [[t.processor for t in found[n, m]] for n in sizes])
                for m in METHODS
            },
            "Fitted to the least of the repetitions. All N × N distances are written, so that no method can be below "
            "the exponent 2 for long: where one is, its set-up, which grows more slowly, takes part of the time.",
            warning,
        ),
        over("table1-3", "biharmonic", "diffusion t = 0.125"),
    )
