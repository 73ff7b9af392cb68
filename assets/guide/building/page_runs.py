"""The blocks of all pages, run before the build: a process for each page, two at once; what has not changed is kept."""

import hashlib
import json
import shutil
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from importlib.util import find_spec
from multiprocessing import get_all_start_methods, get_context
from pathlib import Path
from typing import Any

from .blocks import BlockError, Outcome, blocks_of, imported_modules, run_page
from .dark_figures import dark_name, draw_dark

ROOT = Path(__file__).parents[3]
PROCESSES = 2


def folder_of(page: Path, source: Path) -> Path:
    """Where the blocks of a page run; what they write stays there."""
    return source / "_blocks" / page.relative_to(source).with_suffix("")


def run_pages(source: Path) -> list[str]:
    """Run the blocks of all pages in a folder of pages; what failed, in words."""
    examples = [*source.rglob("*.md"), *(source / "gallery").rglob("*.py")]
    missing = {name for path in examples for name in imported_modules(path) if find_spec(name) is None}
    if missing:
        return [f"Examples import {', '.join(sorted(missing))}: add it to the extra `guide` in pyproject.toml."]
    files = [path for name in ("app", "bihdist_core") for path in (ROOT / name).rglob("*.py")]
    program, pages = max(path.stat().st_mtime for path in files), []
    for page in sorted(source.rglob("*.md")):
        blocks = blocks_of(page.read_text(encoding="utf-8"))
        key = hashlib.sha256(repr((program, blocks)).encode()).hexdigest()
        if blocks and _key(folder_of(page, source)) != key:
            pages.append((page, source, key))
    with ProcessPoolExecutor(PROCESSES, _context(), max_tasks_per_child=1) as pool:
        return [told for told in pool.map(_run, pages) if told]


def _context() -> Any:
    """How processes are started: where they can be forked, with what most pages import, which takes two seconds."""
    if "forkserver" not in get_all_start_methods():
        return get_context("spawn")
    context = get_context("forkserver")
    context.set_forkserver_preload(["assets.guide.building.page_imports"])
    return context


def outcomes_of(page: Path, source: Path) -> list[Outcome]:
    """What became of the blocks of a page that has been run."""
    stored = json.loads((folder_of(page, source) / "outcomes.json").read_text(encoding="utf-8"))
    return [Outcome(each["printed"], tuple(each["pictures"])) for each in stored["outcomes"]]


def run_and_store(page: Path, folder: Path, key: str = "") -> list[Outcome]:
    """Run the blocks of a page in an empty folder, and keep their outcomes there; BlockError where one fails."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    outcomes = run_page(page.resolve(), folder)
    for picture in {folder / name for outcome in outcomes for name in outcome.pictures}:
        draw_dark(picture, dark_name(picture))
    stored = {"key": key, "outcomes": [asdict(outcome) for outcome in outcomes]}
    (folder / "outcomes.json").write_text(json.dumps(stored, indent=1), encoding="utf-8")
    return outcomes


def _run(each: tuple[Path, Path, str]) -> str:
    """Run a page in a process of its own, where nothing of another is left; what failed, in words."""
    page, source, key = each
    try:
        run_and_store(page, folder_of(page, source), key)
    except BlockError as error:
        print(f"{page.relative_to(source)}: a block FAILED", flush=True)
        return str(error)
    print(f"{page.relative_to(source)}: its blocks have run", flush=True)
    return ""


def _key(folder: Path) -> str:
    stored = folder / "outcomes.json"
    return str(json.loads(stored.read_text(encoding="utf-8"))["key"]) if stored.exists() else ""
