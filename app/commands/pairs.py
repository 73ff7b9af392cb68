"""`bihdist pairs`: distances between chosen vertices, or all of them, into a file."""

import argparse
from typing import TYPE_CHECKING

from bihdist_core.counts import counted

from ..version import version
from .mesh import NAME, add_meshes, found_mesh, into_each, read_laplacian
from .options import add_areas, add_distance, add_output, count, positive, specs, vertex, vertices
from .result import Facts, Result, distance_facts
from .terminal import accuracy, progress_line, tell, tell_failure, tell_moved

if TYPE_CHECKING:
    from bihdist_core.analysis.all_pairs import Begun
    from bihdist_core.distances.kinds import Spec
    from bihdist_core.formats.pins import Pins
    from bihdist_core.surface import Surface

WORDS = "distances between chosen vertices, or to those that are nearest"
TEXT = ".csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command `pairs` to its parser."""
    add_meshes(parser)
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--vertices", type=vertices, metavar="I,J,K", help="all distances among these")
    which.add_argument("--pins", metavar="FILE", help="the same among the pins in a .csv, .json or MeshLab's .pp file")
    which.add_argument("--pairs", type=_pair, nargs="+", metavar="I,J", help="the distances of these pairs")
    which.add_argument("--file", metavar="PAIRS.csv", help="the same from a file, a line `i,j` for each pair")
    goes_on = "all pairs of the mesh, to a .npy; goes on where it was interrupted, from a hidden .part file beside it"
    which.add_argument("--all", action="store_true", help=goes_on)
    which.add_argument(
        "--nearest", type=count, metavar="K", help="to the K nearest vertices of each: `i,j,distance`, nearest first"
    )
    parser.add_argument("--source", metavar="V", nargs="+", help="for --nearest: vertices, or all (default: all)")
    parser.add_argument("--fresh", action="store_true", help="for --all: discard what an interrupted run has left")
    parser.add_argument("--dtype", choices=("float32", "float64"), help="for --all (default: float32)")
    parser.add_argument("--memory", type=positive, metavar="MB", help="for --all (default: 500)")
    add_output(parser, f"a .npy or .csv file, for --nearest also .npz or .json; {NAME}: each mesh's")
    add_distance(parser, "a column; repeat for more (default: biharmonic)")
    add_areas(parser)


def run(options: argparse.Namespace) -> Result:
    """Write the distances between pairs of vertices; the exit status is 1 if a mesh failed."""
    return into_each(options, _one)


def _one(options: argparse.Namespace) -> Facts:
    import numpy as np

    from bihdist_core.analysis.neighbours_output import NEIGHBOUR_FORMATS
    from bihdist_core.distances.answers import Distances
    from bihdist_core.errors import ParameterError
    from bihdist_core.formats.field_output import ARRAY_FORMATS, write_array
    from bihdist_core.formats.vertex_maps import read_pairs
    from bihdist_core.whole_file import check_output

    formats = (".npy",) if options.all else NEIGHBOUR_FORMATS if options.nearest else ARRAY_FORMATS
    extension = check_output(options.output, formats)
    chosen = specs(options, list(dict.fromkeys(options.distance or ["biharmonic"])))
    if (options.all or options.nearest) and len(chosen) > 1:
        word = "--all writes the pairs" if options.all else "--nearest writes the neighbours"
        raise ParameterError(f"{word} of one distance; name one.")
    if options.source and not options.nearest:
        raise ParameterError("--source goes with --nearest, whose neighbours are wanted; vertices stand in --vertices.")
    for option in ("fresh", "dtype", "memory"):
        if getattr(options, option) and not options.all:
            raise ParameterError(f"--{option} goes with --all.")
    if options.all:
        return _write_all(options, chosen[0])
    if options.nearest:
        return _write_nearest(options, chosen[0])
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        distances = Distances(laplacian)
        pins = pins_in(options.pins, laplacian.surface) if options.pins else None
        if options.vertices or pins:
            among = pins.vertices if pins else laplacian.surface.check_vertices(options.vertices)
            pairs = np.array([(i, j) for k, i in enumerate(among) for j in among[k + 1 :]]).reshape(-1, 2)
        else:
            pairs = read_pairs(options.file) if options.file else np.array(options.pairs)
            laplacian.surface.check_vertices(np.unique(pairs))
        is_matrix = bool(options.vertices or pins) and extension == ".npy" and len(chosen) == 1
        answers, lines, used = [], [], []
        for each in chosen:
            distance = distances.get(each, progress)
            answers.append(distance.pairwise(among, progress) if is_matrix else distance.of_pairs(pairs, progress))
            lines.append(f"{distance.label}, {counted(len(pairs), 'pair')}{accuracy(distance)}")
            used.append(distance_facts(distance, each))
    if is_matrix:
        write_array(options.output, answers[0])
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


