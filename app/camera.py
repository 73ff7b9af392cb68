"""Where the camera stands: standard views, fitted closely around the shape.  y is up."""

from dataclasses import dataclass

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

VIEW_ANGLE = 25.0

VIEWS = {
    "home": ((0.45, 0.25, 1.0), (0, 1, 0)),
    "front": ((0, 0, 1), (0, 1, 0)),
    "back": ((0, 0, -1), (0, 1, 0)),
    "left": ((-1, 0, 0), (0, 1, 0)),
    "right": ((1, 0, 0), (0, 1, 0)),
    "top": ((0, 1, 0), (0, 0, -1)),
    "bottom": ((0, -1, 0), (0, 0, 1)),
}
"""Name: direction from the shape to the camera, and which way is up."""


@dataclass(frozen=True)
class Margins:
    """Shares of the panel kept free around the shape."""

    side: float = 0.05
    top: float = 0.05
    bottom: float = 0.12


def place_camera(
    camera: vtkCamera, points: np.ndarray, aspect: float, view: str = "home", margins: Margins | None = None
) -> None:
    """Look at points (n, 3) from a standard view so that they just fill a panel of width / height `aspect`."""
    direction, up = (np.array(v, float) for v in VIEWS[view])
    if view == "home" and np.ptp(points[:, 2]) <= 1e-6 * np.ptp(points, axis=0).max():
        direction = np.array([0.0, 0, 1])  # a flat domain is looked at straight
    aim(camera, points, aspect, direction, up, margins or Margins())


def aim(
    camera: vtkCamera, points: np.ndarray, aspect: float, direction: np.ndarray, up: np.ndarray, margins: Margins
) -> None:
    """Look at points (n, 3) along -direction, as near as they fit."""
    back = direction / np.linalg.norm(direction)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    frame = np.stack([right, up, back], 1)
    local = points @ frame
    slope = np.tan(np.radians(VIEW_ANGLE / 2))
    wide = slope * aspect * (1 - 2 * margins.side)
    high = slope * (1 - margins.top - margins.bottom)
    centre = (local.min(axis=0) + local.max(axis=0)) / 2
    # With the camera at distance D before the centre, a point at (x, y, z) is seen at x / (D - z).  The nearest D
    # that keeps all points between the margins depends on the centre and the centre on D: a few rounds settle both.
    for _ in range(4):
        x, y, z = (local - centre).T
        distance = max((np.abs(x) / wide + z).max(), (np.abs(y) / high + z).max(), 1e-12)
        seen = (local - centre)[:, :2] / np.maximum(distance - z, 1e-12)[:, None]
        centre[:2] += distance * (seen.min(axis=0) + seen.max(axis=0)) / 2
    middle = frame @ centre
    camera.SetViewAngle(VIEW_ANGLE)
    camera.SetFocalPoint(*middle)
    camera.SetPosition(*(middle + distance * back))
    camera.SetViewUp(*up)
    camera.SetWindowCenter(0, margins.top - margins.bottom)
