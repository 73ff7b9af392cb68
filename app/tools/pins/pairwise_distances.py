"""Distances among a few vertices and places in faces, by any of the distances, computed in the background and kept.

Asked on one thread, that of `post`; what was known before is not computed again when some come or go.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from bihdist_core import BihdistError, Cancelled
from bihdist_core.arrays import FloatArray, IntArray
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.distances.distance import Distance
from bihdist_core.distances.distance_types import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...session.latest_request_worker import LatestRequestWorker
from ...session.loaded_mesh import LoadedMesh

SOURCES_PER_BLOCK = 8
"""Sources between two places where the work can be given up."""


@dataclass(frozen=True, eq=False)
class _Known:
    """The distances (k, k) among k places, and their unit."""

    places: tuple[Source, ...]
    matrix: FloatArray
    unit: str


@dataclass(frozen=True)
class _Request:
    loaded: LoadedMesh
    areas: str
    specs: tuple[Spec, ...]
    places: tuple[Source, ...]

    def has_operators_of(self, other: "_Request | None") -> bool:
        """Return whether another request is for the same surface and vertex areas."""
        return other is not None and (self.loaded, self.areas) == (other.loaded, other.areas)


class PairwiseDistances:
    """`changed()` is called, by `post`, when what is known of the latest request, or `progress`, is something new."""

    def __init__(self, post: Callable[[Callable[[], None]], None], changed: Callable[[], None]) -> None:
        self._post, self._changed = post, changed
        self._known: dict[Spec, _Known] = {}
        self._failures: dict[Spec, str] = {}
        self._asked: _Request | None = None
        self.progress: tuple[float, str] | None = None
        self._worker: LatestRequestWorker[_Request] = LatestRequestWorker("among", self._work, self._report, self._fail)

    def ask(self, loaded: LoadedMesh, areas: str, specs: Sequence[Spec], places: Sequence[Source]) -> None:
        """Ask for the distances among these places only, by the first of the specs first."""
        old, asked = self._asked, _Request(loaded, areas, tuple(dict.fromkeys(specs)), tuple(places))
        self._asked = asked
        if not asked.has_operators_of(old):
            self._known, self._failures = {}, {}
        missing = [spec for spec in asked.specs if spec not in self._failures and self.matrix(spec) is None]
        if not missing or len(places) < 2:
            self._worker.submit(None)
        elif old != asked or self.progress is None:
            self._worker.submit(asked)

    def matrix(self, spec: Spec) -> FloatArray | None:
        """Return the distances (k, k) among the k places, NaN between components; None as long as they are not
        known."""
        known = self._known.get(spec)
        if known is None or self._asked is None:
            return None
        rows = _rows_in(known.places, self._asked.places)
        return None if (rows < 0).any() else known.matrix[np.ix_(rows, rows)]

    def unit(self, spec: Spec) -> str:
        """Return the unit of the distances, "" as long as none are known."""
        known = self._known.get(spec)
        return "" if known is None else known.unit

    def failure(self, spec: Spec) -> str:
        """Return the reason why there are no distances, in a sentence, "" for none."""
        return self._failures.get(spec, "")

    def close(self) -> None:
        """Stop the work, and the thread."""
        self._worker.close()

    # ------------------------------------------------------------------ in the background
    def _work(self, request: _Request, worker: LatestRequestWorker[_Request]) -> None:
        progress = worker.progress(lambda latest: latest == request)
        for k, spec in enumerate(request.specs):
            known = self._known.get(spec) if request.has_operators_of(self._asked) else None
            share = part(progress, k / len(request.specs), (k + 1) / len(request.specs))
            try:
                distance = request.loaded.distances(request.areas).get(spec, part(share, 0, 0.5))
                matrix = distances_among(distance, request.places, known, part(share, 0.5, 1))
            except Cancelled:
                raise
            except (BihdistError, MemoryError) as error:
                self._post(partial(self._refuse, request, spec, error))
            else:
                self._post(partial(self._take, request, spec, _Known(request.places, matrix, distance.unit)))

    def _take(self, request: _Request, spec: Spec, found: _Known) -> None:
        if request.has_operators_of(self._asked):
            self._known[spec] = found
            self._changed()

    def _refuse(self, request: _Request, spec: Spec, error: Exception) -> None:
        if request.has_operators_of(self._asked):
            self._failures[spec] = failure_in_words(error)
            self._changed()

    def _fail(self, request: _Request, error: Exception) -> None:
        for spec in request.specs:
            self._post(partial(self._refuse, request, spec, error))

    def _report(self, fraction: float | None, text: str) -> None:
        def note() -> None:
            self.progress = None if fraction is None else (fraction, text)
            self._changed()

        self._post(note)


def distances_among(
    distance: Distance, places: Sequence[Source], known: _Known | None, progress: Progress
) -> FloatArray:
    """Return the distances (k, k) among places, without computing again what is known."""
    count = len(places)
    matrix, rows = np.full((count, count), np.nan), np.full(count, -1)
    if known is not None:
        rows = _rows_in(known.places, places)
        old = np.flatnonzero(rows >= 0)
        matrix[np.ix_(old, old)] = known.matrix[np.ix_(rows[old], rows[old])]
    new = np.flatnonzero(rows < 0)
    for start in range(0, len(new), SOURCES_PER_BLOCK):
        some = new[start : start + SOURCES_PER_BLOCK]
        step = part(progress, start / len(new), (start + len(some)) / len(new))

        def tell(share: float, _: str, step: Progress = step) -> None:
            step(share, f"{distance.label} among pins")

        tell(0, "")
        # Each with all that are known, and with the new ones up to itself.
        pairs = [(i, j) for i in some for j in range(count) if rows[j] >= 0 or j < i]
        if pairs:
            i, j = np.array(pairs).T
            matrix[i, j] = matrix[j, i] = distance.of_pairs([(places[a], places[b]) for a, b in pairs], tell)
    np.fill_diagonal(matrix, 0.0)
    return matrix


def _rows_in(known: Sequence[Source], places: Sequence[Source]) -> IntArray:
    """Return the rows (k,) of places among those that are known, -1 for others."""
    rows = {at: row for row, at in enumerate(known)}
    return np.array([rows.get(at, -1) for at in places], int)
