"""The engines that run tasks: processes on this computer, or a Dask cluster, which also computes rows of all pairs."""

import concurrent.futures
import logging
import multiprocessing
import os
import signal
import sys
import threading
import time
import warnings
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from types import ModuleType
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from bihdist_core.analysis.all_pairs import Rows, fill_rows
from bihdist_core.arrays import AnyArray, IntArray
from bihdist_core.distances.distance import Distance
from bihdist_core.errors import BihdistError, ParameterError, PlainSolverWarning, SolverError
from bihdist_core.machine_memory import available
from bihdist_core.solver.blas import one_blas_thread
from bihdist_core.solver.worker_threads import without_workers

from ..version import install_command, version
from .execution import run_task
from .memory import share
from .task import Report, Task, failed_report, refused_report

if TYPE_CHECKING:
    from distributed import Client, Future

USABLE_MEMORY = 0.9
"""The fraction of the memory free at the beginning that tasks may take."""
MAX_TRIES = 2
"""Attempts at a task whose process ended, before it is given up."""


class Engine(Protocol):
    def submit(self, task: Task) -> None:
        """Run a task once there is room."""

    def reports(self) -> Iterator[Report]:
        """Yield the reports of all tasks as they end; more may be submitted meanwhile."""

    def close(self) -> None:
        """End what is under way."""


