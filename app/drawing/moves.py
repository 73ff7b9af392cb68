"""How the user moves a camera: it turns, goes sideways and nearer, all by pixels of a view."""

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

TURN = 200.0
"""Degrees for a move across the whole view."""


def turn(camera: vtkCamera, dx: float, dy: float, size: tuple[float, float]) -> None:
    """Round the focal point, for a move by (dx, dy), y up, across a view of this size."""
    camera.Azimuth(-TURN * dx / max(size[0], 1))
    camera.Elevation(-TURN * dy / max(size[1], 1))
    camera.OrthogonalizeViewUp()


def shift(camera: vtkCamera, dx: float, dy: float, height: float) -> None:
    """What lies at the depth of the focal point follows a move by (dx, dy), y up, in a view of this height."""
    slope = np.tan(np.radians(camera.GetViewAngle() / 2))
    per_pixel = 2 * slope * camera.GetDistance() / max(height, 1)
    up = np.array(camera.GetViewUp())
    along = np.array(camera.GetDirectionOfProjection())
    right = np.cross(along, up)
    right /= np.linalg.norm(right)
    _move(camera, -per_pixel * (dx * right + dy * np.cross(right, along)))


def zoom(camera: vtkCamera, factor: float, about: np.ndarray) -> None:
    """Nearer by a factor; a point (3,) stays where it is seen."""
    for get, put in (
        (camera.GetPosition, camera.SetPosition),
        (camera.GetFocalPoint, camera.SetFocalPoint),
    ):
        put(*(about + (np.array(get()) - about) / factor))


def centre(camera: vtkCamera, point: np.ndarray) -> None:
    """Let a point (3,) be in the middle, and what is turned about; seen from the same side, as large as before."""
    along = np.array(camera.GetDirectionOfProjection())
    offset = point - np.array(camera.GetPosition())
    depth = float(offset @ along)
    if depth > 0:
        camera.SetPosition(*(point - depth * along))
        camera.SetFocalPoint(*point)


def at_focal_depth(renderer: vtkRenderer, x: float, y: float) -> np.ndarray:
    """(3,) the place at device pixel (x, y), y up, that is as far as the focal point."""
    renderer.SetWorldPoint(*renderer.GetActiveCamera().GetFocalPoint(), 1.0)
    renderer.WorldToDisplay()
    renderer.SetDisplayPoint(x, y, renderer.GetDisplayPoint()[2])
    renderer.DisplayToWorld()
    *place, weight = renderer.GetWorldPoint()
    return np.array(place) / weight


def _move(camera: vtkCamera, by: np.ndarray) -> None:
    camera.SetPosition(*(np.array(camera.GetPosition()) + by))
    camera.SetFocalPoint(*(np.array(camera.GetFocalPoint()) + by))
