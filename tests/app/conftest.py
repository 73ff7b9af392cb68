"""A view without pictures, and a loop that runs what the session posts."""

import queue
import time

import pytest

from app.session import Session


class RecordingView:
    """Keeps what it is told."""

    def __init__(self):
        self.told, self.unexpected = [], []
        self.failures_are_expected = False

    def mesh_changed(self):
        self.told.append("mesh")

    def source_changed(self):
        self.told.append("source")

    def answer_changed(self, index):
        self.told.append(f"answer {index}")

    def certificate_changed(self, index):
        pass

    def progress_changed(self):
        pass

    def failed(self, message):
        self.told.append(message)
        if not self.failures_are_expected:
            self.unexpected.append(message)


class Desk:
    """A session with its view; `until` runs posted functions on this thread, as a window's event loop would."""

    def __init__(self, state=None, prepare=lambda surface: None):
        self.view = RecordingView()
        self.posted = queue.Queue()
        self.session = Session(self.view, self.posted.put, state, prepare)

    def until_told(self, words):
        """Wait until the view is told of a failure with these words."""
        self.view.failures_are_expected = True
        self.until(lambda: any(words in told for told in self.view.told))

    def until(self, condition, seconds=30):
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, f"waited in vain; told: {self.view.told}"
            assert not (failing := self.view.unexpected), f"refused: {failing}"
            try:
                self.posted.get(timeout=0.05)()
            except queue.Empty:
                continue

    def opened(self, path, source=None):
        self.session.open(path, source)
        self.until(lambda: self.session.is_complete)
        return self.session


@pytest.fixture
def desk():
    desks = []

    def make(*arguments, **options):
        desks.append(Desk(*arguments, **options))
        return desks[-1]

    yield make
    for each in desks:
        each.session.close()
