"""The pictures of a figure's panels: shaded pixels and, in the same coordinates, isolines, outlines, marks, insets."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import nullcontext
from dataclasses import dataclass, replace

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.isoline_tracing import isolines
from bihdist_core.progress import Progress, part

from ..document.camera import Camera, View
from ..document.document import Zoom
from ..document.looks import Shading
from ..drawing.bands import band_edges
from ..drawing.camera import Margins, Projection, outwards_at, standard_camera
from ..drawing.drawable import drawable, normals_shading, outward_faces
from ..drawing.field_actor import isoline_values
from ..drawing.insets import SIDE
from ..drawing.relief import relief, rise
from ..drawing.style import Style
from .description import Figure, FigurePanel
from .layout import Box, Layout
from .outlines import outlines
from .raster import FINER, SAMPLES, Rectangle, Studio
from .sight import Curve, Sight

FREE = 0.03
"""The share of a view left free along each side."""

NO_MARGINS = Margins(side=0.0, top=0.0, bottom=0.0)

Line = tuple[np.ndarray, bool]
"""Points (k, 2) on the page, and whether the last joins the first."""


@dataclass(frozen=True, eq=False)
class Shot:
    """A rectangle of the page with a picture in it.

    image: (h, w, 4) uint8, colours multiplied by alpha; isolines: a list of visible parts for each curve, with its
    value; marks: their index in the panel, and where (x, y) on the page; source: for an inset, what it enlarges.
    """

    panel: int
    box: Box
    image: np.ndarray
    isolines: list[tuple[float, list[Line]]]
    outlines: list[Line]
    marks: list[tuple[int, float, float]]
    source: Box | None = None


class Stage:
    """What is kept from one figure to the next: the off-screen window, and surfaces made ready.  Use it as a context.

    finer, samples: see `Studio`.
    """

    def __init__(self, finer: int = FINER, samples: int = SAMPLES) -> None:
        self._finer, self._samples = finer, samples
        self._studio: Studio | None = None
        self._meshes: dict[tuple[int, Shading], tuple[Surface, vtkPolyData]] = {}

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        if self._studio is not None:
            self._studio.close()
        self._studio = None

    def studio(self, style: Style) -> Studio:
        """The window for a style."""
        if self._studio is None or self._studio.shown.style != style:
            self.close()
            self._studio = Studio(style, self._finer, self._samples)
        return self._studio

    def keep(self, surfaces: Iterable[Surface]) -> None:
        """Forget all other surfaces."""
        ids = {id(surface) for surface in surfaces}
        self._meshes = {key: entry for key, entry in self._meshes.items() if key[0] in ids}

    def mesh(self, surface: Surface, shading: Shading) -> vtkPolyData:
        key = (id(surface), normals_shading(shading))
        if key not in self._meshes:
            self._meshes[key] = (surface, drawable(surface, shading))
        return self._meshes[key][1]


def take_shots(figure: Figure, layout: Layout, progress: Progress, stage: Stage | None = None) -> list[Shot]:
    """All pictures, in the order in which they lie on each other."""
    shots: list[Shot] = []
    tops = figure.tops()
    count = sum(len(p.views) + len(p.zooms) for p in figure.panels)
    with Stage() if stage is None else nullcontext(stage) as stage:
        stage.keep(panel.surface for panel in figure.panels)
        studio = stage.studio(figure.style)
        for index, (panel, cell) in enumerate(zip(figure.panels, layout.cells, strict=True)):
            surface = panel.surface
            if panel.height and panel.field is not None:
                used = surface.vertices[surface.component_of_vertex >= 0]
                bounds = np.stack([used.min(axis=0), used.max(axis=0)], axis=1).ravel().tolist()
                surface = relief(surface, panel.field, tops[index], rise(bounds, panel.height))
            shading = panel.shading
            mesh = stage.mesh(surface, shading) if surface is panel.surface else drawable(surface, shading)
            studio.shown.show_surface(mesh)
            studio.shown.show_shading(shading)
            if panel.field is not None:
                studio.shown.show_field(panel.field, tops[index], panel.signed)
                studio.shown.show_bands(band_edges(panel.isolines, tops[index], panel.signed))
            studio.shown.show_isolines(0)  # they are drawn as curves
            for number, (view, box) in enumerate(zip(panel.views, cell.views, strict=True)):
                step = part(progress, len(shots) / count, (len(shots) + 1) / count)
                camera = _camera(view, panel, surface, box)
                taker = _Taker(figure, index, surface, outward_faces(mesh), tops[index], camera, box, layout, studio)
                main = taker.take(box, step)
                shots.append(main)
                for zoom in panel.zooms if number == 0 else ():
                    step = part(progress, len(shots) / count, (len(shots) + 1) / count)
                    inset, source = taker.places(zoom, main, [s for s in shots if s.panel == index and s.source])
                    shots.append(taker.take(inset, step, source))
    return shots


def _camera(view: View, panel: FigurePanel, surface: Surface, box: Box) -> Camera:
    if isinstance(view, Camera):
        return view
    name = "relief" if panel.height and view == "home" else view
    shown = surface.vertices[surface.component_of_vertex >= 0]
    outwards = outwards_at(surface, panel.source) if name == "source" and panel.source is not None else None
    aspect = box.width / box.height
    return standard_camera(shown, aspect, name, NO_MARGINS, panel.up, outwards, panel.is_parallel)


class _Taker:
    """Takes the pictures of one view: the whole of it, and insets."""

    def __init__(
        self,
        figure: Figure,
        index: int,
        surface: Surface,
        outward: np.ndarray | None,
        top: float,
        camera: Camera,
        box: Box,
        layout: Layout,
        studio: Studio,
    ) -> None:
        self._style, self._panel, self._index = figure.style, figure.panels[index], index
        self._surface, self._top, self._box, self._studio = surface, top, box, studio
        self._scale, self._stroke = layout.scale, layout.stroke
        self._projection = Projection(camera, box.width / box.height, surface.vertices, FREE, self._panel.is_parallel)
        self._sight = Sight(surface, self._projection, (box.width, box.height), outward)
        self._isolines: list[tuple[float, list[Line]]] | None = None
        self._outlines: list[Line] | None = None
        self._marks = self._visible_marks()

    def take(self, box: Box, progress: Progress, source: Box | None = None) -> Shot:
        """The picture of a part of the view (all of it if None), in a box of the page."""
        _, _, width, height = box.pixels(self._scale)
        image = self._studio.shade(
            self._projection, (width, height), self._scale * self._stroke, self._part(source), part(progress, 0, 0.7)
        )
        progress(0.7, "finding what is hidden")
        if self._isolines is None:
            self._isolines = self._visible_isolines()
        if self._style.outline and self._outlines is None:
            self._outlines = outlines(self._sight)
        move = _Move(source or self._box, box)
        marks = [(k, *move(np.array([[x, y]]) + self._corner)[0]) for k, x, y in self._marks]
        return Shot(
            self._index,
            box,
            image,
            [(value, [(move(p + self._corner), c) for p, c in parts]) for value, parts in self._isolines or []],
            [(move(p + self._corner), c) for p, c in self._outlines or []],
            [(k, x, y) for k, x, y in marks if box.x <= x <= box.right and box.y <= y <= box.bottom],
            source,
        )

    def places(self, zoom: Zoom, main: Shot, others: list[Shot]) -> tuple[Box, Box]:
        """Where the inset of a zoom goes, and what part of the view it shows."""
        side = SIDE * min(self._box.width, self._box.height)
        x, y, _ = self._sight.pixels(self._surface.vertices[[zoom.vertex]])[0]
        if not (0 <= x <= self._box.width and 0 <= y <= self._box.height):
            raise ParameterError(f"Vertex {zoom.vertex} is outside the picture, so it cannot be enlarged.")
        x, y = x + self._box.x, y + self._box.y
        shown = side / zoom.factor
        source = Box(x - shown / 2, y - shown / 2, shown, shown)
        gap = 4.0
        left, top = self._box.x + gap, self._box.y + gap
        right, bottom = self._box.right - side - gap, self._box.bottom - side - gap
        corners = {
            "top right": Box(right, top, side, side),
            "top left": Box(left, top, side, side),
            "bottom right": Box(right, bottom, side, side),
            "bottom left": Box(left, bottom, side, side),
        }
        name = zoom.corner
        if name == "auto":
            taken = [source, *(s.box for s in others)]

            def hidden(box: Box) -> float:
                return self._covered(box, main) + sum(_overlap(box, other) > 0 for other in taken)

            name = min(corners, key=lambda corner: hidden(corners[corner]))
        return corners[name].snapped(self._scale), source

    # ------------------------------------------------------------------ what is seen
    @property
    def _corner(self) -> np.ndarray:
        return np.array([self._box.x, self._box.y])

    def _part(self, source: Box | None) -> Rectangle:
        if source is None:
            return (-1.0, 1.0, -1.0, 1.0)
        whole = self._box
        x = [2 * (side - whole.x) / whole.width - 1 for side in (source.x, source.right)]
        y = [1 - 2 * (side - whole.y) / whole.height for side in (source.bottom, source.y)]
        return (*x, *y)

    def _visible_isolines(self) -> list[tuple[float, list[Line]]]:
        panel = self._panel
        if panel.field is None:
            return []
        found = isolines(
            self._surface, panel.field, isoline_values(panel.field, self._top, panel.isolines.count, panel.signed)
        )
        parts = self._sight.visible(Curve(line.points, line.edges, line.closed) for line in found)
        return [(line.value, p) for line, p in zip(found, parts, strict=True) if p]

    def _visible_marks(self) -> list[tuple[int, float, float]]:
        found = []
        for k, mark in enumerate(self._panel.marks):
            point = self._surface.vertices[mark.vertex]
            x, y, depth = self._sight.pixels(point[None])[0]
            # A mark stands out of the surface: at a silhouette it is seen a little longer than its vertex.
            per_unit = self._projection.pixel_at(depth, self._box.width)
            nearer = point + self._normal(mark.vertex) * per_unit * self._style.marker_size * self._stroke / 3
            if np.isfinite(depth) and (self._sight.sees(point) or self._sight.sees(nearer)):
                found.append((k, float(x), float(y)))
        return found

    def _normal(self, vertex: int) -> np.ndarray:
        corners = self._surface.vertices[self._surface.faces[(self._surface.faces == vertex).any(axis=1)]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0)
        return normal / max(float(np.linalg.norm(normal)), 1e-300)

    def _covered(self, box: Box, main: Shot) -> float:
        """The share of a box of the page that the shape covers."""
        x, y, width, height = replace(box, x=box.x - main.box.x, y=box.y - main.box.y).pixels(self._scale)
        alpha = main.image[max(y, 0) : y + height, max(x, 0) : x + width, 3]
        return float(alpha.mean()) / 255 if alpha.size else 0.0


class _Move:
    """From one rectangle of the page to another."""

    def __init__(self, start: Box, stop: Box) -> None:
        self._from, self._to = start, stop

    def __call__(self, points: np.ndarray) -> np.ndarray:
        a, b = self._from, self._to
        share = (points - [a.x, a.y]) / [a.width, a.height]
        return share * [b.width, b.height] + [b.x, b.y]


def _overlap(a: Box, b: Box) -> float:
    width = min(a.right, b.right) - max(a.x, b.x)
    height = min(a.bottom, b.bottom) - max(a.y, b.y)
    return max(width, 0) * max(height, 0)
