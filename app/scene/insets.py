"""Insets of a panel in the window: places enlarged in its corners, seen by the panel's camera."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkActor2D,
    vtkCamera,
    vtkCoordinate,
    vtkPolyDataMapper2D,
    vtkProp3D,
    vtkRenderer,
)

from bihdist_core.arrays import FloatArray

from ..document.document import Zoom, isolines_in
from .camera import array_of
from .corners import SIDE, Rectangle, chosen_corners, corner_boxes, joins, source_box, taken_by
from .field_actor import FieldActor, light
from .levels import Levels
from .style import Style

if TYPE_CHECKING:
    from .panel_plotter import PanelPlotter

GAP = 4.0
"""Pixels (of which `scale` says how many the device has) between an inset and the sides of its view."""


@dataclass(frozen=True, eq=False)
class InsetPart:
    """Where an inset stands, and what it enlarges, in device pixels with y up; its isolines."""

    box: Rectangle
    source: Rectangle
    levels: Levels


class Insets:
    """Shows `actors` of a panel, its field and what others have added to its plotter once more for each zoom.

    scale: device pixels per pixel.
    """

    def __init__(
        self, plotter: "PanelPlotter", actors: Sequence[vtkActor], field: FieldActor, style: Style, scale: float
    ) -> None:
        self._plotter, self._main = plotter, plotter.renderer
        self._actors, self._style, self._scale = actors, style, scale
        self._zooms: tuple[Zoom, ...] = ()
        self._positions = np.empty((0, 3))
        self._corners: list[str] = []
        self._samples, self._marks = np.empty((0, 3)), np.empty((0, 3))
        self._is_settled = True
        self.renderers: list[vtkRenderer] = []
        self._in_sight: list[bool] = []
        self._field = field
        self._proportion = 1.0
        self._own: list[FieldActor | None] = []  # for those with isolines of their own
        self._added: list[vtkProp3D] = []
        self._frames = self._lines()
        plotter.add_own(self._frames)
        self._observer = self._main.AddObserver("StartEvent", lambda *_: self._place())

    def show(self, zooms: tuple[Zoom, ...], vertices: FloatArray) -> None:
        """These and no others; vertices (n, 3) of the surface."""
        if zooms != self._zooms:
            self._corners = [zoom.corner if zoom.corner != "auto" else "top right" for zoom in zooms]
        self._zooms = zooms
        self._positions = vertices[[zoom.vertex for zoom in zooms]] if zooms else np.empty((0, 3))
        window = self._main.GetRenderWindow()
        while len(self.renderers) > len(zooms):
            window.RemoveRenderer(self.renderers.pop())
        while len(self.renderers) < len(zooms):
            self.renderers.append(self._new_renderer())
            window.AddRenderer(self.renderers[-1])
        self._own += [None] * (len(zooms) - len(self._own))
        del self._own[len(zooms) :]
        for number, zoom in enumerate(zooms):
            self._let_own(number, zoom.isolines is not None)
        self._frames.SetVisibility(bool(zooms))

    def _let_own(self, number: int, is_own: bool) -> None:
        """Let an inset draw the panel's field, or one that follows it with isolines of its own."""
        renderer, before = self.renderers[number], self._own[number]
        if is_own == (before is not None):
            return
        own = before or FieldActor(self._style, self._scale)
        self._own[number] = own if is_own else None
        if is_own:
            own.set_scale(self._scale, self._proportion)
        for each, is_drawn in ((self._field, not is_own), (own, is_own)):
            for actor in (each.actor, each.stand_in.actor):
                renderer.AddActor(actor) if is_drawn else renderer.RemoveActor(actor)

    def _levels(self, number: int) -> Levels:
        return (self._own[number] or self._field).levels

    def set_proportion(self, share: float) -> None:
        """Let isolines of their own be of this share of their usual width."""
        self._proportion = share
        for own in self._own:
            if own is not None:
                own.set_scale(self._scale, share)

    @property
    def corners(self) -> tuple[str, ...]:
        """Where they stand."""
        return tuple(self._corners)

    @property
    def parts(self) -> list[InsetPart]:
        """Those that are in sight, as in the last picture."""
        boxes = self._boxes()
        found = enumerate(zip(self._corners, self._sources(), self._in_sight, strict=False)) if self._zooms else ()
        return [
            InsetPart(boxes[corner], source, self._levels(number))
            for number, (corner, source, is_seen) in found
            if is_seen
        ]

    def remove(self) -> None:
        """They are gone for good."""
        self.show((), self._positions)
        self._main.RemoveObserver(self._observer)

    def settle(self, samples: FloatArray, marks: FloatArray) -> None:
        """Put those that may stand in any corner where they hide the least.

        samples: (k, 3) all over the surface; marks: (k, 3) the marked places.  Called where the view is set, and not
        while it turns: insets would jump.  Done before the next picture, when the view has its size.
        """
        self._samples, self._marks, self._is_settled = samples, marks, False

    def renderer_at(self, x: float, y: float) -> vtkRenderer:
        """Whose picture is at a device pixel, y up: that of an inset, or of the panel."""
        for renderer, is_seen in zip(self.renderers, self._in_sight, strict=False):
            left, bottom = renderer.GetOrigin()
            width, height = renderer.GetSize()
            if is_seen and left <= x < left + width and bottom <= y < bottom + height:
                return renderer
        return self._main

    @property
    def placed(self) -> dict[vtkRenderer, tuple[int, int, int, int]]:
        """(left, bottom, width, height) in device pixels of those that are seen."""
        seen = [r for r, is_seen in zip(self.renderers, self._in_sight, strict=False) if is_seen]
        return {renderer: (*renderer.GetOrigin(), *renderer.GetSize()) for renderer in seen}

    # ------------------------------------------------------------------ where they are
    def _boxes(self) -> dict[str, Rectangle]:
        """By name: where an inset in a corner stands."""
        size = self._main.GetSize()
        return corner_boxes(size, round(SIDE * min(size)), GAP * self._scale)

    def _sources(self) -> list[Rectangle]:
        """What is enlarged."""
        side = round(SIDE * min(self._main.GetSize()))
        places = self._pixels(self._positions)
        return [source_box(place, side, zoom) for place, zoom in zip(places, self._zooms, strict=True)]

    def _pixels(self, points: FloatArray) -> FloatArray:
        """(k, 2) where points (k, 3) are seen; NaN behind the camera."""
        width, height = self._main.GetSize()
        local = np.column_stack([points, np.ones(len(points))]) @ self._matrix().T
        ahead = np.where(local[:, 3] > 0, local[:, 3], np.nan)
        pixels: FloatArray = (local[:, :2] / ahead[:, None] + 1) / 2 * (width, height)
        return pixels

    def _matrix(self) -> FloatArray:
        """(4, 4) from the world to -1 … 1 in the view."""
        camera = self._main.GetActiveCamera()
        return self._projection() @ array_of(camera.GetViewTransformMatrix())

    def _projection(self) -> FloatArray:
        width, height = self._main.GetSize()
        return array_of(self._main.GetActiveCamera().GetProjectionTransformMatrix(width / max(height, 1), -1, 1))

    # ------------------------------------------------------------------ drawing
    def _place(self) -> None:
        """Before each picture: see what the panel's camera sees now, of each place."""
        if not self._zooms or not all(self._main.GetSize()):
            return
        width, height = self._main.GetSize()
        boxes, sources, surface = self._boxes(), self._sources(), self._pixels(self._samples)
        if not self._is_settled:
            marks = self._pixels(self._marks)
            self._corners, self._is_settled = chosen_corners(self._zooms, boxes, sources, surface, marks), True
        self._follow_added()
        projection, loops = self._projection(), []
        is_taken = taken_by(surface, (width, height), [boxes[corner] for corner in self._corners])
        self._in_sight = []
        for zoom, own in zip(self._zooms, self._own, strict=True):
            if own is not None:
                own.follow(self._field, isolines_in(zoom, self._field.isolines))
        for renderer, corner, source in zip(self.renderers, self._corners, sources, strict=True):
            left, right, bottom, top = source
            is_seen = bool(left < width and right > 0 and bottom < height and top > 0)
            self._in_sight.append(is_seen)
            renderer.SetDraw(is_seen)
            if not is_seen:
                continue
            x, x_end, y, y_end = box = boxes[corner]
            renderer.SetViewport(x / width, y / height, x_end / width, y_end / height)
            _enlarge(renderer.GetActiveCamera(), self._main.GetActiveCamera(), projection, source, (width, height))
            loops += [*_rectangles(source, box), *joins(source, box, is_taken)]
        _draw(self._frames, loops)

    def _follow_added(self) -> None:
        """Show what others have added to the panel, and nothing that they have removed."""
        added = self._plotter.added
        for renderer in self.renderers:
            for actor in self._added:
                if actor not in added:
                    renderer.RemoveViewProp(actor)
            for actor in added:
                renderer.AddViewProp(actor)  # which does nothing where it is already
        self._added = added

    def _new_renderer(self) -> vtkRenderer:
        renderer = vtkRenderer()
        renderer.SetBackground(*self._style.background)
        renderer.GetCullers().RemoveAllItems()
        # The mouse turns the panel's camera, which this one follows.
        renderer.InteractiveOff()
        renderer.UseFXAAOn()
        renderer.DrawOff()  # until it has its place
        renderer.SetActiveCamera(vtkCamera())
        for actor in self._actors:
            renderer.AddActor(actor)
        frame = self._lines(normalized=True)
        _draw(frame, [np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [0, 0]])])
        renderer.AddActor(frame)
        light(renderer)
        return renderer

    def _lines(self, normalized: bool = False) -> vtkActor2D:
        """Lines on a view, in its pixels, or in shares of it."""
        mapper, where = vtkPolyDataMapper2D(), vtkCoordinate()
        if normalized:
            where.SetCoordinateSystemToNormalizedViewport()
        else:
            where.SetCoordinateSystemToViewport()
        mapper.SetTransformCoordinate(where)
        mapper.SetInputData(vtkPolyData())
        actor = vtkActor2D()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*self._style.quiet_text)
        actor.GetProperty().SetLineWidth(self._scale)
        return actor


