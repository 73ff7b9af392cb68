"""Recipes as JSON files, written and read strictly.

A recipe is `{"format": 2, "program": ..., "document": {...}, "page": {...}}`, with `"arrays": "NAME.npz"` where the
document has anything from Python.
"""

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from bihdist_core.errors import MeshError, ParameterError
from bihdist_core.file_content import file_json, json_value, open_regular
from bihdist_core.formats.mesh_names import files_of, is_there

from .document import Document, MeshFile
from .form import READERS, document_data, document_from, written
from .json_values import reader_of, record, text, whole
from .page import Page, Recipe

FORMAT = 2
"""Goes up when a file could not be understood by older programs."""

PROGRAM = "bihdist"


def checksum(path: str | os.PathLike[str]) -> str:
    """The SHA-256 of a file's bytes, of a .gltf with the files it names inside; ParameterError if it cannot be read."""
    files = files_of(path)
    if len(files) > 1:
        return hashlib.sha256("".join(map(checksum, files)).encode()).hexdigest()
    if os.path.splitext(path)[1].lower() == ".gltf":
        return _checksum_of_mesh(path)
    digest = hashlib.sha256()
    with open_regular(path, "file") as file:
        try:
            while block := file.read(1 << 20):
                digest.update(block)
        except OSError as error:
            raise ParameterError(f"The file {path} cannot be read: {error.strerror or error}.") from None
    return digest.hexdigest()


def _checksum_of_mesh(path: str | os.PathLike[str]) -> str:
    from bihdist_core.formats.mesh_io import mesh_content

    try:
        return hashlib.sha256(mesh_content(path)).hexdigest()
    except MeshError as error:
        raise ParameterError(str(error)) from None


# ---------------------------------------------------------------------- writing
def recipe_text(recipe: Recipe, version: str) -> str:
    """Return the recipe as JSON."""
    data = {
        "format": FORMAT,
        "program": f"{PROGRAM} {version}",
        **({"arrays": recipe.arrays} if recipe.arrays else {}),
        "document": document_data(recipe.document),
        "page": written(recipe.page),
    }
    return json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def mesh_reference(mesh: str, file: str | os.PathLike[str]) -> str:
    """Return the name of a mesh in a file: from the file's folder where it can be, so that both may move together."""
    if not is_there(mesh):
        return mesh  # a sample's name
    try:
        return Path(os.path.relpath(mesh, Path(file).resolve().parent)).as_posix()
    except ValueError:  # on another drive
        return str(Path(mesh).resolve())


def with_meshes_from(recipe: Recipe, file: str | os.PathLike[str]) -> Recipe:
    """Return the recipe as it is written at a path."""
    return replace(recipe, document=with_all_paths(recipe.document, lambda path: mesh_reference(path, file)))


def with_all_paths(document: Document, named: Callable[[str], str]) -> Document:
    """Return the same document with other paths of all files that it names."""
    return replace(
        document,
        surfaces=tuple(with_paths(mesh, named) for mesh in document.surfaces),
        fields=tuple(replace(field, path=named(field.path)) if field.path else field for field in document.fields),
        panels=tuple(replace(panel, shows=panel.shows.with_paths(named)) for panel in document.panels),
        parts=tuple(part.with_paths(named) for part in document.parts),
    )


def with_paths(mesh: MeshFile, named: Callable[[str], str]) -> MeshFile:
    """Return the same mesh with other paths, where it has any."""
    mesh = replace(mesh, path=named(mesh.path)) if mesh.path else mesh
    if mesh.repairs.cut:
        mesh = replace(mesh, repairs=replace(mesh.repairs, cut=named(mesh.repairs.cut)))
    if mesh.change is None or not mesh.change.pose:
        return mesh
    return replace(mesh, change=replace(mesh.change, pose=named(mesh.change.pose)))


# ---------------------------------------------------------------------- reading
def read_recipe(path: str | os.PathLike[str]) -> Recipe:
    """Read a recipe; its meshes and its archive are then paths from here, or samples' names.

    Raises ParameterError, with a sentence that names the file and what is wrong.
    """
    data = file_json(path, "recipe", "a recipe")
    try:
        recipe = _recipe(data)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None

    def beside(named: str) -> str:
        there = Path(path).parent / named
        # os.path, which takes a path that is too long for one that is not there.
        return str(there) if is_there(there) else named

    arrays = str(Path(path).parent / recipe.arrays) if recipe.arrays else ""
    return replace(recipe, document=with_all_paths(recipe.document, beside), arrays=arrays)


def recipe_from_text(words: str) -> Recipe:
    """The recipe that `recipe_text` wrote; its meshes are as it names them.  ParameterError for any other text."""
    try:
        data = json_value(words)
    except ParameterError as error:
        raise ParameterError(f"This is not a recipe: {error}") from None
    return _recipe(data)


def is_recipe(path: str | os.PathLike[str]) -> bool:
    """Return whether a file is a recipe, perhaps of another version: whether it may be replaced by one."""
    try:
        data = file_json(path, "recipe", "a recipe")
    except ParameterError:
        return False
    return isinstance(data, dict) and str(data.get("program", "")).startswith(PROGRAM) and "format" in data


def _recipe(data: Any) -> Recipe:
    if not isinstance(data, dict) or "format" not in data or "document" not in data:
        raise ParameterError("this is not a recipe: it has no format and document.")
    version = whole(data["format"], "format")
    made_with = text(data.get("program", ""), "program")
    if version > FORMAT:
        raise ParameterError(
            f"the recipe was made by a newer program ({made_with or 'unknown'}, format {version}); "
            f"this one reads formats up to {FORMAT}."
        )
    if version < FORMAT:
        raise ParameterError(f"format {version} is no longer supported; draw the figure again.")
    parts = {
        "format": whole,
        "program": text,
        "arrays": text,
        "document": document_from,
        "page": reader_of(Page, READERS),
    }
    values = record(data, "the recipe", parts, {"format", "document"})
    if not values["document"].surfaces:
        raise ParameterError("the recipe names no mesh.")
    return Recipe(values["document"], values.get("page", Page()), made_with, values.get("arrays", ""))
