"""Which points of a surface are seen in a picture of it, by the depths that were drawn."""

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from bihdist_core.arrays import AnyArray, FloatArray

from .camera import SeenNow

SLACK = 0.004
"""By how much of the shape's diagonal a point may lie behind what was drawn: between two pixels, or on a stand-in."""


def seen_in(renderer: vtkRenderer, points: FloatArray, depths: FloatArray) -> tuple[AnyArray, AnyArray]:
    """Return device pixels (k, 2), y down, of points (k, 3), NaN behind the camera, and whether they are seen (k,).

    The depths (height, width) are those of the picture, from 0 to 1, upright.
    """
    camera, (height, width) = renderer.GetActiveCamera(), depths.shape
    eye, back = np.array(camera.GetPosition()), -np.array(camera.GetDirectionOfProjection())
    bounds = np.reshape(renderer.ComputeVisiblePropBounds(), (3, 2))
    slack = SLACK * float(np.linalg.norm(bounds[:, 1] - bounds[:, 0]))
    towards = np.broadcast_to(back, points.shape) if camera.GetParallelProjection() else eye - points
    towards = towards / np.maximum(np.linalg.norm(towards, axis=1), 1e-300)[:, None]
    pixels = pixels_in(renderer, points, width, height)
    nearer = (SeenNow(camera, width / height).in_picture(points + slack * towards)[:, 2] + 1) / 2
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
    """Return device pixels (k, 2), y down, of points (k, 3) in a picture of this size, whether or not they are seen."""
    flat = SeenNow(renderer.GetActiveCamera(), width / height).in_picture(points)
    return np.column_stack([(flat[:, 0] + 1) / 2 * width, (1 - flat[:, 1]) / 2 * height])
