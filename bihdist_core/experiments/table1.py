"""Table I: seconds for the distances of all pairs of vertices, N = 2k to 16k.

The paper (2.2 GHz Opteron): biharmonic distance is about twice as fast as Dijkstra's algorithm, diffusion distance
much faster; times grow like N^2, N^2 log N and N^1.5.
"""

from collections.abc import Callable
from functools import partial
from time import perf_counter, process_time

import numpy as np

from ..distances.biharmonic import BiharmonicDistance
from ..distances.diffusion import DiffusionDistance
from ..distances.edge_geodesic import EdgeGeodesic
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .result import Chart, Claim, Result, Series, Table
from .shapes import Shapes

TITLE = "Time for all pairs of vertices"
SIZES = (2_000, 4_300, 8_000, 12_000, 16_000)
QUICK_SIZES = (1_000, 2_000, 3_000)
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
SHORT = 5.0
"""Seconds: what takes less is timed again, and the best counts, so that other work on the computer matters less."""
Columns = Callable[[np.ndarray], np.ndarray]


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Times from a bare mesh to an (N, N) float32 array of distances (quick: N = 1k, 2k, 3k)."""
    (name,) = shapes.names("figure")
    sizes = QUICK_SIZES if quick else SIZES
    # Libraries are loaded, and threads started, before anything is timed.
    warm = shapes.sized(name, 500)
    for method in METHODS:
        all_pairs(warm, method)
    rows, seconds = [], {method: [] for method in METHODS}  # type: ignore[var-annotated]
    total = sum(n**2 for n in sizes)
    for k, n in enumerate(sizes):
        done = sum(m**2 for m in sizes[:k]) / total
        surface = shapes.sized(name, n)
        for q, method in enumerate(METHODS):
            step = part(progress, done + n**2 / total * q / 3, done + n**2 / total * (q + 1) / 3)
            wall, cpu = best(partial(all_pairs, surface, method, step))
            seconds[method].append(wall)
            rows.append((n, method, wall, cpu, PAPER[n][q] if n in PAPER else None))
    return Result(
        "table1",
        TITLE,
        "Each time is from a bare mesh (no operators, no factor, no spectrum) to the array of all N × N distances in "
        "single precision, in blocks of 256 sources. Biharmonic: factorization and diagonal, then wide solves on two "
        "threads. Dijkstra: SciPy's, on one thread (it holds the interpreter's lock), over a graph made once, all "
        "sources. Diffusion: eigenpairs until the weight falls to 1e-8 of the first, then distances of points. "
        "CPU time counts all threads; short runs are repeated and the best counts.",
        charts=(
            Chart(
                "all pairs",
                "vertices",
                "seconds",
                tuple(Series(method, np.array(sizes), np.array(seconds[method])) for method in METHODS),
                log_x=True,
                log_y=True,
            ),
        ),
        tables=(
            Table("times", ("vertices", "method", "seconds", "CPU seconds", "paper, seconds"), tuple(rows)),
            Table("ratios", ("vertices", "ratio", "here", "paper"), tuple(_ratios(sizes, seconds))),
        ),
        claims=_claims(sizes, seconds, rows),
    )


def best(timed: Callable[[], tuple[float, float]]) -> tuple[float, float]:
    """The least wall seconds of up to three runs, and their CPU seconds; of one run, if that takes long."""
    runs = [timed()]
    while len(runs) < 3 and sum(wall for wall, _ in runs) < SHORT:
        runs.append(timed())
    return min(runs)


def all_pairs(surface: Surface, method: str, progress: Progress | None = None) -> tuple[float, float]:
    """Wall and CPU seconds for all pairs of one surface, from nothing."""
    wall, cpu = perf_counter(), process_time()
    n = len(surface.vertices)
    result = np.empty((n, n), np.float32)
    columns = _columns(surface, method)
    for start in range(0, n, BLOCK):
        # A distance is symmetric: columns are rows, and rows are written in one piece.
        result[start : start + BLOCK] = columns(np.arange(start, min(start + BLOCK, n))).T
        part(progress, 0, 1)(min(1.0, (start + BLOCK) / n), f"{n:,} vertices, {method}")
    return perf_counter() - wall, process_time() - cpu


def _columns(surface: Surface, method: str) -> Columns:
    if method == "biharmonic":
        return BiharmonicDistance(Laplacian(surface)).from_sources
    if method == "Dijkstra":
        return EdgeGeodesic(surface).distances
    return DiffusionDistance(Laplacian(surface), 0.125).from_sources


def _ratios(sizes: tuple[int, ...], seconds: dict[str, list[float]]) -> list[tuple[int, str, float, float | None]]:
    rows = []
    for k, n in enumerate(sizes):
        for over, q in (("Dijkstra", 1), ("diffusion t = 0.125", 2)):
            printed = PAPER[n][q] / PAPER[n][0] if n in PAPER else None
            rows.append((n, f"{over} / biharmonic", seconds[over][k] / seconds["biharmonic"][k], printed))
    return rows


def _claims(sizes: tuple[int, ...], seconds: dict[str, list[float]], rows: list) -> tuple[Claim, ...]:
    ratio = [d / b for d, b in zip(seconds["Dijkstra"], seconds["biharmonic"], strict=True)]
    cpu = {(row[0], row[1]): row[3] for row in rows}
    growth = {m: float(np.polyfit(np.log(sizes), np.log(seconds[m]), 1)[0]) for m in METHODS}
    return (
        Claim(
            "For all pairs, biharmonic distance is much faster than Dijkstra's algorithm.",
            f"Dijkstra over biharmonic: {', '.join(f'{r:.2f} at {n:,}' for r, n in zip(ratio, sizes, strict=True))}; "
            f"of CPU time {cpu[sizes[-1], 'Dijkstra'] / cpu[sizes[-1], 'biharmonic']:.2f} at {sizes[-1]:,} "
            "(the paper: 1.81 at 16,000).",
            ratio[-1] > 1,
        ),
        Claim(
            "Time grows like N^2 for biharmonic distance, N^2 log N for Dijkstra, N^1.5 for diffusion.",
            "Fitted exponents: " + ", ".join(f"{m} {g:.2f}" for m, g in growth.items()) + ".",
            growth["biharmonic"] < 2.3,
        ),
    )
