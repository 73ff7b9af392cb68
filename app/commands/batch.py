"""`bihdist batch`: the same work on many meshes, into a folder."""

import argparse
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from bihdist_core.counts import counted

from ..batch.work_kinds import KINDS, WORKS, works_of
from ..version import version
from .options import PARAMETERS, add_areas, add_distance, count, source, specs
from .terminal import tell

if TYPE_CHECKING:
    from ..batch.drive import Outcome, Tell
    from ..batch.engines import Engine
    from ..batch.maps import Map
    from ..batch.storage import Folder
    from ..batch.task import Failure, Report, Row
    from ..batch.work_order import Sources, WorkOrder

INTERRUPTED = 130
"""The exit status, as everywhere."""

RULES = ("source", "sources", "landmarks", "sample")
OF_RECIPE = ("distance", "areas", *PARAMETERS)
"""Options that a recipe says itself."""
WORDS = "the same work on many meshes: fields, pairs, neighbours, eigenpairs, farthest points, figures, into a folder"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `batch` to its parser."""
    parser.add_argument("meshes", help="a folder with meshes, or a list of paths or samples, one a line")
    parser.add_argument("--out", metavar="DIR", required=True, help="a folder, or s3://... and what else fsspec knows")
    parser.add_argument(
        "--do",
        metavar="WORKS",
        required=True,
        type=lambda text: tuple(word.strip() for word in text.split(",") if word.strip()),
        help=f"some of {', '.join(WORKS)}, with commas: {'; '.join(KINDS[word].meaning for word in WORKS)}",
    )
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--source", type=source, metavar="V", nargs="+", help="vertices, as of `field`, on each mesh")
    which.add_argument(
        "--sources", metavar="RULE", help="farthest:K, K vertices each farthest from those before it; or all"
    )
    which.add_argument(
        "--landmarks", metavar="FILE", help="vertices from a .npy, .txt or file of pins; {name} is the mesh's name"
    )
    which.add_argument("--sample", type=count, metavar="K", help="K random vertices, the same each time")
    parser.add_argument("--seed", type=int, metavar="N", help="of --sample (default: 0)")
    parser.add_argument("--nearest", type=count, metavar="K", help="for nearest (default: 10)")
    parser.add_argument("--eigenpairs", type=count, metavar="K", help="for eigen (default: 100)")
    of_parcels = "for pairs: means between parcels; a number for each vertex, below 0 for none"
    parser.add_argument("--labels", metavar="FILE", help=of_parcels)
    parser.add_argument("--mask", metavar="FILE", help="0 or 1 for each vertex: which count")
    parser.add_argument("--recipe", metavar="NAME.json", help="for figure: drawn of each mesh, from its highest vertex")
    parser.add_argument(
        "--range",
        choices=("size", "shared", "own"),
        help="for figure: colours end at one value by the size of each mesh, the root of its area (default); at one "
        "value in mesh units; at each mesh's own maximum",
    )
    parser.add_argument(
        "--layout",
        choices=("dist", "geodist"),
        help="for pairs: .mat files in a folder as benchmarks of shape matching read them: dist for ULRSSM and others "
        "that divide by nothing and want --normalise area; geodist for GeomFmaps, DUO-FM and AttentiveFMaps",
    )
    parser.add_argument("--normalise", choices=("area",), help="distances and eigenpairs of each mesh scaled to area 1")
    parser.add_argument("--maps", metavar="FOLDER", help="for evaluate: maps called cat-dog.npy, from cat to dog")
    parser.add_argument("--truth", metavar="WHAT", help="for evaluate: identity, or a folder of maps of the same names")
    parser.add_argument(
        "--symmetry", metavar="FILE", help="for evaluate: partners of vertices that count as right, too"
    )
    parser.add_argument("--samples", type=count, metavar="K", help="for evaluate: of so many vertices")
    parser.add_argument("--format", choices=("npy", "npz", "mat", "zarr"), help="of arrays (default: npy)")
    parser.add_argument("--dtype", choices=("float32", "float64"), help="of arrays (default: float64)")
    verified = "results that are there count only if their bytes have the checksum of their JSON"
    parser.add_argument("--verify", action="store_true", help=verified)
    parser.add_argument("--workers", type=count, metavar="K", help="processes here (default: as many as cores)")
    parser.add_argument("--dask", metavar="WHERE", help="a Dask cluster: tcp://HOST:PORT or its scheduler's .json")
    add_distance(parser, "repeat for more (default: biharmonic)")
    add_areas(parser)


def run(options: argparse.Namespace) -> int:
    """Do the chosen work for all meshes and write the tables; the exit status is 1 if some of it failed."""
    from ..batch.drive import Outcome, do_all, found_meshes, write_tables
    from ..batch.execution import PARTS
    from ..batch.results import check_format
    from ..batch.storage import Folder

    wanted = _wanted(options)
    check_format(wanted.arrays)
    meshes = found_meshes(options.meshes)
    address = options.out if "://" in options.out else os.path.abspath(options.out)
    folder = Folder(address)
    folder.make()
    maps, unnamed = _maps(options, meshes)
    evaluated = [*(map.name for map in maps), *(each.name for each in unnamed)] if "evaluate" in wanted.works else None
    engine, outcome = _engine(options), Outcome(failures=unnamed)
    try:
        do_all(meshes, maps, wanted, address, version(), engine, _progress, outcome)
    except KeyboardInterrupt:
        done = counted(len(outcome.rows), "result")
        tell(f"interrupted; {done} in {folder}. The same command goes on from there.")
        return INTERRUPTED
    finally:
        # Whatever happened, and before the pages, which may fail: the tables say what is there.
        try:
            engine.close()
        finally:
            write_tables(folder, outcome, meshes, evaluated)
    folder.sweep()
    left = folder.size(PARTS)
    if left:
        where = f"{folder}/{PARTS}"
        tell(f"{where} has {left / 1e6:.1f} MB of unfinished work; the same command goes on from there, or delete it.")
    else:
        folder.remove(PARTS)
    pages, lines = _pages(folder, outcome)
    if lines:
        write_tables(folder, outcome, meshes, evaluated, lines)
    new = sum(row.is_new for row in outcome.rows)
    kept = len(outcome.rows) - new
    there = f", {kept} of them there before" if kept else ""
    print(f"{folder}: {counted(len(outcome.rows), 'result')} of {counted(len(meshes), 'mesh', 'meshes')}{there}")
    for page in pages:
        print(f"{folder}/{page}")
    if outcome.failures:
        for line in _reasons(outcome)[:5]:
            tell(line)
        tell(f"{counted(len(outcome.failures), 'result')} missing; {folder}/failures.csv says why.")
    return 1 if outcome.failures else 0


def _reasons(outcome: "Outcome") -> list[str]:
    """A line for each mesh and reason, with all that is missing for it."""
    found: dict[tuple[str, str], list[str]] = {}
    for each in outcome.failures:
        found.setdefault((each.name, each.reason), []).append(f"{each.work} {each.distance}".strip())
    return [f"{name}: {', '.join(works)}: {reason}" for (name, reason), works in found.items()]


def _pages(folder: "Folder", outcome: "Outcome") -> "tuple[list[str], list[Row]]":
    """What shows all results at once: the names of its files, and lines for the summary."""
    pages: list[str] = []
    lines: list[Row] = []
    works = {row.work for row in outcome.rows}
    if "figure" in works:
        from ..batch.pages import write_pages

        pages += write_pages(folder, outcome.rows, outcome.failures)
    if "evaluate" in works:
        from ..batch.curves import write_curves

        files, lines = write_curves(folder, outcome.rows)
        pages += files
    return pages, lines


def _maps(options: argparse.Namespace, meshes: "dict[str, str]") -> "tuple[list[Map], list[Failure]]":
    from bihdist_core.errors import ParameterError

    from ..batch.maps import found_maps
    from ..batch.task import Failure

    if "evaluate" not in options.do:
        return [], []
    if not options.maps or not options.truth:
        raise ParameterError("Maps are evaluated with --maps FOLDER and --truth identity, or a folder of maps.")
    symmetry = os.path.abspath(options.symmetry) if options.symmetry else ""
    maps, reasons = found_maps(options.maps, meshes, options.truth, symmetry, options.samples or 0)
    return maps, [Failure(name, "evaluate", "", reason) for name, reason in reasons.items()]


def _wanted(options: argparse.Namespace) -> "WorkOrder":
    from ..batch.work_order import WorkOrder

    _check_together(options)
    chosen = tuple(str(each) for each in specs(options, list(dict.fromkeys(options.distance or ["biharmonic"]))))
    recipe = _recipe(options, chosen) if "figure" in options.do else ""
    return WorkOrder(
        works=options.do,
        distances=chosen,
        areas=options.areas or "voronoi",
        sources=_sources(options),
        eigenpairs=options.eigenpairs or 100,
        nearest=options.nearest or 10,
        dtype=options.dtype or "float64",
        arrays=options.format or "npy",
        samples=options.samples or 0,
        layout=options.layout or "",
        normalise=options.normalise or "",
        labels=os.path.abspath(options.labels) if options.labels else "",
        mask=os.path.abspath(options.mask) if options.mask else "",
        recipe=recipe,
        range=options.range or "size",
        verify=options.verify,
    )


def _check_together(options: argparse.Namespace) -> None:
    """ParameterError for options that would be left without effect."""
    from bihdist_core.errors import ParameterError

    asked = {*options.do}
    if not asked or not asked <= {*WORKS}:
        return  # a work that there is not is refused before its options
    for name in vars(options):
        works = works_of("distance" if name in PARAMETERS else name)
        if not works or getattr(options, name) is None:
            continue
        counts = asked.intersection(works)
        if not counts:
            raise ParameterError(f"--{name} goes with --do {_either(works)}.")
        if options.recipe and name in OF_RECIPE and counts == {"figure"}:
            raise ParameterError(f"--{name} has no effect on figures of a recipe, which says it; leave it out.")
        if options.labels and name in RULES and counts == {"pairs"}:
            raise ParameterError(f"--{name} has no effect on the means between parcels; leave it out.")
    if options.seed is not None and options.sample is None:
        raise ParameterError("--seed goes with --sample.")
    takes_several = asked.intersection(works_of("sources")) - ({"pairs"} if options.labels else set())
    if len(options.source or ()) > 1 and not takes_several:
        raise ParameterError("Figures have one source; name one vertex after --source.")
    if options.layout and options.format not in (None, "npy"):
        raise ParameterError(f"--layout {options.layout} writes .mat files; leave out --format {options.format}.")


def _either(words: tuple[str, ...]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def _recipe(options: argparse.Namespace, distances: tuple[str, ...]) -> str:
    """That of all figures, from the highest vertex of each mesh if no source is named."""
    from dataclasses import replace

    from bihdist_core.distances.kinds import Spec
    from bihdist_core.errors import ParameterError

    from ..document.document import comparison
    from ..document.file import read_recipe, recipe_text
    from ..document.page import Recipe

    if options.recipe:
        recipe = read_recipe(options.recipe)
        if len(recipe.document.surfaces) != 1:
            raise ParameterError(f"{options.recipe} has {len(recipe.document.surfaces)} meshes; one is drawn of each.")
    else:
        shows = tuple(Spec.parse(each) for each in distances)
        recipe = Recipe(comparison("mesh", shows, areas=options.areas or "voronoi"))
    document = recipe.document
    points = tuple(replace(p, at=options.source[0] if options.source else None) for p in document.points)
    surface = replace(document.surfaces[0], path="mesh", sha256="")
    document = replace(document, surfaces=(surface,), points=points)
    return recipe_text(replace(recipe, document=document), version())


def _sources(options: argparse.Namespace) -> "Sources":
    from bihdist_core.errors import ParameterError
    from bihdist_core.sources.words import short_words_of

    from ..batch.work_order import Sources

    if options.landmarks:
        return Sources("landmarks", file=os.path.abspath(options.landmarks))
    if options.sample:
        return Sources("sample", count=options.sample, seed=options.seed or 0)
    if options.sources:
        rule, _, number = options.sources.partition(":")
        if rule == "all" and not number:
            return Sources("all")
        if rule == "farthest" and number.isdigit() and int(number) > 0:
            return Sources("farthest", count=int(number))
        raise ParameterError(f"{options.sources!r} is no rule for sources; it is farthest:400, say, or all.")
    words = tuple(short_words_of(each) for each in options.source or ())
    return Sources("vertices", words)


def _engine(options: argparse.Namespace) -> "Engine":
    from ..batch.engines import Cluster, Processes

    if options.dask:
        return Cluster(options.dask)
    return Processes(options.workers or os.cpu_count() or 1)


@contextmanager
def _progress(total: int) -> "Iterator[Tell]":
    """A bar with rate and time left on a terminal, a line for each task elsewhere."""
    if not sys.stderr.isatty():
        yield _line
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


def _line(report: "Report", done: int, of: int) -> None:
    remark = f"{len(report.failures)} failed" if report.failures else ""
    if not remark and report.rows and not any(row.is_new for row in report.rows):
        remark = "there before"
    print(f"{done} of {of}: {report.task.words}{': ' if remark else ''}{remark}", file=sys.stderr)
