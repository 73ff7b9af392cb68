"""Points that stand for vertices, as a page holds them: what truncated and diffusion distance are the distances of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray
from bihdist_core.distances.spectral import SpectralDistance
from bihdist_core.progress import Progress, part

LARGEST = 2**15 - 1


@dataclass(frozen=True, eq=False)
class StoredPoints:
    """Coordinates (n, k) of 16 bits, each to be multiplied by its scale (c, k) of the component.

    error: how far rounding moves a distance at most, in its own unit.
    """

    coordinates: FloatArray
    scales: FloatArray
    error: float

    @classmethod
    def of(cls, distance: SpectralDistance, progress: Progress | None = None) -> StoredPoints:
        """Those of a distance on a stored mesh: every vertex is in a component."""
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
        """The scales, then all less significant bytes, coordinate by coordinate, then all others."""
        halves = self.coordinates.T.astype("<i2").reshape(-1, 1).view(np.uint8)
        return self.scales.T.astype("<f8").tobytes() + halves.T.tobytes()
