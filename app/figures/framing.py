"""The framing of a figure's views: their surfaces, cameras, and how much of a picture the shape takes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.first_view import is_flat
from bihdist_core.arrays import FloatArray

from ..document.camera import Camera, View
from ..drawing.shapes import Box
from ..scene.camera import Projection, outwards_at, standard_camera
from ..scene.clipping import clip_plane
from ..scene.drawable import bounds_of, rise, warp_by_scalar
from .description import FigurePanel
from .hidden_lines import cut_faces
from .shadows import shadow_edge

FREE = 0.03
"""The share of a view left free along each side."""

EDGE = 3.0
"""Units left around a shape that is cropped, for marks and lines at its edge."""

MOST_PLACES = 4000
"""Most places of a surface that are tried to find what an inset would hide."""


@dataclass(frozen=True)
class Seen:
    """The part (left, right, bottom, top) that the shape takes of a square picture, which runs from -1 to 1."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def aspect(self) -> float:
        """Width by height."""
        return (self.right - self.left) / (self.top - self.bottom)


def shown_surface(panel: FigurePanel, top: float) -> Surface:
    """Return the surface, or the height field of its field."""
    if not panel.warp_factor or panel.field is None:
        return panel.surface
    up = rise(bounds_of(_used(panel.surface)), panel.warp_factor)
    return warp_by_scalar(panel.surface, panel.field, top, up)


def shown_surfaces(panel: FigurePanel, top: float) -> tuple[Surface, ...]:
    """Return what each view of a panel shows."""
    return panel.parts or (shown_surface(panel, top),) * len(panel.views)


def camera_of(view: View, panel: FigurePanel, surface: Surface, aspect: float) -> Camera:
    """Return the camera of a view of a panel in a picture of width / height `aspect`."""
    if isinstance(view, Camera):
        return view
    name = "relief" if panel.warp_factor and view == "home" else view
    outwards = outwards_at(surface, panel.source) if name == "source" and panel.source is not None else None
    return standard_camera(_framed(panel, surface), aspect, name, panel.up, outwards, panel.is_parallel, margin=0.0)


def seen(view: View, panel: FigurePanel, surface: Surface) -> Seen:
    """Return the part of a square picture that the shape takes, as far as the camera is sure to see it."""
    flat, (across, up) = _flat(view, panel, surface)
    if not np.isfinite(flat).all():
        return Seen(-across, across, -up, up)
    (x, y), (x_end, y_end) = flat.min(axis=0), flat.max(axis=0)
    found = Seen(max(x, -across), min(x_end, across), max(y, -up), min(y_end, up))
    if found.right - found.left < 1e-3 or found.top - found.bottom < 1e-3:
        return Seen(-across, across, -up, up)
    return found


def height_for(width: float, view: View, panel: FigurePanel, surface: Surface) -> float:
    """Return the height from which on a box of this width shows all of the shape that higher ones would."""
    flat, (across, up) = _flat(view, panel, surface)
    if not np.isfinite(flat).all():
        return np.inf
    if not isinstance(view, Camera):
        wide, high = np.ptp(flat, axis=0)
        # The space that is left free beside a flat shape is too little above it.
        return float(width * high / wide) + 4 * FREE * width if wide > 1e-3 else np.inf
    return float(width * max(np.abs(flat[:, 1]).max(), up) / across) + 2 * FREE * width


def _flat(view: View, panel: FigurePanel, surface: Surface) -> tuple[FloatArray, tuple[float, float]]:
    """Return the vertices of faces (k, 2) in a square picture, and how much of it across and up is sure to be seen."""
    camera = camera_of(view, panel, surface, 1.0)
    projection, longest = Projection(camera, 1.0, surface.vertices, 0.0, panel.is_parallel), max(camera.extent)
    return projection(_framed(panel, surface))[:, :2], (camera.extent[0] / longest, camera.extent[1] / longest)


def places(surface: Surface) -> FloatArray:
    """Return places (k, 3) all over a surface: the middles of faces, or of every so many."""
    faces = surface.shape.faces
    faces = faces[:: max(len(faces) // MOST_PLACES, 1)]
    middles: FloatArray = surface.vertices[faces].mean(axis=1)
    return middles


def _used(surface: Surface) -> FloatArray:
    return surface.vertices[surface.component_of_vertex >= 0]


def _framed(panel: FigurePanel, surface: Surface) -> FloatArray:
    """Return the points that have room in a picture: corners of what is left of faces, and the ground about them."""
    used = _used(surface)
    about = shadow_edge(used, panel.up) if has_ground(panel) else np.empty((0, 3))
    plane = clip_plane(panel.clip, panel.surface if panel.parts else surface)
    if plane is not None:
        x, faces = surface.shape.vertices, surface.shape.faces
        x, faces, _ = cut_faces(x, faces, np.arange(len(faces)), plane.depths(x))
        used = x[np.unique(faces)]
    return np.concatenate([used, about])


def has_ground(panel: FigurePanel) -> bool:
    """Return whether a panel shows a shadow on the ground."""
    return panel.ground and not is_flat(_used(panel.surface))


class Framed:
    """A view in a box of the page, which maps points of the surface to the page.

    Parameters
    ----------
    part
        What of a square picture the box shows, with a little space around it; None to fit the camera to the box.

    Attributes
    ----------
    whole
        The box that the whole of the camera's picture takes, which may be larger.
    depth
        The distance from the camera to what it looks at.
    """

    def __init__(self, view: View, panel: FigurePanel, surface: Surface, box: Box, part: Seen | None) -> None:
        camera = camera_of(view, panel, surface, box.width / box.height if part is None else 1.0)
        self.depth = math.dist(camera.position, camera.focal_point)
        if part is None:
            self.whole = box
            self.projection = Projection(camera, box.width / box.height, surface.vertices, FREE, panel.is_parallel)
            return
        room = box.without(EDGE)
        half = min(room.width / (part.right - part.left), room.height / (part.top - part.bottom))
        x = box.middle[0] - half * (1 + (part.left + part.right) / 2)
        y = box.middle[1] - half * (1 - (part.bottom + part.top) / 2)
        self.whole = Box(x, y, 2 * half, 2 * half)
        self.projection = Projection(camera, 1.0, surface.vertices, 0.0, panel.is_parallel)

    def places(self, points: FloatArray) -> FloatArray:
        """Return the positions (k, 2) of points (k, 3) on the page; NaN behind the camera."""
        flat = self.projection(points)
        x = self.whole.x + (flat[:, 0] + 1) / 2 * self.whole.width
        return np.column_stack([x, self.whole.y + (1 - flat[:, 1]) / 2 * self.whole.height])
