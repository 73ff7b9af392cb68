"""Geodesic distance by the heat method (Crane, Weischedel, Wardetzky 2013, Algorithm 1).

I.   solve (A + t L) u = delta, a short flow of heat from the source, t = (mean edge length)^2
II.  X = -grad u / |grad u| on each face
III. solve L phi = div X; distance = phi - phi(source)

With L positive semi-definite (operators.py), (div X)_i means the integral of grad(hat_i) . X, and phi grows away from
the source.  Boundaries: Neumann conditions in both solves, which the cotangent formula gives by itself; the paper's
average with a Dirichlet flow (section 3.4) is not taken.

Far from the source u falls by about e per edge, so beyond some 700 edges it is smaller than any double and has no
gradient.  There the same flow is continued in stages.  Where u is at least FLOOR it is kept, as u1; the rest v of it
obeys (A + t L) v = delta - (A + t L) u1, a residual that lives on the rim of what is known and, being tiny, can be
scaled up before the next solve with the same matrix.  Directions do not depend on scale, so nothing is lost.
"""

from collections.abc import Callable
from ctypes import c_void_p

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..kernel.library import at, library
from ..operators import face_sides
from ..progress import Progress, silent
from ..solver.worker_threads import side_by_side
from ..surface import Surface, dots

Solve = Callable[[FloatArray], FloatArray]
FourArrays = c_void_p * 4

TOP, FLOOR = 1e100, 1e-250
"""A stage starts from heat TOP and trusts what is at least FLOOR; squares of TOP are finite, and sums for values of
FLOOR lose only terms 1e58 times smaller."""
TIME_FACTORS = (1.0, 4.0, 16.0, 64.0)
"""The times that are tried from a source, in squared mean edge lengths."""
MOST_NEGATIVE = 5e-3
"""The share of vertices with negative heat that is harmless.

Heat is positive, but on badly shaped triangles a short flow comes out negative, and where it does directions are wrong:
with 0.3 of the vertices negative, distances are half of what they are; with nearly all, a fifteenth.  A longer flow is
positive, and blurred by a few percent.  Measured against exact distances: up to here the largest errors are those of
the blur, 0.06 to 0.12 of the maximum; at 0.01 they are twice that on some meshes.
"""
FACES_PER_BLOCK = 8192
"""Faces at a time, so that the temporary arrays stay in the processor's cache: twice as fast."""


def heat_time(surface: Surface, factor: float = 1.0) -> float:
    """t = factor * (mean edge length)^2, unit length squared.  Larger factors smooth.

    On many obtuse or needle-shaped faces u turns negative and leads astray at factor 1; see `TIME_FACTORS`.

    Raises ParameterError unless the factor is a positive number.
    """
    if not (np.isfinite(factor) and factor > 0):
        raise ParameterError(f"The heat method's time factor must be a positive number, not {factor!r}.")
    return factor * surface.mean_edge_length**2


def heat_matrix(stiffness: sp.csr_matrix, areas: FloatArray, time: float) -> sp.csr_matrix:
    """Return (n, n) A + t L, the matrix of step I."""
    return (sp.diags_array(areas) + time * stiffness).tocsr()


class NegativeHeatError(SolverError):
    """The flow from this source is negative at more than a few vertices: a longer one is needed."""


