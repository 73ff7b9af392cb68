"""Bounds on the rounding errors of biharmonic fields.

Two errors are estimated and added.

Cancellation.  Rounding changes C_ii, C_jj and C_ij by some eps H, where H is the largest diagonal entry of G A G.  So
d^2 = C_ii + C_jj - 2 C_ij changes by some eps H and d by that over 2 d, which is most where d is least.  Distances
below `recomputed_below` are computed again as pairs; the least of the others is bounded from below.  As d(i, j) is the
maximum of (g_i - g_j) / |A^(-1/2) L g| over all functions g, no vertex is closer to i than

    1 / |A^(-1/2) L e_i|.

The operator.  Vertex i has the point x_i = A^(1/2) G e_i, centred by area, and d(i, j) = |x_i - x_j|.  A change E of L
moves the point by -A^(1/2) G E G e_i, and a distance changes by no more than both of its points move.  The products of
a vector r with all points, V = G A^(1/2) r with r centred, cost one solve, those with all moves, -G E V, another.  Over
a few r of random signs their mean squares estimate squared lengths (Johnson and Lindenstrauss 1984).  E consists of

- the rounding of each diagonal entry of L, and of the weights of thin faces: of about eps l / h for a longest side l
  and a height h;
- the error of the factor, which the residual L V - A^(1/2) r tells;
- what the springs of degenerate faces lack (see `degenerate_faces`), all with one sign.

The coordinates.  Those that are read as the same have other L and A; x_i then moves by A^(1/2) G (dA^(1/2) A^(-1/2) -
dL) G e_i, of which a few samples tell the largest.  That bound has much to spare.
"""

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import AnyArray, FloatArray, IntArray
from ..laplacian import Component
from ..operators import face_weights
from ..surface import FLAT_RATIO
from .accuracy import EPS, RELATIVE_ROUNDING, SAFETY_FACTOR, change_of_root, read_alike

USUAL = 48
"""Bound on the error of a squared distance, in eps H, unless more is found; from 3 to 20 is usual."""
SEEN = 6
"""Ratio of that bound to the error found in a few columns."""
TARGET, NEAR, MOST_NEAR = 1e-9, 1e-5, 31
"""Distances that are computed again: those that cancellation may change by more than the first number, or that are less
than the second, as fractions of the maximum.  The third is how many of a field are at most: with its source, as many as
are solved for together."""
TRIED = 5
"""Number of vectors of random signs."""
UNSEEN = 2
"""Ratio of how far coordinates as they were read may move a point to the most that was found."""
UNLUCKY = 2.5
"""Ratio of a distance's estimate from these vectors to the least value that the distance is taken to have."""
THIN = 0.1
"""Height over the longest side of faces whose weights are rounded more than the diagonal of L."""
CLOSEST = 0.005
"""Fraction of the vertices among which the closest pair is looked for."""


def recomputed_below(component: Component) -> float:
    """Return the distance below which distances are computed again as pairs, unit length."""
    largest = float(np.sqrt(component.biharmonic_diagonal().max()))
    return max(NEAR * largest, _usual_error(component) / (2 * TARGET * largest)) if largest else 0.0


