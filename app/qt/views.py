"""Where the window's camera has been: back and forth among the views it rested at.  `window` is the main window."""

from qtpy import QtCore

from ..document.camera import View
from ..document.history import Trail

STILL_MS = 500
"""When the camera has not moved for so long, what is seen is a view that one can come back to."""


class Views:
    """The views of one mesh; their history is apart from the document's."""

    def __init__(self, window) -> None:
        self._window = window
        self._trail: Trail[View] = Trail()
        self._still = QtCore.QTimer(window, singleShot=True, interval=STILL_MS)
        self._still.timeout.connect(self._remember)

    def begin(self) -> None:
        """Another mesh is there."""
        self._trail = Trail()
        self._offer()

    def moved(self, view: View) -> None:
        """The camera sees this now."""
        self._window.session.look(view)
        self._window.choices.show_view()
        self._offer()
        self.rest_soon()

    def rest_soon(self) -> None:
        """The view is one to come back to, if the camera stays."""
        self._still.start()

    def see(self, view: View) -> None:
        """Let the camera see something else."""
        self._window.grid.look(view)
        self.moved(view)

    def back(self) -> None:
        """Look from where one looked before."""
        self._remember()
        self._see_again(self._trail.back())

    def on(self) -> None:
        """Look from where one looked afterwards."""
        self._see_again(self._trail.on())

    def _remember(self) -> None:
        self._trail.visit(self._window.session.document.camera)
        self._offer()

    def _offer(self) -> None:
        """What can be gone back to, and on."""
        camera, actions = self._window.session.document.camera, self._window.actions_by_word
        actions["view before"].setEnabled(not self._trail.is_first(camera))
        actions["view after"].setEnabled(not self._trail.is_last(camera))

    def _see_again(self, view: View | None) -> None:
        if view is not None:
            self.see(view)
