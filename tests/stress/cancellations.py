"""Work that is cancelled at a random moment: it ends soon, and there are answers again afterwards."""

import math
import random
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    Surface,
    write_mesh,
)
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.progress import Progress
from tests.app.conftest import Desk
from tests.shapes import bumpy, grid

from .outcome import OPENED, WRONG, Outcome

WORDS = "work of the library, and sessions, cancelled at random moments"
SEEDS, BLOCK, SECONDS = 20, 50, 60.0
LARGE = 3000
"""Vertices of the surface on which work is cancelled."""
ACROSS = 140
"""Squares across the sheet that a session is stopped on."""
FREE_WITHIN = 0.5
"""Seconds from a cancellation to its end."""
THREADS = 2
"""At most, by which work is done: what is measured is the time of processors."""
IDLE = 0.01
"""Seconds of processor time in a tenth of a second, of a session that waits."""
WORKS: dict[str, Callable[[Surface, Progress], object]] = {
    "biharmonic distances": lambda surface, progress: BiharmonicDistance(surface, progress=progress).from_sources(
        list(range(40)), progress
    ),
    "diffusion": lambda surface, progress: DiffusionDistance(Laplacian(surface), progress=progress),
    "the heat method": lambda surface, progress: GeodesicDistance(surface, "heat", progress).from_source(3, progress),
    "exact geodesics": lambda surface, progress: ExactGeodesic(surface).columns(range(30), progress),
}


def case(seed: int, number: int, folder: Path) -> Outcome:
    """A function of the library, or a session."""
    rng = random.Random(f"cancellations {seed} {number}")
    return _escaped(folder, rng) if rng.random() < 0.4 else _cancelled(rng)


def _cancelled(rng: random.Random) -> Outcome:
    """Long work that its progress stops at a random moment; afterwards there are answers again."""
    name = rng.choice(sorted(WORKS))
    WORKS[name](bumpy(60), lambda share, text: None)  # what is imported late is there
    surface = bumpy(LARGE, rng.randrange(5))
    moment = time.process_time() + rng.uniform(0, 1)

    def stop(_share: float, _text: str) -> None:
        if time.process_time() >= moment:
            raise Cancelled

    try:
        WORKS[name](surface, stop)
    except Cancelled:
        late = time.process_time() - moment
        if late > THREADS * FREE_WITHIN:
            return Outcome(WRONG, f"{name}: {late:.2f} s of processor time from its cancellation to its end")
    if not np.isfinite(BiharmonicDistance(bumpy(60)).from_source(0)).all():
        return Outcome(WRONG, f"{name}: no answers after it was cancelled")
    return Outcome(OPENED)


def _escaped(folder: Path, rng: random.Random) -> Outcome:
    """A session that opens a mesh and is told to stop at a random moment; afterwards it opens another."""
    for name, surface in (("long", grid(ACROSS, ACROSS)), ("short", bumpy(60))):
        if not (folder / f"{name}.off").exists():
            write_mesh(folder / f"{name}.off", surface)
    desk = Desk()
    try:
        desk.show(str(folder / "long.off"))
        desk.until(partial(_is_over, time.monotonic() + rng.uniform(0, 2)))
        begin = time.process_time()
        desk.session.cancel()
        until_idle(desk)
        late = time.process_time() - begin
        desk.loaded(str(folder / "short.off"))
    finally:
        desk.session.close()
    if late > THREADS * FREE_WITHIN:
        return Outcome(WRONG, f"{late:.2f} s of processor time from Esc to the end of all work")
    return Outcome(OPENED)


def until_idle(desk: Desk) -> None:
    """Until a tenth of a second costs next to nothing."""
    before, cost = time.process_time(), math.inf
    while cost > IDLE:
        desk.until(partial(_is_over, time.monotonic() + 0.1))
        before, cost = time.process_time(), time.process_time() - before


def _is_over(moment: float) -> bool:
    return time.monotonic() >= moment
