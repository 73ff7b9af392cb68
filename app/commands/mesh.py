"""The mesh that a command names, and what to say where there is none."""

import argparse
import os
from collections.abc import Iterable
from difflib import get_close_matches
from typing import TYPE_CHECKING

from ..document.document import AREAS
from ..samples import mesh_path, sample_names
from .terminal import tell_repairs

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
    from bihdist_core.errors import MeshError

    shown = word if len(word) <= LONGEST else f"{word[:LONGEST]}..."
    if word.lower().endswith(".json"):
        raise MeshError(f"There is no file {shown}.")
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
