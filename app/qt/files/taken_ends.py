"""Colour bars that end as in a session or recipe, whose fields are computed in the background."""

import os
from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.distances.answers import failure_in_words

from ...session.latest_request_worker import LatestRequestWorker
from ..context import Context

if TYPE_CHECKING:
    from ...figures.ends import End

PATIENCE_MS = 400
"""How long nothing is said of it."""


class TakenEnds(QtCore.QObject):
    """One file at a time: a later one takes the place of one that is still computed.  `taken` has a sentence."""

    taken = QtCore.Signal(str)
    _found = QtCore.Signal(object, object)
    _failed = QtCore.Signal(object, object)
    _progress = QtCore.Signal(object, str)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._worker: LatestRequestWorker[list[str]] | None = None
        self._wanted: list[str] | None = None  # one path, as an object of its own
        self._waiting: QtWidgets.QProgressDialog | None = None
        self._found.connect(self._take)
        self._failed.connect(self._refuse)
        self._progress.connect(self._show_progress)
        context.closed.connect(self._close)

    def take(self, path: str) -> None:
        """Let the colour bars end as there, as a step that can be undone, or say why not."""
        if self._worker is None:
            self._worker = LatestRequestWorker("ends", self._compute, self._progress.emit, self._failed.emit)
        self._end_waiting()
        self._wanted = [path]
        words = f"The fields of {os.path.basename(path)}…"
        self._waiting = QtWidgets.QProgressDialog(
            words, "Cancel", 0, 100, self._context.widget,
            windowTitle="Ranges", minimumDuration=PATIENCE_MS, autoClose=False, autoReset=False,
        )  # fmt: skip
        self._waiting.setCancelButton(QtWidgets.QPushButton("Cancel", autoDefault=False))
        self._waiting.canceled.connect(self.cancel)
        self._worker.submit(self._wanted)

    def cancel(self) -> None:
        """The ends stay as they are."""
        self._wanted = None
        if self._worker is not None:
            self._worker.submit(None)
        self._end_waiting()

    def _compute(self, request: list[str], worker: LatestRequestWorker[list[str]]) -> None:
        # Not when the window opens, which is before what draws is imported.
        from ...figures.ends import ends_in

        self._found.emit(request, ends_in(request[0], worker.progress(lambda latest: latest is request)))

    def _show_progress(self, fraction: float | None, words: str) -> None:
        if self._waiting is not None and fraction is not None:
            self._waiting.setValue(min(int(100 * fraction), 99))

    def _take(self, request: list[str], ends: "tuple[End, ...]") -> None:
        from ...figures.ends import ended_as

        if request is not self._wanted:
            return
        self._wanted = None
        self._end_waiting()
        context = self._context
        try:
            document, sentence = ended_as(context.document, ends, os.path.basename(request[0]))
        except BihdistError as error:
            context.fail(error)
            return
        context.edit(document)
        context.tell(sentence)
        self.taken.emit(sentence)

    def _refuse(self, request: list[str], error: Exception) -> None:
        if request is self._wanted:
            self._wanted = None
            self._end_waiting()
            self._context.fail(failure_in_words(error))

    def _end_waiting(self) -> None:
        waiting, self._waiting = self._waiting, None
        if waiting is not None:
            waiting.canceled.disconnect(self.cancel)
            waiting.close()
            waiting.deleteLater()

    def _close(self) -> None:
        self._wanted = None
        self._end_waiting()
        if self._worker is not None:
            self._worker.close()
