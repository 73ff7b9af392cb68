"""One BLAS thread inside our kernels.

They are many small products: BLAS' own threads made them 5 to 15 times slower on busy cores.  Parallelism comes
from our own threads over independent blocks instead.  The setting acts on the whole process, so it is counted:
the first kernel to enter limits it, the last to leave restores what was there before.  SciPy brings a BLAS of its own,
which is loaded when it is first needed, also between two kernels or inside one.

Since its version 3.8 threadpoolctl lets one thread alone change OpenBLAS, and silently ignores all others as long as
that thread lives; so it is told each time that no thread has that right.
"""

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import threadpoolctl

LOADERS = ("numpy", "scipy.linalg", "scipy.linalg._fblas", "scipy.linalg.cython_blas", "scipy.sparse.linalg")
"""Modules that load a BLAS."""

_lock = threading.Lock()
_inside = 0
_controller: threadpoolctl.ThreadpoolController | None = None
_loaded: frozenset[str] = frozenset()
_limits: list[Any] = []


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Limit BLAS to one thread while any caller is inside; usable from several threads at once."""
    global _inside, _controller, _loaded
    with _lock:
        _inside += 1
        loaded = frozenset(name for name in LOADERS if name in sys.modules)
        controller = _controller if loaded == _loaded else None
        if _inside == 1 or not controller:
            # Finding the loaded libraries costs milliseconds, so it is done once for each that may be there.
            _controller, _loaded = controller or threadpoolctl.ThreadpoolController(), loaded
            _let_any_thread()
            _limits.append(_controller.limit(limits=1, user_api="blas"))
    try:
        yield
    finally:
        with _lock:
            _inside -= 1
            while not _inside and _limits:
                _let_any_thread()
                _limits.pop().restore_original_limits()


def _let_any_thread() -> None:
    if (clear := getattr(threadpoolctl.OpenBLASController, "clear_controlling_thread", None)) is not None:
        clear(force=True)
