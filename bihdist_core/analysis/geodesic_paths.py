"""Geodesic paths between places on a surface.

Three ways.  The shortest path, exact (pygeodesic, Mitchell, Mount, Papadimitriou 1987).  The shortest path along edges,
straightened by flipping edges until no part of it can be made shorter (potpourri3d, Sharp and Crane 2020): mostly the
shortest, else by some thousandths longer, and in a hundredth of the time.  The shortest path along edges itself, 4 to
13 % too long in the mean on the samples, on any mesh.  Both libraries hold the interpreter lock, and one of them can
crash: so they run in a process of their own.
"""

import importlib.util
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from queue import Empty

import numpy as np

from ..arrays import FloatArray, IntArray
from ..child_process import ChildProcess, mesh_message
from ..distances.edge_geodesic import EdgeGeodesic
from ..distances.geodesic import EXACT_UP_TO
from ..errors import ParameterError, SolverError
from ..progress import REPORT_EVERY, Progress, part, silent, turn
from ..sources.source import SurfacePoint
from ..sources.splitting import Split
from ..surface import Surface
from .places import Places, component_of, place_words
from .surface_paths import Crossings, Stars, SurfacePath, assembled

METHODS = ("auto", "exact", "straightened", "edges")
LABELS = {
    "exact": "shortest geodesic, exact",
    "straightened": "geodesic, straightened (locally shortest)",
    "edges": "shortest path along edges",
}
CHILD = Path(__file__).with_name("_path_child.py")
NEEDED = {"exact": "pygeodesic", "straightened": "potpourri3d"}
KINDS = {"exact": 1, "straightened": 2}
"""Of requests to the process."""
LEAST_LIMIT = 30.0
"""Seconds after which a path is given up, to which some are added that grow with the mesh: ten times what it takes."""


