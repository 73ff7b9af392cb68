"""What the gallery shows of an example: below each block what it has saved, and the files to be downloaded.

    extensions = ["sphinx_gallery.gen_gallery", "assets.guide.building.gallery"]
    sphinx_gallery_conf = {"image_scrapers": ("assets.guide.building.gallery.saved_files",)}

Names of what an example saves begin with its own.  It is built where nothing of it has been saved before.
Thumbnails are drawn from the recipes, for light and for dark pages.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from PIL.Image import Image

PICTURES = (".png", ".gif")
PAGE = ".html"
OTHERS = (".json", ".tex", ".csv")
"""Of what else is written these can be downloaded."""

THUMBNAIL = (400, 280)
DRAWN = "800x660"
"""The size in which thumbnails are drawn, with colour bars, which are then cut off."""

PAGES = "pages"
"""The folder of web pages beside an example's page, which Sphinx knows nothing of."""

IFRAME = """
.. raw:: html

    <iframe src="{path}" title="{title}" loading="lazy" style="width: 100%; height: 32rem; border: 0"></iframe>
"""


# ---------------------------------------------------------------------- what sphinx-gallery calls
def saved_files(block: tuple[Any, ...], variables: dict[str, Any], conf: Mapping[str, Any], **_: Any) -> str:
    """What a block has saved, as reStructuredText; a scraper of sphinx-gallery."""
    from sphinx_gallery.scrapers import figure_rst

    source, page = Path(variables["src_file"]), Path(variables["target_file"]).parent
    seen = variables.setdefault("saved_files", set())
    new = sorted((path for path in own_files(source) if path not in seen), key=lambda path: path.stat().st_mtime_ns)
    seen.update(new)
    shown, text = [], ""
    for path in new:
        if path.suffix in PICTURES:
            shown.append(str(Path(next(variables["image_path_iterator"])).with_suffix(path.suffix)))
            shutil.copy(path, shown[-1])
        elif path.suffix == PAGE:
            (page / PAGES).mkdir(exist_ok=True)
            shutil.copy(path, page / PAGES)
            text += IFRAME.format(path=f"{PAGES}/{path.name}", title=path.stem.replace("_", " "))
        elif path.suffix in OTHERS:
            shutil.copy(path, page)
    downloads = ", ".join(f":download:`{path.name}`" for path in new if path.suffix in OTHERS)
    pictures = figure_rst(shown, conf["src_dir"]) if shown else ""
    return f"{pictures}\n{text}\n{f'Files: {downloads}' if downloads else ''}\n"


# ---------------------------------------------------------------------- an example's files
def own_files(source: Path) -> list[Path]:
    """What an example has written beside itself: names that begin with its own, and are not of another's."""
    return [
        path
        for path in source.parent.glob(f"{source.stem}*")
        if path.suffix in (*PICTURES, PAGE, *OTHERS) and path.name.removeprefix(source.stem)[:1] in ".-"
    ]


# ---------------------------------------------------------------------- thumbnails
def draw_thumbnails(recipe: Path, targets: Mapping[str, Path]) -> None:
    """Draw the first and the last panel of a recipe's figure without text, in the styles that `targets` has files for;
    "" is its own style.
    """
    from app.document.file import read_recipe
    from app.figures.picture import Picture, figure_again

    read, drawn = read_recipe(recipe), figure_again(recipe)
    panels = drawn.document.panels
    ends = slice(None, None, max(1, len(panels) - 1))
    document = replace(drawn.document, panels=panels[ends])
    for style, target in targets.items():
        page = replace(read.page, size=DRAWN, style=style or read.page.style, title="none", hints=False, crop=False)
        page = replace(page, columns=2, views=page.views[:1], transparent=False, format="png")
        fewer = replace(read, document=document, page=page)
        picture = Picture(fewer, drawn._surfaces, drawn._given, drawn.answers[ends])
        thumbnail_of(picture.pixels).save(target)


def thumbnail_of(pixels: np.ndarray[Any, np.dtype[np.uint8]]) -> Image:
    """Return what is above the colour bars of a picture, as large as fits."""
    from PIL import Image, ImageOps

    background = pixels[0, 0]
    filled = (np.abs(pixels.astype(int) - background) > 8).any(axis=2)
    rows = np.flatnonzero(np.diff(filled.any(axis=1).astype(int), prepend=0) == 1)
    if len(rows) > 3:  # below the surfaces are bars, their numbers and their units
        filled[rows[-3] :] = False
    y, x = np.nonzero(filled)
    content = Image.fromarray(pixels[y.min() : y.max() + 1, x.min() : x.max() + 1])
    width, height = THUMBNAIL
    content = ImageOps.contain(content, (width - 20, height - 20), Image.Resampling.LANCZOS)
    thumbnail = Image.new("RGB", THUMBNAIL, tuple(map(int, background)))
    thumbnail.paste(content, ((width - content.width) // 2, (height - content.height) // 2))
    return thumbnail


# ---------------------------------------------------------------------- Sphinx
def setup(app: Any) -> dict[str, Any]:
    """Have thumbnails drawn once examples have run, and pages copied at the end; an extension of Sphinx."""
    app.connect("builder-inited", _make_thumbnails, priority=900)
    app.connect("doctree-read", _add_dark_thumbnails, priority=100)  # before images are collected
    app.connect("build-finished", _copy_pages)
    return {"parallel_read_safe": True}


def _make_thumbnails(app: Any) -> None:
    source = Path(app.srcdir)
    for thumbnail in (source / "gallery/auto").rglob("thumb/sphx_glr_*_thumb.png"):
        name = thumbnail.name.removeprefix("sphx_glr_").removesuffix("_thumb.png")
        section = thumbnail.parents[2].relative_to(source / "gallery/auto")
        recipes = [path for path in own_files(source / "gallery" / section / f"{name}.py") if path.suffix == ".json"]
        dark = _dark(thumbnail)
        first = min(recipes, key=lambda path: path.stat().st_mtime_ns, default=None)
        if first and not (dark.exists() and dark.stat().st_mtime_ns > first.stat().st_mtime_ns):
            draw_thumbnails(first, {"": thumbnail, "dark": dark})


def _dark(thumbnail: Path) -> Path:
    return thumbnail.with_name(thumbnail.name.replace("_thumb.png", "_dark.png"))


def _add_dark_thumbnails(app: Any, document: Any) -> None:
    from docutils import nodes

    for image in [*document.findall(nodes.image)]:
        dark = _dark(Path(image["uri"]))
        if image["uri"].endswith("_thumb.png") and Path(f"{app.srcdir}/{dark}").exists():
            copy = image.deepcopy()
            image["classes"].append("only-light")
            copy["uri"], copy["classes"] = dark.as_posix(), [*copy["classes"], "only-dark"]
            image.parent.insert(image.parent.index(image) + 1, copy)


def _copy_pages(app: Any, failure: Exception | None) -> None:
    if failure is None and app.builder.format == "html":
        for page in Path(app.srcdir).rglob(f"{PAGES}/*{PAGE}"):
            place = Path(app.outdir) / page.relative_to(app.srcdir)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(page, place)
