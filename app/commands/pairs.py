"""`bihdist pairs`: distances between chosen vertices, or all of them, into a file."""

import argparse
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING

from bihdist_core.counts import counted
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import BihdistError, ParameterError

from ..document.repairs import NAME
from ..document.sources import ALL, Sources
from ..version import version
from .mesh import (
    add_meshes,
    check_array_output,
    found_mesh,
    into_each,
    name_output,
    read_laplacian,
    sources_of_mesh,
    sources_on,
)
from .options import (
    DTYPES,
    NEIGHBOURS,
    add_areas,
    add_dask,
    add_distance,
    add_dtype,
    add_output,
    add_pairs,
    add_sources,
    neighbour_count,
    positive,
    specs,
)
from .terminal import Facts, Result, accuracy, distance_facts, progress_line, tell, tell_failure

if TYPE_CHECKING:
    from bihdist_core.analysis.all_pairs import Begun, Rows
    from bihdist_core.distances.distance import Distance

WORDS = "compute distances between chosen vertices, or to their nearest ones"
EXAMPLES = (
    "bihdist pairs hand --sources 12,40,99 -o pairs.csv",
    "bihdist pairs hand --sources 12,40 --nearest --k 10 -o nearest.csv",
    "bihdist pairs domain --sources all -o all.npy",
)
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `pairs` to its parser."""
    add_meshes(parser)
    what = "vertices; all pairs among them are written"
    add_sources(parser, what, default="(default for --nearest: all)", are_vertices=True)
    add_pairs(
        parser,
        "pairs, instead of --sources: 1:2,3:4; or a file with a line `i,j` for each, @FILE, or - for standard input; "
        "or landmarks of two files, @FILE,FILE",
    )
    files = f"a .npy or .csv file, for --nearest also .npz or .json; {NAME}: each mesh's"
    add_output(parser, files, usual="-pairs.npy")
    add_distance(parser, "a column each (default: biharmonic)", k=f"neighbours of --nearest (default: {NEIGHBOURS})")
    add_areas(parser)
    parser.add_argument(
        "--nearest",
        action="store_true",
        help="write the --k vertices nearest to each source, as rows `i,j,distance`, nearest first",
    )
    add_dtype(parser, "number format of a .npy matrix of all pairs among the sources")
    parser.add_argument("--memory", type=positive, metavar="MB", help="for --sources all (default: 500)")
    reach = "for --sources all by the exact geodesic distance: go so far, in mesh units; what is beyond is inf"
    parser.add_argument("--radius", type=positive, metavar="R", help=reach)
    add_dask(parser, "for --sources all: ")
    parser.add_argument(
        "--fresh",
        action="store_true",
        help="for --sources all: start again, and discard the hidden .part file next to the output from which an "
        "interrupted run resumes",
    )


def run(options: argparse.Namespace) -> Result:
    """Write the distances between pairs of vertices; the exit status is 1 if a mesh failed."""
    if options.sources is None and options.pairs is None and not options.nearest:
        raise ParameterError("Which pairs? Name those among --sources, such as 12,40,99 or all, or some by --pairs.")
    if options.pairs is not None and (options.sources is not None or options.nearest):
        other = "--nearest" if options.nearest else "--sources"
        raise ParameterError(f"--pairs and {other} are two ways to say which pairs; leave one out.")
    name_output(options)
    return into_each(options, _one)


def _one(options: argparse.Namespace) -> Facts:
    from bihdist_core.analysis.neighbours import NEIGHBOUR_FORMATS
    from bihdist_core.formats.field_output import ARRAY_FORMATS

    words = list(dict.fromkeys(options.distance or ["biharmonic"]))
    is_all = not options.nearest and options.sources is not None and options.sources.rule == ALL
    formats = (".npy",) if is_all else NEIGHBOUR_FORMATS if options.nearest else ARRAY_FORMATS
    extension = check_array_output(options.output, formats, "nearest" if options.nearest else "pairs")
    is_matrix = extension == ".npy" and not (options.nearest or options.pairs)
    count = neighbour_count(options, words) if options.nearest else 0
    chosen = specs(options, words)
    if (is_all or options.nearest) and len(chosen) > 1:
        word = "--sources all writes the pairs" if is_all else "--nearest writes the neighbours"
        raise ParameterError(f"{word} of one distance; name one.")
    for option in ("fresh", "memory", "radius", "dask"):
        if getattr(options, option) and not is_all:
            raise ParameterError(f"--{option} goes with --sources all.")
    if options.radius and chosen[0].word != "geodesic":
        raise ParameterError(f"--radius goes with --distance geodesic, not with {chosen[0].word}.")
    is_matrix = is_matrix and len(chosen) == 1
    if options.dtype and not is_matrix:
        raise ParameterError("--dtype goes with a matrix: a .npy of the pairs among --sources, of one distance.")
    if is_all:
        return _write_all(options, chosen[0])
    if options.nearest:
        return _write_nearest(options, chosen[0], count)
    return _write_pairs(options, chosen, is_matrix)


def _write_pairs(options: argparse.Namespace, chosen: list[Spec], is_matrix: bool) -> Facts:
    """Write all pairs among sources as a matrix or as rows, or named pairs as rows."""
    import numpy as np

    from bihdist_core.distances.answers import Distances
    from bihdist_core.formats.field_output import write_array
    from bihdist_core.formats.vertex_maps import read_pairs

    pins, among = None, list[int]()
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        distances = Distances(laplacian)
        if options.pairs:
            surface, pairs = laplacian.surface, options.pairs
            pairs = read_pairs(pairs, (surface, surface), tell) if isinstance(pairs, str) else np.array(pairs)
            laplacian.surface.check_vertices(np.unique(pairs))
        else:
            found = sources_on(options, laplacian.surface, lambda: distances.get(chosen[0], progress), progress)
            pins, among = found.pins, found.vertices("Pairs")
            if len(among) < 2:
                raise ParameterError(f"Pairs are among several sources; name another beside {among[0]}.")
            pairs = np.array([(i, j) for k, i in enumerate(among) for j in among[k + 1 :]]).reshape(-1, 2)
        answers, lines, used = [], [], []
        for each in chosen:
            distance = distances.get(each, progress)
            answers.append(distance.pairwise(among, progress) if is_matrix else distance.of_pairs(pairs, progress))
            lines.append(f"{distance.label}, {counted(len(pairs), 'pair')}{accuracy(distance)}")
            used.append(distance_facts(distance, each))
    if is_matrix:
        write_array(options.output, answers[0].astype(options.dtype or DTYPES[0], copy=False))
    else:
        names = ["distance"] if len(chosen) == 1 else [str(each) for each in chosen]
        columns, header = [pairs, *answers], ["i", "j", *names]
        if pins:
            columns = [*(pins.ids[k] for k in np.triu_indices(len(pins), 1)), *columns]
            header = ["pin_i", "pin_j", *header]
        write_array(options.output, np.column_stack(columns), header)
    for line in lines:
        print(f"{options.output}: {line}")
    return {"n_pairs": len(pairs), "distances": used}


def _write_nearest(options: argparse.Namespace, spec: Spec, count: int) -> Facts:
    """Write the nearest vertices of some vertices or of all."""
    import numpy as np

    from bihdist_core import nearest
    from bihdist_core.analysis.neighbours import write_nearest
    from bihdist_core.distances.answers import Distances

    from ..document.file import checksum

    with progress_line() as progress:
        laplacian = read_laplacian(options)
        surface = laplacian.surface
        distance = Distances(laplacian).get(spec, progress)
        asked = options.sources or Sources(ALL)
        found = sources_of_mesh(asked, options.mesh, surface, lambda: distance, progress)
        sources = np.array(found.vertices("Neighbours"))
        indices, values = nearest(distance, sources, count, progress=progress)
        estimate = accuracy(distance)
    facts = {
        "distance": str(spec), "label": distance.label, "unit": distance.unit, "normalisation": "none",
        "mesh": surface.name, "checksum": checksum(found_mesh(options.mesh)), "version": version(),
    }  # fmt: skip
    write_nearest(options.output, sources, indices, values, facts)
    there = int((indices >= 0).sum())
    size = f"{counted(there, 'neighbour')} of {counted(len(sources), 'vertex', 'vertices')}"
    print(f"{options.output}: {distance.label}, {size}{estimate}")
    return {"n_pairs": there, "distances": [distance_facts(distance, spec)]}


def _write_all(options: argparse.Namespace, spec: Spec) -> Facts:
    """Write the pairs of all vertices, and tell what is there of an earlier run, or is kept of this one."""
    from bihdist_core.analysis.all_pairs import begun, check_block, left_by_others, write_all_pairs
    from bihdist_core.distances.answers import Distances
    from bihdist_core.distances.geodesic import GeodesicDistance

    memory = 1e6 * (options.memory or 500)
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        check_block(len(laplacian.surface.vertices), memory)
        if options.radius is None:
            distance = Distances(laplacian).get(spec, progress)
        else:
            distance = GeodesicDistance(laplacian, str(spec["method"]), progress, radius=options.radius)
        estimate = accuracy(distance, everywhere=True)
    dtype = options.dtype or DTYPES[0]
    known = begun(distance, options.output, dtype)
    if known and options.fresh:
        tell(f"Discarding {_described(known)}.")
    elif known:
        tell(f"Resuming from {_described(known)}; --fresh starts again.")
    for path in left_by_others(distance, options.output, dtype):
        size = _size(path.stat().st_size)
        tell(f"{path} ({size}) is left over from another mesh or other options; it may be deleted.")
    try:
        with _cluster(options, distance, dtype) as compute, progress_line() as progress:
            write_all_pairs(distance, options.output, dtype, memory, progress, options.fresh, compute)
    except (KeyboardInterrupt, BihdistError, MemoryError):
        if left := begun(distance, options.output, dtype):
            tell_failure(f"Finished rows are kept: {_described(left)}. Run the same command to resume.")
        raise
    count = len(laplacian.surface.vertices)
    within = "" if options.radius is None else f" up to {options.radius:g}"
    print(f"{options.output}: {distance.label}{within}, all pairs of {count:,} vertices{estimate}")
    facts = distance_facts(distance, spec, everywhere=True)
    return {"n_pairs": count**2, "distances": [facts], **({"radius": options.radius} if within else {})}


def _cluster(options: argparse.Namespace, distance: "Distance", dtype: str) -> "AbstractContextManager[Rows | None]":
    """Return what computes blocks of rows: a Dask cluster if one is named, else this process."""
    if options.dask is None:
        return nullcontext()
    from ..batch.engines import rows_on_cluster

    return rows_on_cluster(options.dask, tell, distance, dtype)


def _described(known: "Begun") -> str:
    return f"{known.path}, {known.rows:,} of {known.n:,} rows ({_size(known.bytes)})"


def _size(count: int) -> str:
    return f"{count / 1e9:.2f} GB" if count >= 1e8 else f"{count / 1e6:.2f} MB"