def accuracy_of_fields(component: Component) -> float:
    """Return the accuracy of biharmonic fields on a component (see `Distance.accuracy`)."""
    factor, areas, diagonal = component.factor(diagonals=True), component.areas, component.biharmonic_diagonal()
    m, least = len(areas), _least_distances(component)
    sources = np.unique([least.argmin(), diagonal.argmax(), m // 2])
    each = np.arange(len(sources))
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (m, TRIED))
    b = np.zeros((m, TRIED + len(sources)))
    b[:, :TRIED] = np.sqrt(areas)[:, None] * signs
    b[:, :TRIED] -= areas[:, None] * (b[:, :TRIED].sum(axis=0) / areas.sum())
    b[sources, TRIED + each] = 1
    y = component.solve(b)
    loads, products = b[:, :TRIED], y[:, :TRIED]

    # Both errors take a second solve.
    changed = [SAFETY_FACTOR * (component.stiffness @ products - loads + operator_changes(component, products))]
    if component.flat.lack.any():
        changed.append(SAFETY_FACTOR / 2 * spring_changes(component, products))
    if (read := _changed_by_reading(component, products, signs)).size:
        changed.append(UNSEEN * read)
    again = component.solve(np.hstack([areas[:, None] * y[:, TRIED:], *changed]))
    moves = component.centred(again[:, len(sources) :]).reshape(m, len(changed), TRIED)
    moved = np.sqrt((moves**2).mean(axis=2)).max(axis=0).sum()

    columns, in_place = factor.sandwich_columns(sources), factor.sandwich_diagonal[sources]
    found = np.abs(columns - again[:, : len(sources)])
    found_in_place = float(np.abs(columns[sources, each] - in_place).max())
    columns -= component.u[:, None] * (component.u[sources] / areas.sum())
    squares = np.maximum(diagonal[:, None] + diagonal[sources] - 2 * columns, 0)
    top, apart = float(np.sqrt(squares.max(axis=0).min())), _closest(component, products, least)
    limit = recomputed_below(component)
    if apart < limit:
        # Of what is closer, distances that are too many to be computed again.
        beyond = np.sort(squares, axis=0)[MOST_NEAR + 1 :].min(initial=4 * limit**2)
        apart = max(apart, float(np.sqrt(beyond)) / 2)
    # The usual error may occur at the smallest distance, a larger one at distances like those where it was found.
    usual = change_of_root(np.array([apart**2]), max(_usual_error(component), SEEN * found_in_place))
    rest = squares >= apart**2
    cancelled = max(float(usual[0]), float(change_of_root(squares[rest], SEEN * found[rest]).max(initial=0.0)))
    return float((cancelled + 2 * moved) / np.float64(top))  # which is 0 where all vertices are in one place


def _usual_error(component: Component) -> float:
    return USUAL * EPS * float(component.factor(diagonals=True).sandwich_diagonal.max())


def _least_distances(component: Component) -> FloatArray:
    """Return (m,) distances to which no other vertex is closer, 0 at a neighbour of a vertex without an area."""
    squares = component.stiffness.copy()
    squares.data **= 2
    found: FloatArray = 1 / np.sqrt(squares @ (1 / component.areas))
    return found


def _closest(component: Component, products: FloatArray, least: FloatArray) -> float:
    """Return a distance to which hardly any two vertices are closer."""
    enough = max(float(np.quantile(least, CLOSEST)), 3 * recomputed_below(component))
    few = np.flatnonzero(least < enough)
    if len(few) < 2:
        return enough
    points = products[few] / np.sqrt(products.shape[1])
    apart = cKDTree(points).query(points, 2, distance_upper_bound=UNLUCKY * enough)[0][:, 1] / UNLUCKY
    return min(enough, float(np.maximum(apart, least[few]).min()))


def _changed_by_reading(component: Component, products: FloatArray, signs: FloatArray) -> FloatArray:
    """Return dA^(1/2) r - dL V (m, k) for surfaces that are read alike, another for each column of V (`products`).

    `signs` (m, k) are r; k is 0 where that is next to nothing.
    """
    found = [component.operators_of(each) for each in read_alike(component, TRIED)]
    changed, areas = np.empty((len(signs), max(len(found) - 1, 0))), component.areas
    for load, (stiffness, other), column, sign in zip(changed.T, found[1:], products.T, signs.T, strict=False):
        load[:] = (np.sqrt(other) - np.sqrt(areas)) * sign - (stiffness - found[0][0]) @ column
        load -= areas * (load.sum() / areas.sum())
    return changed


def spring_changes(component: Component, products: AnyArray) -> AnyArray:
    """Return E V (m, k) for what the springs of degenerate faces lack; complex as the products are."""
    if np.iscomplexobj(products):
        return spring_changes(component, products.real) + 1j * spring_changes(component, products.imag)
    flat = component.flat
    changed: AnyArray = flat.pull(flat.lack[:, None] * flat.stretch(products))
    return changed


def operator_changes(component: Component, products: AnyArray) -> AnyArray:
    """Return E V (m, k) for random roundings E of the operator, where `products` (m, k) is V; complex as they are."""
    if np.iscomplexobj(products):
        return operator_changes(component, products.real) + 1j * operator_changes(component, products.imag)
    surface, flat, rng = component.measured, component.flat, np.random.default_rng(1)

    def signs(n: int) -> FloatArray:
        return rng.choice([-RELATIVE_ROUNDING, RELATIVE_ROUNDING], (n, products.shape[1]))

    changed: FloatArray = component.stiffness.diagonal()[:, None] * signs(len(products)) * products

    def connect(a: IntArray, b: IntArray, weight: FloatArray) -> None:
        flow = weight * (products[a] - products[b])
        for column, along in zip(changed.T, flow.T, strict=True):
            column += np.bincount(a, along, len(column)) - np.bincount(b, along, len(column))

    height = surface.face_heights
    thin = np.flatnonzero((height < THIN) & (height >= FLAT_RATIO))
    if len(thin):
        # One sign for all sides, as it is the height that is rounded.
        weights = face_weights(surface)[:, thin, None] * (signs(len(thin)) / height[thin, None])
        for k in range(3):
            connect(surface.faces[thin, (k + 1) % 3], surface.faces[thin, (k + 2) % 3], weights[k])
    if len(flat.faces):
        _, a, b = flat.vertices
        connect(a, b, np.where(flat.loose, 0, 0.5)[:, None] * signs(len(a)))
    return changed
