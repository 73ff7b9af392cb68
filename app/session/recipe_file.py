"""Recipes and sessions as files: JSON, and beside it an archive of the arrays that came from Python, if any."""

import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from bihdist_core import OutputError
from bihdist_core.whole_file import check_output, whole_file

from ..document.document import Document
from ..document.file import recipe_text, with_meshes_from
from ..document.page import Recipe
from .given import Given, is_archive, is_given


def check_recipe_output(document: Document, path: str | os.PathLike[str]) -> None:
    """Before long work: that a recipe of the document can be written there; OutputError if not."""
    check_output(path, (".json",))
    if is_given(document):
        arrays = _archive_of(path)
        check_output(arrays, (".npz",))
        if arrays.exists() and not is_archive(arrays):
            raise OutputError(f"{arrays}, where the arrays would go, is another file; choose another name.")


@contextmanager
def recipe_written(
    recipe: Recipe, given: Given, path: str | os.PathLike[str], version: str, stays: bool = False
) -> Iterator[None]:
    """Write a recipe, and the arrays it names; they are there when the block ends, and if that fails, neither is.

    stays: the file will not be moved, with its meshes or without them, and names these as the recipe does.
    """
    check_recipe_output(recipe.document, path)
    recipe = replace(recipe if stays else with_meshes_from(recipe, path), arrays="")
    archive = _archive_of(path) if is_given(recipe.document) else None
    with ExitStack() as files:
        # The last that is begun is the first that is in its place: the arrays, before anything names them.
        text = files.enter_context(whole_file(path))
        if archive is not None:
            recipe = replace(recipe, arrays=archive.name)
            with files.enter_context(whole_file(archive)).open("wb") as file:
                np.savez(file, **given.arrays(recipe.document))  # type: ignore[arg-type]
        text.write_text(recipe_text(recipe, version), encoding="utf-8")
        yield


def _archive_of(path: str | os.PathLike[str]) -> Path:
    return Path(path).with_suffix(".npz")
