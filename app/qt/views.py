"""Views of the surface: standard views, the axis that points up, and the history of the camera, back and forth."""

from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from ..document.camera import Camera, View
from ..document.camera_text import camera_text, read_camera
from ..document.document import Document
from ..document.history import NavigationHistory
from ..document.second_mesh_edits import set_up_axis
from .context import Context
from .remembered import remember_up

if TYPE_CHECKING:
    from .panels.camera_controller import CameraController

Cameras = tuple[tuple[str, View], ...]
"""The view of each surface, by its name in the document."""

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
        self._visited: NavigationHistory[Cameras] = NavigationHistory()
        self._still = QtCore.QTimer(self, singleShot=True, interval=STILL_MS, timeout=self._remember)

    def begin(self) -> None:
        """Start on another mesh."""
        self._visited = NavigationHistory()
        self._offer()

    def document_changed(self, before: Document, is_other: bool, is_raised: bool) -> None:
        """Set the cameras as the document has them.

        `is_other` says that another mesh is there, `is_raised` that the height field has changed.
        """
        context, document = self._context, self._context.document
        if context.remembers and not is_other and document.up != before.up:
            remember_up(document.surfaces[0].sha256, document.up)
        context.grid.show_axes(document.axes)
        context.grid.show_scale_bar(document)
        for controller in (controller for controller in context.grid.camera_controllers if controller.surface):
            camera, up = document.camera_of(controller.surface), document.up_of(controller.surface)
            old_camera, old_up = before.camera_of(controller.surface), before.up_of(controller.surface)
            is_stood_otherwise = (up, document.parallel_projection) != (old_up, before.parallel_projection)
            follows = camera == "source" and document.points != before.points
            if is_other or is_raised or is_stood_otherwise or follows or camera != old_camera:
                context.grid.turn_upright()
                controller.set_view(camera)
                self.remember_soon()
            if up != old_up and isinstance(camera, Camera) and camera == old_camera:
                self._set_view("auto", controller)  # undone and done again it would be askew

    def moved(self, view: View, surface: str) -> None:
        """Take what the camera of a surface sees now."""
        self._context.session.set_view(view, surface)
        self.changed.emit()
        self._offer()
        self.remember_soon()

    def remember_soon(self) -> None:
        """Remember the view, if the camera stays."""
        self._still.start()

    def set_view(self, view: View) -> None:
        """Let the camera see something else.

        Where two are linked, both see the same standard view, and move together to any other.
        """
        grid, document = self._context.grid, self._context.document
        controller = self._active_controller
        before = controller.known
        self._set_view(view, controller)
        for other in grid.camera_controllers if document.linked else ():
            if other is controller or not other.surface:
                continue
            if isinstance(view, str):
                self._set_view(view, other)
            elif before is not None:
                followed = other.follow(before, controller.seen)
                if followed is not None:
                    self.moved(followed, other.surface)
        grid.redraw()

    def reset(self, view: View = "auto") -> None:
        """See the surface from a standard view, or from where a camera is, if there is one."""
        if self._context.session.loaded() is not None:
            self.set_view(view)

    def _set_view(self, view: View, controller: "CameraController") -> None:
        view = controller.set_view(view)
        # From where the source is now; the view does not follow it about.
        self.moved(controller.seen if view == "source" else view, controller.surface)

    @property
    def _active_controller(self) -> "CameraController":
        """Return the camera of the active panel's surface."""
        grid = self._context.grid
        surfaces = {panel.id: panel.surface for panel in self._context.document.panels}
        return grid.controller_of(surfaces.get(grid.active, ""))

    def link(self) -> None:
        """Let two cameras move together from where they are, or each by itself."""
        is_linked = not self._context.document.linked
        self._context.session.set_fields(linked=is_linked)
        self._context.tell("Both cameras move together" if is_linked else "Each mesh is turned by itself")

    def back(self) -> None:
        """Look from where one looked before."""
        self._remember()
        self._return_to(self._visited.back())

    def on(self) -> None:
        """Look from where one looked afterwards."""
        self._return_to(self._visited.forward())

    # ------------------------------------------------------------------ what is chosen
    def set_up_axis(self, up: str) -> None:
        """Let an axis, such as "z" or "-z", point up."""
        session, name = self._context.session, self._surface
        session.show(set_up_axis(session.document, up, name or None), key=f"up of {name}")
        self._context.choice_changed.emit()

    @property
    def _surface(self) -> str:
        """The name of the active panel's surface, or of the first one before there are panels."""
        document = self._context.document
        if self._context.is_built:
            return self._active_controller.surface
        return document.surfaces[0].name if document.surfaces else ""

    @property
    def up(self) -> str:
        """Return which axis of the active panel's surface points up."""
        return self._context.document.up_of(self._surface)

    def next_up(self) -> None:
        """Let the next axis point up: z after y, x after z, y after x."""
        self.set_up_axis({"y": "z", "z": "x", "x": "y"}[self.up[-1]])

    def other_end_up(self) -> None:
        """Turn the up axis over."""
        up = self.up
        self.set_up_axis(up[1:] if up.startswith("-") else f"-{up}")

    # ------------------------------------------------------------------ the camera as text
    def copy(self) -> None:
        """Copy the camera to the clipboard."""
        self._context.copy(camera_text(self._active_controller.seen), "The camera is on the clipboard")

    def paste(self) -> None:
        """Look from where the camera on the clipboard looks, or say what there is instead."""
        with self._context.errors_shown():
            self.set_view(read_camera(QtWidgets.QApplication.clipboard().text()))

    # ------------------------------------------------------------------ where one has been
    def _remember(self) -> None:
        self._visited.visit(_cameras(self._context.document))
        self._offer()

    def _offer(self) -> None:
        """Enable the actions that go back and forward."""
        cameras, actions = _cameras(self._context.document), self._context.actions
        actions["view before"].setEnabled(not self._visited.is_first(cameras))
        actions["view after"].setEnabled(not self._visited.is_last(cameras))

    def _return_to(self, cameras: "Cameras | None") -> None:
        known = dict(cameras or ())
        for controller in self._context.grid.camera_controllers:
            if controller.surface in known:
                self._set_view(known[controller.surface], controller)

    @property
    def name(self) -> str:
        """The view of the active panel's surface, in a word."""
        camera = self._context.document.camera_of(self._surface)
        return camera.capitalize() if isinstance(camera, str) else "Free"


def _cameras(document: Document) -> Cameras:
    return tuple((mesh.name, document.camera_of(mesh.name)) for mesh in document.surfaces)
