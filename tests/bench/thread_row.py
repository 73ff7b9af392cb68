"""Row 26: the exact set-up on one, two and four threads."""

from collections.abc import Iterator
from contextlib import contextmanager

from bihdist_core.solver import worker_threads
from bihdist_core.solver.blas import one_blas_thread

from .case import Case, main_case
from .size import Size
from .table import Line, compared
from .timing import alternate

BOUNDS = {1: 1.2, 2: 0.75, 4: 0.5}
CORES = worker_threads.WORKERS


def threads(size: Size) -> Iterator[Line]:
    case = main_case(size)
    _set_up(case, 1)  # the first is slower
    for count, bound in BOUNDS.items():
        work = f"exact set-up on {count} of our threads, {case.count}"
        if count > CORES:
            yield Line(26, work, bound=bound, note=f"skipped: {CORES} cores")
            continue
        result = alternate(lambda n=count: _set_up(case, n), lambda: _set_up(case, 1), size.rounds)
        yield compared(26, work, result, bound=bound, note="peer: our own on one thread")


def _set_up(case: Case, count: int) -> None:
    with one_blas_thread(), _workers(count):
        case.set_up()


@contextmanager
def _workers(count: int) -> Iterator[None]:
    """Within it there are so many worker threads; a single one is the caller's."""
    before = worker_threads.WORKERS
    worker_threads.WORKERS = count
    worker_threads._pool.cache_clear()
    try:
        if count > 1:
            yield
        else:
            with worker_threads.without_workers():
                yield
    finally:
        worker_threads._pool().shutdown()
        worker_threads._pool.cache_clear()
        worker_threads.WORKERS = before
