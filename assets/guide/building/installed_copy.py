"""The built guide as it is installed: without what only the build needs, and small."""

import shutil
from pathlib import Path

LEFT_OUT = ("*.map", ".buildinfo*", "objects.inv", "*.LICENSE.txt.map", "_sources", "_downloads/*.zip", "fa-brands*")
MOST = 6_000_000
"""Bytes of all files."""


def install(pages: Path, target: Path) -> str:
    """Copy the pages to where the program looks for them; how many and how large, in words.  ValueError if too large."""
    fresh = target.with_name(f"{target.name}.new")
    shutil.rmtree(fresh, ignore_errors=True)
    shutil.copytree(pages, fresh, ignore=shutil.ignore_patterns(*LEFT_OUT))
    sizes = {path: path.stat().st_size for path in fresh.rglob("*") if path.is_file()}
    if sum(sizes.values()) > MOST:
        largest = sorted(sizes, key=sizes.__getitem__, reverse=True)[:10]
        named = ", ".join(f"{path.relative_to(fresh)} {sizes[path] // 1000} kB" for path in largest)
        raise ValueError(f"the guide has {sum(sizes.values()):,} bytes, more than {MOST:,}; the largest: {named}")
    shutil.rmtree(target, ignore_errors=True)
    fresh.rename(target)
    count = sum(path.suffix == ".html" for path in sizes)
    return f"{target / 'index.html'}: {count} pages, {sum(sizes.values()) / 1e6:.1f} MB"
