"""Exact geodesic distance on a mesh (Mitchell, Mount, Papadimitriou 1987; the program is pygeodesic's).

pygeodesic holds the interpreter lock for seconds to minutes and can crash, so it runs in a process of its own,
which can be killed.  That process is a plain script with pipes: unlike multiprocessing's "spawn" it never imports
the user's main program again, so scripts need no `if __name__ == "__main__"`.
"""

import importlib.util
import io
import os
import subprocess
import sys
import threading
import time
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import cast

import numpy as np

from ..errors import ParameterError, SolverError
from ..progress import Progress, silent
from ..surface import Surface

CHILD = Path(__file__).with_name("_exact_geodesic_child.py")
UNREACHED = 1e50
"""pygeodesic gives vertices it did not reach a huge finite distance."""
REPORT_EVERY = 0.1
"""Seconds between two progress reports, hence until a cancellation acts."""


class ExactGeodesic:
    """Exact geodesic distances on one connected, manifold surface without unreferenced vertices.

    The first call starts the process and sends it the mesh; it then serves every later source and ends with this
    object.  Usable from several threads, one source at a time.  The process takes some 3 kB a vertex.

    Raises ParameterError if the surface is not manifold, not connected or has unreferenced vertices; SolverError if
    there is no pygeodesic or no Python interpreter to run it.
    """

    def __init__(self, surface: Surface) -> None:
        if surface.component_count != 1 or surface.unreferenced_count:
            raise ParameterError(f"{surface.name} is not one connected piece; ask for exact distances on a component.")
        if not surface.is_manifold:
            raise ParameterError(
                f"{surface.name} is not manifold, where exact geodesic distance is not computed; use the heat method."
            )
        if importlib.util.find_spec("pygeodesic") is None:
            raise SolverError(
                "Exact geodesic distance needs the package pygeodesic; install it or use the heat method."
            )
        if not sys.executable or getattr(sys, "frozen", False):
            raise SolverError("There is no Python interpreter for exact geodesic distance; use the heat method.")
        self.surface = surface
        # pygeodesic has absolute tolerances, so it gets edges near length 1; a power of two changes no digit.
        self._unit = 2.0 ** np.round(np.log2(surface.mean_edge_length or 1.0))
        # 0.6 s for 16,000 vertices and 31 s for 112,000: about the square.  Replaced by what the last source took.
        self._expected_seconds = 0.3 + (len(surface.vertices) / 20_000) ** 2
        self._child: _Child | None = None
        self._lock = threading.Lock()

    def distances(self, source: int, progress: Progress | None = None) -> np.ndarray:
        """(n,) distances from one vertex, in the mesh's length unit; NaN where none was found.

        `progress` is called from this thread every 0.1 s with an estimated share; what it raises kills the process,
        and the next call starts another.  Raises VertexError for a bad id, SolverError if the process fails.
        """
        source = self.surface.check_vertex(source)
        report = progress or silent
        with self._my_turn(report):
            start = time.perf_counter()
            try:
                if self._child is None:
                    self._child = _Child(self.surface.vertices / self._unit, self.surface.faces)
                answers = self._child.ask(source)
                while True:
                    try:
                        answer = answers.get(timeout=REPORT_EVERY)
                        break
                    except Empty:
                        seconds = time.perf_counter() - start
                        report(min(seconds / self._expected_seconds, 0.95), f"exact geodesic, {seconds:.0f} s")
                if isinstance(answer, str):
                    raise SolverError(f"Exact geodesic distance on {self.surface.name} failed: {answer}.")
            except BaseException:
                # Also KeyboardInterrupt: a process whose answer nobody reads would answer the next question wrongly.
                self.close()
                raise
            self._expected_seconds = time.perf_counter() - start
        return np.where(answer < UNREACHED, answer, np.nan) * self._unit

    def close(self) -> None:
        """End the process now rather than with this object; a later call starts another."""
        child, self._child = self._child, None
        if child is not None:
            child.end()

    @contextmanager
    def _my_turn(self, report: Progress) -> Iterator[None]:
        while not self._lock.acquire(timeout=REPORT_EVERY):
            report(0.0, "exact geodesic, waiting for another source")
        try:
            yield
        finally:
            self._lock.release()


class _Child:
    """The process, and the pipes to and from it."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray) -> None:
        self._count = len(vertices)
        # Sent with the first source, by its thread: a pipe holds 64 kB and the process reads once it has started.
        self._unsent = b"".join(
            a.tobytes() for a in (np.array([len(vertices), len(faces)]), vertices, faces.astype(np.int32))
        )
        self.process = subprocess.Popen(
            [sys.executable, str(CHILD), *(p for p in sys.path if isinstance(p, str))],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # Unbuffered files have no lock that a thread could still hold when the interpreter exits.
            bufsize=0,
            # Its numpy needs no BLAS threads, which cost start-up time and memory.
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"},
            # No console window flashes up on Windows.
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._readers: list[threading.Thread] = []
        self.end = weakref.finalize(self, _end, self.process, self._readers)

    def ask(self, source: int) -> "SimpleQueue[np.ndarray | str]":
        """A queue that will hold (n,) distances, or a text that says why there are none."""
        answers: SimpleQueue[np.ndarray | str] = SimpleQueue()
        message, self._unsent = self._unsent + int(source).to_bytes(8, sys.byteorder), b""
        # A thread per source, as pipes cannot be waited for with a time limit on Windows; a daemon, as it must not
        # keep the interpreter alive.  It holds the process, not this object, which may be collected meanwhile.
        reader = threading.Thread(target=_converse, args=(self.process, message, self._count, answers), daemon=True)
        self._readers[:] = [reader]
        reader.start()
        return answers


def _converse(process: subprocess.Popen, message: bytes, count: int, answers: "SimpleQueue[np.ndarray | str]") -> None:
    requests, replies = cast(io.FileIO, process.stdin), cast(io.FileIO, process.stdout)
    try:
        rest = memoryview(message)
        while len(rest):
            rest = rest[requests.write(rest) :]
        code = int.from_bytes(_read(replies, 8), sys.byteorder)
        if code:
            answers.put(_read(replies, code).decode())
        else:
            answers.put(np.frombuffer(_read(replies, 8 * count), np.float64))
    except (OSError, ValueError, EOFError):
        answers.put("the process that computes it died")


def _read(pipe: io.FileIO, count: int) -> bytes:
    content = bytearray(count)
    rest = memoryview(content)
    while len(rest):
        got = pipe.readinto(rest)
        if not got:
            raise EOFError
        rest = rest[got:]
    return bytes(content)


def _end(process: subprocess.Popen, readers: list[threading.Thread]) -> None:
    """Kill, and wait so that no zombie is left; a killed process takes no time to end, nor does its reader."""
    process.kill()
    process.wait()
    for reader in readers:
        reader.join(timeout=1)
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            pipe.close()
