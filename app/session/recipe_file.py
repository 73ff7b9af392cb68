"""Recipes and sessions as files: JSON, and beside it an archive of the arrays that came from Python, if any.

`hand.json` names its archive, `hand.0123456789abcdef.npz`, whose name tells its content: a recipe that is written again
leaves the archive alone that the old one names until it is replaced, and then the old one's goes.
"""

import hashlib
import json
import os
import re
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import replace
from pathlib import Path

import numpy as np

from bihdist_core import OutputError, ParameterError
from bihdist_core.file_content import open_regular
from bihdist_core.file_output import KEPT_CHARACTERS, atomic_write, check_output, remove_stale

from ..document.document import Document
from ..document.file import is_recipe, read_recipe, recipe_text, with_meshes_from
from ..document.page import FORMATS, Recipe
from .array_store import ArrayStore, holds_arrays, is_archive

LONGEST = KEPT_CHARACTERS - 17
"""Letters of a recipe's name that its archive's begins with."""
HEAD = 4096
"""Bytes of a recipe among which its archive is named: names of files have at most 255."""


def recipe_paths(figure: str | os.PathLike[str]) -> tuple[Path, Path]:
    """Return the paths that the recipe of a figure may have: `hand.json`, or if that is taken `hand.pdf.json`."""
    figure = Path(figure)
    return figure.with_suffix(".json"), figure.with_name(f"{figure.name}.json")


def written_recipe(figure: str | os.PathLike[str]) -> Path:
    """Return the path of the recipe of a figure that has been written."""
    usual, own = recipe_paths(figure)
    return own if own.exists() else usual


def check_recipe_beside(document: Document, figure: str | os.PathLike[str]) -> None:
    """Before long work: that a figure's recipe can be written; OutputError if not."""
    usual, own = recipe_paths(figure)
    check_recipe_output(document, usual)
    if usual.exists():
        check_recipe_output(document, own)
    for path in (usual, own):
        if path.exists() and not is_recipe(path):
            raise OutputError(f"{path}, where the recipe would go, is another file; give the figure another name.")


def place_beside(figure: str | os.PathLike[str], recipe: Recipe) -> tuple[Path, str]:
    """Return the path for a figure's recipe, and the format for which it is written there.

    A recipe that is there already is replaced if it says the same, for whatever format, or if it is this figure's and
    no other's.  OutputError if there is no such place.
    """
    figure = Path(figure)
    format = figure.suffix.lower().removeprefix(".")
    usual, own = recipe_paths(figure)
    if not own.exists():
        if not usual.exists():
            return usual, format
        there = _read(usual)
        if there is not None and _without_format(there, usual) == _without_format(recipe, usual):
            return usual, there.page.format
        if there is not None and there.page.format == format and figure.exists() and not _may_be_shared(figure):
            return usual, format
        return own, format
    there = _read(own)
    if there is None or (there.page.format != format and _without_format(there, own) != _without_format(recipe, own)):
        raise OutputError(f"{own}, where the recipe would go, is of something else; give the figure another name.")
    return own, format


def _may_be_shared(figure: Path) -> bool:
    """Return whether there is a figure of the same stem in another format that has no recipe to itself."""
    others = (figure.with_suffix(f".{format}") for format in FORMATS if f".{format}" != figure.suffix.lower())
    return any(other.exists() and not recipe_paths(other)[1].exists() for other in others)


def _read(path: Path) -> Recipe | None:
    try:
        return read_recipe(path)
    except ParameterError:  # of another version
        return None


def _without_format(recipe: Recipe, path: Path) -> Recipe:
    recipe = with_meshes_from(recipe, path)
    return replace(recipe, page=replace(recipe.page, format=""))


def check_recipe_output(document: Document, path: str | os.PathLike[str]) -> None:
    """Before long work: that a recipe of the document can be written there; OutputError if not."""
    check_output(path, (".json",))
    if holds_arrays(document):
        arrays = _archive_of(document, path)
        check_output(arrays, (".npz",))
        if arrays.exists() and not is_archive(arrays):
            raise OutputError(f"{arrays}, where the arrays would go, is another file; choose another name.")


@contextmanager
def recipe_written(
    recipe: Recipe, given: ArrayStore, path: str | os.PathLike[str], version: str, stays: bool = False, format: str = ""
) -> Iterator[None]:
    """Write a recipe, and the arrays it names; they are there when the block ends, and if that fails, neither is.

    `format` is that of the figure that it belongs to, if any. With `stays` the file will not be moved, with its meshes
    or without them, and names these as the recipe does.
    """
    check_recipe_output(recipe.document, path)
    page = replace(recipe.page, format=format)
    recipe = replace(recipe if stays else with_meshes_from(recipe, path), page=page, arrays="")
    archive = _archive_of(recipe.document, path) if holds_arrays(recipe.document) else None
    try:
        with ExitStack() as files:
            # The last that is begun is the first that is in its place: the arrays, before anything names them.
            text = files.enter_context(atomic_write(path))
            if archive is not None:
                recipe = replace(recipe, arrays=archive.name)
                with files.enter_context(atomic_write(archive)).open("wb") as file:
                    np.savez(file, **given.arrays(recipe.document))  # type: ignore[arg-type]
            text.write_text(recipe_text(recipe, version), encoding="utf-8")
            yield
    finally:
        sweep_arrays(path)


def _archive_of(document: Document, path: str | os.PathLike[str]) -> Path:
    """Return the path of a recipe's arrays: it names the arrays, so that no others take their place."""
    named = [(mesh.name, mesh.sha256) for mesh in document.surfaces if not mesh.path and mesh.change is None]
    named += [(field.name, field.sha256) for field in document.fields if not field.path]
    content = hashlib.sha256(repr(named).encode()).hexdigest()[:16]
    path = Path(path)
    return path.with_name(f"{path.stem[:LONGEST]}.{content}.npz")


def sweep_arrays(path: str | os.PathLike[str]) -> None:
    """Remove the archives that recipes at a path have had and that no recipe in the folder names, whether it is
    written already or still being written."""
    path = Path(path)
    name = rf"{re.escape(path.stem[:LONGEST])}\.[0-9a-f]{{16}}\.npz"
    remove_stale(path.parent, name)
    with suppress(OSError):
        archives = [each for each in path.parent.iterdir() if re.fullmatch(name, each.name) and is_archive(each)]
        if archives:
            heads = [_head(each) for each in path.parent.glob("*.json")]
            for each in archives:
                if not any(
                    json.dumps(each.name, ensure_ascii=False).encode(errors="replace") in head for head in heads
                ):
                    each.unlink()


def _head(path: Path) -> bytes:
    """Return the beginning of a file, where a recipe names its archive."""
    try:
        with open_regular(path, "recipe") as file:
            return file.read(HEAD)
    except (ParameterError, OSError):
        return b""
