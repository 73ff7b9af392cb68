"""The compiled kernel: its structures and functions, as `kernel.h` has them.

`build.py` compiles it, once for every processor and once for those with AVX2 and FMA.  ctypes lets go of the
interpreter lock while a function runs.
"""

import ctypes
import os
import sys
import warnings
from contextlib import suppress
from ctypes import POINTER, Structure, c_double, c_int32, c_int64, c_uint64, c_void_p
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import AnyArray
from ..errors import Cancelled, PlainSolverWarning

DONE, STOPPED, NOT_POSITIVE, OUTSIDE, ASYMMETRIC, NO_ROOM, TOO_MUCH, LOST, MORE = 0, -1, -2, -3, -4, -5, -6, -7, 1
"""Status codes of the functions, as in `kernel.h` and `geodesic.h`."""

NONE = -1
"""No window, side or vertex."""

SINGLE, DERIVATIVE, IMAGINARY = 0, 1, 2
"""The second block of each pair of a factor: there is none, it is a derivative, or the imaginary part."""

FOLDER = Path(__file__).parent
SUFFIX = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
"""The folder of libraries, and the ending of their names."""

PLAIN = "BIHDIST_PLAIN"
"""The environment variable that, if set, leaves the compiled kernel aside."""


class Watch(Structure):
    """A flag to stop a computation, and a counter of its work."""

    _fields_ = (("stop", c_int32), ("done", c_int64))

    stop: int
    done: int


class Rows(Structure):
    """A symmetric sparse matrix, or a graph, by rows."""

    _fields_ = (("n", c_int64), ("start", c_void_p), ("index", c_void_p), ("value", c_void_p))


class Entries(Structure):
    """Entries of an inverse on a pattern, and of its second block."""

    _fields_ = (("pattern", Rows), ("value", c_void_p), ("second", c_void_p))


class Region(Structure):
    """A stretch of a graph's vertices, and of its edges."""

    _fields_ = tuple((name, c_int64) for name in ("lo", "hi", "edge", "edge_end"))

    lo: int
    hi: int


TREE_ARRAYS = {
    "vertices": np.int32,
    "place": np.int32,
    "first": np.int32,
    "children": np.int32,
    "parent": np.int32,
    "bound": np.int64,
    "rows": np.int32,
    "up": np.int32,
    "pivot_block": np.int64,
    "row_block": np.int64,
    "stack": np.int64,
    "inverse": np.int64,
    "top": np.uint8,
    "rank": np.int32,
}
"""The arrays of `Tree`, in their order."""


class Tree(Structure):
    """The elimination tree."""

    _fields_ = (("n", c_int64), ("fronts", c_int64), *((name, c_void_p) for name in TREE_ARRAYS))


class Factor(Structure):
    """The factor's blocks."""

    _fields_ = (
        ("tree", POINTER(Tree)),
        *((name, c_void_p) for name in ("areas", "pivots", "boundaries")),
        ("second", c_int64),
    )


class Mesh(Structure):
    """The mesh on which windows unfold."""

    _fields_ = (
        ("vertices", c_int64),
        ("faces", c_int64),
        *((name, c_void_p) for name in ("side", "first", "corner", "kind")),
    )

    faces: int
    vertices: int


class Places(Structure):
    """Points, or straight pieces, of faces."""

    _fields_ = (("count", c_int64), *((name, c_void_p) for name in ("face", "begin", "end")))


CELL_ARRAYS = ("points", "cell", "first", "next", "vertex_for", "edge_for", "divided", "wait", "found", "longest")
"""The arrays of `Cells`, in their order."""

CELL = np.dtype([
    ("part", float), *((name, np.int32, 3) for name in ("corner", "edge")), ("face", np.int32), ("before", np.int32),
    ("step", np.int32, 3), ("is_there", np.int32),
])  # fmt: skip
"""The parts of faces, and what has become of them where degenerate faces are taken out."""

FLAT = 16
"""Bytes of a flat face that waits, in `Cells`."""


class Cells(Structure):
    """All cells of a mesh."""

    _fields_ = (
        *((name, c_int64) for name in ("cells", "edges", "waiting", "flat", "room", "edge_room")),
        *((name, c_void_p) for name in CELL_ARRAYS),
    )

    cells: int


RUN_ARRAYS = (
    "offset", "first_target", "next_target", "reached", "queue", "heap", "window", "order", "spare", "crossing"
)  # fmt: skip
"""The arrays of `Run`, in their order."""

QUEUE, WAITING, WINDOW, CROSSING, PART, MESSAGE = 16, 16, 56, 8, 64, 56
"""Bytes of its structures."""

SIDE = np.dtype([*((name, float) for name in ("length", "x", "y")), *((name, np.int32) for name in ("vertex", "twin"))])
"""A side of a face in its own frame."""

