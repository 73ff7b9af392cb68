"""What the views of a figure's panels see: their surfaces, cameras, and how much of a picture the shape takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import FloatArray

from ..document.camera import Camera, View
from ..scene.camera import Margins, Projection, outwards_at, standard_camera
from ..scene.height_field import rise, warp_by_scalar
from .boxes import Box
from .description import FigurePanel

FREE = 0.03
"""The share of a view left free along each side."""

EDGE = 3.0
"""Units left around a shape that is cropped, for marks and lines at its edge."""

NO_MARGINS = Margins(side=0.0, top=0.0, bottom=0.0)

MOST_PLACES = 4000
"""By which it is found out what an inset would hide."""


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
    """The surface, or the height field of its field."""
    if not panel.height or panel.field is None:
        return panel.surface
    used = _used(panel.surface)
    bounds = np.stack([used.min(axis=0), used.max(axis=0)], axis=1).ravel().tolist()
    return warp_by_scalar(panel.surface, panel.field, top, rise(bounds, panel.height))


def camera_of(view: View, panel: FigurePanel, surface: Surface, aspect: float) -> Camera:
    """The camera of a view of a panel in a picture of width / height `aspect`."""
    if isinstance(view, Camera):
        return view
    name = "relief" if panel.height and view == "home" else view
    outwards = outwards_at(surface, panel.source) if name == "source" and panel.source is not None else None
    return standard_camera(_used(surface), aspect, name, NO_MARGINS, panel.up, outwards, panel.is_parallel)


def seen(view: View, panel: FigurePanel, surface: Surface) -> Seen:
    """How much of a square picture the shape takes, as far as the camera is sure to see it."""
    camera = camera_of(view, panel, surface, 1.0)
    flat = Projection(camera, 1.0, surface.vertices, 0.0, panel.is_parallel)(_used(surface))[:, :2]
    across, up = (side / max(camera.extent) for side in camera.extent)
    if not np.isfinite(flat).all():
        return Seen(-across, across, -up, up)
    (x, y), (x_end, y_end) = flat.min(axis=0), flat.max(axis=0)
    found = Seen(max(x, -across), min(x_end, across), max(y, -up), min(y_end, up))
    if found.right - found.left < 1e-3 or found.top - found.bottom < 1e-3:
        return Seen(-across, across, -up, up)
    return found


def height_for(width: float, view: View, panel: FigurePanel, surface: Surface) -> float:
    """How high a box of this width is that shows all of the shape that higher ones would."""
    camera = camera_of(view, panel, surface, 1.0)
    flat = Projection(camera, 1.0, surface.vertices, 0.0, panel.is_parallel)(_used(surface))[:, :2]
    if not np.isfinite(flat).all():
        return np.inf
    if not isinstance(view, Camera):
        wide, high = np.ptp(flat, axis=0)
        # The space that is left free beside a flat shape is too little above it.
        return float(width * high / wide) + 4 * FREE * width if wide > 1e-3 else np.inf
    across, up = (side / max(camera.extent) for side in camera.extent)
    return float(width * max(np.abs(flat[:, 1]).max(), up) / across) + 2 * FREE * width


def places(surface: Surface) -> FloatArray:
    """(k, 3) places all over a surface: middles of faces, or of every so many."""
    faces = surface.faces[:: max(len(surface.faces) // MOST_PLACES, 1)]
    middles: FloatArray = surface.vertices[faces].mean(axis=1)
    return middles


def _used(surface: Surface) -> FloatArray:
    return surface.vertices[surface.component_of_vertex >= 0]


class Framed:
    """A view in a box of the page: what its camera makes of points there.

    part: what of a square picture the box shows, with a little space around it; None to fit the camera to the box.
    whole: the box of the page that the whole of the camera's picture takes, which may be larger.
    """

    def __init__(self, view: View, panel: FigurePanel, surface: Surface, box: Box, part: Seen | None) -> None:
        if part is None:
            self.whole = box
            camera = camera_of(view, panel, surface, box.width / box.height)
            self.projection = Projection(camera, box.width / box.height, surface.vertices, FREE, panel.is_parallel)
            return
        room = box.without(EDGE)
        half = min(room.width / (part.right - part.left), room.height / (part.top - part.bottom))
        x = box.middle[0] - half * (1 + (part.left + part.right) / 2)
        y = box.middle[1] - half * (1 - (part.bottom + part.top) / 2)
        self.whole = Box(x, y, 2 * half, 2 * half)
        self.projection = Projection(
            camera_of(view, panel, surface, 1.0), 1.0, surface.vertices, 0.0, panel.is_parallel
        )

    def places(self, points: FloatArray) -> FloatArray:
        """(k, 2) where points (k, 3) stand on the page; NaN behind the camera."""
        flat = self.projection(points)
        x = self.whole.x + (flat[:, 0] + 1) / 2 * self.whole.width
        return np.column_stack([x, self.whole.y + (1 - flat[:, 1]) / 2 * self.whole.height])
