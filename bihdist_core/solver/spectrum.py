"""The smallest eigenpairs  L phi = lambda A phi  of one connected mesh, the constant left out.

They are the largest eigenpairs of T = P G A: multiply by the areas, solve with the pinned stiffness matrix, make
the area-weighted mean 0 (P).  T is symmetric in the inner product x^T A y and its eigenvalues are 1 / lambda.
A Krylov space of it is grown by a whole block of columns at a time, because a wide solve costs a fraction of
single ones and orthogonalizing by blocks is matrix multiplication.  See `krylov`.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray
from ..errors import ParameterError, SolverError
from ..progress import Progress, part, silent
from .blas import one_blas_thread
from .krylov import krylov_bytes, largest_eigenpairs, usual_columns
from .tall import centre, over_rows, own_gram, recombine, sparse_rows
from .worker_threads import WORKERS

Solve = Callable[[FloatArray], FloatArray]

ROUNDING = 10
"""Allowance, times root n, for residuals that rounding alone makes: in a regular mesh the roundings of all rows are
alike, and the solve leaves their sum in the pinned row."""

LARGE, LARGE_PRODUCT = 800, 1.5e9
"""Rows of a dense matrix whose eigenpairs take some 0.2 s, and multiplications that take as long."""


SOLVE_WORK, DENSE_WORK = 0.9, 6
"""What solving for a column costs for each byte of the factor, and a dense eigenproblem over the cube of its rows, in
multiplications of tall arrays; measured."""

PROCESS = 9e7
"""Bytes of a process that does long work aside; it has a copy of the factor, too, with its tree, COPY times as much."""
COPY = 1.3


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Eigenpairs L phi_k = lambda_k A phi_k, smallest first, without the constant.

    Attributes
    ----------
    eigenvalues : (k,) float64 ndarray
        Ascending; unit 1 / length squared.
    eigenvectors : (n, k) float64 ndarray
        One per column, phi^T A phi = 1 and A-orthogonal to each other and to constants; unit 1 / length.
    residuals : (k,) float64 ndarray
        The norm (sum_i r_i^2 / A_i)^(1/2) of r = L phi - lambda A phi, over lambda: some exact eigenvalue is within
        this fraction of lambda.  No unit; empty where they were not measured.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> laplacian = bihdist.Laplacian(pyvista.Icosphere(nsub=3))
    >>> spectrum = bihdist.eigenpairs(laplacian, 3)
    >>> phi = spectrum.eigenvectors
    >>> # orthonormal by area
    >>> abs(phi.T @ (laplacian.areas[:, None] * phi)).round(6).tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """

    eigenvalues: FloatArray
    eigenvectors: FloatArray
    residuals: FloatArray = field(default_factory=lambda: np.empty(0))


def smallest_eigenpairs(
    stiffness: sp.csr_matrix,
    areas: FloatArray,
    solve: Solve,
    count: int,
    *,
    tolerance: float = 1e-6,
    start: Spectrum | None = None,
    progress: Progress | None = None,
) -> Spectrum:
    """Compute the `count` smallest eigenpairs of a stiffness matrix whose kernel is the constants.

    Parameters
    ----------
    stiffness : (n, n) sparse matrix
        Positive semi-definite.
    areas : (n,) ndarray
        Not negative.
    solve : callable
        ``solve(b)`` returns G b for b (n,) or (n, k) as a new array; G is the inverse of the stiffness matrix without
        one vertex' row and column, padded with zeros.
    count : int
        The number of pairs.
    tolerance : float
        Bound of the residuals (see `Spectrum`), as far as rounding allows. Eigenvalues are right to about its square
        over their relative distance from the first one left out; 1e-6 keeps distances made of the pairs within 1e-7 of
        the largest, 1e-4 within 1e-5, in about a fifth less time.
    start : Spectrum, optional
        Pairs of the same operators computed before; kept if they meet the tolerance.
    progress : callable, optional
        Called as ``progress(fraction, text)``; may raise Cancelled.

    Raises
    ------
    ParameterError
        Unless there are `count` pairs.
    SolverError
        If the tolerance is not reached.
    """
    areas = np.asarray(areas, np.float64)
    _check(stiffness, areas, count, tolerance)
    # The same digits on every scale: the area is brought near 1 by a power of two.
    scale = 2.0 ** round(np.log2(areas.sum()) / 2)
    if start is not None:
        start = Spectrum(start.eigenvalues * scale * scale, start.eigenvectors * scale, start.residuals)
    found = _pairs_for_unit_area(stiffness, areas / scale / scale, solve, count, tolerance, start, progress or silent)
    vectors = np.divide(found.eigenvectors, scale, out=found.eigenvectors)
    return Spectrum(found.eigenvalues / scale / scale, vectors, found.residuals)


