"""The session: what is open, what is asked, and the answers as they come.  Knows no Qt and draws nothing.

Intents (`open`, `select_source`, `set_panel`, ...) are called on one thread, the window's.  Each panel has a lane of
its own, so that a click is answered at once by the panels that are ready while another still computes.  Answers come
back through `post`, which runs a function on the window's thread; an answer to a question no longer asked is dropped.
"""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol

import numpy as np

from bihdist_core import Distance, Laplacian, SolverError, Surface, read_surface
from bihdist_core.distances.kinds import Spec
from bihdist_core.distances.spectral import SpectralDistance
from bihdist_core.progress import Progress, part

from .answers import Answer, failure_in_words
from .lane import Lane
from .state import ViewerState


@dataclass(frozen=True, eq=False, kw_only=True)
class PanelAnswer(Answer):
    """A panel's answer from `source`; `preview` if a better one comes, `is_judged` if its certificate is there."""

    panel: Spec
    source: int | None
    preview: bool = False
    is_judged: bool = False


@dataclass(frozen=True, eq=False)
class _Opening:
    """A mesh to be opened, what is to be shown of it, and what to do once it is there."""

    path: str
    source: int | None
    areas: str
    panels: tuple[Spec, ...]
    arrived: Callable[[], None]


@dataclass(frozen=True, eq=False)
class _Question:
    """All that a lane needs to answer: nothing is read from the session while it works."""

    laplacian: Laplacian
    panel: Spec
    source: int | None


class _Distances:
    """The distance objects a panel has used on the mesh that is open."""

    def __init__(self) -> None:
        self._laplacian: Laplacian | None = None
        self._known: dict[Spec, Distance] = {}

    def get(self, laplacian: Laplacian, panel: Spec, progress: Progress) -> Distance:
        if laplacian is not self._laplacian:
            self._laplacian, self._known = laplacian, {}
        if panel not in self._known:
            distance = panel.build(laplacian, progress)
            if isinstance(distance, SpectralDistance):
                # A slider would leave one at every step; the eigenpairs themselves stay with the Laplacian.
                self._known = {p: d for p, d in self._known.items() if p.word != panel.word}
            self._known[panel] = distance
        return self._known[panel]


class View(Protocol):
    """What the session tells whoever shows it."""

    def mesh_changed(self) -> None: ...
    def source_changed(self) -> None: ...
    def answer_changed(self, index: int) -> None: ...
    def certificate_changed(self, index: int) -> None: ...
    def progress_changed(self) -> None: ...
    def failed(self, message: str) -> None: ...


