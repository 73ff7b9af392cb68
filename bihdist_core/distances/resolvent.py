"""Distances by rational functions of the Laplacian, without eigenpairs: d(i, j)^2 = K_ii + K_jj - 2 K_ij.

K = sum_k f(lambda_k) phi_k phi_k^T is a weighted sum of resolvents, of which `rational` has the weights and their
error, and `solver.resolvents` the columns and diagonals.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from ..arrays import AnyArray, FloatArray, IntArray, unit_columns
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike
from ..progress import Progress, part, steps
from .accuracy import SAFETY_FACTOR, Perturbation, change_of_root, read_alike
from .biharmonic_accuracy import UNSEEN, operator_changes, spring_changes
from .distance import FactoredDistance
from .rational import RationalFunction, Weight, fitted
from .squares import root

DIRECTIONS = 6
"""Number of random vectors that tell which edges are short."""
WORST_EDGES = 3
"""Number of edges of either kind at which the error is looked at."""
BELOW = 1e-6
"""By what fraction the first eigenvalue may be less than it was found."""
UNLUCKY = 2
"""Ratio of the error between any vertices to that between those looked at."""
CHECKING = "Checking the accuracy"
SEEN = 6
"""Ratio of the rounding that is allowed for to that found in a few columns."""


class ResolventDistance(FactoredDistance):
    """A distance with the weights f(lambda) of all eigenpairs, by a rational function close to f."""

    def __init__(self, laplacian: Laplacian | MeshLike, progress: Progress | None = None) -> None:
        self._functions: Memo[int, RationalFunction] = Memo()
        self._diagonals: Memo[int, FloatArray] = Memo()
        super().__init__(laplacian, progress=progress)

    @abstractmethod
    def _weight(self, component: Component) -> Weight:
        """The weights f of eigenvalues."""

    @abstractmethod
    def _function(self, component: Component, progress: Progress | None) -> RationalFunction:
        """A rational function that is close to them, at poles that are there."""

    def _rational(self, component: Component, progress: Progress | None = None) -> RationalFunction:
        """Return the rational function that stands for f on a component; computed once."""
        if component.index not in self._functions:
            self._functions[component.index] = self._function(component, progress)
        return self._functions[component.index]

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Factor the shifted matrices of a component, if that is not done.

        Parameters
        ----------
        component : Component
            A component of `laplacian`.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        """
        self._diagonal(component, progress)

    def _diagonal(self, component: Component, progress: Progress | None = None) -> FloatArray:
        """Return (m,) K_ii."""
        if component.index not in self._diagonals:
            function = self._rational(component, progress)
            diagonal = component.resolvents.diagonal(function.poles, function.weights)
            if function.inverse:
                diagonal += function.inverse * component.green_diagonal()
            if function.inverse_square:
                diagonal += function.inverse_square * component.biharmonic_diagonal()
            self._diagonals[component.index] = diagonal
        return self._diagonals[component.index]

    def compute_columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        diagonal, columns = self._diagonal(component), self._columns(component, index, progress)
        columns *= -2
        columns += diagonal[:, None]
        columns += diagonal[index]
        return root(columns, np.abs(diagonal).max())

    def _columns(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        """Return (m, k) the columns `index` (k,) of K."""
        function = self._rational(component)
        solved = 0.9 if function.inverse or function.inverse_square else 1.0
        columns = component.resolvents.columns(index, function.poles, function.weights, part(progress, 0, solved))
        if function.inverse:
            columns += function.inverse * component.solve(unit_columns(len(columns), index), part(progress, solved, 1))
        if function.inverse_square:
            columns += function.inverse_square * component.biharmonic_columns(index)
        return columns

    # ------------------------------------------------------------------ the accuracy
    def _estimated_accuracy(self, component: Component, progress: Progress) -> float:
        """Add up the error of the rational function, known for each pair; what cancels in the sum of three terms; and
        what rounding of the operator and of the factors does.

        They are looked at from vertices that are near to a neighbour, where squares are small, at thin faces, and far
        apart.
        """
        function, diagonal = self._bounded(component), self._diagonal(component)
        near = near_pairs(component, self._weight(component), function, part(progress, 0, 0.4))
        perturbation = Perturbation(component)
        thin, apart = [*perturbation.flattest, *perturbation.shortest], [diagonal.argmax(), diagonal.argmin()]
        vertices = np.unique([*near.ravel(), *thin, *apart, len(diagonal) // 2])
        each, green, biharmonic = np.arange(len(vertices)), component.green_diagonal(), component.biharmonic_diagonal()
        y = component.solve(unit_columns(len(green), vertices))
        columns, moved = columns_and_moves(component, function, vertices, y, part(progress, 0.4, 1))
        squares = diagonal[:, None] + diagonal[vertices] - 2 * columns
        among = columns[vertices]
        # By how much two ways to the same entries of K differ.
        rounded = max(np.abs(among[each, each] - diagonal[vertices]).max(), np.abs(among - among.T).max())
        np.maximum(squares, 0, out=squares)
        biharmonic_squares = biharmonic[:, None] + biharmonic[vertices] - 2 * component.biharmonic_columns(vertices)
        commute_time_squares = green[:, None] + green[vertices] - 2 * y
        off = function.off(squares, np.maximum(biharmonic_squares, 0), np.maximum(commute_time_squares, 0))
        off += SEEN * rounded
        off[vertices] += SAFETY_FACTOR * moved
        off[vertices, each] = squares[vertices, each] = 0
        return UNLUCKY * float(change_of_root(squares, off).max() / np.sqrt(squares.max(axis=0).min()))

    def _bounded(self, component: Component) -> RationalFunction:
        """Return the function, with bounds on all that its values may be off by."""
        return self._rational(component)


def fitted_to(
    component: Component, f: Weight, poles: Sequence[complex], scale: Weight, whole: bool = False
) -> RationalFunction:
    """Return the sum over some poles that is closest to f on a component's spectrum; `fitted` has the arguments."""
    has_infinite, (first, last), unit = bool((component.areas == 0).any()), *eigenvalue_range(component)
    found = fitted(
        lambda x: f(unit * x), first / unit, last / unit, [z / unit for z in poles],
        None if scale is f else lambda x: scale(unit * x), whole, has_infinite,
    )  # fmt: skip
    return RationalFunction(
        tuple(poles), unit * found.weights, unit * found.inverse, unit**2 * found.inverse_square, found.share,
        found.bounds * [unit**2, unit],
    )  # fmt: skip


def eigenvalue_range(component: Component) -> tuple[tuple[float, float], float]:
    """Return bounds of the finite eigenvalues besides 0, and a unit for the same digits on every scale: the power of
    two that brings the first near 1."""
    first = float(component.spectrum(1).eigenvalues[0]) * (1 - BELOW)
    return (first, component.largest_eigenvalue), 2.0 ** round(np.log2(first))


def near_pairs(component: Component, f: Weight, function: RationalFunction, progress: Progress) -> IntArray:
    """Return (k, 2) edges whose ends are near each other, or so in comparison with their commute-time distance.

    The products of a random vector with the points that stand for vertices are values of sqrt(f) of the Laplacian, and
    the mean squares of their differences estimate squared distances (Johnson and Lindenstrauss 1984).
    """
    half = fitted_to(component, lambda x: np.sqrt(f(x)), function.poles, lambda x: 1 / x, bool(function.inverse_square))
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (len(component.areas), DIRECTIONS))
    products = applied(component, half, np.sqrt(component.areas)[:, None] * signs, progress)
    edges = component.stiffness.tocoo()
    upper = (edges.row < edges.col) & (edges.data < 0)
    i, j, weight = edges.row[upper], edges.col[upper], -edges.data[upper]
    lengths = np.linalg.norm(products[i] - products[j], axis=1)
    worst = np.unique([np.argsort(lengths)[:WORST_EDGES], np.argsort(lengths * np.sqrt(weight))[:WORST_EDGES]])
    return np.stack([i[worst], j[worst]], axis=1)


def applied(component: Component, function: RationalFunction, b: FloatArray, progress: Progress) -> FloatArray:
    """Return (m, k) the function of the Laplacian, times loads b (m, k), up to constants in each column."""
    total = component.resolvents.apply(b, function.poles, function.weights, progress)
    if function.inverse or function.inverse_square:
        y = component.centred(component.solve(b - component.areas[:, None] * (b.sum(axis=0) / component.areas.sum())))
        total += function.inverse * y
        total += function.inverse_square * component.solve(component.areas[:, None] * y)
    return total


def columns_and_moves(
    component: Component, function: RationalFunction, vertices: IntArray, y: FloatArray, progress: Progress
) -> tuple[FloatArray, FloatArray]:
    """Return (m, k) the columns of K at some vertices, and (k, k) how far their squared distances are off by what
    rounding does to the operator.

    A change E of L - z A changes its inverse R by -R E R. E consists of random roundings, of the residual of each
    factor, of what the springs of degenerate faces lack, and of other coordinates that are read as the same. y (m, k)
    are the columns of G.
    """
    units, columns, changes = unit_columns(len(y), vertices), np.zeros(y.shape), np.zeros((3, *[len(vertices)] * 2))
    readings = changes_by_reading(component)

    def add(weight: complex, left: AnyArray, right: AnyArray, residual: AnyArray, pole: complex = 0) -> None:
        changed = {0: operator_changes(component, right) + residual}
        if component.flat.lack.any():
            changed[1] = spring_changes(component, right)
        for stiffness, areas in readings:
            changed[2] = UNSEEN * (stiffness @ right - pole * (areas[:, None] * right))
        for number, each in changed.items():
            changes[number] += (weight * (left.T @ each)).real

    for step, (pole, weight) in steps(progress, zip(function.poles, function.weights, strict=True)):
        step(0.0, CHECKING)
        x = component.resolvents.factor(pole).columns(vertices)
        weight = (2 if pole.imag else 1) * weight
        columns += (weight * x).real
        add(weight, x, x, component.stiffness @ x - pole * (component.areas[:, None] * x) - units, pole)
    if function.inverse or function.inverse_square:
        columns += function.inverse * y
        columns += function.inverse_square * component.biharmonic_columns(vertices)
        y = component.centred(y)
        residual = component.stiffness @ y - units
        residual[component.pin] += 1
        twice = component.centred(component.solve(component.areas[:, None] * y))
        add(function.inverse, y, y, residual)
        add(2 * function.inverse_square, twice, y, residual)
        for _, areas in readings:
            changes[2] -= UNSEEN * function.inverse_square * (y.T @ (areas[:, None] * y))
    own = changes.diagonal(axis1=1, axis2=2)
    squares = own[:, :, None] + own[:, None] - changes - changes.transpose(0, 2, 1)
    moved: FloatArray = np.abs(squares).sum(axis=0)
    return columns, moved


def changes_by_reading(component: Component) -> list[tuple[sp.csr_matrix, FloatArray]]:
    """Return by how much the stiffness matrix and the areas are others where the coordinates are, that are read as the
    same; none where that is next to nothing."""
    found = [component.operators_of(each) for each in read_alike(component, 1)]
    return [(stiffness - found[0][0], areas - found[0][1]) for stiffness, areas in found[1:]]
