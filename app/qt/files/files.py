"""What the window opens and writes, but for its session.  `window` is the main window."""

import os
from dataclasses import replace

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, OutputError
from bihdist_core.whole_file import check_output, whole_file

from ...document.file_names import file_name
from ..docks.saving import MESH_FILES, ask_path
from ..pages.messages import ask_which
from .curve_files import is_curve
from .session_actions import FILES


class Files(QtCore.QObject):
    """Opening by a dialog or by a drop; pictures of the window, figures and movies."""

    def __init__(self, window) -> None:
        super().__init__(window)
        self._window = window
        window.setAcceptDrops(True)
        window.installEventFilter(self)

    # ------------------------------------------------------------------ opening
    def choose(self) -> None:
        window = self._window
        path, _ = QtWidgets.QFileDialog.getOpenFileName(window, "Open", window.preferences.last_folder, FILES)
        if path:
            window.preferences = replace(window.preferences, last_folder=os.path.dirname(path))
            self.open(path)

    def choose_beside(self) -> None:
        """A second mesh, beside the first."""
        window = self._window
        path, _ = QtWidgets.QFileDialog.getOpenFileName(
            window, "Open beside", window.preferences.last_folder, MESH_FILES
        )
        if path:
            window.preferences = replace(window.preferences, last_folder=os.path.dirname(path))
            window.session.open_beside(path)

    def open(self, path: str) -> None:
        """A mesh, a session or recipe, or a curve for distances to start from."""
        if not path.lower().endswith(".json"):
            self._window.open(path)
        elif is_curve(path):
            self._window.once_built(lambda: self._window.curve_files.take(path))
        else:
            self._window.once_built(lambda: self._window.session_file.open(path))

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        kinds = QtCore.QEvent.Type
        if event.type() == kinds.DragEnter and event.mimeData().hasUrls():
            event.acceptProposedAction()
            self._window.show_dropping(True)
        elif event.type() == kinds.DragLeave:
            self._window.show_dropping(False)
        elif event.type() == kinds.Drop:
            self._window.show_dropping(False)
            self._take(event)
        return super().eventFilter(watched, event)

    def _take(self, drop: QtGui.QDropEvent) -> None:
        paths = [url.toLocalFile() for url in drop.mimeData().urls() if url.isLocalFile()]
        path = paths[0] if len(paths) == 1 else ask_which(self._window, paths) if paths else None
        if path:
            self.open(path)

    # ------------------------------------------------------------------ writing
    def export_figure(self) -> None:
        from .figure_actions import export_figure

        export_figure(self._window)

    def export_movie(self) -> None:
        from .figure_actions import export_movie

        export_movie(self._window)

    def copy(self, what: str) -> None:
        """Copy the figure: "picture", or the line that makes it: "command", "python"."""
        from .figure_actions import copy

        copy(self._window, what)

    def choose_screenshot(self) -> None:
        name = file_name([self._window.session.surface.name], "window")
        path = ask_path(self._window, "Save a picture of the window", name, (".png",))
        if path:
            try:
                self.save_screenshot(path)
            except BihdistError as error:
                self._window.failed(str(error))

    def save_screenshot(self, path: str) -> None:
        """The window as a PNG; OutputError if it cannot be written, and then what was there stays."""
        check_output(path, (".png",))
        if self._window.grid is not None:
            self._window.grid.draw_in_full()
        with whole_file(path) as temporary:
            if not self._window.grab().toImage().save(str(temporary), "PNG"):
                raise OutputError(f"{path} could not be written.")
        self._window.say(f"Saved {os.path.basename(path)}")
