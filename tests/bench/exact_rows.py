"""Rows 1 to 4, 11, 23 and 25: what the exact distance costs.

Set-up always means from arrays to the first exact field, so that nothing hides in laziness.
"""

import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from bihdist_core import BiharmonicDistance, Surface
from bihdist_core.analysis.all_pairs import write_all_pairs
from bihdist_core.solver.blas import one_blas_thread
from bihdist_core.solver.elimination_tree import EliminationTree
from bihdist_core.solver.factor import Factor
from bihdist_core.solver.worker_threads import without_workers

from . import machine, peers
from .case import EXACT, Case, difference, main_case
from .child import forget_peak, in_child, peak_memory
from .least_work import column_bytes, operations
from .meshes import along_curve, bumpy_sphere
from .size import Size
from .table import Line, compared
from .timing import alternate, timed

SINGLE = 2e-7
"""Rounding to float32."""
CHOLESKY_BOUND = 1.0


def set_up(size: Size) -> Iterator[Line]:
    case = main_case(size)
    line = _set_up_line(case, f"exact set-up, {case.count}", 0.2)
    work = operations(case.component.tree())
    yield replace(line, limit=work / line.ours / machine.limits()[1], memory=in_child(_set_up_alone, size))
    ordered = Case(*along_curve(*case.arrays), size)
    yield _set_up_line(ordered, f"exact set-up, numbered along a curve, {case.count}", 0.24)
    with one_blas_thread(), without_workers():
        line = _set_up_line(case, f"exact set-up on one thread, {case.count}", 0.28)
    yield line
    laplacian = case.distance.laplacian
    yield compared(
        1,
        f"accuracy of the exact distance, {case.count}",
        alternate(lambda: BiharmonicDistance(laplacian).accuracy, case.set_up, size.rounds),
        bound=0.25,
        note="peer: our set-up",
    )


def _set_up_line(case: Case, work: str, bound: float) -> Line:
    result = alternate(case.set_up, lambda: peers.heat_solver(*case.arrays), case.size.rounds)
    return compared(
        1,
        work,
        result,
        bound=bound,
        error=case.error(result.answer.from_source(case.source)[case.targets]),
        tolerance=EXACT,
        note="peer: potpourri3d, heat solver constructed",
    )


def one_field(size: Size) -> Iterator[Line]:
    case = main_case(size)
    result = case.one_field
    values = case.distance.from_source(case.source)[case.targets]
    yield compared(
        2,
        f"one exact field, {case.count}",
        result,
        bound=0.1,
        limit=column_bytes(case.component.tree()) / result.our_time / machine.limits()[0],
        error=case.error(values),
        tolerance=EXACT,
        note="peer: one potpourri3d heat solve",
    )


def many_sources(size: Size) -> Iterator[Line]:
    case = main_case(size)

    def ours() -> np.ndarray:
        return BiharmonicDistance(Surface(*case.arrays)).from_sources(case.sources)

    def dijkstra() -> np.ndarray:
        return peers.edge_distances(peers.edge_graph(Surface(*case.arrays)), case.sources)

    result = alternate(ours, dijkstra, max(1, size.rounds - 1))
    yield compared(
        3,
        f"{len(case.sources)} sources to all, {case.count}, set-up included",
        result,
        bound=0.14,
        error=case.error(result.answer[case.targets, 0]),
        tolerance=EXACT,
        note="peer: scipy Dijkstra",
    )


def all_pairs(size: Size) -> Iterator[Line]:
    case = Case(*bumpy_sphere(size.pairs), size)
    with tempfile.TemporaryDirectory() as folder:
        path, other = str(Path(folder, "ours.npy")), str(Path(folder, "peer.npy"))

        def ours() -> None:
            write_all_pairs(BiharmonicDistance(Surface(*case.arrays)), path)

        def dijkstra() -> None:
            peers.edge_distances_to_file(peers.edge_graph(Surface(*case.arrays)), other)

        result = alternate(ours, dijkstra, 1)
        values = np.load(path, mmap_mode="r")[case.source, case.targets]
        memory = in_child(_all_pairs_alone, size)
    yield compared(
        4,
        f"all pairs to float32 on disk, {case.count}",
        result,
        bound=0.14,
        memory=memory,
        error=case.error(values),
        tolerance=SINGLE,
        note="peer: scipy Dijkstra, to the same",
    )


