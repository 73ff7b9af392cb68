"""The memory that tasks need and may take."""

import math
import sys

from bihdist_core.machine_memory import available

from ..document.sources import ALL
from .work_order import STATEMENTS, WorkOrder

BASE_BYTES = 2.5e8
BYTES_PER_VERTEX = 6e3
"""Bytes for the program, and for each vertex with its share of the factor: measured at 20,000 to 200,000 vertices,
0.2 to 0.95 GB, with some to spare."""
PART_BYTES = 2.5e8
"""A result larger than this is done in parts of no more."""
FIELD_COPIES, PAIR_COPIES = 3, 6
"""Times the bytes of a part that are there at once while it is computed, of fields and of all pairs among sources."""

FINEST = 111_000
"""Vertices of the finest mesh that the paper's experiments make of another."""


def needed(n: int, wanted: WorkOrder, from_file: int = 0) -> int:
    """Return the bytes that a mesh with n vertices and so many sources from a file takes at most."""
    counts = (wanted.sources.count, len(wanted.sources.members), from_file, 1)
    sources = n if wanted.sources.rule == ALL else max(counts)
    has_pairs = "pairs" in wanted.works and not wanted.labels
    fields = min(n * sources * 8.0, PART_BYTES) * (PAIR_COPIES if has_pairs else FIELD_COPIES)
    # Formats that are written at once are joined in memory.
    of_both = max((sources if "pairs" in wanted.works else 0), (n if "fields" in wanted.works else 0))
    whole = sources * of_both * 8.0 if wanted.layout or wanted.arrays in ("npz", "mat") else 0.0
    eigen = n * wanted.eigenpairs * 8.0 * 4 if "eigen" in wanted.works else 0.0
    if STATEMENTS in wanted.works and not wanted.quick:
        n = max(n, FINEST)
    figure = 3e8 if "figure" in wanted.works else 0.0
    return int(BASE_BYTES + n * BYTES_PER_VERTEX + max(fields, whole, eigen) + figure)


_share: int | None = None


def share(bytes_of_each: int) -> None:
    """Set the bytes that an unknown task may take in this process."""
    global _share
    _share = bytes_of_each


def allowed(is_expected: bool = False) -> float:
    """Return the bytes that a task may take: the share of a Dask worker's thread, that of this process, or all.

    With `is_expected`, room was found for it, and the memory of its worker is the only bound.
    """
    if "distributed" in sys.modules:
        from distributed import get_worker

        try:
            worker = get_worker()
        except ValueError:  # no worker runs this
            worker = None
        if worker is not None and worker.memory_manager.memory_limit:
            threads = 1 if is_expected else max(worker.state.nthreads, 1)
            return float(worker.memory_manager.memory_limit / threads)
    return math.inf if is_expected else _share or available()


def too_big(needs: int, most: int) -> str:
    """Return the sentence on a task that needs too much memory."""
    return (
        f"It needs about {needs / 1e9:.1f} GB of memory, and there are {most / 1e9:.1f} GB; "
        "run it where there is more, or ask for less of it."
    )
