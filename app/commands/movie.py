"""`bihdist movie`: a figure in motion."""

import argparse
import os

from bihdist_core.errors import ParameterError

from .figure_options import add_figure_options, chosen_recipe
from .mesh import usual_output, write_ids_of
from .options import add_workers
from .result import Result, panel_facts
from .terminal import progress_line, report_answers

WORDS = "draw a figure that turns, or whose source moves, as MP4 or GIF"
EXAMPLES = (
    "bihdist movie hand -o turn.gif --frames 40",
    "bihdist movie hand --path 12,900 --distance biharmonic -o walk.gif",
    "bihdist movie --recipe hand.json -o turn.gif --fps 10",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `movie` to its parser."""
    add_figure_options(parser, "a .mp4 or .gif file", usual=".gif")
    parser.add_argument(
        "--turn",
        type=float,
        metavar="DEGREES",
        help="how far the shape turns, in degrees (default: 360, or 0 with --path)",
    )
    parser.add_argument(
        "--path",
        type=_path,
        default=(),
        metavar="V,…",
        help="move the source through these vertices, instead of --sources",
    )
    parser.add_argument("--frames", type=int, default=120, metavar="N", help="number of frames (default: 120)")
    parser.add_argument("--fps", type=float, default=25.0, metavar="N", help="frames per second (default: 25)")
    add_workers(parser)


def run(options: argparse.Namespace) -> Result:
    """Draw the movie and write its recipe; the exit status is 1 if a panel failed."""
    from ..figures.movie import Movie, check_movie, write_movie
    from ..figures.raster import check_offscreen

    if options.output:
        check_movie(options.output)
    check_offscreen()
    for given, name in (
        (options.path and options.sources, "--sources beside --path, whose first vertex is the source"),
        (options.transparent, "--transparent"),
        (options.crop, "--crop"),
        (len(options.cpos or ()) > 1, "more than one view"),
    ):
        if given:
            raise ParameterError(f"A movie takes no {name.removeprefix('no ')}.")
    turn = options.turn if options.turn is not None else 0.0 if options.path else 360.0
    recipe = chosen_recipe(options)
    options.output = options.output or usual_output(recipe.document.surfaces[0].path, options.usual_output)
    movie = Movie(recipe, turn, options.path, options.frames, options.fps)
    with progress_line() as progress:
        answers = write_movie(movie, options.output, progress, workers=options.workers)
    print(f"{options.output}: {movie.frames:,} frames, {movie.frames / movie.fps:.3g} s")
    document = movie.recipe.document
    ids_files = write_ids_of(document, options.output)
    facts = {
        "meshes": [{"mesh": mesh.path} for mesh in document.surfaces],
        "outputs": [options.output, *ids_files],
        "frames": movie.frames,
        "seconds": movie.frames / movie.fps,
        "panels": [panel_facts(p.shows, answer) for p, answer in zip(document.panels, answers, strict=True)],
    }
    return Result(facts, report_answers(answers, os.path.basename(document.surfaces[0].path)))


def _path(text: str) -> tuple[int, ...]:
    try:
        return tuple(int(word) for word in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not vertex ids with commas between them") from None
