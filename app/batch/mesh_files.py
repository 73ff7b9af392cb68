"""The meshes of a batch: files, samples, folders of files, and lists of them."""

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from bihdist_core.errors import ParameterError
from bihdist_core.file_content import file_text
from bihdist_core.formats.mesh_names import MESH_FORMATS, is_mesh_file, mesh_name
from bihdist_core.formats.whole_numbers import numbered_lines

from ..samples import mesh_path


@dataclass(frozen=True)
class MeshFiles:
    """The paths of meshes by name, and the reasons for those that are missing."""

    paths: dict[str, str]
    missing: dict[str, str]


def find_mesh_files(words: Sequence[str], list_file: str = "", list_text: str = "") -> MeshFiles:
    """Find the meshes of words, which are files, samples and folders of files, then those of a list, one on each
    line.

    A mesh has the name of its file, with that of its folder before it if several files have the same. Paths of
    `list_file` are taken from its folder first; `list_text` is its content if it cannot be read again.

    Raises ParameterError if there is no mesh, the list cannot be read, or two meshes have the same name.
    """
    found: list[tuple[Path, str]] = []
    for word in words:
        found += _meshes_of(word, Path())
    if list_file:
        lines = numbered_lines(list_text or file_text(list_file, "list of meshes"))
        known = [(number, line) for number, line in lines if not line.startswith("#")]
        if not known:
            raise ParameterError(f"{list_file} names no mesh; write a path on each line.")
        for number, line in known:
            for path, reason in _meshes_of(line, Path(list_file).parent):
                found.append((path, f"{list_file}, line {number}: {reason}" if reason else ""))
    reasons = [reason for _, reason in found if reason]
    if len(reasons) == len(found):
        raise ParameterError(reasons[0] if reasons else "Which meshes? Name files, folders, or a list with --list.")
    paths = {Path(os.path.abspath(path)): reason for path, reason in found}
    names = Counter(map(mesh_name, paths))
    meshes = MeshFiles({}, {})
    for each, reason in paths.items():
        # One folder for each subject, with the same names in all of them.
        name = mesh_name(each)
        name = name if names[name] == 1 else f"{each.parent.name}_{name}"
        if name in meshes.paths or name in meshes.missing:
            raise ParameterError(f"{meshes.paths.get(name, name)} and {each} have the same name, {name}; rename one.")
        if reason:
            meshes.missing[name] = reason
        else:
            meshes.paths[name] = str(each)
    return meshes


def _meshes_of(word: str, folder: Path) -> list[tuple[Path, str]]:
    """Return the paths that a word means, each with the reason why it is not a mesh, or ""."""
    beside = folder / word
    # os.path, for which a path that is too long is one that is not there.
    path = beside if os.path.exists(beside) else Path(mesh_path(word))
    if os.path.isdir(path):
        paths = sorted(each for each in path.iterdir() if is_mesh_file(each) and each.is_file())
        reason = f"There is no mesh in the folder {word}; meshes are {', '.join(MESH_FORMATS)} files and FreeSurfer's."
        return [(each, "") for each in paths] or [(path, reason)]
    return [(path, "" if os.path.isfile(path) else f"There is no file or folder {word}, nor a sample of that name.")]