REACHED = np.dtype([*((name, float) for name in ("distance", "px", "py")), ("rest", np.int32, 4)])
"""The way in which a vertex or a place was reached."""


class Round(Structure):
    """What the threads of a run share."""

    _fields_ = (
        *((name, c_void_p) for name in ("part", "busy", "message")),
        *((name, c_int64) for name in ("parts", "messages", "shift", "threads", "count", "used", "sent", "taken")),
        *((name, c_double) for name in ("band", "bound")),
    )

    parts: int
    messages: int
    shift: int
    threads: int
    taken: int
    band: float


class Run(Structure):
    """A run of windows from sources over a mesh, as one of its threads has it."""

    _fields_ = (
        ("mesh", POINTER(Mesh)),
        ("round", POINTER(Round)),
        ("source", Places),
        ("target", Places),
        *((name, c_void_p) for name in RUN_ARRAYS),
        *((name, c_int64) for name in ("windows", "crossings", "crossings_used")),
        *((name, c_int64) for name in ("needed", "messages_needed", "crossings_needed", "taken", "most_taken")),
        *((name, c_int64) for name in ("unused", "message", "messages_end")),
        ("radius", c_double),
        *((name, c_int32) for name in ("thread", "free", "part", "everything", "targets_only")),
        ("apart", c_int64 * 16),
    )

    source: Places
    target: Places
    windows: int
    crossings: int
    crossings_used: int
    needed: int
    messages_needed: int
    crossings_needed: int
    most_taken: int
    unused: int
    thread: int
    free: int
    radius: float
    everything: int
    targets_only: int


SEEN = 48
"""Bytes of what a vertex sees, in `Spread`."""


class Spread(Structure):
    """A front that carries virtual sources over a mesh."""

    _fields_ = (
        ("mesh", POINTER(Mesh)),
        ("points", c_void_p),
        ("source", Places),
        ("target", Places),
        *((name, c_void_p) for name in ("offset", "seen", "heap", "at_target")),
        ("radius", c_double),
        ("waiting", c_int64),
    )

    source: Places
    target: Places


_START: Any = ctypes.c_char * 0
"""The address of an array."""


class _Array:
    """An argument: a contiguous array, or None; the call keeps it while the function runs."""

    @staticmethod
    def from_param(array: AnyArray | None) -> Any:
        if array is None:
            return None
        return _START.from_buffer(array) if array.flags.writeable else c_void_p(at(array))


_P, _A, _I = c_void_p, _Array, c_int64
_SIGNATURES: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "has_avx2": (c_int32, ()),
    "dissection_room": (c_int64, (_I, _I)),
    "begin_dissection": (c_int64, (_P, _A, _A)),
    "cut": (c_int32, (_A, _P, _P)),
    "dissect": (c_int64, (_A, _P, _I, _A, _A, _P)),
    "end_dissection": (None, (_A, _A, _A)),
    "order": (c_int64, (_P, *(_A,) * 6)),
    "lay_out": (c_int64, (_P, _P, _A, _A, _I, _I, _A, _A)),
    "elimination_room": (None, (_P, _I, _I, _I, _A)),
    "eliminate": (c_int32, (_P, _P, _I, _I, _A, _A, _A, _P)),
    "inversion_room": (None, (_P, _I, _I, _A)),
    "invert": (c_int32, (_P, _I, _I, _A, _A, _A, _A, _P, _P)),
    "factor_room": (c_int64, (_P, _I, c_int32)),
    "factor": (c_int32, (_P, _P, _A, _A, _A, _A)),
    "take_rows": (None, (_P, _I, _I, _I, _I, _P, _I, _A)),
    "put_rows": (None, (_P, _I, _I, _I, _I, _A, _P, _I)),
    "distances": (_I, (_I, _I, _A, _P, _I, *(_A,) * 4, c_double, c_double, _A, _P, _I)),
    "solve": (None, (_P, _I, _I, _P, _I, _P, _I, _A, _A)),
    "sweep_up": (c_int32, (_P, _I, _I, _I, _I, _A, _A, _A, _P)),
    "sweep_down": (c_int32, (_P, _I, _I, _I, _A, _A, _P)),
    "send_units": (None, (_P, _A, _I, _I, _A, _A, _A)),
    "sweep_up_both": (None, (_P, _I, _A, _A, _A)),
    "sweep_down_both": (c_int32, (_P, _I, _I, _I, _A, _A, _A, _P)),
    "connected": (None, (_I, _I, _I, _A, _A)),
    "measures": (None, (_I, _A, _A, _A, _A)),
    "corners": (None, (_I, _A, _A, _A, _A, _A)),
    "edges": (c_int64, (_I, _I, _A, _A, _A, _A)),
    "divergence": (None, (_I, _A, _P, _I, _I, _A, _A, _A)),
    "voronoi_areas": (None, (_I, *(_A,) * 5)),
    "stiffness": (c_int64, (_I, _I, _A, _A, _A, _A, _A, _A)),
    "check_faces": (c_int32, (_I, _I, _A, _I, _A)),
    "make_delaunay": (None, (_I, _I, *(_A,) * 8)),
    "stars": (None, (_I, _I, _I, *(_A,) * 4)),
    "merge_points": (c_int64, (_I, _A, _I, _A, _A, _A)),
    "geodesic_mesh": (c_int64, (_P, _A, _A, _P, _A, _A, _A)),
    "geodesic_cells": (c_int32, (_P, _I, _I, _I)),
    "geodesic_begin": (c_int32, (_P,)),
    "geodesic_next": (c_int32, (_P,)),
    "geodesic_round": (c_int32, (_P, _P)),
    "virtual_sources": (c_int32, (_P, _P)),
    "geodesic_path": (c_int64, (_P, _I, _I, _A, _A, _A)),
    "place": (None, (_I, _A, _A, _A)),
    "nearest_faces": (None, (_I, _A, _A, _I, _I, _A, _A)),
    "add_light": (None, (_I, _A, _A, _A, _A, c_double, c_double, _I, _A, _A, _A)),
    "read_lists": (c_int32, (_P, _I, _I, _I, c_int32)),
    "read_obj": (c_int32, (_P, _A, _I)),
    "read_stl": (c_int32, (_P, _A, c_uint64, c_uint64)),
}


