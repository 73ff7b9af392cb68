"""`bihdist figure`: the window's comparison as a picture, without a window."""

import argparse
from pathlib import Path

from bihdist_core.errors import OutputError
from bihdist_core.formats.mesh_names import mesh_name
from bihdist_core.sources.words import short_words_of

from ..document.document import starting_points
from ..version import version
from .figure_options import add_figure_options, chosen_recipe
from .mesh import write_ids_of
from .result import Result, panel_facts
from .terminal import progress_line, report_answers, tell, tell_repairs

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
    what = ", source vertex " if all(isinstance(each, int) for each in starts) else ", source "
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
