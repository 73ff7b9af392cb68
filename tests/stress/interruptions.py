"""Work that is killed or finds the disk full: what is there under a final name is whole, and the next run goes on.

Commands run in a process that is forked from this one, which has not computed anything yet, so that the moment at
which they are killed is one of their work and not of Python's start.
"""

import contextlib
import io
import os
import random
import resource
import signal
import sys
import time
import traceback
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np

from app.document.page import Recipe
from app.main import main
from app.session.array_store import comparison_of_arrays
from app.session.recipe_file import recipe_written
from bihdist_core import OutputError, write_mesh
from tests.shapes import bumpy

from .outcome import CRASHED, LOST, OPENED, REFUSED, WRONG, Outcome
from .sentences import fault_of

WORDS = "work that is killed or finds the disk full"
SEEDS, BLOCK, SECONDS = 40, 50, 60.0
COUNT = 400
"""Vertices of the mesh that commands work on."""
PARTIAL = ".part"
"""What `pairs` keeps of what it has done, to go on from there."""
COMMANDS = {
    "field.npy": "field MESH --sources 5,7 -o OUT",
    "field.csv": "field MESH --sources 5,7 -o OUT",
    "field.ply": "field MESH --sources 5,7 -o OUT",
    "field.vtp": "field MESH --sources 5,7 -o OUT",
    "pairs.npy": "pairs MESH --sources all --memory 0.2 -o OUT",
    "lines.vtp": "isolines MESH --sources 5 -o OUT",
    "ids.csv": "samples MESH --sources farthest:50 -o OUT",
    "results": "batch MESH --do fields,eigen --k 9 --sources 5 --workers 1 -o OUT",
    "session.json": "",
}
"""By what they write; a session is written by no command."""


def case(seed: int, number: int, folder: Path) -> Outcome:
    """A command, or the saving of a session, that is killed at a random moment or has no room."""
    rng = random.Random(f"interruptions {seed} {number}")
    name = rng.choice(sorted(COMMANDS))
    attack = _killed if name == "results" or rng.random() < 0.6 else _full
    return attack(name, folder, _sound(name, folder), rng)


# ---------------------------------------------------------------------- processes
def forked(work: Callable[[], int], said: Path) -> int:
    """Begin work in a process of its own, whose messages go to a file; its id."""
    process = os.fork()
    if process:
        return process
    status = 70
    try:
        os.setpgid(0, 0)
        with said.open("w") as file, contextlib.redirect_stderr(file), contextlib.redirect_stdout(io.StringIO()):
            try:
                status = work()
            except BaseException:
                traceback.print_exc()
    finally:
        os._exit(status)


def ended(process: int) -> int:
    """The status with which a process ends, the negative number of the signal that ended it."""
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


# ---------------------------------------------------------------------- kills
def _work(name: str, folder: Path, out: Path) -> Callable[[], int]:
    if name == "session.json":
        return lambda: _save(out)
    words = [{"MESH": str(folder / "m.off"), "OUT": str(out)}.get(word, word) for word in COMMANDS[name].split()]
    return lambda: main(words)


def _save(path: Path) -> int:
    surface = bumpy(COUNT)
    document, given = comparison_of_arrays(surface, ["biharmonic", "mine"], {"mine": surface.vertices[:, 0]}, (5,))
    with recipe_written(Recipe(document), given, path, "0"):
        pass
    return 0


@cache
def _sound(name: str, folder: Path) -> tuple[dict[str, bytes], float]:
    """What a command writes that nobody disturbs, by the names of files, and how many seconds it takes."""
    if not (folder / "m.off").exists():
        write_mesh(folder / "m.off", bumpy(COUNT))
    place = folder / f"sound {name}"
    place.mkdir()
    begin = time.monotonic()
    status = ended(forked(_work(name, folder, place / name), folder / "said"))
    if status:
        raise RuntimeError(f"{name}: {(folder / 'said').read_text()[-300:]}")
    return _files(place), time.monotonic() - begin


