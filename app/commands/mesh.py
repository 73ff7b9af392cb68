"""The mesh that a command names, with its sources, and what to say where there is none."""

import argparse
import os
import re
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import BihdistError, MeshError, MissingFileError, OutputError, ParameterError
from bihdist_core.formats.mesh_names import is_there, mesh_name
from bihdist_core.progress import Progress
from bihdist_core.sentences import shortened
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import short_words_of

from ..batch.work_order import ARRAYS
from ..document.document import AREAS, COMPARISON, Document
from ..document.quantities import Quantity
from ..document.repairs import NAME, NO_REPAIRS, Repairs
from ..document.sources import HIGHEST, LISTED, POSITION, Sources
from ..document.synonyms import COMMAND_HINTS, near
from ..samples import mesh_path, sample_names
from .options import repairs_of
from .terminal import Facts, Result, tell, tell_failure, tell_moved, tell_repairs

if TYPE_CHECKING:
    from bihdist_core import Distance, Laplacian, Surface
    from bihdist_core.arrays import IntArray

    from ..session.chosen_sources import Chosen

_SOURCES = re.compile(r"([0-9]+|f[0-9]+:[^/]*|loop:[0-9]+)([,+ ][^/]*)?")
"""Words that name a vertex or another source, and hardly a file."""
MAX_NAME_CHARS = 200
"""Letters of a name that are repeated."""


def found_mesh(word: str) -> str:
    """Return the path of the mesh that a word names; MeshError if there is none."""
    check_mesh(word)
    return mesh_path(word)


def check_mesh(word: str, commands: Iterable[str] = ()) -> None:
    """Raise MeshError if there is neither such a file nor such a sample, with what may have been meant.

    `commands` are words that would have been possible in its place, too.
    """
    if is_there(mesh_path(word)):
        return

    shown = shortened(word, MAX_NAME_CHARS)
    if word.lower().endswith(".json"):
        raise MissingFileError(f"There is no file {shown}.")
    if _SOURCES.fullmatch(word):
        raise MeshError(f"There is no file {shown}; did you mean --sources {shown}?")
    commands, word = tuple(commands), word.lower()
    meant = (COMMAND_HINTS.get(word) if commands else None) or near(word, (*commands, *sample_names()))
    what = "command or file" if commands and os.path.basename(word) == word and "." not in word else "file"
    if meant in commands:
        raise MeshError(f"There is no {what} {shown}; did you mean {meant}? See `bihdist --help`.")
    hint = f"; did you mean {meant}?" if meant else "."
    raise MeshError(f"There is no {what} {shown}{hint} The samples are {', '.join(sample_names())}.")


def read_laplacian(options: argparse.Namespace) -> "Laplacian":
    """Return the Laplacian of the named mesh, with the vertex areas and repairs of the options.

    If these renumber vertices, the file with the new ids is written beside the output.
    """
    return laplacian_of(options.mesh, options.areas, repairs_of(options, options.mesh), ids_beside(options))


def laplacian_of(
    mesh: str, areas: str | None = None, repairs: Repairs = NO_REPAIRS, ids_file: str | None = None
) -> "Laplacian":
    """Read a mesh and report what was repaired; new ids of vertices are written to `ids_file`, if one is given."""
    from bihdist_core import Laplacian, read_surface

    from ..session.repaired_surface import repaired

    surface, ids = repaired(read_surface(found_mesh(mesh)), repairs)
    tell_repairs(surface)
    if ids is not None and ids_file is not None:
        _write_ids(ids_file, ids, surface.name)
    return Laplacian(surface, areas or AREAS[0], repairs.operator)


def name_output(options: argparse.Namespace) -> None:
    """Name the output after the mesh, or each of several, if none is named; OutputError if there is such a file."""
    if options.output:
        return
    names = [mesh_name(mesh) for mesh in (options.meshes if "meshes" in options else [options.mesh])]
    for name in names:
        usual_output(name, options.usual_output)
    options.output = (names[0] if len(names) == 1 else NAME) + options.usual_output


