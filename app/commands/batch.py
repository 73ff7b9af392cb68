"""`bihdist batch`: the same work on many meshes, into a folder."""

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from bihdist_core.analysis.signature_types import SIGNATURES
from bihdist_core.counts import counted
from bihdist_core.errors import ParameterError

from ..batch.work_order import ARRAYS, COUNTS, GIFTI, KINDS, WORKS, WorkOrder, works_of
from ..document.document import comparison
from ..document.lists import standard_input
from ..document.page import Recipe
from ..document.quantities import quantity
from ..document.repairs import NO_REPAIRS
from ..document.sources import HIGHEST, Sources
from ..version import version
from .options import (
    DTYPES,
    NEIGHBOURS,
    PARAMETERS,
    add_areas,
    add_dask,
    add_distance,
    add_dtype,
    add_output,
    add_sources,
    add_workers,
    count,
    eigenpair_count,
    neighbour_count,
    specs,
)
from .terminal import Facts, Result, is_quiet, task_lines, tell, tell_failure
from .termination import status_of, words_of

if TYPE_CHECKING:
    from ..batch.engines import Engine
    from ..batch.maps import Map
    from ..batch.mesh_files import MeshFiles
    from ..batch.scheduler import Outcome, Tell
    from ..batch.storage import Folder
    from ..batch.task import Failure, Report, ResultRow

EIGENPAIRS = 100
"""So many, unless `--k` says otherwise."""

OF_RECIPE = ("distance", "areas", *PARAMETERS)
"""Options that a recipe says itself."""

DRAWN = {"figure": "vtkmodules", "evaluate": "matplotlib"}
"""Works whose results are drawn, and the module they need, which is not there where batches are all that runs."""

