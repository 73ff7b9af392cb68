"""How far from exact a distance may be: an estimate from what rounding and degenerate faces can do to its operator.

With L y = e_i - e_j, y centred by area and z = G A y, a change dL of the stiffness matrix changes the biharmonic
d(i, j)^2 by -2 y^T dL z, the commute-time distance's by -y^T dL y, an eigenvalue by phi^T dL phi.  dL consists of

- the rounding of each weight, and of each diagonal entry, which then holds on to a value instead of to a difference;
- the rounding of a face's height h, which changes all of the face's energy by a share of about eps l / h (l is its
  longest side);
- for a degenerate face what its spring lacks (see `degenerate_faces`): a share 1 - h / (FLAT l) of its energy, to first
  order.

Roundings are as good as random, so their squares are added; the springs of degenerate faces have one sign and add up.
A residual r of a solve counts as z^T r, and what else the solver makes of it is found by computing the same distances
in another way.  All this is done for a few pairs of vertices where it is worst: at the flattest face, from there to
where the distance is largest, at the shortest edge, and where solutions are off the most (`solve_errors`).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..laplacian import Component
from ..operators import face_weights
from ..solver.worker_threads import side_by_side
from ..surface import FLAT, Surface, dots
from .solve_errors import SolveErrors

Columns = Callable[[IntArray], FloatArray]
Adjoint = Callable[[FloatArray], FloatArray]
Effect = Callable[[int], FloatArray]
Squares = Callable[[FloatArray, FloatArray], FloatArray]

POOR = 1e-3
"""What may be further off than this, as a fraction of its maximum, is warned of; what need not be is not given."""

EPS = float(np.finfo(float).eps)
ROUNDED = 8 * EPS / 2
"""By what share a number may be rounded that went through up to eight roundings; there is some to spare."""
SPARE = 6
"""By how much an error found at the places that were tried may be exceeded elsewhere; what is added up, and not as good
as random, by half as much."""
SPRINGS = 16
"""How many springs of degenerate faces are looked at to find where they matter most."""
BLOCK = 8192
"""Faces at a time, so that the temporary arrays stay in the processor's cache."""


@dataclass(frozen=True)
class ErrorEstimate:
    """An accuracy in words, empty where there is none, and whether it is so poor that a user should be warned.

    share: the accuracy, as a fraction of the maximum.  short: what a label adds, where it is no exact distance.
    """

    text: str = ""
    is_poor: bool = False
    share: float | None = None
    short: str = ""

    @classmethod
    def of(cls, accuracy: float, text: str = "") -> "ErrorEstimate":
        """Of a fraction of the maximum; text: for more to be said than that."""
        return cls(text or accurate_to(accuracy), accuracy > POOR, accuracy)

    @classmethod
    def of_difference(cls, one: "ErrorEstimate", other: "ErrorEstimate") -> "ErrorEstimate":
        """Of the difference of two fields in fractions of their maxima; empty where one is not known."""
        if one.share is not None and other.share is not None:
            off = one.share + other.share
            return cls.of(off, f"accurate to {rounded_up(off)} of both maxima")
        return next((each for each in (one, other) if each.is_poor), cls())


def accurate_to(share: float) -> str:
    """The accuracy in words, rounded up: accurate to 2e-10 of the maximum."""
    return f"accurate to {rounded_up(share)} of the maximum"


def rounded_up(share: float) -> str:
    """One digit, not less than the number: 2e-10."""
    if not 0 < share < math.inf:
        return f"{share:g}"
    exponent = math.floor(math.log10(share))
    digit = math.ceil(share / 10.0**exponent * (1 - 1e-12))
    return f"1e{exponent + 1:+03d}" if digit == 10 else f"{digit}e{exponent:+03d}"


