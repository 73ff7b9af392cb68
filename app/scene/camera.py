"""Cameras: standard views, fitted closely around the shape, and what they see of a point."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkCamera

from bihdist_core import Surface
from bihdist_core.analysis.first_view import is_flat
from bihdist_core.analysis.upright import axes_of
from bihdist_core.analysis.view_directions import OBLIQUE_VIEWS
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.surface import connected

from ..document.camera import ANATOMICAL, Camera, Vector, checked_view

VIEW_ANGLE = 25.0

DIRECTIONS = {
    **{name: (direction, (0, 1, 0)) for name, direction in OBLIQUE_VIEWS.items()},
    "front": ((0, 0, 1), (0, 1, 0)),
    "back": ((0, 0, -1), (0, 1, 0)),
    "left": ((-1, 0, 0), (0, 1, 0)),
    "right": ((1, 0, 0), (0, 1, 0)),
    "top": ((0, 1, 0), (0, 0, -1)),
    "bottom": ((0, -1, 0), (0, 0, 1)),
    # Of a brain in RAS, whose z is up and whose front is on the other side, see `directions`.
    "anterior": ((0, 0, -1), (0, 1, 0)),
    "posterior": ((0, 0, 1), (0, 1, 0)),
    "dorsal": ((0, 1, 0), (0, 0, -1)),
    "ventral": ((0, -1, 0), (0, 0, -1)),
    **dict.fromkeys(("lateral-left", "medial-right"), ((-1, 0, 0), (0, 1, 0))),
    **dict.fromkeys(("medial-left", "lateral-right"), ((1, 0, 0), (0, 1, 0))),
    "relief": ((-0.35, -1.0, 0.75), (0, 0, 1)),
}
"""Of the standard views where y is up: from the shape to the camera, and which way is up."""

NEIGHBOURHOOD = 0.08
"""The share of the shape's diagonal over which the direction outwards is averaged."""

SOME = 50_000
"""Faces that tell of a large surface which side is outside."""


MARGIN = 0.05
"""Usual fraction of a panel that is kept free along each side of the shape."""


def frame(camera: Camera) -> FloatArray:
    """Return the camera's axes as columns (3, 3): right, up, and back to the camera."""
    back = np.subtract(camera.position, camera.focal_point)
    back = back / np.linalg.norm(back)
    right = np.cross(np.array(camera.up) / np.linalg.norm(camera.up), back)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(back, right), back], 1)


def turned(camera: Camera, degrees: float, axis: FloatArray) -> Camera:
    """Return the camera gone round its focal point, about an axis (3,)."""
    a, axis = np.radians(degrees), np.asarray(axis, float) / np.linalg.norm(axis)

    def turn(arm: AnyArray) -> FloatArray:
        turned: FloatArray = arm * np.cos(a) + np.cross(axis, arm) * np.sin(a) + axis * (axis @ arm) * (1 - np.cos(a))
        return turned

    arm = turn(np.subtract(camera.position, camera.focal_point))
    up = turn(np.array(camera.up))
    return replace(camera, position=_vector(np.add(camera.focal_point, arm)), up=_vector(up))


def follow_camera(other: Camera, before: Camera, after: Camera) -> Camera:
    """Return another camera after it has followed one that goes from before to after.

    It moves by the same similarity, seen from where it stands: both turn alike in their pictures, and come nearer or
    move aside by the same fractions of the sizes of their shapes.
    """
    turn = frame(other) @ frame(before).T
    arms = [np.linalg.norm(np.subtract(each.position, each.focal_point)) for each in (other, before)]
    scale = float(arms[0] / arms[1])

    def place(point: Vector) -> Vector:
        return _vector(np.array(other.focal_point) + scale * (turn @ np.subtract(point, before.focal_point)))

    extent = tuple(e * new / old for e, new, old in zip(other.extent, after.extent, before.extent, strict=True))
    up = _vector(turn @ np.array(after.up))
    return Camera(place(after.position), place(after.focal_point), up, _pair(extent))


