"""Work in a process of its own, so that its peak memory is its own."""

import ctypes
import resource
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from .size import Size

C = ctypes.CDLL(None) if sys.platform == "linux" else None
STATUS, FORGET = Path("/proc/self/status"), Path("/proc/self/clear_refs")


def in_child(function: Callable[..., Any], *arguments: Any) -> Any:
    """What the module-level function returns in a new process; BrokenProcessPool if that ends without an answer."""
    with _process() as process:
        return process.submit(function, *arguments).result()


def in_window_child(size: Size, function: Callable[..., Any], *arguments: Any) -> Any:
    """What the module-level function returns in a new process, or in a common one if `size` is that of a quick run.

    For what draws or asks a session, which is slow to import: nothing of it depends on a process of its own but times.
    """
    return _common().submit(function, *arguments).result() if size.is_quick else in_child(function, *arguments)


def _process() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, mp_context=get_context("spawn"))


_common = cache(_process)


def forget_peak() -> None:
    """Let `peak_memory` count from now, where the system can do that."""
    if FORGET.exists():
        # What was freed would hide what is asked for next.
        if hasattr(C, "malloc_trim"):
            C.malloc_trim(0)
        FORGET.write_text("5")


def peak_memory() -> int:
    """Most bytes this process has had in memory."""
    # A new process' ru_maxrss begins with its parent's, so it is only the second choice.
    if STATUS.exists():
        return 1024 * int(STATUS.read_text().split("VmHWM:")[1].split()[0])
    unit = 1 if sys.platform == "darwin" else 1024
    return unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
