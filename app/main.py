"""The command line: `bihdist MESH` opens the viewer; `field`, `pairs`, `figure`, `info` and `paper` need
no window.

The only place that wires everything.  What is heavy (numpy, VTK, Qt) is imported by the command that needs it.
"""

import argparse
import os
import re
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import contextmanager

from bihdist_core.distances.kinds import OURS, Spec, kinds

from .figure_command import add_figure_options, add_movie_options, chosen_movie, chosen_recipe
from .state import COMPARISON
from .version import version

COMMANDS = ("view", "field", "pairs", "figure", "movie", "info", "paper")

WHOLE = re.compile("-?[0-9]{1,18}")
PANELS = f"a panel; repeat for more (default: {', '.join(str(spec) for spec in COMPARISON)})"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status: 0, 1 for a figure with a failed panel, 2 for what the user can
    mend, 130 when interrupted."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    if not arguments or (arguments[0] not in COMMANDS and not arguments[0].startswith("-")):
        arguments.insert(0, "view")
    options = _parser().parse_args(arguments)
    from bihdist_core.errors import BihdistError

    try:
        status = options.run(options) or 0
        sys.stdout.flush()
        return status
    except BihdistError as error:
        print(f"bihdist: {error}", file=sys.stderr)
        return 2
    except MemoryError:
        print("bihdist: there is not enough memory for this.", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # Whoever read the output has seen enough; Python would complain again when it closes the pipe.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        print("bihdist: interrupted.", file=sys.stderr)
        return 130


# ---------------------------------------------------------------------- the words
def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="bihdist",
        description="Biharmonic distance on triangle meshes, beside geodesic and diffusion distances.",
        epilog="`bihdist MESH` is short for `bihdist view MESH`.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    view = _command(commands, "view", _view, "open the viewer")
    view.add_argument("mesh", nargs="?", help="mesh file, or the name of a sample (default: figure)")
    view.add_argument("--source", type=_vertex, metavar="V", help="vertex id the distances start from")
    view.add_argument("--screenshot", metavar="OUT.png", help="save the window's picture once complete, and exit")
    _add_distance(view, PANELS)
    _add_areas(view)

    field = _command(commands, "field", _field, "distances of all vertices from one or more sources")
    field.add_argument("mesh", help="mesh file, or the name of a sample")
    field.add_argument("--source", type=_vertex, metavar="V", nargs="+", required=True, help="vertex ids")
    field.add_argument("-o", "--output", metavar="OUT", required=True, help="a .npy, .csv, .ply or .vtp file")
    _add_distance(field)
    _add_areas(field)

    pairs = _command(commands, "pairs", _pairs, "distances between chosen vertices")
    pairs.add_argument("mesh", help="mesh file, or the name of a sample")
    which = pairs.add_mutually_exclusive_group(required=True)
    which.add_argument("--vertices", type=_vertices, metavar="I,J,K", help="all distances among these")
    which.add_argument("--pairs", type=_pair, nargs="+", metavar="I,J", help="the distances of these pairs")
    which.add_argument("--file", metavar="PAIRS.csv", help="the same from a file, a line `i,j` for each pair")
    which.add_argument("--all", action="store_true", help="all pairs of the mesh, to a .npy; goes on if interrupted")
    pairs.add_argument("--dtype", choices=("float32", "float64"), default="float32", help="for --all")
    pairs.add_argument("--memory", type=_positive, default=500, metavar="MB", help="for --all (default: 500)")
    pairs.add_argument("-o", "--output", metavar="OUT", required=True, help="a .npy or .csv file")
    _add_distance(pairs, "a column; repeat for more (default: biharmonic)")
    _add_areas(pairs)

    figure = _command(commands, "figure", _figure, "the window's comparison as a picture, without a window")
    add_figure_options(figure)
    _add_distance(figure, PANELS)
    _add_areas(figure)

    movie = _command(commands, "movie", _movie, "a figure that turns, or whose source wanders, as MP4 or GIF")
    add_figure_options(movie, "a .mp4 or .gif file")
    add_movie_options(movie)
    _add_distance(movie, PANELS)
    _add_areas(movie)

    info = _command(commands, "info", _info, "what a mesh file holds and what would be repaired")
    info.add_argument("mesh", help="mesh file, or the name of a sample")
    info.add_argument("--accuracy", action="store_true", help="how accurate its exact distances are; factors the mesh")
    _add_areas(info)

    paper = _command(commands, "paper", _paper, "every figure and table of the paper, computed anew, as one page")
    paper.add_argument("--out", metavar="DIR", required=True, help="folder for index.html, pictures and numbers")
    paper.add_argument("--only", metavar="IDS", default="", help="a choice, such as fig4,table2")
    paper.add_argument(
        "--mesh", metavar="PATH", help="your own mesh, or a folder of meshes (claims and a picture each)"
    )
    paper.add_argument("--quick", action="store_true", help="smaller meshes and fewer samples, for a first look")
    return parser


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        print(f"bihdist {version()}")
        parser.exit()


def _command(commands, name: str, run: Callable, text: str) -> argparse.ArgumentParser:
    parser = commands.add_parser(name, help=text, description=f"{text[0].upper()}{text[1:]}.")
    parser.set_defaults(run=run)
    return parser


def _add_distance(parser: argparse.ArgumentParser, several: str = "") -> None:
    """`--distance`, and an option for each parameter of ours, which holds where the distance does not say otherwise."""
    words = f"{', '.join(kinds())}; with parameters like 'diffusion(t=1/4)'"
    if several:
        parser.add_argument("--distance", metavar="NAME", action="append", help=f"{words}: {several}")
    else:
        text = f"{words} (default: biharmonic)"
        parser.add_argument("--distance", metavar="NAME", default="biharmonic", help=text)
    parameters = {p.name: p for kind in OURS for p in kind.parameters}
    for name, parameter in parameters.items():
        of = ", ".join(kind.word for kind in OURS if parameter in kind.parameters)
        parser.add_argument(
            f"--{name}",
            metavar="{" + ",".join(parameter.choices) + "}" if parameter.choices else name.upper()[:1],
            help=f"{parameter.meaning}, for {of} (default: {parameter.written(parameter.default)})",
        )


def _add_areas(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--areas", choices=("voronoi", "barycentric"), default="voronoi", help="vertex areas")


def _vertex(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a vertex id (a whole number)") from None


def _vertices(text: str) -> list[int]:
    return [_vertex(word) for word in text.split(",")]


def _pair(text: str) -> list[int]:
    pair = _vertices(text)
    if len(pair) != 2:
        raise argparse.ArgumentTypeError(f"{text!r} is not a pair of vertex ids such as 1,2")
    return pair


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive number")
    return value


# ---------------------------------------------------------------------- the commands
def _view(options: argparse.Namespace) -> int:
    from .samples import mesh_path

    path = mesh_path(options.mesh or "figure")
    # Not in the window, where a script would wait for ever.
    if not os.path.exists(path):
        from bihdist_core import MeshError

        raise MeshError(f"There is no file {path}.")
    if options.screenshot:
        from bihdist_core.whole_file import check_output

        check_output(options.screenshot, (".png",))
    from .qt.start import run_viewer

    return run_viewer(_viewer_state(options), path, options.source, options.screenshot)


def _viewer_state(options: argparse.Namespace):
    from .state import ViewerState

    words = options.distance or [spec.word for spec in COMPARISON]
    return ViewerState(panels=tuple(_spec(options, word) for word in words), areas=options.areas)


def _spec(options: argparse.Namespace, text: str) -> Spec:
    """The distance that a text means with the options beside it."""
    parameters = {p.name: p for kind in OURS for p in kind.parameters}
    given = {name: getattr(options, name) for name in parameters}
    return Spec.parse(text, **{name: parameters[name].parsed(v) for name, v in given.items() if v is not None})


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def _field(options: argparse.Namespace) -> None:
    from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
    from bihdist_core.whole_file import check_output

    check_output(options.output, FIELD_FORMATS)
    with _progress() as progress:
        laplacian = _laplacian(options)
        laplacian.surface.check_vertices(options.source)
        distance = _spec(options, options.distance).build(laplacian, progress)
        columns = distance.from_sources(options.source, progress)
        accuracy = _accuracy(distance)
    word = _spec(options, options.distance).word
    names = [f"{word}_from_{v}" for v in options.source]
    write_fields(options.output, laplacian.surface, dict(zip(names, columns.T, strict=True)))
    said = f"{distance.label}, {columns.shape[0]} vertices, {_counted(columns.shape[1], 'source')}"
    print(f"{options.output}: {said}{accuracy}")


def _pairs(options: argparse.Namespace) -> None:
    import numpy as np

    from bihdist_core.analysis.all_pairs import write_all_pairs
    from bihdist_core.errors import ParameterError
    from bihdist_core.formats.field_output import ARRAY_FORMATS, write_array
    from bihdist_core.whole_file import check_output

    extension = check_output(options.output, (".npy",) if options.all else ARRAY_FORMATS)
    specs = [_spec(options, text) for text in dict.fromkeys(options.distance or ["biharmonic"])]
    if options.all and len(specs) > 1:
        raise ParameterError("--all writes the pairs of one distance; name one.")
    with _progress() as progress:
        laplacian = _laplacian(options)
        if options.all:
            (spec,) = specs
            distance = spec.build(laplacian, progress)
            accuracy = _accuracy(distance, everywhere=True)
            write_all_pairs(distance, options.output, options.dtype, 1e6 * options.memory, progress)
            count = len(laplacian.surface.vertices)
            print(f"{options.output}: {distance.label}, all pairs of {count} vertices{accuracy}")
            return
        if options.vertices:
            vertices = laplacian.surface.check_vertices(options.vertices)
            pairs = np.array([(i, j) for k, i in enumerate(vertices) for j in vertices[k + 1 :]]).reshape(-1, 2)
        else:
            pairs = _pairs_in(options.file) if options.file else np.array(options.pairs)
            laplacian.surface.check_vertices(np.unique(pairs))
        is_matrix = bool(options.vertices) and extension == ".npy" and len(specs) == 1
        answers, said = [], []
        for spec in specs:
            distance = spec.build(laplacian, progress)
            answers.append(distance.pairwise(vertices) if is_matrix else distance.of_pairs(pairs))
            said.append(f"{distance.label}, {_counted(len(pairs), 'pair')}{_accuracy(distance)}")
    if is_matrix:
        write_array(options.output, answers[0])
    else:
        names = ["distance"] if len(specs) == 1 else [str(spec) for spec in specs]
        write_array(options.output, np.column_stack([pairs, *answers]), ["i", "j", *names])
    for text in said:
        print(f"{options.output}: {text}")


def _accuracy(distance, everywhere: bool = False) -> str:
    """What to add to the words on an answer: how accurate it is, with a warning where that is poor.

    everywhere: on all components, also those not asked about.
    """
    certificate = distance.certificate(range(distance.surface.component_count) if everywhere else None)
    if certificate.is_poor:
        _warn(f"{distance.label} on {distance.surface.name} is only {certificate.text}.")
    return f", {certificate.text}" if certificate.text else ""


def _warn(text: str) -> None:
    print(f"bihdist: warning: {text}", file=sys.stderr)


def _judged(answers, name: str) -> int:
    """Warn of answers that are poor, name those that failed; the exit status: 1 if there is one."""
    failures = dict.fromkeys(f"{answer.label}: {answer.failure}" for answer in answers if answer.failure)
    for failure in failures:
        print(f"bihdist: {failure}", file=sys.stderr)
    for label, text in dict.fromkeys((a.label, a.certificate.text) for a in answers if a.certificate.is_poor):
        _warn(f"{label} on {name} is only {text}.")
    return 1 if failures else 0


def _figure(options: argparse.Namespace) -> int:
    from .figure_export import check_export, export
    from .figures import described

    check_export(options.output)
    recipe = chosen_recipe(options, _spec)
    with _progress() as progress:
        figure, recipe, answers = export(recipe, options.output, version(), progress)
    _tell(figure.panels[0].surface)
    sources = ", ".join(str(v) for v in dict.fromkeys(panel.source for panel in recipe.panels))
    print(f"{options.output}: {described(figure)}, source vertex {sources}")
    return _judged(answers, figure.panels[0].surface.name)


def _movie(options: argparse.Namespace) -> int:
    from .figure_raster import check_offscreen
    from .movie import check_movie, write_movie

    check_movie(options.output)
    check_offscreen()
    movie = chosen_movie(options, _spec)
    with _progress() as progress:
        answers = write_movie(movie, options.output, progress)
    print(f"{options.output}: {movie.frames} frames, {movie.frames / movie.fps:.3g} s")
    return _judged(answers, os.path.basename(movie.recipe.mesh))


def _info(options: argparse.Namespace) -> None:
    from bihdist_core import read_surface

    from .samples import mesh_path

    s = read_surface(mesh_path(options.mesh))
    genus = s.genus
    rows = [
        ("vertices", len(s.vertices)),
        ("faces", len(s.faces)),
        ("components", s.component_count),
        ("boundary loops", s.boundary_loop_count),
        ("genus", "not defined (not manifold or not orientable)" if genus is None else genus),
        ("non-manifold edges", s.nonmanifold_edge_count),
        ("non-manifold vertices", s.nonmanifold_vertex_count),
        ("vertices without a face", s.unreferenced_count),
        ("flat faces", len(s.flat_faces)),
        ("mean edge length", f"{s.mean_edge_length:.6g}"),
        ("area", f"{s.face_areas.sum():.6g}"),
    ]
    for name, value in rows:
        print(f"{name:<26}{value}")
    print(f"{'repairs':<26}{'; '.join(s.remarks) or 'none'}")
    if options.accuracy:
        from bihdist_core import BiharmonicDistance, CommuteTimeDistance, Laplacian, SolverError

        said = []
        with _progress() as progress:
            laplacian = Laplacian(s, options.areas)
            for make in (BiharmonicDistance, CommuteTimeDistance):
                try:
                    distance = make(laplacian, progress)
                    said.append((distance.label, _accuracy(distance, everywhere=True).removeprefix(", ")))
                except SolverError as error:
                    said.append((make.label, str(error)))
        for label, text in said:
            print(f"{label:<26}{text}")


def _paper(options: argparse.Namespace) -> None:
    from .paper.reproduce import reproduce
    from .samples import mesh_path

    only = [word for word in options.only.split(",") if word]
    mesh = mesh_path(options.mesh) if options.mesh else None
    with _progress() as progress:
        page = reproduce(options.out, only, mesh, options.quick, progress, say=lambda line: print(line, flush=True))
    print(f"{page}: open it in a browser")


def _laplacian(options: argparse.Namespace):
    from bihdist_core import Laplacian, read_surface

    from .samples import mesh_path

    surface = read_surface(mesh_path(options.mesh))
    _tell(surface)
    return Laplacian(surface, options.areas)


def _tell(surface) -> None:
    """Say on standard error what was done to a mesh."""
    for text in surface.remarks:
        print(f"{surface.name}: {text}", file=sys.stderr)


def _pairs_in(path: str):
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


@contextmanager
def _progress():
    """A line of progress on a terminal, nothing elsewhere."""
    if not sys.stderr.isatty():
        yield None
        return
    last = 0.0

    def report(fraction: float, text: str) -> None:
        nonlocal last
        if time.monotonic() - last > 0.1:
            last = time.monotonic()
            width = os.get_terminal_size(sys.stderr.fileno()).columns
            print(f"\r\x1b[K{fraction:4.0%} {text}"[: width + 3], end="", file=sys.stderr, flush=True)

    try:
        yield report
    finally:
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)
