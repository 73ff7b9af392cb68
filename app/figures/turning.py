"""Cameras around a turning shape, and frames as large as what turns, and no larger."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.first_view import is_flat
from bihdist_core.analysis.view_directions import OBLIQUE_VIEWS
from bihdist_core.arrays import FloatArray

from ..document.camera import Camera, View
from ..scene.camera import VIEW_ANGLE, Projection, directions, outwards_at, standard_camera, turned
from ..scene.drawable import bounds_of, rise
from ..scene.picking import FaceBlocks
from .description import Figure
from .grid import grid_of
from .layout import lay_out
from .size import Size

STEP = 10
"""Degrees between the angles that are looked at."""

FLATTEST, STEEPEST = 2.5, 0.5
"""Width by height of a view, at most and at least."""

NARROWEST = 0.6
"""Least fraction of a view's usual width, where a high shape takes less."""

SEEN_ALSO_DEG = 15
"""Degrees by which a place that is well seen may be turned either way, and is still seen."""


def start_and_axis(
    view: View,
    surface: Surface,
    span: tuple[float, float],
    height: float,
    looks: Sequence[tuple[float, int]],
    up: str = "y",
    is_parallel: bool = False,
) -> tuple[Camera, FloatArray]:
    """Return the camera at 0 degrees, whose extent holds the shape while it turns, and the axis (3,) of the turn.

    Parameters
    ----------
    span
        The least and the largest angle of the turn, in degrees.
    height
        Of a height field.
    looks
        Angles with the sources there, of which as many as possible are seen where no view was chosen.
    up
        The axis that is up.
    is_parallel
        Whether the projection is parallel.
    """
    points = surface.vertices[surface.component_of_vertex >= 0]
    if height:
        points = np.concatenate([points, points + np.array([0.0, 0.0, rise(bounds_of(points), height)])])
    if isinstance(view, Camera):
        axis, camera = np.array(view.up), view
        extent = _swept(camera, axis, points, span, is_parallel)
        if not any(span):  # no more than was chosen
            extent = tuple(np.minimum(extent, view.extent))
        return replace(camera, extent=extent), axis
    name = "relief" if height and view == "home" else view
    outwards = outwards_at(surface, looks[0][1]) if name == "source" and looks else None
    axis = directions(name, up, outwards)[1]
    camera = standard_camera(points, 1.0, name, up, outwards, is_parallel)
    if any(span):
        camera = _about(camera, axis, points)
    if view in OBLIQUE_VIEWS and looks and not is_flat(points):
        camera = turned(camera, _facing(camera, axis, surface, looks), axis)
    return replace(camera, extent=_swept(camera, axis, points, span, is_parallel)), axis


def fitted_size(figure: Figure, extent: tuple[float, float]) -> Size:
    """Return the size of a figure whose views have the shape of an extent, as far as its own leaves that open."""
    size, layout = figure.size, lay_out(figure)
    scale, dpi = layout.scale, 96 * layout.scale
    if size.height is not None or not 10 <= dpi <= 2400:
        return size
    grid = grid_of(figure)
    rows, columns = grid.rows, grid.columns
    aspect = min(max(extent[0] / extent[1], STEEPEST), FLATTEST)
    box = layout.cells[0].views[0]
    width = layout.width
    if size.width is None:  # what is high becomes narrow, and the page no higher, as long as there is room for words
        views = len(figure.panels[0].views)
        narrower = box.width - max(min(box.height * aspect, box.width), box.width * NARROWEST)
        width -= columns * views * narrower
        figure = replace(figure, size=Size(width * scale, layout.height * scale, "px", dpi))
        layout = lay_out(figure)
        box = layout.cells[0].views[0]
    height = layout.height + rows * (box.width / aspect - box.height)
    if size.width is None:
        height = min(height, lay_out(figure).height)
    return Size(float(round(width * scale)), float(round(height * scale)), "px", dpi)


def _about(camera: Camera, axis: FloatArray, points: FloatArray) -> Camera:
    """Return the camera at the middle of the shape, far enough to see it from everywhere round an axis."""
    axis = axis / np.linalg.norm(axis)
    along = points @ axis
    across = points - along[:, None] * axis
    middle = _centre(across) + axis * (along.min() + along.max()) / 2
    radius = float(np.linalg.norm(points - middle, axis=1).max())
    back = np.subtract(camera.position, camera.focal_point)
    back = back / np.linalg.norm(back) * radius / np.sin(np.radians(VIEW_ANGLE / 2))
    x, y, z = (float(number) for number in middle)
    a, b, c = (float(number) for number in middle + back)
    return replace(camera, position=(a, b, c), focal_point=(x, y, z))


def _centre(points: FloatArray) -> FloatArray:
    """Return about the middle (3,) of the smallest ball round points (n, 3), by ever smaller steps to the farthest."""
    middle: FloatArray = (points.min(axis=0) + points.max(axis=0)) / 2
    for k in range(2, 60):
        farthest = points[((points - middle) ** 2).sum(axis=1).argmax()]
        middle = middle + (farthest - middle) / k**1.5
    return middle


def _swept(
    camera: Camera, axis: FloatArray, points: FloatArray, span: tuple[float, float], is_parallel: bool
) -> tuple[float, float]:
    """Return the extent that holds points (n, 3) at all angles of a turn."""
    low, high = span[0], min(span[1], span[0] + 360)
    wide = tall = 0.0
    for degrees in np.append(np.arange(low, high, STEP), high):
        whole = replace(turned(camera, float(degrees), axis), extent=(1.0, 1.0))
        seen = np.abs(Projection(whole, 1.0, points, 0.0, is_parallel)(points))
        wide, tall = max(wide, float(np.nanmax(seen[:, 0]))), max(tall, float(np.nanmax(seen[:, 1])))
    return wide, tall


def _facing(camera: Camera, axis: FloatArray, surface: Surface, looks: Sequence[tuple[float, int]]) -> float:
    """Return the least turn, in degrees, after which most of the looks show their vertices well."""
    blocks = FaceBlocks(surface.shape)
    tolerance = 1e-6 * float(np.linalg.norm(np.ptp(surface.vertices, axis=0)))

    def seen(degrees: float) -> int:
        return sum(
            blocks.sees(np.array(turned(camera, degrees + angle + more, axis).position), surface.vertices[v], tolerance)
            for angle, v in looks
            for more in (-SEEN_ALSO_DEG, 0, SEEN_ALSO_DEG)
        )

    return float(max(sorted(range(-180 + STEP, 181, STEP), key=abs), key=seen))
