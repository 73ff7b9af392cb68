"""How far a factor's solutions are off by rounding, and where that shows most.

The solver's answers are those of a matrix L + E.  E is some roundings of large entries, or more where it inverts blocks
that are nearly singular: beside springs of degenerate faces, and where a piece of little area hangs on weak links.  The
residual L y - b = -E y of any solution y tells E y, and another solve with it how far y is off.  From random b, the
vertices stand out whose rows of the inverse are off the most.
"""

from collections.abc import Callable

import numpy as np

from ..arrays import FloatArray, IntArray
from ..laplacian import Component

TRIED = 2
"""Random right-hand sides."""


class SolveErrors:
    """What the rounding of a component's factor does.

    rounding: of each diagonal entry, as a share of it, which counts where the solver is better than that.
    """

    def __init__(self, component: Component, rounding: float) -> None:
        self._component = component
        signs = np.random.default_rng(0).choice([-1.0, 1.0], (len(component.vertices), TRIED + 1))
        self._tried = signs[:, :TRIED]
        self._rounded = rounding * component.stiffness.diagonal()[:, None] * signs[:, TRIED:]

    def off(self, b: FloatArray) -> FloatArray:
        """(m, k) about how far solutions for b (m, k) are off."""
        y = self._component.solve(b)
        return self._component.solve(self._component.stiffness @ y - b + self._rounded * y)

    def at_worst(self, adjoint: Callable[[FloatArray], FloatArray]) -> tuple[IntArray, FloatArray]:
        """The vertices (k,) where it shows most, and (m, k) about how far squared distances from these may be off.

        adjoint(y) gives z (m, k) of `accuracy_of_pairs`.
        """
        off = self.off(self._tried)
        rows = [np.abs(each).sum(axis=1) for each in (off, adjoint(off))]
        vertices = np.unique([row.argmax() for row in rows])
        each = np.arange(len(vertices))
        b = np.zeros((len(off), len(each)))
        b[vertices, each] = 1
        columns = adjoint(self.off(b))
        return vertices, np.abs(columns - columns[vertices, each])
