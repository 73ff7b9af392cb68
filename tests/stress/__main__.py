"""`python -m tests.stress [--parts ...] [--folder DIR] [--minutes M]`: a long run that attacks the program.

It goes on where an earlier run in the same folder was interrupted.  The exit status is 1 if there is a fault.
`--case PART SEED NUMBER` tries one case again, in this process.
"""

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests.bench import machine
from tests.bench.guide_page import put

from .blocks import block, stop
from .child import attempt
from .log import Log
from .parts import PARTS
from .table import faults, render

BEGIN, END = "<!-- stress: from the run -->", "<!-- end of stress -->"
"""Between them, in a page of the guide, is the table."""


def main(arguments: Sequence[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    if options.case:
        return _again(*options.case)
    log = Log(Path(options.folder))
    end = time.monotonic() + 60 * options.minutes
    left = [
        (name, seed)
        for name in options.parts
        for seed in range(options.blocks or PARTS[name].SEEDS)
        if (name, seed) not in log.tallies
    ]
    # All parts get on alike, so that a run of any length tries something of each.
    left.sort(key=lambda each: each[1] / PARTS[each[0]].SEEDS)

    def do(name: str, seed: int) -> None:
        if time.monotonic() < end:
            tally = block(PARTS[name], seed)
            log.add(name, seed, tally)
            print(f"{name} {seed}: {tally.tried} tried, {tally.faulty} faults", file=sys.stderr, flush=True)

    workers = ThreadPoolExecutor(options.workers)
    try:
        list(workers.map(lambda each: do(*each), left))
    except KeyboardInterrupt:
        workers.shutdown(wait=False, cancel_futures=True)
        stop()
        print(f"interrupted; what is done is in {log.path}, and a run goes on from there", file=sys.stderr)
        return 130
    words = {name: PARTS[name].WORDS for name in options.parts}
    table = f"{', '.join(sorted(log.days))}; {machine.describe()}\n\n{render(log, words)}"
    found = faults(log, words)
    print("\n".join([table, *(["", *found] if found else [])]))
    if options.table:
        put(Path(options.table), table, BEGIN, END)
    return 1 if any(log.of(name).faulty for name in options.parts) else 0


def _again(name: str, seed: str, number: str) -> int:
    with tempfile.TemporaryDirectory(prefix="stress-") as folder:
        print(attempt(PARTS[name], int(seed), int(number), Path(folder)))
    return 0


def _parts(text: str) -> list[str]:
    unknown = [word for word in text.split(",") if word not in PARTS]
    if unknown:
        raise argparse.ArgumentTypeError(f"there is no part {', '.join(unknown)}; parts are {', '.join(PARTS)}")
    return text.split(",")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.stress", description=__doc__.split("\n\n")[1])
    parser.add_argument("--parts", type=_parts, default=list(PARTS), help=f"some of {','.join(PARTS)}; all without it")
    parser.add_argument("--folder", default="stress-results", help="where results are kept (default: stress-results)")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="begin no block after so many")
    parser.add_argument("--blocks", type=int, help="so many of each part, in place of those of the recorded run")
    workers = os.cpu_count() or 1
    parser.add_argument("--workers", type=int, default=workers, help="processes side by side (default: one a core)")
    parser.add_argument("--table", metavar="PAGE", help="put the table into this page of the guide, too")
    parser.add_argument("--case", nargs=3, metavar=("PART", "SEED", "NUMBER"), help="try one case again, here")
    return parser


if __name__ == "__main__":
    sys.exit(main())
