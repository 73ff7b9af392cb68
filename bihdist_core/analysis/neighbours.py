"""The nearest vertices by any distance, without the matrix of all distances.

A graph of them is what much of machine learning and of visualization on meshes starts from.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..progress import Progress, part, silent
from ..scalars import real_number
from .parcels import checked_mask

MEMORY = 1e8
"""Bytes that the fields of one block may take, unless another number is given."""
BYTES_PER_VALUE = 24
"""In memory, at once, for each distance of a block."""
NONE = -1
"""In the place of a neighbour that is not there."""


def nearest(
    distance: Distance,
    sources: npt.ArrayLike | Sequence[int] | None = None,
    k: int = 10,
    mask: npt.ArrayLike | None = None,
    memory: float = MEMORY,
    progress: Progress | None = None,
) -> tuple[IntArray, FloatArray]:
    """The k vertices nearest to each of s sources, nearest first, and how far they are: (s, k), (s, k).

    sources: (s,) vertices, all n if None.  A source is no neighbour of itself; of vertices at the same distance the
    one with the lower number comes first.  Only what the distance reaches is a neighbour: where the component of a
    source has fewer than k other vertices, and at vertices that belong to no face, -1 and NaN stand instead.  Of a
    distance that is not symmetric, the one from the source counts.  mask: (n,) which vertices may be neighbours.

    Costs a field for each source and holds those of a block, of so many bytes as `memory` says.  Raises VertexError for
    a source that is not there or, if it is named, belongs to no face; ParameterError for a number that is none, and a
    mask of another shape.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> ids, lengths = bihdist.nearest(distance, [0], k=3)
    >>> ids.tolist(), lengths.round(3).tolist()
    ([[1, 9, 10]], [[0.125, 0.125, 0.177]])
    """
    surface = distance.surface
    n = len(surface.vertices)
    if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or k < 1:
        raise ParameterError(f"k is {k!r}; at least one neighbour is needed, a whole number.")
    if k > n:
        raise ParameterError(f"{k:,} neighbours asked for; {surface.name} has {n:,} vertices.")
    if not real_number(memory, "The memory for a block") > 0:
        raise ParameterError(f"The memory for a block is {memory:g} bytes; it must be positive.")
    hidden = None if mask is None else ~checked_mask(surface, mask)
    if sources is None:
        ids, rows = np.flatnonzero(surface.component_of_vertex >= 0), n
        of_row = ids
    else:
        ids = surface.check_vertices(sources)
        rows = len(ids)
        of_row = np.arange(rows)
    indices, values = np.full((rows, k), NONE), np.full((rows, k), np.nan)
    step = int(np.clip(memory / (n * BYTES_PER_VALUE), 1, max(len(ids), 1)))
    for start in range(0, len(ids), step):
        (progress or silent)(start / len(ids), f"neighbours of {start:,} of {len(ids):,} vertices")
        some = ids[start : start + step]
        fields = distance.from_sources(some, part(progress, start / len(ids), (start + len(some)) / len(ids)))
        fields[some, np.arange(len(some))] = np.nan
        if hidden is not None:
            fields[hidden] = np.nan
        for row, field in zip(of_row[start : start + step], fields.T, strict=True):
            found = least(field, k)
            indices[row, : len(found)], values[row, : len(found)] = found, field[found]
    (progress or silent)(1.0, f"neighbours of {len(ids):,} vertices")
    return indices, values


def least(field: FloatArray, k: int) -> IntArray:
    """(at most k,) where a field (n,) is least, ascending; equal ones by number, what is not finite left out."""
    known = np.where(np.isfinite(field), field, np.inf)
    reach = np.partition(known, k - 1)[k - 1] if k < len(known) else np.inf
    candidates = np.flatnonzero(known <= reach)
    candidates = candidates[np.isfinite(known[candidates])]
    return candidates[np.argsort(known[candidates], kind="stable")][:k]
