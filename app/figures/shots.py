"""The pictures of a figure's panels: shaded pixels and, in the same coordinates, isolines, outlines, marks, insets."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from bihdist_core import ParameterError, PointCloud, Surface
from bihdist_core.arrays import AnyArray, ByteArray, FloatArray
from bihdist_core.progress import Progress, part
from bihdist_core.surface import with_faces
from bihdist_core.tetrahedra import SolidBoundary

from ..document.document import isolines_in
from ..document.looks import Isolines, Shading
from ..drawing.glyphs import FEATURE_EDGES, SECTION, LineLook
from ..drawing.shapes import Box
from ..marks.primitives import PointMark
from ..scene.bands import band_edges
from ..scene.clipping import ClipPlane, clip_plane, cut_through, is_kept
from ..scene.drawable import drawable, feature_edges, normals_shading, outward_faces
from ..scene.field_actor import FieldActor
from ..scene.levels import levels, too_many
from ..scene.line_clipping import Line
from ..scene.line_labels import Contour
from ..scene.selected import selected_colours
from ..scene.style import Style
from .description import Figure, FigurePanel
from .framing import Framed, has_ground, shown_surfaces
from .hidden_lines import Curve, HiddenLineRemoval, contours_seen
from .inset_places import source_of
from .outlines import outlines
from .page_layout import PageLayout
from .raster import FINER, SAMPLES, Rectangle, RenderWindow
from .shadows import Shadows

LEAST_SEEN = 3.0
"""Units of a line; where less of it is seen, nobody will find it."""

PlacedMark = tuple[int, float, float]
"""The index of a mark in its panel, and its x and y on the page."""


@dataclass(frozen=True, eq=False)
class SeenLines:
    """The parts of lines of one look that are seen.

    `course` holds all of their parts, if what is hidden is drawn, too, or seen through the surface.
    """

    seen: list[Line]
    course: list[Line]


@dataclass(frozen=True, eq=False)
class Shot:
    """A rectangle of the page with a picture in it.

    Attributes
    ----------
    image
        (h, w, 4) uint8, with premultiplied alpha.
    isolines
        In the order of their values.
    marks, ghosts
        Marks that are seen, and marks that the shape hides.
    frame
        (3, 3) axes of the camera, see `scene.camera.frame`.
    source
        What an inset enlarges; None for a view.
    seen
        Names of lines of which something is seen.
    lines
        By their looks, those of a higher rank last.
    opacity
        Of the surface.
    per_unit
        How long a unit of the mesh is on the page, in the plane that the camera looks at.
    """

    panel: int
    box: Box
    image: ByteArray
    isolines: list[Contour]
    outlines: list[Line]
    marks: list[PlacedMark]
    frame: FloatArray
    ghosts: list[PlacedMark] = field(default_factory=list)
    source: Box | None = None
    seen: frozenset[str] = frozenset()
    lines: dict[LineLook, SeenLines] = field(default_factory=dict)
    opacity: float = 1.0
    per_unit: float = 0.0

    @cached_property
    def cover(self) -> AnyArray:
        """How much of each pixel (h, w) the surface takes, 0 to 255."""
        alpha = self.image[..., 3]
        return alpha if self.opacity == 1 else np.minimum(np.rint(alpha / self.opacity), 255).astype(np.uint8)

    def cover_at(self, points: FloatArray) -> AnyArray:
        """Return how much the surface takes of the picture, 0 to 255, at points (k, 2) of the page; 0 outside of it."""
        rows, columns, _ = self.image.shape
        column, row = np.floor(self.box.shares(points) * (columns, rows)).astype(int).T
        is_inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        cover = np.zeros(len(points), np.uint8)
        cover[is_inside] = self.cover[row[is_inside], column[is_inside]]
        return cover


class RenderCache:
    """Resources kept from one figure to the next: the off-screen window, and prepared surfaces.  Use it as a context.

    Parameters
    ----------
    finer, samples
        See `RenderWindow`.
    curves
        Whether isolines are exact curves, hidden one by one; otherwise the surface is painted with them, as in the
        window, which takes a fraction of the time.
    """

    def __init__(self, finer: int = FINER, samples: int = SAMPLES, curves: bool = True) -> None:
        self._finer, self._samples, self.curves = finer, samples, curves
        self._render_window: RenderWindow | None = None
        self._meshes: dict[tuple[int, Shading], tuple[Surface, vtkPolyData]] = {}

    def __enter__(self) -> RenderCache:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the render window, if one was opened."""
        if self._render_window is not None:
            self._render_window.close()
        self._render_window = None

    def render_window(self, style: Style) -> RenderWindow:
        """Return the off-screen window for a style."""
        if self._render_window is None or self._render_window.shown.style != style:
            self.close()
            self._render_window = RenderWindow(style, self._finer, self._samples)
        return self._render_window

    def keep(self, surfaces: Iterable[Surface]) -> None:
        """Forget all other surfaces."""
        ids = {id(surface) for surface in surfaces}
        self._meshes = {key: entry for key, entry in self._meshes.items() if key[0] in ids}

    def mesh(self, surface: Surface, shading: Shading) -> vtkPolyData:
        """Return the surface as VTK draws it with this shading, made once."""
        key = (id(surface), normals_shading(shading))
        if key not in self._meshes:
            self._meshes[key] = (surface, drawable(surface, shading))
        return self._meshes[key][1]


