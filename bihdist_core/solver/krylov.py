"""Largest eigenpairs of a symmetric operator by a block Krylov method with thick restarts.

The operator T is symmetric in the inner product x^T A y, A = diag(weights).  The basis V is A-orthonormal, and the
next block Q is A-orthonormal too and orthogonal to V:

    T V = V H + Q B,     so     T X - X M = Q B Y     for the Ritz vectors X = V Y, where H Y = Y M.

The error of every Ritz pair is thus known without applying T again.  Recombining the columns of V keeps this form,
so that a restart, or a start from eigenvectors known already, is only another V, H, B.
"""

from collections.abc import Callable

import numpy as np

from ..arrays import FloatArray
from ..progress import Progress
from .tall import centre, gram, multiply, own_gram, recombine, subtract

WIDTHS = 8, 32
"""Fewest and most columns of a block.  Wide blocks are cheaper per column; narrow ones need fewer columns."""
PAIRS_PER_COLUMN = 12
"""Wanted pairs for each column of the block; measured."""
CHECK = 1.07
"""The growth of the basis after which the errors, which take a dense eigenproblem, are checked again."""
MEMORY = 2e9
"""Bytes the basis may fill before it is restarted, unless the pairs asked for need more."""
PATIENCE = 8
"""Stop, whatever the errors are, after this many times the columns usually needed; the caller checks the result."""
EPS = float(np.finfo(float).eps)
LOSS = 1e-11
"""A basis that is orthonormal up to so much is good enough: the pairs are made orthonormal afterwards."""
SOLVE = 300
"""For the progress: applying T to a column costs about as much as making it orthogonal to half as many; measured."""
CROWD = 1.01
"""Eigenvalues within this ratio may hide further ones: a block sees at most as many equal ones as it has columns."""


def largest_eigenpairs(
    apply: Callable[[FloatArray], FloatArray],
    weights: FloatArray,
    count: int,
    tolerance: float,
    known: tuple[FloatArray, FloatArray],
    progress: Progress,
) -> FloatArray:
    """Return (n, count) vectors that span the eigenvectors of the `count` largest eigenvalues mu.

    `apply(x)` returns T x for x (n, k), both A-orthogonal to constants; `weights` (n,) is the diagonal of A. The
    `tolerance` is for ||T x - mu x||_A / mu, and not promised. `known` are eigenvalues (j,) and eigenvectors (n, j) to
    begin with. `count` must be well below n. `progress` is called before and after each use of `apply`.
    """
    n = len(weights)
    width = _width(count)
    space = _Space(weights, _room(n, count), *known, tolerance)
    random = np.random.default_rng(0)
    space.inject(random.standard_normal((n, width)))
    families, applied, check, expected = 1, 0, 1.5 * count + width, usual_columns(count)
    while True:
        share = min(0.98, applied * (SOLVE + applied) / (expected * (SOLVE + expected)))
        progress(share, "eigenpairs: solving")
        image = apply(space.block)
        progress(share, "eigenpairs: orthogonalizing")
        applied += image.shape[1]
        space.grow(image)
        exhausted = not space.block.shape[1]
        if space.size >= check or (exhausted and space.size >= count):
            check = CHECK * space.size
            mu, y = space.ritz(count)
            missed = space.couple @ y / mu
            if applied > PATIENCE * expected:
                break
            if np.linalg.norm(missed, axis=0).max() <= tolerance:
                crowd = width * families
                if count <= crowd or (mu[: 1 - crowd] > CROWD * mu[crowd - 1 :]).all():
                    break
                space.inject(random.standard_normal((n, width)))
                families += 1
        if exhausted:
            # The space is invariant: only a new direction can find more.
            space.inject(random.standard_normal((n, width)))
        if space.make_room(count):
            check = 0.0
    progress(0.99, "eigenpairs: combining")
    vectors = multiply(space.basis, y)
    # This makes them T X M^-1 without applying T: smoother than X, and to be had for nothing.
    subtract(vectors, [space.block], -missed)
    return vectors


def usual_columns(count: int) -> float:
    """Return the usual number of columns of a basis for `count` pairs."""
    return 3.5 * count + 8 * _width(count)


def krylov_bytes(n: int, count: int) -> float:
    """Memory for `count` pairs of n rows: the basis with some blocks beside it and, where it is small, the pairs; and
    the dense eigenproblem in it."""
    columns = min(usual_columns(count), _room(n, count) + count)
    return 8.0 * n * (columns + 4 * _width(count)) + 24.0 * columns**2


def _room(n: int, count: int) -> int:
    """Columns of the basis at most."""
    width = _width(count)
    return int(np.clip(MEMORY / (8 * n), count + 6 * width, 4 * count + 16 * width))