class Projection:
    """The projection of points into a picture by a camera.

    Parameters
    ----------
    aspect
        Width by height of the picture.
    points
        (n, 3) points of the shape, between which and the camera nothing is clipped.
    free
        Fraction of each side that is left free around what the camera is sure to see.
    is_parallel
        Whether the lines of sight are parallel; everything is then seen as in the focal point's plane.

    Attributes
    ----------
    view
        (4, 4) from the world's to the camera's coordinates.
    matrix
        (4, 4) from the camera's coordinates to -1 … 1 in x, y and depth.
    """

    def __init__(
        self, camera: Camera, aspect: float, points: FloatArray, free: float = 0.0, is_parallel: bool = False
    ) -> None:
        axes, self.position = frame(camera), np.array(camera.position, float)
        self.is_parallel, self.back = is_parallel, axes[:, 2]
        high = max(camera.extent[1], camera.extent[0] / aspect) / (1 - 2 * free)
        depth = -(points @ self.back - self.position @ self.back)
        if is_parallel:
            high *= float(np.linalg.norm(np.subtract(camera.position, camera.focal_point)))
            # It may as well stand farther back, with all of the shape before it.
            aside = max(0.0, 0.05 * float(np.ptp(depth)) + 0.1 * high - float(depth.min()))
            self.position, depth = self.position + aside * self.back, depth + aside
        self.view = np.eye(4)
        self.view[:3, :3], self.view[:3, 3] = axes.T, -axes.T @ self.position
        far = max(float(depth.max()), 1e-12) * 1.01
        near = max(float(depth.min()) * 0.99, far * 1e-4)
        self.matrix = np.zeros((4, 4))
        self.matrix[0, 0], self.matrix[1, 1] = 1 / (high * aspect), 1 / high
        if is_parallel:
            self.matrix[2, 2:], self.matrix[3, 3] = (-2 / (far - near), -(far + near) / (far - near)), 1
        else:
            self.matrix[2, 2:] = -(far + near) / (far - near), -2 * far * near / (far - near)
            self.matrix[3, 2] = -1

        flat = self(points)[:, :2]
        # Vertices behind the camera are not in the picture, but faces that reach there may be.
        self._bounds = None if np.isnan(flat).any() else (*flat.min(axis=0), *flat.max(axis=0))

    def meets(self, part: tuple[float, float, float, float]) -> bool:
        """Return whether the points' bounding box reaches into a part (left, right, bottom, top) of the picture."""
        if self._bounds is None:
            return True
        left, right, bottom, top = part
        x, y, x_end, y_end = self._bounds
        return bool(x <= right and x_end >= left and y <= top and y_end >= bottom)

    def __call__(self, points: FloatArray) -> FloatArray:
        """Return x and y of points (n, 3), -1 … 1 inside the picture, and their distance along the line of sight."""
        local = points @ self.view[:3, :3].T + self.view[:3, 3]
        depth = -local[:, 2]
        safe = np.where(depth > 0, 1.0 if self.is_parallel else depth, np.nan)
        return np.column_stack([self.matrix[0, 0] * local[:, 0] / safe, self.matrix[1, 1] * local[:, 1] / safe, depth])

    def pixel_at(self, depth: float, width: float) -> float:
        """Return the length of a pixel of a picture of this width at a depth."""
        return float((1.0 if self.is_parallel else depth) / (self.matrix[0, 0] * width / 2))


def standard_camera(
    points: FloatArray,
    aspect: float,
    view: str = "home",
    up: str = "y",
    outwards: FloatArray | None = None,
    is_parallel: bool = False,
    margin: float = MARGIN,
) -> Camera:
    """Return the camera that sees points (n, 3) from a standard view so that they just fill a panel.

    Parameters
    ----------
    aspect
        Width by height of the panel.
    up
        The axis that is up.
    outwards
        (3,) normal at the source, see `outwards_at`, for the view from there; without it the source is seen from home.
    margin
        Fraction of the panel that is kept free along each side.
    """
    direction, upright = directions(view, up, outwards)
    if view == "home" and is_flat(points) and up[-1] != "z":
        direction = np.array([0.0, 0, 1])  # a flat domain is looked at straight
    return aimed(points, aspect, direction, upright, margin, is_parallel)