class HeatGeodesic:
    """Heat-method distances on one connected surface without unreferenced vertices; it need not be manifold.

    `matrix` (n, n) is A + t L and `solve_heat(b) -> x` solves with it; `solve_poisson(b) -> x` gives any solution of
    L x = b, sum(b) = 0, such as the one that is 0 at a pinned vertex.  Both take and give (n,) float64.
    """

    def __init__(self, surface: Surface, matrix: sp.csr_matrix, solve_heat: Solve, solve_poisson: Solve) -> None:
        self.surface = surface
        self._matrix, self._solve_heat, self._solve_poisson = matrix, solve_heat, solve_poisson
        self._pattern = matrix.astype(bool)
        self._flow = _FaceFlow(surface)

    def flow(self, loads: FloatArray) -> FloatArray:
        """Return the heat (n, k) that flows from loads (n, k): the first stage of step I."""
        return self._solve_heat(loads)

    def distances(self, source: int, progress: Progress | None = None) -> FloatArray:
        """Return (n,) distances from one vertex, in the mesh's length unit; 0 at the source, never negative.

        Next to the source phi can fall below phi(source) by a part of an edge length; such values become 0.
        Raises VertexError for a bad id, SolverError if a solve gives values that are not finite, NegativeHeatError if
        heat is negative at more than MOST_NEGATIVE of the vertices.
        """
        source = self.surface.check_vertex(source)
        return self.distances_with(np.array([source]), np.ones(1), np.zeros(1), progress)

    def distances_with(
        self, vertices: IntArray, loads: FloatArray, offsets: FloatArray, progress: Progress | None = None
    ) -> FloatArray:
        """Return (n,) distances from a source that is spread over vertices (k,), with repeats, by positive loads (k,).

        `offsets` (k,) are the distances of these vertices from the source itself. phi is known up to a constant, which
        is chosen so that phi agrees with them in the mean by the loads.
        """
        report = progress or silent
        load = np.bincount(vertices, loads, len(self.surface.vertices))
        divergence = self._divergence(load / load.max(), report)
        report(0.8, "heat method, distances")
        phi = self._solve_poisson(divergence)
        distances: FloatArray = np.maximum(phi - loads @ (phi[vertices] - offsets) / loads.sum(), 0.0)
        if not np.isfinite(distances).all():
            raise SolverError(f"The heat method on {self.surface.name} gave values that are not finite numbers.")
        return distances

    def _divergence(self, load: FloatArray, report: Progress) -> FloatArray:
        """Return (n,) div X of the flow from vertices with a load (n,): steps I and II, in as many stages as u
        needs."""
        report(0.0, "heat method, flow")
        peak = int(load.argmax())
        b = load * (TOP * self._matrix[peak, peak])
        u = self._solve_heat(b)
        if not np.isfinite(u).all():
            raise SolverError(f"The heat flow on {self.surface.name} gave values that are not finite numbers.")
        negative = float((u < 0).mean())
        if negative > MOST_NEGATIVE:
            raise NegativeHeatError(
                f"The heat flow on {self.surface.name} is negative at {negative:.2g} of all vertices."
            )
        known = np.abs(u) >= FLOOR
        pending = None if known.all() else ~known[self.surface.faces].all(axis=1)
        divergence = self._flow.divergence(u, None if pending is None else np.flatnonzero(~pending))
        while pending is not None and pending.any():
            report(0.8 * float(known.mean()), "heat method, flow")
            u, b = self._enlarged(np.where(known, u, 0.0), known, load)
            v = self._solve_heat(b)
            new = ~known & (np.abs(v) >= FLOOR)
            if not new.any():
                break  # Nothing is conducted to the rest; its faces get no direction.
            u[new] = v[new]
            known |= new
            still = ~known[self.surface.faces].all(axis=1)
            divergence += self._flow.divergence(u, np.flatnonzero(pending & ~still))
            pending = still
        return divergence

    def _enlarged(self, u1: FloatArray, known: BoolArray, load: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the known part of u and its residual b = delta - (A + t L) u1, both (n,), scaled up for the next
        stage."""
        # Away from the rim the residual is 0 but for rounding, which would drown the rim's tiny values.
        rim = self._pattern @ ~known
        rim[load > 0] = False
        b = np.where(rim, -(self._matrix @ u1), 0.0)
        peak = int(np.argmax(np.abs(b)))
        smallest_normal = float(np.finfo(float).tiny)
        by, grow = max(abs(b[peak]), smallest_normal), TOP * self._matrix[peak, peak]
        # Values deep inside only have to stay finite: no face whose direction is missing has them as a corner.
        return np.clip(u1, -TOP * by, TOP * by) / by * grow, b / by * grow


class _FaceFlow:
    """Steps II and the right-hand side of step III, intrinsic to each face.

    With sides e1, e2 from corner 0 and differences d1, d2 of u along them, c = d1 e2 - d2 e1 is grad u turned by a
    right angle within the face and scaled by twice its area.  So c / |c| is X turned, and the integrals of
    grad(hat_k) . X are -e2 . c / (2 |c|) for corner 1, e1 . c / (2 |c|) for corner 2 and minus their sum for corner 0:
    no division by an area.  Of a degenerate face the direction is that of the field that its spring gives, hence with
    the spring's height; the integrals are those of the true face.
    """

    def __init__(self, surface: Surface) -> None:
        self._n, self._corners = len(surface.vertices), np.ascontiguousarray(surface.faces.T)
        _, back, self._e1 = face_sides(surface)
        self._e2 = np.negative(back, out=back)
        self._true1, self._true2 = self._e1, self._e2
        if len(surface.degenerate_faces):
            _, back, self._true1 = face_sides(surface, true=True)
            self._true2 = np.negative(back, out=back)

    def divergence(self, u: FloatArray, faces: IntArray | None = None) -> FloatArray:
        """Return (n,) div X of -grad u / |grad u| on all or some (k,) faces; a face where u is constant has X = 0."""
        lib = library()
        if lib is None:
            return self._plain_divergence(u, faces)
        m, u = self._corners.shape[1], np.ascontiguousarray(u)
        sides = FourArrays(*(at(side) for side in (self._e1, self._e2, self._true1, self._true2)))
        count = m if faces is None else len(faces)
        half = max(1, -(-count // 2))

        def one(first: int) -> FloatArray:
            part = np.zeros(self._n)
            lib.bih_divergence(m, self._corners, sides, first, min(first + half, count), faces, u, part)
            return part

        return sum(side_by_side(one, range(0, count, half)), np.zeros(self._n))

    def _plain_divergence(self, u: FloatArray, faces: IntArray | None) -> FloatArray:
        """Without the compiled kernel."""
        if faces is None:
            corners, e1, e2, true1, true2 = self._corners, self._e1, self._e2, self._true1, self._true2
        else:
            corners = self._corners[:, faces]
            e1, e2, true1, true2 = (x[:, faces] for x in (self._e1, self._e2, self._true1, self._true2))
        b = np.empty(corners.shape)
        for start in range(0, corners.shape[1], FACES_PER_BLOCK):
            part = np.s_[:, start : start + FACES_PER_BLOCK]
            at = u.take(corners[part])
            d1, d2 = at[1] - at[0], at[2] - at[0]
            # Squares of 1e-200 are 0, so each face is brought to size 1 first.
            size = np.maximum(np.abs(d1), np.abs(d2))
            size[size == 0] = 1.0
            d1 /= size
            d2 /= size
            c = d1 * e2[part]
            c -= d2 * e1[part]
            length = np.sqrt(dots(c, c))
            half = np.divide(0.5, length, out=np.zeros_like(length), where=length > 0)
            b[1, start : start + FACES_PER_BLOCK] = -half * dots(true2[part], c)
            b[2, start : start + FACES_PER_BLOCK] = half * dots(true1[part], c)
        np.add(b[1], b[2], out=b[0])
        np.negative(b[0], out=b[0])
        return np.bincount(corners.ravel(), b.ravel(), self._n).astype(float, copy=False)
