"""A first, rough mesh of a field's zero surface: flying edges on a grid that is filled only near the surface."""

import numpy as np
import pyvista as pv
from scipy.ndimage import zoom

from .fields import Field
from .triangles import largest_component

COARSE = 4
"""Grid steps per step of the coarse grid that says where the surface is."""

BLOCK = 400_000


def polygonise(field: Field, low: np.ndarray, high: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) points and (m, 3) faces, facing outwards, of the largest piece of the surface in the box low..high."""
    low, wide = np.asarray(low, float), step * COARSE
    count = np.ceil((np.asarray(high) - low) / wide).astype(int) + 1
    axes = [start + wide * np.arange(k) for start, k in zip(low, count, strict=True)]
    coarse = field(np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)).reshape(count)
    size = (count - 1) * COARSE + 1
    values = zoom(coarse, size / count, order=1, grid_mode=False)
    near = np.argwhere(np.abs(values) < 2.2 * wide)
    for i in range(0, len(near), BLOCK):
        at = near[i : i + BLOCK]
        values[tuple(at.T)] = field(low + step * at)
    grid = pv.ImageData(dimensions=size, spacing=(step, step, step), origin=low)
    grid["distance"] = values.ravel(order="F").astype(np.float32)
    mesh = grid.contour([0.0], scalars="distance", method="flying_edges").triangulate()
    return largest_component(np.asarray(mesh.points, float), mesh.regular_faces[:, ::-1].astype(np.int64))
