"""`bihdist movie`: a figure in motion."""

import argparse
import os

from bihdist_core.errors import ParameterError

from .figure import add_figure_options, chosen_recipe
from .mesh import usual_output, write_ids_of
from .options import add_workers
from .terminal import Result, panel_facts, progress_line, report_answers

WORDS = "draw a figure that turns, whose source moves or whose parameter changes, as MP4, WebM, GIF or PNG frames"
EXAMPLES = (
    "bihdist movie hand --path 12,900 --distance biharmonic -o walk.gif",
    "bihdist movie hand --sweep t=4..1/60 --distance diffusion --swing -o times.gif",
    "bihdist movie --recipe hand.json -o turn.gif --fps 10",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `movie` to its parser."""
    files = "a .mp4, .webm or .gif file, or names for a .png file of each frame, such as frames/%%04d.png"
    add_figure_options(parser, files, usual=".gif")
    parser.add_argument(
        "--turn",
        type=float,
        metavar="DEGREES",
        help="how far the shape turns, in degrees (default: 360; 90 with --swing, else 0 with --path or --sweep)",
    )
    parser.add_argument("--swing", action="store_true", help="turn the shape back and forth, with the source in view")
    parser.add_argument(
        "--path",
        type=_path,
        default=(),
        metavar="V,…",
        help="move the source through these vertices, instead of --sources",
    )
    parser.add_argument(
        "--sweep",
        default="",
        metavar="NAME=RANGE",
        help="change a parameter: over a range, t=4..1/60 or there and back alpha=1.05..3..1.05, or through values, "
        "k=10,50,200",
    )
    parser.add_argument("--frames", type=int, default=120, metavar="N", help="number of frames (default: 120)")
    parser.add_argument("--fps", type=float, default=25.0, metavar="N", help="frames per second (default: 25)")
    add_workers(parser)


def run(options: argparse.Namespace) -> Result:
    """Draw the movie and write its recipe; the exit status is 1 if a panel failed."""
    from ..figures.movie import Movie, write_movie
    from ..figures.movie_files import check_movie
    from ..figures.raster import check_offscreen

    if options.output:
        check_movie(options.output, options.frames)
    check_offscreen()
    for given, name in (
        (options.path and options.sources, "--sources beside --path, whose first vertex is the source"),
        (options.transparent, "--transparent"),
        (options.crop, "--crop"),
        (options.layout, "--layout"),
        (len(options.cpos or ()) > 1, "more than one view"),
    ):
        if given:
            raise ParameterError(f"A movie takes no {name.removeprefix('no ')}.")
    recipe = chosen_recipe(options)
    options.output = options.output or usual_output(recipe.document.surfaces[0].path, options.usual_output)
    movie = Movie(recipe, options.turn, options.swing, options.path, options.sweep, options.frames, options.fps)
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
