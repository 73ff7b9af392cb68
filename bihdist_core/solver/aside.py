"""Work with long steps that nobody can ask to stop, such as LAPACK's on large matrices, in a process that can be ended.

The process does what it is told once, and ends with the work, with what the progress raises, or with its parent.
"""

import os
import pickle
import sys
import threading
import time
from collections.abc import Callable
from queue import Empty
from typing import Any, BinaryIO, TypeVar

from ..child_process import ANSWER, ChildProcess, read_request, send, send_report
from ..errors import SolverError
from ..progress import REPORT_EVERY_S, Progress, silent
from .worker_threads import is_alone

Result = TypeVar("Result")


def aside(work: Callable[..., Result], *arguments: Any, progress: Progress | None = None) -> Result:
    """Run ``work(*arguments, progress=progress)`` in a process of its own; what the work raises is raised here.

    `work` is a function of a module; its arguments and its result go through pipes as pickles.
    `progress` is called from this thread every 0.1 s with what the work told last; what it raises ends the process.
    Within `without_workers`, and where there is no Python interpreter to start, the work is done here.  SolverError if
    the process dies.
    """
    report = progress or silent
    if is_alone() or not sys.executable or getattr(sys, "frozen", False):
        return work(*arguments, progress=report)
    child = ChildProcess(__name__)
    reports: list[tuple[float, str]] = []
    try:
        answers = child.ask(_packed((work, arguments)), lambda *told: reports.append(told))
        while True:
            try:
                answer = answers.get(timeout=REPORT_EVERY_S)
                break
            except Empty:
                if reports:
                    report(*reports[-1])
                    del reports[:-1]
                else:
                    report(0.0, "starting a process")
    finally:
        child.end()
    if isinstance(answer, str):
        raise SolverError(f"A computation was lost: {answer}. There may not be enough memory for it.")
    value, error = _unpacked(answer)
    try:
        if error is not None:
            raise error
    finally:
        # The error's traceback refers to this frame, and so to the arguments.
        del error
    result: Result = value
    return result


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """Do the work that is asked for, in the process."""
    work, arguments = _unpacked(bytearray(read_request(requests)))
    threading.Thread(target=_end_with_parent, daemon=True).start()
    last = -1.0

    def report(fraction: float, text: str) -> None:
        nonlocal last
        if time.monotonic() - last >= REPORT_EVERY_S / 2:
            last = time.monotonic()
            send_report(answers, fraction, text)

    outcome: tuple[Any, Exception | None]
    try:
        outcome = work(*arguments, progress=report), None
    except Exception as error:
        outcome = None, error
    send(answers, ANSWER, _packed(outcome))


def _end_with_parent() -> None:
    """Exit when the pipe ends, as it does when the parent has ended in whatever way."""
    os.read(0, 1)
    os._exit(1)


def _packed(value: object) -> list[bytes | memoryview]:
    """Return a pickle whose arrays are not copied: the number of its pieces and their lengths, and the pieces."""
    arrays: list[pickle.PickleBuffer] = []
    head = pickle.dumps(value, 5, buffer_callback=arrays.append)
    pieces: list[bytes | memoryview] = [head, *(array.raw() for array in arrays)]
    lengths = [len(pieces), *(memoryview(piece).nbytes for piece in pieces)]
    return [b"".join(length.to_bytes(8, sys.byteorder) for length in lengths), *pieces]


def _unpacked(content: bytearray | memoryview) -> Any:
    whole = memoryview(content)
    count = int.from_bytes(whole[:8], sys.byteorder)
    lengths = [int.from_bytes(whole[8 * k + 8 : 8 * k + 16], sys.byteorder) for k in range(count)]
    pieces, start = [], 8 + 8 * count
    for length in lengths:
        pieces.append(whole[start : start + length])
        start += length
    return pickle.loads(pieces[0], buffers=pieces[1:])
