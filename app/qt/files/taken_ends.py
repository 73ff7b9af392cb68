"""Taking the ends of colour bars from a session or recipe, whose fields are computed in the background."""

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from bihdist_core.progress import Progress

from ..context import Context

if TYPE_CHECKING:
    from ...figures.colour_limits import ColourLimit

PATIENCE_MS = 400
"""Time before a progress dialog appears."""


class TakenEnds(QtCore.QObject):
    """Takes the ends of one file at a time; a later one replaces one that is still computed."""

    taken = QtCore.Signal(str)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._waiting: QtWidgets.QProgressDialog | None = None
        self._background = context.background("ends", _computed, self._take, self._refuse, self._show_progress)
        context.closed.connect(self._end_waiting)

    def take(self, path: str) -> None:
        """Let the colour bars end as in a file, as one step of the history, or tell why that is not possible."""
        self._end_waiting()
        words = f"Computing the fields of {os.path.basename(path)}…"
        self._waiting = QtWidgets.QProgressDialog(
            words, "Cancel", 0, 100, self._context.widget,
            windowTitle="Ranges", minimumDuration=PATIENCE_MS, autoClose=False, autoReset=False,
        )  # fmt: skip
        self._waiting.setCancelButton(QtWidgets.QPushButton("Cancel", autoDefault=False))
        self._waiting.canceled.connect(self.cancel)
        self._background.ask([path])

    def cancel(self) -> None:
        """Leave the ends as they are."""
        self._background.ask(None)
        self._end_waiting()

    def _show_progress(self, progress: tuple[float, str] | None) -> None:
        if self._waiting is not None and progress is not None:
            self._waiting.setValue(min(int(100 * progress[0]), 99))

    def _take(self, request: list[str], ends: "tuple[ColourLimit, ...]") -> None:
        from ...figures.colour_limits import with_limits_of

        self._end_waiting()
        context = self._context
        with context.errors_shown():
            document, sentence = with_limits_of(context.document, ends, os.path.basename(request[0]))
            context.session.show(document)
            context.tell(sentence)
            self.taken.emit(sentence)

    def _refuse(self, request: list[str], sentence: str) -> None:
        self._end_waiting()
        self._context.fail(sentence)

    def _end_waiting(self) -> None:
        waiting, self._waiting = self._waiting, None
        if waiting is not None:
            waiting.canceled.disconnect(self.cancel)
            waiting.close()
            waiting.deleteLater()


def _computed(request: list[str], progress: Progress) -> "Iterator[tuple[ColourLimit, ...]]":
    # Not when the window opens, which is before what draws is imported.
    from ...figures.colour_limits import limits_in

    yield limits_in(request[0], progress)
