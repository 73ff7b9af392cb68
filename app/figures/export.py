"""From a recipe to a file: the fields computed, the figure drawn, and the recipe written beside it."""

import os
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np

from bihdist_core import BihdistError, OutputError, ParameterError, SolverError, Surface
from bihdist_core.analysis.region_boundaries import region_boundaries
from bihdist_core.distances.answers import Answer
from bihdist_core.progress import Progress, part
from bihdist_core.sources.pieces import pieces_of
from bihdist_core.sources.source import BoundaryLoop, Curve, Source, SurfacePoint
from bihdist_core.sources.words import short_words_of
from bihdist_core.whole_file import check_output, whole_file

from ..document.document import Document, Panel, Zoom, starting_points
from ..document.looks import NO_LINES, Isolines
from ..document.maps import Maps
from ..document.page import Recipe
from ..document.perturbation import COLUMNS, changed_mesh
from ..document.profile import shows_path
from ..document.selections import Selections, vertices_of
from ..document.source_edits import members_of
from ..marks.glyphs import DOT, PIN, RING, TRIANGLE_DOWN, TRIANGLE_UP
from ..marks.primitives import PointMark
from ..scene.levels import in_unit
from ..scene.selected import selected_colours
from ..scene.source_lines import SourceLine, source_lines
from ..scene.style import PINS, style_of
from ..session.anchors import anchors_on
from ..session.array_store import ArrayStore
from ..session.bar_ends import own_end, typed_end
from ..session.extrema import extrema_of
from ..session.isoline_points import IsolinePoint, passed
from ..session.loaded_mesh import LoadedMesh, open_mesh
from ..session.map_answers import map_in
from ..session.perturbed_meshes import carried
from ..session.pin_locations import located_pins
from ..session.profiling import path_of
from ..session.questions import questions, source_at, vertex_at
from ..session.recipe_file import check_recipe_beside, place_beside, recipe_paths, recipe_written
from ..session.regions import regions_of, regions_questions
from .description import Figure, FigurePanel
from .draw import FIGURE_FORMATS, check_offscreen, check_transparency, save_figure
from .pair_marks import pair_marks, plain_heading
from .size import Size
from .tex import tex_path, tex_snippet

Surfaces = dict[str, LoadedMesh]
"""The surfaces of a document, by their names in it."""


def check_export(document: Document, path: str | os.PathLike[str]) -> None:
    """Before long work: that a figure and its recipe can be written; OutputError if not."""
    check_output(path, FIGURE_FORMATS)
    check_offscreen()
    check_recipe_beside(document, path)


def check_tex(path: str | os.PathLike[str]) -> Path:
    """Where the LaTeX snippet of a figure goes; OutputError if it cannot."""
    snippet = tex_path(Path(path))
    check_output(snippet, (".tex",))
    if snippet.exists() and "\\includegraphics" not in snippet.read_text(encoding="utf-8", errors="replace"):
        raise OutputError(f"{snippet}, where the snippet would go, is another file; give the figure another name.")
    return snippet


def open_document(recipe: Recipe, given: ArrayStore) -> tuple[Document, Surfaces]:
    """The recipe's document with checksums and vertices, and its surfaces.

    Raises ParameterError if one is missing or has changed since the document was written.
    """
    surfaces, document = {}, recipe.document
    remedy = "Name the mesh that is to be drawn with --mesh." if recipe.made_with else ""
    for mesh in document.surfaces:
        surfaces[mesh.name] = loaded = open_mesh(mesh, given, remedy, list(surfaces.values()))
        document = loaded.settled(document)
    for loaded in surfaces.values():
        loaded.beside = tuple(surfaces.values())
    if document[Maps].maps:
        one, two, *_ = surfaces.values()
        for map in document[Maps].maps:
            map_in(map, one.surface, two.surface)
    return document, surfaces