def _pairs_for_unit_area(
    stiffness: sp.csr_matrix,
    areas: FloatArray,
    solve: Solve,
    count: int,
    tolerance: float,
    start: Spectrum | None,
    progress: Progress,
) -> Spectrum:
    """Find the pairs of `smallest_eigenpairs` for areas that add up to about 1."""
    known = np.empty(0), np.empty((len(areas), 0))
    if start is not None and _accepted(start, stiffness, areas, tolerance):
        known = 1 / start.eigenvalues, start.eigenvectors
        if len(start.eigenvalues) >= count:
            return Spectrum(start.eigenvalues[:count], start.eigenvectors[:, :count], start.residuals[:count])

    loads = np.empty((len(areas), 0))

    def apply(x: FloatArray) -> FloatArray:
        nonlocal loads
        if loads.shape != x.shape:
            loads = np.empty(x.shape)  # used again: memory that is touched first costs more
        over_rows(lambda rows: np.multiply(areas[rows, None], x[rows], out=loads[rows]), len(x))
        y = solve(loads)
        centre(y, areas)
        return y

    def own() -> FloatArray:
        if dense_is_faster(len(areas), count):
            return _dense(areas, apply, count, part(progress, 0, 0.9))
        return largest_eigenpairs(apply, areas, count, tolerance, known, part(progress, 0, 0.95))

    for attempt in (own, lambda: _arnoldi(areas, apply, count, part(progress, 0.5, 0.95))):
        try:
            # Where numbers end, the check below says so.
            with one_blas_thread(), np.errstate(all="ignore"):
                spectrum = _refined(stiffness, areas, attempt(), part(progress, 0.95, 1))
                accepted = _accepted(spectrum, stiffness, areas, tolerance)
        except np.linalg.LinAlgError:
            continue
        if accepted:
            progress(1.0, f"{count:,} eigenpairs")
            return spectrum
    raise SolverError(
        f"The first {count:,} eigenpairs cannot be found accurately: the mesh has faces that are too long and thin, or "
        "differ too much in size. Remeshing would help; biharmonic, commute-time and geodesic distance need no "
        "eigenpairs."
    )


def dense_is_faster(n: int, count: int) -> bool:
    """Return whether all of T, as a dense matrix of n rows, costs less than a block method for `count` pairs;
    measured."""
    return n <= max(400, min(8 * count, 1500), 3 * count)


def is_long(n: int, count: int) -> bool:
    """Return whether `count` eigenpairs of n rows take steps of half a second and more, in which nobody can be asked to
    stop.

    These are eigenproblems of dense matrices, and products of bases (see `krylov`).
    """
    if dense_is_faster(n, count):
        return n > LARGE
    columns = usual_columns(count)
    return columns > LARGE or n * columns * count > LARGE_PRODUCT


def eigenpair_work(n: int, count: int, factor_bytes: int) -> float:
    """Multiplications for `count` pairs of n rows, as one core does them; what only one core does counts for all."""
    if dense_is_faster(n, count):
        return DENSE_WORK * WORKERS * float(n) ** 3
    columns = usual_columns(count)
    return SOLVE_WORK * factor_bytes * columns + n * columns * count + DENSE_WORK * WORKERS * columns**3


def eigenpair_bytes(n: int, count: int, factor_bytes: int) -> float:
    """Memory for `count` pairs of n rows, the factor's own not counted: measured up to 500,000 rows and 1,000 pairs."""
    aside = PROCESS + COPY * factor_bytes if is_long(n, count) else 0.0
    return aside + (52.0 * n * n if dense_is_faster(n, count) else krylov_bytes(n, count))


def _check(stiffness: sp.csr_matrix, areas: FloatArray, count: int, tolerance: float) -> None:
    n = len(areas)
    if stiffness.shape != (n, n):
        raise ParameterError(f"The stiffness matrix has shape {stiffness.shape}, and there are {n} areas.")
    if not (np.isfinite(areas).all() and (areas >= 0).all()):
        raise ParameterError("Each vertex area must be a finite number, not negative.")
    most = int((areas > 0).sum()) - 1
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or not 1 <= count <= most:
        raise ParameterError(f"There are {most:,} eigenpairs besides the constant; {count} asked for.")
    if not 0 < tolerance < 1:
        raise ParameterError(f"The tolerance is {tolerance:g}; it must be between 0 and 1.")


