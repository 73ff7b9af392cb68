"""Colour bars that end as in a session or recipe, whose fields are computed in the background."""

import os
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.progress import Progress

from ..background import Background
from ..context import Context

if TYPE_CHECKING:
    from ...figures.ends import End

PATIENCE_MS = 400
"""How long nothing is said of it."""


class TakenEnds(QtCore.QObject):
    """One file at a time: a later one takes the place of one that is still computed.  `taken` has a sentence."""

    taken = QtCore.Signal(str)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._waiting: QtWidgets.QProgressDialog | None = None
        context.closed.connect(self._end_waiting)

    @cached_property
    def _background(self) -> Background:
        made = self._context.background("ends", _computed)
        made.answered.connect(self._take)
        made.failed.connect(self._refuse)
        made.progressed.connect(self._show_progress)
        return made

    def take(self, path: str) -> None:
        """Let the colour bars end as there, as a step that can be undone, or say why not."""
        self._end_waiting()
        words = f"The fields of {os.path.basename(path)}…"
        self._waiting = QtWidgets.QProgressDialog(
            words, "Cancel", 0, 100, self._context.widget,
            windowTitle="Ranges", minimumDuration=PATIENCE_MS, autoClose=False, autoReset=False,
        )  # fmt: skip
        self._waiting.setCancelButton(QtWidgets.QPushButton("Cancel", autoDefault=False))
        self._waiting.canceled.connect(self.cancel)
        self._background.ask([path])

    def cancel(self) -> None:
        """The ends stay as they are."""
        self._background.ask(None)
        self._end_waiting()

    def _show_progress(self, progress: tuple[float, str] | None) -> None:
        if self._waiting is not None and progress is not None:
            self._waiting.setValue(min(int(100 * progress[0]), 99))

    def _take(self, request: list[str], ends: "tuple[End, ...]") -> None:
        from ...figures.ends import ended_as

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

    def _refuse(self, request: list[str], sentence: str) -> None:
        self._end_waiting()
        self._context.fail(sentence)

    def _end_waiting(self) -> None:
        waiting, self._waiting = self._waiting, None
        if waiting is not None:
            waiting.canceled.disconnect(self.cancel)
            waiting.close()
            waiting.deleteLater()


def _computed(request: list[str], progress: Progress) -> "Iterator[tuple[End, ...]]":
    # Not when the window opens, which is before what draws is imported.
    from ...figures.ends import ends_in

    yield ends_in(request[0], progress)
