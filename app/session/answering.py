"""The answers of all panels: what is known is shown at once, the rest is worked on by lanes, one for each panel.

`ask` is called on the view's thread, and answers come back to it through `post`.
"""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Protocol

from bihdist_core import SolverError
from bihdist_core.distances.answers import Answer, failed
from bihdist_core.progress import Progress, part

from .latest_request_worker import LatestRequestWorker
from .loaded_mesh import LoadedMesh
from .questions import Question, are_about_the_same, are_alike

MUCH_LONGER, AT_LEAST = 4.0, 0.2
"""In a drag, an answer that takes so many times as long as the one before, and so many seconds, gives way to the next:
it waits for something that is made beside it, such as a longer flow of heat, and the others need not."""

REST = 0.2
"""Seconds for which a slider rests before long work for its value begins, of which something coarse is shown."""


class AnswerView(Protocol):
    """Who is told, on the view's thread, by the ids of the panels."""

    def answer_changed(self, panel: int) -> None:
        """Called when a panel has another answer."""

    def error_estimate_changed(self, panel: int) -> None:
        """Called when it becomes known how accurate a panel's answer is."""

    def progress_changed(self) -> None:
        """Called when work begins, goes on or ends."""


@dataclass(frozen=True, eq=False)
class Shown:
    """The answer that a panel shows, and its question.

    `question` is what the panel was asked; a preview answers a similar one sooner.
    """

    question: Question
    answer: Answer
    serial: int
    is_preview: bool = False


@dataclass(frozen=True, eq=False)
class _Request:
    """A question for the worker of a panel.

    While a drag goes on (`live`), a preview will do, and work on a similar question is finished before it.
    """

    question: Question
    loaded: LoadedMesh
    serial: int
    live: bool


