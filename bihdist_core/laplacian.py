"""The Laplacian of a surface with what is expensive to compute about it, each computed once, when first needed.

Everything here happens on one connected component: the stiffness matrix of a component has the constants as its
only kernel.  One vertex p is pinned, and G is the inverse of the stiffness matrix without row and column p, padded
with zeros.  With a the component's area and u = G A 1,

    C = G A G - u u^T / a                          (paper, Eq. 10, without ever forming L A^-1 L)

is the Green's function of the biharmonic operator up to terms that cancel in distances.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from copy import copy

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from .arrays import FloatArray, IntArray
from .degenerate_faces import DegenerateFaces
from .errors import ParameterError, SolverError
from .expected_time import Expected, expected_seconds
from .intrinsic import COTAN, checked_operator
from .machine_memory import check_memory
from .memo import locked_cached_property
from .mesh_arrays import check_size
from .mesh_like import MeshLike, Rows
from .nodes import Matrices, Nodes, nodes_of, why_not_factored
from .operators import checked_areas, operators, operators_by_lengths
from .progress import Progress, part, turn
from .scalars import whole_number
from .solver.aside import aside
from .solver.elimination_tree import EliminationTree
from .solver.factor import Factor, share_of_ordering, usual_bytes, usual_seconds
from .solver.resolvents import Resolvents
from .solver.shifted import ShiftedFactor
from .solver.spectrum import Spectrum, eigenpair_bytes, eigenpair_work, is_long, smallest_eigenpairs
from .solver.worker_threads import WORKERS
from .surface import Surface

Computed = tuple[EliminationTree | None, Factor | None, Spectrum | None]
"""The results of a component that are kept: its tree, its factor, its eigenpairs."""

TINY = 1e-40
"""A step of which the square is nothing."""

EIGENPAIR_ADVICE = (
    "take fewer of them, simplify the mesh (bihdist perturb --simplify N), or use a larger machine or a cluster."
)
"""The message where eigenpairs need more memory than there is."""


class SurfaceOperators:
    """The stiffness matrix and the vertex areas of a surface, assembled once for its Laplacian and each component.

    Components hold this and not the Laplacian: an object that refers back to its owner is not freed, with its factor,
    before the garbage collector runs.
    """

    def __init__(self, surface: Surface, areas_kind: str, operator: str = COTAN) -> None:
        self.surface = surface
        self.areas_kind = areas_kind
        self.operator = operator

    def __reduce__(self) -> tuple[type[SurfaceOperators], tuple[Surface, str, str]]:
        return SurfaceOperators, (self.surface, self.areas_kind, self.operator)

    @locked_cached_property
    def _assembled(self) -> Matrices:
        stiffness, areas = self._assemble()
        for array in (stiffness.data, stiffness.indices, stiffness.indptr, areas):
            array.flags.writeable = False
        return stiffness, areas

    def _assemble(self) -> Matrices:
        return operators(self.surface, self.areas_kind, self.operator)

    @property
    def stiffness(self) -> sp.csr_matrix:
        """The stiffness matrix (n, n), read-only; no unit."""
        return self._assembled[0]

    @property
    def areas(self) -> FloatArray:
        """The vertex areas (n,), read-only; unit length squared."""
        return self._assembled[1]

    @locked_cached_property
    def eigenpair_counts(self) -> IntArray:
        """The number of eigenpairs of each component (c,) besides the constant, one less than vertices with an area."""
        label = self.surface.component_of_vertex[self.areas > 0]
        return np.bincount(label[label >= 0], minlength=self.surface.n_components) - 1


class GivenOperators(SurfaceOperators):
    """The matrices that a Laplacian was made of."""

    def __init__(self, nodes: Nodes, matrices: Matrices) -> None:
        super().__init__(nodes, "given")
        self._given = matrices

    def __reduce__(self) -> tuple[type[GivenOperators], tuple[Surface, Matrices]]:  # type: ignore[override]
        return GivenOperators, (self.surface, self._given)

    def _assemble(self) -> Matrices:
        return self._given


class Laplacian:
    """The Laplacian of a surface (paper, Eq. 7): its stiffness matrix, vertex areas and connected components.

    Parameters
    ----------
    surface : MeshLike
        A surface or any other mesh that `Surface.of` takes.
    areas : {"voronoi", "barycentric"}
        The vertex areas; ``"voronoi"`` are mixed Voronoi areas.
    operator : {"cotan", "intrinsic-delaunay", "tufted"}
        The triangles whose cotangents the stiffness matrix has: the faces, as in the paper; those of an intrinsic
        Delaunay triangulation, for thin faces; or of the tufted cover, for edges of more than two faces, which has
        areas of its own. The last two need the compiled kernel.

    Attributes
    ----------
    surface : Surface
        The mesh.
    operator : str
        The name of its operator.
    components : tuple of Component
        The connected components, the one with most vertices first.
    pickles_factors : bool
        Whether pickles of it, and of its distances, hold factors and eigenpairs.  By default they hold the surface
        alone, and the rest is computed again where it is needed.

    Raises
    ------
    MeshError
        If the surface is larger than 1e50 or smaller than 1e-50.
    ParameterError
        For other areas and operators.

    Notes
    -----
    Distances share factors and eigenpairs by being given the same Laplacian; nothing is cached elsewhere.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> laplacian = bihdist.Laplacian(pyvista.Icosphere(nsub=3))
    >>> biharmonic = bihdist.BiharmonicDistance(laplacian)
    >>> # with the factor that is already there
    >>> commute = bihdist.CommuteTimeDistance(laplacian)
    >>> len(laplacian.components)
    1
    >>> round(biharmonic.between(0, 1), 3)
    0.466
    >>> round(commute.between(0, 1), 3)
    1.184
    """

    pickles_factors = False

    def __init__(self, surface: MeshLike, areas: str = "voronoi", operator: str = COTAN) -> None:
        checked_areas(areas)
        known = Surface.of(surface)
        if len(known.faces):
            check_size(known.vertices, known.faces, known.name)
        self._set(SurfaceOperators(known, areas, checked_operator(operator, areas)))

    def _set(self, operators: SurfaceOperators) -> None:
        self._operators, self.surface, self.areas_kind = operators, operators.surface, operators.areas_kind
        self.operator = operators.operator
        self.components = tuple(Component(operators, k) for k in range(self.surface.n_components))

    @classmethod
    def from_matrices(
        cls,
        stiffness: sp.spmatrix,
        masses: npt.ArrayLike,
        positions: npt.ArrayLike | None = None,
        name: str = "matrix",
    ) -> Laplacian:
        """Return the Laplacian A^-1 L of any matrices: of a graph, a point cloud, tetrahedra, your own operator.

        Parameters
        ----------
        stiffness : (n, n) sparse matrix
            L: symmetric, positive semi-definite, with rows of sum 0.  Rows that are joined by entries off the diagonal
            are a component; a row without any has no distance (NaN).
        masses : (n,) array_like
            The diagonal of A, positive.
        positions : (n, 3) array_like, optional
            Where the rows are, for an order of elimination.  Without them the order is found from the entries.
        name : str
            Name for messages.

        Returns
        -------
        Laplacian
            For every distance but the geodesic one; sources are rows, and sets of rows.

        Raises
        ------
        ParameterError
            For matrices that do not fit or are not symmetric, another kernel, masses that are not positive; the message
            names the entry.

        Examples
        --------
        >>> import bihdist, numpy, scipy.sparse
        >>> ring = scipy.sparse.csgraph.laplacian(numpy.roll(numpy.eye(6), 1, axis=1), symmetrized=True)
        >>> laplacian = bihdist.Laplacian.from_matrices(ring, numpy.ones(6))
        >>> bihdist.BiharmonicDistance(laplacian).from_source(0).round(3).tolist()
        [0.0, 0.697, 1.054, 1.173, 1.054, 0.697]
        """
        laplacian = cls.__new__(cls)
        laplacian._set(GivenOperators(*nodes_of(stiffness, masses, positions, name)))
        return laplacian

    @classmethod
    def from_edge_lengths(
        cls,
        faces: npt.ArrayLike,
        lengths: npt.ArrayLike,
        areas: str = "voronoi",
        operator: str = COTAN,
        name: str = "faces",
    ) -> Laplacian:
        """Return the Laplacian of triangles of which no positions are known, but the lengths of their sides.

        Parameters
        ----------
        faces : (m, 3) array_like of int
            Vertex ids from 0 on.
        lengths : (m, 3) array_like
            The lengths of the sides, in each face that opposite to the same corner; unit length.
        areas : {"voronoi", "barycentric"}
            The vertex areas.
        operator : {"cotan", "intrinsic-delaunay"}
            As of a surface.
        name : str
            Name for messages.

        Returns
        -------
        Laplacian
            For every distance but the geodesic one; sources are vertices, and sets of vertices.

        Raises
        ------
        MeshError
            For faces that do not fit.
        ParameterError
            For a face whose sides make no triangle, an edge with two lengths, and a vertex of no face.

        Examples
        --------
        >>> import bihdist
        >>> # a square with its diagonal
        >>> flat = bihdist.Laplacian.from_edge_lengths([[0, 1, 2], [0, 2, 3]], [[1, 2**0.5, 1], [1, 1, 2**0.5]])
        >>> bihdist.BiharmonicDistance(flat).from_source(0).round(3).tolist()
        [0.0, 0.559, 0.707, 0.559]
        """
        checked_operator(operator, checked_areas(areas))
        return cls.from_matrices(*operators_by_lengths(faces, lengths, areas, operator, name), name=name)

    def __repr__(self) -> str:
        return f"Laplacian({self.surface!r}, {self.areas_kind} areas{self.operator_words})"

    @property
    def operator_words(self) -> str:
        """What labels say of the operator: nothing of the paper's.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.Laplacian(pyvista.Icosphere(nsub=1), operator="intrinsic-delaunay").operator_words
        ', intrinsic-delaunay'
        """
        return "" if self.operator == COTAN else f", {self.operator}"

    def of_faces(self) -> Laplacian:
        """Return the Laplacian by the cotangents of the faces: itself, unless it has another operator.

        Returns
        -------
        Laplacian
            With the same areas, or Voronoi areas.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> other = bihdist.Laplacian(pyvista.Icosphere(nsub=1), operator="intrinsic-delaunay")
        >>> other.of_faces()
        Laplacian(Surface(PolyData: 42 vertices, 80 faces), voronoi areas)
        """
        return self if self.operator == COTAN else Laplacian(self.surface, self.areas_kind)

    def __reduce__(self) -> tuple[Callable[..., Laplacian], tuple[object, ...]]:
        computed = tuple(component._computed for component in self.components) if self.pickles_factors else None
        return _unpickled, (self._operators, computed)

    @property
    def stiffness(self) -> sp.csr_matrix:
        """The cotangent stiffness matrix (n, n), positive semi-definite, read-only; no unit.

        Examples
        --------
        >>> import bihdist
        >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
        >>> # rows have sum 0
        >>> bihdist.Laplacian(square).stiffness.toarray().round(9).tolist()
        [[1.0, -0.5, 0.0, -0.5], [-0.5, 1.0, -0.5, 0.0], [0.0, -0.5, 1.0, -0.5], [-0.5, 0.0, -0.5, 1.0]]
        """
        return self._operators.stiffness

    @property
    def areas(self) -> FloatArray:
        """The vertex areas (n,), read-only; unit length squared.

        Examples
        --------
        >>> import bihdist
        >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
        >>> bihdist.Laplacian(square).areas.tolist()
        [0.25, 0.25, 0.25, 0.25]
        >>> bihdist.Laplacian(square, areas="barycentric").areas.round(3).tolist()
        [0.333, 0.167, 0.333, 0.167]
        """
        return self._operators.areas

    @property
    def eigenpair_counts(self) -> IntArray:
        """The number of eigenpairs of each component (c,) besides the constant, one less than vertices with an area.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=2)  # 162 vertices
        >>> bihdist.Laplacian(sphere).eigenpair_counts.tolist()
        [161]
        """
        return self._operators.eigenpair_counts

    def check_eigenpairs(self, k: int, most: int) -> None:
        """Check that there are k eigenpairs besides the constant.

        Parameters
        ----------
        k : int
            The number that is wanted.
        most : int
            The number there is.

        Raises
        ------
        ParameterError
            If there are not; the message says what is possible.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> laplacian = bihdist.Laplacian(pyvista.Icosphere(nsub=1))
        >>> try:
        ...     laplacian.check_eigenpairs(100, most=41)
        ... except bihdist.ParameterError as error:
        ...     print(error)
        PolyData has 41 eigenpairs besides the constant, and k is 100; choose k from 1 to 41.
        """
        if not 1 <= whole_number(k, "k") <= most:
            name = self.surface.name
            raise ParameterError(
                f"{name} has {most:,} eigenpairs besides the constant, and k is {k:,}; choose k from 1 to {most:,}."
            )

    def component_of(self, vertex: int) -> Component:
        """Return the component that a vertex belongs to.

        Parameters
        ----------
        vertex : int
            A vertex id.

        Returns
        -------
        Component
            One of `components`.

        Raises
        ------
        VertexError
            If the vertex is not on the surface, or belongs to no face.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> both = pyvista.Icosphere(nsub=1) + pyvista.Icosphere(nsub=2, center=(3, 0, 0))
        >>> laplacian = bihdist.Laplacian(both)
        >>> laplacian.component_of(0).index, len(laplacian.component_of(0).vertices)
        (1, 42)
        """
        index: int = self.surface.component_of_vertex[self.surface.check_vertex(vertex)]
        return self.components[index]


class Component:
    """One connected component, in its own vertex numbering: local vertex k is `vertices[k]` of the surface.

    Safe to use from several threads; a cancelled computation leaves nothing behind and can be asked for again.
    """

    pin = 0

    def __init__(self, whole: SurfaceOperators, index: int) -> None:
        self._whole = whole
        self.index = index
        # Two locks, so that a click is answered from the factor while eigenpairs are being computed.
        self._factor_lock = threading.RLock()
        self._spectrum_lock = threading.Lock()
        self._tree: EliminationTree | None = None
        self._factor: Factor | None = None
        self._spectrum: Spectrum | None = None

    def __reduce__(self) -> tuple[type[Component], tuple[SurfaceOperators, int]]:
        return Component, (self._whole, self.index)

    @property
    def _computed(self) -> Computed:
        with self._factor_lock, self._spectrum_lock:
            return self._tree, self._factor, self._spectrum

    @_computed.setter
    def _computed(self, computed: Computed) -> None:
        self._tree, self._factor, self._spectrum = computed

    @locked_cached_property
    def _cut(self) -> tuple[Surface, IntArray]:
        surface, ids = self._whole.surface.component(self.index)
        if len(surface.faces):
            check_size(surface.vertices, surface.faces, surface.name)
        return surface, ids

    @property
    def surface(self) -> Surface:
        """The component alone."""
        return self._cut[0]

    @property
    def vertices(self) -> IntArray:
        """The vertices' ids (m,) in the whole surface, ascending."""
        return self._cut[1]

    def local(self, vertices: IntArray) -> IntArray:
        """Return local numbers of ids that belong to this component."""
        return np.searchsorted(self.vertices, vertices)

    @locked_cached_property
    def stiffness(self) -> sp.csr_matrix:
        """The stiffness matrix (m, m)."""
        whole = self._whole.stiffness
        return whole if len(self.vertices) == whole.shape[0] else whole[self.vertices][:, self.vertices]

    @locked_cached_property
    def measured(self) -> Surface:
        """The component with the faces that the operator is made of, none if it has others."""
        if self._whole.operator == COTAN:
            return self.surface
        alone = np.zeros(len(self.vertices), np.int64)
        return Nodes(self.surface.vertices, name=self.surface.name, component_of_vertex=alone)

    @locked_cached_property
    def flat(self) -> DegenerateFaces:
        """The degenerate faces that the operator is made of."""
        return DegenerateFaces.of(self.measured)

    @locked_cached_property
    def areas(self) -> FloatArray:
        """The vertex areas (m,), unit length squared."""
        return self._whole.areas[self.vertices]

    def operators_of(self, surface: Surface) -> tuple[sp.csr_matrix, FloatArray]:
        """Return the stiffness matrix and the areas of another surface, of the same kind."""
        return operators(surface, self._whole.areas_kind)

    # ------------------------------------------------------------------ the factor
    def tree(self, progress: Progress | None = None) -> EliminationTree:
        """Return the elimination order, which serves every matrix with the pattern of the stiffness matrix."""
        with turn(self._factor_lock, progress, "waiting for the factor"):
            if self._tree is None:
                self._tree = EliminationTree(self.stiffness, self.surface.vertices, progress=progress)
            return self._tree

    def factor(self, progress: Progress | None = None, diagonals: bool = False) -> Factor:
        """Return the factor of the pinned stiffness matrix; with the diagonals of G and G A G if asked for.

        The pinned vertex stays in the matrix as an equation of its own, x_p = 0, and gets no area: then the
        entries of G and G A G elsewhere are the ones wanted.
        """
        have = self._factor
        if have is not None and (have.has_diagonals or not diagonals):
            return have
        with turn(self._factor_lock, progress, "waiting for the factor"):
            if self._factor is None or (diagonals and not self._factor.has_diagonals):
                ordered = share_of_ordering(len(self.vertices), diagonals)
                tree = self.tree(part(progress, 0, ordered))
                areas = self.areas.copy()
                areas[self.pin] = 0
                matrix = _pinned(self.stiffness, self.pin)
                try:
                    self._factor = Factor(tree, matrix, areas if diagonals else None, part(progress, ordered, 1))
                except SolverError as error:
                    raise SolverError(f"The Laplacian of {why_not_factored(self.surface)} ({error})") from None
            return self._factor

    def solve(self, b: FloatArray, progress: Progress | None = None) -> FloatArray:
        """G b; b (m,) or (m, k)."""
        return _solved(self.factor(progress), self.pin, b, progress)

    def centred(self, x: FloatArray) -> FloatArray:
        """x (m,) or (m, k) less its mean by area."""
        centred: FloatArray = x - self.areas @ x / self.areas.sum()
        return centred

    # ------------------------------------------------------------------ Green's functions
    def green_diagonal(self, progress: Progress | None = None) -> FloatArray:
        """Return (m,) G_jj; no unit."""
        diagonal = self.factor(progress, diagonals=True).diagonal.copy()
        diagonal[self.pin] = 0
        return diagonal

    def biharmonic_diagonal(self, progress: Progress | None = None) -> FloatArray:
        """Return (m,) C_jj; unit length squared."""
        self.factor(progress, diagonals=True)
        return self._biharmonic_diagonal

    @locked_cached_property
    def _biharmonic_diagonal(self) -> FloatArray:
        diagonal: FloatArray = self.factor(diagonals=True).sandwich_diagonal - self.u**2 / self.areas.sum()
        return diagonal

    def biharmonic_columns(self, index: IntArray) -> FloatArray:
        """Return (m, k) the columns `index` (k,) of C; unit length squared."""
        columns = self.factor(diagonals=True).sandwich_columns(index)
        columns -= self.u[:, None] * (self.u[index] / self.areas.sum())
        return columns

    @locked_cached_property
    def edges(self) -> tuple[IntArray, IntArray]:
        """The ends i < j (e,) of the entries of the stiffness matrix."""
        rows = np.repeat(np.arange(len(self.areas)), np.diff(self.stiffness.indptr))
        upper = rows < self.stiffness.indices
        return rows[upper], self.stiffness.indices[upper].astype(np.int64)

    def commute_time_squares(self) -> FloatArray:
        """Return (e,) G_ii + G_jj - 2 G_ij at all `edges`; no unit."""
        matrix = _pinned(self.stiffness, self.pin)
        return self._squares(Factor(self.tree(), matrix).inverse_entries(matrix))

    def biharmonic_squares(self) -> FloatArray:
        """Return (e,) C_ii + C_jj - 2 C_ij at all `edges`; unit length squared.

        G A G is the derivative of the inverse along A, minus the imaginary part where a tiny multiple of i A was added,
        to all digits (Squire and Trapp 1998).
        """
        matrix, areas, (i, j) = _pinned(self.stiffness, self.pin), self.areas.copy(), self.edges
        areas[self.pin] = 0
        step = TINY / float(np.abs(self.u).max())
        factor = ShiftedFactor(self.tree(), matrix, areas, -1j * step, inverted=False)
        squares = self._squares(factor.inverse_entries(matrix).imag / -step)
        squares -= (self.u[i] - self.u[j]) ** 2 / self.areas.sum()
        return squares

    def _squares(self, entries: FloatArray) -> FloatArray:
        """Return (e,) g_ii + g_jj - 2 g_ij for the entries of a matrix g with the pattern of the pinned one."""
        rows, columns = np.repeat(np.arange(len(self.areas)), np.diff(self.stiffness.indptr)), self.stiffness.indices
        i, j = self.edges
        entries = np.where((rows == self.pin) | (columns == self.pin), 0, entries)
        diagonal, upper = entries[rows == columns], entries[rows < columns]
        squares: FloatArray = diagonal[i] + diagonal[j] - 2 * upper
        return squares

    @locked_cached_property
    def biharmonic_eccentricity(self) -> FloatArray:
        """The root (m,) of the mean, by area, of the squared biharmonic distances to all points; unit length.

        It is largest at the tips of a shape.  With y = C A 1, the mean of C_ii + C_jj - 2 C_ij over j.
        """
        diagonal, areas, u = self.biharmonic_diagonal(), self.areas, self.u
        total = areas.sum()
        y = self.solve(areas * u) - u * (areas @ u / total)
        squares = diagonal + (areas @ diagonal - 2 * y) / total
        roots: FloatArray = np.sqrt(np.maximum(squares, 0))
        return roots

    @locked_cached_property
    def u(self) -> FloatArray:
        """The column u = G A 1 (m,), by which C = G A G - u u^T / sum(A) is without a mean; unit length squared."""
        return self.solve(self.areas)

    @locked_cached_property
    def resolvents(self) -> Resolvents:
        """The inverses of L - z A at the poles z that distances asked for."""
        return Resolvents(self.tree(), self.stiffness, self.areas, why_not_factored(self.surface))

    # ------------------------------------------------------------------ the spectrum
    @property
    def most_eigenpairs(self) -> int:
        """The number of eigenpairs besides the constant (`Laplacian.eigenpair_counts`)."""
        return int(self._whole.eigenpair_counts[self.index])

    @property
    def eigenpairs_there(self) -> int:
        """The number of eigenpairs that have been computed."""
        return 0 if self._spectrum is None else len(self._spectrum.eigenvalues)

    @locked_cached_property
    def largest_eigenvalue(self) -> float:
        """A bound on the largest finite eigenvalue by Gershgorin's circles; unit 1 / length squared."""
        areas, rows = self.areas, np.asarray(np.abs(self.stiffness).sum(axis=1)).ravel()
        return float((rows[areas > 0] / areas[areas > 0]).max())

    def check_room_for(self, count: int) -> None:
        """Before long work: NotEnoughMemory where so many eigenpairs have no room, with the factor if there is none."""
        n, factor, have = len(self.areas), self._factor, self._spectrum
        if have is None or len(have.eigenvalues) < count:
            size = usual_bytes(n) if factor is None else factor.nbytes
            needed = eigenpair_bytes(n, min(count, self.most_eigenpairs), size) + (size if factor is None else 0)
            check_memory(needed, f"Finding {count:,} eigenpairs of {n:,} vertices", EIGENPAIR_ADVICE)

    def share_of_factor(self, count: int) -> float:
        """Return which share of the time that the factor, with its diagonals, and so many eigenpairs take is the
        factor's."""
        n = len(self.areas)
        if self._factor is not None and self._factor.has_diagonals:
            return 0.0
        factor = usual_seconds(n, True)
        return factor / (factor + expected_seconds("eigenpairs", eigenpair_work(n, count, usual_bytes(n)), WORKERS))

    def spectrum(self, count: int, progress: Progress | None = None) -> Spectrum:
        """At least the first `count` eigenpairs (of at most `most_eigenpairs`); grown and kept."""
        count = min(count, self.most_eigenpairs)
        have = self._spectrum
        if have is not None and len(have.eigenvalues) >= count:
            return have
        with turn(self._spectrum_lock, progress, "waiting for eigenpairs"):
            have = self._spectrum
            if have is not None and len(have.eigenvalues) >= count:
                return have
            factored = 0.0 if self._factor is not None else 0.1
            factor, n = self.factor(part(progress, 0, factored)), len(self.areas)
            given = factor, self.pin, self.stiffness, self.areas, count, have
            self.check_room_for(count)
            work = eigenpair_work(n, count, factor.nbytes)
            try:
                with Expected("eigenpairs", work, WORKERS, part(progress, factored, 1)) as it:
                    if is_long(n, count):
                        self._spectrum = aside(_spectrum, *given, progress=it.progress)
                    else:
                        self._spectrum = _spectrum(*given, progress=it.progress)
            except SolverError as error:
                raise SolverError(f"{self.surface.name}: {error}") from None
            return self._spectrum


