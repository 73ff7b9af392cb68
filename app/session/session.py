"""The session: it shows documents.  Knows no Qt and draws nothing.

`show(document)` and the other intents are called on one thread, the window's.  What a document asks that is not known
yet is worked on by lanes, one for each panel, so that a click is answered at once by the panels that are ready while
another still computes.  Answers come back through `post`, which runs a function on the window's thread.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol

from bihdist_core import BihdistError, SolverError, Surface
from bihdist_core.distances.answers import Answer, failed, failure_in_words
from bihdist_core.distances.kinds import Spec
from bihdist_core.progress import Progress, part

from ..document.camera import Camera
from ..document.document import Document, MeshFile
from ..document.edits import open_mesh as with_mesh
from ..document.history import History
from .kept import KeptAnswers
from .lane import Lane
from .opened import Opened, in_memory, is_same, open_mesh
from .questions import Question, questions

SPARED = 120_000
"""Surfaces no longer shown are kept up to so many vertices in all, for undo; with their factors these take 0.4 GB."""


class View(Protocol):
    """What the session tells whoever shows it; panels are named by their ids."""

    def document_changed(self, before: Document) -> None: ...
    def answer_changed(self, panel: int) -> None: ...
    def certificate_changed(self, panel: int) -> None: ...
    def progress_changed(self) -> None: ...
    def failed(self, message: str) -> None: ...


@dataclass(frozen=True, eq=False)
class Shown:
    """What a panel shows: the answer to a question.

    asked: what the panel was asked, which is another question while a quick stand-in is shown (`is_preview`).
    """

    asked: Question
    answer: Answer
    serial: int
    is_preview: bool = False


@dataclass(frozen=True, eq=False)
class _Request:
    """A question for a lane.  live: a drag goes on, so a stand-in will do and nobody is in the way of the next."""

    question: Question
    opened: Opened
    serial: int
    live: bool


@dataclass(frozen=True, eq=False)
class _Opening:
    """Meshes to be opened, and what becomes of the document once they are there."""

    meshes: tuple[MeshFile, ...]
    arrive: Callable[[], object]
    arrived: Callable[[], None] = lambda: None


class Session:
    """See the module.

    `post(function)` must run the function on the thread of the view, in order.  `prepare(surface)` runs in the
    background when a mesh is opened, for what the view needs of it; its result is then in `opened().prepared`.
    """

    def __init__(
        self,
        view: View,
        post: Callable[[Callable[[], None]], None],
        prepare: Callable[[Surface], Any] = lambda surface: None,
        document: Document | None = None,
    ) -> None:
        self.view = view
        self.history = History(document or Document())
        self.shown: dict[int, Shown] = {}
        self.progress: dict[str | int, tuple[float, str]] = {}
        self.is_stopped = False
        self._post = post
        self._prepare = prepare
        self._kept = KeptAnswers()
        self._opened: list[Opened] = []  # those shown last come last
        self._serial = 0
        self._opening: _Opening | None = None
        self._is_begun = False
        self._loader: Lane[_Opening] = Lane("load", self._load, self._reporter("load"), self._loading_failed)
        self._lanes: dict[int, Lane[_Request]] = {}

    # ------------------------------------------------------------------ intents
    def show(
        self, document: Document, key: str = "", live: bool = False, arrived: Callable[[], None] = lambda: None
    ) -> None:
        """Make this the present document: a step of the history (equal keys in a row are one).

        If it has other surfaces they are opened first, in the background, and what is shown stays as it is until they
        are there.  live: a drag goes on; stand-ins will do, and what is computed is shown though it is late.  arrived:
        called once the document is shown.
        """
        missing = self._missing(document)
        if missing:
            self._start_opening(_Opening(missing, lambda: self._change(document, key), arrived))
        else:
            self._present(lambda: self._change(document, key), live)
            arrived()

    def open(
        self,
        path: str,
        source: int | None = None,
        edit: Callable[[Document], Document] = lambda document: document,
        arrived: Callable[[], None] = lambda: None,
    ) -> None:
        """Open another mesh in the place of the one that is shown, which stays until the new one is there.

        edit: what else is to change with it; arrived: called when it is shown.
        """
        mesh = MeshFile("A", os.fspath(path))

        def arrive() -> None:
            # Until now the user went on with what is shown.
            self._change(edit(with_mesh(self.document, mesh, source)))

        self._start_opening(_Opening((mesh,), arrive, arrived))

    def give(self, surface: Surface, name: str = "A") -> MeshFile:
        """Have a surface that comes from no file, to be named by documents."""
        opened = in_memory(surface, name)
        opened.prepared = self._prepare(surface)
        self._opened.append(opened)
        return opened.mesh

    def look(self, camera: Camera) -> None:
        """The camera has moved, which is no step of the history."""
        self.history.change(replace(self.document, camera=camera))

    def undo(self) -> None:
        """One step back."""
        self._step(self.history.before(), self.history.undo)

    def redo(self) -> None:
        """One step forward again."""
        self._step(self.history.after(), self.history.redo)

    def cancel(self) -> None:
        """Stop everything that is going on; the next click or change asks again."""
        self.is_stopped, self._opening = True, None
        self._loader.submit(None)
        for id in self._lanes:
            self._stop(id)

    def close(self) -> None:
        lanes: list[Lane] = [self._loader, *self._lanes.values()]
        for lane in lanes:
            lane.end()
        for lane in lanes:
            lane.close()

    # ------------------------------------------------------------------ what is known
    @property
    def document(self) -> Document:
        """What is shown."""
        return self.history.present

    def opened(self, name: str = "A") -> Opened | None:
        """A surface of the document; None before there is one."""
        mesh = next((mesh for mesh in self.document.surfaces if mesh.name == name), None)
        return None if mesh is None else self._found(mesh)

    @property
    def surface(self) -> Surface | None:
        """The first surface of the document; None before there is one."""
        first = self.document.surfaces[:1]
        opened = self.opened(first[0].name) if first and self._is_begun else None
        return None if opened is None else opened.surface

    def is_answered(self, panel: int) -> bool:
        """Whether a panel shows the final answer to its present question, be its accuracy known or not."""
        shown = self.shown.get(panel)
        return shown is not None and not shown.is_preview and shown.asked == questions(self.document)[panel]

    @property
    def is_complete(self) -> bool:
        """Whether every panel does, and it is known how accurate that is."""
        ids = [panel.id for panel in self.document.panels]
        return self.surface is not None and all(self.is_answered(id) and self.shown[id].answer.is_final for id in ids)

    # ------------------------------------------------------------------ opening
    def _found(self, mesh: MeshFile) -> Opened | None:
        return next((opened for opened in reversed(self._opened) if is_same(mesh, opened.mesh)), None)

    def _missing(self, document: Document) -> tuple[MeshFile, ...]:
        """Surfaces that have to be read; where any content will do, what the file holds now."""
        return tuple(mesh for mesh in document.surfaces if not mesh.sha256 or self._found(mesh) is None)

    def _start_opening(self, opening: _Opening) -> None:
        self._opening, self.is_stopped = opening, False
        self._loader.submit(opening)

    def _load(self, opening: _Opening, lane: Lane[_Opening]) -> None:
        # The first report comes before the reading, which has no others.
        report = lane.progress(lambda latest: latest is opening, quiet=0)
        found = []
        for k, mesh in enumerate(opening.meshes):
            report(k / len(opening.meshes), f"reading {os.path.basename(mesh.path)}")
            opened = open_mesh(mesh)
            report((k + 0.5) / len(opening.meshes), f"assembling {opened.surface.name}")
            opened.prepared = self._prepare(opened.surface)
            # Told by the view, for whose thread going over all faces would take too long.
            _ = opened.surface.remarks
            found.append(opened)
        report(1, "")
        self._post(lambda: self._loaded(opening, found))

    def _loaded(self, opening: _Opening, found: list[Opened]) -> None:
        if opening is not self._opening:
            return  # cancelled, or another mesh was asked for, while it was on its way here
        self._opening = None
        before = list(self._opened)
        self._opened += found
        try:
            self._present(opening.arrive)
        except BihdistError as error:  # a source that the mesh does not have
            self._opened = before
            self.view.failed(failure_in_words(error))
        else:
            opening.arrived()

    def _loading_failed(self, opening: _Opening, error: Exception) -> None:
        def tell() -> None:
            if opening is self._opening:
                self._opening = None
                self.view.failed(failure_in_words(error))

        self._post(tell)

    def _step(self, document: Document | None, step: Callable[[], Document]) -> None:
        if document is None:
            return
        self._opening = None  # a mesh on its way was a step not yet done
        if self._missing(document):
            self._start_opening(_Opening(self._missing(document), step))
        else:
            self._present(step)

    def _settled(self, document: Document) -> Document:
        """With the checksums of the surfaces that are there, and points where there is a vertex."""
        for mesh in document.surfaces:
            opened = self._found(mesh)
            if opened is not None:
                document = opened.settled(document)
        return document

    # ------------------------------------------------------------------ asking
    def _change(self, document: Document, key: str = "") -> None:
        """A step of the history; the first document that can be shown is its beginning."""
        document = self._settled(document)
        if not self._is_begun:
            self.history, self._is_begun = History(document), True
        else:
            self.history.change(document, key)

    def _present(self, change: Callable[[], object], live: bool = False) -> None:
        """Let the document change, tell the view, and ask what is new."""
        before = self.document
        change()
        self._forget()
        self.view.document_changed(before)
        self._ask(live)

    def _forget(self) -> None:
        """Surfaces that are no longer shown, the oldest first, and panels that are gone."""
        shown = [opened for opened in self._opened if any(is_same(m, opened.mesh) for m in self.document.surfaces)]
        others = [opened for opened in self._opened if opened not in shown]
        while others and sum(len(opened.surface.vertices) for opened in others) > SPARED:
            others.pop(0)
        self._opened = [*others, *shown]
        ids = {panel.id for panel in self.document.panels}
        for id in self._lanes.keys() - ids:
            self._lanes.pop(id).end()
            self.progress.pop(id, None)
        meshes = self.document.surfaces
        self.shown = {id: shown for id, shown in self.shown.items() if id in ids and shown.asked.mesh in meshes}

    def _ask(self, live: bool) -> None:
        asked = questions(self.document)
        for id, question in asked.items():
            opened = self._found(question.mesh)
            if opened is None:
                continue
            self._serial += 1
            shown = self.shown.get(id)
            if self.is_answered(id) and shown is not None and shown.answer.is_final:
                self._stop(id)
                continue
            known = self._kept.get(question)
            if known is not None:
                self._stop(id)
                self._show_answer(id, Shown(question, known, self._serial))
                continue
            self.is_stopped = False
            if id not in self._lanes:
                self._lanes[id] = self._new_lane(id)
            self._lanes[id].submit(_Request(question, opened, self._serial, live))
        for opened in self._opened:
            opened.keep(self.document.areas, {q.spec for q in asked.values() if is_same(q.mesh, opened.mesh)})

    def _stop(self, id: int) -> None:
        if id in self._lanes:
            self._lanes[id].submit(None)

    # ------------------------------------------------------------------ answering
    def _new_lane(self, id: int) -> "Lane[_Request]":
        return Lane(
            f"panel {id}",
            lambda request, lane: self._work(id, request, lane),
            self._reporter(id),
            lambda request, error: self._deliver(id, request, failed(str(request.question.spec), error)),
        )

    def _work(self, id: int, request: _Request, lane: Lane[_Request]) -> None:
        question, opened = request.question, request.opened

        def is_wanted(latest: _Request) -> bool:
            same = latest.question.is_about_the_same(question)
            return latest.question == question or (latest.live and same)

        known = self._kept.get(question)
        if known is not None:
            self._deliver(id, request, known)
            return
        # The source may move while the distance is made ready: then the next question has it.
        preparing = lane.progress(lambda latest: latest.question.is_about_the_same(question))
        asking = lane.progress(is_wanted)
        distances = opened.distances(question.areas)
        distances.get(question.spec, part(preparing, 0, 0.9))
        asking(0.9, str(question.spec))
        stand_in = distances.stand_in(question.spec)
        if stand_in is not None and self._preview(id, request, stand_in, preparing, asking) and request.live:
            return
        answer = opened.answer(question, asking, at_once=lambda first: self._deliver(id, request, first))
        self._kept.put(question, answer)
        self._deliver(id, request, answer)

    def _preview(self, id: int, request: _Request, stand_in: Spec, preparing: Progress, asking: Progress) -> bool:
        """Hand on what a quick distance answers; whether it did: its failure must not cost the answer."""
        question = replace(request.question, spec=stand_in)
        answer = self._kept.get(question)
        if answer is None:
            try:
                request.opened.distances(question.areas).get(stand_in, preparing)
            except (SolverError, MemoryError):
                return False
            answer = request.opened.answer(question, asking)
            self._kept.put(question, answer)
        if not answer.failure:
            self._deliver(id, request, answer, is_preview=True)
        return not answer.failure

    def _deliver(self, id: int, request: _Request, answer: Answer, is_preview: bool = False) -> None:
        """Hand an answer on, from any thread."""
        shown = Shown(request.question, answer, request.serial, is_preview)
        self._post(lambda: self._answered(id, shown, request.live))

    def _answered(self, id: int, new: Shown, live: bool) -> None:
        """Show an answer unless nobody asks for it any more, or something newer is shown."""
        now = questions(self.document).get(id)
        if now is None or not (new.asked == now or (live and new.asked.is_about_the_same(now))):
            return
        old = self.shown.get(id)
        if old is None or not old.asked.is_about_the_same(new.asked) or old.serial <= new.serial:
            self._show_answer(id, new)

    def _show_answer(self, id: int, new: Shown) -> None:
        old = self.shown.get(id)
        self.shown[id] = new
        same_field = old is not None and new.answer.field is not None and old.answer.field is new.answer.field
        if same_field and old is not None and old.is_preview == new.is_preview:
            self.view.certificate_changed(id)
        else:
            self.view.answer_changed(id)

    # ------------------------------------------------------------------ progress
    def _reporter(self, name: str | int) -> Callable[[float | None, str], None]:
        def report(fraction: float | None, text: str) -> None:
            def note() -> None:
                if fraction is None:
                    self.progress.pop(name, None)
                elif name == "load" or name in self._lanes:
                    self.progress[name] = (fraction, text)
                self.view.progress_changed()

            self._post(note)

        return report