def _write_nearest(options: argparse.Namespace, spec: "Spec") -> Facts:
    """The nearest vertices of some, or of all."""
    import numpy as np

    from bihdist_core import nearest
    from bihdist_core.analysis.neighbours_output import write_nearest
    from bihdist_core.distances.answers import Distances

    from ..document.file import checksum

    with progress_line() as progress:
        laplacian = read_laplacian(options)
        surface = laplacian.surface
        asked = _asked(options.source)
        sources = np.flatnonzero(surface.component_of_vertex >= 0) if asked is None else surface.check_vertices(asked)
        distance = Distances(laplacian).get(spec, progress)
        indices, values = nearest(distance, sources, options.nearest, progress=progress)
        estimate = accuracy(distance)
    facts = {
        "distance": str(spec), "label": distance.label, "unit": distance.unit, "normalisation": "none",
        "mesh": surface.name, "checksum": checksum(found_mesh(options.mesh)), "version": version(),
    }  # fmt: skip
    write_nearest(options.output, sources, indices, values, facts)
    found = int((indices >= 0).sum())
    count = f"{counted(found, 'neighbour')} of {counted(len(sources), 'vertex', 'vertices')}"
    print(f"{options.output}: {distance.label}, {count}{estimate}")
    return {"n_pairs": found, "distances": [distance_facts(distance, spec)]}


def _asked(words: list[str] | None) -> list[int] | None:
    """The vertices whose neighbours are wanted, None for all."""
    from bihdist_core.errors import ParameterError

    if words is None or words == ["all"]:
        return None
    try:
        return [vertex(word) for word in words]
    except argparse.ArgumentTypeError as error:
        raise ParameterError(f"{error}; write --source 12 40, or --source all.") from None


def _write_all(options: argparse.Namespace, spec: "Spec") -> Facts:
    """The pairs of all vertices, and what is said of the part of them that is there already, or is left."""
    from bihdist_core.analysis.all_pairs import begun, left_by_others, write_all_pairs
    from bihdist_core.distances.answers import Distances
    from bihdist_core.errors import OutputError

    with progress_line() as progress:
        laplacian = read_laplacian(options)
        distance = Distances(laplacian).get(spec, progress)
        estimate = accuracy(distance, everywhere=True)
    dtype = options.dtype or "float32"
    known = begun(distance, options.output, dtype)
    if known and options.fresh:
        tell(f"Discarding {_described(known)}.")
    elif known:
        tell(f"Going on from {_described(known)}; --fresh begins anew.")
    for path in left_by_others(distance, options.output, dtype):
        tell(f"{path} ({_size(path.stat().st_size)}) is left of a run with another mesh or other options; it may go.")
    try:
        with progress_line() as progress:
            memory = 1e6 * (options.memory or 500)
            write_all_pairs(distance, options.output, dtype, memory, progress, options.fresh)
    except (KeyboardInterrupt, OutputError, MemoryError):
        if left := begun(distance, options.output, dtype):
            tell_failure(f"What is done is kept: {_described(left)}. The same command goes on from there.")
        raise
    count = len(laplacian.surface.vertices)
    print(f"{options.output}: {distance.label}, all pairs of {count:,} vertices{estimate}")
    return {"n_pairs": count**2, "distances": [distance_facts(distance, spec, everywhere=True)]}


def _described(known: "Begun") -> str:
    return f"{known.path}, {known.rows:,} of {known.n:,} rows ({_size(known.bytes)})"


def _size(count: int) -> str:
    return f"{count / 1e9:.2f} GB" if count >= 1e8 else f"{count / 1e6:.2f} MB"


def pins_in(path: str, surface: "Surface") -> "Pins":
    """The pins in a file; how far they had to be moved is said."""
    from bihdist_core.formats.pins import read_pins

    pins = read_pins(path, surface)
    tell_moved(path, "pin", pins.moved, pins.ids.tolist(), surface)
    return pins


def _pair(text: str) -> list[int]:
    pair = vertices(text)
    if len(pair) != 2:
        raise argparse.ArgumentTypeError(f"{text!r} is not a pair of vertex ids such as 1,2")
    return pair