class Answering:
    """Answers the questions of all panels, each on a worker of its own.

    Attributes
    ----------
    questions
        The question of each panel, by its id.
    shown
        What each panel shows.
    progress
        The progress of what is computed for a panel: the fraction done, and a text.
    stopped
        The panels for which the user has cancelled the last question.
    """

    def __init__(self, view: AnswerView, post: Callable[[Callable[[], None]], None]) -> None:
        self.shown: dict[int, Shown] = {}
        self.progress: dict[int, tuple[float, str]] = {}
        self.stopped: set[int] = set()
        self._view = view
        self._post = post
        self.questions: dict[int, Question] = {}
        self._kept = AnswerCache()
        self._serial = 0
        self._workers: dict[int, LatestRequestWorker[_Request]] = {}
        self._took: dict[int, float] = {}  # seconds, of what was answered last in a drag

    # ------------------------------------------------------------------ asking
    def ask(self, asked: Mapping[int, tuple[Question, LoadedMesh]], live: bool) -> None:
        """Ask the questions of all panels, each with its mesh; from now on no others are wanted.

        While a drag goes on (`live`), previews will do, and what is computed is shown even if it is late.
        """
        for id, (question, loaded) in asked.items():
            self._serial += 1
            self.stopped.discard(id)
            if self.is_answered(id) and self.shown[id].answer.is_final:
                # Asked anew: what is on its way from before is older.
                self.shown[id] = replace(self.shown[id], serial=self._serial)
                self._stop(id)
                continue
            known = self._kept.get(question)
            if known is not None:
                self._stop(id)
                self._show(id, Shown(question, known, self._serial))
                continue
            if id not in self._workers:
                self._workers[id] = self._new_worker(id)
            self._workers[id].submit(_Request(question, loaded, self._serial, live))

    def keep(self, question: Question, answer: Answer) -> None:
        """Keep an answer that was computed elsewhere, on any thread."""
        self._kept.put(question, answer)

    def expect(self, asked: dict[int, Question]) -> None:
        """Take the questions of all panels; what is shown of other panels or meshes is forgotten."""
        self.questions = asked
        for id in self._workers.keys() - asked.keys():
            self._workers.pop(id).end()
            self.progress.pop(id, None)
        self.stopped &= asked.keys()
        self.shown = {id: s for id, s in self.shown.items() if id in asked and s.question.mesh == asked[id].mesh}

    def is_answered(self, panel: int) -> bool:
        """Return whether a panel shows the final answer to its question, be its accuracy known or not."""
        return self._answers(panel) and not self.shown[panel].is_preview

    def is_preview(self, panel: int) -> bool:
        """Return whether a panel shows a preview of the answer to its question."""
        return self._answers(panel) and self.shown[panel].is_preview

    def _answers(self, panel: int) -> bool:
        shown = self.shown.get(panel)
        return shown is not None and shown.question == self.questions.get(panel)

    def cancel(self, panel: int | None = None) -> None:
        """Stop what is going on for a panel, for all if none is named; what is asked next is answered."""
        for id in self._workers if panel is None else {panel} & self._workers.keys():
            if not (self.is_answered(id) and self.shown[id].answer.is_final):
                self.stopped.add(id)
            self._stop(id)

    def end(self) -> None:
        """Stop everything, and soon the threads."""
        for worker in self._workers.values():
            worker.end()

    def close(self) -> None:
        """Stop everything, and wait for the threads."""
        for worker in self._workers.values():
            worker.close()

    def _stop(self, id: int) -> None:
        if id in self._workers:
            self._workers[id].submit(None)

    # ------------------------------------------------------------------ answering
    def _new_worker(self, id: int) -> "LatestRequestWorker[_Request]":
        return LatestRequestWorker(
            f"panel {id}",
            lambda request, worker: self._work(id, request, worker),
            self._reporter(id),
            lambda request, error: self._deliver(id, request, failed(str(request.question), error)),
            leaves=True,
        )

    def _work(self, id: int, request: _Request, worker: LatestRequestWorker[_Request]) -> None:
        question, loaded = request.question, request.loaded
        begun, took, is_live = time.monotonic(), self._took.get(id), request.live
        is_coarse_there = is_there = False

        def is_wanted(latest: _Request) -> bool:
            if latest.question == question:
                return True
            # Of a field that is there only the accuracy is to come, which is another for other parameters.
            alike = are_about_the_same if is_there else are_alike
            if not (latest.live and alike(latest.question, question)):
                return False
            if took is None or time.monotonic() - begun < max(MUCH_LONGER * took, AT_LEAST):
                return True
            # Were all to take as long, one of the next is waited for.
            self._took[id] = max(2 * took, AT_LEAST / MUCH_LONGER)
            return False

        def is_awaited(latest: _Request) -> bool:
            nonlocal is_live
            is_live = latest.live
            # The source may move while the distance is made ready: then the next question has it.
            if are_about_the_same(latest.question, question):
                return True
            is_short = not is_coarse_there and time.monotonic() - begun < AT_LEAST
            return latest.live and is_short and are_alike(latest.question, question)

        known = self._kept.get(question)
        if known is not None:
            self._deliver(id, request, known)
            return
        preparing = worker.progress(is_awaited)
        asking = worker.progress(is_wanted)
        distances = loaded.distances(question.areas)
        coarse = question.with_specs(tuple(distances.meanwhile(spec) or spec for spec in question.specs))
        if coarse != question:
            self._show_preview(id, request, coarse, preparing, asking)
            is_coarse_there = True
        preparing(0.0, str(question))
        while is_coarse_there and is_live and time.monotonic() < begun + REST:
            time.sleep(0.01)
            preparing(0.0, str(question))
        for spec in question.specs:
            distances.get(spec, part(preparing, 0, 0.9))
        asking(0.9, str(question))
        at_hand = question.is_at_hand(loaded)
        specs = tuple(distances.preview(spec) or spec for spec in question.specs)
        preview = question.with_specs(specs)
        if (
            preview != question
            and not at_hand
            and self._is_preview_wanted(request, preview, preparing)
            and self._show_preview(id, request, preview, preparing, asking)
            and request.live
        ):
            self._took[id] = time.monotonic() - begun
            return

        def deliver(first: Answer) -> None:
            nonlocal is_there
            is_there = True
            self._deliver(id, request, first)

        answer = question.answer(loaded, asking, deliver)
        self._kept.put(question, answer)
        self._deliver(id, request, answer)
        if request.live:
            self._took[id] = time.monotonic() - begun
        else:
            self._took.pop(id, None)

    def _is_preview_wanted(self, request: _Request, preview: Question, preparing: Progress) -> bool:
        """Return whether a preview comes first: in drags, where it is ready, and where the answer takes long."""
        distances = request.loaded.distances(preview.areas)
        if request.live or all(distances.is_ready(spec) for spec in preview.specs):
            return True
        return any(distances.get(spec).is_slow(preparing) for spec in request.question.specs)

    def _show_preview(
        self, id: int, request: _Request, question: Question, preparing: Progress, asking: Progress
    ) -> bool:
        """Deliver a preview and return whether there is one: its failure must not cost the answer."""
        answer = self._kept.get(question)
        if answer is None:
            try:
                for spec in question.specs:
                    request.loaded.distances(question.areas).get(spec, preparing)
            except (SolverError, MemoryError):
                return False
            # How accurate a stand-in is nobody asks.
            answer = question.answer(request.loaded, asking, lambda first: True)
            if answer.is_final:
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
        now = self.questions.get(id)
        # What was under way when the user stopped it may be done all the same.
        if now is None or id in self.stopped:
            return
        if new.question != now and not (live and are_alike(new.question, now)):
            return
        old = self.shown.get(id)
        if old is None or not are_alike(old.question, new.question) or old.serial <= new.serial:
            self._show(id, new)

    def _show(self, id: int, new: Shown) -> None:
        old = self.shown.get(id)
        self.shown[id] = new
        same_field = old is not None and new.answer.field is not None and old.answer.field is new.answer.field
        if same_field and old is not None and old.is_preview == new.is_preview:
            self._view.error_estimate_changed(id)
        else:
            self._view.answer_changed(id)

    # ------------------------------------------------------------------ progress
    def _reporter(self, id: int) -> Callable[[float | None, str], None]:
        def report(fraction: float | None, text: str) -> None:
            def note() -> None:
                if fraction is None:
                    self.progress.pop(id, None)
                elif id in self._workers:
                    self.progress[id] = (fraction, text)
                self._view.progress_changed()

            self._post(note)

        return report


