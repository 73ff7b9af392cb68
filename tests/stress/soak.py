"""Many clicks and opens, in a session without a window and in a window: memory and handles stay as they are."""

import os
import random
import threading
from pathlib import Path

import numpy as np

from bihdist_core import write_mesh
from tests.app.conftest import Desk
from tests.shapes import bumpy, grid, torus

from .cancellations import until_idle
from .outcome import OPENED, WRONG, Outcome
from .screens import found_by, there_is_a_screen

WORDS = "10,000 clicks and 200 opens in a session, 2,000 acts of hands in a window"
SEEDS, BLOCK, SECONDS = 5, 2, 3600.0
CLICKS, OPENS, HAND_ACTIONS = 10_000, 200, 2_000
GROWTH = 30 << 20
"""Bytes by which memory may grow after the first tenth: answers are kept, and pools of what was freed fill up."""
GROWTH_OF_SESSION = 10 << 20
"""The same where nothing is drawn: all that is kept is bounded in number."""
SPARE = 5
"""Handles and threads of pools; one left of each open is many more."""
SAMPLES = 20
PATIENCE = 120.0


def case(seed: int, number: int, folder: Path) -> Outcome | None:
    """A session, then a window where there can be one."""
    return session(seed, folder, CLICKS, OPENS) if number == 0 else window(seed, folder, HAND_ACTIONS)


def session(seed: int, folder: Path, clicks: int, opens: int) -> Outcome:
    """Clicks at random vertices, with another mesh opened now and then."""
    rng = random.Random(f"soak {seed}")
    paths: list[str] = []
    for k in range(opens):
        shape = (bumpy(200, k), torus(20, 10), grid(12, 10))[k % 3]
        paths.append(str(folder / f"{k}.off"))
        write_mesh(paths[-1], shape)
    desk = Desk()
    memory, handles, every = [], [], max(clicks // opens, 1)
    try:
        for k in range(clicks):
            if k % every == 0:
                desk.show(paths[k // every % len(paths)])
            else:
                document, count = desk.session.document, len(desk.session.mesh().surface.vertices)
                desk.click(rng.randrange(count), rng.choice(document.panels).id)
            desk.until(lambda: desk.session.is_complete and not desk.session.is_opening, PATIENCE)
            desk.drain()
            if k % max(clicks // SAMPLES, 1) == 0:
                until_idle(desk)  # what was given up has ended
                memory.append(_resident())
                handles.append(len(os.listdir("/proc/self/fd")) + threading.active_count())
    finally:
        desk.session.close()
    return _flat(memory, handles, GROWTH_OF_SESSION)


def window(seed: int, folder: Path, actions: int) -> Outcome | None:
    """Random hands on the real window; nothing where there is no screen to be had."""
    if not there_is_a_screen():
        return None
    found = found_by("random_actions", seed, actions, folder)
    if isinstance(found, Outcome):
        return found
    return _flat([1e6 * megabytes for megabytes in found["rss"]], [0])


def _resident() -> int:
    return 1024 * int(Path("/proc/self/status").read_text().split("VmRSS:")[1].split()[0])


def _flat(memory: list, handles: list, growth_allowed: int = GROWTH) -> Outcome:
    """Whether neither grows after the first tenth, by their medians of the tenth after that and of the last."""
    tenth = max(len(memory) // 10, 1)
    growth = float(np.median(memory[-tenth:]) - np.median(memory[tenth : 2 * tenth + 1]))
    if growth > growth_allowed:
        return Outcome(WRONG, f"memory grows by {growth / 1e6:.0f} MB after the first tenth")
    more = round(float(np.median(handles[-tenth:]) - np.median(handles[tenth : 2 * tenth + 1])))
    return Outcome(WRONG, f"{more} more handles and threads at the end") if more > SPARE else Outcome(OPENED)
