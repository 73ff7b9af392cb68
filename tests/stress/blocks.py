"""Blocks of cases, each tried in a process that is begun again where a case ends it."""

import json
import os
import signal
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from types import ModuleType

from .outcome import CRASHED, HUNG, Outcome, Tally

ROOT = Path(__file__).resolve().parents[2]
RUNNING: set[subprocess.Popen] = set()
TOO_LONG = (-signal.SIGPROF, -signal.SIGALRM)


class Stopped(Exception):
    """A block that was stopped: what is known of it does not count."""


def stop() -> None:
    """Stop all blocks."""
    while RUNNING:
        process = RUNNING.pop()
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


def block(part: ModuleType, seed: int, count: int = 0) -> Tally:
    """The outcomes of a part's cases with this seed, of the first `count` if that is given."""
    tally, number, last = Tally(), 0, count or part.BLOCK
    with tempfile.TemporaryDirectory(prefix="stress-") as folder:
        while number < last:
            number = _from(part, seed, number, last, folder, tally)
    return tally


def _from(part: ModuleType, seed: int, first: int, last: int, folder: str, tally: Tally) -> int:
    """Try cases until one of them ends the process; the number of the next."""
    name = part.__name__.rpartition(".")[2]
    command = [sys.executable, "-m", "tests.stress.child", name, *map(str, (seed, first, last, folder))]
    number = first - 1
    with tempfile.TemporaryFile("w+") as said:
        # Ctrl-C is not meant for it: what it does would look like a crash.
        options = {"stdout": subprocess.PIPE, "stderr": said, "text": True, "start_new_session": True}
        with subprocess.Popen(command, cwd=ROOT, **options) as process:
            RUNNING.add(process)
            for line in process.stdout or ():
                data = json.loads(line)
                if isinstance(data, int):
                    number = data
                elif data and "memory" in data:
                    tally.memory = max(tally.memory, data["memory"])
                    number = last
                elif data:
                    tally.add(Outcome(**data), number)
        if process not in RUNNING:
            raise Stopped
        RUNNING.discard(process)
        if number == last:
            return last
        said.seek(0)
        words = said.read().strip()
    if number < first:
        raise RuntimeError(f"{name} does not begin: {words[-2000:]}")
    if process.returncode in TOO_LONG:
        limit = "processor time" if process.returncode == TOO_LONG[0] else "time"
        tally.add(Outcome(HUNG, f"not done within its {limit}"), number)
    else:
        # What faulthandler says begins so.
        last = " ".join(words[max(words.find("Fatal Python error"), 0) :].split())[:300]
        tally.add(Outcome(CRASHED, f"ended by {_ended(process.returncode)}: {last}"), number)
    return number + 1


def _ended(status: int) -> str:
    return signal.Signals(-status).name if status < 0 else f"status {status}"
