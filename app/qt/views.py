"""Where the surface is seen from: standard views, which way is up, and where the camera has been, back and forth."""

from dataclasses import replace
from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError

from ..document.beside_edits import stand_beside
from ..document.camera import Camera, View
from ..document.camera_text import camera_text, read_camera
from ..document.document import Document
from ..document.edits import stand
from ..document.history import Trail
from .context import Context
from .remembered import remember_up

if TYPE_CHECKING:
    from .panels.eye import Eye

Cameras = tuple[tuple[str, View], ...]
"""From where each surface is seen, by its name in the document."""

STILL_MS = 500
"""When the camera has not moved for so long, what is seen is a view that one can come back to."""


class Views(QtCore.QObject):
    """The views of the meshes; their history is apart from the document's.

    What is chosen is meant for the surface of the active panel, and for the other as well where they are linked.
    """

    changed = QtCore.Signal()  # what is seen

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._trail: Trail[Cameras] = Trail()
        self._still = QtCore.QTimer(self, singleShot=True, interval=STILL_MS, timeout=self._remember)

    def begin(self) -> None:
        """Another mesh is there."""
        self._trail = Trail()
        self._offer()

    def document_changed(self, before: Document, is_other: bool, is_raised: bool) -> None:
        """Let the camera see what the document says.  is_other: another mesh is there; is_raised: the height is."""
        context, document = self._context, self._context.document
        if context.remembers and not is_other and document.up != before.up:
            remember_up(document.surfaces[0].sha256, document.up)
        context.grid.show_axes(document.axes)
        for eye in (eye for eye in context.grid.eyes if eye.surface):
            camera, up = document.camera_of(eye.surface), document.up_of(eye.surface)
            old_camera, old_up = before.camera_of(eye.surface), before.up_of(eye.surface)
            is_stood_otherwise = (up, document.projection) != (old_up, before.projection)
            follows = camera == "source" and document.points != before.points
            if is_other or is_raised or is_stood_otherwise or follows or camera != old_camera:
                context.grid.turn_upright()
                eye.look(camera)
                self.rest_soon()
            if up != old_up and isinstance(camera, Camera) and camera == old_camera:
                self._see("auto", eye)  # undone and done again it would be askew

    def moved(self, view: View, surface: str) -> None:
        """The camera of a surface sees this now."""
        self._context.session.look(view, surface)
        self.changed.emit()
        self._offer()
        self.rest_soon()

    def rest_soon(self) -> None:
        """The view is one to come back to, if the camera stays."""
        self._still.start()

    def see(self, view: View) -> None:
        """Let the camera see something else.

        Where two are linked, both see the same standard view, and move together to any other.
        """
        grid, document = self._context.grid, self._context.document
        eye = self._active_eye
        before = eye.known
        self._see(view, eye)
        for other in grid.eyes if document.linked else ():
            if other is eye or not other.surface:
                continue
            if isinstance(view, str):
                self._see(view, other)
            elif before is not None:
                followed = other.follow(before, eye.seen)
                if followed is not None:
                    self.moved(followed, other.surface)
        grid.redraw()

    def reset(self, view: View = "auto") -> None:
        """See the surface from a standard view, or from where a camera is, if there is one."""
        if self._context.session.surface is not None:
            self.see(view)

    def _see(self, view: View, eye: "Eye") -> None:
        view = eye.look(view)
        # From where the source is now; the view does not follow it about.
        self.moved(eye.seen if view == "source" else view, eye.surface)

    @property
    def _active_eye(self) -> "Eye":
        """That of the active panel's surface."""
        grid = self._context.grid
        surfaces = {panel.id: panel.surface for panel in self._context.document.panels}
        return grid.eye_of(surfaces.get(grid.active, ""))

    def link(self) -> None:
        """As the menu says: two cameras move together from where they are, or each for itself."""
        is_linked = self._context.actions["link"].isChecked()
        self._context.session.link(is_linked)
        self._context.tell("The two cameras move together" if is_linked else "Each mesh is turned for itself")

    def back(self) -> None:
        """Look from where one looked before."""
        self._remember()
        self._see_again(self._trail.back())

    def on(self) -> None:
        """Look from where one looked afterwards."""
        self._see_again(self._trail.on())

    # ------------------------------------------------------------------ what is chosen
    def stand(self, up: str) -> None:
        """Let an axis, such as "z" or "-z", point up."""
        session, name = self._context.session, self._surface
        document = session.document
        is_first = not document.surfaces or name == document.surfaces[0].name
        session.show(stand(document, up) if is_first else stand_beside(document, up, name), key=f"up of {name}")
        self._context.choice_changed.emit()

    @property
    def _surface(self) -> str:
        """That of the active panel, by its name in the document; before there are panels the first."""
        document = self._context.document
        if self._context.is_built:
            return self._active_eye.surface
        return document.surfaces[0].name if document.surfaces else ""

    @property
    def up(self) -> str:
        """Which axis of the active panel's surface points up."""
        return self._context.document.up_of(self._surface)

    def next_up(self) -> None:
        """From y to z, from z to x, from x to y."""
        self.stand({"y": "z", "z": "x", "x": "y"}[self.up[-1]])

    def other_end_up(self) -> None:
        """What was up is down."""
        up = self.up
        self.stand(up[1:] if up.startswith("-") else f"-{up}")

    def project(self) -> None:
        """As the menu says: nothing gets smaller with distance, or in perspective."""
        session, is_on = self._context.session, self._context.actions["orthographic"].isChecked()
        session.show(replace(session.document, projection="orthographic" if is_on else "perspective"))

    def show_axes(self) -> None:
        """As the menu says."""
        session = self._context.session
        session.show(replace(session.document, axes=self._context.actions["axes"].isChecked()))

    def turn_upright(self) -> None:
        """As the menu says: as on a turntable, or freely."""
        context, is_on = self._context, self._context.actions["turntable"].isChecked()
        context.prefer(turntable=is_on)
        if context.is_built:
            context.grid.turn_upright(is_on)

    # ------------------------------------------------------------------ the camera as text
    def copy(self) -> None:
        """The camera, to the clipboard."""
        QtWidgets.QApplication.clipboard().setText(camera_text(self._active_eye.seen))
        self._context.tell("The camera is on the clipboard")

    def paste(self) -> None:
        """Look from where the camera on the clipboard looks, or say what there is instead."""
        try:
            view = read_camera(QtWidgets.QApplication.clipboard().text())
        except BihdistError as error:
            self._context.fail(error)
        else:
            self.see(view)

    # ------------------------------------------------------------------ where one has been
    def _remember(self) -> None:
        self._trail.visit(_cameras(self._context.document))
        self._offer()

    def _offer(self) -> None:
        """What can be gone back to, and on."""
        cameras, actions = _cameras(self._context.document), self._context.actions
        actions["view before"].setEnabled(not self._trail.is_first(cameras))
        actions["view after"].setEnabled(not self._trail.is_last(cameras))

    def _see_again(self, cameras: "Cameras | None") -> None:
        known = dict(cameras or ())
        for eye in self._context.grid.eyes:
            if eye.surface in known:
                self._see(known[eye.surface], eye)

    @property
    def name(self) -> str:
        """What of the active panel's surface is seen, in a word."""
        camera = self._context.document.camera_of(self._surface)
        return camera.capitalize() if isinstance(camera, str) else "Free"


def _cameras(document: Document) -> Cameras:
    return tuple((mesh.name, document.camera_of(mesh.name)) for mesh in document.surfaces)
