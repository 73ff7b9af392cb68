"""The build: sources and what is written of the program, their blocks run, Sphinx, and the copy to be installed."""

import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]
GUIDE = ROOT / "assets/guide"
SOURCE = ROOT / "build/guide/source"
PAGES = ROOT / "build/guide/pages"
PLUGIN = ROOT / "tests/plugin/geodesic_circle"
"""The tool that the reference shows."""
KEPT = ("_blocks", "gallery/auto")
"""Made in the copy of the sources, and kept from one build to the next."""


def main() -> int:
    """The exit status is 1 where a block fails, Sphinx warns or a link is wrong; the installed copy then stays."""
    write_sources(SOURCE)
    return build(SOURCE, PAGES, ROOT / "app/guide")


def build(source: Path, pages: Path, target: Path) -> int:
    """Run the blocks of all sources, make pages of them, and install these; the exit status."""
    from sphinx.cmd.build import main as sphinx

    from .installed_copy import install
    from .page_runs import run_pages
    from .search_index import write_search_index

    failures = run_pages(source)
    if failures:
        print(*failures, sep="\n\n", file=sys.stderr)
        return 1
    shutil.rmtree(pages, ignore_errors=True)
    options = ["-b", "html", "-W", "--keep-going", "-q", "-d", str(source.with_name("read"))]
    if sphinx([*options, str(source), str(pages)]):
        return 1
    write_search_index(pages)
    try:
        print(install(pages, target))
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


def write_sources(source: Path) -> None:
    """A copy of the guide's sources with the pages that are made of the program; what is as before is left alone."""
    from .command_pages import command_pages
    from .key_page import key_page
    from .library_pages import library_pages
    from .record_page import record_page

    made = {**library_pages(), **command_pages(), **key_page(), **record_page()}
    wanted = {path: text.encode() for path, text in made.items()}
    for path in GUIDE.rglob("*"):
        name = path.relative_to(GUIDE).as_posix()
        if path.is_file() and not name.startswith("building/") and "__pycache__" not in name:
            wanted[name] = path.read_bytes()
    wanted |= {f"reference/plugin/{path.name}": path.read_bytes() for path in PLUGIN.glob("*.py")}
    for name, content in wanted.items():
        path = source / name
        if not path.exists() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    for path in source.rglob("*"):
        name = path.relative_to(source).as_posix()
        if path.is_file() and name not in wanted and not name.startswith(KEPT):
            path.unlink()
    for page in (source / "gallery/auto").rglob("*.rst"):
        example = f"gallery/{page.relative_to(source / 'gallery/auto').with_suffix('.py').as_posix()}"
        if page.stem != "index" and example not in wanted:
            page.unlink()
