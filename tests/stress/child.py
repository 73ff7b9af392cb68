"""`python -m tests.stress.child PART SEED FIRST LAST FOLDER`: cases of a part, one after the other, under limits.

A process of its own, which one of the cases may end.  Before each case it writes its number, after it its outcome, and
at the end the peak of its memory, a line of JSON each.
"""

import faulthandler
import json
import os
import resource
import signal
import sys
import traceback
import warnings
from dataclasses import asdict
from importlib import import_module
from pathlib import Path

from tests.bench.child import peak_memory

from .outcome import CRASHED, Outcome

MEMORY = 8 << 30
"""Bytes of addresses, of which libraries take some two GB and never touch them."""
WAITING = 20
"""So many times the processor time of a case may pass on the clock: machines are busy."""


def main(name: str, seed: str, first: str, last: str, folder: str) -> None:
    """Try the cases."""
    faulthandler.enable()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    told = os.fdopen(os.dup(1), "w")
    # What the program prints goes nowhere.
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    warnings.simplefilter("ignore")
    part = import_module(f"tests.stress.{name}")
    for number in range(int(first), int(last)):
        print(number, file=told, flush=True)
        # Either signal ends the process.
        signal.setitimer(signal.ITIMER_PROF, part.SECONDS)
        signal.setitimer(signal.ITIMER_REAL, WAITING * part.SECONDS)
        outcome = attempt(part, int(seed), number, Path(folder))
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        print(json.dumps(outcome and asdict(outcome)), file=told, flush=True)
    print(json.dumps({"memory": peak_memory()}), file=told, flush=True)
    told.close()
    os._exit(0)


def attempt(part: object, seed: int, number: int, folder: Path) -> Outcome | None:
    """A case; an exception that nothing foresaw is a crash."""
    try:
        return part.case(seed, number, folder)  # type: ignore[attr-defined]
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        words = " ".join(str(error).split())[:200]
        return Outcome(CRASHED, f"{type(error).__name__}: {words} ({Path(last.filename).name}:{last.lineno})")


if __name__ == "__main__":
    main(*sys.argv[1:])
