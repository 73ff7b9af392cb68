"""The resolvents (L - z A)^-1 of one component at some poles z, whose weighted sums are functions of the Laplacian.

For eigenpairs L phi_k = lambda_k A phi_k,

    sum_j c_j (L - z_j A)^-1 = sum_k r(lambda_k) phi_k phi_k^T,   r(x) = sum_j c_j / (x - z_j),

over all of them, so that a function r that is close to another one on the spectrum gives that function of the
Laplacian without any eigenpair: its columns by solves, its diagonal by selected inversion (pole expansion and selected
inversion, PEXSI: Lin, Lu, Ying, Car and E 2009).
"""

from __future__ import annotations

import threading
from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import SolverError
from ..machine_memory import available
from ..progress import Progress, part, steps, turn
from .elimination_tree import EliminationTree
from .shifted import ShiftedFactor

SHARE_KEPT = 0.5
"""The fraction of free memory that the factors which are kept may take; others are made again where they are needed."""
KEPT_SOURCES = 2
"""The number of sources whose columns are kept, so that other weights of the same columns cost next to nothing."""


class Resolvents:
    """The resolvents of a component at the poles that were asked for so far, of complex ones that above the real axis.

    Of a pair of conjugate poles the one above the axis stands for both: with weights c and its conjugate, the sum is
    twice the real part.  Usable from several threads.
    """

    def __init__(self, tree: EliminationTree, stiffness: sp.csr_matrix, areas: FloatArray, why: str) -> None:
        self._tree, self._stiffness, self._areas, self._why = tree, stiffness, areas, why
        # Two, so that columns at the poles that are there do not wait for others to be factored.
        self._lock, self._columns_lock = threading.Lock(), threading.Lock()
        self._sets: list[tuple[complex, ...]] = []
        self._factors: dict[complex, ShiftedFactor | None] = {}
        self._diagonals: dict[complex, AnyArray] = {}
        self._columns: dict[int, dict[complex, AnyArray]] = {}

    @property
    def sets(self) -> tuple[tuple[complex, ...], ...]:
        """The sets of poles that there are, as they were added."""
        return tuple(self._sets)

    @property
    def nbytes(self) -> int:
        """Bytes of factors, diagonals and columns."""
        kept = sum(factor.nbytes for factor in self._factors.values() if factor is not None)
        columns = (each.nbytes for some in self._columns.values() for each in some.values())
        return kept + sum(each.nbytes for each in self._diagonals.values()) + sum(columns)

    def add(self, poles: tuple[complex, ...], progress: Progress | None = None) -> None:
        """Factor and invert at poles that are not there yet.

        Raises SolverError where a matrix is singular to working accuracy, NotEnoughMemory where one factor has no room.
        """
        with turn(self._lock, progress, "waiting for the shifted factors"):
            # What a cancelled addition has left may serve the next.
            wanted = {*poles, *(pole for some in self._sets for pole in some)}
            for left in (self._factors, self._diagonals):
                for pole in left.keys() - wanted:
                    del left[pole]
            missing = [pole for pole in poles if pole not in self._diagonals]
            for step, pole in steps(progress, missing):
                factor = self._made(pole, step)
                self._factors[pole] = factor if factor.nbytes < SHARE_KEPT * available() else None
                self._diagonals[pole] = factor.diagonal
                del factor  # before the next is made
            if poles and poles not in self._sets:
                self._sets.append(poles)

    def release(self, poles: tuple[complex, ...]) -> None:
        """Free the factors at some poles, whose diagonals stay: factors are made again where they are needed."""
        with self._lock:
            self._factors.update(dict.fromkeys(poles))

    def _made(self, pole: complex, progress: Progress | None, inverted: bool = True) -> ShiftedFactor:
        try:
            return ShiftedFactor(self._tree, self._stiffness, self._areas, pole, progress, inverted)
        except SolverError as error:
            raise SolverError(f"The shifted Laplacian of {self._why} ({error})") from None

    def factor(self, pole: complex, progress: Progress | None = None) -> ShiftedFactor:
        """Return the factor at one of the poles, made again if there was no room to keep it."""
        return self._factors[pole] or self._made(pole, progress, inverted=False)

    def diagonal(self, poles: Sequence[complex], weights: AnyArray) -> FloatArray:
        """Return (m,) the diagonal of the sum with weights (p,)."""
        total = np.zeros(len(self._areas))
        for pole, weight in zip(poles, weights, strict=True):
            _add(total, self._diagonals[pole], pole, weight)
        return total

    def columns(
        self, index: IntArray, poles: Sequence[complex], weights: AnyArray, progress: Progress | None = None
    ) -> FloatArray:
        """Return (m, k) the columns `index` (k,) of the sum with weights (p,); those of one source are kept."""
        total = np.zeros((len(self._areas), len(index)))
        kept = self._kept(int(index[0])) if len(index) == 1 else {}
        for step, (pole, weight) in steps(progress, zip(poles, weights, strict=True)):
            column = kept.get(pole)
            if column is None:
                # Not kept in a variable: the next may need its room.
                column = self.factor(pole, part(step, 0, 0.9)).columns(index)
                if len(index) == 1:
                    kept[pole] = column
            _add(total, column, pole, weight)
        return total

    def _kept(self, source: int) -> dict[complex, AnyArray]:
        with self._columns_lock:
            kept = self._columns.pop(source, {})
            while len(self._columns) >= KEPT_SOURCES:
                del self._columns[next(iter(self._columns))]
            self._columns[source] = kept
            return kept

    def apply(
        self, b: FloatArray, poles: Sequence[complex], weights: AnyArray, progress: Progress | None = None
    ) -> FloatArray:
        """Return (m, k) the sum with weights (p,), times b (m, k)."""
        total = np.zeros(b.shape)
        for step, (pole, weight) in steps(progress, zip(poles, weights, strict=True)):
            step(0.0, "Solving")
            _add(total, self.factor(pole).solve(b), pole, weight)
        return total


def _add(total: FloatArray, values: AnyArray, pole: complex, weight: complex) -> None:
    """Add the real part of weight times values, twice for a pair of poles."""
    if pole.imag:
        total += 2 * weight.real * values.real
        total -= 2 * weight.imag * values.imag
    else:
        total += weight.real * values
