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
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.progress import Progress

from ..document.beside_edits import close_beside, open_beside, see
from ..document.camera import View as CameraView
from ..document.derived_surfaces import changed_mesh
from ..document.document import Document, MeshFile, Point, starting_points
from ..document.edits import open_mesh as with_mesh
from ..document.history import History, Trail
from .answering import Answering, AnswerView, Shown
from .array_store import ArrayStore
from .derived_surfaces import answers_ahead, led
from .followed_vertices import followed
from .loaded_mesh import LoadedMesh, started_alike
from .questions import asks_of, questions
from .surfaces import LoadingView, Opening, Surfaces

AHEAD = 60_000
"""Vertices up to which a changed mesh takes the place of another only once its fields are there: some seconds."""


class View(AnswerView, LoadingView, Protocol):
    """What the session tells whoever shows it; panels are named by their ids."""

    def document_changed(self, before: Document) -> None:
        """Called when another document is shown."""


class Session:
    """See the module.

    `post(function)` must run the function on the thread of the view, in order.  `prepare(surface)` runs in the
    background when a mesh is opened, for what the view needs of it; its result is then in `opened().prepared`.
    `known_up(sha256)`, in the background too, is which way a mesh points up as far as that has been chosen before, or
    "".  given: surfaces and fields from Python, to be there before a document names them.
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
        self._walk: Trail[tuple[Point, ...]] | None = None
        self._walk_end: tuple[Point, ...] = ()

    # ------------------------------------------------------------------ intents
    def show(self, document: Document, key: str = "", live: bool = False) -> None:
        """Make this the present document: a step of the history (equal keys in a row are one).

        If it has other surfaces they are opened first, in the background, and what is shown stays as it is until they
        are there.  live: a drag goes on; stand-ins will do, and what is computed is shown though it is late.
        """
        if not self._is_begun:
            is_edit = document.surfaces == self.document.surfaces and self._surfaces.tried
            self.history = History(document)
            if is_edit:
                return  # shown with the mesh that is on its way, or with the next
        missing = self._surfaces.missing(document)
        if missing:
            self._surfaces.start(Opening(missing, lambda: self._change(self._wanted(document), key)))
        else:
            self._present(lambda: self._change(document, key), live)

    def show_instead(self, document: Document, arriving: Callable[[], None], arrived: Callable[[], None]) -> None:
        """The same of a document from elsewhere, a file or a program: nothing else that is being opened is wanted.

        arriving: called when it has become the present document, before the view is told; arrived: afterwards.
        """
        self._surfaces.drop()
        if not self._is_begun:
            self.history = History(document)

        def arrive() -> None:
            self._change(self._wanted(document))
            arriving()

        missing = self._surfaces.missing(document)
        if missing:
            self._surfaces.start(Opening(missing, arrive, arrived))
        elif self._present(arrive):
            arrived()

    def _wanted(self, document: Document) -> Document:
        """What was asked for, with what was chosen while its surfaces were on their way to be the first."""
        is_same_mesh = not self._is_begun and self.document.surfaces == document.surfaces
        return self.document if is_same_mesh else document

    def open(self, path: str, source: int | None = None) -> None:
        """Open another mesh in the place of the one that is shown, which stays until the new one is there."""
        names = [mesh.name for mesh in self.document.surfaces]
        mesh = MeshFile(names[0] if names else "A", os.fspath(path))

        def arrive() -> None:
            # Until now the user went on with what is shown.
            self._change(with_mesh(self.document, mesh, source))

        self._surfaces.start(Opening((mesh,), arrive))

    def open_beside(self, path: str) -> None:
        """Open a second mesh beside the first, in the place of the one that stands there."""
        mesh = MeshFile("", os.fspath(path))

        def arrive() -> None:
            self._change(open_beside(self.document, mesh))

        self._surfaces.start(Opening((mesh,), arrive))

    def close_beside(self) -> None:
        """The first surface alone."""
        if len(self.document.surfaces) > 1:
            self.show(close_beside(self.document))

    def apply(self, edit: Callable[[Document], Document], key: str = "") -> None:
        """Show what an edit makes of the document: a step of the history (equal keys in a row are one).

        Where that takes a surface that is made first, what is shown stays until it is there, and the edit is of what
        that is by then; a small one that takes the place of another comes with its fields.
        """
        try:
            document = self._followed(edit(self.document))
        except BihdistError as error:
            self.view.failed(failure_in_words(error))
            return
        missing = self._surfaces.missing(document)
        if not missing:
            self._surfaces.drop()  # a change that was asked for before
            self.show(document, key)
            return

        def arrive() -> None:
            # Until now the user went on with what is shown.
            self._change(self._followed(edit(self.document)), key)

        def ahead(found: Sequence[LoadedMesh], progress: Progress) -> None:
            for question, answer in answers_ahead(document, found, tuple(self._surfaces), progress):
                self._answering.keep(question, answer)

        is_small = self.surface is not None and len(self.surface.vertices) <= AHEAD
        is_next = changed_mesh(self.document) is not None and all(mesh.change is not None for mesh in missing)
        self._surfaces.start(Opening(missing, arrive, ahead=ahead if is_small and is_next else None))

    def look(self, camera: CameraView, surface: str | None = None) -> None:
        """A surface, the first if none is named, is seen from elsewhere, which is no step of the history."""
        if self._is_begun:
            self.history.change(see(self.document, camera, surface))

    def link(self, is_linked: bool) -> None:
        """Whether the cameras of two surfaces move together, which is no step of the history."""
        if self._is_begun:
            self.history.change(replace(self.document, linked=is_linked))

    def keep_open(self, docks: tuple[str, ...]) -> None:
        """Which docks are open, which is no step of the history."""
        if self._is_begun:
            self.history.change(replace(self.document, docks=docks))

    def keep_snapping(self, is_snapping: bool) -> None:
        """Whether the pointer puts sources on vertices, which is no step of the history."""
        if self._is_begun:
            self.history.change(replace(self.document, snap=is_snapping))

    def undo(self) -> None:
        """One step back."""
        self._step(-1)

    def redo(self) -> None:
        """One step forward again."""
        self._step(1)

    def walk_sources(self, step: int) -> None:
        """To the points before (-1) or after (1) in the history's walk; the walk as a whole is one step."""
        starting = starting_points(self.document)
        if self._walk is None or self._walk_end != starting:
            self._walk = self.history.trail_of_points()
        walked = self._walk.back() if step < 0 else self._walk.on()
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
        asked = questions(self.document).get(panel)
        loaded = None if asked is None else self._surfaces.found(asked.mesh)
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
        """What is shown."""
        return self.history.present

    def loaded(self, name: str | None = None) -> LoadedMesh | None:
        """A surface of the document, the first if no name is given; None before there is one."""
        meshes = [mesh for mesh in self.document.surfaces if name in (None, mesh.name)]
        return self._surfaces.found(meshes[0]) if meshes and self._is_begun else None

    @property
    def surface(self) -> Surface | None:
        """The first surface of the document; None before there is one."""
        loaded = self.loaded()
        return None if loaded is None else loaded.surface

    def loaded_in(self, panel: int) -> LoadedMesh | None:
        """The surface of a panel; None before it is there, and where there is no such panel."""
        name = next((each.surface for each in self.document.panels if each.id == panel), None)
        return None if name is None else self.loaded(name)

    @property
    def first_surface(self) -> Surface:
        """The first surface of the document; LookupError before there is one."""
        return self.mesh().surface

    def mesh(self, name: str | None = None) -> LoadedMesh:
        """A surface of the document, the first if no name is given; LookupError before it is there."""
        loaded = self.loaded(name)
        if loaded is None:
            raise LookupError(f"The surface {name or 'of the document'} is not loaded yet.")
        return loaded

    def surface_in(self, panel: int) -> Surface:
        """The surface of a panel; LookupError before it is there, and where there is no such panel."""
        return self.mesh(self.document.panel(panel).surface).surface

    @property
    def can_undo(self) -> bool:
        """Whether there is a document before this one."""
        return self.history.at(self._steps_on_their_way - 1) is not None

    @property
    def can_redo(self) -> bool:
        """Whether a document has been left by undo."""
        return self.history.at(self._steps_on_their_way + 1) is not None

    @property
    def is_opening(self) -> bool:
        """Whether a mesh is being read for a document that is still wanted."""
        return self._surfaces.on_their_way is not None

    @property
    def replaced(self) -> set[str]:
        """The names of surfaces in whose places others are being read from files."""
        opening = self._surfaces.on_their_way
        meshes = opening.meshes if opening is not None and opening.is_wanted() else ()
        return {mesh.name for mesh in meshes if mesh.change is None}

    @property
    def shown(self) -> dict[int, Shown]:
        """What each panel shows, by its id."""
        return self._answering.shown

    @property
    def progress(self) -> dict[str | int, tuple[float, str]]:
        """What is going on, as a share done and a text: for panels by their ids, and of "load"."""
        loading = self._surfaces.progress
        going: dict[str | int, tuple[float, str]] = {} if loading is None else {"load": loading}
        going.update(self._answering.progress.items())
        return going

    @property
    def is_stopped(self) -> bool:
        """Whether the user has cancelled something of what was asked last."""
        return bool(self._answering.stopped)

    def is_stopped_at(self, panel: int) -> bool:
        """Whether that is for this panel."""
        return panel in self._answering.stopped

    def is_quick_look(self, panel: int) -> bool:
        """Whether a panel shows a stand-in for the answer to its present question."""
        return self._answering.is_quick_look(panel)

    def is_answered(self, panel: int) -> bool:
        """Whether a panel shows the final answer to its present question, be its accuracy known or not."""
        return self._answering.is_answered(panel)

    @property
    def is_complete(self) -> bool:
        """Whether every panel does, and it is known how accurate that is."""
        ids = [panel.id for panel in self.document.panels]
        return self.surface is not None and all(self.is_answered(id) and self.shown[id].answer.is_final for id in ids)

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
        opening = self._surfaces.on_their_way
        return opening.steps if opening is not None and opening.is_wanted() else 0

    def _step(self, by: int) -> None:
        steps = by + self._steps_on_their_way
        document = self.history.at(steps)
        if document is None:
            return
        self._surfaces.drop()  # a mesh on its way was a step not yet done
        missing = self._surfaces.missing(document)

        def step() -> None:
            self.history.go(steps)

        if missing:
            # Whatever is done meanwhile takes its place.
            wanted = Opening(missing, step, is_wanted=lambda: self.history.at(steps) == document, steps=steps)
            self._surfaces.start(wanted)
        else:
            self._present(step)

    def _followed(self, document: Document) -> Document:
        """With all that is at vertices where these are in it, as far as its surfaces are there."""
        return followed(document, self.document, self._surfaces.found)

    def _settled(self, document: Document) -> Document:
        """With the checksums of the surfaces that are there, and points where there is a vertex."""
        first = self._surfaces.found(document.surfaces[0]) if document.surfaces else None
        for mesh in document.surfaces:
            loaded = self._surfaces.found(mesh)
            if loaded is not None and first is not None:
                document = started_alike(document, mesh.name, first, loaded)
            if loaded is not None:
                document = loaded.settled(document)
        return document

    # ------------------------------------------------------------------ asking
    def _change(self, document: Document, key: str = "") -> None:
        """A step of the history; the first document that can be shown is its beginning."""
        for mesh in document.surfaces if self._is_begun else ():
            loaded = self._surfaces.found(mesh) if mesh.change is not None else None
            if loaded is not None:
                document = led(document, self.document, loaded)
        document = self._settled(document)
        if not self._is_begun:
            self.history, self._is_begun = History(document), True
        else:
            self.history.change(document, key)

    def _present(self, change: Callable[[], object], live: bool = False) -> bool:
        """Let the document change, tell the view, and ask what is new; False if there is no such place."""
        before = self.document
        try:
            change()
        except Exception as error:  # a source that the mesh does not have, or what nobody foresaw of a file
            self.view.failed(failure_in_words(error))
            return False
        self._surfaces.forget(self.document)
        self._answering.expect(questions(self.document))
        try:
            self.view.document_changed(before)
        finally:
            self._ask(live)
        return True

    def _ask(self, live: bool) -> None:
        asked = {id: (each, self._surfaces.found(each.mesh)) for id, each in questions(self.document).items()}
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
