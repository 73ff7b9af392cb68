"""The change to the mesh that is wanted now, asked of the session one after another."""

import time

from qtpy import QtCore

from bihdist_core.applications.changes import Perturbation

from ...qt.context import Context
from .comparison import change_as, change_mesh

SOON_MS = 60
"""Between two changes that are asked for while a slider moves."""

PATIENCE = 4.0
"""Seconds for which the last change may go on before the next takes its place: so some arrive while a slider moves."""


class ChangeAsking(QtCore.QObject):
    """wanted: what the controls say; None once that is asked for.  `lost` is emitted if a change cannot be made."""

    lost = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.wanted: Perturbation | None = None
        self._key = ""
        self._mesh = ""
        self._asked, self._asked_at = Perturbation(), 0.0
        self._soon = QtCore.QTimer(self, singleShot=True, interval=SOON_MS)
        self._soon.timeout.connect(self._ask)
        context.refused.connect(self._refused)

    @property
    def latest(self) -> Perturbation:
        """What is wanted, or what the document says."""
        return change_as(self._context.document) if self.wanted is None else self.wanted

    def want(self, change: Perturbation, key: str = "", is_live: bool = False) -> None:
        """key: of the step of the history; is_live: more is on its way."""
        self.wanted, self._key = change, key
        self._mesh = self._context.document.surfaces[0].sha256
        if not is_live:
            self._soon.stop()
            self._ask(at_once=True)
        elif not self._soon.isActive():
            self._soon.start()

    def forget(self) -> None:
        """Ask for no change any more."""
        self.wanted = None
        self._soon.stop()

    def _ask(self, at_once: bool = False) -> None:
        session = self._context.session
        if self.wanted is None or session.document.surfaces[0].sha256 != self._mesh:
            self.forget()  # another mesh has been opened
            return
        if session.is_opening and not at_once and time.monotonic() - self._asked_at < PATIENCE:
            self._soon.start()
            return
        wanted, self.wanted = self.wanted, None
        if wanted == (self._asked if session.is_opening else change_as(session.document)):
            return
        self._asked, self._asked_at = wanted, time.monotonic()
        session.apply(lambda document: change_mesh(document, wanted), self._key)

    def _refused(self, _: str) -> None:
        if self.wanted is None:
            self.lost.emit()