def take_shots(
    figure: Figure, layout: PageLayout, progress: Progress, render_cache: RenderCache | None = None
) -> list[Shot]:
    """Take all pictures, in the order in which they lie on each other."""
    shots: list[Shot] = []
    tops = figure.upper_limits()
    count = sum(len(p.views) + len(p.insets) for p in figure.panels)
    sights: dict[Hashable, tuple[HiddenLineRemoval, Shadows | None]] = {}
    with RenderCache() if render_cache is None else nullcontext(render_cache) as render_cache:
        render_cache.keep(each for panel in figure.panels for each in (panel.surface, *panel.parts))
        render_window = render_cache.render_window(figure.style)
        for index, (panel, cell) in enumerate(zip(figure.panels, layout.cells, strict=True)):
            surfaces, shown_now = shown_surfaces(panel, tops[index]), None
            for is_asked, what in (
                (panel.isolines.labels, "labels of isolines"),
                (panel.feature_edges, "feature edges"),
            ):
                if is_asked:
                    with_faces(panel.surface, what)
            curves = render_cache.curves or panel.isolines.labels  # which stand on curves
            views = zip(panel.views, cell.views, cell.parts, surfaces, strict=True)
            for number, (view, box, shown, surface) in enumerate(views):
                if surface is not shown_now:
                    shown_now, is_own = surface, surface is panel.surface or bool(panel.parts)
                    mesh = render_cache.mesh(surface, panel.shading) if is_own else drawable(surface, panel.shading)
                    clip = clip_plane(panel.clip, panel.surface if panel.parts else surface)
                    _show(panel, mesh, tops[index], clip, render_window.shown)
                step = part(progress, len(shots) / count, (len(shots) + 1) / count)
                framed = Framed(view, panel, surface, box, shown)
                size = (framed.whole.width, framed.whole.height)
                # Panels of one surface that are seen alike differ in their fields alone.
                seen_by = framed.projection.view.tobytes(), framed.projection.matrix.tobytes()
                key = (id(mesh), clip, panel.opacity < 1, size, *seen_by)
                if key not in sights:
                    outward, ground = outward_faces(mesh, clip is not None, panel.opacity), has_ground(panel)
                    is_cast = figure.style.occlusion > 0 or ground
                    solid = mesh
                    if is_cast and isinstance(surface, PointCloud):
                        # Hexagons would cast shadows on each other.
                        solid = drawable(surface.shape, Shading("smooth"))
                    sights[key] = (
                        HiddenLineRemoval(surface.shape, framed.projection, size, outward, clip),
                        Shadows(solid, framed.projection, panel.up, ground, clip) if is_cast else None,
                    )
                taker = _Taker(figure, index, surface, *sights[key], tops[index], framed, layout, render_window, curves)
                shots.append(taker.take(box, panel.isolines, step))
                for inset, place in zip(panel.insets, cell.insets, strict=True) if number == 0 else ():
                    step = part(progress, len(shots) / count, (len(shots) + 1) / count)
                    source = source_of(framed, surface, inset.vertex, place.width, inset.factor, box)
                    shots.append(taker.take(place, isolines_in(inset, panel.isolines), step, source))
    return shots if figure.dashes_all else [_without_seen(shot, shots) for shot in shots]


