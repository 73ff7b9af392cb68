"""The result of a command, as plain values, and its messages: progress, repairs, accuracy and failures."""

import argparse
import io
import json
import math
import os
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout, suppress
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from bihdist_core.counts import counted
from bihdist_core.errors import BihdistError, LandmarkWarning, OutputError, PlainSolverWarning
from bihdist_core.expected_time import duration_in
from bihdist_core.progress import Progress

from ..session.time_left import TimeLeft
from ..version import version

if TYPE_CHECKING:
    from bihdist_core import Distance, Surface
    from bihdist_core.distances.accuracy import ErrorEstimate
    from bihdist_core.distances.answers import Answer
    from bihdist_core.formats.anchors import Anchors
    from bihdist_core.formats.pins import Pins

PROGRESS_INTERVAL_S = 10.0
"""Seconds from one line of progress to the next where there is no terminal."""


@dataclass
class _Telling:
    """The messages of the command that runs, as a process has one standard error."""

    quiet: bool = False
    clock: Callable[[], float] = time.monotonic
    notes: list[str] = field(default_factory=list)
    last: float = 0.0
    turn: threading.Lock = field(default_factory=threading.Lock)

    def __post_init__(self) -> None:
        self.last = self.clock()

    def note(self, text: str, before: str = "bihdist: ") -> None:
        """Keep a sentence, and tell it unless quiet."""
        self.notes.append(text)
        if not self.quiet:
            print(f"{before}{text}", file=sys.stderr)

    def line(self, text: str) -> None:
        """Tell a line of progress."""
        self.last = self.clock()
        print(f"bihdist: {text}", file=sys.stderr, flush=True)

    def line_if_due(self, words: Callable[[], str]) -> None:
        """Tell a line of progress if there has been none for long."""
        with self.turn:
            if self.clock() - self.last >= PROGRESS_INTERVAL_S:
                self.line(words())

    @contextmanager
    def watched(self, words: Callable[[], str]) -> Iterator[None]:
        """Tell a line of progress whenever there has been none for long, while the block runs."""
        ended = threading.Event()

        def watch() -> None:
            # A standard error that is closed ends the command where the work itself reports.
            with suppress(OSError):
                while not ended.wait(PROGRESS_INTERVAL_S / 10):
                    self.line_if_due(words)

        watching = threading.Thread(target=watch, name="progress", daemon=True)
        watching.start()
        try:
            yield
        finally:
            ended.set()
            watching.join()

    @contextmanager
    def progress(self) -> Iterator[Progress]:
        """Tell progress as a line now and then, also while a step reports nothing, and at once for long work."""
        left, announced, words = TimeLeft(), set[str](), "under way"

        def report(fraction: float, text: str) -> None:
            nonlocal words
            words = with_time_left(fraction, text, left, self.clock())
            if duration_in(text) and text not in announced:
                announced.add(text)
                self.line(words)
            self.line_if_due(lambda: words)

        with self.watched(lambda: words):
            yield report


_telling = _Telling()


def add_telling(parser: argparse.ArgumentParser) -> None:
    """Add the options that all commands have."""
    parser.add_argument("--json", action="store_true", help="print the result as one JSON object, and nothing else")
    parser.add_argument("--quiet", action="store_true", help="print errors only, no notes and no progress")