class GeodesicPaths:
    """Paths on one surface; the process that computes them is started when first needed and ends with this object.

    Usable from several threads, one path at a time.
    """

    def __init__(self, surface: Surface) -> None:
        self.surface = surface
        self._lock = threading.Lock()
        self._child: ChildProcess | None = None
        self._sent: Surface | None = None
        self._components: dict[int, tuple[Surface, IntArray, IntArray]] = {}
        self._stars: tuple[Surface, Stars] | None = None

    def path(
        self, places: Sequence[int | SurfacePoint | str], method: str = "auto", progress: Progress | None = None
    ) -> SurfacePath:
        """The path through two or more vertices or places in faces, or their words, in order.

        `method` and `label` of the path say how each of its parts was made.

        method: "exact"; "straightened"; "edges"; or "auto": the first of these that the mesh allows, exact up to 20,000
        vertices and without degenerate faces, the first two where it is manifold (and, for the second, its faces are
        consistently oriented).

        Raises VertexError for a bad vertex; ParameterError for a bad place or method, fewer than two places, the same
        place twice in a row, places on different components, and "exact" or "straightened" where the mesh does not
        allow it; SolverError where these fail.
        """
        if method not in METHODS:
            raise ParameterError(f"There is no path method {method!r}; choose one of {', '.join(METHODS)}.")
        if len(places) < 2:
            raise ParameterError(f"A path leads through two places or more; {len(places)} were given.")
        found = Places.of(self.surface, places)
        component, ids, faces = self._component(component_of(self.surface, places, found))
        local = Places(np.searchsorted(faces, found.faces), np.searchsorted(ids, found.corners), found.weights)
        split = local.split(component)
        if (split.vertices[1:] == split.vertices[:-1]).any():
            k = int(np.flatnonzero(split.vertices[1:] == split.vertices[:-1])[0])
            same = place_words(places[k])
            raise ParameterError(f"The places {k} and {k + 1} of a path are the same, {same}; leave one out.")
        made = self._made(split, method, progress or silent)
        if len(ids) == len(self.surface.vertices):
            return made
        return SurfacePath(
            made.points,
            faces[made.faces],
            ids[made.corners],
            made.begins,
            made.ends,
            made.knots,
            made.method,
            made.label,
        )

    def close(self) -> None:
        """End the process now rather than with this object; a later path starts another."""
        child, self._child, self._sent = self._child, None, None
        if child is not None:
            child.end()

    def _component(self, index: int) -> tuple[Surface, IntArray, IntArray]:
        """A component, the ids of its vertices here, and those of its faces."""
        if index not in self._components:
            component, ids = self.surface.component(index)
            faces = np.flatnonzero(self.surface.component_of_vertex[self.surface.faces[:, 0]] == index)
            self._components[index] = component, ids, faces
        return self._components[index]

    def _made(self, split: Split, method: str, progress: Progress) -> SurfacePath:
        if method == "auto":
            allowed = split.whole.is_manifold
            # Beside degenerate faces pygeodesic may go on for ever.
            quick = len(split.whole.vertices) <= EXACT_UP_TO and not len(split.surface.degenerate_faces)
            for each in ("exact", "straightened"):
                if allowed and (quick or each != "exact") and not _missing(each):
                    try:
                        return self._by_library(split, each, progress)
                    except SolverError:
                        continue
            return self._along_edges(split)
        if method == "edges":
            return self._along_edges(split)
        if not split.whole.is_manifold:
            raise ParameterError(
                f"{self.surface.name} is not manifold, where there are only paths along edges; take the method edges."
            )
        if missing := _missing(method):
            raise SolverError(f"{missing}; take another method.")
        return self._by_library(split, method, progress)

    def _along_edges(self, split: Split) -> SurfacePath:
        graph, stars = EdgeGeodesic(split.surface), self._stars_of(split.surface)
        parts = []
        for start, stop in zip(split.vertices[:-1], split.vertices[1:], strict=True):
            path = graph.path(int(start), int(stop))
            ends = np.stack([path, path], 1)
            parts.append(Crossings(ends, np.zeros(len(path)), stars.common(ends)))
        return assembled(split, parts, "edges", LABELS["edges"])

    def _by_library(self, split: Split, method: str, progress: Progress) -> SurfacePath:
        stars, parts = self._stars_of(split.surface), []
        pairs = list(zip(split.vertices[:-1].tolist(), split.vertices[1:].tolist(), strict=True))
        for k, (start, stop) in enumerate(pairs):
            report = part(progress, k / len(pairs), (k + 1) / len(pairs))
            points = self._asked(split.surface, KINDS[method], start, stop, report)
            parts.append(stars.followed(points, start, stop))
        return assembled(split, parts, method, LABELS[method])

    def _stars_of(self, surface: Surface) -> Stars:
        if self._stars is None or self._stars[0] is not surface:
            self._stars = surface, Stars(surface)
        return self._stars[1]

    def _asked(self, surface: Surface, kind: int, start: int, stop: int, report: Progress) -> FloatArray:
        """(k, 3) the points of a path between two vertices."""
        # pygeodesic has absolute tolerances, so it gets edges near length 1; a power of two changes no digit.
        unit = 2.0 ** np.round(np.log2(surface.mean_edge_length or 1.0))
        with turn(self._lock, report, "path, waiting for another"):
            try:
                if self._child is None:
                    self._child = ChildProcess(CHILD, b"")
                if self._sent is not surface:
                    self._answer(_words(0) + mesh_message(surface.vertices / unit, surface.faces), report)
                    self._sent = surface
                return np.frombuffer(self._answer(_words(kind, start, stop), report)).reshape(-1, 3) * unit
            except BaseException:
                # Also KeyboardInterrupt: a process whose answer nobody reads would answer the next question wrongly.
                self.close()
                raise

    def _answer(self, request: bytes, report: Progress) -> memoryview:
        child = self._child
        if child is None:
            raise SolverError("The process that computes paths has ended.")
        answers, begun = child.ask(request), time.perf_counter()
        while True:
            try:
                answer = answers.get(timeout=REPORT_EVERY)
                break
            except Empty:
                seconds = time.perf_counter() - begun
                if seconds > LEAST_LIMIT + (len(self.surface.vertices) / 5_000) ** 2:
                    raise SolverError(
                        f"A path on {self.surface.name} was given up after {seconds:.0f} s; take another method."
                    ) from None
                report(0.5, f"path, {seconds:.0f} s")
        if isinstance(answer, str):
            raise SolverError(f"A path on {self.surface.name} could not be computed: {answer}.")
        return answer


def _missing(method: str) -> str:
    """What a method that needs a library lacks, in words."""
    if not sys.executable or getattr(sys, "frozen", False):
        return "There is no Python interpreter to compute such paths"
    if importlib.util.find_spec(NEEDED[method]) is None:
        return f"Such paths need the package {NEEDED[method]}"
    return ""


def _words(*numbers: int) -> bytes:
    return b"".join(int(number).to_bytes(8, sys.byteorder) for number in numbers)