def compute(document: Document, surfaces: Surfaces, progress: Progress | None = None) -> list[Answer]:
    """For each panel its answer; SolverError if all of them are failures."""
    asked = [(document.panel(id), question) for id, question in questions(document).items()]
    answers = []
    for k, (panel, question) in enumerate(asked):
        step = part(progress, k / len(asked), (k + 1) / len(asked))
        answers.append(surfaces[panel.surface].answer(question, step))
    refuse_if_nothing(answers)
    return answers


def refuse_if_nothing(answers: Sequence[Answer]) -> None:
    """SolverError if all of them are failures: a figure of bare shapes helps nobody."""
    if answers and all(answer.failure for answer in answers):
        raise SolverError(" ".join(dict.fromkeys(answer.failure for answer in answers)))


def figure_of(recipe: Recipe, surfaces: Surfaces, answers: Sequence[Answer]) -> Figure:
    """The figure a recipe describes, from its panels' answers."""
    document, page = recipe.document, recipe.page
    style = style_of(page.style, document.colours)
    if not document.panels:
        raise ParameterError("The recipe has no panels.")
    path, remarks = _path(document, surfaces)
    shown = {panel.id: answer for panel, answer in zip(document.panels, answers, strict=True)}
    panels = tuple(
        replace(
            _figure_panel(recipe, panel, surfaces[panel.surface], answer),
            path=path.get(panel.surface, ()),
            maximum=(
                own_end(document, shown, panel.id, surfaces.get)
                if document.range == "own"
                else typed_end(document, panel.id, answer)
            ),
        )
        for panel, answer in zip(document.panels, answers, strict=True)
    )
    return Figure(
        panels,
        remarks=remarks,
        columns=page.columns or (COLUMNS if changed_mesh(document) is not None else None),
        size=Size.parse(page.size) if page.size else Size(),
        style=style,
        range=document.range,
        transparent=page.transparent,
        crop=page.crop,
        title=page.title,
        font=page.font,
        text=page.text,
    )


def _silent(_text: str) -> None:
    pass


def write_figure(
    figure: Figure,
    recipe: Recipe,
    given: ArrayStore,
    path: str,
    version: str,
    progress: Progress | None = None,
    say: Callable[[str], None] = _silent,
    tex: Sequence[Answer] | None = None,
) -> None:
    """The figure at `path` and its recipe beside it, all or nothing; `say` gets sentences on what is unusual.

    tex: the panels' answers, if a LaTeX snippet is to be written too.
    """
    check_export(recipe.document, path)
    place, format = place_beside(path, recipe)
    usual, is_new = recipe_paths(path)[0], not place.exists()
    with ExitStack() as files:
        files.enter_context(recipe_written(recipe, given, place, version, format=format))
        if tex is not None:
            snippet = files.enter_context(whole_file(check_tex(path)))
            snippet.write_text(tex_snippet(figure, recipe, tex, Path(path)), encoding="utf-8")
        remarks = save_figure(figure, path, progress)
    for remark in remarks:
        say(remark)
    if place != usual and is_new:
        say(f"The recipe is in {place}: {usual.name} is that of something else, and stays.")


def export(
    recipe: Recipe,
    path: str,
    version: str,
    progress: Progress | None = None,
    say: Callable[[str], None] = _silent,
    tex: bool = False,
) -> tuple[Figure, Recipe, list[Answer]]:
    """Everything: read, compute, draw, write.  Returns the figure, the recipe with its sources, and the answers.

    say: as in `write_figure`.  tex: with a LaTeX snippet.
    """
    check_export(recipe.document, path)
    check_transparency(recipe.page.transparent, path)
    if tex:
        check_tex(path)
    given = ArrayStore.read(recipe)
    document, surfaces = open_document(recipe, given)
    recipe = replace(recipe, document=document)
    # What cannot be drawn is refused before the long work.
    figure_of(recipe, surfaces, [Answer(label="")] * len(document.panels))
    answers = compute(document, surfaces, part(progress, 0.0, 0.6))
    figure = figure_of(recipe, surfaces, answers)
    write_figure(figure, recipe, given, path, version, part(progress, 0.6, 1.0), say, answers if tex else None)
    return figure, recipe, answers


