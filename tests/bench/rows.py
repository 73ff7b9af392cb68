"""Rows 1 to 11: what the core does, one small function each.

Set-up always means from arrays to the first exact field, so that nothing hides in laziness.
"""

import tempfile
from collections.abc import Iterator
from functools import cache, cached_property
from pathlib import Path

import numpy as np

from bihdist_core import BiharmonicDistance, GeodesicDistance, Surface
from bihdist_core.all_pairs import write_all_pairs
from bihdist_core.elimination_tree import EliminationTree
from bihdist_core.heat_geodesic import heat_matrix, heat_time
from bihdist_core.laplacian import Component
from bihdist_core.spectrum import Spectrum, smallest_eigenpairs

from . import machine, peers
from .child import forget_peak, in_child, peak_memory
from .meshes import MAKERS, bumpy_sphere
from .size import Size
from .table import Line
from .timing import Comparison, alternate, timed

EXACT = 1e-7
"""A single distance may be off by this share: next to the source digits cancel."""
SINGLE = 2e-7
"""Rounding to float32."""
HEAT = 1e-6
RESIDUAL, EIGENVALUE = 1e-4, 1e-6


class Case:
    """One mesh, and what several rows need of it, made once."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray, size: Size) -> None:
        self.arrays, self.size = (vertices, faces), size
        random = np.random.default_rng(1)
        self.sources = random.choice(len(vertices), min(size.sources, len(vertices)), replace=False)
        near = faces[(faces == self.sources[0]).any(axis=1)][0]
        self.targets = np.array([v for v in [*near, *random.choice(len(vertices), 20)] if v != self.sources[0]])

    @property
    def source(self) -> int:
        return int(self.sources[0])

    def set_up(self) -> BiharmonicDistance:
        """From arrays to a distance that has answered once."""
        distance = BiharmonicDistance(Surface(*self.arrays))
        distance.from_source(self.source)
        return distance

    @cached_property
    def distance(self) -> BiharmonicDistance:
        return self.set_up()

    @property
    def component(self) -> Component:
        return self.distance.laplacian.components[0]

    @cached_property
    def heat_peer(self):
        solver = peers.heat_solver(*self.arrays)
        solver.compute_distance(self.source)
        return solver

    @cached_property
    def reference(self) -> peers.Reference:
        return peers.Reference(self.component)

    def error(self, values: np.ndarray) -> float:
        """Largest relative difference of distances from the source to the targets."""
        return _difference(values, self.reference.biharmonic(self.source, self.targets))

    @cached_property
    def one_field(self) -> Comparison:
        """Row 2's times, which other rows are measured by."""
        distance, peer = self.distance, self.heat_peer
        next_ours, next_peer = iter(np.tile(self.sources, 100)), iter(np.tile(self.sources, 100))
        return alternate(
            lambda: distance.from_source(int(next(next_ours))),
            lambda: peer.compute_distance(int(next(next_peer))),
            3 * self.size.rounds,
            self.size.repeat,
        )


@cache
def main_case(size: Size) -> Case:
    return Case(*size.main_mesh(), size)


@cache
def limits() -> tuple[float, float]:
    """Bytes and floating-point operations per second, at most."""
    return machine.bandwidth(), machine.matmul_rate()


# ---------------------------------------------------------------------- exact distances
def set_up(size: Size) -> Iterator[Line]:
    case = main_case(size)
    result = alternate(case.set_up, lambda: peers.heat_solver(*case.arrays), size.rounds)
    values = result.answer.from_source(case.source)[case.targets]
    work = operations(case.component.tree())
    memory = in_child(_set_up_alone, size)
    yield Line(
        1,
        f"exact set-up, {_count(case)}",
        result.our_time,
        result.peer_time,
        result.ratio,
        result.effort,
        bound=0.6,
        limit=work / result.our_time / limits()[1],
        memory=memory,
        error=case.error(values),
        tolerance=EXACT,
        note="peer: potpourri3d, heat solver constructed",
    )


