"""The nearest vertices by any distance, without the matrix of all distances, and their files.

A graph of them is what much of machine learning and of visualization on meshes starts from.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..file_output import atomic_write, check_output
from ..formats.field_output import write_array
from ..progress import Progress, blocks, silent
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
    """Find the k vertices nearest to each of several sources, without the matrix of all distances.

    Parameters
    ----------
    distance : Distance
        The distance; if it is not symmetric, the one from the source counts.
    sources : (s,) array_like, optional
        Vertices; all n by default.
    k : int
        How many neighbours. A source is no neighbour of itself.
    mask : (n,) array_like, optional
        Which vertices may be neighbours, as 0 or 1; all by default.
    memory : float
        Bytes that the fields of one block may take.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    ids : (s, k) int64 ndarray
        The neighbours, nearest first; at the same distance the lower id comes first. -1 where the distance reaches
        fewer than k, and at vertices that belong to no face.
    distances : (s, k) float64 ndarray
        How far they are, NaN where there is none.

    Raises
    ------
    VertexError
        For a source that is not there or, if sources are named, belongs to no face.
    ParameterError
        For a bad `k` or `memory`, and a mask of another shape.

    Examples
    --------
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
    for report, start, some in blocks(progress, ids, step):
        report(0.0, f"neighbours of {start:,} of {len(ids):,} vertices")
        fields = distance.from_sources(some, report)
        fields[some, np.arange(len(some))] = np.nan
        if hidden is not None:
            fields[hidden] = np.nan
        for row, field in zip(of_row[start : start + step], fields.T, strict=True):
            found = least(field, k)
            indices[row, : len(found)], values[row, : len(found)] = found, field[found]
    (progress or silent)(1.0, f"neighbours of {len(ids):,} vertices")
    return indices, values


def least(field: FloatArray, k: int) -> IntArray:
    """Return at most k vertices where a field (n,) is least, ascending, then by id; only finite values count."""
    known = np.where(np.isfinite(field), field, np.inf)
    reach = np.partition(known, k - 1)[k - 1] if k < len(known) else np.inf
    candidates = np.flatnonzero(known <= reach)
    candidates = candidates[np.isfinite(known[candidates])]
    return candidates[np.argsort(known[candidates], kind="stable")][:k]


# ---------------------------------------------------------------------- files
NEIGHBOUR_FORMATS = (".csv", ".npy", ".npz", ".json")


def write_nearest(
    path: str | os.PathLike[str],
    sources: IntArray,
    indices: IntArray,
    distances: FloatArray,
    facts: Mapping[str, object],
) -> None:
    """Write the neighbours (s, k) of vertices (s,) and how far they are (s, k); the extension names the format.

    .csv: a line `i,j,distance` for each neighbour j of a vertex i, nearest first; those that are not there are left
          out. .npy: these lines as (q, 3) float64.
    .npz: `sources`, `indices` (-1 for none), `distances` (NaN for none), and the texts of `facts`.
    .json: {facts, "neighbours": [{"vertex", "indices", "distances"}, ...]}.

    Raises OutputError if the file cannot be written; what was there then stays.
    """
    extension = check_output(path, NEIGHBOUR_FORMATS)
    if not len(sources) == len(indices) == len(distances):
        raise ParameterError(f"{len(sources):,} vertices have neighbours of {len(indices):,}; they need as many.")
    is_there = indices >= 0
    if extension in (".csv", ".npy"):
        of_each = np.broadcast_to(np.asarray(sources)[:, None], indices.shape)
        table = np.column_stack([of_each[is_there], indices[is_there], distances[is_there]])
        write_array(path, table, ["i", "j", "distance"])
        return
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        if extension == ".npz":
            texts = {name: np.array(str(fact)) for name, fact in facts.items()}
            np.savez(file, **{**texts, "sources": sources, "indices": indices, "distances": distances})  # type: ignore[arg-type]
            return
        lines = ",\n".join(
            json.dumps({"vertex": vertex, "indices": found[there].tolist(), "distances": away[there].tolist()})
            for vertex, found, away, there in zip(sources.tolist(), indices, distances, is_there, strict=True)
        )
        text = json.dumps(dict(facts), indent=1, ensure_ascii=False)
        file.write(f'{text.removesuffix("}").rstrip()},\n "neighbours": [\n{lines}\n]}}\n'.encode())
