"""The session: it shows documents.  Knows no Qt and draws nothing.

`show(document)` and the other intents are called on one thread, the window's: a document's meshes are opened, it
becomes a step of the history, and what it asks is answered (`answering`), as soon as each panel's answer is there.
"""

import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Protocol

from bihdist_core import BihdistError, Surface
from bihdist_core.distances.answers import Answer, failure_in_words
from bihdist_core.progress import Progress

from ..document.camera import View as CameraView
from ..document.derived_surfaces import changed_mesh
from ..document.document import Document, MeshFile, Point, starting_points
from ..document.edits import close_meshes, open_mesh as with_mesh
from ..document.history import History, NavigationHistory
from ..document.second_mesh_edits import close_second_mesh, open_second_mesh, set_view
from .answering import Answering, AnswerView, Shown
from .array_store import ArrayStore
from .derived_surfaces import answers_ahead, propagate_source
from .loaded_mesh import LoadedMesh, match_sources
from .questions import Question, asks_of, questions
from .surfaces import LoadingView, Opening, Surfaces
from .vertex_remap import remap_vertices

MOST_PRECOMPUTED = 60_000
"""Vertices up to which a changed mesh takes the place of another only once its fields are there: some seconds."""


class View(AnswerView, LoadingView, Protocol):
    """The view of a session, which is told of changes; panels are named by their ids."""

    def document_changed(self, before: Document) -> None:
        """Called when another document is shown."""


