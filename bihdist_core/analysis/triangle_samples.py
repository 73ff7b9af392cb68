"""Random triangles of vertices against the triangle inequality."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..distances.distance import Distance
from ..errors import ParameterError
from ..progress import Progress, part
from ..scalars import whole_number
from .diagnostics import TriangleSample, triangle_violations

TRIANGLE_POINTS, TRIANGLE_STEP = 40, 8
"""Points of a sample of triangles, and how many at a time become part of it."""


def triangle_sample(
    distance: Distance,
    points: int = TRIANGLE_POINTS,
    component: int = 0,
    count: int = 100_000,
    seed: int = 0,
    progress: Progress | None = None,
) -> TriangleSample:
    """Hold random triples of random vertices of a component against the triangle inequality.

    Parameters
    ----------
    distance : Distance
        The distance; it is asked for all pairs of the vertices.
    points : int
        How many vertices, at least three; all that there are if these are fewer.
    component : int
        The component of the surface.
    count : int
        How many triples.
    seed : int
        Seed of the random numbers.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    TriangleSample
        How many triples break it by more than rounding, and by how much.

    Raises
    ------
    ParameterError
        For fewer than three points, and for a component that does not exist or has fewer than three vertices.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
    >>> sample = bihdist.triangle_sample(distance, points=20, count=1000)
    >>> sample.triples, sample.violations, sample.tightest > 0
    (1000, 0, True)
    """
    *_, (_, last) = triangle_samples(distance, points, component, count, seed, progress)
    return last


def triangle_samples(
    distance: Distance,
    points: int = TRIANGLE_POINTS,
    component: int = 0,
    count: int = 100_000,
    seed: int = 0,
    progress: Progress | None = None,
) -> Iterator[tuple[int, TriangleSample]]:
    """Hold ever more vertices against the triangle inequality, 8 at a time, so that early results can be shown.

    Parameters
    ----------
    distance : Distance
        The distance; it is asked for all pairs of the vertices.
    points : int
        How many vertices in the end, at least three; all that there are if these are fewer.
    component : int
        The component of the surface.
    count : int
        How many triples.
    seed : int
        Seed of the random numbers.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Yields
    ------
    points : int
        How many vertices so far.
    sample : TriangleSample
        What `triangle_sample` finds among them.

    Raises
    ------
    ParameterError
        For fewer than three points, and for a component that does not exist or has fewer than three vertices.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> distance = bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3))
    >>> for points, sample in bihdist.triangle_samples(distance, points=20, count=1000):
    ...     print(points, sample.violations)
    8 0
    16 0
    20 0
    """
    ids = (
        np.flatnonzero(distance.surface.component_of_vertex == component)
        if whole_number(component, "A component") >= 0
        else np.empty(0, np.int64)
    )
    if min(whole_number(points, "The number of points"), len(ids)) < 3:
        raise ParameterError(
            f"Triangles need three points; {points:,} were asked for, and component {component} has {len(ids):,} "
            "vertices."
        )
    some = np.random.default_rng(seed).choice(ids, min(points, len(ids)), replace=False)
    among = np.zeros((len(some), len(some)))
    # No step of one or two points.
    ends = [*range(TRIANGLE_STEP, len(some) - 2, TRIANGLE_STEP), len(some)]
    for start, stop in zip([0, *ends], ends, strict=False):
        rows, columns = np.tril_indices(stop, -1)
        new = rows >= start
        rows, columns = rows[new], columns[new]
        step = part(progress, start / len(some), stop / len(some))
        pairs = np.stack([some[rows], some[columns]], 1)
        among[rows, columns] = among[columns, rows] = distance.of_pairs(pairs, step)
        yield stop, triangle_violations(among[:stop, :stop], count, seed)