MEMORY = 256_000_000
"""Bytes of fields that are kept: 320 of 100,000 vertices, 32 of a million."""

MOST = 250
"""Answers that are kept: of small meshes those before are found again sooner than anybody notices, while a session that
kept thousands would grow for hours."""


class AnswerCache:
    """The final answers given last, for any thread: what comes back, by undo or in another panel, costs nothing."""

    def __init__(self, memory: int = MEMORY) -> None:
        self._memory = memory
        self._bytes = 0
        self._answers: OrderedDict[Question, Answer] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, question: Question) -> Answer | None:
        """Return the answer to a question, None if it is not held."""
        with self._lock:
            if question in self._answers:
                self._answers.move_to_end(question)
            return self._answers.get(question)

    def put(self, question: Question, answer: Answer) -> None:
        """Keep an answer with a field or colours; those not asked for the longest go."""
        if not _size(answer):
            return
        with self._lock:
            old = self._answers.pop(question, None)
            self._bytes += _size(answer) - (0 if old is None else _size(old))
            self._answers[question] = answer
            while len(self._answers) > (MOST if self._bytes <= self._memory else 1):
                _, gone = self._answers.popitem(last=False)
                self._bytes -= _size(gone)


def _size(answer: Answer) -> int:
    """Bytes of its arrays."""
    return sum(each.nbytes for each in (answer.field, answer.colours, answer.leads_to) if each is not None)
