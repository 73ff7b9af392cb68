"""How the user moves a camera: it turns, goes sideways and nearer, all by pixels of a view."""

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from bihdist_core.arrays import FloatArray

TURN = 200.0
"""Degrees for a move across the whole view."""

STEEPEST = 89.0
"""Degrees of elevation up to which a turntable tilts: at the poles nothing would be upright."""


def turn(camera: vtkCamera, dx: float, dy: float, size: tuple[float, float], upright: FloatArray | None = None) -> None:
    """Turn a camera round its focal point, for a move by (dx, dy), y up, across a view of this size.

    The unit vector `upright` (3,) stays upright in the picture, as on a turntable; without one the camera turns freely.
    """
    across, along = -TURN * dx / max(size[0], 1), -TURN * dy / max(size[1], 1)
    if upright is not None:
        _turn_upright(camera, across, along, upright)
        return
    camera.Azimuth(across)
    camera.Elevation(along)
    camera.OrthogonalizeViewUp()


def _turn_upright(camera: vtkCamera, across: float, along: float, upright: FloatArray) -> None:
    """Turn by degrees about the upright axis, and up along the meridian as far as that goes."""
    focal_point = np.array(camera.GetFocalPoint())
    arm = np.array(camera.GetPosition()) - focal_point
    length = float(np.linalg.norm(arm))
    back = arm / length
    steep = float(np.degrees(np.arcsin(np.clip(back @ upright, -1, 1))))
    level = back - (back @ upright) * upright
    if np.linalg.norm(level) < 1e-6:
        # From a pole, the way that is up or down in the picture is where the front is.
        level = -np.sign(steep) * np.array(camera.GetViewUp())
        level = level - (level @ upright) * upright
    level /= np.linalg.norm(level)
    a = np.radians(across)
    level = np.cos(a) * level + np.sin(a) * np.cross(upright, level)
    # What is steeper already, such as the view from the top, may stay so, and get no steeper.
    limit = STEEPEST if along else max(STEEPEST, abs(steep))
    e = np.radians(np.clip(steep + along, -limit, limit))
    camera.SetPosition(*(focal_point + length * (np.cos(e) * level + np.sin(e) * upright)))
    camera.SetViewUp(*(np.cos(e) * upright - np.sin(e) * level))


def shift(camera: vtkCamera, dx: float, dy: float, height: float) -> None:
    """Pan so that what is as deep as the focal point follows a move by (dx, dy), y up, in a view of this height."""
    half = np.tan(np.radians(camera.GetViewAngle() / 2)) * camera.GetDistance()
    if camera.GetParallelProjection():
        half = camera.GetParallelScale()
    per_pixel = 2 * half / max(height, 1)
    up = np.array(camera.GetViewUp())
    along = np.array(camera.GetDirectionOfProjection())
    right = np.cross(along, up)
    right /= np.linalg.norm(right)
    step = -per_pixel * (dx * right + dy * np.cross(right, along))
    camera.SetPosition(*(np.array(camera.GetPosition()) + step))
    camera.SetFocalPoint(*(np.array(camera.GetFocalPoint()) + step))


def zoom(camera: vtkCamera, factor: float, about: FloatArray) -> None:
    """Move a camera nearer by a factor; a point (3,) stays where it is seen."""
    for get, put in (
        (camera.GetPosition, camera.SetPosition),
        (camera.GetFocalPoint, camera.SetFocalPoint),
    ):
        put(*(about + (np.array(get()) - about) / factor))
    camera.SetParallelScale(camera.GetParallelScale() / factor)


def centre(camera: vtkCamera, point: FloatArray) -> None:
    """Let a point (3,) be in the middle, and what is turned about; seen from the same side, as large as before."""
    along = np.array(camera.GetDirectionOfProjection())
    offset = point - np.array(camera.GetPosition())
    depth = float(offset @ along)
    if depth > 0:
        camera.SetPosition(*(point - depth * along))
        camera.SetFocalPoint(*point)


def at_focal_depth(renderer: vtkRenderer, x: float, y: float) -> FloatArray:
    """Return the place (3,) at device pixel (x, y), y up, that is as deep as the focal point."""
    renderer.SetWorldPoint(*renderer.GetActiveCamera().GetFocalPoint(), 1.0)
    renderer.WorldToDisplay()
    renderer.SetDisplayPoint(x, y, renderer.GetDisplayPoint()[2])
    renderer.DisplayToWorld()
    *place, weight = renderer.GetWorldPoint()
    return np.array(place) / weight