class Session:
    """Shows documents: opens their meshes, keeps their history, and has their questions answered.

    Parameters
    ----------
    view
        The view that is told of changes.
    post
        `post(function)` runs the function on the view's thread, in order.
    prepare
        `prepare(surface)` runs in the background when a mesh is opened, and makes what the view needs of it, which is
        then in `loaded().prepared`.
    document
        The document to show first.
    known_up
        `known_up(sha256)`, also called in the background, returns the axis of a mesh that was chosen to point up
        before, or "".

    Attributes
    ----------
    given
        Surfaces and fields from Python, to be there before a document names them.
    """

    def __init__(
        self,
        view: View,
        post: Callable[[Callable[[], None]], None],
        prepare: Callable[[Surface], Any] = lambda surface: None,
        document: Document | None = None,
        known_up: Callable[[str], str] = lambda sha256: "",
    ) -> None:
        self.view = view
        self.given = ArrayStore()
        self.history = History(document or Document())
        self._answering = Answering(view, post)
        self._surfaces = Surfaces(view, post, self.given, prepare, known_up, self._present, self._load_programs)
        self._is_begun = False  # whether a document has been shown
        self._walk: NavigationHistory[tuple[Point, ...]] | None = None
        self._walk_end: tuple[Point, ...] = ()

    # ------------------------------------------------------------------ intents
    def show(self, document: Document, key: str = "", live: bool = False) -> None:
        """Make this the present document: a step of the history (equal keys in a row are one).

        If it has other surfaces they are opened first, in the background, and what is shown stays as it is until they
        are there. While a drag goes on (`live`), previews will do, and what is computed is shown even if it is late.
        """
        if not self._is_begun:
            is_edit = document.surfaces == self.document.surfaces and self._surfaces.tried
            self.history = History(document)
            if is_edit:
                return  # shown with the mesh that is on its way, or with the next
        self._open(document, lambda: self._change(self._wanted(document), key), live=live)

    def show_instead(
        self, document: Document, on_change: Callable[[], None], on_done: Callable[[], None], is_opened: bool = False
    ) -> None:
        """Show a document from elsewhere, a file or a program; nothing else that is being opened is wanted.

        `on_change` is called when it has become the present document, before the view is told, `on_done` afterwards.
        With `is_opened` it is no edit of the present document, even if it shows the same meshes.
        """
        self._surfaces.drop()
        if not self._is_begun:
            self.history = History(document)

        def change() -> None:
            first, shown = self._surfaces.find(document.surfaces[0]), self.loaded()
            is_other = first is None or shown is None or first.mesh.sha256 != shown.mesh.sha256
            self._change(self._wanted(document), is_opened=is_opened or is_other)
            on_change()

        self._open(document, change, on_done=on_done)

    def _wanted(self, document: Document) -> Document:
        """Return the document asked for, with what was chosen while its surfaces were being opened."""
        is_same_mesh = not self._is_begun and self.document.surfaces == document.surfaces
        return self.document if is_same_mesh else document

    def open(self, path: str, source: int | None = None) -> None:
        """Open another mesh in the place of the one that is shown, which stays until the new one is there."""
        names = [mesh.name for mesh in self.document.surfaces]
        mesh = MeshFile(names[0] if names else "A", os.fspath(path))
        self._open_mesh(mesh, lambda document: with_mesh(document, mesh, source), is_opened=True)

    def open_second_mesh(self, path: str) -> None:
        """Open a second mesh beside the first, in the place of the one that stands there."""
        mesh = MeshFile("", os.fspath(path))
        self._open_mesh(mesh, lambda document: open_second_mesh(document, mesh))

    def _open_mesh(self, mesh: MeshFile, edit: Callable[[Document], Document], is_opened: bool = False) -> None:
        """Load a mesh, and edit what the user has made of the document until then."""
        self._surfaces.start(Opening((mesh,), lambda: self._change(edit(self.document), is_opened=is_opened)))

    def close_meshes(self) -> None:
        """Show nothing, as at the start; undo comes back."""
        self._surfaces.drop()
        if self.loaded() is not None:
            self._present(Opening((), lambda: self._change(close_meshes(self.document), is_opened=True)))

    def close_second_mesh(self) -> None:
        """Close the second mesh, with all that belongs to it."""
        if len(self.document.surfaces) > 1:
            self.show(close_second_mesh(self.document))

    def apply(self, edit: Callable[[Document], Document], key: str = "") -> None:
        """Show what an edit makes of the document: a step of the history (equal keys in a row are one).

        Where that takes a surface that is made first, what is shown stays until it is there, and the edit is of what
        that is by then; a small one that takes the place of another comes with its fields.
        """
        try:
            document = self._remap_vertices(edit(self.document))
        except BihdistError as error:
            self.view.failed(failure_in_words(error))
            return
        missing = self._surfaces.missing(document)
        if not missing:
            self._surfaces.drop()  # a change that was asked for before
            self.show(document, key)
            return

        def precompute(found: Sequence[LoadedMesh], progress: Progress) -> None:
            for question, answer in answers_ahead(document, found, tuple(self._surfaces), progress):
                self._answering.keep(question, answer)

        first = self.loaded()
        is_small = first is not None and len(first.surface.vertices) <= MOST_PRECOMPUTED
        is_next = changed_mesh(self.document) is not None and all(mesh.change is not None for mesh in missing)

        def change() -> None:
            # Until now the user went on with what is shown.
            self._change(self._remap_vertices(edit(self.document)), key)

        self._surfaces.start(Opening(missing, change, precompute=precompute if is_small and is_next else None))

    def set_view(self, camera: CameraView, surface: str | None = None) -> None:
        """A surface, the first if none is named, is seen from elsewhere, which is no step of the history."""
        if self._is_begun:
            self.history.change(set_view(self.document, camera, surface))

    def set_fields(self, **changes: Any) -> None:
        """Change fields of the document that are no content: `docks`, `snap`, `linked`.  That is no step to undo."""
        if self._is_begun:
            self.history.change(replace(self.document, **changes))

    def undo(self) -> None:
        """Go one step back."""
        self._step(-1)

    def take_back(self) -> None:
        """Undo the last step, of the same meshes, as if it had not been taken: it cannot be redone."""
        self._present(Opening((), self.history.take_back))

    def redo(self) -> None:
        """Go one step forward again."""
        self._step(1)

    def walk_sources(self, step: int) -> None:
        """To the points before (-1) or after (1) in the history's walk; the walk as a whole is one step."""
        starting = starting_points(self.document)
        if self._walk is None or self._walk_end != starting:
            self._walk = self.history.point_history()
        walked = self._walk.back() if step < 0 else self._walk.forward()
        moved = {point.name: point for point in walked or ()}
        if walked is not None and {point.name for point in starting} <= moved.keys():
            # Pins and other marks stay where they are.
            points = tuple(moved[p.name] if p in starting else p for p in self.document.points)
            self.show(replace(self.document, points=points), key="walk")
            self._walk_end = starting_points(self.document)

    def cancel(self, panel: int | None = None) -> None:
        """Stop what is going on, for one panel or everything; `retry`, the next click or change asks again."""
        if panel is None:
            self._surfaces.cancel()
        self._answering.cancel(panel)

    def retry(self, panel: int) -> None:
        """Ask again what was stopped for a panel."""
        asked = self.questions.get(panel)
        loaded = None if asked is None else self._surfaces.find(asked.mesh)
        if asked is not None and loaded is not None:
            self._answering.ask({panel: (asked, loaded)}, live=False)

    def close(self) -> None:
        """End all threads and child processes."""
        self._surfaces.end()
        self._answering.end()
        self._surfaces.close()
        self._answering.close()

    # ------------------------------------------------------------------ what is known
    @property
    def document(self) -> Document:
        """The document that is shown."""
        return self.history.present

    def loaded(self, where: str | int | None = None) -> LoadedMesh | None:
        """Return the mesh of a name in the document, or of a panel's id; the first if None.

        None before it is loaded, and where there is no such mesh or panel.
        """
        if isinstance(where, int):
            where = next((panel.surface for panel in self.document.panels if panel.id == where), "")
        meshes = [mesh for mesh in self.document.surfaces if where in (None, mesh.name)]
        return self._surfaces.find(meshes[0]) if meshes and self._is_begun else None

    def mesh(self, where: str | int | None = None) -> LoadedMesh:
        """Return the same mesh; LookupError where `loaded` returns None."""
        loaded = self.loaded(where)
        if loaded is None:
            raise LookupError(f"The mesh {'of the document' if where is None else repr(where)} is not loaded yet.")
        return loaded

    @property
    def can_undo(self) -> bool:
        """Return whether there is a document before this one."""
        return self.history.at(self._steps_on_their_way - 1) is not None

    @property
    def can_redo(self) -> bool:
        """Return whether a document has been left by undo."""
        return self.history.at(self._steps_on_their_way + 1) is not None

    @property
    def is_opening(self) -> bool:
        """Return whether a mesh is being read for a document that is still wanted."""
        return self._surfaces.opening is not None

    @property
    def replaced(self) -> set[str]:
        """The names of surfaces in whose places others are being read from files."""
        opening = self._surfaces.opening
        meshes = opening.meshes if opening is not None and opening.is_wanted() else ()
        return {mesh.name for mesh in meshes if mesh.change is None}

    @property
    def questions(self) -> dict[int, Question]:
        """The question of each panel, by its id."""
        return self._answering.questions

    @property
    def shown(self) -> dict[int, Shown]:
        """The answers that the panels show, by their ids."""
        return self._answering.shown

    def answer(self, panel: int) -> Answer | None:
        """Return the answer that a panel shows, None before its first."""
        shown = self.shown.get(panel)
        return None if shown is None else shown.answer

    @property
    def progress(self) -> dict[str | int, tuple[float, str]]:
        """The progress of panels by their ids, and of "load", as the fraction done and a text."""
        loading = self._surfaces.progress
        going: dict[str | int, tuple[float, str]] = {} if loading is None else {"load": loading}
        going.update(self._answering.progress.items())
        return going

    @property
    def is_stopped(self) -> bool:
        """Return whether the user has cancelled something of what was asked last."""
        return bool(self._answering.stopped)

    def is_stopped_at(self, panel: int) -> bool:
        """Return whether that is for this panel."""
        return panel in self._answering.stopped

    def is_preview(self, panel: int) -> bool:
        """Return whether a panel shows a stand-in for the answer to its present question."""
        return self._answering.is_preview(panel)

    def is_answered(self, panel: int) -> bool:
        """Return whether a panel shows the final answer to its present question, be its accuracy known or not."""
        return self._answering.is_answered(panel)

    @property
    def is_complete(self) -> bool:
        """Return whether every panel does, and it is known how accurate that is."""
        ids = [panel.id for panel in self.document.panels]
        return self.loaded() is not None and all(self.is_answered(id) and self.shown[id].answer.is_final for id in ids)

    # ------------------------------------------------------------------ opening
    def _load_programs(self) -> None:
        """While the window takes surfaces in: at the start it is still busy with itself."""
        for question in questions(self.document).values():
            for spec in question.specs:
                with suppress(BihdistError):  # somebody else's, which says so when it is asked
                    spec.load()

    @property
    def _steps_on_their_way(self) -> int:
        """Taken to a document whose mesh is still being read, unless something has been done since."""
        opening = self._surfaces.opening
        return opening.steps if opening is not None and opening.is_wanted() else 0

    def _step(self, by: int) -> None:
        steps = by + self._steps_on_their_way
        document = self.history.at(steps)
        if document is None:
            return
        self._surfaces.drop()  # a mesh on its way was a step not yet done

        def is_wanted() -> bool:
            return self.history.at(steps) == document  # whatever is done meanwhile takes its place

        self._open(document, lambda: self.history.go(steps), is_wanted=is_wanted, steps=steps)

    def _open(self, document: Document, change: Callable[[], object], live: bool = False, **options: Any) -> None:
        """Change the document, at once or when the meshes that it needs are loaded; see `Opening`."""
        opening = Opening(self._surfaces.missing(document), change, **options)
        if opening.meshes:
            self._surfaces.start(opening)
        else:
            self._present(opening, live)

    def _remap_vertices(self, document: Document) -> Document:
        """Move all that is at vertices to where these are in the document, as far as its surfaces are loaded."""
        return remap_vertices(document, self.document, self._surfaces.find)

    def _resolve_points(self, document: Document) -> Document:
        """Fill in the checksums of the surfaces that are loaded, and points that have no place yet."""
        first = self._surfaces.find(document.surfaces[0]) if document.surfaces else None
        for mesh in document.surfaces:
            loaded = self._surfaces.find(mesh)
            if loaded is not None and first is not None:
                document = match_sources(document, mesh.name, first, loaded)
            if loaded is not None:
                document = loaded.resolve_points(document)
        return document

    # ------------------------------------------------------------------ asking
    def _change(self, document: Document, key: str = "", is_opened: bool = False) -> None:
        """A step of the history; the first document that can be shown is its beginning."""
        for mesh in document.surfaces if self._is_begun else ():
            loaded = self._surfaces.find(mesh) if mesh.change is not None else None
            if loaded is not None:
                document = propagate_source(document, self.document, loaded)
        document = self._resolve_points(document)
        if not self._is_begun:
            self.history, self._is_begun = History(document), True
        else:
            self.history.change(document, key, is_opened)

    def _present(self, opening: Opening, live: bool = False) -> bool:
        """Change the document, tell the view, and ask what is new; False if the document cannot be."""
        before = self.document
        try:
            opening.change()
        except Exception as error:  # a source that the mesh does not have, or what nobody foresaw of a file
            self.view.failed(failure_in_words(error))
            return False
        self._surfaces.forget(self.document)
        self._answering.expect(questions(self.document))
        try:
            self.view.document_changed(before)
        finally:
            self._ask(live)
        opening.on_done()
        return True

    def _ask(self, live: bool) -> None:
        asked = {id: (each, self._surfaces.find(each.mesh)) for id, each in self.questions.items()}
        there = {id: (question, loaded) for id, (question, loaded) in asked.items() if loaded is not None}
        self._answering.ask(there, live)
        for loaded in self._surfaces:
            wanted = {
                spec
                for question, surface in there.values()
                if loaded in (surface, surface.origin) or asks_of(question, loaded.mesh)
                for spec in question.specs
            }
            loaded.keep(self.document.areas, wanted)