WORDS = "do the same work on many meshes, into a folder"
EXAMPLES = (
    "bihdist batch meshes --do fields --sources farthest:10 -o results",
    "bihdist batch hand beast --do figure -o pictures",
    "bihdist batch 'sub-*/surf/lh.pial+rh.pial' --do pairs --sources random:100 -o results",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `batch` to its parser."""
    parser.add_argument(
        "meshes",
        metavar="MESH",
        nargs="*",
        help="mesh files, names of samples, folders of meshes, or both hemispheres by a pattern: 'sub-*/lh.*+rh.*'",
    )
    parser.add_argument(
        "--list", metavar="FILE", help="more meshes, a path or a sample on each line; - for standard input"
    )
    parser.add_argument(
        "--do",
        metavar="WORK,…",
        required=True,
        type=lambda text: tuple(word.strip() for word in text.split(",") if word.strip()),
        help=f"some of {', '.join(WORKS)}, with commas: {'; '.join(KINDS[word].meaning for word in WORKS)}",
    )
    add_sources(parser, "where distances start on each mesh; {name} in @FILE is the mesh's name")
    add_output(parser, "a folder, or an address that fsspec knows, such as s3://...", metavar="DIR")
    add_distance(
        parser,
        f"for fields, pairs, nearest, fps and figure (default: biharmonic); for fields and figure also "
        f"{', '.join(SIGNATURES)}",
        k=f"the neighbours of nearest (default: {NEIGHBOURS}), the eigenpairs of eigen (default: {EIGENPAIRS})",
    )
    add_areas(parser)
    add_dtype(parser, "number format of arrays")
    parser.add_argument("--format", choices=ARRAYS, help="format of arrays (default: npy); func.gii for fields only")
    one_based = "with --format mat: vertex ids in files count from 1, as MATLAB's do, and files say so"
    parser.add_argument("--one-based", action="store_true", default=None, help=one_based)
    parser.add_argument(
        "--normalise", choices=("area",), help="compute distances and eigenpairs of each mesh scaled to area 1"
    )
    kinds = ".npy, .txt, .gii, .annot, .label or another file of FreeSurfer's; {name} is the mesh's name"
    parser.add_argument(
        "--mask",
        metavar="FILE",
        help=f"1 for each vertex that counts in results and 0 for others, which distances still cross: a {kinds}",
    )
    of_parcels = "for pairs: means between parcels; a number for each vertex, below 0 for none"
    parser.add_argument("--labels", metavar="FILE", help=f"{of_parcels}: a {kinds}")
    parser.add_argument(
        "--layout",
        choices=("dist", "geodist"),
        help="for pairs: .mat files in a folder as benchmarks of shape matching read them: dist for ULRSSM and others "
        "that divide by nothing and want --normalise area; geodist for GeomFmaps, DUO-FM and AttentiveFMaps",
    )
    parser.add_argument(
        "--recipe", metavar="FILE.json", help="for figure: the recipe to draw for each mesh, from its highest vertex"
    )
    parser.add_argument(
        "--clim",
        choices=("size", "shared", "own"),
        help="for figure: colours end at one value by the size of each mesh, the root of its area (default); at one "
        "value in mesh units; at each mesh's own maximum",
    )
    parser.add_argument("--maps", metavar="DIR", help="for evaluate: maps called cat-dog.npy, from cat to dog")
    parser.add_argument(
        "--truth",
        metavar="MAP",
        help="for evaluate: the correct maps, `identity` or a folder of maps with the same names",
    )
    parser.add_argument(
        "--symmetry",
        metavar="MAP",
        help="for evaluate: symmetric partners, which also count as correct; {name} is the mesh's name",
    )
    parser.add_argument("--samples", type=count, metavar="N", help="for evaluate: errors of N vertices (default: all)")
    verified = "check existing results against the checksums in their JSON"
    parser.add_argument("--verify", action="store_true", help=verified)
    add_workers(parser)
    add_dask(parser)


def run(options: argparse.Namespace) -> Result:
    """Do the chosen work for all meshes and write the tables; the exit status is 1 if some of it failed."""
    from ..batch.execution import PARTS
    from ..batch.results import check_format
    from ..batch.scheduler import Outcome, run_batch
    from ..batch.storage import Folder
    from ..batch.tables import write_tables
    from ..batch.task import Failure

    wanted = _wanted(options)
    check_format(wanted.arrays)
    _check_drawing(wanted.works)
    found = _meshes(options)
    meshes = found.paths
    address = options.output if "://" in options.output else os.path.abspath(options.output)
    folder, place = Folder(address), options.output.rstrip("/") or "/"
    folder.make()
    maps, failures = _maps(options, meshes)
    unnamed = [*failures]
    failures += [Failure(name, *each, why) for name, why in found.missing.items() for each in wanted.results()]
    evaluated = [*(map.name for map in maps), *(each.name for each in unnamed)] if "evaluate" in wanted.works else None
    engine, outcome = engine_of(options), Outcome(failures=failures)
    names = [*meshes, *found.missing]
    try:
        run_batch(meshes, maps, wanted, address, version(), engine, task_progress, outcome)
    except KeyboardInterrupt as error:
        done = counted(len(outcome.rows), "result")
        tell_failure(f"{words_of(error)}; {done} in {place}. Run the same command to resume.")
        return Result(_facts(folder, outcome, len(names)), status_of(error))
    finally:
        # Whatever happened, and before the pages, which may fail: the tables say what is there.
        try:
            engine.close()
        finally:
            write_tables(folder, outcome.rows, outcome.failures, names, evaluated)
    folder.sweep()
    left = folder.size(PARTS)
    if left:
        where = f"{place}/{PARTS}"
        tell(f"{where} has {left / 1e6:.1f} MB of unfinished work; run the same command to resume, or delete it.")
    else:
        folder.remove(PARTS)
    pages, lines = _pages(folder, outcome)
    if lines:
        write_tables(folder, [*outcome.rows, *lines], outcome.failures, names, evaluated)
    new = sum(row.is_new for row in outcome.rows)
    kept = len(outcome.rows) - new
    there = f", {kept} of them there before" if kept else ""
    print(f"{place}: {counted(len(outcome.rows), 'result')} of {counted(len(names), 'mesh', 'meshes')}{there}")
    for page in pages:
        print(f"{place}/{page}")
    if outcome.failures:
        for line in _reasons(outcome)[:5]:
            tell_failure(line)
        tell_failure(f"{counted(len(outcome.failures), 'result')} missing; {place}/failures.csv says why.")
    return Result(_facts(folder, outcome, len(names), pages), 1 if outcome.failures else 0)


def _check_drawing(works: Sequence[str]) -> None:
    """Raise ParameterError, before hours of work, if a package that draws results is not installed."""
    for work in works:
        if work in DRAWN and find_spec(DRAWN[work]) is None:
            raise ParameterError(
                f"--do {work} needs {DRAWN[work]}, which is not installed: `pip install bihdist` brings it."
            )


def _facts(folder: "Folder", outcome: "Outcome", n_meshes: int, pages: Sequence[str] = ()) -> Facts:
    """Return the results, the failures, and the tables and pages about them."""
    tables = ["summary.csv", *(["failures.csv"] if outcome.failures else [])]
    return {
        "output": str(folder),
        "n_meshes": n_meshes,
        "outputs": [f"{folder}/{name}" for name in (*tables, *pages)],
        "results": [
            {
                "mesh": row.name, "work": row.work, "distance": row.distance, "file": row.metadata["file"],
                "seconds": row.metadata.get("seconds"), "is_new": row.is_new,
            }
            for row in outcome.rows
        ],
        "failures": [
            {"mesh": each.name, "work": each.work, "distance": each.distance, "reason": each.reason}
            for each in outcome.failures
        ],
    }  # fmt: skip


def _meshes(options: argparse.Namespace) -> "MeshFiles":
    from ..batch.mesh_files import find_mesh_files

    if options.list != "-":
        return find_mesh_files(options.meshes, options.list or "")
    return find_mesh_files(options.meshes, "standard input", standard_input("meshes"))


def _reasons(outcome: "Outcome") -> list[str]:
    """Return a line for each mesh and reason, with all that is missing for it."""
    found: dict[tuple[str, str], list[str]] = {}
    for each in outcome.failures:
        found.setdefault((each.name, each.reason), []).append(f"{each.work} {each.distance}".strip())
    return [f"{name}: {', '.join(works)}: {reason}" for (name, reason), works in found.items()]


def _pages(folder: "Folder", outcome: "Outcome") -> "tuple[list[str], list[ResultRow]]":
    """Write the pages on all results; return the names of their files, and rows for the summary."""
    pages: list[str] = []
    lines: list[ResultRow] = []
    works = {row.work for row in outcome.rows}
    if "figure" in works:
        from ..batch.pages import write_pages

        pages += write_pages(folder, outcome.rows, outcome.failures)
    if "evaluate" in works:
        from ..batch.curves import write_curves

        files, lines = write_curves(folder, outcome.rows)
        pages += files
    return pages, lines


def _maps(options: argparse.Namespace, meshes: dict[str, str]) -> "tuple[list[Map], list[Failure]]":
    from ..batch.maps import found_maps
    from ..batch.task import Failure

    if "evaluate" not in options.do:
        return [], []
    if not options.maps or not options.truth:
        raise ParameterError("Maps are evaluated with --maps FOLDER and --truth identity, or a folder of maps.")
    symmetry = os.path.abspath(options.symmetry) if options.symmetry else ""
    maps, reasons = found_maps(options.maps, meshes, options.truth, symmetry, options.samples or 0)
    return maps, [Failure(name, "evaluate", "", reason) for name, reason in reasons.items()]


def _wanted(options: argparse.Namespace) -> WorkOrder:
    _check_together(options)
    words = list(dict.fromkeys(options.distance or ["biharmonic"]))
    eigenpairs, neighbours = _counts(options, words)
    between_two = {word for word in WORKS if KINDS[word].by_distance} - {"fields"}
    chosen = tuple(str(each) for each in specs(options, words, between_two.isdisjoint(options.do)))
    recipe = _recipe(options, chosen) if "figure" in options.do else ""
    return WorkOrder(
        works=options.do,
        distances=chosen,
        areas=options.areas or "voronoi",
        sources=_sources(options),
        eigenpairs=eigenpairs,
        nearest=neighbours,
        dtype=options.dtype or (DTYPES[1] if options.format == GIFTI else DTYPES[0]),
        arrays=options.format or "npy",
        one_based=bool(options.one_based),
        samples=options.samples or 0,
        layout=options.layout or "",
        normalise=options.normalise or "",
        cut=os.path.abspath(options.cut) if options.cut else "",
        merge=options.merge,
        largest_component=bool(options.largest_component),
        operator=options.operator or "cotan",
        labels=os.path.abspath(options.labels) if options.labels else "",
        mask=os.path.abspath(options.mask) if options.mask else "",
        recipe=recipe,
        range=options.clim or "size",
        verify=options.verify,
    )


def _counts(options: argparse.Namespace, words: list[str]) -> tuple[int, int]:
    """Read the numbers of eigenpairs and of neighbours from `--k`; ParameterError if it may be either."""
    counted = [work for work in COUNTS if work in options.do]
    if len(counted) > 1 and options.k is not None:
        raise ParameterError(f"--k {options.k} could count for nearest or for eigen; run them as two commands.")
    if "nearest" in counted:
        return EIGENPAIRS, neighbour_count(options, words)
    return (eigenpair_count(options, words, EIGENPAIRS) if counted else EIGENPAIRS), NEIGHBOURS


def _check_together(options: argparse.Namespace) -> None:
    """Raise ParameterError for options without an effect."""
    asked = {*options.do}
    if not asked or not asked <= {*WORKS}:
        return  # a work that there is not is refused before its options
    for name in vars(options):
        works = works_of("distance" if name in PARAMETERS and name != "k" else name)
        if not works or getattr(options, name) is None:
            continue
        counts = asked.intersection(works)
        if not counts:
            raise ParameterError(f"--{name.replace('_', '-')} needs --do {_either(works)}.")
        if options.recipe and name in OF_RECIPE and counts == {"figure"}:
            raise ParameterError(f"--{name} has no effect on figures drawn from a recipe; leave it out.")
        if options.labels and name == "sources" and counts == {"pairs"}:
            raise ParameterError(f"--{name} has no effect on the means between parcels; leave it out.")
    if options.one_based and options.layout:
        raise ParameterError(f"--one-based has no effect on --layout {options.layout}, whose files have no vertex ids.")
    if options.one_based and options.format != "mat":
        raise ParameterError(
            f"--one-based goes with --format mat; vertex ids in .{options.format or 'npy'} files count from 0."
        )
    if options.format == GIFTI and asked - {"fields", "figure"}:
        raise ParameterError(f"{GIFTI} files have values at vertices; they are written by --do fields.")
    if options.format == GIFTI and options.dtype == "float64":
        raise ParameterError(f"{GIFTI} files are in single precision; leave out --dtype float64.")
    takes_several = asked.intersection(works_of("sources")) - {"figure"} - ({"pairs"} if options.labels else set())
    if options.sources and options.sources.several and not takes_several:
        raise ParameterError("Figures have one source; name one vertex after --sources.")
    if options.layout and options.format not in (None, "npy"):
        raise ParameterError(f"--layout {options.layout} writes .mat files; leave out --format {options.format}.")


def _either(words: tuple[str, ...]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def _recipe(options: argparse.Namespace, distances: tuple[str, ...]) -> str:
    """Return the text of the recipe of all figures, from the highest vertex if no source is named."""
    from ..document.file import read_recipe, recipe_text

    if options.recipe:
        recipe = read_recipe(options.recipe)
        if len(recipe.document.surfaces) != 1:
            raise ParameterError(f"{options.recipe} has {len(recipe.document.surfaces)} meshes; one is drawn of each.")
    else:
        shows = tuple(map(quantity, distances))
        recipe = Recipe(comparison("mesh", shows, areas=options.areas or "voronoi"))
    if recipe.document.surfaces[0].repairs != NO_REPAIRS:
        raise ParameterError(
            f"{options.recipe} repairs its own mesh; batch does what --cut, --merge, --largest-component and "
            "--operator say."
        )
    document, members = recipe.document, options.sources.members if options.sources else ()
    first = members[0] if members else None
    points = tuple(replace(p, at=first) for p in document.points)
    surface = replace(document.surfaces[0], path="mesh", sha256="")
    document = replace(document, surfaces=(surface,), points=points)
    return recipe_text(replace(recipe, document=document), version())


def _sources(options: argparse.Namespace) -> Sources:
    asked = options.sources or HIGHEST
    return replace(asked, file=os.path.abspath(asked.file)) if asked.file and not asked.text else asked


def engine_of(options: argparse.Namespace) -> "Engine":
    """Return the engine of `--dask` or `--workers`."""
    from ..batch.engines import Cluster, Processes

    if options.dask:
        return Cluster(options.dask, tell)
    from bihdist_core.kernel.library import library

    library()  # where there is none, this process says why, and not each of those
    return Processes(options.workers or os.cpu_count() or 1)


@contextmanager
def task_progress(total: int) -> "Iterator[Tell]":
    """Show a bar with rate and time left on a terminal, a line for each task elsewhere, nothing if that is asked
    for."""
    if is_quiet():
        yield lambda report, done, of: None
        return
    if not sys.stderr.isatty():
        reached = (0, total)

        def line(report: "Report", done: int, of: int) -> None:
            nonlocal reached
            reached = done, of
            say(_line(report, done, of))

        with task_lines(lambda: f"{reached[0]} of {reached[1]} done, others under way") as say:
            yield line
        return
    from tqdm import tqdm

    # Some terminals, those of containers, say that they have no columns.
    has_size = os.get_terminal_size(sys.stderr.fileno()).columns > 0
    width: dict[str, Any] = {"dynamic_ncols": True} if has_size else {"ncols": 80, "nrows": 20}
    with tqdm(total=total, unit="task", file=sys.stderr, **width) as bar:

        def show(report: "Report", done: int, of: int) -> None:
            bar.total = of
            bar.set_postfix_str(report.task.words, refresh=False)
            bar.update(done - bar.n)

        yield show


def _line(report: "Report", done: int, of: int) -> str:
    remark = f"{len(report.failures)} failed" if report.failures else ""
    if not remark and report.rows and not any(row.is_new for row in report.rows):
        remark = "there before"
    return f"{done} of {of}: {report.task.words}{': ' if remark else ''}{remark}"