def directions(view: str, up: str = "y", outwards: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
    """Return, for a standard view, the direction (3,) from the shape to the camera, and what is up (3,)."""
    checked_view(view)
    if view == "relief":
        return np.array(DIRECTIONS[view][0], float), np.array(DIRECTIONS[view][1], float)
    turn = axes_of("z" if view in ANATOMICAL else up)
    _, upright, front = turn.T
    if view == "source" and outwards is not None:
        # From above or below, what is at the back is up, as in the views from there.
        is_steep = abs(float(outwards @ upright)) > np.cos(np.radians(5.0))
        return outwards, np.sign(outwards @ upright) * -front if is_steep else upright
    direction, above = DIRECTIONS["home" if view in ("auto", "source") else view]
    return turn @ np.array(direction, float), turn @ np.array(above, float)


def outwards_at(surface: Surface, vertex: int) -> FloatArray | None:
    """Return the unit normal (3,) that points out of a surface, averaged about a vertex; None where there is none."""
    x, faces = surface.vertices, surface.shape.faces
    used = x[surface.component_of_vertex >= 0]
    reach = NEIGHBOURHOOD * float(np.linalg.norm(np.ptp(used, axis=0)))
    near = np.linalg.norm(x - x[vertex], axis=1) <= reach
    near[vertex] = True
    about = faces[near[faces].any(axis=1)]
    normals = _area_normals(x[about])
    own = normals[(about == vertex).any(axis=1)].sum(axis=0)
    # Of what is near, also the other side of something thin, only what hangs together and faces alike.
    ids, place = np.unique(about, return_inverse=True)
    place = place.reshape(-1, 3)
    piece = connected(place[:, [[0, 1], [1, 2]]].reshape(-1, 2).T, len(ids))
    is_own = piece[place[:, 0]] == piece[np.searchsorted(ids, vertex)]
    total = normals[is_own & (normals @ own > 0)].sum(axis=0)
    # Normals that point inwards make the volume negative; of many faces some tell that as well.
    corners = x[faces[:: max(1, len(faces) // SOME)]] - used.mean(axis=0)
    volume = float(np.einsum("ij,ij->", corners.sum(axis=1), _area_normals(corners)))
    length = float(np.linalg.norm(total))
    return None if length <= 0 else total / length * (-1.0 if volume < 0 else 1.0)


def _area_normals(corners: FloatArray) -> FloatArray:
    """Return normals (m, 3) of faces (m, 3, 3), twice as long as the faces' areas."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


class SeenNow:
    """The positions of points in a picture of this aspect by the window's present camera; else as `Projection`."""

    def __init__(self, camera: vtkCamera, aspect: float) -> None:
        self.view = array_of(camera.GetViewTransformMatrix())
        self.matrix = array_of(camera.GetProjectionTransformMatrix(aspect, -1, 1))

    def in_picture(self, points: FloatArray) -> FloatArray:
        """Return the positions of points (n, 3) in the picture and in depth, -1 to 1; NaN behind the camera."""
        flat = np.column_stack([points, np.ones(len(points))]) @ (self.matrix @ self.view).T
        return flat[:, :3] / np.where(flat[:, 3] > 0, flat[:, 3], np.nan)[:, None]

    def __call__(self, points: FloatArray) -> FloatArray:
        """Return x, y and depth (n, 3) of points (n, 3), see `Projection`; x and y are NaN behind the camera."""
        return np.column_stack([self.in_picture(points)[:, :2], -points @ self.view[2, :3] - self.view[2, 3]])


def array_of(matrix: vtkMatrix4x4) -> FloatArray:
    """Return a matrix of VTK as an array (4, 4)."""
    return np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])


def see_part(camera: vtkCamera, projection: FloatArray, part: tuple[float, float, float, float]) -> None:
    """Let a camera see a part (left, right, bottom, top) of what a projection matrix (4, 4) shows from -1 to 1."""
    left, right, bottom, top = part
    enlarge = np.diag([2 / (right - left), 2 / (top - bottom), 1.0, 1.0])
    enlarge[0, 3], enlarge[1, 3] = -(right + left) / (right - left), -(top + bottom) / (top - bottom)
    matrix = vtkMatrix4x4()
    matrix.DeepCopy((enlarge @ projection).ravel().tolist())
    camera.UseExplicitProjectionTransformMatrixOn()
    camera.SetExplicitProjectionTransformMatrix(matrix)


def camera_seen(camera: vtkCamera, aspect: float) -> Camera:
    """Return the window's camera written down; it is sure to see what lies between the panel's margins."""
    slope = np.tan(np.radians(camera.GetViewAngle() / 2))
    extent = slope * aspect * (1 - 2 * MARGIN), slope * (1 - 2 * MARGIN)
    focal_point = np.array(camera.GetFocalPoint())
    arm = np.array(camera.GetPosition()) - focal_point
    if camera.GetParallelProjection():
        # Where it stands says nothing about what it sees: `stand_back` may have moved it.
        arm *= camera.GetParallelScale() / slope / np.linalg.norm(arm)
    return Camera(_vector(focal_point + arm), _vector(focal_point), _vector(camera.GetViewUp()), _pair(extent))


def show_camera(camera: vtkCamera, shown: Camera, aspect: float, is_parallel: bool = False) -> None:
    """Let the window's camera, in a panel of this aspect, see at least what another was sure to see."""
    slope = max(shown.extent[1], shown.extent[0] / aspect) / (1 - 2 * MARGIN)
    camera.SetFocalPoint(*shown.focal_point)
    camera.SetPosition(*shown.position)
    camera.SetViewUp(*shown.up)
    camera.SetViewAngle(float(np.degrees(2 * np.arctan(slope))))
    camera.SetParallelProjection(is_parallel)
    camera.SetParallelScale(slope * float(np.linalg.norm(np.subtract(shown.position, shown.focal_point))))


def stand_back(camera: vtkCamera, bounds: Sequence[float]) -> None:
    """Let a camera whose lines of sight are parallel have all of what is in the bounds before it.

    VTK draws nothing behind a camera; what this one sees does not depend on how far it stands back.
    """
    if not camera.GetParallelProjection():
        return
    along, position = np.array(camera.GetDirectionOfProjection()), np.array(camera.GetPosition())
    corners = np.stack(np.meshgrid(bounds[:2], bounds[2:4], bounds[4:6]), -1).reshape(-1, 3)
    size = float(np.linalg.norm(np.ptp(corners, axis=0)))
    nearest = float(((corners - position) @ along).min())
    if not 0.01 * size <= nearest <= 10 * size:
        ahead = nearest - 0.1 * size
        before = float((np.array(camera.GetFocalPoint()) - position) @ along)
        # The focal point stays before it too.
        camera.SetPosition(*(position + min(ahead, before - 0.1 * size) * along))


def aimed(
    points: FloatArray,
    aspect: float,
    direction: FloatArray,
    up: FloatArray,
    margin: float,
    is_parallel: bool = False,
) -> Camera:
    """Look at points (n, 3) along -direction, as near as they fit."""
    back = direction / np.linalg.norm(direction)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    frame = np.stack([right, up, back], 1)
    # Each coordinate for itself: over contiguous memory every step is several times faster.
    local = np.ascontiguousarray((points @ frame).T)
    slope = np.tan(np.radians(VIEW_ANGLE / 2))
    wide, high = slope * aspect * (1 - 2 * margin), slope * (1 - 2 * margin)
    centre = (local.min(axis=1) + local.max(axis=1)) / 2
    half = np.ptp(local, axis=1) / 2
    distance = max(half[0] / wide, half[1] / high, 1e-12)
    # With the camera at distance D before the centre, a point at (x, y, z) is seen at x / (D - z).  The nearest D
    # that keeps all points between the margins depends on the centre and the centre on D: a few rounds settle both.
    for _ in range(0 if is_parallel else 4):
        x, y, z = local - centre[:, None]
        distance = max((np.abs(x) / wide + z).max(), (np.abs(y) / high + z).max(), 1e-12)
        seen = np.stack([x, y]) / np.maximum(distance - z, 1e-12)
        centre[:2] += distance * (seen.min(axis=1) + seen.max(axis=1)) / 2
    middle = frame @ centre
    return Camera(_vector(middle + distance * back), _vector(middle), _vector(up), _pair((wide, high)))


def _vector(values: Iterable[float]) -> Vector:
    x, y, z = values
    return float(x), float(y), float(z)


def _pair(values: Iterable[float]) -> tuple[float, float]:
    x, y = values
    return float(x), float(y)