def _figure_panel(recipe: Recipe, panel: Panel, loaded: LoadedMesh, answer: Answer) -> FigurePanel:
    document, surface = recipe.document, loaded.surface
    starts = [source_at(document.point(name).at, surface) for name in panel.shows.points]
    heading = answer.label
    if loaded.origin is not None and not panel.shows.compares_meshes:
        heading += f", after: {loaded.mesh.change}"
    starting = dict.fromkeys(point for point in starting_points(document) if not point.image_of)
    if starts and len(starting) > 1:
        heading += f", from {', '.join(map(short_words_of, starts))}"
    hint = "; ".join(text for text in (panel.shows.hint * recipe.page.hints, answer.remark) if text)
    heading, hint = plain_heading(document, panel, loaded, answer) or (heading, hint)
    through = passed(document, panel.surface, loaded, answer)
    up = document.up_of(panel.surface)
    up = up if up != "auto" else loaded.up
    views = recipe.page.views or (document.camera_of(panel.surface),)
    return FigurePanel(
        surface,
        answer.field,
        colours=answer.colours,
        heading=heading,
        hint=hint,
        label="" if answer.failure else answer.label,
        unit=answer.unit,
        failure=answer.failure,
        isolines=NO_LINES if answer.is_rough else _isolines(document, answer),
        through=tuple(point.value for point in through),
        views=tuple(loaded.view_of(view, up) for view in views),
        marks=(
            *_extremum_marks(document, panel, surface, answer),
            *_dots(through, answer),
            *_source_marks(starts, surface),
            *_anchor_marks(recipe, panel, loaded),
            *_largest(answer),
            *_pin_marks(document, panel, surface),
            *pair_marks(document, panel, loaded, answer),
        ),
        zooms=_zooms(document, loaded),
        height=0.0 if answer.failure else document.height,
        signed=answer.is_signed,
        largest=answer.largest_words,
        shading=document.shading,
        up=up,
        source=vertex_at(starts[0], surface) if starts else None,
        is_parallel=document.projection == "orthographic",
        axes=document.axes,
        lines=_source_lines(starts, surface),
        regions=() if answer.field is None else _region_lines(document, panel, loaded),
        selected=_selected(document, panel, surface),
    )


def _isolines(document: Document, answer: Answer) -> Isolines:
    in_shares = document.range == "shares" and answer.signs is None
    return in_unit(document.isolines, answer.scale, in_shares, answer.is_signed)


def _zooms(document: Document, loaded: LoadedMesh) -> tuple[Zoom, ...]:
    """At the same places of a changed surface."""
    if loaded.origin is None:
        return document.zooms
    places = [vertex_at(carried(zoom.vertex, loaded), loaded.surface) for zoom in document.zooms]
    return tuple(replace(zoom, vertex=vertex) for zoom, vertex in zip(document.zooms, places, strict=True))


def _selected(document: Document, panel: Panel, surface: Surface) -> np.ndarray | None:
    """The selections of the panel's surface; VertexError where that has no such vertex."""
    chosen = [each for each in document[Selections].selections if each.surface == panel.surface and each.runs]
    for each in chosen:
        if each.runs[-1][1] >= len(surface.vertices):
            surface.check_vertex(each.runs[-1][1])
    return selected_colours([(vertices_of(each.runs), each.colour) for each in chosen], len(surface.vertices))


def _path(document: Document, surfaces: Surfaces) -> tuple[dict[str, tuple[SourceLine, ...]], tuple[str, ...]]:
    """The path of the profile by the name of its surface, or a sentence on why there is none."""
    if not shows_path(document):
        return {}, ()
    try:
        name, path = path_of(document, surfaces)
    except BihdistError as error:
        return {}, (f"No path is drawn: {error}",)
    places = path.places
    return {name: (SourceLine(places.corners, places.weights, is_closed=False),)}, ()


