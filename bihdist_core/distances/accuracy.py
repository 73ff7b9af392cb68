"""How far from exact a distance may be: an estimate from what rounding and degenerate faces can do to its operator.

With L y = e_i - e_j a change dL of the stiffness matrix changes the commute-time d(i, j)^2 by -y^T dL y, an eigenvalue
by phi^T dL phi (`biharmonic_accuracy` has the biharmonic distance).  dL consists of

- the rounding of each weight, and of each diagonal entry, which then holds on to a value instead of to a difference;
- the rounding of a face's height h, which changes all of the face's energy by a share of about eps l / h (l is its
  longest side);
- for a degenerate face what its spring lacks (see `degenerate_faces`): a share 1 - h / (FLAT_RATIO l) of its energy, to
  first order;
- the rounding of coordinates as they were read, far from the origin above all, which moves the corners of all faces at
  a vertex together: dL of a few surfaces whose coordinates are read as the same.

Roundings are as good as random, so their squares are added; the springs of degenerate faces have one sign and add up.
A residual r of a solve counts as y^T r, and what else the solver makes of it is found by computing the same distances
in another way.  All this is done for a few pairs of vertices where it is worst: at the flattest face, from there to
where the distance is largest, at the shortest edge, and where solutions are off the most (`SolveErrors`).  For all
pairs there is a bound on what cancels in G_ii + G_jj - 2 G_ij.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray, IntArray
from ..counts import counted
from ..laplacian import Component
from ..operators import face_weights
from ..solver.worker_threads import side_by_side
from ..surface import FLAT_RATIO, Surface, dots

Columns = Callable[[IntArray], FloatArray]
Effect = Callable[[int], FloatArray]

POOR_ACCURACY = 1e-3
"""What may be further off than this, as a fraction of its maximum, is warned of; what need not be is not given."""

FINEST_ACCURACY = 1e-12
"""The least an accuracy is said to be: estimates look at some pairs, and others may be rounded worse."""

EPS = float(np.finfo(float).eps)
RELATIVE_ROUNDING = 8 * EPS / 2
"""By what share a number may be rounded that went through up to eight roundings; there is some to spare."""
SAFETY_FACTOR = 6
"""By how much an error found at the places that were tried may be exceeded elsewhere; what is added up, and not as good
as random, by half as much."""
CANCELLATION_EPS = 48
"""Bound on the error of a squared commute-time distance by cancellation, in eps times the largest G_ii."""
TRIED_SPRINGS = 16
"""The number of springs of degenerate faces that are tried to find where they matter most."""
TRIED_READINGS = 5
"""The number of surfaces whose coordinates are read as the same."""
FACES_PER_BLOCK = 8192
"""Faces at a time, so that the temporary arrays stay in the processor's cache."""


@dataclass(frozen=True)
class ErrorEstimate:
    """An accuracy in words, empty where there is none, and whether it is so poor that a user should be warned.

    `share` is the accuracy as a fraction of the maximum, and `short` what a label adds where the distance is not exact.
    `sources` counts the sources from which it was measured, so that fields from others may be further off; it is None
    where the accuracy holds for all.
    """

    text: str = ""
    is_poor: bool = False
    share: float | None = None
    short: str = ""
    sources: int | None = None

    @classmethod
    def of(cls, accuracy: float, text: str = "") -> "ErrorEstimate":
        """Make the estimate for a fraction of the maximum; `text` replaces the usual words."""
        return cls(text or accurate_to(accuracy), accuracy > POOR_ACCURACY, accuracy)

    @classmethod
    def of_difference(cls, one: "ErrorEstimate", other: "ErrorEstimate") -> "ErrorEstimate":
        """Make the estimate for a difference of two fields in fractions of their maxima; empty where one is not
        known."""
        if one.share is not None and other.share is not None:
            off, text = one.share + other.share, "accurate to {} of both maxima"
            sources = min((each.sources for each in (one, other) if each.sources is not None), default=None)
            if sources is not None:
                text += f" from {counted(sources, 'vertex', 'vertices')}; from others it may be further off"
            return replace(cls.of(off, text.format(rounded_up(off))), sources=sources)
        return next((each for each in (one, other) if each.is_poor), cls())


def accurate_to(share: float) -> str:
    """Return the accuracy in words, rounded up: accurate to 2e-10 of the maximum."""
    return f"accurate to {rounded_up(share)} of the maximum"


