"""The meshes of a batch: files, samples, folders of files, and lists of them."""

import os
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from glob import glob
from pathlib import Path

from bihdist_core.errors import ParameterError
from bihdist_core.file_content import file_text
from bihdist_core.formats.mesh_names import JOIN, MESH_FORMATS, files_of, is_mesh_file, is_there, mesh_name
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

    A word may be two files joined, perhaps in several folders: `sub-*/lh.pial+rh.pial`, `lh.*+rh.*`. A mesh has the
    name of its file, with that of its folder before it if several files have the same. Paths of
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
    names = _names([*paths])
    meshes = MeshFiles({}, {})
    for each, reason in paths.items():
        name = names[each]
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
    path = beside if os.path.exists(beside) or JOIN in word else Path(mesh_path(word))
    if JOIN in word and not is_there(path):
        return _joined_meshes(*os.fspath(path).split(JOIN, 1))
    if os.path.isdir(path):
        paths = sorted(each for each in path.iterdir() if is_mesh_file(each) and each.is_file())
        reason = f"There is no mesh in the folder {word}; meshes are {', '.join(MESH_FORMATS)} files and FreeSurfer's."
        return [(each, "") for each in paths] or [(path, reason)]
    return [(path, "" if is_there(path) else f"There is no file or folder {word}, nor a sample of that name.")]


def _joined_meshes(pattern: str, other: str) -> list[tuple[Path, str]]:
    """Return each mesh that a pattern finds joined with the other, in whose name a * stands for what one stood for."""
    in_name = re.compile(re.escape(os.path.basename(pattern)).replace(r"\*", "(.*)"))
    found = []
    for first in sorted(glob(pattern)):
        if is_mesh_file(Path(first)) and (stars := in_name.fullmatch(os.path.basename(first))):
            second = other
            for star in stars.groups():
                second = second.replace("*", star, 1)
            path = f"{first}{JOIN}{second}"
            found.append((Path(path), "" if is_there(path) else f"There is no file {second} beside {first}."))
    return found or [(Path(f"{pattern}{JOIN}{other}"), f"There is no mesh {pattern}.")]


def _names(paths: Sequence[Path]) -> dict[Path, str]:
    """Name meshes after their files and, where several have the same, folders of theirs that tell them apart."""
    names = {path: mesh_name(path) for path in paths}
    folders = {path: Path(files_of(path)[0]).parts[1:-1] for path in paths}
    for depth in range(1, 1 + max(map(len, folders.values()))):
        shared = Counter(names.values())
        for path in paths:
            if shared[names[path]] > 1:
                names[path] = "_".join([*folders[path][-depth:], mesh_name(path)])
    return names
