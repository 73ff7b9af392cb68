"""Which points of a surface are seen in a picture of it, by the depths that were drawn."""

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from bihdist_core.arrays import AnyArray, FloatArray

from .camera import array_of

SLACK = 0.004
"""By how much of the shape's diagonal a point may lie behind what was drawn: between two pixels, or on a stand-in."""


def seen_in(renderer: vtkRenderer, points: FloatArray, depths: FloatArray) -> tuple[AnyArray, AnyArray]:
    """(k, 2) device pixels, y down, of points (k, 3), and (k,) whether they are seen.

    depths: (height, width) of the picture, 0 to 1, upright.  Behind the camera pixels are NaN.
    """
    camera, (height, width) = renderer.GetActiveCamera(), depths.shape
    eye, back = np.array(camera.GetPosition()), -np.array(camera.GetDirectionOfProjection())
    bounds = np.reshape(renderer.ComputeVisiblePropBounds(), (3, 2))
    slack = SLACK * float(np.linalg.norm(bounds[:, 1] - bounds[:, 0]))
    towards = np.broadcast_to(back, points.shape) if camera.GetParallelProjection() else eye - points
    towards = towards / np.maximum(np.linalg.norm(towards, axis=1), 1e-300)[:, None]
    pixels = pixels_in(renderer, points, width, height)
    nearer = (_divided(renderer, points + slack * towards, width, height)[:, 2] + 1) / 2
    inside = np.isfinite(pixels).all(axis=1)
    column, row = (np.where(inside, pixels[:, k], 0).astype(int) for k in (0, 1))
    # At an edge of the shape the pixel of a point may be beside it.
    farthest = np.zeros(len(points))
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            rows, columns = np.clip(row + down, 0, height - 1), np.clip(column + right, 0, width - 1)
            farthest = np.maximum(farthest, depths[rows, columns])
    return pixels, inside & (nearer <= farthest)


def pixels_in(renderer: vtkRenderer, points: FloatArray, width: int, height: int) -> FloatArray:
    """(k, 2) device pixels, y down, of points (k, 3) in a picture of so many, be they seen or not."""
    flat = _divided(renderer, points, width, height)
    return np.column_stack([(flat[:, 0] + 1) / 2 * width, (1 - flat[:, 1]) / 2 * height])


def _divided(renderer: vtkRenderer, points: FloatArray, width: int, height: int) -> FloatArray:
    """(k, 3) points (k, 3) as -1 ... 1 in the picture and in depth; NaN behind the camera."""
    seen = renderer.GetActiveCamera().GetCompositeProjectionTransformMatrix(width / max(height, 1), -1, 1)
    local = np.column_stack([points, np.ones(len(points))]) @ array_of(seen).T
    return local[:, :3] / np.where(local[:, 3] > 0, local[:, 3], np.nan)[:, None]