def _enlarge(
    camera: vtkCamera, main: vtkCamera, projection: FloatArray, source: Rectangle, size: tuple[int, int]
) -> None:
    """Let a camera see a part of what another sees in a view of this size."""
    left, right, bottom, top = source
    width, height = size
    x, y = (left + right) / width - 1, (bottom + top) / height - 1
    enlarge = np.diag([width / (right - left), height / (top - bottom), 1.0, 1.0])
    enlarge[0, 3], enlarge[1, 3] = -enlarge[0, 0] * x, -enlarge[1, 1] * y
    matrix = vtkMatrix4x4()
    matrix.DeepCopy((enlarge @ projection).ravel().tolist())
    camera.SetPosition(*main.GetPosition())
    camera.SetFocalPoint(*main.GetFocalPoint())
    camera.SetViewUp(*main.GetViewUp())
    camera.UseExplicitProjectionTransformMatrixOn()
    camera.SetExplicitProjectionTransformMatrix(matrix)


def _rectangles(*boxes: Rectangle) -> list[FloatArray]:
    """Their sides, as lines (5, 2)."""
    return [np.array([[a, c], [b, c], [b, d], [a, d], [a, c]]) for a, b, c, d in boxes]


def _draw(actor: vtkActor2D, lines: Sequence[FloatArray]) -> None:
    """Let it draw these lines (k, 2)."""
    points, cells, drawn = vtkPoints(), vtkCellArray(), vtkPolyData()
    for line in lines:
        ids = [points.InsertNextPoint(x, y, 0) for x, y in line]
        cells.InsertNextCell(len(ids), ids)
    drawn.SetPoints(points)
    drawn.SetLines(cells)
    actor.GetMapper().SetInputData(drawn)  # type: ignore[attr-defined]  # it is a vtkPolyDataMapper2D
