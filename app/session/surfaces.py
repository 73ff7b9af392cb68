"""The surfaces that are there: read in the background, and kept for undo when they are no longer shown."""

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

from bihdist_core import Surface
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.machine_memory import release_freed
from bihdist_core.progress import Progress, part

from ..document.document import Document, MeshFile
from .array_store import ArrayStore
from .latest_request_worker import LatestRequestWorker
from .loaded_mesh import LoadedMesh, is_same, open_mesh

SPARED = 120_000
"""Surfaces no longer shown are kept up to so many vertices in all, for undo; with their factors these take 0.4 GB."""

LEAST = 10_000
"""Vertices that each of them counts for at least: a small one takes half a megabyte for what is made once."""

SPARED_MADE = 2
"""The same of surfaces made from others: made again they are soon there."""


class LoadingView(Protocol):
    """Who is told, on the view's thread."""

    def progress_changed(self) -> None:
        """Called as a file is being read."""

    def failed(self, message: str) -> None:
        """Called with the reason if a file cannot be opened."""


@dataclass(frozen=True, eq=False)
class Opening:
    """A change of the document that waits for meshes: load these, change the document, show it, call `on_done`.

    `change` makes the session's document another one, and raises where that cannot be; `steps` is how far it goes in
    the history, if that is all it does.  `is_wanted` is asked once the meshes are loaded, and
    `precompute(meshes, progress)` runs in the background before they are shown.
    """

    meshes: tuple[MeshFile, ...]
    change: Callable[[], object]
    on_done: Callable[[], None] = lambda: None
    is_wanted: Callable[[], bool] = lambda: True
    steps: int = 0
    precompute: Callable[[Sequence[LoadedMesh], Progress], None] | None = None


class Surfaces:
    """Called on the view's thread, but for what the lane does.

    `prepare`, `known_up` and `post` are those of the `Session`.  `present(opening)` changes the document and tells
    whether that could be; `loaded()` is called in the background once surfaces are on their way to the view.
    `opening` is what is being read and still wanted, and `progress` how far that is, as a fraction and a text.
    """

    def __init__(
        self,
        view: LoadingView,
        post: Callable[[Callable[[], None]], None],
        given: ArrayStore,
        prepare: Callable[[Surface], Any],
        known_up: Callable[[str], str],
        present: Callable[[Opening], bool],
        loaded: Callable[[], None],
    ) -> None:
        self._view, self._post, self._given = view, post, given
        self._prepare, self._known_up = prepare, known_up
        self._present, self._loaded = present, loaded
        self._opened: list[LoadedMesh] = []  # those shown last come last
        self.opening: Opening | None = None
        self.progress: tuple[float, str] | None = None
        self._dropped = False  # whether surfaces have been forgotten whose memory may still be held
        self.tried = False  # whether surfaces have been asked for
        self._worker: LatestRequestWorker[Opening] = LatestRequestWorker(
            "load", self._load, self._report, self._failed, leaves=True
        )

    def __iter__(self) -> Iterator[LoadedMesh]:
        return iter(self._opened)

    def find(self, mesh: MeshFile) -> LoadedMesh | None:
        """Return the surface of a mesh; None before it is there."""
        return next((loaded for loaded in reversed(self._opened) if is_same(mesh, loaded.mesh)), None)

    def missing(self, document: Document) -> tuple[MeshFile, ...]:
        """Surfaces that have to be read; where any content will do, what the file holds now."""
        return tuple(
            mesh
            for mesh in document.surfaces
            if not mesh.sha256 or (mesh.repairs.cut and not mesh.repairs.cut_sha256) or self.find(mesh) is None
        )

    def start(self, opening: Opening) -> None:
        """Read meshes, and nothing else that is on its way."""
        self.opening, self.tried = opening, True
        self._worker.submit(opening)

    def drop(self) -> None:
        """Give up what is on its way; its reading may go on."""
        self.opening = None

    def cancel(self) -> None:
        """Give up what is on its way, and stop reading."""
        self.drop()
        self._worker.submit(None)

    def forget(self, document: Document) -> None:
        """Surfaces that are no longer shown, the oldest first; asked for again they are opened again.

        Those that are shown know each other.
        """
        latest = {loaded.mesh: loaded for loaded in self._opened}.values()  # of a file that was read again
        shown = [loaded for loaded in latest if any(is_same(mesh, loaded.mesh) for mesh in document.surfaces)]
        others = [loaded for loaded in latest if loaded not in shown]
        made = [loaded for loaded in others if loaded.origin is not None]
        # Of those that a slider has passed none is come back to.
        others = [loaded for loaded in others if loaded not in made[:-SPARED_MADE]]
        while others and sum(max(len(loaded.surface.vertices), LEAST) for loaded in others) > SPARED:
            others.pop(0)
        self._dropped = self._dropped or len(others) + len(shown) < len(self._opened)
        self._opened = [*others, *shown]
        for loaded in self._opened:
            loaded.set_shown_with(shown if loaded in shown else ())

    def end(self) -> None:
        """Stop reading, and soon the thread."""
        self._worker.end()

    def close(self) -> None:
        """Stop reading, and wait for the thread."""
        self._worker.close()

    def _load(self, opening: Opening, worker: LatestRequestWorker[Opening]) -> None:
        # The first report comes before the reading, which has no others.
        report = worker.progress(lambda latest: latest is opening, quiet=0)
        found: list[LoadedMesh] = []
        for k, mesh in enumerate(opening.meshes):
            word = "reading" if mesh.change is None else "changing"
            report(k / len(opening.meshes), f"{word} {os.path.basename(mesh.path) or mesh.name}")
            making = part(report, k / len(opening.meshes), (k + 0.5) / len(opening.meshes))
            loaded = open_mesh(mesh, self._given, there=[*self._opened, *found], progress=making)
            share, words = (k + 0.5) / len(opening.meshes), f"assembling {loaded.surface.name}"
            self._assemble(loaded, partial(report, share, words))
            found.append(loaded)
        if opening.precompute is not None:
            opening.precompute(found, part(report, 0.5, 1))
        report(1, "")
        self._post(lambda: self._take(opening, found))
        self._loaded()
        if self._dropped:
            self._dropped = False
            release_freed()  # of one after another, as a slider moves, nobody else would

    def _assemble(self, loaded: LoadedMesh, check_wanted: Callable[[], None]) -> None:
        """Compute what the view needs of a surface; `check_wanted` raises Cancelled once nobody wants it."""
        check_wanted()
        loaded.prepared = self._prepare(loaded.surface)
        check_wanted()
        loaded.up = self._known_up(loaded.mesh.sha256) or loaded.guessed_up(lambda *_: check_wanted())
        check_wanted()
        loaded.first_look(loaded.up)
        check_wanted()
        # Told by the view and needed to pick, for whose thread going over all faces would take too long.
        surface_notes(loaded.surface)
        check_wanted()
        _ = loaded.surface.mean_edge_length

    def _take(self, opening: Opening, found: list[LoadedMesh]) -> None:
        if opening is not self.opening:
            return  # cancelled, or another mesh was asked for, while it was on its way here
        self.opening = None
        if not opening.is_wanted():
            return
        before = list(self._opened)
        self._opened += found
        if not self._present(opening):
            self._opened = before

    def _failed(self, opening: Opening, error: Exception) -> None:
        def tell() -> None:
            if opening is self.opening:
                self.opening = None
                self._view.failed(failure_in_words(error))

        self._post(tell)

    def _report(self, fraction: float | None, text: str) -> None:
        def note() -> None:
            self.progress = None if fraction is None else (fraction, text)
            self._view.progress_changed()

        self._post(note)
