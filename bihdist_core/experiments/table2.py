"""Table II: seconds for the distances of all pairs among M = 2, 100, 400 vertices, N = 2k to 111k.

The paper: Dijkstra is fastest for small M; biharmonic distance pays for its factorization first and is fastest for
large M; diffusion distance hardly depends on M.
"""

from functools import partial
from time import perf_counter, process_time

import numpy as np

from ..distances.diffusion import DiffusionDistance
from ..distances.edge_geodesic import EdgeGeodesic
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .result import Chart, Claim, Result, Series, Table
from .shapes import Shapes
from .table1 import METHODS, best

TITLE = "Time for pairs of a subset"
SIZES = (2_000, 4_000, 8_000, 16_000, 56_000, 111_000)
QUICK_SIZES = SIZES[:3]
SUBSETS = (2, 100, 400)
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


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Times from a bare mesh to the (M, M) distances (quick: N = 2k, 4k, 8k)."""
    (name,) = shapes.names("figure")
    sizes = QUICK_SIZES if quick else SIZES
    warm = shapes.sized(name, 500)
    for method in METHODS:
        subset_pairs(warm, np.array([0, 1]), method)
    rows: list[tuple[int, int, str, float, float, float | None]] = []
    for k, n in enumerate(sizes):
        at = sum(sizes[:k]) / sum(sizes)
        step = part(progress, at, at + n / sum(sizes))
        surface = shapes.sized(name, n, part(step, 0, 0.3))
        for q, m in enumerate(SUBSETS):
            vertices = np.random.default_rng(0).choice(n, m, replace=False)
            for r, method in enumerate(METHODS):
                part(step, 0.3, 1)((q * 3 + r) / 9, f"{n:,} vertices, {m} of them, {method}")
                wall, cpu = best(partial(subset_pairs, surface, vertices, method))
                rows.append((n, m, method, wall, cpu, _printed(n, q, r)))
    table = Table("times", ("vertices", "M", "method", "seconds", "CPU seconds", "paper, seconds"), tuple(rows))
    return Result(
        "table2",
        TITLE,
        "Each time is from a bare mesh to the distances among M random vertices (seed 0). Biharmonic: factorization "
        "and M wide solves; no diagonal is needed for pairs. Dijkstra: SciPy's, from M sources. Diffusion: eigenpairs "
        "until the weight falls to 1e-8 of the first. CPU time counts all threads; short runs are repeated and "
        "the best counts.",
        charts=tuple(_chart(table, sizes, m) for m in SUBSETS),
        tables=(table,),
        claims=_claims(table, sizes),
    )


def subset_pairs(surface: Surface, vertices: np.ndarray, method: str) -> tuple[float, float]:
    """Wall and CPU seconds for the distances among some vertices, from nothing."""
    wall, cpu = perf_counter(), process_time()
    distances_among(surface, vertices, method)
    return perf_counter() - wall, process_time() - cpu


def distances_among(surface: Surface, vertices: np.ndarray, method: str) -> np.ndarray:
    """(m, m) distances among some vertices (m,) of one connected surface, as quickly as each method can."""
    if method == "biharmonic":
        component = Laplacian(surface).components[0]
        half = np.empty((len(vertices), len(surface.vertices)))
        root = np.sqrt(component.areas)
        # In blocks, as several copies of all columns would fill the memory.
        for start in range(0, len(vertices), BLOCK):
            block = vertices[start : start + BLOCK]
            b = np.zeros((len(root), len(block)))
            b[block, np.arange(len(block))] = 1
            half[start : start + BLOCK] = component.centred(component.solve(b)).T * root
        green = half @ half.T
        diagonal = np.diag(green)
        return np.sqrt(np.maximum(diagonal + diagonal[:, None] - 2 * green, 0))
    if method == "Dijkstra":
        return EdgeGeodesic(surface).distances(vertices)[vertices]
    return DiffusionDistance(Laplacian(surface), 0.125).pairwise(vertices)


def _printed(n: int, q: int, r: int) -> float | None:
    if n not in PAPER:
        return None
    entry = PAPER[n][r]
    return entry if isinstance(entry, float) else entry[q]


def _chart(table: Table, sizes: tuple[int, ...], m: int) -> Chart:
    series = tuple(
        Series(method, np.array(sizes), np.array([float(v or 0) for v in table.values("seconds", M=m, method=method)]))
        for method in METHODS
    )
    return Chart(f"{m} vertices", "vertices", "seconds", series, log_x=True, log_y=True)


def _claims(table: Table, sizes: tuple[int, ...]) -> tuple[Claim, ...]:
    n = sizes[-1]

    def seconds(m: int, method: str) -> float:
        return table.value("seconds", vertices=n, M=m, method=method)

    def said(m: int) -> str:
        return f"N = {n:,}, M = {m}: " + ", ".join(f"{method} {seconds(m, method):.3g} s" for method in METHODS) + "."

    diffusion = [seconds(m, METHODS[2]) for m in SUBSETS]
    return (
        Claim(
            "Dijkstra is fastest for small M.", said(2), seconds(2, "Dijkstra") == min(seconds(2, m) for m in METHODS)
        ),
        Claim(
            "Biharmonic distance becomes the fastest for large M.",
            said(400),
            seconds(400, "biharmonic") == min(seconds(400, m) for m in METHODS),
        ),
        Claim(
            "The time for diffusion distance does not depend on M.",
            f"N = {n:,}: " + ", ".join(f"M = {m} {s:.3g} s" for m, s in zip(SUBSETS, diffusion, strict=True)) + ".",
            max(diffusion) < 1.5 * min(diffusion),
        ),
    )
