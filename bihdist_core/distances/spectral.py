"""Distances that are sums over eigenpairs: d(i, j)^2 = sum_k w_k (phi_k(i) - phi_k(j))^2."""

from abc import abstractmethod
from collections.abc import Sequence

import numpy as np

from ..errors import ParameterError
from ..laplacian import Component, Laplacian
from ..progress import Progress
from ..solver.spectrum import Spectrum
from ..solver.tall import point_distances
from ..surface import Surface
from .accuracy import SPARE, Perturbation, change_of_root
from .distance import Distance

CLEAR = 1e-3
"""Eigenvalues this far apart, as a share of themselves, are clearly two."""


class SpectralDistance(Distance):
    """Vertices become points with the coordinates sqrt(w_k) phi_k; the distance is that of the points."""

    is_quadratic = True

    def __init__(self, laplacian: Laplacian | Surface) -> None:
        super().__init__(laplacian)
        self._points: dict[int, np.ndarray] = {}

    @abstractmethod
    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, np.ndarray]:
        """Eigenpairs of a component and the weights (k,) of those that are used, which are the first."""

    @abstractmethod
    def _slopes(self, eigenvalues: np.ndarray) -> np.ndarray:
        """(k,) by what share a weight changes at most, over the share by which the eigenvalues change."""

    @abstractmethod
    def _missing(self, component: Component, source: int, squares: np.ndarray, changes: np.ndarray) -> np.ndarray:
        """(m,) what eigenpairs left out can do to the squared distances from a vertex.

        squares (m, k): the terms of their sums; changes (k,): the share by which each eigenpair may be wrong.
        """

    def points(self, component: Component, progress: Progress | None = None) -> np.ndarray:
        """(m, k) the points that stand for a component's vertices."""
        if component.index not in self._points:
            spectrum, weights = self._weighted(component, progress)
            self._points[component.index] = spectrum.eigenvectors[:, : len(weights)] * np.sqrt(weights)
        return self._points[component.index]

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        self.points(component, progress)

    def _columns(self, component: Component, index: np.ndarray, progress: Progress | None) -> np.ndarray:
        points = self.points(component)
        return point_distances(points, points[index])

    def _pairwise(self, component: Component, index: np.ndarray, progress: Progress | None = None) -> np.ndarray:
        points = self.points(component)[index]
        return point_distances(points, points)

    def _of_pairs(
        self, component: Component, i: np.ndarray, j: np.ndarray, progress: Progress | None = None
    ) -> np.ndarray:
        points = self.points(component)
        return np.linalg.norm(points[i] - points[j], axis=1)

    def _estimated_accuracy(self, component: Component) -> float:
        spectrum, weights = self._weighted(component, None)
        count = len(weights)
        values, residuals = spectrum.eigenvalues[:count], spectrum.residuals[:count]
        perturbation = Perturbation(component)
        few = np.unique([0, count // 2, count - 1])
        some = spectrum.eigenvectors[:, few]
        change = float((sum(perturbation.of(some, some)) / values[few]).max())
        # Beside flat faces residuals are large by rounding, and stiff: G makes little of them.
        again = component.centred(component.solve(component.areas[:, None] * some)) * values[few]
        missed = np.sqrt(component.areas @ (again - some) ** 2)
        residuals = residuals * min(1.0, float((missed / np.maximum(residuals[few], 1e-300)).max()))
        points = self.points(component)
        source = int(perturbation.flattest[0])
        squares = (points - points[source]) ** 2
        fields = squares.sum(axis=1)
        # What is missed turns an eigenvector towards others, which counts by the difference of their weights.
        by = squares @ (self._slopes(values) * change + 2 * SPARE * residuals)
        by += self._missing(component, source, squares, change + residuals)
        return float(change_of_root(fields, by).max() / np.sqrt(fields.max()))


class PowerDistance(SpectralDistance):
    """The family of the paper's section 6, weights 1 / lambda^alpha, from the first k eigenpairs.

    alpha > 1 (else the sum diverges on a surface); scales like length ** (alpha - 1).  A component with fewer than
    k + 1 vertices uses all its eigenpairs.  Raises ParameterError for another alpha, and if no component has k of them.
    """

    def __init__(
        self, laplacian: Laplacian | Surface, alpha: float = 1.5, k: int = 200, progress: Progress | None = None
    ) -> None:
        if not 1 < checked_number(alpha, "alpha") < np.inf:
            raise ParameterError(f"alpha is {alpha:g}; the sum of 1 / lambda^alpha needs alpha > 1.")
        super().__init__(laplacian)
        self.alpha, self.k = float(alpha), checked_count(k)
        self.laplacian.check_eigenpairs(self.k, int(self.laplacian.eigenpair_counts.max()))
        self.label = f"1/λ^{alpha:g}, {self.k} eigenpairs"
        self.length_power = self.alpha - 1
        self.prepare(self.laplacian.components[0], progress)

    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, np.ndarray]:
        spectrum = component.spectrum(self.k, progress)
        return spectrum, spectrum.eigenvalues[: self.k] ** -self.alpha

    def _slopes(self, eigenvalues: np.ndarray) -> np.ndarray:
        return np.full(len(eigenvalues), self.alpha)

    def _remedy(self, components: Sequence[int]) -> str:
        for component in (self.laplacian.components[index] for index in components):
            values = component.spectrum(self.k + 1).eigenvalues[: self.k + 1]
            gaps = np.diff(values) / values[1:]
            if len(values) > self.k and gaps[-1] < CLEAR:
                clear = np.flatnonzero(gaps >= CLEAR) + 1
                choose = f"; choose another k, such as {clear[-1]}" if len(clear) else ""
                return (
                    f"Eigenvalues {self.k} and {self.k + 1} differ by {gaps[-1]:.0e} of themselves only, so that it is "
                    f"open which eigenpairs are the first {self.k}{choose}."
                )
        return super()._remedy(components)

    def _missing(self, component: Component, source: int, squares: np.ndarray, changes: np.ndarray) -> np.ndarray:
        # One more tells how clearly those used are set off.
        spectrum, count = component.spectrum(self.k + 1), squares.shape[1]
        if len(spectrum.eigenvalues) <= count:
            return np.zeros(len(squares))
        values, next_value = spectrum.eigenvalues[:count], spectrum.eigenvalues[count]
        # By how much eigenvectors may have turned towards the first that is left out.
        turned = np.minimum(1, changes * next_value / np.maximum(next_value - values, 1e-300))
        reach = np.ptp(spectrum.eigenvectors[:, count])
        return 2 * reach * np.sqrt(squares) @ (turned * values ** (-self.alpha / 2))


class TruncatedBiharmonicDistance(PowerDistance):
    """The biharmonic distance from its first k eigenpairs (paper, Eq. 11); unit length.

    Its error falls about like 1 / k; `BiharmonicDistance` is exact and, for one source, faster.
    """

    def __init__(self, laplacian: Laplacian | Surface, k: int = 200, progress: Progress | None = None) -> None:
        super().__init__(laplacian, alpha=2.0, k=k, progress=progress)
        self.label = f"biharmonic, {self.k} eigenpairs"


def checked_number(value: float, name: str) -> float:
    """A parameter as a float; ParameterError unless it is a number."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise ParameterError(f"{name} is {value!r}; it must be a number.")
    return float(value)


def checked_count(k: int) -> int:
    """k as an int; ParameterError unless it is a whole number of at least 1."""
    if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or k < 1:
        raise ParameterError(f"k is {k!r}; the number of eigenpairs must be a whole number of at least 1.")
    return int(k)
