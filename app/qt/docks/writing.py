"""Files that are written in the background.  `window` is the main window."""

import sys
from collections.abc import Callable, Iterator
from typing import Any

from qtpy import QtCore

from bihdist_core import BihdistError
from bihdist_core.progress import Progress

from .background import Background
from .saving import ask_path, saved_words


class Writing(QtCore.QObject):
    """Asks where things go, and writes them in the background, one after the other."""

    def __init__(self, window: Any) -> None:
        super().__init__(window)
        self._window = window
        self._waiting: list[Callable[[], str]] = []  # the first of them is being written
        self._background = Background("writing", _done, window)
        self._background.answered.connect(self._say)
        self._background.failed.connect(self._refuse)
        window.closed.connect(self._finish)

    def save(
        self,
        title: str,
        name: str,
        formats: tuple[str, ...],
        write: Callable[[str], None],
        path: str,
        said: str = "",
    ) -> None:
        """path: asks for one if it is empty.  said: besides that it is written."""
        path = path or ask_path(self._window, title, name, formats)

        def work() -> str:
            write(path)
            return f"{saved_words(path)}{said}"

        if path:
            self._waiting.append(work)
            if len(self._waiting) == 1:
                self._write_next()

    def _write_next(self) -> None:
        self._background.ask((self._waiting[0],))

    def _finish(self) -> None:
        """The window has closed: what waits is written all the same; the first is being written."""
        for work in self._waiting[1:]:
            try:
                work()
            except (BihdistError, OSError) as error:
                print(f"bihdist: {error}", file=sys.stderr)
        self._waiting.clear()

    def _say(self, request: object, words: str) -> None:
        self._window.say(words)
        self._ended()

    def _refuse(self, request: object, sentence: str) -> None:
        self._window.failed(sentence)
        self._ended()

    def _ended(self) -> None:
        self._waiting.pop(0)
        if self._waiting:
            self._write_next()


def _done(request: tuple[Callable[[], object]], progress: Progress) -> Iterator[object]:
    yield request[0]()
