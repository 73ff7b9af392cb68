"""The blocks of all pages, run before the build: a process for each page, two at once; what has not changed is kept."""

import hashlib
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path

from .blocks import Outcome, blocks_of, imported_modules

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
    with ThreadPoolExecutor(PROCESSES) as pool:
        return [told for told in pool.map(lambda each: _run(*each), pages) if told]


def outcomes_of(page: Path, source: Path) -> list[Outcome]:
    """What became of the blocks of a page that has been run."""
    stored = json.loads((folder_of(page, source) / "outcomes.json").read_text(encoding="utf-8"))
    return [Outcome(each["printed"], tuple(each["pictures"])) for each in stored["outcomes"]]


def _run(page: Path, source: Path, key: str) -> str:
    """A process for each page: none minds what another has left behind."""
    command = [sys.executable, "-m", "assets.guide.building", str(page)]
    more = ["--folder", str(folder_of(page, source).parent), "--key", key]
    done = subprocess.run([*command, *more], cwd=ROOT, capture_output=True, text=True)
    print(f"{page.relative_to(source)}: {'its blocks have run' if done.returncode == 0 else 'a block FAILED'}")
    return "" if done.returncode == 0 else done.stderr.strip()


def _key(folder: Path) -> str:
    stored = folder / "outcomes.json"
    return str(json.loads(stored.read_text(encoding="utf-8"))["key"]) if stored.exists() else ""
