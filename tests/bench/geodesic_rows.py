"""Row 27: exact and approximate geodesic distances, and paths, against pygeodesic's and potpourri3d's heat method."""

import time
from collections.abc import Iterator
from functools import cache

import numpy as np

from bihdist_core import GeodesicDistance, Surface
from bihdist_core.analysis.geodesic_paths import GeodesicPaths
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.solver.worker_threads import WORKERS, without_workers

from . import peers
from .case import difference
from .child import forget_peak, in_child, peak_memory
from .meshes import Arrays, bumpy_sphere
from .size import Size
from .table import Line, compared
from .timing import alternate, timed

ROW = 27
EXACT = 1e-9
"""Of the largest distance: pygeodesic drops windows shorter than about 1e-10 of an edge."""

SOME = 4
"""Sources that pygeodesic is timed from, in place of all."""


def exact_geodesics(size: Size) -> Iterator[Line]:
    small, middle = (_smooth(count) for count in size.geodesic)
    if peers.is_installed("pygeodesic"):
        for mesh, bound in ((small, 0.2), (middle, 0.12)):
            result = alternate(lambda mesh=mesh: _ours(mesh), lambda mesh=mesh: peers.exact_geodesic(mesh, [0])[0], 1)
            yield compared(
                ROW,
                f"exact geodesic, set-up and one source, {len(mesh[0]):,}",
                result,
                bound=bound,
                error=difference(result.answer, result.peer_answer),
                tolerance=EXACT,
                note="peer: pygeodesic",
            )
        yield _many(small, size)
    else:
        yield Line(ROW, "exact geodesic, one source and many", bound=0.2, note="skipped: pygeodesic is not installed")
    rough = _rough(size.main)
    result = alternate(lambda: _ours(rough), lambda: peers.heat_solver(*rough).compute_distance(0), size.rounds)
    yield compared(
        ROW,
        f"exact geodesic, set-up and one source, as scanned, {len(rough[0]):,}",
        result,
        bound=1.0,
        note="peer: potpourri3d, heat solver constructed and one heat solve",
    )
    yield from _approximate(rough, size)
    yield from _growth(size)
    yield _threads(_smooth(size.geodesic_growth[-1]))
    yield _path(middle, size)


def _many(mesh: Arrays, size: Size) -> Line:
    """From many sources, against as many times what pygeodesic takes for one."""
    sources = np.random.default_rng(1).choice(len(mesh[0]), size.sources, replace=False)
    distance = GeodesicDistance(Surface(*mesh), "exact")
    result = alternate(
        lambda: distance.from_sources(sources), lambda: peers.exact_geodesic(mesh, sources[:SOME].tolist()), 1
    )
    times = len(sources) / SOME
    return Line(
        ROW,
        f"exact geodesic, {len(sources)} sources, {len(mesh[0]):,}",
        result.our_time,
        result.peer_time * times,
        result.ratio / times,
        result.effort / times,
        bound=0.15,
        error=difference(result.answer[:, :SOME], np.stack(result.peer_answer, 1)),
        tolerance=EXACT,
        note=f"peer: as many times what pygeodesic takes for each of {SOME}",
    )


def _approximate(mesh: Arrays, size: Size) -> Iterator[Line]:
    """One field without a set-up, and its error."""
    result = alternate(
        lambda: GeodesicDistance(Surface(*mesh), "virtual-sources").from_source(0),
        lambda: peers.heat_solver(*mesh).compute_distance(0),
        size.rounds,
    )
    name = f"approximate geodesic, set-up and one source, as scanned, {len(mesh[0]):,}"
    note = "peer: potpourri3d, heat solver constructed and one heat solve"
    yield compared(ROW, name, result, bound=0.2, note=note)
    exact = _ours(mesh)
    heat, virtual = (np.abs(each - exact)[1:] / exact[1:] for each in (result.peer_answer, result.answer))
    yield Line(
        ROW,
        f"approximate geodesic: off in the mean, in %, as scanned, {len(mesh[0]):,}",
        value=100 * float(virtual.mean()),
        bound=0.5,
        note=f"the heat method of potpourri3d {heat.mean():.1%}",
    )


def _growth(size: Size) -> Iterator[Line]:
    for name, make, bound in (("as scanned", _rough, 1.3), ("smooth", _smooth, 1.6)):
        counts = size.geodesic_growth
        seconds, bytes_each = zip(*(in_child(_grow, make, count) for count in counts), strict=True)
        yield Line(
            ROW,
            f"exact geodesic: time grows like n^p, {name}, {counts[0]:,} to {counts[-1]:,}",
            value=np.polyfit(np.log(counts), np.log(seconds), 1)[0],
            bound=bound,
            note=", ".join(f"{each:.2f} s" for each in seconds),
        )
        yield Line(
            ROW,
            f"exact geodesic: memory in kB a vertex, {name}, {counts[-1]:,}",
            value=bytes_each[-1] / 1e3,
            bound=1.0,
        )


def _threads(mesh: Arrays) -> Line:
    """One source on all cores, against one thread."""
    solver = ExactGeodesic(Surface(*mesh))

    def alone() -> np.ndarray:
        with without_workers():
            return solver.distances(0)

    result = alternate(lambda: solver.distances(0), alone, 1)
    return compared(
        ROW,
        f"exact geodesic, one source on {WORKERS} threads, {len(mesh[0]):,}",
        result,
        bound=0.6,
        error=difference(result.answer, result.peer_answer),
        tolerance=0,
        note="peer: our own on one thread",
    )


def _grow(make, count: int) -> tuple[float, float]:
    """The processor's seconds of a set-up with one source, and the bytes a vertex that it takes beside the surface."""
    surface = Surface(*make(count))
    _ = surface.component_of_vertex, surface.edges
    forget_peak()
    before, begun = peak_memory(), time.process_time()
    ExactGeodesic(surface).distances(0)
    seconds = time.process_time() - begun
    return seconds, (peak_memory() - before) / len(surface.vertices)


def _path(mesh: Arrays, size: Size) -> Line:
    """A path between two places once the field of one is there."""
    surface = Surface(*mesh)
    field = ExactGeodesic(surface).field(0)
    ends = np.random.default_rng(2).choice(len(mesh[0]), 50, replace=False).tolist()
    seconds = [timed(lambda end=end: field.path(end))[0] for end in ends]
    longest = max(ends, key=lambda end: field.distances[end])
    length = GeodesicPaths(surface).path([longest, 0]).length
    return Line(
        ROW,
        f"exact geodesic: a path after its field in ms, {len(mesh[0]):,}",
        value=1e3 * float(np.median(seconds)),
        bound=1.0,
        error=abs(length / field.distances[longest] - 1),
        tolerance=EXACT,
        note="error: the length of the longest against the field",
    )


def _ours(mesh: Arrays) -> np.ndarray:
    return ExactGeodesic(Surface(*mesh)).distances(0)


@cache
def _smooth(count: int) -> Arrays:
    return bumpy_sphere(count)


@cache
def _rough(count: int) -> Arrays:
    """As a scanner makes it: off by a tenth of an edge."""
    x, faces = bumpy_sphere(count)
    edge = np.linalg.norm(x[faces[:, 0]] - x[faces[:, 1]], axis=1).mean()
    return x + 0.1 * edge * np.random.default_rng(3).standard_normal(x.shape), faces
