"""Work in a process of its own, so that its peak memory is its own."""

import multiprocessing
import resource
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

STATUS, FORGET = Path("/proc/self/status"), Path("/proc/self/clear_refs")


def in_child(function: Callable[..., Any], *arguments: Any) -> Any:
    """What the module-level function returns in a new process; RuntimeError if that ends without an answer."""
    here, there = multiprocessing.Pipe(duplex=False)
    child = multiprocessing.get_context("spawn").Process(target=_call, args=(there, function, arguments))
    child.start()
    there.close()
    try:
        return here.recv()
    except EOFError:
        raise RuntimeError(f"{function.__name__}{arguments} ended without an answer.") from None
    finally:
        child.join()


def _call(answer: Connection, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    answer.send(function(*arguments))


def forget_peak() -> None:
    """Let `peak_memory` count from now, where the system can do that."""
    if FORGET.exists():
        FORGET.write_text("5")


def peak_memory() -> int:
    """Most bytes this process has had in memory."""
    # A new process' ru_maxrss begins with its parent's, so it is only the second choice.
    if STATUS.exists():
        return 1024 * int(STATUS.read_text().split("VmHWM:")[1].split()[0])
    unit = 1 if sys.platform == "darwin" else 1024
    return unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