def _unpickled(operators: SurfaceOperators, computed: tuple[Computed, ...] | None) -> Laplacian:
    laplacian = Laplacian.__new__(Laplacian)
    laplacian._set(operators)
    if computed is not None:
        laplacian.pickles_factors = True
        for component, its in zip(laplacian.components, computed, strict=True):
            component._computed = its
    return laplacian


def _spectrum(
    factor: Factor,
    pin: int,
    stiffness: sp.csr_matrix,
    areas: FloatArray,
    count: int,
    start: Spectrum | None,
    progress: Progress,
) -> Spectrum:
    """Return the first `count` eigenpairs of a component, by the factor of its pinned stiffness matrix."""
    return smallest_eigenpairs(
        stiffness, areas, lambda b: _solved(factor, pin, b), count, start=start, progress=progress
    )


def _solved(factor: Factor, pin: int, b: FloatArray, progress: Progress | None = None) -> FloatArray:
    """G b by the factor of the pinned matrix."""
    x = factor.solve(b, progress)
    # The pinned vertex' equation is one of its own: x_p = b_p.
    x[pin] = 0
    return x


def eigenpairs(laplacian: Laplacian | MeshLike, count: int, progress: Progress | None = None) -> Spectrum:
    """Compute the first eigenpairs L phi = lambda A phi, phi^T A phi = 1, without the constant of each component.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian.
    count : int
        The number of eigenpairs.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    eigenvalues : (count,) float64 ndarray
        Ascending; unit 1 / length squared.
    eigenvectors : (n, count) float64 ndarray
        One per column, 0 at vertices that belong to no face; unit 1 / length.

    Raises
    ------
    ParameterError
        If there are not that many.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> spectrum = bihdist.eigenpairs(pyvista.Icosphere(nsub=3), 8)
    >>> # of the unit sphere: 2 three times, then 6 five times
    >>> spectrum.eigenvalues.round(2).tolist()
    [2.0, 2.0, 2.0, 5.97, 5.97, 5.97, 5.97, 5.97]
    """
    laplacian = as_laplacian(laplacian)
    components = laplacian.components
    laplacian.check_eigenpairs(count, int(laplacian.eigenpair_counts.sum()))
    spectra = [
        c.spectrum(count, part(progress, k / len(components), (k + 1) / len(components)))
        for k, c in enumerate(components)
    ]
    values = np.concatenate([s.eigenvalues[:count] for s in spectra])
    owner = np.concatenate([np.full(min(count, len(s.eigenvalues)), k) for k, s in enumerate(spectra)])
    column = np.concatenate([np.arange(min(count, len(s.eigenvalues))) for s in spectra])
    first = np.argsort(values, kind="stable")[:count]
    vectors = np.zeros((len(laplacian.areas), count))
    for k, component in enumerate(components):
        mine = np.flatnonzero(owner[first] == k)
        vectors[np.ix_(component.vertices, mine)] = spectra[k].eigenvectors[:, column[first[mine]]]
    return Spectrum(values[first], vectors)


def as_laplacian(laplacian: Laplacian | MeshLike | Rows, faces: npt.ArrayLike | None = None) -> Laplacian:
    """Return a Laplacian, or that of a mesh of any kind with the default vertex areas."""
    return laplacian if isinstance(laplacian, Laplacian) else Laplacian(Surface.of(laplacian, faces))


def _pinned(matrix: sp.csr_matrix, pin: int) -> sp.csr_matrix:
    """Return the symmetric matrix with row and column `pin` replaced by the identity's; it shares the pattern's
    arrays."""
    start, index, value = matrix.indptr, matrix.indices, matrix.data.copy()
    value[index == pin] = 0
    row = slice(start[pin], start[pin + 1])
    value[row] = index[row] == pin
    pinned = copy(matrix)
    pinned.data = value
    return pinned