def usual_output(mesh: str, ending: str) -> str:
    """Return the name of an output that is not named; OutputError if there is such a file already."""
    path = f"{mesh_name(mesh)}{ending}"
    if os.path.exists(path):
        raise OutputError(f"There is a file {path} already; name another with -o, or this one to replace it.")
    return path


def outputs_of(options: argparse.Namespace) -> list[str]:
    """Return the files that a command with one output has written."""
    ids_file = ids_beside(options)
    return [options.output, *([ids_file] if ids_file else [])]


def ids_beside(options: argparse.Namespace, letter: str = "") -> str | None:
    """Return the path of the new ids of merged vertices beside the output, None without --merge or an output file.

    `letter` is that of one of two meshes.
    """
    if options.merge is None or not getattr(options, "output", None) or hasattr(options, "is_standard_output"):
        return None
    return _ids_file(options.output, letter)


def _ids_file(output: str, letter: str = "") -> str:
    return ".".join(filter(None, (os.path.splitext(output)[0], letter, "ids.csv")))


def write_ids_of(document: Document, output: str) -> list[str]:
    """Write the new ids of merged vertices of a document's meshes beside an output; the files, one for each mesh."""
    from ..session.loaded_mesh import open_mesh

    meshes = [mesh for mesh in document.surfaces if mesh.change is None]
    files = []
    for letter, mesh in zip("ABCDEFGH", meshes, strict=False):
        # Read again, as whoever has drawn it keeps no ids; of a mesh from Python there is no file.
        loaded = open_mesh(mesh) if mesh.path and mesh.repairs.merge is not None else None
        if loaded is not None and loaded.new_ids is not None:
            files.append(_ids_file(output, letter if len(meshes) > 1 else ""))
            _write_ids(files[-1], loaded.new_ids, loaded.surface.name)
    return files


def _write_ids(path: str, ids: "IntArray", name: str) -> None:
    from ..session.repaired_surface import write_ids

    write_ids(path, ids)
    tell(f"{path}: the new id of each vertex of {name}.")


def check_array_output(path: str, formats: Sequence[str], work: str) -> str:
    """Return the extension of an output path, in lower case; OutputError if it is not one of `formats`.

    The error names `work` of `bihdist batch`, which writes these arrays in more formats.
    """
    from bihdist_core.file_output import check_output

    extension = os.path.splitext(path)[1].lower()
    if extension not in formats and extension[1:] in ARRAYS:
        raise OutputError(
            f"{path}: {extension} files are written by `bihdist batch --do {work} --format {extension[1:]} -o FOLDER`; "
            f"here the formats are {', '.join(formats)}."
        )
    return check_output(path, formats)


def add_meshes(parser: argparse.ArgumentParser) -> None:
    """Add the argument of several meshes."""
    parser.add_argument(
        "meshes",
        nargs="+",
        metavar="MESH",
        help="mesh files, some with + between as one (lh.pial+rh.pial), or the names of samples",
    )


def into_each(options: argparse.Namespace, do: Callable[[argparse.Namespace], Facts]) -> Result:
    """Do something with each mesh, into an output of its own.

    `do` gets the options with `mesh` and `output`, tells what it has done and returns it. Raises ParameterError if
    several meshes had one output.
    """

    if len(options.meshes) > 1 and NAME not in options.output:
        for mesh in options.meshes:
            check_mesh(mesh)
        raise ParameterError(
            f"Several meshes have an output each; write -o {NAME}{os.path.splitext(options.output)[1]}."
        )

    def output(mesh: str) -> str:
        return str(options.output.replace(NAME, mesh_name(mesh)))

    taken: dict[str, str] = {}
    for mesh in options.meshes:
        first = taken.setdefault(output(mesh), mesh)
        if first != mesh:
            raise ParameterError(f"{first} and {mesh} would both be written to {output(mesh)}; rename one.")

    def one(mesh: str) -> Facts:
        own = argparse.Namespace(**{**vars(options), "mesh": mesh, "output": output(mesh)})
        return {"mesh": mesh, "outputs": outputs_of(own), **do(own)}

    return each_mesh(options.meshes, one)


