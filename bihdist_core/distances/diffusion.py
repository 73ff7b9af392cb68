"""The diffusion distance (paper, Eq. 1, with its normalised time t <- t / (2 lambda_1))."""

import math

import numpy as np

from ..errors import ParameterError
from ..laplacian import Component, Laplacian
from ..progress import Progress, part
from ..solver.spectrum import Spectrum
from ..surface import Surface
from .accuracy import SPARE
from .spectral import SpectralDistance, checked_number

FIRST_BATCH = 16
LONGEST = 700.0
"""From here on the first weight, exp(-t), is no number any more."""
MOST_PAIRS = 3000
"""More eigenpairs than this are not computed: at 100,000 vertices they fill 2.4 GB."""


class DiffusionDistance(SpectralDistance):
    """d(i, j)^2 = sum_k exp(-t lambda_k / lambda_1) (phi_k(i) - phi_k(j))^2; unit 1 / length.

    The sum takes every eigenpair whose weight exceeds `tolerance` times the first weight; `bound` tells what the
    rest can add.  lambda_1 is that of the component.  Raises ParameterError if t or the tolerance is not positive,
    or if they need more than `MOST_PAIRS` eigenpairs.
    """

    length_power = -1.0

    def __init__(
        self,
        laplacian: Laplacian | Surface,
        t: float = 1.0,
        tolerance: float = 1e-8,
        progress: Progress | None = None,
    ) -> None:
        if not 0 < checked_number(t, "The diffusion time t") <= LONGEST:
            raise ParameterError(f"The diffusion time t is {t:g}; it must be positive, and at most {LONGEST:g}.")
        if not 0 < checked_number(tolerance, "The tolerance") < 1:
            raise ParameterError(f"The tolerance is {tolerance:g}; it must lie between 0 and 1.")
        super().__init__(laplacian)
        self.t, self.tolerance = float(t), float(tolerance)
        self.label = f"diffusion, t = {t:g}"
        self._omitted: dict[int, float] = {}
        self.prepare(self.laplacian.components[0], progress)

    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, np.ndarray]:
        spectrum = component.spectrum(FIRST_BATCH, part(progress, 0, 0.3))
        first = spectrum.eigenvalues[0]
        last = float(first) * (1 - math.log(self.tolerance) / self.t)
        most = component.most_eigenpairs
        while spectrum.eigenvalues[-1] < last and len(spectrum.eigenvalues) < most:
            have = len(spectrum.eigenvalues)
            # Weyl's law, lambda_k ~ 4 pi k / area, with the constant of the last pair known.
            needed = 1.1 * have * last / spectrum.eigenvalues[-1] + 4
            if min(needed, most) > MOST_PAIRS:
                raise ParameterError(
                    f"Diffusion with t = {self.t:g} to a tolerance of {self.tolerance:g} needs about {needed:.3g} "
                    f"eigenpairs here; at most {MOST_PAIRS} are computed. Choose a larger t or tolerance."
                )
            spectrum = component.spectrum(int(min(needed, most)), part(progress, 0.3, 1))
        weights = np.exp(-self.t * spectrum.eigenvalues / first)
        count = int(np.searchsorted(spectrum.eigenvalues, last))
        self._omitted[component.index] = float(weights[count]) if count < len(weights) else 0.0
        return spectrum, weights[:count]

    def _slopes(self, eigenvalues: np.ndarray) -> np.ndarray:
        # The weights depend on the first eigenvalue too.
        return 2 * self.t * eigenvalues / eigenvalues[0]

    def _missing(self, component: Component, source: int, squares: np.ndarray, changes: np.ndarray) -> np.ndarray:
        """The terms that are known without being used, and an estimate of the others.

        By Weyl's law, lambda_k ~ 4 pi k / area, and (phi_k(x) - phi_k(y))^2 ~ min(2, lambda_k r^2 / 2) / area, in the
        mean: at a tip it can be several times as much.
        """
        spectrum, count = component.spectrum(1), squares.shape[1]
        values = spectrum.eigenvalues
        if count == component.most_eigenpairs:
            return np.zeros(len(squares))
        weights = np.exp(-self.t * values / values[0])
        others = spectrum.eigenvectors[:, count:]
        known = (others - others[source]) ** 2 @ weights[count:]
        step = values[0] / self.t
        far = weights[-1] * step / (2 * np.pi)
        near = weights[-1] * step * (values[-1] + step) * component.areas.sum() / (4 * np.pi * (weights @ values))
        return 2 * SPARE * known + SPARE**2 * np.minimum(far, near * squares.sum(axis=1))

    def pair_count(self, vertex: int) -> int:
        """How many eigenpairs the sum has on the component of a vertex."""
        return self.points(self.laplacian.component_of(vertex)).shape[1]

    def bound(self, vertex: int) -> np.ndarray:
        """(n,) a proven bound on the error of `from_source(vertex)`, from leaving eigenpairs out.

        With w the first omitted weight, at most w (1/A_x + 1/A_y - sum_{k <= K} (phi_k(x) - phi_k(y))^2) is left out
        of d^2 (the constant mode's difference is 0), so the error of d is at most min(sqrt(tail), tail / d).
        """
        component = self.laplacian.component_of(vertex)
        points = self.points(component)
        source = component.local(np.array([vertex]))[0]
        count = points.shape[1]
        vectors = component.spectrum(count).eigenvectors[:, :count]
        known = np.einsum("ij,ij->i", vectors - vectors[source], vectors - vectors[source])
        field = self.from_source(vertex)[component.vertices]
        with np.errstate(divide="ignore", invalid="ignore"):
            tail = self._omitted[component.index] * (1 / component.areas + 1 / component.areas[source] - known)
            tail = np.maximum(tail, 0)
            error = np.fmin(np.sqrt(tail), tail / field)
        error[source] = 0
        bound = np.full(len(self.surface.vertices), np.nan)
        bound[component.vertices] = error
        return bound
