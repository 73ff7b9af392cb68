"""Where the camera stands: standard views, fitted closely around the shape, and what it sees of a point.  y is up."""

from dataclasses import dataclass, replace

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

from ..document.camera import Camera, Vector, checked_view

VIEW_ANGLE = 25.0

DIRECTIONS = {
    "home": ((0.45, 0.25, 1.0), (0, 1, 0)),
    "front": ((0, 0, 1), (0, 1, 0)),
    "back": ((0, 0, -1), (0, 1, 0)),
    "left": ((-1, 0, 0), (0, 1, 0)),
    "right": ((1, 0, 0), (0, 1, 0)),
    "top": ((0, 1, 0), (0, 0, -1)),
    "bottom": ((0, -1, 0), (0, 0, 1)),
    "relief": ((-0.35, -1.0, 0.75), (0, 0, 1)),
}
"""Of the standard views: from the shape to the camera, and which way is up."""


@dataclass(frozen=True)
class Margins:
    """Shares of the panel kept free around the shape."""

    side: float = 0.05
    top: float = 0.05
    bottom: float = 0.05


def frame(camera: Camera) -> np.ndarray:
    """(3, 3) columns: right, up, and back to the camera."""
    back = np.subtract(camera.position, camera.focal_point)
    back = back / np.linalg.norm(back)
    right = np.cross(np.array(camera.up) / np.linalg.norm(camera.up), back)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(back, right), back], 1)


def turned(camera: Camera, degrees: float, axis: np.ndarray) -> Camera:
    """The camera gone round its focal point, about an axis (3,)."""
    a, axis = np.radians(degrees), np.asarray(axis, float) / np.linalg.norm(axis)

    def turn(arm: np.ndarray) -> np.ndarray:
        return arm * np.cos(a) + np.cross(axis, arm) * np.sin(a) + axis * (axis @ arm) * (1 - np.cos(a))

    arm = turn(np.subtract(camera.position, camera.focal_point))
    up = turn(np.array(camera.up))
    return replace(camera, position=_vector(np.add(camera.focal_point, arm)), up=_vector(up))


class Projection:
    """What a camera makes of points in a picture of width / height `aspect`.

    A share `free` along each side is left around what the camera is sure to see.  matrix: (4, 4) from the camera's
    coordinates to -1 … 1 in x, y and depth; view: (4, 4) from the world's to the camera's.
    """

    def __init__(self, camera: Camera, aspect: float, points: np.ndarray, free: float = 0.0) -> None:
        axes, self.position = frame(camera), np.array(camera.position, float)
        self.view = np.eye(4)
        self.view[:3, :3], self.view[:3, 3] = axes.T, -axes.T @ self.position
        depth = -(points @ axes[:, 2] - self.position @ axes[:, 2])
        far = max(float(depth.max()), 1e-12) * 1.01
        near = max(float(depth.min()) * 0.99, far * 1e-4)
        high = max(camera.extent[1], camera.extent[0] / aspect) / (1 - 2 * free)
        self.matrix = np.zeros((4, 4))
        self.matrix[0, 0], self.matrix[1, 1], self.matrix[3, 2] = 1 / (high * aspect), 1 / high, -1
        self.matrix[2, 2:] = -(far + near) / (far - near), -2 * far * near / (far - near)

        flat = self(points)[:, :2]
        # Vertices behind the camera are not in the picture, but faces that reach there may be.
        self._bounds = None if np.isnan(flat).any() else (*flat.min(axis=0), *flat.max(axis=0))

    def meets(self, part: tuple[float, float, float, float]) -> bool:
        """Whether the points' bounding box reaches into a part (left, right, bottom, top) of the picture."""
        if self._bounds is None:
            return True
        left, right, bottom, top = part
        x, y, x_end, y_end = self._bounds
        return bool(x <= right and x_end >= left and y <= top and y_end >= bottom)

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) points to (n, 3): x, y, -1 … 1 inside the picture, and the distance along the line of sight."""
        local = points @ self.view[:3, :3].T + self.view[:3, 3]
        depth = -local[:, 2]
        safe = np.where(depth > 0, depth, np.nan)
        return np.column_stack([self.matrix[0, 0] * local[:, 0] / safe, self.matrix[1, 1] * local[:, 1] / safe, depth])


def standard_camera(points: np.ndarray, aspect: float, view: str = "home", margins: Margins | None = None) -> Camera:
    """The camera that sees points (n, 3) from a standard view so that they just fill a panel of this aspect."""
    checked_view(view)
    direction, up = (np.array(v, float) for v in DIRECTIONS[view])
    if view == "home" and is_flat(points):
        direction = np.array([0.0, 0, 1])  # a flat domain is looked at straight
    return _aim(points, aspect, direction, up, margins or Margins())


def is_flat(points: np.ndarray) -> bool:
    """Whether points (n, 3) lie in a plane of constant z."""
    return bool(np.ptp(points[:, 2]) <= 1e-6 * np.ptp(points, axis=0).max())


def place_camera(
    camera: vtkCamera, points: np.ndarray, aspect: float, view: str = "home", margins: Margins | None = None
) -> None:
    """Let the window's camera look at points (n, 3) from a standard view; they fill a panel of this aspect."""
    margins = margins or Margins()
    _set(camera, standard_camera(points, aspect, view, margins), margins)


def camera_seen(camera: vtkCamera, aspect: float, margins: Margins | None = None) -> Camera:
    """The window's camera written down; it is sure to see what lies between the panel's margins."""
    margins = margins or Margins()
    slope = np.tan(np.radians(camera.GetViewAngle() / 2))
    extent = slope * aspect * (1 - 2 * margins.side), slope * (1 - margins.top - margins.bottom)
    return Camera(
        _vector(camera.GetPosition()), _vector(camera.GetFocalPoint()), _vector(camera.GetViewUp()), _pair(extent)
    )


def _set(camera: vtkCamera, found: Camera, margins: Margins) -> None:
    camera.SetViewAngle(VIEW_ANGLE)
    camera.SetFocalPoint(*found.focal_point)
    camera.SetPosition(*found.position)
    camera.SetViewUp(*found.up)
    camera.SetWindowCenter(0, margins.top - margins.bottom)


def show_camera(camera: vtkCamera, shown: Camera, aspect: float, margins: Margins | None = None) -> None:
    """Let the window's camera, in a panel of this aspect, see at least what another was sure to see."""
    margins = margins or Margins()
    _set(camera, shown, margins)
    high = shown.extent[1] / (1 - margins.top - margins.bottom)
    slope = max(high, shown.extent[0] / (aspect * (1 - 2 * margins.side)))
    camera.SetViewAngle(float(np.degrees(2 * np.arctan(slope))))


def _aim(points: np.ndarray, aspect: float, direction: np.ndarray, up: np.ndarray, margins: Margins) -> Camera:
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
    return Camera(_vector(middle + distance * back), _vector(middle), _vector(up), _pair((wide, high)))


def _vector(values) -> Vector:
    x, y, z = values
    return float(x), float(y), float(z)


def _pair(values) -> tuple[float, float]:
    x, y = values
    return float(x), float(y)