def _region_lines(document: Document, panel: Panel, loaded: LoadedMesh) -> tuple[SourceLine, ...]:
    """The boundaries of the pins' regions, where the panel shows them."""
    question = regions_questions(document).get(panel.id)
    if question is None:
        return ()
    curves = region_boundaries(loaded.surface, regions_of(question, loaded))
    return tuple(SourceLine(curve.corners, curve.weights, curve.closed) for curve in curves)


def _extremum_marks(document: Document, panel: Panel, surface: Surface, answer: Answer) -> list[PointMark]:
    """Where the document says so: the same as the window's."""
    found = extrema_of(questions(document)[panel.id], surface, answer) if document.extrema else None
    if found is None:
        return []
    minima = [PointMark(vertex, TRIANGLE_DOWN) for vertex in found.minima.tolist()]
    return minima + [PointMark(vertex, TRIANGLE_UP) for vertex in found.maxima.tolist()]


def _source_lines(starts: Sequence[Source], surface: Surface) -> tuple[SourceLine, ...]:
    """Those of boundary loops and curves."""
    members = dict.fromkeys(member for start in starts for member in members_of(start))
    return tuple(
        line
        for member in members
        if isinstance(member, BoundaryLoop | Curve)
        for line in source_lines(pieces_of(member, surface), _line_in_words(member))
    )


def _line_in_words(member: BoundaryLoop | Curve) -> str:
    if isinstance(member, BoundaryLoop):
        return f"Boundary loop {member.number}"
    return f"The {'closed ' if member.closed else ''}curve of {len(member.places):,} points"


def _source_marks(starts: Sequence[Source], surface: Surface) -> list[PointMark]:
    """A mark for each vertex and place."""
    marks: list[PointMark] = []
    for start in starts:
        points = pieces_of(start, surface).points
        for face, corners, weights in zip(points.faces.tolist(), points.corners, points.start, strict=True):
            vertex = int(corners[weights.argmax()])
            is_vertex = weights.max() == 1
            if is_vertex:
                marks.append(PointMark(vertex))
                continue
            place = SurfacePoint(face, tuple(weights.tolist()))
            at = (tuple(corners.tolist()), place.weights)
            marks.append(PointMark(vertex, corners=at[0], weights=at[1], name=f"The place {short_words_of(place)}"))
    return marks


def _dots(through: Sequence[IsolinePoint], answer: Answer) -> list[PointMark]:
    """On isolines through points; see `scene.levels` on the values that have one."""
    low = -answer.maximum if answer.is_signed else 0.0
    on_lines = [point for point in through if low < point.value < answer.maximum]
    return [PointMark(p.vertices[0], DOT, corners=p.vertices, weights=p.weights) for p in on_lines]


def _largest(answer: Answer) -> list[PointMark]:
    """The place of the largest difference, with its value and name."""
    vertex = answer.largest
    if vertex is None or answer.field is None:
        return []
    value, percent = float(answer.field[vertex]), " %" if answer.scale == 100 else ""
    return [PointMark(vertex, colour="largest", text=f"{value:+.3g}{percent} at {vertex}".replace("-", "−"))]


def _anchor_marks(recipe: Recipe, panel: Panel, loaded: LoadedMesh) -> list[PointMark]:
    found = anchors_on(recipe.document, panel.surface, loaded)
    has_words = recipe.page.anchor_values
    return [
        PointMark(
            vertex,
            RING,
            text=f"{value:.4g}".replace("-", "−") if has_words and value is not None else "",
        )
        for vertex, value in found
    ]


def _pin_marks(document: Document, panel: Panel, surface: Surface) -> list[PointMark]:
    marks = []
    for pinned in located_pins(document, panel.surface, surface):
        vertex = pinned.vertex if pinned.vertex is not None else int(pinned.corners[pinned.weights.argmax()])
        mark = PointMark(vertex, PIN, PINS[pinned.pin.colour], number=pinned.number)
        if pinned.vertex is None:
            mark = replace(mark, corners=tuple(pinned.corners.tolist()), weights=tuple(pinned.weights.tolist()))
        marks.append(mark)
    return marks