def _show(panel: FigurePanel, mesh: vtkPolyData, top: float, clip: ClipPlane | None, actor: FieldActor) -> None:
    """Show a panel's field, or what else it has, on a mesh."""
    actor.show_surface(mesh)
    actor.show_shading(panel.shading)
    # Behind a translucent surface lines are painted; before it they are curves, like all of an opaque one.
    actor.show_clip(clip, paints_section=panel.opacity < 1 or isinstance(panel.surface, PointCloud))
    actor.show_cut(cut_through(panel.surface, clip))
    actor.show_opacity(panel.opacity)
    actor.show_selected(selected_colours(panel.areas, len(panel.surface.vertices)))
    if panel.field is not None:
        actor.show_field(panel.field, top, panel.signed)
        actor.show_bands(band_edges(panel.isolines, top, panel.signed))
    elif panel.colours is not None:
        actor.show_colours(panel.colours, panel.are_labels)
    else:
        actor.show_bare(is_plain=not panel.failure)
    actor.show_base(panel.base, panel.has_coloured_isolines)


def _without_seen(shot: Shot, shots: Sequence[Shot]) -> Shot:
    """Leave out dashed marks that another picture of the panel shows."""
    seen = {mark[0] for other in shots if other.panel == shot.panel for mark in other.marks}
    return replace(shot, ghosts=[ghost for ghost in shot.ghosts if ghost[0] not in seen])


