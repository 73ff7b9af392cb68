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

from ..child_process import ANSWER, REPORT, SERVED, ChildProcess, framed, send
from ..errors import SolverError
from ..progress import REPORT_EVERY, Progress, silent
from .worker_threads import is_alone

Result = TypeVar("Result")


def aside(work: Callable[..., Result], *arguments: Any, progress: Progress | None = None) -> Result:
    """work(*arguments, progress=progress) in a process of its own; what the work raises is raised here.

    work: a function of a module; its arguments and what it returns go through pipes as pickles.
    `progress` is called from this thread every 0.1 s with what the work told last; what it raises ends the process.
    Within `without_workers`, and where there is no Python interpreter to start, the work is done here.  SolverError if
    the process dies.
    """
    report = progress or silent
    if is_alone() or not sys.executable or getattr(sys, "frozen", False):
        return work(*arguments, progress=report)
    child = ChildProcess(SERVED, framed(__name__.encode()))
    reports: list[memoryview] = []
    try:
        pieces = _packed((work, arguments))
        length = sum(memoryview(piece).nbytes for piece in pieces)
        answers = child.ask([length.to_bytes(8, sys.byteorder), *pieces], reports.append)
        while True:
            try:
                answer = answers.get(timeout=REPORT_EVERY)
                break
            except Empty:
                if reports:
                    report(*pickle.loads(reports[-1]))
                    del reports[:-1]
                else:
                    report(0.0, "starting a process")
    finally:
        child.end()
    if isinstance(answer, str):
        raise SolverError(f"A computation was lost: {answer}. There may not be enough memory for it.")
    value, error = _unpacked(answer)
    if error is not None:
        raise error
    result: Result = value
    return result


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """What the process does: the work that is asked for."""
    work, arguments = _unpacked(bytearray(requests.read(int.from_bytes(requests.read(8), sys.byteorder))))
    threading.Thread(target=_end_with_parent, daemon=True).start()
    last = -1.0

    def report(fraction: float, text: str) -> None:
        nonlocal last
        if time.monotonic() - last >= REPORT_EVERY / 2:
            last = time.monotonic()
            send(answers, REPORT, [pickle.dumps((fraction, text))])

    outcome: tuple[Any, Exception | None]
    try:
        outcome = work(*arguments, progress=report), None
    except Exception as error:
        outcome = None, error
    send(answers, ANSWER, _packed(outcome))


def _end_with_parent() -> None:
    """Nothing more comes through the pipe but its end, when the parent has ended in whatever way."""
    os.read(0, 1)
    os._exit(1)


def _packed(value: object) -> list[bytes | memoryview]:
    """A pickle whose arrays are not copied: the number of its pieces and their lengths, and the pieces."""
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
