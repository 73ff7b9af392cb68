"""Runs pages without Sphinx: `python -m assets.guide.building PAGE.md …` prints what their blocks print.

What they write stays in `guide-try/PAGE`, with their outcomes in `outcomes.json`.
"""

import argparse
import sys
from pathlib import Path

from .blocks import BlockError, blocks_of
from .page_runs import run_and_store


def main() -> int:
    """The exit status is 1 where a block failed."""
    parser = argparse.ArgumentParser(prog="python -m assets.guide.building", description="Run the blocks of pages.")
    parser.add_argument("pages", metavar="PAGE.md", nargs="+", type=Path)
    parser.add_argument("--folder", metavar="DIR", type=Path, default=Path("guide-try"), help="for what they write")
    options, status = parser.parse_args(), 0
    for page in options.pages:
        folder = options.folder.resolve() / page.stem
        try:
            outcomes = run_and_store(page, folder)
        except BlockError as error:
            print(error, file=sys.stderr)
            status = 1
            continue
        for block, outcome in zip(blocks_of(page.read_text(encoding="utf-8")), outcomes, strict=True):
            pictures = [str(folder / name) for name in outcome.pictures]
            print(f"--- {page}:{block.line} {block.kind}", outcome.printed, *pictures, sep="\n")
    return status


if __name__ == "__main__":
    raise SystemExit(main())
