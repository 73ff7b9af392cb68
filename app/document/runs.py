"""Ids of vertices or faces as runs: the first and the last of each, going up and not touching."""

import numpy as np

from bihdist_core.applications.changes import Runs, joined_runs
from bihdist_core.arrays import IntArray
from bihdist_core.errors import ParameterError


def runs_of(ids: IntArray) -> Runs:
    """Ids (k,) as runs."""
    ids = np.unique(np.asarray(ids, np.int64))
    if not len(ids):
        return ()
    breaks = np.flatnonzero(np.diff(ids) > 1)
    firsts, lasts = ids[np.append(0, breaks + 1)], ids[np.append(breaks, len(ids) - 1)]
    return tuple(zip(firsts.tolist(), lasts.tolist(), strict=True))


def ids_of(runs: Runs) -> IntArray:
    """Return the ids (k,) in runs, ascending."""
    firsts, lasts = np.array(runs, np.int64).reshape(-1, 2).T
    counts = lasts - firsts + 1
    # A scattered selection has as many runs as vertices.
    ids: IntArray = np.arange(counts.sum()) + np.repeat(firsts - np.cumsum(counts) + counts, counts)
    return ids


def runs_from_words(text: str) -> Runs:
    """Vertex ids and ranges of them, both ends included, in any order; ParameterError for other words."""
    runs: list[tuple[int, int]] = []
    for word in text.split("+"):
        ends = word.strip().split("-")
        if len(ends) > 2 or not all(end.strip().isdecimal() for end in ends):
            raise ParameterError(f"{word!r} is not a vertex id or a range of ids, such as 12 or 40-77.")
        first, last = int(ends[0]), int(ends[-1])
        if last < first:
            raise ParameterError(f"The range {word.strip()} ends before it begins.")
        runs.append((first, last))
    return joined_runs(runs)