def one_field(size: Size) -> Iterator[Line]:
    case = main_case(size)
    result = case.one_field
    values = case.distance.from_source(case.source)[case.targets]
    yield Line(
        2,
        f"one exact field, {_count(case)}",
        result.our_time,
        result.peer_time,
        result.ratio,
        result.effort,
        bound=0.22,
        limit=column_bytes(case.component.tree()) / result.our_time / limits()[0],
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
    yield Line(
        3,
        f"{len(case.sources)} sources to all, {_count(case)}, set-up included",
        result.our_time,
        result.peer_time,
        result.ratio,
        result.effort,
        bound=0.7,
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
    yield Line(
        4,
        f"all pairs to float32 on disk, {_count(case)}",
        result.our_time,
        result.peer_time,
        result.ratio,
        result.effort,
        bound=1.0,
        memory=memory,
        error=case.error(values),
        tolerance=SINGLE,
        note="peer: scipy Dijkstra, to the same",
    )


# ---------------------------------------------------------------------- other distances
def eigenpairs(size: Size) -> Iterator[Line]:
    case = main_case(size)
    component = case.component
    for count, bound in zip(size.eigenpairs, (0.6, 0.5), strict=True):

        def ours(count: int = count) -> Spectrum:
            return smallest_eigenpairs(component.stiffness, component.areas, component.solve, count, tolerance=RESIDUAL)

        def arpack(count: int = count) -> np.ndarray:
            return peers.arpack_eigenvalues(component, count, RESIDUAL)

        result = alternate(ours, arpack, 1)
        yield Line(
            5,
            f"{count} eigenpairs, {_count(case)}",
            result.our_time,
            result.peer_time,
            result.ratio,
            result.effort,
            bound=bound,
            error=_difference(result.answer.eigenvalues, result.peer_answer),
            tolerance=EIGENVALUE,
            note=f"residuals up to {result.answer.residuals.max():.0e}; peer: scipy eigsh, the same factor",
        )


def heat_geodesic(size: Size) -> Iterator[Line]:
    case = main_case(size)

    def ours() -> GeodesicDistance:
        distance = GeodesicDistance(Surface(*case.arrays), method="heat")
        distance.from_source(case.source)
        return distance

    result = alternate(ours, lambda: peers.heat_solver(*case.arrays), size.rounds)
    distance = result.answer
    error = _difference(distance.from_source(case.source), slow_heat(case))
    yield Line(
        6,
        f"heat geodesic, set-up, {_count(case)}",
        result.our_time,
        result.peer_time,
        result.ratio,
        result.effort,
        bound=0.6,
        error=error,
        tolerance=HEAT,
        note="peer: potpourri3d, heat solver constructed",
    )
    result = alternate(
        lambda: distance.from_source(case.source),
        lambda: case.heat_peer.compute_distance(case.source),
        3 * size.rounds,
        size.repeat,
    )
    yield Line(
        6,
        f"heat geodesic, one field, {_count(case)}",
        result.our_time,
        result.peer_time,
        result.ratio,
        result.effort,
        bound=0.5,
        note="peer: one potpourri3d heat solve",
    )


def slow_heat(case: Case) -> np.ndarray:
    """(n,) the heat method, step by step, with SuperLU."""
    from scipy.sparse.linalg import splu

    component, surface = case.component, case.distance.surface
    matrix = heat_matrix(component.stiffness, component.areas, heat_time(surface))
    b = np.zeros(len(surface.vertices))
    # Heat far away is smaller than any double where it starts from 1.
    b[case.source] = 1e200
    u = splu(matrix.tocsc()).solve(b)
    x, f = surface.vertices, surface.faces
    side = [x[f[:, (k + 2) % 3]] - x[f[:, (k + 1) % 3]] for k in range(3)]
    normal = np.cross(side[0], side[1])
    scale = np.abs(u[f]).max(axis=1)
    gradient = sum(np.cross(normal, side[k]) * (u[f[:, k]] / scale)[:, None] for k in range(3))
    flow = -gradient / np.linalg.norm(gradient, axis=1)[:, None]
    divergence = np.zeros(len(x))
    for k in range(3):
        turned = np.cross(normal, side[k]) / np.linalg.norm(normal, axis=1)[:, None] / 2
        np.add.at(divergence, f[:, k], np.einsum("ij,ij->i", turned, flow))
    phi = case.reference.solve(divergence[:, None])[:, 0]
    return np.maximum(phi - phi[case.source], 0)


# ---------------------------------------------------------------------- size and shape
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
    error = _difference(fields[0][1][case.targets], pairs)
    return seconds, float(np.median([time for time, _ in fields])), peak, len(case.arrays[0]), error


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


def shapes(size: Size) -> Iterator[Line]:
    sphere = Case(*bumpy_sphere(size.main), size)
    for name, bound in [("genus 2", 1.5), ("folded sheet", None), ("needle", None)]:
        case = Case(*MAKERS[name](size.main), size)
        result = alternate(case.set_up, sphere.set_up, size.rounds)
        share = len(sphere.arrays[0]) / len(case.arrays[0])
        case.distance = result.answer
        yield Line(
            9,
            f"set-up per vertex, {name}, {_count(case)}",
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


def column(size: Size) -> Iterator[Line]:
    case = main_case(size)
    component = case.component
    factor, index = component.factor(diagonals=True), np.array([case.source])
    source = iter(np.tile(case.sources, 100))
    # Both depend on what else the machine does, so they are measured in turn.
    ours, copied = [], []
    for _ in range(3 * size.rounds):
        copied.append(machine.bandwidth(rounds=3))
        ours.append(np.median([timed(lambda: factor.sandwich_columns([next(source)]))[0] for _ in range(size.repeat)]))
    least = column_bytes(component.tree()) / np.array(copied)
    ratio = float(np.median(ours / least))
    green = component.solve(np.eye(1, len(component.areas), case.source)[0])
    twice = component.solve(component.areas * green)
    yield Line(
        11,
        f"column against memory bandwidth, {_count(case)}",
        float(np.median(ours)),
        float(np.median(least)),
        ratio,
        bound=3,
        limit=1 / ratio,
        error=_difference(factor.sandwich_columns(index)[:, 0], twice, over=np.abs(twice).max()),
        tolerance=EXACT,
        note=f"{np.median(copied) / 1e9:.1f} GB/s copied on two threads",
    )


# ---------------------------------------------------------------------- what must be done at least
def _front_sizes(tree: EliminationTree) -> tuple[np.ndarray, np.ndarray]:
    """Pivots and boundary vertices of each front, padding not counted."""
    pivots = np.bincount(tree.node[: tree.n], minlength=2 << tree.depth)
    bounds = np.zeros(len(pivots), np.int64)
    for part in tree.parts:
        for stack in part.stacks:
            bounds[stack.nodes] = (stack.bound < part.end).sum(axis=1)
    return pivots.astype(float), bounds.astype(float)


def column_bytes(tree: EliminationTree) -> float:
    """Bytes of the factor that one column needs: N and N1 of every front."""
    pivots, bounds = _front_sizes(tree)
    return float(16 * (pivots * bounds).sum())


def operations(tree: EliminationTree) -> float:
    """Floating-point operations of the dual elimination and inversion."""
    c, m = _front_sizes(tree)
    up = 2 * c**3 + 2 * 2 * c**3 + 3 * 2 * c**2 * m + 2 * 2 * c * m**2
    down = 3 * 2 * c * m**2 + 3 * 2 * c**2 * m
    return float((up + down).sum())


def _difference(values: np.ndarray, reference: np.ndarray, over: float | None = None) -> float:
    """Largest relative difference; of values that are 0 in both, none."""
    size = np.maximum(np.abs(reference), 1e-300) if over is None else over
    return float((np.abs(np.asarray(values, float) - reference) / size).max())


def _count(case: Case) -> str:
    return f"{len(case.arrays[0]):,}"
