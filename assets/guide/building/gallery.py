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

from .dark_figures import dark_name, draw_dark

if TYPE_CHECKING:
    from PIL.Image import Image

    from app.figures.picture import Picture

PICTURES = (".png", ".gif")
PAGE = ".html"
OTHERS = (".json", ".tex", ".csv")
"""Of what else is written these can be downloaded."""

THUMBNAIL = (400, 280)
DRAWN = "800x660"
"""The size in which thumbnails are drawn, with colour bars, which are then cut off."""

PAGES = "pages"
"""The folder of web pages beside an example's page, which Sphinx knows nothing of."""

IMAGE = """
.. image:: /{path}
    :alt: {title}
    :class: sphx-glr-single-img
"""

IFRAME = """
.. raw:: html

    <iframe src="{path}" title="{title}" loading="lazy" style="width: 100%; height: 32rem; border: 0"></iframe>
"""


# ---------------------------------------------------------------------- what sphinx-gallery calls
def saved_files(block: tuple[Any, ...], variables: dict[str, Any], conf: Mapping[str, Any], **_: Any) -> str:
    """What a block has saved, as reStructuredText; a scraper of sphinx-gallery."""
    source, page = Path(variables["src_file"]), Path(variables["target_file"]).parent
    seen = variables.setdefault("saved_files", set())
    new = sorted((path for path in own_files(source) if path not in seen), key=lambda path: path.stat().st_mtime_ns)
    seen.update(new)
    shown, text = [], ""
    for path in new:
        if path.suffix in PICTURES:
            shown.append(Path(next(variables["image_path_iterator"])).with_suffix(path.suffix))
            shutil.copy(path, shown[-1])
        elif path.suffix == PAGE:
            (page / PAGES).mkdir(exist_ok=True)
            shutil.copy(path, page / PAGES)
            text += IFRAME.format(path=f"{PAGES}/{path.name}", title=path.stem.replace("_", " "))
        elif path.suffix in OTHERS:
            shutil.copy(path, page)
    downloads = ", ".join(f":download:`{path.name}`" for path in new if path.suffix in OTHERS)
    title = source.stem.replace("_", " ")
    places = [Path(path).relative_to(conf["src_dir"]).as_posix() for path in shown]
    pictures = "\n".join(IMAGE.format(path=place, title=title) for place in places)
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
def draw_thumbnails(recipe: Path, targets: Mapping[str, Path]) -> Picture:
    """Draw the first and the last panel of a recipe's figure without text, in the styles that `targets` has files for;
    "" is its own style. Returns the figure.
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
    return drawn


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
    app.connect("build-finished", _copy_pages)
    return {"parallel_read_safe": True}


def _make_thumbnails(app: Any) -> None:
    source = Path(app.srcdir)
    for thumbnail in (source / "gallery/auto").rglob("thumb/sphx_glr_*_thumb.png"):
        name = thumbnail.name.removeprefix("sphx_glr_").removesuffix("_thumb.png")
        section = thumbnail.parents[2].relative_to(source / "gallery/auto")
        files = own_files(source / "gallery" / section / f"{name}.py")
        files.sort(key=lambda path: path.stat().st_mtime_ns)
        dark = dark_name(thumbnail)
        first = next((path for path in files if path.suffix == ".json"), None)
        if first is None or (dark.exists() and dark.stat().st_mtime_ns > first.stat().st_mtime_ns):
            continue
        drawn = draw_thumbnails(first, {"": thumbnail, "dark": dark})
        for number, path in enumerate((path for path in files if path.suffix in PICTURES), 1):
            shown = thumbnail.parents[1] / f"sphx_glr_{name}_{number:03}.png"
            draw_dark(path, dark_name(shown), drawn if path.stem == first.stem else None)


def _copy_pages(app: Any, failure: Exception | None) -> None:
    if failure is None and app.builder.format == "html":
        for page in Path(app.srcdir).rglob(f"{PAGES}/*{PAGE}"):
            place = Path(app.outdir) / page.relative_to(app.srcdir)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(page, place)