class Processes:
    """Processes on this computer, each running one task at a time.

    A process that ends by itself, killed for its memory or by a fault in a library, takes all others of its pool
    along. Their tasks are run again one at a time, so that it is known which of them it was.

    Each may take its share of the memory. A task that needs more comes back, and starts when there is room for it.
    """

    def __init__(self, workers: int, memory: int | None = None) -> None:
        """Let `workers` processes share so many bytes of memory, most of what is free if None."""
        self._workers = workers
        self._memory = memory or int(USABLE_MEMORY * available())
        self._waiting: deque[Task] = deque()
        self._alone: deque[Task] = deque()
        self._under_way: dict[concurrent.futures.Future[Report], Task] = {}
        self._tries: Counter[Task] = Counter()
        self._pool: concurrent.futures.ProcessPoolExecutor | None = None

    def submit(self, task: Task) -> None:
        """Let the task be done by one of the processes."""
        self._waiting.append(task)

    def reports(self) -> Iterator[Report]:
        """Yield reports as tasks end, in any order; tasks lost with a process are run again."""
        while self._waiting or self._alone or self._under_way:
            try:
                self._fill()
            except BrokenProcessPool:
                # A process that had nothing to do has ended; a new pool takes the first task in any case.
                yield from self._broken()
                continue
            ended, _ = concurrent.futures.wait(self._under_way, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in ended:
                # A broken pool ends several at once, and all of them are dealt with at the first.
                if future in self._under_way:
                    yield from self._report(future)

    def _fill(self) -> None:
        if self._pool is None:
            self._pool = concurrent.futures.ProcessPoolExecutor(
                self._workers,
                multiprocessing.get_context("spawn"),
                initializer=_begin,
                initargs=(self._memory // self._workers,),
            )
        if self._alone:
            if not self._under_way:
                self._start(self._alone[0])
                self._alone.popleft()
            return
        while len(self._under_way) < self._workers:
            room = self._memory - sum(map(self._bytes, self._under_way.values()))
            # In order, but for what has no room yet; alone anything begins that is not larger than all.
            fitting = (task for task in self._waiting if self._bytes(task) <= room)
            task = next(fitting, None)
            if task is None:
                break
            self._start(task)
            self._waiting.remove(task)

    def _bytes(self, task: Task) -> int:
        return task.needs or self._memory // self._workers

    def _start(self, task: Task) -> None:
        """Start a task; BrokenProcessPool if a process has ended since the last report."""
        assert self._pool is not None
        with _no_program():
            self._under_way[self._pool.submit(run_task, task)] = task

    def _report(self, future: concurrent.futures.Future[Report]) -> Iterator[Report]:
        try:
            report = future.result()
        except BrokenProcessPool:
            yield from self._broken()
            return
        task = self._under_way.pop(future)
        if not report.needs:
            yield report
        elif report.needs <= self._memory:
            self._waiting.appendleft(replace(task, needs=report.needs))
        else:
            yield refused_report(report, self._memory)

    def _broken(self) -> Iterator[Report]:
        suspects, self._under_way = list(self._under_way.values()), {}
        assert self._pool is not None
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._pool = None
        was_alone = len(suspects) == 1
        for task in suspects:
            self._tries[task] += was_alone
            if self._tries[task] >= MAX_TRIES:
                yield failed_report(task, "Its process ended twice; perhaps there was too little memory.")
            else:
                self._alone.append(task)

    def close(self) -> None:
        """End the processes at once."""
        if self._pool is not None:
            for process in list((getattr(self._pool, "_processes", None) or {}).values()):
                process.kill()
            self._pool.shutdown(wait=False, cancel_futures=True)
            self._pool = None


@contextmanager
def _no_program() -> Iterator[None]:
    """Let processes that start now import what their tasks need only, and not the program that runs.

    The method "spawn" would run it again in each of them; scripts need no `if __name__ == "__main__"`.
    """
    program = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = program


def _begin(memory: int) -> None:
    """Set up a new process: its share of the memory, one BLAS thread, and an end when its parent ends."""
    # A terminal's Ctrl-C reaches all processes; the one that has begun this one ends it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    share(memory)
    # The one that has begun it says so, once.
    warnings.simplefilter("ignore", PlainSolverWarning)
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    parent = multiprocessing.parent_process()

    def leave() -> None:
        if parent is not None:
            parent.join()
        os._exit(1)

    threading.Thread(target=leave, daemon=True).start()


SCHEDULER_WAIT_S = 60.0
"""Seconds in which a scheduler that has just been started writes its file."""


def _wait_for(file: str, say: Callable[[str], None]) -> None:
    """Wait for a scheduler's file; ParameterError if it does not appear."""
    end = time.monotonic() + SCHEDULER_WAIT_S
    if not os.path.exists(file):
        say(f"Waiting for the scheduler's file {file}, at most {SCHEDULER_WAIT_S:.0f} seconds.")
    while not os.path.exists(file):
        if time.monotonic() > end:
            raise ParameterError(f"No scheduler has written {file}; start it with --scheduler-file {file}.")
        time.sleep(0.2)


def _connected(where: str, say: Callable[[str], None]) -> "Client":
    """Connect to a Dask cluster's address (tcp://…) or its scheduler's file (….json), which is waited for after a
    sentence by `say`.

    Raises ParameterError if it cannot be reached or has another version, and if Dask is missing.
    """
    try:
        from distributed import Client
    except ImportError:
        raise ParameterError(f"--dask needs the package distributed: {install_command('distributed')}") from None
    # It would print where it was for each connection that is closed.
    logging.getLogger("distributed.batched").setLevel(logging.WARNING)
    if where.endswith(".json"):
        _wait_for(where, say)
    try:
        options: dict[str, Any] = {"scheduler_file": where} if where.endswith(".json") else {"address": where}
        client = Client(**options, timeout="20s", set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise ParameterError(f"There is no Dask scheduler at {where}: {error}") from None
    try:
        there = client.run_on_scheduler(version)
    except Exception:  # whatever it cannot unpickle
        there = ""
    if there != version():
        client.close()
        has = f"has version {there}" if there else "cannot import it"
        raise ParameterError(
            f"Scheduler and workers need the same version of bihdist as this one, {version()}; the scheduler at "
            f"{where} {has}."
        )
    return client


class Cluster:
    """A Dask cluster that `distributed.Client` reaches; scheduling, retries and memory are Dask's."""

    def __init__(self, where: str, say: Callable[[str], None]) -> None:
        """Connect as `_connected` does."""
        self._client = _connected(where, say)
        from distributed import as_completed

        self._ended = as_completed(loop=self._client.loop)
        self._under_way: dict[str, Task] = {}
        self._tries: Counter[Task] = Counter()
        self._lost = ""

    def submit(self, task: Task) -> None:
        """Let the task be done by a worker of the cluster."""
        self._tries[task] += 1
        key = f"bihdist-{task.words}-{task.digest}-{self._tries[task]}"
        # Also what is never begun has a report: that the cluster was lost.
        self._under_way[key] = task
        if not self._lost:
            try:
                self._begin(task, key)
            except Exception as error:
                self._lose(error)

    def _begin(self, task: Task, key: str) -> None:
        _check_running(self._client)
        large = [address for address, limit in self._limits().items() if limit >= task.needs] if task.needs else None
        # Where none of those workers is left, others take it and send it back.
        future = self._client.submit(
            run_task, task, key=key, pure=False, workers=large or None, allow_other_workers=bool(large)
        )
        self._ended.add(future)

    def reports(self) -> Iterator[Report]:
        """Yield reports as tasks end, in any order; tasks of a lost worker are run again."""
        while self._under_way:
            report = None
            if not self._lost:
                # Without its scheduler Dask has many errors, at any of its calls.
                try:
                    report = self._ended_next()
                except Exception as error:
                    self._lose(error)
            if self._lost:
                _, task = self._under_way.popitem()
                report = failed_report(task, self._lost)
            if report is not None:
                yield report

    def _ended_next(self) -> Report | None:
        """Return the report of the next task that ends, None if it is run again where there is more memory.

        Raises Dask's errors if the cluster is lost; then the task is still under way.
        """
        future = next(self._ended)
        task = self._under_way[future.key]
        # None for a task that was cancelled, whose result raises that.
        error = future.exception()
        if error is not None:
            report = failed_report(task, f"The cluster gave up on it: {_in_words(error)}")
        else:
            report = future.result()
            most = max(self._limits().values(), default=0) if report.needs else 0
            if report.needs > most:
                report = refused_report(report, most)
        del self._under_way[future.key]
        if report.needs:
            self.submit(replace(task, needs=report.needs))
            return None
        return report

    def _lose(self, error: Exception) -> None:
        self._lost = f"The connection to the cluster was lost: {_reason(error)}. Run the same command to resume."

    def _limits(self) -> dict[str, int]:
        """Return the memory of each worker; without a limit it is more than anything needs."""
        workers = self._client.scheduler_info(n_workers=-1)["workers"]
        return {address: int(about["memory_limit"] or 1 << 62) for address, about in workers.items()}

    def close(self) -> None:
        """Disconnect from the cluster, which keeps running."""
        self._client.close()


def _in_words(error: BaseException) -> str:
    """Return an error in one line."""
    return f"{type(error).__name__}: {' '.join(str(error).split())}"


def _reason(error: BaseException) -> str:
    """Return in a line why a cluster was lost, and let its client be closed in silence."""
    # It would print where it was when it is closed while it seeks its scheduler.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    # Of a task that is cancelled only the reason, which all of them have.
    return getattr(error, "reason", "") or _in_words(error)


def _check_running(client: "Client") -> None:
    """Raise ConnectionError while a client seeks a scheduler that is gone: it takes tasks and says nothing more of
    them."""
    if client.status != "running":
        raise ConnectionError("the scheduler has stopped")


# ---------------------------------------------------------------------- all pairs
BLOCKS_AHEAD = 2
"""Blocks of rows for each thread of a cluster that are computed, or wait, while one is written."""


@contextmanager
def rows_on_cluster(where: str, say: Callable[[str], None], distance: Distance, dtype: str) -> Iterator[Rows]:
    """Yield what `write_all_pairs` may call to let a Dask cluster compute blocks of rows.

    It raises the distance's own errors, and BihdistError if the cluster fails; see `_connected` for the rest.
    """
    client = _connected(where, say)
    try:
        yield partial(_rows, client, distance, dtype)
    finally:
        client.close()


def _rows(client: "Client", distance: Distance, dtype: str, blocks: Sequence[IntArray]) -> Iterator[AnyArray]:
    waiting, under_way = deque(blocks), deque["Future[AnyArray]"]()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # that a surface is large
            # As a task, it is there again where a worker was lost; scattered, it would not be.
            there = client.submit(_same, distance, pure=False)
        while waiting or under_way:
            _check_running(client)
            room = BLOCKS_AHEAD * max(1, sum(client.nthreads().values()))
            while waiting and len(under_way) < room:
                ids = waiting.popleft()
                under_way.append(client.submit(_rows_there, there, distance.label, ids, dtype, pure=False))
            yield under_way.popleft().result()
    except BihdistError:
        raise
    except Exception as error:  # without its scheduler Dask has many, at any of its calls
        raise BihdistError(f"The cluster has not computed the rows: {_reason(error)}.") from error


def _same(distance: Distance) -> Distance:
    return distance


def _rows_there(distance: Distance, label: str, ids: IntArray, dtype: str) -> AnyArray:
    """Return the rows of some vertices; SolverError if there they are computed by another method."""
    rows = np.empty((len(ids), len(distance.surface.vertices)), dtype)
    with one_blas_thread(), without_workers():
        fill_rows(rows, distance, ids)
    if distance.label != label:
        raise SolverError(f"A worker has given up {label} for {distance.label}; name that method.")
    return rows
