"""Write the figure of a recipe: compute its fields, draw it, and write the recipe beside it."""

import os
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import replace
from pathlib import Path

from bihdist_core import OutputError, ParameterError, SolverError, Surface
from bihdist_core.distances.answers import Answer
from bihdist_core.file_output import atomic_write, check_output
from bihdist_core.progress import Progress, part

from ..document.derived_surfaces import COLUMNS, changed_mesh
from ..document.document import Document, Inset, Panel
from ..document.looks import NO_LINES, Isolines
from ..document.page import Page, Recipe
from ..drawing.glyphs import NAMED
from ..marks.marked_panel import MarkedPanel, marks_of
from ..marks.primitives import AreaMark, Caption, LineMark, PointMark, Remark, SurfaceMark
from ..scene.levels import in_unit
from ..scene.style import style_of
from ..session.array_store import ArrayStore
from ..session.bar_ends import own_end, typed_end
from ..session.base import BaseGreys
from ..session.derived_surfaces import map_to_derived
from ..session.hemispheres import LATERAL_AND_MEDIAL, Hemispheres
from ..session.isoline_points import passed
from ..session.loaded_mesh import LoadedMesh, open_mesh
from ..session.questions import questions, source_at, vertex_at
from ..session.recipe_file import check_recipe_beside, place_beside, recipe_paths, recipe_written
from .arrangement import Arrangement, arranged, charts_of, source_words
from .description import Figure, FigurePanel
from .draw import FIGURE_FORMATS, check_offscreen, check_room, check_transparency, save_figure
from .legend import legend_of_labels
from .size import Size
from .tex import tex_path, tex_snippet

DEPTHS = (
    "The scale bar holds for what is as far away as the middle of the view; with --parallel-projection it holds "
    "everywhere."
)

Surfaces = dict[str, LoadedMesh]
"""The surfaces of a document, by their names in it."""


def check_export(document: Document, path: str | os.PathLike[str]) -> None:
    """Raise OutputError before long work if a figure or its recipe cannot be written."""
    check_output(path, FIGURE_FORMATS)
    check_offscreen()
    check_recipe_beside(document, path)


def check_tex(path: str | os.PathLike[str]) -> Path:
    """Return the path of a figure's LaTeX snippet; raise OutputError if it cannot be written."""
    snippet = tex_path(Path(path))
    check_output(snippet, (".tex",))
    if snippet.exists() and "\\includegraphics" not in snippet.read_text(encoding="utf-8", errors="replace"):
        raise OutputError(f"{snippet} exists and was not written by this program; give the figure another name.")
    return snippet


def open_document(recipe: Recipe, given: ArrayStore) -> tuple[Document, Surfaces]:
    """Return the recipe's document with checksums and vertices, and its surfaces.

    Raises ParameterError if one is missing or has changed since the document was written.
    """
    surfaces: Surfaces = {}
    document = recipe.document
    remedy = "Choose the mesh with --mesh." if recipe.made_with else ""
    for mesh in document.surfaces:
        surfaces[mesh.name] = loaded = open_mesh(mesh, given, remedy, list(surfaces.values()))
        document = loaded.resolve_points(document)
    for loaded in surfaces.values():
        loaded.set_shown_with(surfaces.values())
    for each in document.parts:
        each.check_files({name: loaded.surface for name, loaded in surfaces.items()})
    return document, surfaces


def compute(document: Document, surfaces: Surfaces, progress: Progress | None = None) -> list[Answer]:
    """Return each panel's answer; raise SolverError if all of them are failures."""
    asked = [(document.panel(id), question) for id, question in questions(document).items()]
    answers = []
    for k, (panel, question) in enumerate(asked):
        step = part(progress, k / len(asked), (k + 1) / len(asked))
        answers.append(question.answer(surfaces[panel.surface], step))
    refuse_if_nothing(answers)
    return answers


def refuse_if_nothing(answers: Sequence[Answer]) -> None:
    """Raise SolverError if all of them are failures: a figure of bare shapes helps nobody."""
    if answers and all(answer.failure for answer in answers):
        raise SolverError(" ".join(dict.fromkeys(answer.failure for answer in answers)))


