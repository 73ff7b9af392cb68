"""Perturbations that are asked of the session one after another."""

import time

from qtpy import QtCore

from bihdist_core.applications.changes import Perturbation

from ...qt.context import Context
from .perturbed_documents import perturb_mesh, perturbation_of

REQUEST_INTERVAL_MS = 60
"""Milliseconds between two requests while a slider moves."""

PATIENCE_S = 4.0
"""Seconds for which the last perturbation may go on before the next takes its place, so that some arrive while a
slider moves."""


class PerturbationRequests(QtCore.QObject):
    """Asks for the perturbation `wanted`, None once that is done; `lost` is emitted if it cannot be made."""

    lost = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.wanted: Perturbation | None = None
        self._key = ""
        self._mesh = ""
        self._asked, self._asked_at = Perturbation(), 0.0
        self._soon = QtCore.QTimer(self, singleShot=True, interval=REQUEST_INTERVAL_MS)
        self._soon.timeout.connect(self._ask)
        context.refused.connect(self._refused)

    def want(self, change: Perturbation, key: str = "", is_live: bool = False) -> None:
        """Ask for a perturbation, as a step of the history with the key; with `is_live`, more are to come."""
        self.wanted, self._key = change, key
        self._mesh = self._context.document.surfaces[0].sha256
        if not is_live:
            self._soon.stop()
            self._ask(at_once=True)
        elif not self._soon.isActive():
            self._soon.start()

    def forget(self) -> None:
        """Ask for nothing any more."""
        self.wanted = None
        self._soon.stop()

    def _ask(self, at_once: bool = False) -> None:
        session = self._context.session
        if self.wanted is None or session.document.surfaces[0].sha256 != self._mesh:
            self.forget()  # another mesh has been opened
            return
        if session.is_opening and not at_once and time.monotonic() - self._asked_at < PATIENCE_S:
            self._soon.start()
            return
        wanted, self.wanted = self.wanted, None
        if wanted == (self._asked if session.is_opening else perturbation_of(session.document)):
            return
        self._asked, self._asked_at = wanted, time.monotonic()
        session.apply(lambda document: perturb_mesh(document, wanted), self._key)

    def _refused(self, _: str) -> None:
        if self.wanted is None:
            self.lost.emit()