def _width(count: int) -> int:
    """Columns of a block."""
    return int(np.clip(count // PAIRS_PER_COLUMN, *WIDTHS))


class _Space:
    """The basis V, the block Q to expand by next, and H and B ("couple") of the module's formula."""

    def __init__(self, weights: FloatArray, room: int, values: FloatArray, vectors: FloatArray, error: float) -> None:
        """Begin with known pairs (values, vectors), which are about `error` from eigenpairs, as a fraction of T."""
        n, self.size = vectors.shape
        self.weights = weights
        self.basis: list[FloatArray] = [np.array(vectors, order="C")] if self.size else []
        room += self.size
        self.h = np.zeros((room, room))
        self.h[: self.size, : self.size] = np.diag(values)
        self.block = np.empty((n, 0))
        self._error = error if self.size else EPS
        """About how far the formula is from true, as a fraction of T."""
        self._left = EPS, EPS
        """About the largest products of columns of V with the last ones of V, and with the block."""
        self.couple = np.zeros((0, self.size))

    def inject(self, columns: FloatArray) -> None:
        """Widen the block by columns (n, k) that need have nothing to do with V."""
        centre(columns, self.weights)
        for _ in range(2):
            old = [*self.basis, self.block]
            subtract(columns, old, gram(old, columns, self.weights))
            columns, _ = self._orthonormal(columns)
        self.block = np.hstack([self.block, columns])
        self.couple = np.vstack([self.couple, np.zeros((columns.shape[1], self.size))])

    def grow(self, image: FloatArray) -> None:
        """Take the block into the basis and make the next one of its image T Q (n, k), which is overwritten."""
        old, new = self.size, self.size + self.block.shape[1]
        touched = np.append(np.flatnonzero(self.couple.any(axis=0)), old)
        ends = np.cumsum([x.shape[1] for x in self.basis])
        near = [*self.basis[np.searchsorted(ends, touched[0], side="right") :], self.block]
        self.basis = [*self.basis, self.block] if self.block.shape[1] else self.basis
        inside = gram(near, image, self.weights)
        subtract(image, near, inside)
        inside = inside[old - new :]
        q, r = self._orthonormal(image, smallest=1e-14 * max(self.h.max(), inside.max()))
        self.h[old:new, :old] = self.couple
        self.h[:old, old:new] = self.couple.T
        self.h[old:new, old:new] = inside
        large, least = np.linalg.svd(r, compute_uv=False)[[0, -1]] if r.size else (0.0, np.inf)
        orthonormal, scale = EPS * (large / least) ** 2, self.h.max()
        # What is left of the other columns: rounding, and what was left of this block and of the one before.
        before, this = self._left
        left = ((self._error + this) * scale + before * np.linalg.norm(self.couple)) / least
        if left > LOSS:
            rest = gram(self.basis, q, self.weights)
            subtract(q, self.basis, rest)
            centre(q, self.weights)
            self.h[:new, old:new] += rest @ r
            self.h[old:new, :old] += (rest[:old] @ r).T
            left = EPS
            orthonormal += np.square(rest).sum()
        if orthonormal > LOSS:
            q, again = self._orthonormal(q)
            left /= np.linalg.svd(again, compute_uv=False).min(initial=1)
            r = again @ r
        self._left = this, left
        self.block, self.size, self.couple = q, new, np.hstack([np.zeros((len(r), old)), r])

    def ritz(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return the `count` largest eigenvalues of H, descending, and its eigenvectors (size, count)."""
        h = self.h[: self.size, : self.size]
        # NumPy's, for which other Python threads need not stand still as for SciPy's; it takes no longer for all.
        mu, y = np.linalg.eigh((h + h.T) / 2)
        return mu[: -count - 1 : -1], np.ascontiguousarray(y[:, : -count - 1 : -1])

    def make_room(self, count: int) -> bool:
        """If the block does not fit into the basis any more, keep only the best Ritz vectors; whether it was so."""
        room = len(self.h)
        if self.size + self.block.shape[1] <= room:
            return False
        keep = min(count + (room - count) // 3, self.size)
        mu, y = self.ritz(keep)
        self.basis = recombine(self.basis, y)
        self.h[:] = 0
        self.h[:keep, :keep] = np.diag(mu)
        self.couple, self.size = self.couple @ y, keep
        # H is symmetric, which products of columns of V are only that far.
        self._error = LOSS
        short = keep + 2 * self.block.shape[1] - room
        if short > 0:
            # Only after several injections into a space at its limit of memory.
            self.h = np.pad(self.h, (0, short))
        return True

    def _orthonormal(self, w: FloatArray, smallest: float = 0.0) -> tuple[FloatArray, FloatArray]:
        """Q (n, j) and R (j, k) with W = Q R and Q A-orthonormal; what is only rounding in W (n, k) is left out.  W is
        overwritten.

        Once leaves Q as far from orthonormal as the columns of W were from independent; twice makes it good.
        """
        products = own_gram(w, self.weights)
        size = np.sqrt(np.diag(products))
        live = np.flatnonzero(size > smallest)
        size = size[live]
        values, u = np.linalg.eigh(products[np.ix_(live, live)] / size / size[:, None])
        values, u = values[values > 1e-12], u[:, values > 1e-12]
        turn, r = np.zeros((w.shape[1], len(values))), np.zeros((len(values), w.shape[1]))
        turn[live] = u / np.sqrt(values) / size[:, None]
        r[:, live] = np.sqrt(values)[:, None] * u.T * size
        return recombine([w], turn)[0], r
