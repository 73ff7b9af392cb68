"""Where the surface is seen from: standard views, which way is up, and where the camera has been, back and forth.

`window` is the main window.
"""

from dataclasses import replace

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError

from ..document.camera import Camera, View
from ..document.camera_text import camera_text, read_camera
from ..document.document import Document
from ..document.edits import stand
from ..document.history import Trail
from .look.numbers import MINUS
from .preferences import save
from .remembered import remember_up

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

    def document_changed(self, before: Document, is_other: bool, is_raised: bool) -> None:
        """Let the camera see what the document says.  is_other: another mesh is there; is_raised: a relief changed."""
        window, document = self._window, self._window.session.document
        if window.remembers and not is_other and document.up != before.up:
            remember_up(document.surfaces[0].sha256, document.up)
        window.grid.show_axes(document.axes)
        is_stood_otherwise = (document.up, document.projection) != (before.up, before.projection)
        follows = document.camera == "source" and document.points != before.points
        if is_other or is_raised or is_stood_otherwise or follows or document.camera != before.camera:
            window.grid.turn_upright()
            window.grid.eye.look(document.camera)
            self.rest_soon()
        if document.up != before.up and isinstance(document.camera, Camera) and document.camera == before.camera:
            self.see("home")  # undone and done again it would be askew

    def moved(self, view: View) -> None:
        """The camera sees this now."""
        self._window.session.look(view)
        self._show_name()
        self._offer()
        self.rest_soon()

    def rest_soon(self) -> None:
        """The view is one to come back to, if the camera stays."""
        self._still.start()

    def see(self, view: View) -> None:
        """Let the camera see something else."""
        self._window.grid.eye.look(view)
        # From where the source is now; the view does not follow it about.
        self.moved(self._window.grid.eye.seen if view == "source" else view)

    def back(self) -> None:
        """Look from where one looked before."""
        self._remember()
        self._see_again(self._trail.back())

    def on(self) -> None:
        """Look from where one looked afterwards."""
        self._see_again(self._trail.on())

    # ------------------------------------------------------------------ what is chosen
    def show(self) -> None:
        """Let menus and buttons say what is chosen."""
        window, document = self._window, self._window.session.document
        self._show_name()
        window.tools["up"].show_value("" if document.up == "auto" else document.up.replace("-", MINUS))
        window.menus.show_choice(window.menus.up, document.up)
        for word, is_on in {
            "orthographic": document.projection == "orthographic",
            "axes": document.axes,
            "turntable": window.preferences.turntable,
        }.items():
            window.actions_by_word[word].setChecked(is_on)

    def stand(self, up: str) -> None:
        """Let an axis, such as "z" or "-z", point up."""
        self._window.session.show(stand(self._window.session.document, up), key="up")
        self.show()

    def next_up(self) -> None:
        """From y to z, from z to x, from x to y."""
        self.stand({"y": "z", "z": "x", "x": "y"}[self._window.session.document.up[-1]])

    def other_end_up(self) -> None:
        """What was up is down."""
        up = self._window.session.document.up
        self.stand(up[1:] if up.startswith("-") else f"-{up}")

    def project(self) -> None:
        """As the menu says: nothing gets smaller with distance, or in perspective."""
        session, is_on = self._window.session, self._window.actions_by_word["orthographic"].isChecked()
        session.show(replace(session.document, projection="orthographic" if is_on else "perspective"))

    def show_axes(self) -> None:
        """As the menu says."""
        session = self._window.session
        session.show(replace(session.document, axes=self._window.actions_by_word["axes"].isChecked()))

    def turn_upright(self) -> None:
        """As the menu says: as on a turntable, or freely."""
        window, is_on = self._window, self._window.actions_by_word["turntable"].isChecked()
        window.preferences = replace(window.preferences, turntable=is_on)
        if window.remembers:
            save(window.preferences)
        if window.grid is not None:
            window.grid.turn_upright(is_on)

    # ------------------------------------------------------------------ the camera as text
    def copy(self) -> None:
        """The camera, to the clipboard."""
        QtWidgets.QApplication.clipboard().setText(camera_text(self._window.grid.eye.seen))
        self._window.say("The camera is on the clipboard")

    def paste(self) -> None:
        """Look from where the camera on the clipboard looks, or say what there is instead."""
        try:
            view = read_camera(QtWidgets.QApplication.clipboard().text())
        except BihdistError as error:
            self._window.failed(str(error))
        else:
            self.see(view)

    # ------------------------------------------------------------------ where one has been
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

    def _show_name(self) -> None:
        """Let the button of views say what is seen."""
        camera = self._window.session.document.camera
        self._window.tools["views"].show_value(camera.capitalize() if isinstance(camera, str) else "Free")
