"""Figures of dark pages: each that has a recipe is drawn again in the dark style, beside the light one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from app.figures.picture import Picture


def dark_name(picture: Path) -> Path:
    """Return where the dark figure is that belongs to a picture."""
    return picture.with_stem(f"{picture.stem}_dark")


def draw_dark(picture: Path, target: Path, drawn: Picture | None = None) -> None:
    """Draw the figure of a PNG file's recipe in the dark style, if it has one and chooses no style itself.

    `drawn` is the figure, where it has been drawn again before.
    """
    from PIL import Image

    from app.document.file import is_recipe, read_recipe
    from app.figures.picture import Picture, figure_again

    recipe = picture.with_suffix(".json")
    if picture.suffix != ".png" or not (recipe.exists() and is_recipe(recipe)):
        return
    read = read_recipe(recipe)
    if read.page.style != "paper" or read.page.transparent or read.page.format != "png":
        return
    drawn = drawn or figure_again(recipe)
    dark = replace(read, document=drawn.document, page=replace(read.page, style="dark"))
    Image.fromarray(Picture(dark, drawn._surfaces, drawn._given, drawn.answers).pixels).save(target)


def setup(app: Any) -> dict[str, Any]:
    """Have each picture with a dark one followed by it; an extension of Sphinx."""
    app.connect("doctree-read", _add_dark_figures, priority=100)  # before images are collected
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _add_dark_figures(app: Any, document: Any) -> None:
    from docutils import nodes

    for image in [*document.findall(nodes.image)]:
        dark = dark_name(Path(image["uri"]))
        if Path(f"{app.srcdir}/{dark}").exists():
            copy = image.deepcopy()
            image["classes"].append("only-light")
            copy["uri"], copy["classes"] = dark.as_posix(), [*copy["classes"], "only-dark"]
            image.parent.insert(image.parent.index(image) + 1, copy)