def figure_of(recipe: Recipe, surfaces: Surfaces, answers: Sequence[Answer]) -> Figure:
    """Return the figure a recipe describes, from its panels' answers."""
    document, page = recipe.document, recipe.page
    style = style_of(page.style, document.colours)
    if not document.panels:
        raise ParameterError("The recipe has no panels.")
    marked = [
        marks_of(MarkedPanel(document, panel, surfaces, answer))
        for panel, answer in zip(document.panels, answers, strict=True)
    ]
    shown = {panel.id: answer for panel, answer in zip(document.panels, answers, strict=True)}
    columns = page.columns or (1 if page.layout else COLUMNS if changed_mesh(document) is not None else None)
    arrangement = Arrangement(tuple(range(len(document.panels))), columns)
    if page.rows:
        arrangement = arranged(document, page.rows, surfaces, answers)
    elif page.chart:
        arrangement = replace(arrangement, columns=columns or len(document.panels))
    panels = tuple(
        replace(
            _figure_panel(recipe, panel, surfaces, answer, marks),
            maximum=(
                own_end(document, shown, panel.id, surfaces.get)
                if document.range == "own"
                else typed_end(document, panel.id, answer)
            ),
            ground=page.ground,
            feature_edges=page.feature_edges,
        )
        for panel, answer, marks in zip(document.panels, answers, marked, strict=True)
    )
    remarks = [DEPTHS] if document.scale_bar and not document.parallel_projection else []
    remarks += [mark.text for marks in marked for mark in marks if isinstance(mark, Remark)]
    if any(str(view).startswith(("lateral", "medial")) for panel in panels for view in panel.views):
        with suppress(ParameterError):  # the user has named the side
            remarks += [loaded.memory(Hemispheres).sentence(loaded) for loaded in surfaces.values()]
    size = Size.parse(page.size) if page.size else Size()
    legend, left_out = legend_of_labels(answers)
    if legend and size.height is not None:
        legend, left_out = (), "There is no legend of labels on a page of given height; give its width only."
    figure = Figure(
        tuple(panels[k] for k in arrangement.order),
        remarks=tuple(dict.fromkeys([*remarks, left_out] if left_out else remarks)),
        legend=legend,
        columns=arrangement.columns,
        order=arrangement.order,
        row_heads=arrangement.row_heads,
        column_heads=arrangement.column_heads,
        size=size,
        style=style,
        range=document.range,
        transparent=page.transparent,
        crop=page.crop,
        title=page.title,
        letters=page.panel_letters,
        dashes_all=not page.layout,
        font=page.font_family,
        text=page.font_size,
    )
    if not page.chart:
        return figure
    return replace(figure, charts=charts_of(document, page, surfaces, answers, arrangement, figure.upper_limits()))


def check_drawable(recipe: Recipe, surfaces: Surfaces, extension: str = ".png") -> None:
    """Raise BihdistError before long work if a figure cannot be drawn into such a file, or has no room."""
    check_room(figure_of(recipe, surfaces, [Answer(label="")] * len(recipe.document.panels)), extension)


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
    """Write the figure at `path` and its recipe beside it, both or neither.

    Parameters
    ----------
    say
        Called with a sentence on each thing that is unusual.
    tex
        The panels' answers, if a LaTeX snippet is to be written, too.
    """
    check_export(recipe.document, path)
    place, format = place_beside(path, recipe)
    usual, is_new = recipe_paths(path)[0], not place.exists()
    with ExitStack() as files:
        files.enter_context(recipe_written(recipe, given, place, version, format=format))
        if tex is not None:
            snippet = files.enter_context(atomic_write(check_tex(path)))
            snippet.write_text(tex_snippet(figure, recipe, tex, Path(path)), encoding="utf-8")
        remarks = save_figure(figure, path, progress)
    for remark in remarks:
        say(remark)
    if place != usual and is_new:
        say(f"The recipe is in {place}, as {usual.name} belongs to another file.")


def export(
    recipe: Recipe,
    path: str,
    version: str,
    progress: Progress | None = None,
    say: Callable[[str], None] = _silent,
    tex: bool = False,
) -> tuple[Figure, Recipe, list[Answer]]:
    """Read, compute, draw and write a figure; return it, the recipe with its sources, and the answers.

    `say` gets sentences as in `write_figure`; with `tex` a LaTeX snippet is written, too.
    """
    check_export(recipe.document, path)
    check_transparency(recipe.page.transparent, path)
    if tex:
        check_tex(path)
    given = ArrayStore.read(recipe)
    document, surfaces = open_document(recipe, given)
    recipe = replace(recipe, document=document)
    check_drawable(recipe, surfaces, Path(path).suffix.lower())
    answers = compute(document, surfaces, part(progress, 0.0, 0.6))
    figure = figure_of(recipe, surfaces, answers)
    write_figure(figure, recipe, given, path, version, part(progress, 0.6, 1.0), say, answers if tex else None)
    return figure, recipe, answers


