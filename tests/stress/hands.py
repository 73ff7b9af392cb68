"""Work in the real window that Esc stops at a random moment: how soon the window is free, and what it shows then."""

from pathlib import Path

from .outcome import OPENED, Outcome
from .screens import found_by, there_is_a_screen

WORDS = (
    "runs of 25 moments in a window: Esc in the midst of work, then a click, a change, undo, another mesh or its end"
)
SEEDS, BLOCK, SECONDS = 20, 1, 3600.0
MOMENTS = 25
LARGE = 40_000
"""Vertices of the meshes in whose reading, set-up and fields Esc is pressed."""


def case(seed: int, number: int, folder: Path) -> Outcome | None:
    """Some moments; nothing where there is no screen to be had."""
    return moments(1000 * seed + number, folder, MOMENTS, LARGE) if there_is_a_screen() else None


def moments(seed: int, folder: Path, count: int, size: int) -> Outcome:
    """So many moments in a window."""
    found = found_by("random_moments", seed, count, size, folder)
    return found if isinstance(found, Outcome) else Outcome(OPENED, seconds=max(found["waits"])[0])
