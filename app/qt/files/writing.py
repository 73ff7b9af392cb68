"""Writing files in the background."""

import sys
from collections.abc import Callable

from qtpy import QtCore

from bihdist_core import BihdistError

from ..background import call
from ..context import Context
from .saving import ask_path, saved_words


class Writing(QtCore.QObject):
    """Asks for paths, and writes files in the background, one after the other."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._waiting: list[Callable[[], str]] = []  # the first of them is being written
        self._background = context.background("writing", call, self._say, self._refuse)
        context.closed.connect(self._finish)

    def save(
        self,
        title: str,
        name: str,
        formats: tuple[str, ...],
        write: Callable[[str], None],
        path: str,
        remark: str = "",
    ) -> None:
        """Write a file, asking for a path if none is given; `remark` is told besides."""
        path = path or ask_path(self._context, title, name, formats)

        def work() -> str:
            write(path)
            return f"{saved_words(path)}{remark}"

        if path:
            self._waiting.append(work)
            if len(self._waiting) == 1:
                self._write_next()

    def _write_next(self) -> None:
        self._background.ask((self._waiting[0],))

    def _finish(self) -> None:
        """Write what still waits, as the window has closed."""
        for work in self._waiting[1:]:
            try:
                work()
            except (BihdistError, OSError) as error:
                print(f"bihdist: {error}", file=sys.stderr)
        self._waiting.clear()

    def _say(self, request: object, words: str) -> None:
        self._context.tell(words)
        self._ended()

    def _refuse(self, request: object, sentence: str) -> None:
        self._context.fail(sentence)
        self._ended()

    def _ended(self) -> None:
        self._waiting.pop(0)
        if self._waiting:
            self._write_next()
