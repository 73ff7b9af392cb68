"""`bihdist figure`: the window's comparison as a picture, without a window."""

import argparse
from pathlib import Path

from bihdist_core.sources.words import short_words_of

from ..version import version
from .figure_options import add_figure_options, chosen_recipe
from .mesh import write_ids_of
from .result import Result, panel_facts
from .terminal import judged, progress_line, tell, tell_repairs

WORDS = "the window's comparison as a picture, without a window"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `figure` to its parser."""
    add_figure_options(parser, "a .png, .pdf, .svg or .eps file")
    parser.add_argument("--tex", action="store_true", help="a LaTeX snippet beside it, with a caption")


def run(options: argparse.Namespace) -> Result:
    """Draw the figure and write its recipe; the exit status is 1 if a panel failed."""
    from ..document.document import starting_points
    from ..figures.draw import described
    from ..figures.export import export
    from ..figures.tex import tex_path
    from ..session.questions import source_at
    from ..session.recipe_file import written_recipe

    recipe = chosen_recipe(options)
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
    shown = {panel.surface: drawn.surface for panel, drawn in zip(recipe.document.panels, figure.panels, strict=True)}
    starts = list(dict.fromkeys(source_at(point.at, shown[point.surface]) for point in points))
    what = ", source vertex " if all(isinstance(each, int) for each in starts) else ", source "
    print(f"{options.output}: {described(figure)}{what if starts else ''}{', '.join(map(short_words_of, starts))}")
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
    return Result(facts, judged(answers, surface.name))
