"""What this machine can do at most, measured where the figures are compared with it."""

import os
import platform
import statistics
import threading
import time
from collections.abc import Callable
from functools import cache

import numpy as np

from bihdist_core.solver.blas import one_blas_thread

CORES = 2
"""Our kernels use two threads."""


def describe() -> str:
    """System, cores and load, in words."""
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    return f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores{load}, Python {platform.python_version()}"


def bandwidth(megabytes: int = 128, rounds: int = 7) -> float:
    """Bytes per second that two threads read and write together, copying arrays too large for the caches."""
    pairs = [(np.ones(megabytes << 17), np.empty(megabytes << 17)) for _ in range(CORES)]
    seconds = _together([lambda pair=pair: np.copyto(pair[1], pair[0]) for pair in pairs], rounds)
    return 2 * CORES * (megabytes << 20) / seconds


def matmul_rate(size: int = 512) -> float:
    """Floating-point operations per second of matrix products on two threads."""
    a = np.random.default_rng(0).random((CORES, size, size))
    out = np.empty_like(a)
    with one_blas_thread():
        seconds = _together(
            [lambda k=k: [np.matmul(a[k], a[k], out=out[k]) for _ in range(4)] for k in range(CORES)], 7
        )
    return CORES * 4 * 2 * size**3 / seconds


@cache
def limits() -> tuple[float, float]:
    """Bytes and floating-point operations per second, at most."""
    return bandwidth(), matmul_rate()


def _together(works: list[Callable[[], object]], rounds: int) -> float:
    """Median seconds for all of them side by side."""
    times = []
    for _ in range(rounds):
        threads = [threading.Thread(target=work) for work in works]
        start = time.perf_counter()
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        times.append(time.perf_counter() - start)
    return statistics.median(times)