def _figure_panel(
    recipe: Recipe, panel: Panel, surfaces: Surfaces, answer: Answer, marks: Sequence[SurfaceMark]
) -> FigurePanel:
    document, loaded = recipe.document, surfaces[panel.surface]
    surface = loaded.surface
    starts = [source_at(document.point(name).at, surface) for name in panel.shows.points]
    heading = answer.label
    if loaded.origin is not None and not panel.shows.compares_meshes:
        heading += f", after: {loaded.mesh.change}"
    if words := source_words(document, panel, surfaces):
        heading += f", {words}"
    hint = "; ".join(text for text in (panel.shows.hint * recipe.page.hints, answer.remark) if text)
    for caption in (mark for mark in marks if isinstance(mark, Caption) and mark.plain):
        heading, hint = caption.plain, caption.sentence[0]
    through = passed(document, panel.surface, loaded, answer)
    up = document.up_of(panel.surface)
    up = up if up != "auto" else loaded.up
    views, parts = recipe.page.views or (document.camera_of(panel.surface),), tuple[Surface, ...]()
    if recipe.page.layout == "hemispheres":
        sides = loaded.memory(Hemispheres).of(loaded)
        views = tuple(view for side in sides for view in LATERAL_AND_MEDIAL[side])
        parts = tuple(sides[side] for side in sides for _ in LATERAL_AND_MEDIAL[side])
    return FigurePanel(
        surface,
        answer.field,
        colours=answer.colours,
        are_labels=answer.labels is not None,
        heading=heading,
        hint=hint,
        label="" if answer.failure else answer.label,
        unit=document.unit_of(answer.unit),
        failure=answer.failure,
        isolines=NO_LINES if answer.is_rough else _isolines(document, answer),
        through=tuple(point.value for point in through),
        views=tuple(loaded.view_of(view, up) for view in views),
        parts=parts,
        marks=tuple(_with_words(mark, recipe.page) for mark in marks if isinstance(mark, PointMark)),
        lines=tuple(mark for mark in marks if isinstance(mark, LineMark)),
        areas=tuple(mark for mark in marks if isinstance(mark, AreaMark)),
        insets=_insets(document, loaded),
        warp_factor=0.0 if answer.failure else document.warp_factor,
        signed=answer.is_signed,
        largest=answer.largest_words,
        shading=document.shading,
        base=None if answer.field is None else loaded.memory(BaseGreys).greys(document, panel, loaded),
        has_coloured_isolines=not document.base.white_isolines,
        up=up,
        source=vertex_at(starts[0], surface) if starts else None,
        is_parallel=document.parallel_projection,
        axes=document.axes,
        scale_unit=document.scale_unit,
        clip=document.clip,
        opacity=document.opacity,
    )


def _with_words(mark: PointMark, page: Page) -> PointMark:
    """Return a mark with its value, or a pin with its name in place of its number, where the page has them."""
    is_pin = mark.number is not None
    if not mark.value or not (page.pin_names if is_pin else page.anchor_values):
        return mark
    if is_pin:
        mark = replace(mark, glyph=NAMED, number=None, name=f"Pin {mark.value!r}")
    return replace(mark, text=mark.value)


def _isolines(document: Document, answer: Answer) -> Isolines:
    in_shares = document.range == "fraction" and answer.signs is None
    return in_unit(document.isolines, answer.scale, in_shares, answer.is_signed)


def _insets(document: Document, loaded: LoadedMesh) -> tuple[Inset, ...]:
    """Return insets at the same places of a changed surface."""
    if loaded.origin is None:
        return document.insets
    places = [vertex_at(map_to_derived(zoom.vertex, loaded), loaded.surface) for zoom in document.insets]
    return tuple(replace(zoom, vertex=vertex) for zoom, vertex in zip(document.insets, places, strict=True))
