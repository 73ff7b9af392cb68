"""Insets of a panel in the window: places enlarged in its corners, seen by the panel's camera."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
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

from ..document.document import Inset, isolines_in
from .camera import SeenNow, see_part
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
    """The place of an inset, and what it enlarges, in device pixels with y up; its isolines."""

    box: Rectangle
    source: Rectangle
    levels: Levels


class Insets:
    """Shows `actors` of a panel, its field and what others have added to its plotter once more for each inset.

    `scale` is the number of device pixels in a pixel.
    """

    def __init__(
        self, plotter: "PanelPlotter", actors: Sequence[vtkActor], field: FieldActor, style: Style, scale: float
    ) -> None:
        self._plotter, self._main = plotter, plotter.renderer
        self._actors, self._style, self._scale = actors, style, scale
        self._insets: tuple[Inset, ...] = ()
        self._positions = np.empty((0, 3))
        self.corners: list[str] = []  # in which insets stand
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

    def show(self, insets: tuple[Inset, ...], vertices: FloatArray) -> None:
        """Show these insets and no others on a surface with vertices (n, 3)."""
        if insets != self._insets:
            self.corners = [inset.corner if inset.corner != "auto" else "top right" for inset in insets]
        self._insets = insets
        self._positions = vertices[[inset.vertex for inset in insets]] if insets else np.empty((0, 3))
        window = self._main.GetRenderWindow()
        while len(self.renderers) > len(insets):
            window.RemoveRenderer(self.renderers.pop())
        while len(self.renderers) < len(insets):
            self.renderers.append(self._new_renderer())
            window.AddRenderer(self.renderers[-1])
        self._own += [None] * (len(insets) - len(self._own))
        del self._own[len(insets) :]
        for number, inset in enumerate(insets):
            self._let_own(number, inset.isolines is not None)
        self._frames.SetVisibility(bool(insets))

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

    def set_proportion(self, share: float) -> None:
        """Let isolines of their own be of this share of their usual width."""
        self._proportion = share
        for own in self._own:
            if own is not None:
                own.set_scale(self._scale, share)

    @property
    def parts(self) -> list[InsetPart]:
        """The insets in sight, as in the last picture."""
        boxes = self._boxes()
        found = enumerate(zip(self.corners, self._sources(), self._in_sight, strict=False)) if self._insets else ()
        return [
            InsetPart(boxes[corner], source, (self._own[number] or self._field).levels)
            for number, (corner, source, is_seen) in found
            if is_seen
        ]

    def remove(self) -> None:
        """Remove all insets for good."""
        self.show((), self._positions)
        self._main.RemoveObserver(self._observer)

    def settle(self, samples: FloatArray, marks: FloatArray) -> None:
        """Put insets that may stand in any corner where they hide the least, before the next picture.

        This is called where the view is set, and not while it turns, as insets would jump.

        Parameters
        ----------
        samples
            (k, 3) places all over the surface.
        marks
            (k, 3) marked places.
        """
        self._samples, self._marks, self._is_settled = samples, marks, False

    def renderer_at(self, x: float, y: float) -> vtkRenderer:
        """Return the renderer whose picture is at a device pixel, y up: that of an inset, or of the panel."""
        for renderer, (left, bottom, width, height) in self.placed.items():
            if left <= x < left + width and bottom <= y < bottom + height:
                return renderer
        return self._main

    @property
    def placed(self) -> dict[vtkRenderer, tuple[int, int, int, int]]:
        """The places of insets that are seen: (left, bottom, width, height) in device pixels."""
        seen = [r for r, is_seen in zip(self.renderers, self._in_sight, strict=False) if is_seen]
        return {renderer: (*renderer.GetOrigin(), *renderer.GetSize()) for renderer in seen}

    # ------------------------------------------------------------------ where they are
    def _boxes(self) -> dict[str, Rectangle]:
        """Return the box of an inset in each corner, by name."""
        size = self._main.GetSize()
        return corner_boxes(size, round(SIDE * min(size)), GAP * self._scale)

    def _sources(self) -> list[Rectangle]:
        """Return the boxes that are enlarged."""
        side = round(SIDE * min(self._main.GetSize()))
        places = self._pixels(self._positions)
        return [source_box(place, side, inset) for place, inset in zip(places, self._insets, strict=True)]

    def _pixels(self, points: FloatArray) -> FloatArray:
        """Return the pixels (k, 2) of points (k, 3); NaN behind the camera."""
        pixels: FloatArray = (self._seen().in_picture(points)[:, :2] + 1) / 2 * self._main.GetSize()
        return pixels

    def _seen(self) -> SeenNow:
        width, height = self._main.GetSize()
        return SeenNow(self._main.GetActiveCamera(), width / max(height, 1))

    # ------------------------------------------------------------------ drawing
    def _place(self) -> None:
        """Let each inset see its place as the panel's camera sees it now; called before each picture."""
        if not self._insets or not all(self._main.GetSize()):
            return
        width, height = self._main.GetSize()
        boxes, sources, surface = self._boxes(), self._sources(), self._pixels(self._samples)
        if not self._is_settled:
            marks = self._pixels(self._marks)
            self.corners, self._is_settled = chosen_corners(self._insets, boxes, sources, surface, marks), True
        self._follow_added()
        projection, loops = self._seen().matrix, []
        is_taken = taken_by(surface, (width, height), [boxes[corner] for corner in self.corners])
        self._in_sight = []
        for inset, own in zip(self._insets, self._own, strict=True):
            if own is not None:
                own.follow(self._field, isolines_in(inset, self._field.isolines))
        for renderer, corner, source in zip(self.renderers, self.corners, sources, strict=True):
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
        """Return an actor for lines on a view, in pixels or in fractions of it."""
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
    camera.SetPosition(*main.GetPosition())
    camera.SetFocalPoint(*main.GetFocalPoint())
    camera.SetViewUp(*main.GetViewUp())
    part = 2 * left / width - 1, 2 * right / width - 1, 2 * bottom / height - 1, 2 * top / height - 1
    see_part(camera, projection, part)


def _rectangles(*boxes: Rectangle) -> list[FloatArray]:
    """Return the outlines of boxes as lines (5, 2)."""
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
