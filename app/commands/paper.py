"""`bihdist paper`: the paper's figures, tables and claims, computed anew."""

import argparse
from functools import partial

from ..figures.view_options import UP, up_meaning
from .mesh import found_mesh
from .options import add_output, add_rows
from .result import Result
from .terminal import progress_line, tell_failure

WORDS = "recompute every figure and table of the paper, as one page"
EXAMPLES = (
    "bihdist paper -o paper --quick",
    "bihdist paper -o paper --only fig4,table2",
    "bihdist paper -o paper --mesh hand.ply",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `paper` to its parser."""
    add_output(parser, "a folder for index.html, pictures and numbers", metavar="DIR")
    parser.add_argument("--only", metavar="ID,…", default="", help="only these figures and tables, such as fig4,table2")
    parser.add_argument(
        "--mesh", metavar="MESH", help="your own mesh, or a folder of meshes (claims and a picture each)"
    )
    add_rows(parser, UP, viewup=up_meaning("y on the bundled meshes, guessed for yours"))
    parser.add_argument("--quick", action="store_true", help="use smaller meshes and fewer samples, for a first look")


def run(options: argparse.Namespace) -> Result:
    """Reproduce the paper; the exit status is 1 if a part could not be done, though the page is written."""
    from ..paper.reproduce import reproduce

    only = [word for word in options.only.split(",") if word]
    mesh = found_mesh(options.mesh) if options.mesh else None
    say, up = partial(print, flush=True), options.viewup or "auto"
    with progress_line() as progress:
        made = reproduce(options.output, only, mesh, options.quick, progress, say, up)
    print(f"{made.page}: open it in a browser")
    if made.not_done:
        parts = "One part" if made.not_done == 1 else f"{made.not_done} parts"
        tell_failure(f"{parts} could not be done; the reasons are on the page.")
    return Result({"outputs": [str(made.page)], "n_not_done": made.not_done}, int(made.not_done > 0))
