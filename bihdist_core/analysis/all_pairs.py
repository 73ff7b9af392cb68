"""Distances between all pairs of vertices, in a file: too many for memory, so they are computed and written in
blocks of rows, and an interrupted computation is taken up where it ended.

What is done stands in a file beside the result, whose name is made from all that the numbers depend on: the surface,
the distance, the number type.  So what is found there is the beginning of the same array, and its length tells how
much of it.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

import numpy as np
import numpy.typing as npt

from ..arrays import AnyArray, IntArray
from ..distances.distance import Distance
from ..errors import OutputError, ParameterError
from ..file_output import check_output
from ..machine_memory import check_memory
from ..progress import Progress, silent

MEMORY = 5e8
"""Bytes that the arrays of one block may take, unless another number is given."""
BYTES_PER_VALUE = 40
"""In memory, at once, for each distance of a block: the fields, what they are made from, and their rounded copy."""
Rows = Callable[[Sequence[IntArray]], Iterator[AnyArray]]
"""From blocks of vertices, each (k,), to the rows (k, n) of each in turn, which are used before the next are made."""

REMEDY = "use smaller blocks (--memory), a larger machine or a cluster."


@dataclass(frozen=True)
class Begun:
    """The file that an interrupted computation has left, its size in bytes, and how many of the n rows it holds."""

    path: Path
    bytes: int
    rows: int
    n: int


def begun(distance: Distance, path: str | os.PathLike[str], dtype: npt.DTypeLike = np.float32) -> Begun | None:
    """Find the unfinished work from which `write_all_pairs` would resume with these arguments, if any."""
    dtype, n = np.dtype(dtype), len(distance.surface.vertices)
    partial = _partial_path(distance, Path(os.path.realpath(path)), dtype)
    rows = _rows_done(partial, _header(n, dtype), n * dtype.itemsize)
    return Begun(partial, partial.stat().st_size, rows, n) if rows > 0 else None


def left_by_others(distance: Distance, path: str | os.PathLike[str], dtype: npt.DTypeLike = np.float32) -> list[Path]:
    """Return the files that interrupted computations of other numbers have left beside this path."""
    target = Path(os.path.realpath(path))
    mine = _partial_path(distance, target, np.dtype(dtype))
    name = re.compile(rf"\.{re.escape(target.stem[:60])}-[0-9a-f]{{16}}\.npy\.part")
    return sorted(p for p in target.parent.iterdir() if name.fullmatch(p.name) and p != mine)


def write_all_pairs(
    distance: Distance,
    path: str | os.PathLike[str],
    dtype: npt.DTypeLike = np.float32,
    memory: float = MEMORY,
    progress: Progress | None = None,
    fresh: bool = False,
    compute: Rows | None = None,
) -> None:
    """Write the (n, n) array of all distances as .npy; NaN in the rows and columns of vertices that have none.

    Parameters
    ----------
    distance : Distance
        The distance.
    path : str or path-like
        The .npy file.
    dtype : str
        "float32" or "float64".
    memory : float
        Bytes for the arrays of a block, besides what the distance itself holds; at least one row is computed at a time.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    fresh : bool
        Compute all rows anew. Otherwise a call after an interruption, `Cancelled` included, computes only the rows that
        are missing; `begun` tells which are there.
    compute : callable, optional
        Called with blocks of vertices, to yield the rows of each in turn, which `fill_rows` may have made elsewhere.

    Raises
    ------
    OutputError
        If the file cannot be written or the disk is too small for it.
    NotEnoughMemory
        If there is no memory for a block.
    """
    dtype = np.dtype(dtype)
    if dtype not in (np.float32, np.float64):
        raise ParameterError(f"Distances are written as float32 or float64, not as {dtype}.")
    if not memory > 0:
        raise ParameterError(f"The memory for a block is {memory:g} bytes; it must be positive.")
    check_output(path, (".npy",))
    report = progress or silent
    target = Path(os.path.realpath(path))
    n = len(distance.surface.vertices)
    unfinished = _partial_path(distance, target, dtype)
    header = _header(n, dtype)
    row_bytes = n * dtype.itemsize
    rows = _rows_of_block(n, memory)

    def reached(row: float) -> None:
        report(row / n, f"all pairs: {int(row):,} of {n:,} vertices")

    try:
        check_block(n, memory)
        done = 0 if fresh else _rows_done(unfinished, header, row_bytes)
        _check_space(target, len(header) + n * row_bytes, unfinished.stat().st_size if unfinished.exists() else 0)
        with _alone(unfinished, target) as file:
            # A row that was cut off is written again.
            file.truncate(len(header) + done * row_bytes if done else 0)
            file.seek(0, os.SEEK_END)
            if not done:
                file.write(header)
            blocks = [np.arange(start, min(start + rows, n)) for start in range(done, n, rows)]
            reached(done)
            for block in (compute or partial(_compute_here, distance, dtype, reached))(blocks):
                # Not `tofile`, which does not notice that the disk is full.
                file.write(block.data)
                file.flush()
                done += len(block)
                reached(done)
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{path} could not be written: {error.strerror or error}.") from error


def check_block(n: int, memory: float = MEMORY) -> None:
    """Raise NotEnoughMemory if there is no memory for a block of the pairs of n vertices, of so many bytes."""
    rows = _rows_of_block(n, memory)
    check_memory(rows * n * BYTES_PER_VALUE, f"A block of {rows:,} x {n:,} distances", REMEDY)


def _rows_of_block(n: int, memory: float) -> int:
    return int(np.clip(memory / (n * BYTES_PER_VALUE), 1, n))


def _compute_here(
    distance: Distance, dtype: np.dtype, reached: Callable[[float], None], blocks: Sequence[IntArray]
) -> Iterator[AnyArray]:
    """Yield the rows of each block, all in the same memory."""
    room = np.empty((max(map(len, blocks), default=0), len(distance.surface.vertices)), dtype)
    for ids in blocks:
        start, rows = int(ids[0]), room[: len(ids)]
        fill_rows(rows, distance, ids, partial(_within, reached, start, len(ids)))
        yield rows


def _within(reached: Callable[[float], None], start: int, count: int, fraction: float, _text: str) -> None:
    reached(start + fraction * count)


def fill_rows(rows: AnyArray, distance: Distance, ids: IntArray, progress: Progress | None = None) -> None:
    """Write distances from k vertices into rows (k, n)."""
    used = distance.surface.component_of_vertex[ids] >= 0
    if used.all():
        distance.from_sources(ids, progress=progress, out=rows.T)
    else:
        rows[~used] = np.nan
        rows[used] = distance.from_sources(ids[used], progress=progress, dtype=rows.dtype).T


@contextmanager
def _alone(partial: Path, target: Path) -> Iterator[BinaryIO]:
    """Open the unfinished file for writing, and rename it to the target when the block ends well.

    Raises OutputError while another process has it.
    """
    is_posix = os.name == "posix"
    with open(os.open(partial, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o666), "r+b") as file:
        if is_posix:
            _lock(file, partial, target)
        yield file
        if is_posix:
            os.replace(partial, target)  # before another can have it
    if not is_posix:
        os.replace(partial, target)  # no file is moved there that is open


def _lock(file: BinaryIO, partial: Path, target: Path) -> None:
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        # Between the opening and the lock another may have ended, and its file be in its place.
        is_ours = partial.exists() and os.path.samestat(os.fstat(file.fileno()), partial.stat())
    except BlockingIOError:
        is_ours = False
    except OSError:
        is_ours = True  # a file system without locks
    if not is_ours:
        raise OutputError(f"{target} is being written by another run; wait for it, or choose another name.")


def _header(n: int, dtype: np.dtype) -> bytes:
    """Return the header of an .npy file."""
    file = BytesIO()
    facts = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": (n, n)}
    np.lib.format.write_array_header_1_0(file, facts)
    return file.getvalue()


def _partial_path(distance: Distance, target: Path, dtype: np.dtype) -> Path:
    """Return the path of the rows until all are there."""
    digest = hashlib.sha256()
    laplacian, surface = distance.laplacian, distance.surface
    # A label rounds its numbers; a spec does not, nor do the distance's own plain attributes where there is none.
    own = sorted((key, value) for key, value in vars(distance).items() if isinstance(value, (int, float, str)))
    kind = laplacian.areas_kind + laplacian.operator_words
    for text in (distance.label, distance.identity or repr(own), kind, dtype.str, target.name):
        digest.update(text.encode() + b"\0")
    for array in (surface.vertices, surface.faces):
        digest.update(array.tobytes())
    return target.with_name(f".{target.stem[:60]}-{digest.hexdigest()[:16]}.npy.part")


def _rows_done(partial: Path, header: bytes, row_bytes: int) -> int:
    """Count the whole rows that an earlier call has left."""
    if not partial.exists():
        return 0
    with partial.open("rb") as file:
        if file.read(len(header)) != header:
            return 0
    return (partial.stat().st_size - len(header)) // row_bytes


def _check_space(target: Path, needed: int, present: int) -> None:
    free = shutil.disk_usage(target.parent).free
    if needed - present > free:
        raise OutputError(
            f"{target} cannot be written: it needs {(needed - present) / 1e9:.2f} GB more, "
            f"and its disk has {free / 1e9:.2f} GB left."
        )
