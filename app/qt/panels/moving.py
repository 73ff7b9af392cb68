"""While the camera moves, and drawing takes too long for that, what stands in for large surfaces is drawn."""

from collections.abc import Callable, Sequence

from qtpy import QtCore

from .view import View

FLUENT = 0.06
"""Seconds that one picture of each panel may take together for a camera that follows the hand."""

REST_MS = 150
"""After the last move all is drawn, also if a button is still down."""


class Moving(QtCore.QObject):
    """views: asks for those that are shown.  fluent: see FLUENT."""

    def __init__(self, views: Callable[[], Sequence[View]], parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._views = views
        self.fluent = FLUENT
        self._timer = QtCore.QTimer(self, singleShot=True, interval=REST_MS, timeout=self.rest)

    def moved(self, rest_ms: int = REST_MS) -> None:
        """The user has moved the camera, or changed what all panels show; nothing has been drawn since.

        rest_ms: all is drawn so long after.
        """
        views = self._views()
        if any(view.scene.can_stand_in for view in views) and sum(view.scene.seconds for view in views) > self.fluent:
            for view in views:
                view.scene.show_stand_in(True)
            self._timer.start(rest_ms)

    def go_on(self) -> None:
        """The user is busy: what is to be drawn waits a little longer."""
        if self._timer.isActive():
            self._timer.start()

    def rest(self) -> None:
        """The camera is where it stays: draw all of it."""
        self._timer.stop()
        for view in self._views():
            view.draw_in_full()
