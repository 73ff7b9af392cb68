"""Runs pages without Sphinx: `python -m assets.guide.building PAGE.md …` prints what their blocks print.

What they write stays in `guide-try/PAGE`, with their outcomes in `outcomes.json`.
"""

import argparse
import json
import shutil
import sys
from dataclasses import asdict
from pathlib import Path

from .blocks import BlockError, blocks_of, run_page


def main() -> int:
    """The exit status is 1 where a block failed."""
    parser = argparse.ArgumentParser(prog="python -m assets.guide.building", description="Run the blocks of pages.")
    parser.add_argument("pages", metavar="PAGE.md", nargs="+", type=Path)
    parser.add_argument("--folder", metavar="DIR", type=Path, default=Path("guide-try"), help="for what they write")
    parser.add_argument("--key", default="", help="kept with the outcomes")
    options, status = parser.parse_args(), 0
    for page in options.pages:
        folder = options.folder.resolve() / page.stem
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        try:
            outcomes = run_page(page.resolve(), folder)
        except BlockError as error:
            print(error, file=sys.stderr)
            status = 1
            continue
        stored = {"key": options.key, "outcomes": [asdict(outcome) for outcome in outcomes]}
        (folder / "outcomes.json").write_text(json.dumps(stored, indent=1), encoding="utf-8")
        for block, outcome in zip(blocks_of(page.read_text(encoding="utf-8")), outcomes, strict=True):
            pictures = [str(folder / name) for name in outcome.pictures]
            print(f"--- {page}:{block.line} {block.kind}", outcome.printed, *pictures, sep="\n")
    return status


if __name__ == "__main__":
    raise SystemExit(main())
