"""What a command says beside its result: progress, what was repaired, how accurate it is, what failed."""

import argparse
import io
import os
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from typing import TYPE_CHECKING

from bihdist_core.counts import counted

if TYPE_CHECKING:
    from bihdist_core import Distance, Surface
    from bihdist_core.arrays import FloatArray
    from bihdist_core.distances.answers import Answer
    from bihdist_core.progress import Progress


@contextmanager
def progress_line() -> "Iterator[Progress | None]":
    """A line of progress on a terminal, nothing elsewhere."""
    if not sys.stderr.isatty():
        yield None
        return
    last = 0.0

    def report(fraction: float, text: str) -> None:
        nonlocal last
        if time.monotonic() - last > 0.1:
            last = time.monotonic()
            width = os.get_terminal_size(sys.stderr.fileno()).columns
            print(f"\r\x1b[K{fraction:4.0%} {text}"[: width + 3], end="", file=sys.stderr, flush=True)

    try:
        yield report
    finally:
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)


@contextmanager
def standard_output(options: argparse.Namespace, text: str) -> Iterator[None]:
    """Where the output is `-`, the file goes to standard output, and what is said to standard error.

    text: the extension of the format, nothing if the command has none that is text: then OutputError.
    """
    if getattr(options, "output", None) != "-":
        yield
        return
    import shutil
    import tempfile

    from bihdist_core.errors import BihdistError, OutputError

    if not text:
        raise OutputError(f"`bihdist {options.command}` writes no text; name a file instead of -.")
    with tempfile.TemporaryDirectory() as folder:
        path, printed = os.path.join(folder, f"output{text}"), io.StringIO()
        options.output = path
        try:
            with redirect_stdout(printed):
                yield
        except BihdistError as error:
            raise type(error)(str(error).replace(path, "-")) from error
        finally:
            sys.stderr.write(printed.getvalue().replace(path, "-"))
        with open(path, encoding="utf-8") as file:
            shutil.copyfileobj(file, sys.stdout)


def tell(text: str) -> None:
    """A sentence beside the result."""
    print(f"bihdist: {text}", file=sys.stderr)


def warn(text: str) -> None:
    """Print a warning to standard error."""
    print(f"bihdist: warning: {text}", file=sys.stderr)


def tell_repairs(surface: "Surface") -> None:
    """Say on standard error what was done to a mesh, and what is to be minded about it."""
    from bihdist_core.analysis.surface_notes import surface_notes

    notes = surface_notes(surface)
    for text in (*notes.repairs, *notes.warnings):
        print(f"{surface.name}: {text}", file=sys.stderr)


def accuracy(distance: "Distance", everywhere: bool = False) -> str:
    """What to add to the words on an answer: how accurate it is, with a warning where that is poor.

    everywhere: on all components, also those not asked about.
    """
    error_estimate = distance.error_estimate(range(distance.surface.n_components) if everywhere else None)
    if error_estimate.is_poor:
        warn(f"{distance.label} on {distance.surface.name} is only {error_estimate.text}.")
    return f", {error_estimate.text}" if error_estimate.text else ""


def judged(answers: "Iterable[Answer]", name: str) -> int:
    """Warn of answers that are poor, name those that failed; the exit status: 1 if there is one."""
    answers = list(answers)
    failures = dict.fromkeys(f"{answer.label}: {answer.failure}" for answer in answers if answer.failure)
    for failure in failures:
        print(f"bihdist: {failure}", file=sys.stderr)
    for label, text in dict.fromkeys((a.label, a.accuracy.text) for a in answers if a.accuracy.is_poor):
        warn(f"{label} on {name} is only {text}.")
    return 1 if failures else 0


def tell_moved(path: str, noun: str, moved: "FloatArray", names: "Sequence[object]", surface: "Surface") -> None:
    """Say how far the points of a file (k,) had to be moved to vertices, if any were."""
    import numpy as np

    # Positions are often written with seven digits.
    size = float(np.linalg.norm(np.ptp(surface.vertices, axis=0)))
    far = np.flatnonzero(moved > 1e-6 * size)
    if len(far):
        most = int(moved.argmax())
        name = names[most] or most + 1
        tell(
            f"{path}: {counted(len(far), noun)} moved to a vertex; the farthest, {name}, by "
            f"{moved[most]:.3g} ({moved[most] / size:.2%} of the mesh's size)."
        )
