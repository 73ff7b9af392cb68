"""Exact geodesic distance on a mesh (Mitchell, Mount, Papadimitriou 1987; the program is pygeodesic's).

pygeodesic holds the interpreter lock for seconds to minutes and can crash, so it runs in a process of its own,
which can be killed (see `child_process`).
"""

import importlib.util
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import Empty

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray
from ..child_process import ChildProcess, mesh_message
from ..errors import ParameterError, SolverError
from ..progress import REPORT_EVERY, Progress, silent
from ..surface import Surface

CHILD = Path(__file__).with_name("_exact_geodesic_child.py")
UNREACHED = 1e50
"""pygeodesic gives vertices it did not reach a huge finite distance."""


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
        self._child: ChildProcess | None = None
        self._changed, self._waiting = threading.Condition(), deque[object]()

    def distances(self, sources: npt.ArrayLike, progress: Progress | None = None) -> FloatArray:
        """(n,) distances from one vertex, or the nearest of several (k,), in the mesh's length unit; NaN where none was
        found.

        `progress` is called from this thread every 0.1 s with an estimated share; what it raises kills the process,
        and the next call starts another.  Raises VertexError for a bad id, SolverError if the process fails.
        """
        ids = self.surface.check_vertices(sources)
        report = progress or silent
        with self._my_turn(report):
            start = time.perf_counter()
            try:
                if self._child is None:
                    message = mesh_message(self.surface.vertices / self._unit, self.surface.faces)
                    self._child = ChildProcess(CHILD, message)
                answers = self._child.ask(np.append(len(ids), ids).astype(np.int64).tobytes())
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
        lengths = np.frombuffer(answer, np.float64)
        return np.where(lengths < UNREACHED, lengths, np.nan) * self._unit

    def close(self) -> None:
        """End the process now rather than with this object; a later call starts another."""
        child, self._child = self._child, None
        if child is not None:
            child.end()

    @contextmanager
    def _my_turn(self, report: Progress) -> Iterator[None]:
        """In the order of asking: who asks for one source after another is in nobody's way for longer than one."""
        me = object()
        with self._changed:
            self._waiting.append(me)
        try:
            while True:
                with self._changed:
                    if self._changed.wait_for(lambda: self._waiting[0] is me, REPORT_EVERY):
                        break
                report(0.0, "exact geodesic, waiting for another source")
            yield
        finally:
            with self._changed:
                self._waiting.remove(me)
                self._changed.notify_all()