def each_mesh(meshes: Sequence[str], do: Callable[[str], Facts]) -> Result:
    """Do something with each mesh.

    The exit status is 2 if one of several failed, which costs no other; what is wrong with a single one is raised.
    """

    done, failures = [], []
    for mesh in meshes:
        try:
            done.append(do(mesh))
        except BihdistError as error:
            if len(meshes) == 1:
                raise
            tell_failure(str(error))
            failures.append({"mesh": mesh, "reason": str(error)})
    return Result({"meshes": done, "failures": failures}, 2 if failures else 0)


def sources_on(
    options: argparse.Namespace,
    surface: "Surface",
    distance: "Callable[[], Distance]",
    progress: Progress | None = None,
) -> "Chosen":
    """Return the sources of `--sources` on the surface of the command's mesh, the highest vertex by default.

    `distance` returns the one by which points are farthest.
    """
    return sources_of_mesh(options.sources or HIGHEST, options.mesh, surface, distance, progress)


def sources_of_mesh(
    asked: Sources,
    mesh: str,
    surface: "Surface",
    distance: "Callable[[], Distance]",
    progress: Progress | None = None,
) -> "Chosen":
    """Return the sources on the surface of a mesh, and tell how far the points of a file had to be moved."""
    from ..session.chosen_sources import chosen_sources

    name = os.path.splitext(os.path.basename(mesh))[0]
    found = chosen_sources(asked, surface, distance, name, progress=progress)
    if found.pins is not None:
        noun = "position" if asked.file.startswith(POSITION) else "pin"
        tell_moved(found.path, noun, found.pins, found.pins.ids.tolist(), surface)
    return found


def sources_of_document(
    asked: Sources | None,
    mesh: str,
    shows: Sequence[Spec | Quantity],
    areas: str | None,
    repairs: Repairs,
    progress: Progress | None = None,
) -> list[Source]:
    """Return the sources on the mesh of a document that is still to be opened, [] if none are named.

    Points are farthest by the first distance of `shows`; `areas` and `repairs` say how the mesh is taken.
    """
    if asked is None or asked.rule == LISTED:
        # Whoever opens the document looks where they are.
        return [] if asked is None else [*asked.members]
    from bihdist_core import Laplacian
    from bihdist_core.distances.answers import Distances

    from ..session.repaired_surface import read_repaired

    surface = read_repaired(found_mesh(mesh), repairs)
    spec = first_spec(shows)
    distances = Distances(Laplacian(surface, areas or "voronoi", repairs.operator))
    return sources_of_mesh(asked, mesh, surface, lambda: distances.get(spec, progress), progress).sources


def sources_of_two(asked: Sources | None, found: list[Source], other: str) -> tuple[list[Source], Source | None]:
    """Return the sources on the first mesh as one for it and one for the second, None for the highest vertex.

    Raises ParameterError for more than two, and for a second one by a rule or a file, which are of the first mesh.
    """
    if len(found) > 2 or (asked is not None and asked.rule != LISTED and len(found) > 1):
        raise ParameterError(
            f"Two meshes have a source each, and --sources names {len(found):,} of the first; write one of each with a "
            "comma, such as 12,40."
        )
    if len(found) == 1:
        tell(
            f"--sources names one of the first mesh, and {other} starts from its highest vertex; one of each is named "
            f"as {short_words_of(found[0])},40."
        )
    return found[:1], found[1] if len(found) > 1 else None


def first_spec(shows: Sequence[Spec | Quantity]) -> Spec:
    """Return the first distance of what is shown, or the usual one."""
    specs = (spec for each in shows for spec in ((each,) if isinstance(each, Spec) else each.specs))
    return next(specs, COMPARISON[0])


def one_source(sources: list[Source]) -> Source | None:
    """Return the only source, None if there is none; ParameterError for several."""
    from ..session.chosen_sources import Chosen

    return Chosen(sources).one() if sources else None
