"""Opening meshes and sessions, and writing what the window shows."""

import os

from qtpy import QtCore, QtGui

from bihdist_core import OutputError
from bihdist_core.file_output import atomic_write, check_output

from ...document.file_names import file_name
from ..context import Context
from ..pages.messages import ask_which
from .curve_files import CurveFiles, is_curve
from .field_files import FieldFiles
from .saving import MESH_FILES, ask_file, ask_path
from .session_actions import FILES, SessionFile


class Files(QtCore.QObject):
    """Opens files by a dialog or a drop, and saves pictures of the window."""

    dropping = QtCore.Signal(bool)  # whether something is held over the window that may be dropped

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        context.widget.setAcceptDrops(True)
        context.widget.installEventFilter(self)

    # ------------------------------------------------------------------ opening
    def choose(self) -> None:
        """Ask for a file, and open it."""
        ask_file(self._context, "Open", FILES, self.open)

    def choose_second_mesh(self) -> None:
        """Ask for a second mesh, and open it."""
        ask_file(self._context, "Open second mesh", MESH_FILES, self._context.session.open_second_mesh)

    def open(self, path: str) -> None:
        """Open a mesh, a session or recipe, a source curve, or a field."""
        if not path.lower().endswith(".json"):
            from bihdist_core.formats.vertex_arrays import is_vertex_array_file  # with the readers of all formats

            if is_vertex_array_file(path):
                self._context.once_built(lambda: self._context[FieldFiles].add(path))
            else:
                self._context.open(path)
        elif is_curve(path):
            self._context.once_built(lambda: self._context[CurveFiles].take(path))
        else:
            self._context.once_built(lambda: self._context[SessionFile].open(path))

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        kinds = QtCore.QEvent.Type
        if event.type() == kinds.DragEnter and event.mimeData().hasUrls():
            event.acceptProposedAction()
            self.dropping.emit(True)
        elif event.type() == kinds.DragLeave:
            self.dropping.emit(False)
        elif event.type() == kinds.Drop:
            self.dropping.emit(False)
            self._take(event)
        return bool(super().eventFilter(watched, event))

    def _take(self, drop: QtGui.QDropEvent) -> None:
        paths = [url.toLocalFile() for url in drop.mimeData().urls() if url.isLocalFile()]
        path = paths[0] if len(paths) == 1 else ask_which(self._context.widget, paths) if paths else None
        if path:
            self.open(path)

    # ------------------------------------------------------------------ writing
    def choose_screenshot(self) -> None:
        """Ask for a file, and save a picture of the window there."""
        name = file_name([self._context.session.mesh().surface.name], "window")
        path = ask_path(self._context, "Save a picture of the window", name, (".png",))
        if path:
            with self._context.errors_shown():
                self.save_screenshot(path)

    def save_screenshot(self, path: str) -> None:
        """Save the window as a PNG; OutputError if it cannot be written, in which case an old file stays."""
        check_output(path, (".png",))
        if self._context.is_built:
            self._context.grid.draw_in_full()
        with atomic_write(path) as temporary:
            if not self._context.widget.grab().toImage().save(str(temporary), "PNG"):
                raise OutputError(f"{path} could not be written.")
        self._context.tell(f"Saved {os.path.basename(path)}")
