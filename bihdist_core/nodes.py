"""What the rows of a matrix stand for, where that is no triangle mesh: the nodes of a graph, points, tetrahedra's
corners."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from .arrays import BoolArray, FloatArray, IntArray, real_numbers
from .errors import ParameterError
from .sparse_inverse import ROUNDING, checked_symmetric
from .surface import Surface, connected, ranked_components

Matrices = tuple[sp.csr_matrix, FloatArray]
"""The stiffness matrix (n, n) and the masses (n,)."""


@dataclass(frozen=True, eq=False, repr=False)
class Nodes(Surface):
    """The nodes of a graph, or points: a surface without faces, whose components are those of a matrix.

    Attributes
    ----------
    vertices : (n, 3) ndarray
        Positions, all 0 where there are none.
    component_of_vertex : (n,) ndarray
        The component of each, the largest first; -1 for one that is joined to no other.
    """

    nouns: ClassVar[tuple[str, str]] = ("node", "nodes")

    faces: IntArray = field(default_factory=lambda: np.empty((0, 3), np.int64))
    component_of_vertex: IntArray = field(default_factory=lambda: np.empty(0, np.int64))

    def __post_init__(self) -> None:
        for array in (self.vertices, self.faces, self.component_of_vertex):
            array.flags.writeable = False

    def __repr__(self) -> str:
        return f"Nodes({self.name}: {len(self.vertices):,} nodes)"

    def component(self, index: int) -> tuple[Nodes, IntArray]:
        ids = np.flatnonzero(self.component_of_vertex == index)
        if len(ids) == len(self.vertices):
            return self, ids
        return Nodes(self.vertices[ids], name=self.name, component_of_vertex=np.zeros(len(ids), np.int64)), ids

    @property
    def nonmanifold_vertices(self) -> IntArray:
        return np.empty(0, np.int64)

    @property
    def genus(self) -> None:
        return None

    @cached_property
    def in_proper_face(self) -> BoolArray:
        return self.component_of_vertex >= 0

    def _without_distances(self, vertex: int) -> str:
        return f"node {vertex} is joined to no other, so no distance is defined from it."


def why_not_factored(surface: Surface) -> str:
    """Return why a Laplacian cannot be factored, and what would help, in a sentence without its subject."""
    if not len(surface.faces):
        return f"{surface.name} cannot be factored: its entries differ too much in size."
    return (
        f"{surface.name} cannot be factored: its faces are too thin, or differ too much in size. Remeshing would help."
    )


def nodes_of(
    stiffness: sp.spmatrix, masses: npt.ArrayLike, positions: npt.ArrayLike | None, name: str
) -> tuple[Nodes, Matrices]:
    """Return the nodes of a Laplacian and its matrices, checked.

    Raises ParameterError, which names entries that do not fit, and what they should be.
    """
    matrix = checked_symmetric(stiffness, f"{name}: the stiffness matrix")
    n = matrix.shape[0]
    weights = real_numbers(masses, "Masses")
    if weights.shape != (n,):
        raise ParameterError(f"{name}: {n:,} rows have as many masses, not an array of shape {weights.shape}.")
    wrong = np.flatnonzero(~((weights > 0) & np.isfinite(weights)))
    if len(wrong):
        raise ParameterError(f"{name}: masses are positive, and that of row {wrong[0]} is {weights[wrong[0]]:g}.")
    label = _checked_kernel(matrix, name)
    places = np.zeros((n, 3)) if positions is None else real_numbers(positions, "Positions").copy()
    if places.shape != (n, 3) or not np.isfinite(places).all():
        raise ParameterError(f"{name}: positions of {n:,} rows are (n, 3) finite numbers, not {places.shape}.")
    for array in (matrix.data, matrix.indices, matrix.indptr):
        array.flags.writeable = False
    weights = weights.copy()
    weights.flags.writeable = False
    return Nodes(places, name=name, component_of_vertex=label), (matrix, weights)


def _checked_kernel(matrix: sp.csr_matrix, name: str) -> IntArray:
    """Return the components; ParameterError for another kernel than constants on each."""
    n, diagonal = matrix.shape[0], matrix.diagonal()
    if (diagonal < 0).any():
        i = int(diagonal.argmin())
        raise ParameterError(
            f"{name}: a stiffness matrix is positive semi-definite, and the diagonal entry of row {i} is "
            f"{diagonal[i]:g}; with the other sign it might be one."
        )
    sums = np.abs(np.asarray(matrix.sum(axis=1)).ravel())
    if (sums > n**0.5 * ROUNDING * diagonal).any():
        i = int((sums / np.where(diagonal > 0, diagonal, 1)).argmax())
        raise ParameterError(
            f"{name}: the rows of a stiffness matrix have the sum 0, so that constants are its kernel, and that of row "
            f"{i} is {sums[i]:g}."
        )
    rows = np.repeat(np.arange(n), np.diff(matrix.indptr))
    joined = (rows < matrix.indices) & (matrix.data != 0)
    if not joined.any():
        raise ParameterError(f"{name}: no entry joins two rows, so there is no distance.")
    label = connected(np.stack([rows[joined], matrix.indices[joined]]).astype(np.int64), n)
    return ranked_components(label, diagonal > 0)


def spread(matrices: Matrices, ids: IntArray, n: int) -> Matrices:
    """Return matrices of n rows, of which `ids` (k,) are those given, and others are empty."""
    if len(ids) == n:
        return matrices
    there = sp.csr_matrix((np.ones(len(ids)), (ids, np.arange(len(ids)))), shape=(n, len(ids)))
    return sp.csr_matrix(there @ matrices[0] @ there.T), there @ matrices[1]
