"""Values of vertices as a page holds them: the points of a spectral distance, and a field of the user's own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from bihdist_core.arrays import FloatArray, IntArray
from bihdist_core.distances.spectral import SpectralDistance
from bihdist_core.progress import Progress, part

LARGEST = 2**15 - 1


@dataclass(frozen=True, eq=False)
class StoredPoints:
    """The embedding of the vertices in k dimensions, as whole numbers; a distance is that between two of its points.

    Attributes
    ----------
    coordinates : (n, k) ndarray
        Whole numbers of 16 bits, to be multiplied by the scales of the vertex's component.
    scales : (c, k) ndarray
        For each component.
    error : float
        The most by which rounding changes a distance, in its own unit.
    """

    coordinates: FloatArray
    scales: FloatArray
    error: float

    @classmethod
    def of(cls, distance: SpectralDistance, progress: Progress | None = None) -> StoredPoints:
        """Round the embedding of a distance on a stored mesh, all of whose vertices belong to components."""
        components = distance.laplacian.components
        found = [
            distance.points(component, part(progress, k / len(components), (k + 1) / len(components)))
            for k, component in enumerate(components)
        ]
        count = max(points.shape[1] for points in found)
        coordinates, scales = np.zeros((len(distance.surface.vertices), count)), np.zeros((len(found), count))
        for number, (component, points) in enumerate(zip(components, found, strict=True)):
            k = points.shape[1]
            scales[number, :k] = np.abs(points).max(axis=0, initial=0) / LARGEST
            coordinates[component.vertices, :k] = np.rint(
                points / np.where(scales[number, :k] > 0, scales[number, :k], 1)
            )
        return cls(coordinates, scales, float(np.sqrt((scales**2).sum(axis=1)).max()))

    @property
    def packed(self) -> bytes:
        """The scales, then the low bytes, coordinate by coordinate, then the high bytes."""
        halves = self.coordinates.T.astype("<i2").reshape(-1, 1).view(np.uint8)
        return self.scales.T.astype("<f8").tobytes() + halves.T.tobytes()


@dataclass(frozen=True, eq=False)
class StoredField:
    """A field as multiples of a power of two, so that no value is too large or too small for single precision.

    Attributes
    ----------
    multiples : (n,) float32 ndarray
        NaN where the field is undefined.
    scale : float
        The power of two.
    error : float
        The most by which rounding changes a value, as a fraction of the largest.
    """

    multiples: npt.NDArray[np.float32]
    scale: float
    error: float

    @classmethod
    def of(cls, values: FloatArray, ids: IntArray) -> StoredField:
        """Round the values of the vertices `ids` (n,)."""
        largest = float(np.nanmax(np.abs(values), initial=0.0))
        exponent = int(np.frexp(largest)[1]) - 1
        exact = np.ldexp(values[ids], -exponent)
        multiples = exact.astype(np.float32)
        error = float(np.nanmax(np.abs(multiples - exact), initial=0.0))
        return cls(multiples, float(np.ldexp(1.0, exponent)), error / float(np.ldexp(largest, -exponent) or 1.0))

    @property
    def values(self) -> FloatArray:
        """The values (n,), as they were rounded."""
        return self.multiples.astype(np.float64) * self.scale

    @property
    def packed(self) -> bytes:
        """The scale, then the first bytes of all numbers, then the second bytes, and so on."""
        planes = self.multiples.astype("<f4").view(np.uint8).reshape(-1, 4).T
        return np.array(self.scale, "<f8").tobytes() + planes.tobytes()
