"""Files of values at vertices of all kinds, damaged: each is read, or is refused in one sentence."""

import contextlib
import random
import tempfile
from functools import cache
from pathlib import Path

from bihdist_core.errors import ParameterError
from bihdist_core.formats.vertex_arrays import read_vertex_arrays
from tests.core.damage import damaged
from tests.core.field_samples import WRITERS

from .outcome import OPENED, REFUSED, WRONG, Outcome
from .sentences import fault_of

WORDS = "damaged files of values at vertices"
SEEDS, BLOCK, SECONDS = 40, 500, 20.0


@cache
def samples() -> tuple[tuple[str, bytes], ...]:
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for name, write in WRITERS.items():
            with contextlib.suppress(ImportError):  # of who writes such files
                write(Path(folder) / name)
                found.append((name, (Path(folder) / name).read_bytes()))
    return tuple(found)


def case(seed: int, number: int, folder: Path) -> Outcome:
    """A file with one to three damages, read."""
    rng = random.Random(f"field files {seed} {number}")
    name, content = rng.choice(samples())
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        content = damaged(content, rng) or b"\n"
    path = folder / name
    path.write_bytes(content)
    try:
        arrays = read_vertex_arrays(path)
    except ParameterError as error:
        fault = fault_of(str(error), name)
        return Outcome(WRONG, fault) if fault else Outcome(REFUSED)
    if any(array.values.ndim != 1 or array.values.dtype != float for array in arrays):
        return Outcome(WRONG, f"{name} was read as something else than values at vertices")
    return Outcome(OPENED)