class Session:
    """See the module.

    `post(function)` must run the function on the thread of the view, in order.  `prepare(surface)` runs in the
    background when a mesh is loaded, for what the view needs of it; its result is then in `prepared`.
    """

    def __init__(
        self,
        view: View,
        post: Callable[[Callable[[], None]], None],
        state: ViewerState | None = None,
        prepare: Callable[[Surface], Any] = lambda surface: None,
    ) -> None:
        self.view = view
        self.prepared: Any = None
        self.state = state or ViewerState()
        self.surface: Surface | None = None
        self.laplacian: Laplacian | None = None
        self.path: str | None = None
        self.answers: list[PanelAnswer | None] = [None for _ in self.state.panels]
        self.progress: dict[str, tuple[float, str]] = {}
        self.is_stopped = False
        self._post = post
        self._prepare = prepare
        self._opening: _Opening | None = None
        self._loader: Lane[_Opening] = Lane("load", self._load, self._reporter("load"), self._loading_failed)
        self._lanes: list[Lane[_Question]] = [
            Lane(f"panel {i}", self._answerer(i), self._reporter(f"panel {i}"), partial(self._answering_failed, i))
            for i in range(len(self.state.panels))
        ]

    # ------------------------------------------------------------------ intents
    def open(
        self,
        path: str,
        source: int | None = None,
        areas: str | None = None,
        panels: Sequence[Spec] = (),
        arrived: Callable[[], None] = lambda: None,
    ) -> None:
        """Load a mesh in the background; what is open stays as it is until the new one has been read.

        areas, panels: what is chosen with it, for as many panels as are given; arrived: called when it is shown.
        """
        self._opening = _Opening(os.fspath(path), source, areas or self.state.areas, tuple(panels), arrived)
        self._loader.submit(self._opening)

    def select_source(self, vertex: int) -> None:
        """Ask every panel for the distances from a vertex; VertexError if there is none."""
        if self.surface is None:
            return
        self.state = replace(self.state, source=self.surface.check_vertex(vertex))
        self.view.source_changed()
        self._ask_all()

    def set_panel(self, index: int, panel: Spec) -> None:
        """Show another distance, or the same with other parameters."""
        if panel != self.state.panels[index]:
            self.state = self.state.with_panel(index, panel)
            self._ask(index)

    def set_isolines(self, count: int) -> None:
        self.state = replace(self.state, isolines=count)

    def cancel(self) -> None:
        """Stop everything that is going on; the next click or change asks again."""
        self.is_stopped, self._opening = True, None
        for lane in (self._loader, *self._lanes):
            lane.submit(None)

    def close(self) -> None:
        for lane in (self._loader, *self._lanes):
            lane.close()

    # ------------------------------------------------------------------ what is known
    def is_answered(self, index: int) -> bool:
        """Whether a panel shows the final answer to the present question."""
        answer, asked = self.answers[index], (self.state.panels[index], self.state.source)
        return answer is not None and not answer.preview and (answer.panel, answer.source) == asked

    @property
    def is_complete(self) -> bool:
        """Whether every panel does, and it is known how accurate that is."""
        shown = range(len(self.answers))
        return self.surface is not None and all(self.is_answered(k) and self.answers[k].is_judged for k in shown)

    # ------------------------------------------------------------------ loading
    def _load(self, opening: _Opening, lane: Lane[_Opening]) -> None:
        # The first report comes before the reading, which has no others.
        report = lane.progress(lambda latest: latest is opening, quiet=0)
        report(0, f"reading {os.path.basename(opening.path)}")
        surface = read_surface(opening.path)
        laplacian = Laplacian(surface, opening.areas)
        report(0.5, f"assembling {surface.name}")
        source = surface.check_vertex(first_source(surface) if opening.source is None else opening.source)
        prepared = self._prepare(surface)
        # Told by the view, for whose thread going over all faces would take too long.
        _ = surface.remarks
        report(1, f"assembling {surface.name}")
        self._post(lambda: self._loaded(opening, laplacian, source, prepared))

    def _loaded(self, opening: _Opening, laplacian: Laplacian, source: int, prepared: Any) -> None:
        if opening is not self._opening:
            return  # cancelled, or another mesh was asked for, while it was on its way here
        self._opening, self.prepared = None, prepared
        self.path, self.laplacian, self.surface = opening.path, laplacian, laplacian.surface
        self.answers = [None for _ in self.state.panels]
        panels = (*opening.panels, *self.state.panels[len(opening.panels) :])[: len(self.state.panels)]
        self.state = replace(self.state, source=source, areas=opening.areas, panels=panels)
        self.view.mesh_changed()
        opening.arrived()
        self.view.source_changed()
        self._ask_all()

    def _loading_failed(self, opening: _Opening, error: Exception) -> None:
        self._post(lambda: self.view.failed(failure_in_words(error)))

    # ------------------------------------------------------------------ answering
    def _ask_all(self) -> None:
        for index in range(len(self._lanes)):
            self._ask(index)

    def _ask(self, index: int) -> None:
        if self.laplacian is not None:
            self.is_stopped = False
            self._lanes[index].submit(_Question(self.laplacian, self.state.panels[index], self.state.source))

    def _answerer(self, index: int) -> Callable[[_Question, Lane[_Question]], None]:
        distances = _Distances()

        def answer(question: _Question, lane: Lane[_Question]) -> None:
            preparing = lane.progress(
                lambda latest: latest.laplacian is question.laplacian and latest.panel == question.panel
            )
            asking = lane.progress(lambda latest: latest is question)
            distance = distances.get(question.laplacian, question.panel, part(preparing, 0, 0.9))
            # The source may have moved while the distance was made ready: then the next question has it.
            asking(0.9, distance.label)
            stand_in = question.panel.quick(distance)
            if stand_in is not None:
                try:
                    quick = distances.get(question.laplacian, stand_in, preparing)
                    self._deliver(index, question, quick, asking, preview=True)
                except (SolverError, MemoryError):
                    pass  # a stand-in that fails must not cost the answer
            self._deliver(index, question, distance, asking)

        return answer

    def _deliver(
        self, index: int, question: _Question, distance: Distance, progress: Progress, preview: bool = False
    ) -> None:
        field = distance.from_source(question.source, progress=progress)
        field.flags.writeable = False
        answer = PanelAnswer(
            panel=question.panel,
            source=question.source,
            field=field,
            label=distance.label,
            unit=distance.unit,
            preview=preview,
        )
        component = question.laplacian.component_of(question.source).index
        if distance.is_judged(component) and not preview:
            certified = replace(answer, certificate=distance.certificate([component]), is_judged=True)
            self._post(lambda: self._answered(index, question, certified))
            return
        self._post(lambda: self._answered(index, question, answer))
        if not preview:
            # The answer does not wait for it; a newer question does not either.
            progress(1.0, distance.label)
            certified = replace(answer, certificate=distance.certificate([component]), is_judged=True)
            self._post(lambda: self._certified(index, question, certified))

    def _answered(self, index: int, question: _Question, answer: PanelAnswer) -> None:
        asked = (self.laplacian, self.state.panels[index], self.state.source)
        if asked == (question.laplacian, answer.panel, answer.source):
            self.answers[index] = answer
            self.view.answer_changed(index)

    def _certified(self, index: int, question: _Question, answer: PanelAnswer) -> None:
        if self.laplacian is question.laplacian and self.is_answered(index):
            shown = self.answers[index]
            if (shown.panel, shown.source) == (answer.panel, answer.source):
                self.answers[index] = answer
                self.view.certificate_changed(index)

    def _answering_failed(self, index: int, question: _Question, error: Exception) -> None:
        """A panel says by itself what could not be done; the others go on."""
        answer = PanelAnswer(
            panel=question.panel,
            source=question.source,
            label=str(question.panel),
            failure=failure_in_words(error),
            is_judged=True,
        )
        self._post(lambda: self._answered(index, question, answer))

    # ------------------------------------------------------------------ progress
    def _reporter(self, name: str) -> Callable[[float | None, str], None]:
        def report(fraction: float | None, text: str) -> None:
            def note() -> None:
                if fraction is None:
                    self.progress.pop(name, None)
                else:
                    self.progress[name] = (fraction, text)
                self.view.progress_changed()

            self._post(note)

        return report


def first_source(surface: Surface) -> int:
    """Where to start: the highest vertex (along y) of the largest component."""
    ids = np.flatnonzero(surface.component_of_vertex == 0)
    return int(ids[surface.vertices[ids, 1].argmax()])
