"""A part with each fault that a run has to find, for its tests."""

import os
import time
from pathlib import Path

from .outcome import LOST, OPENED, REFUSED, WRONG, Outcome

WORDS = "faults on purpose"
SEEDS, BLOCK, SECONDS = 2, 9, 0.3


def case(seed: int, number: int, folder: Path) -> Outcome | None:
    """One after the other: all outcomes, and all ways to end a process."""
    match number:
        case 0:
            return Outcome(OPENED, ratio=0.25 + seed)
        case 1:
            return Outcome(REFUSED)
        case 2:
            raise KeyError("nothing\nforeseen")
        case 3:
            os.abort()
        case 4:
            while True:
                pass
        case 5:
            return Outcome(WRONG, "another number")
        case 6:
            return Outcome(LOST, "half a file")
        case 7:
            time.sleep(60)
        case _:
            print("a program may print what it likes")
            return None
