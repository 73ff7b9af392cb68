"""Mesh files of all formats, damaged: each opens, and its distances obey the laws, or is refused in one sentence."""

import random
import tempfile
from functools import cache
from pathlib import Path

import numpy as np

from bihdist_core import MeshError, Surface, read_surface, write_mesh
from tests.core.damage import damaged
from tests.core.mesh_samples import samples_of_all_formats
from tests.shapes import bumpy, torus, two_pieces

from .laws import checked
from .outcome import REFUSED, WRONG, Outcome
from .sentences import fault_of

WORDS = "damaged mesh files of all formats"
SEEDS, BLOCK, SECONDS = 400, 500, 20.0
LARGER = 0.5
"""The share of files with more faces than three, of which more can be measured."""


@cache
def samples() -> tuple[tuple[str, bytes], ...]:
    with tempfile.TemporaryDirectory() as folder:
        return tuple(samples_of_all_formats(Path(folder)).items())


@cache
def larger_samples() -> tuple[tuple[str, bytes], ...]:
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for surface in (bumpy(40), torus(8, 5), two_pieces()):
            for extension in (".off", ".obj", ".ply", ".vtp"):
                path = Path(folder) / f"{surface.name.replace(' ', '_')}{extension}"
                write_mesh(path, surface)
                found.append((path.name, path.read_bytes()))
    return tuple(found)


def case(seed: int, number: int, folder: Path) -> Outcome:
    """A file with one to three damages, read and measured."""
    rng = random.Random(f"mesh files {seed} {number}")
    name, content = rng.choice(larger_samples() if rng.random() < LARGER else samples())
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        content = damaged(content, rng) or b"\n"
    path = folder / name
    path.write_bytes(content)
    return opened(path, rng.getrandbits(32))


def opened(path: Path, seed: int) -> Outcome:
    """What becomes of a mesh file that is read and measured from random vertices."""
    try:
        surface: Surface = read_surface(path)
    except MeshError as error:
        fault = fault_of(str(error), path.name)
        return Outcome(WRONG, fault) if fault else Outcome(REFUSED)
    with np.errstate(all="ignore"):
        return checked(surface, np.random.default_rng(seed))