class _Unfit(Exception):
    """A library that cannot be used; the message is a sentence without its full stop."""


@cache
def library() -> Any:
    """Return the best library for this processor, with its functions' signatures; None without one, or if PLAIN is set.

    Without one a PlainSolverWarning says so, and why, once.
    """
    if os.environ.get(PLAIN):
        return None
    try:
        portable = _loaded("libbihdist")
    except _Unfit:
        words = f"The solver runs in NumPy, slower, and geodesics by the heat method: {why_plain()}."
        warnings.warn(words, PlainSolverWarning, stacklevel=2)
        return None
    if portable.bih_has_avx2():
        with suppress(_Unfit):
            return _loaded("libbihdist-avx2")
    return portable


def why_plain() -> str:
    """Say why the compiled kernel is not used and what to do, without a full stop; "" where it is used."""
    if os.environ.get(PLAIN):
        return f"the environment variable {PLAIN} is set"
    try:
        _loaded("libbihdist")
    except _Unfit as reason:
        has_sources = (FOLDER / "kernel.h").exists()
        return f"{reason}; " + (f"run python {FOLDER / 'build.py'}" if has_sources else "install bihdist again")
    return ""


def description() -> str:
    """Describe the kernel in use: "compiled, AVX2", "compiled", or "plain NumPy: " and the reason."""
    if why := why_plain():
        return f"plain NumPy: {why}"
    return "compiled, AVX2" if "avx2" in Path(library()._name).name else "compiled"


def _loaded(name: str) -> Any:
    """Return the library of that name; _Unfit where there is none that fits this machine and this code."""
    path = FOLDER / (name + SUFFIX)
    if not path.exists():
        raise _Unfit(f"there is no compiled kernel {path}")
    try:
        found = ctypes.CDLL(str(path))
    except OSError as error:
        raise _Unfit(f"the compiled kernel cannot be loaded ({error})") from None
    for function, (result, arguments) in _SIGNATURES.items():
        try:
            bound = getattr(found, f"bih_{function}")
        except AttributeError:
            reason = (
                f"the compiled kernel {path} was built from other sources than this program: it has no bih_{function}"
            )
            raise _Unfit(reason) from None
        bound.restype, bound.argtypes = result, arguments
    return found


def at(array: AnyArray | None) -> int | None:
    """Return the address of a contiguous array, for a structure; the array must outlive it.  TypeError if it has
    gaps."""
    if array is None:
        return None
    if array.flags.writeable:
        return ctypes.addressof(_START.from_buffer(array))  # in a fifth of the time
    if not array.flags.c_contiguous:
        raise TypeError("The kernel takes contiguous arrays only.")
    return array.ctypes.data


def rows_of(start: AnyArray, index: AnyArray, value: AnyArray | None = None) -> Rows:
    """Return a sparse matrix by rows of int32 start (n + 1,) and index (e,), float64 value (e,)."""
    return Rows(len(start) - 1, at(start), at(index), at(value))


def check_stopped(status: int) -> int:
    """Raises Cancelled where a function was told to stop."""
    if status == STOPPED:
        raise Cancelled("The work was stopped.")
    return status