class _Taker:
    """Takes the pictures of one view: the whole of it, and insets."""

    def __init__(
        self,
        figure: Figure,
        index: int,
        surface: Surface,
        sight: HiddenLineRemoval,
        shadows: Shadows | None,
        top: float,
        framed: Framed,
        layout: PageLayout,
        render_window: RenderWindow,
        curves: bool,
    ) -> None:
        self._style, self._panel, self._index = figure.style, figure.panels[index], index
        self._surface, self._top, self._box, self._render_window = surface, top, framed.whole, render_window
        self._scale, self._stroke, self._lift = layout.scale, layout.stroke, layout.mark / 2
        self._projection = framed.projection
        self._per_unit = 1 / framed.projection.pixel_at(framed.depth, framed.whole.width)
        self._sight, self._shadows, self._curves = sight, shadows, curves
        self._is_translucent = figure.panels[index].opacity < 1
        # Whose isolines and sections are painted, and which have no outlines.
        self._is_of_points = isinstance(surface, PointCloud)
        has_cut = isinstance(surface, SolidBoundary) and figure.panels[index].clip is not None
        self._paints_isolines = not curves or self._is_of_points or has_cut
        self._found: dict[Isolines, list[Contour]] = {}
        panel = self._panel
        self._seen: set[str] = set()
        edges = []
        if panel.feature_edges or (self._style.feature_edges and not self._is_of_points):
            edges = sight.along(*feature_edges(surface, panel.shading, panel.feature_edges))
        found = (FEATURE_EDGES, edges), (SECTION, [] if self._is_of_points else sight.section())
        self._lines = {look: SeenLines(lines, []) for look, lines in found if lines}
        looks = sorted(dict.fromkeys(line.look for line in panel.lines), key=lambda look: look.rank)
        self._lines |= {look: self._seen_lines(look) for look in looks}
        self._marks, self._ghosts = self._placed_marks()

    def take(self, box: Box, wanted: Isolines, progress: Progress, source: Box | None = None) -> Shot:
        """Take what a box of the page shows: the view or, for an inset, a part of it enlarged, with these isolines."""
        _, _, width, height = box.pixels(self._scale)
        # Labels would stand on painted ones.
        is_painted = self._paints_isolines or (self._is_translucent and not wanted.labels)
        self._render_window.shown.show_isolines(wanted if is_painted else Isolines(0), self._panel.through)
        seen = self._part(source or box)
        image = self._render_window.shade(
            self._projection, (width, height), self._scale * self._stroke, seen, part(progress, 0, 0.7)
        )
        if self._shadows is not None:
            image = self._shadows.cast(image, seen, self._style.occlusion * self._panel.opacity)
        progress(0.7, "finding hidden marks")
        contours = [] if self._paints_isolines else self._contours(wanted)
        outlined = outlines(self._sight) if self._style.outline and not self._is_of_points else []
        corner = np.array([self._box.x, self._box.y])

        def moved(points: FloatArray) -> FloatArray:
            """Return points (k, 2) of the view's picture as they stand on the page, enlarged in an inset."""
            return box.at((source or box).shares(points + corner))

        def moved_lines(lines: Sequence[Line]) -> list[Line]:
            return [(moved(points), is_closed) for points, is_closed in lines]

        def moved_marks(marks: Sequence[PlacedMark]) -> list[PlacedMark]:
            places = [(k, *moved(np.array([x, y])).tolist()) for k, x, y in marks]
            return [mark for mark in places if box.holds(*mark[1:])]

        return Shot(
            self._index,
            box,
            image,
            [replace(line, parts=moved_lines(line.parts)) for line in contours],
            moved_lines(outlined),
            moved_marks(self._marks),
            self._projection.view[:3, :3].T,
            moved_marks(self._ghosts) if source is None else [],
            source,
            frozenset(self._seen),
            {look: SeenLines(moved_lines(of.seen), moved_lines(of.course)) for look, of in self._lines.items()},
            self._panel.opacity,
            self._per_unit,
        )

    # ------------------------------------------------------------------ what is seen
    def _part(self, source: Box) -> Rectangle:
        whole = self._box
        left, right = (2 * (side - whole.x) / whole.width - 1 for side in (source.x, source.right))
        bottom, top = (1 - 2 * (side - whole.y) / whole.height for side in (source.bottom, source.y))
        return left, right, bottom, top

    def _contours(self, wanted: Isolines) -> list[Contour]:
        """Return the visible parts of isolines, traced once for all pictures that have the same."""
        if wanted not in self._found:
            self._found[wanted] = self._visible_isolines(wanted)
        return self._found[wanted]

    def _visible_isolines(self, wanted: Isolines) -> list[Contour]:
        panel = self._panel
        if panel.field is None:
            return []
        own = float(np.nanmax(np.abs(panel.field) if panel.signed else panel.field, initial=0.0))
        found = levels(wanted, self._top, own, panel.signed, panel.through)
        if reason := too_many(found, wanted, own):
            raise ParameterError(reason)
        return contours_seen(self._sight, panel.field, found)

    def _seen_lines(self, look: LineLook) -> SeenLines:
        """Return the panel's lines of a look; the names of those of which something is seen are kept."""
        x, component = self._surface.vertices, self._surface.component_of_vertex
        lines = [line for line in self._panel.lines if line.look == look and (component[line.spans] >= 0).all()]
        curves = [Curve(line.positions(x), line.spans, line.is_closed) for line in lines]
        outlined = [self._sight.outlined([curve]) for curve in curves if look.hidden or self._is_translucent]
        seen = self._sight.visible(curves)
        found = outlined if self._is_translucent else seen
        self._seen |= {
            line.name for line, parts in zip(lines, found, strict=True) if sum(map(_length, parts)) > LEAST_SEEN
        }
        return SeenLines(list(chain.from_iterable(seen)), list(chain.from_iterable(outlined)))

    def _placed_marks(self) -> tuple[list[PlacedMark], list[PlacedMark]]:
        """Return the marks that are seen, and those that the shape hides."""
        seen: list[PlacedMark] = []
        hidden: list[PlacedMark] = []
        for k, mark in enumerate(self._panel.marks):
            if self._surface.component_of_vertex[mark.vertex] < 0:
                continue  # on another part of the surface
            point = mark.on(self._surface.vertices)
            if not is_kept(self._sight.clip, point[None])[0]:
                continue
            x, y, depth = self._sight.pixels(point[None])[0]
            if not np.isfinite(depth) or not np.isfinite(x):
                continue
            # A mark stands out of the surface: at a silhouette it is seen a little longer than its vertex.
            per_unit = self._projection.pixel_at(depth, self._box.width)
            nearer = point + self._normal(mark) * per_unit * 0.67 * self._lift
            is_seen = self._is_translucent or self._sight.sees(point) or self._sight.sees(nearer)
            if is_seen or mark.glyph.hidden is not None:
                (seen if is_seen else hidden).append((k, float(x), float(y)))
        return seen, hidden

    def _normal(self, mark: PointMark) -> FloatArray:
        faces = self._surface.shape.faces
        there = np.isin(faces, mark.corners).all(axis=1) if mark.corners else (faces == mark.vertex).any(axis=1)
        corners = self._surface.vertices[faces[there]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0)
        unit: FloatArray = normal / max(float(np.linalg.norm(normal)), 1e-300)
        return unit


def _length(part: Line) -> float:
    """Return the length of a part of a line, in units of the page."""
    return float(np.linalg.norm(np.diff(part[0], axis=0), axis=1).sum())
