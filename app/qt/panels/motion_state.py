"""While the camera moves, and drawing takes too long for that, what stands in for large surfaces is drawn."""

from collections.abc import Callable, Sequence

from qtpy import QtCore

from .view import View

FLUENT = 0.06
"""Seconds that one picture of each panel may take together for a camera that follows the hand."""

REST_MS = 150
"""After the last move all is drawn, also if a button is still down."""


class MotionState(QtCore.QObject):
    """Whether the camera moves.

    Attributes
    ----------
    fluent
        Seconds for one picture of each panel, see FLUENT.
    """

    def __init__(self, views: Callable[[], Sequence[View]], parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self._views = views
        self.fluent = FLUENT
        self._timer = QtCore.QTimer(self, singleShot=True, interval=REST_MS, timeout=self.stop)

    def moved(self, rest_ms: int = REST_MS) -> None:
        """Draw stand-ins, if need be, as the camera or all panels have changed, and everything a while later."""
        views = self._views()
        has_stand_in = any(view.scene.field_actor.stand_in.stand_in is not None for view in views)
        if has_stand_in and sum(view.scene.seconds for view in views) > self.fluent:
            for view in views:
                view.scene.field_actor.show_stand_in(True)
            self._timer.start(rest_ms)

    def postpone(self) -> None:
        """Wait a little longer with drawing everything: the user is busy."""
        if self._timer.isActive():
            self._timer.start()

    def stop(self) -> None:
        """Draw everything: the camera stays where it is."""
        self._timer.stop()
        for view in self._views():
            view.draw_in_full()
