"""The built guide as it is installed: without what only the build needs, and small."""

import re
import shutil
import zlib
from pathlib import Path

from PIL import Image

from .links import wrong_links

LEFT_OUT = (
    "*.map", ".buildinfo*", "objects.inv", "_sources", "fa-brands*", "webpack-macros.html", "searchindex.js",
    "__pycache__", "*.ipynb", "*.zip", "searchtools.js", "language_data.js", "*-stemmer.js", "*_badge_logo.svg",
    "broken_example.png", "no_image.png", "sg_gallery-*",
)  # fmt: skip
CHANGES = [
    # The guide has a search of its own.
    (r'<script src="[^"]*(?:searchindex|searchtools|language_data)\.js[^"]*"></script>\s*', ""),
    # Of the gallery's looks, what no example needs.
    (r"<link[^>]*sg_gallery-(?:binder|dataframe|rendered-html)\.css[^>]*>\s*", ""),
    # Of an example, its one file; as text, since what ends in .py in the program's folder would be taken for its own.
    (r'<div class="sphx-glr-download sphx-glr-download-(?:jupyter|zip)[^"]*">.*?</div>\s*', ""),
    (r'download="" href="([^"]*/)([^"/]+\.py)"', r'download="\2" href="\1\2.txt"'),
]
"""Patterns in pages, and what stands there instead."""
MOST = 10_000_000
"""Bytes of all files, compressed as they are in a wheel."""
QUALITY = 80
"""Of drawings; pictures of the window, in few colours, lose nothing."""


def install(pages: Path, target: Path) -> str:
    """Copy the pages to where the program looks for them; how many and how large, in words.

    ValueError where they are too large or a link leads nowhere; what was there before then stays.
    """
    fresh = pages.with_name("installed")
    shutil.rmtree(fresh, ignore_errors=True)
    shutil.copytree(pages, fresh, ignore=shutil.ignore_patterns(*LEFT_OUT))
    for path in list(fresh.rglob("*.py")):
        path.rename(path.with_name(f"{path.name}.txt"))
    changes = [*CHANGES, *_smaller_pictures(fresh / "_images")]
    for path in fresh.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        for pattern, instead in changes:
            text = re.sub(pattern, instead, text, flags=re.DOTALL)
        pieces = re.split(r"(<pre.*?</pre>)", text, flags=re.DOTALL)
        text = "".join(piece if odd % 2 else re.sub(r"\n\s+", "\n", piece) for odd, piece in enumerate(pieces))
        path.write_text(text, encoding="utf-8")
    if wrong := wrong_links(fresh):
        raise ValueError("links of the guide are wrong:\n" + "\n".join(wrong))
    sizes = {path: len(zlib.compress(path.read_bytes())) for path in fresh.rglob("*") if path.is_file()}
    if sum(sizes.values()) > MOST:
        largest = sorted(sizes, key=sizes.__getitem__, reverse=True)[:10]
        named = ", ".join(f"{path.relative_to(fresh)} {sizes[path] // 1000} kB" for path in largest)
        raise ValueError(f"the guide has {sum(sizes.values()):,} bytes, more than {MOST:,}; the largest: {named}")
    shutil.rmtree(target, ignore_errors=True)
    shutil.move(fresh, target)
    count = sum(path.suffix == ".html" for path in sizes)
    return f"{target / 'index.html'}: {count} pages, {sum(sizes.values()) / 1e6:.1f} MB compressed"


def _smaller_pictures(folder: Path) -> list[tuple[str, str]]:
    """Have PNG files become WebP; what has to be changed in pages for that."""
    changes = []
    for path in folder.glob("*.png"):
        with Image.open(path) as picture:
            picture.save(path.with_suffix(".webp"), lossless=picture.mode == "P", quality=QUALITY, method=6)
        path.unlink()
        changes.append((rf"(_images/{re.escape(path.stem)})\.png\b", r"\1.webp"))
    return changes
