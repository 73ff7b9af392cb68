"""Distances that are sums over eigenpairs: d(i, j)^2 = sum_k w_k (phi_k(i) - phi_k(j))^2."""

from abc import abstractmethod

import numpy as np

from .distance import Distance
from .errors import ParameterError
from .laplacian import Component, Laplacian
from .progress import Progress
from .spectrum import Spectrum
from .surface import Surface
from .tall import point_distances


class SpectralDistance(Distance):
    """Vertices become points with the coordinates sqrt(w_k) phi_k; the distance is that of the points."""

    def __init__(self, laplacian: Laplacian | Surface) -> None:
        super().__init__(laplacian)
        self._points: dict[int, np.ndarray] = {}

    @abstractmethod
    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, np.ndarray]:
        """The eigenpairs used on a component and their weights (k,)."""

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

    def _pairwise(self, component: Component, index: np.ndarray) -> np.ndarray:
        points = self.points(component)[index]
        return point_distances(points, points)


class PowerDistance(SpectralDistance):
    """The family of the paper's section 6, weights 1 / lambda^alpha, from the first k eigenpairs.

    alpha > 1 (else the sum diverges on a surface: ParameterError); scales like length ** (alpha - 1).  A component
    with fewer than k + 1 vertices uses all its eigenpairs.
    """

    def __init__(
        self, laplacian: Laplacian | Surface, alpha: float = 1.5, k: int = 200, progress: Progress | None = None
    ) -> None:
        if not 1 < alpha < np.inf:
            raise ParameterError(f"alpha is {alpha:g}; the sum of 1 / lambda^alpha needs alpha > 1.")
        super().__init__(laplacian)
        self.alpha, self.k = float(alpha), checked_count(k)
        self.label = f"1/λ^{alpha:g}, {k} eigenpairs"
        self.length_power = self.alpha - 1
        self.prepare(self.laplacian.components[0], progress)

    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, np.ndarray]:
        spectrum = component.spectrum(self.k, progress)
        return spectrum, spectrum.eigenvalues[: self.k] ** -self.alpha


class TruncatedBiharmonicDistance(PowerDistance):
    """The biharmonic distance from its first k eigenpairs (paper, Eq. 11); unit length.

    Its error falls about like 1 / k; `BiharmonicDistance` is exact and, for one source, faster.
    """

    def __init__(self, laplacian: Laplacian | Surface, k: int = 200, progress: Progress | None = None) -> None:
        super().__init__(laplacian, alpha=2.0, k=k, progress=progress)
        self.label = f"biharmonic, {k} eigenpairs"


def checked_count(k: int) -> int:
    """k as an int; ParameterError unless it is a whole number of at least 1."""
    if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or k < 1:
        raise ParameterError(f"k is {k!r}; the number of eigenpairs must be a whole number of at least 1.")
    return int(k)