def _files(place: Path) -> dict[str, bytes]:
    """All files below a folder but those of a batch that tell times, and those of work that may go on."""
    paths = [path for path in place.rglob("*") if path.is_file() and path.suffix != PARTIAL]
    return {
        str(path.relative_to(place)): b"" if "results/" in str(path) and path.suffix != ".npy" else _content(path)
        for path in paths
    }


def _content(path: Path) -> bytes:
    """The bytes of a file, of an archive those of its arrays: its entries have times."""
    try:
        with np.load(path) as archive:
            return b"".join(archive[name].tobytes() for name in archive.files)
    except Exception:
        return path.read_bytes()


def _killed(name: str, folder: Path, sound: tuple[dict[str, bytes], float], rng: random.Random) -> Outcome:
    """Kill a command, sometimes more than once, then let it be: what it writes is what it writes undisturbed."""
    whole, seconds = sound
    place = folder / f"killed {rng.getrandbits(40):x}"
    place.mkdir()
    old = rng.random() < 0.5 and name != "results"
    if old:
        (place / name).write_bytes(b"old")
    for _ in range(rng.choice((1, 1, 2))):
        process = forked(_work(name, folder, place / name), folder / "said")
        time.sleep(rng.uniform(0, 1.1) * seconds)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process, signal.SIGKILL)
        status = ended(process)
        for file, content in _files(place).items():
            if Path(file).name.startswith("."):
                continue  # half-written files have names of their own
            if content != whole.get(file) and not (old and content == b"old"):
                return Outcome(LOST, f"{file} is half written after a kill, {len(content)} bytes")
        if old and name not in _files(place):
            return Outcome(LOST, f"what was in {name} is gone after a kill")
        if status not in (0, -signal.SIGKILL):
            return Outcome(CRASHED, f"{name}: status {status}: {(folder / 'said').read_text()[-300:]}")
    status = ended(forked(_work(name, folder, place / name), folder / "said"))
    said = (folder / "said").read_text()
    if status:
        return Outcome(CRASHED, f"{name} does not go on: status {status}: {said[-300:]}")
    found = _files(place)
    wrong = [file for file in whole if found.get(file) != whole[file]]
    return Outcome(WRONG, f"{wrong[0]} is another after a kill") if wrong else Outcome(OPENED)


# ---------------------------------------------------------------------- full disks
def _full(name: str, folder: Path, sound: tuple[dict[str, bytes], float], rng: random.Random) -> Outcome:
    """A limit on the size of files stands for a disk that is full."""
    place = folder / f"full {rng.getrandbits(40):x}"
    place.mkdir()
    (place / name).write_bytes(b"old")
    room = int(rng.uniform(0, 1.1) * max(map(len, sound[0].values())))
    work = _work(name, folder, place / name)

    def limited() -> int:
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, before[1]))
        said = io.StringIO()
        try:
            # What is said goes to a file, too, and has to find room there.
            with contextlib.redirect_stderr(said):
                return work()
        except OutputError as error:  # of a session, which no command saves
            print(f"bihdist: {error}", file=said)
            return 2
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
            sys.stderr.write(said.getvalue())

    status = ended(forked(limited, folder / "said"))
    said = (folder / "said").read_text()
    found = _files(place)
    if status == 0:
        wrong = [file for file in sound[0] if found.get(file) != sound[0][file]]
        return Outcome(WRONG, f"{wrong[0]} is not whole, and nothing is said") if wrong else Outcome(OPENED)
    left = [file for file in found if file != name]
    if found.get(name) != b"old":
        return Outcome(LOST, f"what was in {name} is gone, of a disk with room for {room} bytes")
    if left:
        return Outcome(WRONG, f"{left[0]} is left on a full disk")
    if status != 2 or "Traceback" in said:
        return Outcome(CRASHED, f"{name} on a full disk: status {status}: {said[-300:]}")
    last = said.strip().splitlines()[-1] if said.strip() else ""
    fault = fault_of(last.removeprefix("bihdist: "), name.partition(".")[0])
    return Outcome(WRONG, f"{name} on a full disk: {fault}") if fault else Outcome(REFUSED)