@contextmanager
def telling(quiet: bool = False, clock: Callable[[], float] = time.monotonic) -> Iterator[list[str]]:
    """Tell notes and progress while a command runs, or keep them quiet; yields all notes."""
    global _telling
    before, _telling = _telling, _Telling(quiet, clock)
    shown = warnings.showwarning

    def show(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        if issubclass(category, PlainSolverWarning | LandmarkWarning):
            _telling.note(str(message))
        else:
            shown(message, category, *where, **more)

    warnings.showwarning = show
    try:
        yield _telling.notes
    finally:
        _telling = before
        warnings.showwarning = shown


def is_quiet() -> bool:
    """Return whether neither notes nor progress are told."""
    return _telling.quiet


@contextmanager
def progress_line() -> Iterator[Progress | None]:
    """Show a line of progress on a terminal, and a new line every ten seconds elsewhere."""
    if _telling.quiet:
        yield None
        return
    if not sys.stderr.isatty():
        with _telling.progress() as report_line:
            yield report_line
        return
    last, left = 0.0, TimeLeft()

    def report(fraction: float, text: str) -> None:
        nonlocal last
        if time.monotonic() - last > 0.1:
            last = time.monotonic()
            width = os.get_terminal_size(sys.stderr.fileno()).columns
            words = with_time_left(fraction, text, left, last)
            print(f"\r\x1b[K{words}"[: width + 3], end="", file=sys.stderr, flush=True)

    try:
        yield report
    finally:
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def with_time_left(fraction: float, text: str, left: TimeLeft, now: float) -> str:
    """Return words such as "12% Factoring the matrix, about 30 s left"."""
    head = text.partition(":")[0] if duration_in(text) else text
    return ", ".join(filter(None, (f"{fraction:.0%} {head}", left.words(fraction, text, now))))


@contextmanager
def task_lines(words: Callable[[], str]) -> Iterator[Callable[[str], None]]:
    """Without a terminal, tell a line for each task that is done, and `words` if none ends for long."""
    telling = _telling
    with telling.watched(words):
        yield telling.line


@contextmanager
def standard_output(options: argparse.Namespace, text: str) -> Iterator[None]:
    """Write the file of the output `-` to standard output, and messages to standard error.

    With `--json` only the JSON is printed, and with `--quiet` nothing where a file is written. `text` is the extension
    of the format; OutputError if the command has no text format.
    """
    output = getattr(options, "output", None)
    if output != "-":
        writes_file = output or getattr(options, "usual_output", "")
        with redirect_stdout(io.StringIO()) if options.json or (options.quiet and writes_file) else nullcontext():
            yield
        return
    import shutil
    import tempfile

    if not text:
        raise OutputError(f"`bihdist {options.command}` writes no text; name a file instead of -.")
    if options.json:
        raise OutputError("Standard output takes either the file or the JSON; name a file instead of -.")
    with tempfile.TemporaryDirectory() as folder:
        path, printed = os.path.join(folder, f"output{text}"), io.StringIO()
        options.output, options.is_standard_output = path, True
        try:
            with redirect_stdout(printed):
                yield
        except BihdistError as error:
            raise type(error)(str(error).replace(path, "-")) from error
        finally:
            if not _telling.quiet:
                sys.stderr.write(printed.getvalue().replace(path, "-"))
        with open(path, encoding="utf-8") as file:
            shutil.copyfileobj(file, sys.stdout)


def tell(text: str) -> None:
    """Tell a sentence beside the result."""
    _telling.note(text)


def tell_failure(text: str) -> None:
    """Tell a sentence on what could not be done, even if quiet."""
    print(f"bihdist: {text}", file=sys.stderr)


def warn(text: str) -> None:
    """Tell a warning beside the result."""
    _telling.note(f"warning: {text}")


def tell_repairs(surface: "Surface") -> None:
    """Say on standard error what was done to a mesh, and what is to be minded about it."""
    from bihdist_core.analysis.surface_notes import surface_notes

    notes = surface_notes(surface)
    for text in (*notes.repairs, *notes.warnings):
        _telling.note(f"{surface.name}: {text}", before="")


def accuracy(distance: "Distance", everywhere: bool = False) -> str:
    """Word the accuracy of an answer, and warn if it is poor.

    With `everywhere` it is that on all components, also on those not asked about.
    """
    return tell_accuracy(
        distance, distance.error_estimate(range(distance.surface.n_components) if everywhere else None)
    )


def tell_accuracy(distance: "Distance", error_estimate: "ErrorEstimate") -> str:
    """Word an error estimate to follow an answer, and warn if it is poor."""
    if error_estimate.is_poor:
        warn(f"{distance.label} on {distance.surface.name} is only {error_estimate.text}.")
    return f", {error_estimate.text}" if error_estimate.text else ""


def report_answers(answers: "Iterable[Answer]", name: str) -> int:
    """Warn of answers that are poor, and name those that failed; return the exit status, 1 if there is a failure."""
    answers = list(answers)
    failures = dict.fromkeys(f"{answer.label}: {answer.failure}" for answer in answers if answer.failure)
    for failure in failures:
        tell_failure(failure)
    for label, text in dict.fromkeys((a.label, a.accuracy.text) for a in answers if a.accuracy.is_poor):
        warn(f"{label} on {name} is only {text}.")
    return 1 if failures else 0


def tell_moved(path: str, noun: str, found: "Pins | Anchors", names: Sequence[object], surface: "Surface") -> None:
    """Say how far the points of a file (k,) had to be moved to vertices, if any were, and what is known of them."""
    import numpy as np

    moved = found.moved
    for fact in found.facts:
        tell(f"{path}: {fact}.")

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


Facts = dict[str, Any]


@dataclass(frozen=True)
class Result:
    """Facts by names in snake_case, those of the library's attributes where it has them; NumPy arrays may be among
    them.

    With `ends_process` the process ends at once when they have been printed.
    """

    facts: Facts = field(default_factory=dict)
    status: int = 0
    ends_process: bool = False


def as_json(command: str, status: int, facts: Mapping[str, Any]) -> str:
    """Return one JSON object in ASCII, which any standard output takes."""
    about = {"command": command, "version": version(), "exit_status": status}
    return json.dumps({**about, **_plain(facts)}, indent=2, allow_nan=False)


def _plain(value: Any) -> Any:
    """Return a value for JSON, with null for numbers that are not finite."""
    if isinstance(value, Mapping):
        return {str(name): _plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if hasattr(value, "tolist"):  # of NumPy
        return _plain(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value


def distance_facts(distance: "Distance", spec: object, everywhere: bool = False) -> Facts:
    """Return the facts about a distance that was asked for as `spec`.

    With `everywhere` its accuracy is that on all components, also on those not asked about.
    """
    estimate = distance.error_estimate(range(distance.surface.n_components) if everywhere else None)
    return {"distance": str(spec), "label": distance.label, "unit": distance.unit, **accuracy_facts(estimate)}


def accuracy_facts(estimate: "ErrorEstimate") -> Facts:
    """Return the accuracy as a fraction of the maximum, in words, and from how many vertices it was measured."""
    return {"accuracy": estimate.share, "accuracy_text": estimate.text, "accuracy_sources": estimate.sources}


def panel_facts(shows: object, answer: "Answer") -> Facts:
    """Return the facts about a field that is drawn, with its failure in words, or ""."""
    return {
        "distance": str(shows),
        "label": answer.label,
        "unit": answer.unit,
        "maximum": answer.maximum,
        **accuracy_facts(answer.accuracy),
        "failure": answer.failure,
    }


def facts_of(record: Any, *names: str) -> Facts:
    """Return some attributes of a result of the library, or all fields of a dataclass."""
    return {name: getattr(record, name) for name in names} if names else asdict(record)
