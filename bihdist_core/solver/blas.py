"""One BLAS thread inside our kernels.

They are many small products: BLAS' own threads made them 5 to 15 times slower on busy cores.  Parallelism comes
from our own threads over independent blocks instead.  The setting acts on the whole process, so it is counted:
the first kernel to enter limits it, the last to leave restores what was there before.
"""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from threadpoolctl import ThreadpoolController

_lock = threading.Lock()
_inside = 0
_controller: ThreadpoolController | None = None
_limit: Any = None


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Limit BLAS to one thread while any caller is inside; usable from several threads at once."""
    global _inside, _limit, _controller
    with _lock:
        _inside += 1
        if _inside == 1:
            # Finding the loaded libraries costs milliseconds, so it is done once.
            _controller = _controller or ThreadpoolController()
            _limit = _controller.limit(limits=1, user_api="blas")
    try:
        yield
    finally:
        with _lock:
            _inside -= 1
            if _inside == 0:
                _limit.restore_original_limits()