def rounded_up(share: float) -> str:
    """Return a number rounded up to one digit: 2e-10."""
    if not 0 < share < math.inf:
        return f"{share:g}"
    exponent = math.floor(math.log10(share))
    digit = math.ceil(share / 10.0**exponent * (1 - 1e-12))
    return f"1e{exponent + 1:+03d}" if digit == 10 else f"{digit}e{exponent:+03d}"


class Perturbation:
    """The effect of dL on a component.

    Attributes
    ----------
    flattest : (3,) ndarray
        The corners of the flattest face, the one opposite to its longest side first, as local vertices.
    shortest : (2,) ndarray
        The ends of the shortest edge, as local vertices.
    """

    def __init__(self, component: Component) -> None:
        self._component = component
        self._surface: Surface = component.measured
        self._diagonal = component.stiffness.diagonal()
        self._weights, height = face_weights(self._surface), self._surface.face_heights
        self._flat = component.flat
        matrices = [component.operators_of(each)[0] for each in read_alike(component, TRIED_READINGS)]
        self._read = [other - matrices[0] for other in matrices[1:]]
        with np.errstate(divide="ignore"):
            self._uncertain = np.where(height < FLAT_RATIO, 0, 1 / height)
        if not len(height):
            # Of a matrix, the ends of its largest entry.
            entries = component.stiffness.tocoo()
            most = int(np.where(entries.row == entries.col, 0, -entries.data).argmax())
            self.shortest = np.array([entries.row[most], entries.col[most]])
            self.flattest = self.shortest[[0, 1, 1]]
            return
        # What a convention gives is no place to look for errors.
        height = height.copy()
        height[self._flat.faces[self._flat.loose]] = 1
        squares = np.stack([dots(side, side) for side in self._surface.sides()])
        flattest = int(height.argmin())
        self.flattest = np.roll(self._surface.faces[flattest], -int(squares[:, flattest].argmax()))
        k, face = divmod(int(squares.argmin()), squares.shape[1])
        self.shortest = np.roll(self._surface.faces[face], -k)[1:]

    def of(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return about the largest |y^T dL y| there can be, for the columns of y (m, k), 0 at the pinned vertex.

        (k,) by rounding and (k,) by the springs of degenerate faces.
        """
        held = self._diagonal[:, None] * y
        held *= y
        starts = range(0, len(self._surface.faces), FACES_PER_BLOCK)
        of_blocks = side_by_side(lambda start: self._rounded(y, slice(start, start + FACES_PER_BLOCK)), starts)
        squares = np.einsum("ij,ij->j", held, held) + sum(of_blocks)
        flat, spring = self._flat, np.zeros(y.shape[1])
        if len(flat.faces):
            spring += flat.lack @ flat.stretch(y) ** 2
            _, a, b = flat.vertices
            # A link, whose strength is half a height.
            links = (y[a] - y[b]) ** 2 / 2
            squares += (links[~flat.loose] ** 2).sum(axis=0)
        rounding = RELATIVE_ROUNDING * np.sqrt(squares)
        read = [np.einsum("ij,ij->j", y, change @ y) for change in self._read]
        if read:
            rounding += np.sqrt(np.mean(np.square(read), axis=0))
        return SAFETY_FACTOR * rounding, SAFETY_FACTOR / 2 * spring

    def effect_of_springs(self) -> Effect | None:
        """Return the effect of what springs lack on squared commute-time distances from a vertex to all.

        It is made of a few springs; None if none lacks anything. Where many hang at one vertex, as those of a closed
        T-junction do, or in a row, what they lack adds up; this tells between which vertices.
        """
        flat = self._flat
        lacking = np.flatnonzero(flat.lack)
        if not len(lacking):
            return None
        corners = self._surface.faces[flat.faces[lacking]]
        hub = np.bincount(corners.ravel()).argmax()
        around = lacking[(corners == hub).any(axis=1)]
        some = np.unique(np.concatenate([_spread(around), _spread(lacking)]))
        g, _ = flat.select(some).missing_springs()
        y, lack = self._component.solve(g), flat.lack[some]
        return lambda vertex: (y - y[vertex]) ** 2 @ lack

    def _rounded(self, y: FloatArray, block: slice) -> FloatArray:
        """Return (k,) sum of squares of what a block of faces can do, in units of the rounding of a number."""
        at = [y.take(corner, axis=0) for corner in self._surface.faces[block].T]
        energy, squares = np.zeros(at[0].shape), np.zeros(y.shape[1])
        for k in range(3):
            of_side = at[(k + 1) % 3] - at[(k + 2) % 3]
            of_side *= of_side
            of_side *= self._weights[k, block, None]
            energy += of_side
            squares += np.einsum("ij,ij->j", of_side, of_side)
        energy *= self._uncertain[block, None]
        total: FloatArray = squares + np.einsum("ij,ij->j", energy, energy)
        return total


def read_alike(component: Component, count: int) -> list[Surface]:
    """Return the component near the origin, and `count` surfaces whose coordinates, at random, are read as its own.

    None where distances cannot change by more than FINEST_ACCURACY.  Whole numbers and what single precision holds, as
    all of a file that is in single precision, count as exact.
    """
    surface, x = component.measured, component.measured.vertices
    with np.errstate(over="ignore", under="ignore"):
        is_exact = (x == x.astype(np.float32)) | ((x == np.rint(x)) & (np.abs(x) < 1 / EPS))
        half = np.where(is_exact, 0, np.spacing(np.abs(x)) / 2)
    # A corner that moves by some share of the face's height changes the face's energy by up to some four times that.
    heights = np.sqrt(2 * surface.face_areas * surface.face_heights)
    moved = np.linalg.norm(half, axis=1)[surface.faces].max(axis=1)
    if not (4 * moved > FINEST_ACCURACY * heights)[surface.face_heights >= FLAT_RATIO].any():
        return []
    # There, between the numbers of the file, are others.
    near, rng = x - x[0], np.random.default_rng(2)
    others = (near + half * rng.uniform(-1, 1, x.shape) for _ in range(count))
    return [Surface(each, surface.faces, surface.name) for each in (near, *others)]


def _moved_by_reading(component: Component) -> float:
    """Return by how much commute-time distances may change where coordinates are read as the same.

    L is D^T D for differences D u along the sides s of each face, weighted by 1 / (2 sqrt(area)), and d(i, j) is
    |x_i - x_j| with x_i = D G e_i.  As in `biharmonic_accuracy`, random signs r tell how far these points move: by
    G (dD^T r - dL V) with V = G D^T r.
    """
    first, *others = read_alike(component, TRIED_READINGS) or [component.measured]
    if not others:
        return 0.0
    signs = np.random.default_rng(3).choice([-1.0, 1.0], (len(others), 3, len(first.faces)))
    proper = np.flatnonzero(first.face_heights >= FLAT_RATIO)

    def loads(surface: Surface, sign: FloatArray) -> FloatArray:
        scaled = sign[:, proper] / (2 * np.sqrt(surface.face_areas[proper]))
        along = np.concatenate([dots(side[:, proper], scaled) for side in surface.sides()])
        found: FloatArray = np.bincount(surface.faces[proper].T.ravel(), along, len(surface.vertices)).astype(float)
        return found

    before = np.stack([loads(first, sign) for sign in signs], axis=1)
    products, stiffness = component.solve(before), component.operators_of(first)[0]
    changed = np.stack([loads(*each) for each in zip(others, signs, strict=True)], axis=1) - before
    for each, load, column in zip(others, changed.T, products.T, strict=True):
        load -= (component.operators_of(each)[0] - stiffness) @ column
    moves = component.centred(component.solve(changed))
    return 2 * float(np.sqrt((moves**2).mean(axis=1)).max())


def _spread(some: IntArray) -> IntArray:
    """Return at most TRIED_SPRINGS of the numbers, evenly spread."""
    return some[:: -(-len(some) // TRIED_SPRINGS)]


def change_of_root(square: FloatArray, by: FloatArray | float) -> FloatArray:
    """Bound the change of the root where a square changes by up to `by`, both at least 0."""
    root = np.sqrt(square)
    change: FloatArray = np.maximum(root - np.sqrt(np.maximum(square - by, 0)), np.sqrt(square + by) - root)
    return change


def accuracy_of_resistances(component: Component, columns: Columns, corrected: float) -> float:
    """Return the accuracy of the commute-time distance on a component (see `Distance.accuracy`).

    columns(index) gives (m, k) fields from local vertices.  Distances up to the share `corrected` of the maximum do not
    lack springs.
    """
    perturbation = Perturbation(component)
    face, edge = perturbation.flattest, perturbation.shortest
    # Of a needle the ends of the short side, each once: the spring may hold either of them.
    sources = np.array([face[0], edge[1] if edge[0] == face[0] else edge[0]])
    effect = perturbation.effect_of_springs()
    if effect is not None:
        sources = np.append(sources, effect(int(effect(int(face[0])).argmax())).argmax())
    known, (most_off, off) = len(sources), SolveErrors(component, RELATIVE_ROUNDING).at_worst()
    sources = np.append(sources, most_off)
    fields = columns(sources)
    fields[sources, np.arange(len(sources))] = 0
    tops = fields.max(axis=0)
    beside = face[1:][fields[face[1:], 0].argmin()]
    targets = [{beside, fields[:, 0].argmax()}, {edge.sum() - sources[1]}]
    if effect is not None:
        targets.append(set())
        for source, field, some in zip(sources[:known], fields.T, targets, strict=False):
            most = effect(int(source))
            some |= {most.argmax(), change_of_root(field**2, most).argmax()}
    targets.append({component.pin, int(change_of_root(fields[:, known] ** 2, off).argmax())})
    for nearest, also in zip(np.where(fields > corrected * tops, fields, np.inf).argmin(axis=0), targets, strict=True):
        also.add(nearest)
    pairs = [(column, int(t)) for column, some in enumerate(targets) for t in sorted(some) if t != sources[column]]
    column, target = np.array(pairs).T
    b, each = np.zeros((len(fields), len(pairs))), np.arange(len(pairs))
    b[sources[column], each] = 1
    b[target, each] = -1
    y = component.solve(b)
    squares = np.einsum("ij,ij->j", b, y)
    rounding, springs = perturbation.of(y)
    residual = np.abs(np.einsum("ij,ij->j", y, component.stiffness @ y - b))
    computed = fields[target, column]
    is_large = computed > corrected * tops[column]
    # Few springs are tried, and others may lack twice as much.
    by = (
        rounding
        + SAFETY_FACTOR * residual
        + np.where(is_large, 2 * springs + SAFETY_FACTOR * np.abs(computed**2 - squares), 0)
    )
    # d(i, j)^2 is the largest (g_i - g_j)^2 / g^T L g, which of g = e_i is 1 / L_ii.
    closest = 1 / component.stiffness.diagonal().max(keepdims=True)
    cancelled = change_of_root(closest, CANCELLATION_EPS * EPS * float(component.green_diagonal().max()))
    moved = _moved_by_reading(component)
    return float((change_of_root(computed**2, by).max() + cancelled[0] + moved) / tops.min())


# ---------------------------------------------------------------------- errors of solutions
RANDOM_SIDES = 2
"""Random right-hand sides."""


class SolveErrors:
    """The errors that rounding of a component's factor makes, and the vertex where they show most.

    The solver's answers are those of a matrix L + E. E is some roundings of large entries, or more where it inverts
    blocks that are nearly singular: beside springs of degenerate faces, and where a piece of little area hangs on weak
    links. The residual L y - b = -E y of any solution y tells E y, and another solve with it how far y is off. From
    random b, the vertices stand out whose rows of the inverse are off the most.

    `rounding` is that of each diagonal entry, as a fraction of it, which counts where the solver is better than that.
    """

    def __init__(self, component: Component, rounding: float) -> None:
        self._component = component
        signs = np.random.default_rng(0).choice([-1.0, 1.0], (len(component.vertices), RANDOM_SIDES + 1))
        self._tried = signs[:, :RANDOM_SIDES]
        self._rounded = rounding * component.stiffness.diagonal()[:, None] * signs[:, RANDOM_SIDES:]

    def off(self, b: FloatArray) -> FloatArray:
        """Return (m, k) about how far solutions for b (m, k) are off."""
        y = self._component.solve(b)
        return self._component.solve(self._component.stiffness @ y - b + self._rounded * y)

    def at_worst(self) -> tuple[int, FloatArray]:
        """Return the vertex where it shows most, and (m,) about how far squared commute-time distances from it may be
        off."""
        vertex = int(np.abs(self.off(self._tried)).sum(axis=1).argmax())
        b = np.zeros((len(self._tried), 1))
        b[vertex] = 1
        column = self.off(b)[:, 0]
        return vertex, np.abs(column - column[vertex])
