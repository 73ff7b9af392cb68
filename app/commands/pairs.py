"""`bihdist pairs`: distances between chosen vertices, or all of them, into a file."""

import argparse
import re
from typing import TYPE_CHECKING

from .mesh import read_laplacian
from .options import add_areas, add_distance, positive, specs, vertices
from .terminal import accuracy, counted, progress_line, tell

if TYPE_CHECKING:
    import numpy as np

    from bihdist_core.analysis.all_pairs import Begun
    from bihdist_core.distances.kinds import Spec
    from bihdist_core.formats.pins import Pins
    from bihdist_core.surface import Surface

WORDS = "distances between chosen vertices"
WHOLE = re.compile("-?[0-9]{1,18}")


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("mesh", help="mesh file, or the name of a sample")
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--vertices", type=vertices, metavar="I,J,K", help="all distances among these")
    which.add_argument("--pins", metavar="FILE", help="the same among the pins in a .csv, .json or MeshLab's .pp file")
    which.add_argument("--pairs", type=_pair, nargs="+", metavar="I,J", help="the distances of these pairs")
    which.add_argument("--file", metavar="PAIRS.csv", help="the same from a file, a line `i,j` for each pair")
    which.add_argument(
        "--all",
        action="store_true",
        help="all pairs of the mesh, to a .npy; goes on where it was interrupted, from a hidden .part file beside it",
    )
    parser.add_argument("--fresh", action="store_true", help="for --all: discard what an interrupted run has left")
    parser.add_argument("--dtype", choices=("float32", "float64"), default="float32", help="for --all")
    parser.add_argument("--memory", type=positive, default=500, metavar="MB", help="for --all (default: 500)")
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="a .npy or .csv file")
    add_distance(parser, "a column; repeat for more (default: biharmonic)")
    add_areas(parser)


def run(options: argparse.Namespace) -> None:
    import numpy as np

    from bihdist_core.distances.answers import Distances
    from bihdist_core.errors import ParameterError
    from bihdist_core.formats.field_output import ARRAY_FORMATS, write_array
    from bihdist_core.whole_file import check_output

    extension = check_output(options.output, (".npy",) if options.all else ARRAY_FORMATS)
    chosen = specs(options, list(dict.fromkeys(options.distance or ["biharmonic"])))
    if options.all and len(chosen) > 1:
        raise ParameterError("--all writes the pairs of one distance; name one.")
    if options.fresh and not options.all:
        raise ParameterError("--fresh goes with --all: nothing else is kept when it is interrupted.")
    if options.all:
        _write_all(options, chosen[0])
        return
    with progress_line() as progress:
        laplacian = read_laplacian(options)
        distances = Distances(laplacian)
        pins = pins_in(options.pins, laplacian.surface) if options.pins else None
        if options.vertices or pins:
            among = pins.vertices if pins else laplacian.surface.check_vertices(options.vertices)
            pairs = np.array([(i, j) for k, i in enumerate(among) for j in among[k + 1 :]]).reshape(-1, 2)
        else:
            pairs = pairs_in(options.file) if options.file else np.array(options.pairs)
            laplacian.surface.check_vertices(np.unique(pairs))
        is_matrix = bool(options.vertices or pins) and extension == ".npy" and len(chosen) == 1
        answers, lines = [], []
        for each in chosen:
            distance = distances.get(each, progress)
            answers.append(distance.pairwise(among) if is_matrix else distance.of_pairs(pairs))
            lines.append(f"{distance.label}, {counted(len(pairs), 'pair')}{accuracy(distance)}")
    if is_matrix:
        write_array(options.output, answers[0])
    else:
        names = ["distance"] if len(chosen) == 1 else [str(each) for each in chosen]
        columns, header = [pairs, *answers], ["i", "j", *names]
        if pins:
            columns = [*(pins.ids[k] for k in np.triu_indices(len(pins), 1)), *columns]
            header = ["pin_i", "pin_j", *header]
        write_array(options.output, np.column_stack(columns), header)
    for text in lines:
        print(f"{options.output}: {text}")


