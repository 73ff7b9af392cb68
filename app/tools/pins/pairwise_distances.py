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
from bihdist_core.distances.kinds import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source

from ...session.latest_request_worker import LatestRequestWorker
from ...session.loaded_mesh import LoadedMesh

AT_ONCE = 8
"""Sources between two places where the work can be given up."""

WorkOrder = tuple[LoadedMesh, str, Spec]
"""A surface, the areas of its operators, and a distance."""


@dataclass(frozen=True, eq=False)
class _Known:
    """matrix: (k, k) the distances among k places."""

    places: tuple[Source, ...]
    matrix: FloatArray


@dataclass(frozen=True, eq=False)
class _Request:
    loaded: LoadedMesh
    areas: str
    specs: tuple[Spec, ...]
    places: tuple[Source, ...]


class PairwiseDistances:
    """`changed()` is called, by `post`, when `matrix`, `unit`, `failure` or `progress` say something new."""

    def __init__(self, post: Callable[[Callable[[], None]], None], changed: Callable[[], None]) -> None:
        self._post, self._changed = post, changed
        self._known: dict[WorkOrder, _Known] = {}
        self._units: dict[WorkOrder, str] = {}
        self._failures: dict[WorkOrder, str] = {}
        self._asked: _Request | None = None
        self.progress: tuple[float, str] | None = None
        self._worker: LatestRequestWorker[_Request] = LatestRequestWorker("among", self._work, self._report, self._fail)

    def ask(self, loaded: LoadedMesh, areas: str, specs: Sequence[Spec], places: Sequence[Source]) -> None:
        """The distances among these are wanted, those of the first of the specs first; nothing else is."""
        asked = _Request(loaded, areas, tuple(dict.fromkeys(specs)), tuple(places))
        wanted = {(loaded, areas, spec) for spec in asked.specs}
        # What nobody asks for any more is forgotten, but for the same pins' other distances.
        self._known = {key: known for key, known in self._known.items() if key[:2] == (loaded, areas)}
        self._failures = {key: reason for key, reason in self._failures.items() if key[:2] == (loaded, areas)}
        self._units = {key: unit for key, unit in self._units.items() if key[:2] == (loaded, areas)}
        missing = [key for key in wanted if key not in self._failures and self.matrix(*key, places) is None]
        old, self._asked = self._asked, asked
        if not missing or len(places) < 2:
            self._worker.submit(None)
        elif old is None or not _is_same(old, asked) or self.progress is None:
            self._worker.submit(asked)

    def matrix(self, loaded: LoadedMesh, areas: str, spec: Spec, places: Sequence[Source]) -> FloatArray | None:
        """(k, k) the distances among k places, NaN between components; None as long as they are not known."""
        known = self._known.get((loaded, areas, spec))
        if known is None:
            return None
        rows = _rows_in(known.places, places)
        return None if (rows < 0).any() else known.matrix[np.ix_(rows, rows)]

    def unit(self, loaded: LoadedMesh, areas: str, spec: Spec) -> str:
        """The unit of the distances, "" as long as none are known."""
        return self._units.get((loaded, areas, spec), "")

    def failure(self, loaded: LoadedMesh, areas: str, spec: Spec) -> str:
        """Why there is none, in a sentence."""
        return self._failures.get((loaded, areas, spec), "")

    def close(self) -> None:
        """Stop the work, and the thread."""
        self._worker.close()

    # ------------------------------------------------------------------ in the background
    def _work(self, request: _Request, worker: LatestRequestWorker[_Request]) -> None:
        progress = worker.progress(lambda latest: _is_same(latest, request))
        for k, spec in enumerate(request.specs):
            key = (request.loaded, request.areas, spec)
            known = self._known.get(key)
            share = part(progress, k / len(request.specs), (k + 1) / len(request.specs))
            try:
                distance = request.loaded.distances(request.areas).get(spec, part(share, 0, 0.5))
                matrix = distances_among(distance, request.places, known, part(share, 0.5, 1))
            except Cancelled:
                raise
            except (BihdistError, MemoryError) as error:
                self._post(partial(self._failed, key, error))
            else:
                found = _Known(request.places, matrix)
                self._post(partial(self._found, key, found, distance.unit))

    def _found(self, key: WorkOrder, found: _Known, unit: str) -> None:
        if self._asked is None or self._asked.loaded is not key[0]:
            return  # of a surface that has gone
        self._known[key], self._units[key] = found, unit
        self._changed()

    def _failed(self, key: WorkOrder, error: Exception) -> None:
        self._failures[key] = failure_in_words(error)
        self._changed()

    def _fail(self, request: _Request, error: Exception) -> None:
        for spec in request.specs:
            self._post(partial(self._failed, (request.loaded, request.areas, spec), error))

    def _report(self, fraction: float | None, text: str) -> None:
        def note() -> None:
            self.progress = None if fraction is None else (fraction, text)
            self._changed()

        self._post(note)


def distances_among(
    distance: Distance, places: Sequence[Source], known: _Known | None, progress: Progress
) -> FloatArray:
    """(k, k) those among places; of what is known, none is computed again."""
    count = len(places)
    matrix, rows = np.full((count, count), np.nan), np.full(count, -1)
    if known is not None:
        rows = _rows_in(known.places, places)
        old = np.flatnonzero(rows >= 0)
        matrix[np.ix_(old, old)] = known.matrix[np.ix_(rows[old], rows[old])]
    new = np.flatnonzero(rows < 0)
    for start in range(0, len(new), AT_ONCE):
        some = new[start : start + AT_ONCE]
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
    """(k,) where places stand among those that are known, -1 for those that are not there."""
    rows = {at: row for row, at in enumerate(known)}
    return np.array([rows.get(at, -1) for at in places], int)


def _is_same(one: _Request, other: _Request) -> bool:
    return (one.loaded, one.areas, one.specs, one.places) == (
        other.loaded,
        other.areas,
        other.specs,
        other.places,
    )
