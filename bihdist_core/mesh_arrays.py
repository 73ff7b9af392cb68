"""Arrays of vertices and faces as they come from anywhere, checked and copied."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .arrays import AnyArray, FloatArray, IntArray
from .counts import counted
from .errors import MeshError
from .kernel.library import DONE, library

LARGEST, SMALLEST = 1e50, 1e-50
"""Sixth powers of longer and of shorter lengths, which some distances are made of, are beyond what a float holds."""


def checked_vertices(vertices: npt.ArrayLike, name: str) -> FloatArray:
    """Return vertices (n, 3) as a float64 copy; MeshError, which begins with `name`, for what is not."""
    _, x = _converted(vertices, np.float64, f"{name}: the vertices are not an array of numbers")
    if x.ndim != 2 or x.shape[1] != 3:
        raise MeshError(f"{name}: vertices must have shape (n, 3), not {x.shape}.")
    return x


def place_unused(x: FloatArray, faces: IntArray, name: str) -> list[str]:
    """Put vertices of no face that are NaN in the place of a vertex of the faces (m, 3), and return that in words.

    MeshError, which begins with `name`, for other coordinates that are not finite.
    """
    is_finite = np.isfinite(x)
    if is_finite.all():
        return []
    unused = np.asarray(np.isnan(x).any(axis=1))
    unused[faces] = False
    bad = np.flatnonzero(~is_finite.all(axis=1) & ~unused)
    if len(bad):
        raise MeshError(f"{name}: vertex {bad[0]} has the coordinates {_row(x[bad[0]])}; all must be finite numbers.")
    x[unused] = x[faces[0, 0]]
    what = counted(int(unused.sum()), "vertex", "vertices")
    return [f"{what} of no face and without coordinates (NaN) put in the place of vertex {faces[0, 0]}"]


def checked_faces(faces: npt.ArrayLike, n: int, name: str) -> tuple[IntArray, list[str]]:
    """Return the faces (m, 3) of n vertices that can be used, and what was dropped, in words; MeshError for bad
    ones."""
    f, whole = _converted(faces, np.int64, f"{name}: the faces are not an array of vertex ids")
    if f.size == 0:
        raise MeshError(f"{name} has no faces; a surface needs at least one triangle.")
    if f.ndim != 2 or f.shape[1] != 3:
        raise MeshError(f"{name}: faces must have shape (m, 3), not {f.shape}.")
    whole = np.ascontiguousarray(whole)
    if f.dtype.kind in "iu" and _are_proper(whole, n):
        return whole, []
    _check_range(f, whole, n, f"{name}: face")
    a, b, c = whole.T
    proper = np.flatnonzero((a != b) & (b != c) & (c != a))
    unique = _without_repeats(whole, proper)
    repairs = [
        f"{count} {'face' if count == 1 else 'faces'} {what} dropped"
        for count, what in [
            (len(f) - len(proper), "with a repeated vertex"),
            (len(proper) - len(unique), "that repeated another"),
        ]
        if count
    ]
    if not len(unique):
        raise MeshError(f"{name}: every face names a vertex twice; a surface needs at least one triangle.")
    return whole[unique], repairs


def checked_tetrahedra(tetrahedra: npt.ArrayLike, n: int, name: str) -> IntArray:
    """Return the tetrahedra (m, 4) of n vertices; MeshError for bad ones."""
    t, whole = _converted(tetrahedra, np.int64, f"{name}: the tetrahedra are not an array of vertex ids")
    if t.ndim != 2 or t.shape[1] != 4 or not len(t):
        raise MeshError(f"{name}: tetrahedra must have shape (m, 4), not {t.shape}.")
    _check_range(t, whole, n, f"{name}: tetrahedron")
    return np.ascontiguousarray(whole)


def _check_range(given: AnyArray, whole: AnyArray, n: int, what: str) -> None:
    bad = np.flatnonzero(((whole < 0) | (whole >= n) | (whole != given)).any(axis=1))
    if len(bad):
        raise MeshError(f"{what} {bad[0]} has the vertices {_row(given[bad[0]])}; ids run from 0 to {n - 1}.")


def check_size(vertices: FloatArray, faces: IntArray, name: str) -> None:
    """Check that a surface is neither too large nor too small to compute with; MeshError, which begins with `name`."""
    # All is small only where the first face is.
    if np.ptp(vertices[faces[0]], axis=0).max() < SMALLEST:
        extent = float(np.ptp(vertices[faces], axis=(0, 1)).max())
        if 0 < extent < SMALLEST:
            raise MeshError(f"{name} measures {extent:g}; below {SMALLEST:g} areas have no numbers, so scale it up.")
    if max(float(vertices.max()), -float(vertices.min())) > LARGEST:
        k, axis = np.argwhere(np.abs(vertices) > LARGEST)[0]
        raise MeshError(
            f"{name}: vertex {k} has the coordinate {vertices[k, axis]:g}; beyond {LARGEST:g} areas have no numbers, "
            "so scale it down."
        )


def _converted(values: npt.ArrayLike, dtype: npt.DTypeLike, refusal: str) -> tuple[AnyArray, AnyArray]:
    """Return a copy of an array of numbers, as it is and as another type; MeshError, with the reason, for others."""
    try:
        array = np.array(values, order="C")
        if array.dtype.kind not in "iufO":
            raise TypeError(f"their type is {array.dtype}")
        return array, array.astype(dtype, copy=False)
    except (TypeError, ValueError) as error:
        raise MeshError(f"{refusal} ({error}).") from None


def _are_proper(faces: IntArray, n: int) -> bool:
    """Return whether the kernel finds nothing wrong with the (m, 3) faces of n vertices."""
    kernel, slots = library(), 2 << len(faces).bit_length()
    return kernel is not None and kernel.bih_check_faces(n, len(faces), faces, slots, np.empty(slots, np.int32)) == DONE


def _without_repeats(faces: IntArray, some: IntArray) -> IntArray:
    """Return the numbers `some` (k,) of faces without those that repeat the three vertices of another."""
    # Repeated faces are rare.  Random numbers for the vertices, added up, tell in no time that there are none.
    random = np.random.default_rng(0).integers(1 << 62, size=int(faces.max()) + 1)
    sums = random[faces[some]].sum(axis=1)
    sums.sort()
    if (sums[1:] != sums[:-1]).all():
        return some
    return np.sort(some[np.unique(np.sort(faces[some], axis=1), axis=0, return_index=True)[1]])


def _row(values: AnyArray) -> str:
    return "(" + ", ".join(f"{v:g}" for v in values) + ")"
