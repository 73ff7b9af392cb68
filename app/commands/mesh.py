"""The mesh that a command names, and what to say where there is none."""

import argparse
import os
from collections.abc import Callable, Iterable, Sequence
from difflib import get_close_matches
from typing import TYPE_CHECKING

from bihdist_core.sentences import shortened

from ..document.document import AREAS
from ..samples import mesh_path, sample_names
from .result import Facts, Result
from .terminal import tell_failure, tell_repairs

if TYPE_CHECKING:
    from bihdist_core import Laplacian

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
    """That of the mesh that was named, with the areas that were asked for."""
    return laplacian_of(options.mesh, options.areas)


def laplacian_of(mesh: str, areas: str | None = None) -> "Laplacian":
    """Read a mesh and say what was repaired."""
    from bihdist_core import Laplacian, read_surface

    surface = read_surface(found_mesh(mesh))
    tell_repairs(surface)
    return Laplacian(surface, areas or AREAS[0])


NAME = "{name}"
"""In an output it stands for the name of each mesh."""


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
        own = {**vars(options), "mesh": mesh, "output": output(mesh)}
        return {"mesh": mesh, "outputs": [own["output"]], **do(argparse.Namespace(**own))}

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
