"""The mesh that a command names, and what to say where there is none."""

import argparse
import os
from collections.abc import Callable, Iterable, Sequence
from difflib import get_close_matches
from typing import TYPE_CHECKING

from bihdist_core.sentences import shortened

from ..document.document import AREAS
from ..document.repairs import NAME, NO_REPAIRS, Repairs
from ..samples import mesh_path, sample_names
from .options import repairs_of
from .result import Facts, Result
from .terminal import tell, tell_failure, tell_repairs

if TYPE_CHECKING:
    from bihdist_core import Laplacian
    from bihdist_core.arrays import IntArray

    from ..document.document import Document

LONGEST = 200
"""Letters of a name that are repeated."""


def found_mesh(word: str) -> str:
    """The path of the mesh that a word names; MeshError where there is none."""
    check_mesh(word)
    return mesh_path(word)


def check_mesh(word: str, commands: Iterable[str] = ()) -> None:
    """MeshError where there is neither such a file nor such a sample, with what may have been meant.

    commands: words that would have been possible in its place, too.
    """
    if os.path.exists(mesh_path(word)):
        return
    from bihdist_core.errors import MeshError, MissingFileError

    shown = shortened(word, LONGEST)
    if word.lower().endswith(".json"):
        raise MissingFileError(f"There is no file {shown}.")
    commands = tuple(commands)
    near = get_close_matches(word.lower(), dict.fromkeys((*commands, *sample_names())), 1)
    meant = f"; did you mean {near[0]}?" if near else "."
    what = "command or file" if commands and os.path.basename(word) == word and "." not in word else "file"
    raise MeshError(f"There is no {what} {shown}{meant} The samples are {', '.join(sample_names())}.")


def read_laplacian(options: argparse.Namespace) -> "Laplacian":
    """That of the mesh that was named, with the areas and the repairs that were asked for.

    Where these number vertices anew, the file with the numbers is written beside the output.
    """
    return laplacian_of(options.mesh, options.areas, repairs_of(options, options.mesh), ids_beside(options))


def laplacian_of(
    mesh: str, areas: str | None = None, repairs: Repairs = NO_REPAIRS, ids_file: str | None = None
) -> "Laplacian":
    """Read a mesh and say what was repaired.  ids_file: where new ids of vertices are written, if anywhere."""
    from bihdist_core import Laplacian, read_surface

    from ..session.repaired_surface import repaired

    surface, ids = repaired(read_surface(found_mesh(mesh)), repairs)
    tell_repairs(surface)
    if ids is not None and ids_file is not None:
        _write_ids(ids_file, ids, surface.name)
    return Laplacian(surface, areas or AREAS[0])


def outputs_of(options: argparse.Namespace) -> list[str]:
    """The files that a command with one output has written."""
    ids_file = ids_beside(options)
    return [options.output, *([ids_file] if ids_file else [])]


def ids_beside(options: argparse.Namespace, letter: str = "") -> str | None:
    """Where the new ids of merged vertices stand, beside the output; None without --merge, or an output's file.

    letter: of one of two meshes.
    """
    if options.merge is None or not getattr(options, "output", None) or hasattr(options, "is_standard_output"):
        return None
    return _ids_file(options.output, letter)


def _ids_file(output: str, letter: str = "") -> str:
    return ".".join(filter(None, (os.path.splitext(output)[0], letter, "ids.csv")))


def write_ids_of(document: "Document", output: str) -> list[str]:
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


def add_meshes(parser: argparse.ArgumentParser) -> None:
    """Add the argument of several meshes."""
    parser.add_argument("meshes", nargs="+", metavar="MESH", help="mesh files, or the names of samples")


def into_each(options: argparse.Namespace, do: Callable[[argparse.Namespace], Facts]) -> Result:
    """Do something with each mesh, into an output of its own.

    do: gets the options with `mesh` and `output`, says what it has done and returns it.  ParameterError if several
    meshes had one output.
    """
    from bihdist_core.errors import ParameterError
    from bihdist_core.formats.mesh_names import mesh_name

    if len(options.meshes) > 1 and NAME not in options.output:
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
    from bihdist_core.errors import BihdistError

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