def _write_all(options: argparse.Namespace, spec: "Spec") -> None:
    """The pairs of all vertices, and what is said of the part of them that is there already, or is left."""
    from bihdist_core.analysis.all_pairs import begun, left_by_others, write_all_pairs
    from bihdist_core.distances.answers import Distances
    from bihdist_core.errors import OutputError

    with progress_line() as progress:
        laplacian = read_laplacian(options)
        distance = Distances(laplacian).get(spec, progress)
        said = accuracy(distance, everywhere=True)
    known = begun(distance, options.output, options.dtype)
    if known and options.fresh:
        tell(f"Discarding {_described(known)}.")
    elif known:
        tell(f"Going on from {_described(known)}; --fresh begins anew.")
    for path in left_by_others(distance, options.output, options.dtype):
        tell(f"{path} ({_size(path.stat().st_size)}) is left of a run with another mesh or other options; it may go.")
    try:
        with progress_line() as progress:
            memory = 1e6 * options.memory
            write_all_pairs(distance, options.output, options.dtype, memory, progress, options.fresh)
    except (KeyboardInterrupt, OutputError, MemoryError):
        if left := begun(distance, options.output, options.dtype):
            tell(f"What is done is kept: {_described(left)}. The same command goes on from there.")
        raise
    count = len(laplacian.surface.vertices)
    print(f"{options.output}: {distance.label}, all pairs of {count} vertices{said}")


def _described(known: "Begun") -> str:
    return f"{known.path}, {known.rows:,} of {known.n:,} rows ({_size(known.bytes)})"


def _size(count: int) -> str:
    return f"{count / 1e9:.2f} GB" if count >= 1e8 else f"{count / 1e6:.2f} MB"


def pins_in(path: str, surface: "Surface") -> "Pins":
    """The pins in a file; how far they had to be moved is said."""
    import numpy as np

    from bihdist_core.formats.pins import read_pins

    pins = read_pins(path, surface)
    # Positions are often written with seven digits.
    size = float(np.linalg.norm(np.ptp(surface.vertices, axis=0)))
    far = np.flatnonzero(pins.moved > 1e-6 * size)
    if len(far):
        most = int(pins.moved.argmax())
        tell(
            f"{path}: {counted(len(far), 'pin')} moved to a vertex; the farthest, {pins.ids[most]}, by "
            f"{pins.moved[most]:.3g} ({pins.moved[most] / size:.2%} of the mesh's size)."
        )
    return pins


def pairs_in(path: str) -> "np.ndarray":
    """(m, 2) ids from a file with a line `i,j` for each pair; a first line of words is a header."""
    import numpy as np

    from bihdist_core.errors import ParameterError

    pairs = []
    try:
        with open(path, encoding="utf-8-sig") as lines:
            for number, line in enumerate(lines, 1):
                words = [word.strip() for word in line.replace(";", ",").split(",")]
                if not line.strip() or (number == 1 and not WHOLE.fullmatch(words[0])):
                    continue
                if len(words) < 2 or not all(WHOLE.fullmatch(word) for word in words[:2]):
                    raise ParameterError(f"{path}, line {number}: {line.strip()!r} is not a pair of ids such as 1,2.")
                pairs.append((int(words[0]), int(words[1])))
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not a text file"
        raise ParameterError(f"The pairs in {path} cannot be read: {reason}.") from None
    if not pairs:
        raise ParameterError(f"{path} holds no pairs; each line is two vertex ids such as 1,2.")
    return np.array(pairs)


def _pair(text: str) -> list[int]:
    pair = vertices(text)
    if len(pair) != 2:
        raise argparse.ArgumentTypeError(f"{text!r} is not a pair of vertex ids such as 1,2")
    return pair