class Perturbation:
    """What dL can do to a component.

    flattest: (3,) local vertices, the corners of a face, that opposite to its longest side first; shortest: (2,), the
    ends of an edge.
    """

    def __init__(self, component: Component) -> None:
        self._component = component
        self._surface: Surface = component.surface
        self._diagonal = component.stiffness.diagonal()
        self._weights, height = face_weights(self._surface), self._surface.face_heights
        self._flat = component.flat
        with np.errstate(divide="ignore"):
            self._uncertain = np.where(height < FLAT, 0, 1 / height)
        # What a convention gives is no place to look for errors.
        height = height.copy()
        height[self._flat.faces[self._flat.loose]] = 1
        squares = np.stack([dots(side, side) for side in self._surface.sides()])
        flattest = int(height.argmin())
        self.flattest = np.roll(self._surface.faces[flattest], -int(squares[:, flattest].argmax()))
        k, face = divmod(int(squares.argmin()), squares.shape[1])
        self.shortest = np.roll(self._surface.faces[face], -k)[1:]

    def of(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """About the largest |y^T dL z| there can be, for the columns of y and z (m, k), 0 at the pinned vertex.

        (k,) by rounding and (k,) by the springs of degenerate faces.
        """
        held = self._diagonal[:, None] * y
        held *= z
        starts = range(0, len(self._surface.faces), BLOCK)
        of_blocks = side_by_side(lambda start: self._rounded(y, z, slice(start, start + BLOCK)), starts)
        squares = np.einsum("ij,ij->j", held, held) + sum(of_blocks)
        flat, spring = self._flat, np.zeros(y.shape[1])
        if len(flat.faces):
            spring += flat.lack @ np.abs(flat.stretch(y) * flat.stretch(z))
            _, a, b = flat.vertices
            # A link, whose strength is half a height.
            links = (y[a] - y[b]) * (z[a] - z[b]) / 2
            squares += (links[~flat.loose] ** 2).sum(axis=0)
        return SPARE * ROUNDED * np.sqrt(squares), SPARE / 2 * spring

    def effect_of_springs(self, adjoint: Adjoint) -> Effect | None:
        """By how much what springs lack changes squared distances from a vertex to all, from a few springs; None if
        none lacks anything.

        Where many hang at one vertex, as those of a closed T-junction do, or in a row, what they lack adds up; this
        tells between which vertices.
        """
        flat = self._flat
        lacking = np.flatnonzero(flat.lack)
        if not len(lacking):
            return None
        corners = self._surface.faces[flat.faces[lacking]]
        hub = np.bincount(corners.ravel()).argmax()
        around = lacking[(corners == hub).any(axis=1)]
        some = np.unique(np.concatenate([_spread(around), _spread(lacking)]))
        g, _ = flat.some(some).missing_springs()
        y = self._component.solve(g)
        z, lack = adjoint(y), flat.lack[some]
        return lambda vertex: np.abs((y - y[vertex]) * (z - z[vertex])) @ lack

    def _rounded(self, y: FloatArray, z: FloatArray, block: slice) -> FloatArray:
        """(k,) sum of squares of what a block of faces can do, in units of the rounding of a number."""
        at_y, at_z = ([x.take(corner, axis=0) for corner in self._surface.faces[block].T] for x in (y, z))
        energy_y, energy_z = np.zeros((2, *at_y[0].shape))
        squares = np.zeros(y.shape[1])
        for k in range(3):
            dy, dz = (at[(k + 1) % 3] - at[(k + 2) % 3] for at in (at_y, at_z))
            by_y, by_z = dy * self._weights[k, block, None], dz * self._weights[k, block, None]
            energy_y += by_y * dy
            energy_z += by_z * dz
            by_y *= dz
            squares += np.einsum("ij,ij->j", by_y, by_y)
        energy = np.sqrt(np.maximum(energy_y, 0) * np.maximum(energy_z, 0))
        energy *= self._uncertain[block, None]
        total: FloatArray = squares + np.einsum("ij,ij->j", energy, energy)
        return total


def _spread(some: IntArray) -> IntArray:
    """A few of them, evenly."""
    return some[:: -(-len(some) // SPRINGS)]


def change_of_root(square: FloatArray, by: FloatArray) -> FloatArray:
    """How much the root changes at most where a square changes by up to `by`, both at least 0."""
    root = np.sqrt(square)
    change: FloatArray = np.maximum(root - np.sqrt(np.maximum(square - by, 0)), np.sqrt(square + by) - root)
    return change


def accuracy_of_pairs(
    component: Component, columns: Columns, squares_of: Squares, adjoint: Adjoint, times: int, corrected: float = 0.0
) -> float:
    """The accuracy (see `Distance.accuracy`) of an exact distance on a component.

    columns(index) gives (m, k) fields from local vertices.  For b (m, k), differences of two unit vectors, and y = G b
    squares_of(b, y) gives the squared distances (k,), adjoint(y) gives z (m, k); they change by so many times y^T dL z.
    Distances up to the share `corrected` of the maximum do not lack springs.
    """
    perturbation = Perturbation(component)
    face, edge = perturbation.flattest, perturbation.shortest
    # Of a needle the ends of the short side, each once: the spring may hold either of them.
    sources = np.array([face[0], edge[1] if edge[0] == face[0] else edge[0]])
    effect = perturbation.effect_of_springs(adjoint)
    if effect is not None:
        sources = np.append(sources, effect(int(effect(int(face[0])).argmax())).argmax())
    known, (most_off, off) = len(sources), SolveErrors(component, ROUNDED).at_worst(adjoint)
    sources = np.append(sources, most_off)
    fields = columns(sources)
    fields[sources, np.arange(len(sources))] = 0
    top = fields.max()
    beside = face[1:][fields[face[1:], 0].argmin()]
    targets = [{beside, fields[:, 0].argmax()}, {edge.sum() - sources[1]}]
    if effect is not None:
        targets.append(set())
        for source, field, some in zip(sources[:known], fields.T, targets, strict=False):
            most = effect(int(source))
            some |= {most.argmax(), change_of_root(field**2, most).argmax()}
    changes = change_of_root(fields[:, known:] ** 2, off)
    targets += [{component.pin, int(change.argmax())} for change in changes.T]
    if corrected:
        for nearest, also in zip(
            np.where(fields > corrected * top, fields, np.inf).argmin(axis=0), targets, strict=True
        ):
            also.add(nearest)
    pairs = [(column, int(t)) for column, some in enumerate(targets) for t in sorted(some) if t != sources[column]]
    column, target = np.array(pairs).T
    b, each = np.zeros((len(fields), len(pairs))), np.arange(len(pairs))
    b[sources[column], each] = 1
    b[target, each] = -1
    y = component.solve(b)
    squares, z = squares_of(b, y), adjoint(y)
    rounding, springs = perturbation.of(y, z)
    residual = np.abs(np.einsum("ij,ij->j", z, component.stiffness @ y - b))
    computed = fields[target, column]
    is_large = computed > corrected * top
    by = times * (rounding + SPARE * residual + np.where(is_large, springs, 0))
    found = np.where(is_large, np.abs(computed - np.sqrt(squares)), 0)
    return float((change_of_root(computed**2, by) + SPARE * found).max() / top)