def _dense(areas: FloatArray, apply: Callable[[FloatArray], FloatArray], count: int, progress: Progress) -> FloatArray:
    """Return (n, count) eigenvectors, from all of T: exact also where `count` is all there is."""
    n = len(areas)
    root = np.sqrt(areas)
    unroot = np.divide(1, root, out=np.zeros(n), where=root > 0)
    full = np.empty((n, n))
    for first in range(0, n, 256):
        progress(0.5 * first / n, "eigenpairs: the dense operator")
        columns = np.arange(first, min(first + 256, n))
        unit = np.zeros((n, len(columns)))
        unit[columns, columns - first] = unroot[columns]
        full[:, columns] = root[:, None] * apply(_centred(unit, areas))
    progress(0.5, "eigenpairs of the dense operator")
    inverse, vectors = np.linalg.eigh((full + full.T) / 2)
    inverse, vectors = inverse[-count:], vectors[:, -count:]
    # One more application of T: dividing by small roots of areas would magnify rounding.
    eigenvectors: FloatArray = apply(_centred(unroot[:, None] * vectors[:, ::-1], areas)) / inverse[::-1]
    return eigenvectors


def _arnoldi(
    areas: FloatArray, apply: Callable[[FloatArray], FloatArray], count: int, progress: Progress
) -> FloatArray:
    """Return (n, count) eigenvectors by ARPACK: slower by far, and independent of our own iteration."""
    from scipy.sparse.linalg import ArpackError, LinearOperator, eigsh

    n = len(areas)
    root = np.sqrt(areas)
    unroot = np.divide(1, root, out=np.zeros(n), where=root > 0)
    done = 0

    def symmetric(x: FloatArray) -> FloatArray:
        nonlocal done
        done += 1
        progress(done / (done + 5 * count), "eigenpairs, second attempt")
        return root * apply(_centred((unroot * x)[:, None], areas))[:, 0]

    operator = LinearOperator((n, n), matvec=symmetric, dtype=np.float64)
    try:
        inverse, vectors = eigsh(operator, count, v0=root * np.random.default_rng(0).standard_normal(n))
    except ArpackError as error:
        raise np.linalg.LinAlgError(str(error)) from None
    eigenvectors: FloatArray = apply(_centred(unroot[:, None] * vectors, areas)) / inverse
    return eigenvectors


def _centred(x: FloatArray, areas: FloatArray) -> FloatArray:
    centred: FloatArray = x - areas @ x / areas.sum()
    return centred


def _refined(stiffness: sp.csr_matrix, areas: FloatArray, vectors: FloatArray, progress: Progress) -> Spectrum:
    """Rayleigh-Ritz in the span of the (n, k) vectors with the stiffness matrix itself, and the residuals.  The vectors
    are overwritten.
    """
    scale = 1 / np.sqrt(np.einsum("ij,i,ij->j", vectors, areas, vectors))
    progress(0.1, "eigenpairs: combining")
    mass = own_gram(vectors, areas) * scale * scale[:, None]
    images = np.empty(vectors.shape)

    def energies(rows: slice) -> Any:
        images[rows] = sparse_rows(stiffness, rows) @ vectors
        return np.dot(vectors[rows].T, images[rows])

    energy = sum(over_rows(energies, len(areas))) * scale * scale[:, None]
    progress(0.4, "eigenpairs: combining")
    # The small generalized eigenproblem, in steps for which other Python threads need not stand still.
    turn = np.linalg.inv(np.linalg.cholesky(mass)).T
    energy = turn.T @ energy @ turn
    values, mix = np.linalg.eigh((energy + energy.T) / 2)
    mix = scale[:, None] * (turn @ mix)
    (vectors,) = recombine([vectors], mix)
    progress(0.8, "eigenpairs: checking")

    def squares(rows: slice) -> FloatArray:
        r = images[rows] @ mix - areas[rows, None] * vectors[rows] * values
        return _over_areas(r * r, areas[rows])

    return Spectrum(values, vectors, np.sqrt(sum(over_rows(squares, len(areas)))) / values)


def _over_areas(squares: FloatArray, areas: FloatArray) -> FloatArray:
    """Return (k,) sums of squares (n, k) over areas; a vertex without area has no say."""
    return np.divide(1, areas, out=np.zeros(len(areas)), where=areas > 0) @ squares


def _accepted(spectrum: Spectrum, stiffness: sp.csr_matrix, areas: FloatArray, tolerance: float) -> bool:
    """Return whether the residuals are within the tolerance, or within what rounding alone makes of them."""
    values, residuals = spectrum.eigenvalues, spectrum.residuals
    if len(residuals) < len(values) or not (values > 0).all():
        return False
    late = residuals > 2 * tolerance
    if not late.any():
        return True
    # The lowest pairs dominate T, so that the rounding of theirs is in all.
    late[0] = True
    terms = abs(stiffness) @ abs(spectrum.eigenvectors[:, late])
    rounding = np.finfo(float).eps * (np.sqrt(_over_areas(terms**2, areas)) / values[late]).max()
    return bool(residuals.max() <= ROUNDING * np.sqrt(len(areas)) * rounding)
