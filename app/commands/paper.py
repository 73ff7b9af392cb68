"""`bihdist paper`: the paper's figures, tables and claims, computed anew."""

import argparse
import os
from functools import partial
from pathlib import Path

from bihdist_core.errors import ParameterError

from ..figures.view_options import UP, up_meaning
from .batch import engine_of, task_progress
from .mesh import found_mesh
from .options import add_dask, add_output, add_rows, add_workers
from .terminal import Result, progress_line, tell_failure

WORDS = "recompute every figure and table of the paper, as one page"
EXAMPLES = (
    "bihdist paper -o paper --quick",
    "bihdist paper -o paper --mesh hand.ply",
    "bihdist paper -o shrec --mesh meshes --aggregate --quick",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `paper` to its parser."""
    add_output(parser, "a folder for index.html, pictures and numbers", metavar="DIR")
    parser.add_argument("--only", metavar="ID,…", default="", help="only these figures and tables, such as fig4,table2")
    parser.add_argument(
        "--mesh", metavar="MESH", help="your own mesh, or a folder of meshes (claims and a picture each)"
    )
    add_rows(parser, UP, viewup=up_meaning("y on the bundled meshes, guessed for yours"))
    parser.add_argument("--quick", action="store_true", help="use smaller meshes and fewer sources, for a first look")
    parser.add_argument(
        "--aggregate", action="store_true", help="judge each statement over all meshes of a folder, on one page"
    )
    add_workers(parser)
    add_dask(parser, "with --aggregate: ")


def run(options: argparse.Namespace) -> Result:
    """Reproduce the paper; the exit status is 1 if a part could not be done, though the page is written."""
    from ..paper.reproduce import reproduce

    only = [word for word in options.only.split(",") if word]
    mesh = found_mesh(options.mesh) if options.mesh else None
    if options.aggregate:
        return _aggregated(options, only)
    if options.dask or options.workers:
        raise ParameterError("--dask and --workers need --aggregate.")
    say, up = partial(print, flush=True), options.viewup or "auto"
    with progress_line() as progress:
        made = reproduce(options.output, only, mesh, options.quick, progress, say, up)
    print(f"{made.page}: open it in a browser")
    if made.not_done:
        parts = "One part" if made.not_done == 1 else f"{made.not_done} parts"
        tell_failure(f"{parts} could not be done; the reasons are on the page.")
    return Result({"outputs": [str(made.page)], "n_not_done": made.not_done}, int(made.not_done > 0))


def _aggregated(options: argparse.Namespace, only: list[str]) -> Result:
    """Measure the statements on each mesh of a folder, as a batch that can be resumed, and write the page."""
    from bihdist_core.distances.distance_types import Spec

    from ..batch.mesh_files import find_mesh_files
    from ..batch.scheduler import Outcome, run_batch
    from ..batch.storage import Folder
    from ..batch.work_order import STATEMENTS, WorkOrder, thumbnail_name
    from ..document.document import comparison
    from ..document.file import recipe_text
    from ..document.page import Page, Recipe
    from ..paper.aggregate import MeshStatements, write_page
    from ..paper.reproduce import chosen
    from ..version import version

    if not options.mesh or not os.path.isdir(options.mesh):
        raise ParameterError("--aggregate needs a folder of meshes: --mesh FOLDER.")
    ids = tuple(each.id for each in chosen(only, options.mesh) if only or each.is_parallel)
    recipe = recipe_text(Recipe(comparison("mesh", (Spec.of("biharmonic"),)), Page(title="none")), version())
    order = WorkOrder(
        ("figure", STATEMENTS), recipe=recipe, experiments=ids, quick=options.quick, up=options.viewup or ""
    )
    out = os.path.abspath(options.output)
    folder, found, outcome = Folder(out), find_mesh_files([options.mesh]), Outcome()
    folder.make()
    engine = engine_of(options)
    try:
        run_batch(found.paths, [], order, out, version(), engine, task_progress, outcome)
    finally:
        engine.close()
    meshes = {
        row.name: MeshStatements.from_table(
            folder.read(row.metadata["file"]) or b"",
            folder.read(thumbnail_name(row.name)) or b"",
            row.metadata["not_done"],
        )
        for row in sorted(outcome.rows, key=lambda row: row.name)
        if row.work == STATEMENTS
    }
    for failure in outcome.failures:
        tell_failure(f"{failure.name}: {failure.work}: {failure.reason}")
    about = f"the {len(meshes)} meshes in the folder {Path(options.mesh).resolve().name}"
    page = write_page(Path(out), about, ids, meshes, options.quick)
    print(f"{os.path.join(options.output, page.name)}: open it in a browser")
    not_done = len(outcome.failures) + sum(len(mesh.not_done) for mesh in meshes.values())
    return Result({"outputs": [str(page)], "n_not_done": not_done}, int(not_done > 0))
