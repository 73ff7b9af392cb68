"""`bihdist figure`: the window's comparison as a picture, without a window; and the options it shares with movies."""

import argparse
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from bihdist_core.counts import counted
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import OutputError, ParameterError
from bihdist_core.formats.mesh_names import mesh_name
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import short_words_of

from ..document.document import (
    Document,
    MeshFile,
    Panel,
    Point,
    comparison,
    free_names,
    from_points,
    starting_points,
    unnamed_fields,
)
from ..document.edits import put_point, show_in
from ..document.page import Recipe
from ..document.quantities import Quantity, from_point
from ..document.second_mesh_edits import open_second_mesh
from ..document.synonyms import COLOUR_MAPS
from ..figures.options import made_from, rows, with_options, with_rows
from ..figures.repair_options import REPAIRS
from ..version import version
from .mesh import check_mesh, sources_of_document, sources_of_two, write_ids_of
from .options import (
    MESH,
    PANELS,
    add_distance,
    add_output,
    add_rows,
    add_sources,
    check_parameters,
    fields_of,
    given,
    given_parameters,
    quantities,
    with_fields,
)
from .terminal import Result, panel_facts, progress_line, report_answers, tell, tell_repairs


def add_figure_options(parser: argparse.ArgumentParser, files: str, usual: str = ".png") -> None:
    """Add the options that both commands have; the value of one that is not given is None."""
    parser.add_argument("mesh", metavar="MESH", nargs="?", help=MESH)
    parser.add_argument("beside", metavar="BESIDE", nargs="?", help="a second mesh B, shown next to the first, A")
    add_sources(parser, "where distances start, a row of panels each, or with two meshes one of each")
    add_output(parser, files, usual=usual)
    add_distance(parser, PANELS, is_field=True)
    add_recipe(parser, "draw this recipe again; all other options change it")
    add_rows(parser, *rows())


