"""What the gallery shows of an example: below each block what it has saved, and the files to be downloaded.

    extensions = ["sphinx_gallery.gen_gallery", "assets.guide.building.gallery"]
    sphinx_gallery_conf = {"image_scrapers": ("assets.guide.building.gallery.saved_files",)}

Names of what an example saves begin with its own.  It is built where nothing of it has been saved before.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

PICTURES = (".png", ".gif")
PAGE = ".html"
OTHERS = (".json", ".tex", ".csv")
"""Of what else is written these can be downloaded."""

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


# ---------------------------------------------------------------------- Sphinx
def setup(app: Any) -> dict[str, Any]:
    """Have pages copied once Sphinx has built the others; an extension of Sphinx."""
    app.connect("build-finished", _copy_pages)
    return {"parallel_read_safe": True}


def _copy_pages(app: Any, failure: Exception | None) -> None:
    if failure is None and app.builder.format == "html":
        for page in Path(app.srcdir).rglob(f"{PAGES}/*{PAGE}"):
            place = Path(app.outdir) / page.relative_to(app.srcdir)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(page, place)