def column(size: Size) -> Iterator[Line]:
    case = main_case(size)
    component = case.component
    factor, index = component.factor(diagonals=True), np.array([case.source])
    source = iter(np.tile(case.sources, 100))
    # Both depend on what else the machine does, so they are measured in turn.
    ours, copied = [], []
    for _ in range(3 * size.rounds):
        copied.append(machine.bandwidth(rounds=3))
        # The first ones after the copying are slower.
        runs = [timed(lambda: factor.sandwich_columns([next(source)]))[0] for _ in range(4 * size.repeat)]
        ours.append(np.median(runs))
    least = column_bytes(component.tree()) / np.array(copied)
    ratio = float(np.median(ours / least))
    green = component.solve(np.eye(1, len(component.areas), case.source)[0])
    twice = component.solve(component.areas * green)
    yield Line(
        11,
        f"column against memory bandwidth, {case.count}",
        float(np.median(ours)),
        float(np.median(least)),
        ratio,
        bound=3,
        limit=1 / ratio,
        error=difference(factor.sandwich_columns(index)[:, 0], twice, over=np.abs(twice).max()),
        tolerance=EXACT,
        note=f"{np.median(copied) / 1e9:.1f} GB/s copied on two threads",
    )


def small_meshes(size: Size) -> Iterator[Line]:
    """From arrays to one field of each of many small meshes."""
    cases = [Case(*bumpy_sphere(1000, seed), size) for seed in range(size.small)]

    def ours() -> list[np.ndarray]:
        return [BiharmonicDistance(Surface(*case.arrays)).from_source(case.source) for case in cases]

    def heat() -> list[np.ndarray]:
        return [peers.heat_solver(*case.arrays).compute_distance(case.source) for case in cases]

    result = alternate(ours, heat, size.rounds)
    yield compared(
        23,
        f"exact set-up and one field of {len(cases):,} meshes of about 1,000 vertices",
        result,
        bound=0.6,
        error=max(case.error(field[case.targets]) for case, field in zip(cases[:20], result.answer, strict=False)),
        tolerance=EXACT,
        note="peer: potpourri3d, heat solver constructed and one heat solve",
    )


def cholesky(size: Size) -> Iterator[Line]:
    """The factor alone, without diagonals, and columns of G A G, by CHOLMOD on the same pinned matrix."""
    case = main_case(size)
    works = f"factor of the pinned matrix, {case.count}", f"column of G A G, {case.count}"
    if not peers.is_installed("cholespy"):
        for work in works:
            yield Line(25, work, bound=CHOLESKY_BOUND, note="skipped: cholespy, which has CHOLMOD, is not installed")
        return
    component = case.component
    keep = np.arange(len(component.areas)) != component.pin
    matrix, areas, x = component.stiffness[keep][:, keep], component.areas[keep], component.surface.vertices[keep]
    compressed, source = matrix.tocsc(), np.count_nonzero(keep[: case.source])
    unit = np.eye(1, len(areas), source)[0]
    result = alternate(
        lambda: Factor(EliminationTree(matrix, x), matrix), lambda: peers.cholmod(compressed), size.rounds
    )
    solve, expected = result.peer_answer, result.peer_answer(unit)
    yield compared(
        25,
        works[0],
        result,
        bound=CHOLESKY_BOUND,
        error=difference(result.answer.solve(unit), expected, over=np.abs(expected).max()),
        tolerance=EXACT,
        note="peer: CHOLMOD by cholespy; both with their ordering",
    )
    factor = Factor(EliminationTree(matrix, x), matrix, areas)
    result = alternate(
        lambda: factor.sandwich_columns([source])[:, 0],
        lambda: solve(areas * solve(unit)),
        3 * size.rounds,
        size.repeat,
    )
    yield compared(
        25,
        works[1],
        result,
        bound=CHOLESKY_BOUND,
        error=difference(result.answer, result.peer_answer, over=np.abs(result.peer_answer).max()),
        tolerance=EXACT,
        note="peer: two solves by CHOLMOD",
    )


def _set_up_alone(size: Size) -> int:
    case = main_case(size)
    forget_peak()
    case.set_up()
    return peak_memory()


def _all_pairs_alone(size: Size) -> int:
    case = Case(*bumpy_sphere(size.pairs), size)
    forget_peak()
    with tempfile.TemporaryDirectory() as folder:
        write_all_pairs(BiharmonicDistance(Surface(*case.arrays)), Path(folder, "ours.npy"))
    return peak_memory()