def add_recipe(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the options of a recipe, or a session, that is taken instead of a mesh."""
    parser.add_argument("--recipe", metavar="FILE.json", help=what)
    parser.add_argument(
        "--mesh",
        dest="other_mesh",
        metavar="MESH",
        help="with --recipe: another mesh instead, with the same vertex ids",
    )


def chosen_recipe(options: argparse.Namespace) -> Recipe:
    """Make the recipe that the options describe; ParameterError if it makes no sense here."""
    if options.recipe is None:
        if options.other_mesh is not None:
            raise ParameterError("--mesh goes with --recipe; without a recipe, name the mesh by itself.")
        if options.mesh is None:
            raise ParameterError("There is nothing to draw; name a mesh, or a recipe with --recipe.")
        check_mesh(options.mesh)
        if options.mesh.lower().endswith(".json"):
            raise ParameterError(f"A recipe or a session is named with --recipe {options.mesh}.")
        return _changed(Recipe(comparison(options.mesh)), options)
    if options.mesh is not None:
        raise ParameterError(f"With --recipe, another mesh is named as --mesh {options.mesh}.")
    from ..document.file import read_recipe

    return _changed(read_recipe(options.recipe), options)


def _changed(recipe: Recipe, options: argparse.Namespace) -> Recipe:
    values = given(options, *rows())
    document, made = made_from(recipe.document)
    if options.other_mesh is not None:
        document = _with_other_mesh(document, options.other_mesh)
    document = with_fields(document, fields_of(options))
    document = with_rows(replace(recipe, document=document), given(options, REPAIRS), (REPAIRS,)).document
    asked, second = _sources(document, options), None
    if options.beside is not None:
        asked, second = sources_of_two(options.sources, asked, options.beside)
    document, columns = _with_panels(document, options, asked)
    if columns is not None and not made:
        recipe = replace(recipe, page=replace(recipe.page, columns=columns))
    recipe = with_rows(replace(recipe, document=document), made, rows())

    def with_second(document: Document) -> Document:
        return _with_beside(document, options.beside, second)

    with progress_line() as progress:
        recipe = with_options(recipe, values, with_second, tell, progress)
    tell_other_colours(values)
    _tell_if_unseen(recipe.page.style, values)
    return recipe


def _with_beside(document: Document, path: str | None, at: Source | None) -> Document:
    if path is None:
        return document
    check_mesh(path)
    return open_second_mesh(document, MeshFile("", path), at)


def tell_other_colours(values: Mapping[str, Any]) -> None:
    """Tell which colour map stands for a named one of another program."""
    from ..scene.colour_maps import MAPS

    name = str(values.get("cmap") or "")
    if word := COLOUR_MAPS.get(name.lower().removesuffix("_r")):
        tell(f"{name} is drawn with the colour map {word} ({MAPS[word].hint}).")


def _tell_if_unseen(style: str, values: dict[str, Any]) -> None:
    """Tell that colours are named for a style that has none."""
    from ..scene.style import STYLES

    named = [f"--{name.replace('_', '-')}" for name in ("cmap", "flip_scalars", "bands") if values.get(name)]
    if named and style in STYLES and not STYLES[style].coloured:
        tell(f"The style {style} has no colours; {', '.join(named)} cannot be seen in it.")


def _with_other_mesh(document: Document, path: str) -> Document:
    """Show another mesh, which may be any file, with the same points."""
    if len(document.surfaces) != 1:
        raise ParameterError(f"--mesh replaces one mesh, and this recipe has {len(document.surfaces)}.")
    check_mesh(path)
    return replace(document, surfaces=(replace(document.surfaces[0], path=path, sha256=""),))


def _sources(document: Document, options: argparse.Namespace) -> list[Source]:
    """Return the sources that the options name on the first mesh, none if they name none."""
    if options.sources is None:
        return []
    words = options.distance
    shows = quantities(options, words, [field.name for field in document.fields]) if words else []
    shown = shows or [panel.shows for panel in document.panels]
    mesh, areas = document.surfaces[0], options.areas or document.areas
    with progress_line() as progress:
        return sources_of_document(options.sources, mesh.path, shown, areas, mesh.repairs, progress)


def _with_panels(document: Document, options: argparse.Namespace, asked: list[Source]) -> tuple[Document, int | None]:
    """Change distances, parameters or sources; also return the number of panels in a row, if they stand in rows."""
    shown = dict.fromkeys(name for panel in document.panels for name in panel.shows.points)
    starts = list(dict.fromkeys(map(_place, map(document.point, shown))))
    if options.distance or (asked and len(asked) != len(starts)):
        words = options.distance
        shows = tuple(quantities(options, words, [field.name for field in document.fields])) if words else ()
        shows += tuple(unnamed_fields(options.fields or (), shows)) if words else ()
        shows = shows or tuple(
            dict.fromkeys(from_point(_respecified(panel.shows, options), "") for panel in document.panels)
        )
        if len(document.surfaces) != 1 and words:
            raise ParameterError(f"--distance makes the panels of one mesh; this recipe has {len(document.surfaces)}.")
        if len(document.surfaces) != 1:
            raise ParameterError(
                f"The {len(document.surfaces)} meshes of this recipe start from {counted(len(starts), 'source')}, and "
                f"--sources names {len(asked)}; name as many, those of the first mesh first."
            )
        surface, sources = document.surfaces[0].name, tuple(asked or document.sources)
        used = {*document.isolines.through, *(name for part in document.parts for name in part.points)}
        kept = [point for point in document.points if point.name in used]
        names = free_names("source", len(sources), [point.name for point in kept])
        points = [Point(name, at, surface) for name, at in zip(names, sources, strict=True)]
        panels = [Panel(k, each, surface) for k, each in enumerate(from_points(shows, names))]
        document = replace(document, points=(*points, *kept), panels=tuple(panels), next_id=len(panels))
        check_parameters(options, [spec for panel in document.panels for spec in panel.shows.parametrised])
        return document, len(shows) if len(sources) > 1 else None
    for panel in document.panels:
        document = show_in(document, panel.id, _respecified(panel.shows, options))
    check_parameters(options, [spec for panel in document.panels for spec in panel.shows.parametrised])
    if asked:
        moved = dict(zip(starts, asked, strict=True))
        for point in map(document.point, shown):
            document = put_point(document, point.name, moved[_place(point)], point.surface)
    return document, None


def _place(point: Point) -> tuple[Source | None, str]:
    """Return the source of a point, and the mesh that it is on."""
    return point.at, point.surface


def _respecified(shows: Quantity, options: argparse.Namespace) -> Quantity:
    """Change the parameters of a quantity that the options name and its distances have."""
    given = given_parameters(options)

    def respecified(spec: Spec) -> Spec:
        return spec.changed(**{p.name: given[p.name] for p in spec.distance_type.parameters if p.name in given})

    parts = (p if p.done or not p.parametrised else p.with_spec(respecified(p.parametrised[0])) for p in shows.parts)
    return shows.with_parts(tuple(parts))


WORDS = "draw the window's comparison as a picture, without a window"
EXAMPLES = (
    "bihdist figure hand --sources 12",
    "bihdist figure hand --distance biharmonic --isolines 30 --size 85mm -o hand.pdf",
    "bihdist figure --recipe hand.json --cmap uniform -o again.png",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `figure` to its parser."""
    add_figure_options(parser, "a .png, .pdf, .svg or .eps file")
    parser.add_argument("--tex", action="store_true", help="write a LaTeX snippet next to it, with a caption")


def _usual_output(mesh: str) -> str:
    """Return the usual file of a figure; OutputError if there is a file of that name without a recipe."""
    from ..document.file import is_recipe
    from ..session.recipe_file import recipe_paths

    path = f"{mesh_name(mesh)}.png"
    if Path(path).exists() and not any(each.exists() and is_recipe(each) for each in recipe_paths(path)):
        raise OutputError(
            f"There is a file {path} already, without a recipe beside it; name the figure's file with -o."
        )
    return path


def run(options: argparse.Namespace) -> Result:
    """Draw the figure and write its recipe; the exit status is 1 if a panel failed."""
    from ..figures.draw import described
    from ..figures.export import export
    from ..figures.tex import tex_path
    from ..session.questions import source_at
    from ..session.recipe_file import written_recipe

    recipe = chosen_recipe(options)
    options.output = options.output or _usual_output(recipe.document.surfaces[0].path)
    remarks: list[str] = []
    with progress_line() as progress:
        figure, recipe, answers = export(recipe, options.output, version(), progress, remarks.append, options.tex)
    for text in remarks:
        tell(text)
    for answer in answers:
        if answer.remark:
            print(f"{answer.label}: {answer.remark}")
    surface = figure.panels[0].surface
    tell_repairs(surface)
    points = [point for point in starting_points(recipe.document) if not point.image_of]
    ordered = zip(figure.order, figure.panels, strict=True)
    shown = {recipe.document.panels[k].surface: drawn.surface for k, drawn in ordered}
    starts = list(dict.fromkeys(source_at(point.at, shown[point.surface]) for point in points))
    nouns = {drawn.surface.nouns[0] for drawn in figure.panels}
    is_named = len(nouns) == 1 and all(isinstance(each, int) for each in starts)
    what = f", source {nouns.pop()} " if is_named else ", source "
    from_where = f"{what}{', '.join(map(short_words_of, starts))}" if starts else ""
    print(f"{options.output}: {described(figure, options.output)}{from_where}")
    ids_files = write_ids_of(recipe.document, options.output)
    document, snippet = recipe.document, str(tex_path(Path(options.output)))
    facts = {
        "meshes": [{"mesh": mesh.path} for mesh in document.surfaces],
        "outputs": [
            options.output,
            str(written_recipe(options.output)),
            *([snippet] if options.tex else []),
            *ids_files,
        ],
        "sources": [each if isinstance(each, int) else short_words_of(each) for each in starts],
        "panels": [panel_facts(p.shows, answer) for p, answer in zip(document.panels, answers, strict=True)],
    }
    return Result(facts, report_answers(answers, surface.name))
