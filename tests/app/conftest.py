"""A view without pictures, and a loop that runs what the session posts."""

import queue
import time
from dataclasses import replace

import pytest

from app.document.document import COMPARISON, comparison
from app.document.edits import move_source, show_in
from app.session.session import Session
from tests.waiting import PATIENCE


class RecordingView:
    """Keeps what it is told."""

    def __init__(self):
        self.told, self.unexpected = [], []
        self.failures_are_expected = False

    def document_changed(self, before):
        self.told.append("document")

    def answer_changed(self, panel):
        self.told.append(f"answer {panel}")

    def error_estimate_changed(self, panel):
        pass

    def progress_changed(self):
        pass

    def failed(self, message):
        self.told.append(message)
        if not self.failures_are_expected:
            self.unexpected.append(message)


class Desk:
    """A session with its view; `until` runs posted functions on this thread, as a window's event loop would."""

    def __init__(self, specs=COMPARISON, prepare=lambda surface: None, document=None):
        self.specs = tuple(specs)
        self.view = RecordingView()
        self.posted = queue.Queue()
        self.post = self.posted.put
        self.session = Session(self.view, lambda function: self.post(function), prepare, document)

    def until_told(self, words):
        """Wait until the view is told of a failure with these words."""
        self.view.failures_are_expected = True
        self.until(lambda: any(words in told for told in self.view.told))

    def until(self, condition, seconds=PATIENCE):
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, f"waited in vain; told: {self.view.told}"
            assert not (failing := self.view.unexpected), f"refused: {failing}"
            try:
                self.posted.get(timeout=0.05)()
            except queue.Empty:
                continue

    def drain(self):
        """Run what is posted by now, and forget what the view was told."""
        while not self.posted.empty():
            self.posted.get()()
        self.view.told.clear()

    def complete(self):
        self.until(lambda: self.session.is_complete)
        return self.session

    def show(self, path, source=None):
        """Ask for a mesh with the desk's distances, and do not wait."""
        self.session.show(comparison(path, self.specs, (source,)))

    def loaded(self, path, source=None):
        self.show(path, source)
        return self.complete()

    def click(self, vertex, panel=0, **options):
        """A source, as a click chooses it."""
        self.session.show(move_source(self.session.document, panel, vertex), **options)

    def choose(self, panel, spec, **options):
        """Another distance in a panel, from the same point."""
        shows = self.session.document.panel(panel).shows
        self.session.show(show_in(self.session.document, panel, replace(shows, spec=spec)), **options)

    def post_later(self):
        """From now on what the session posts is kept: the list, and what to post through to let things go on."""
        kept = []
        self.post, after = kept.append, self.post
        return kept, after

    def hold_reading(self, ask):
        """Ask for a mesh and read it, but keep it back; what is returned lets it come."""
        kept, after = self.post_later()
        ask()
        # What was posted has a mesh with it.
        self.until(lambda: any("_take" in function.__code__.co_names for function in kept))
        self.post = after
        return lambda: [function() for function in kept]

    @property
    def source(self):
        return self.session.document.point("source").at

    @property
    def answers(self):
        """In the order of the panels; None where there is none yet."""
        shown = self.session.shown
        return [shown[p.id].answer if p.id in shown else None for p in self.session.document.panels]

    @property
    def sources_shown(self):
        shown = self.session.shown
        return [shown[p.id].question.at if p.id in shown else None for p in self.session.document.panels]


@pytest.fixture
def desk():
    desks = []

    def make(*arguments, **options):
        desks.append(Desk(*arguments, **options))
        return desks[-1]

    yield make
    for each in desks:
        each.session.close()
