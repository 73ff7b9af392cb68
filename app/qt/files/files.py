"""What the window opens and writes, but for its session."""

import os
from collections.abc import Callable

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, OutputError
from bihdist_core.whole_file import check_output, whole_file

from ...document.file_names import file_name
from ..context import Context
from ..pages.messages import ask_which
from .curve_files import CurveFiles, is_curve
from .saving import MESH_FILES, ask_path
from .session_actions import FILES, SessionFile


class Files(QtCore.QObject):
    """Opening by a dialog or by a drop; pictures of the window, figures, movies and web pages."""

    dropping = QtCore.Signal(bool)  # whether something is held over the window that may be dropped

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        context.widget.setAcceptDrops(True)
        context.widget.installEventFilter(self)

    # ------------------------------------------------------------------ opening
    def choose(self) -> None:
        """Ask for a file, and open it."""
        self._ask("Open", FILES, self.open)

    def choose_beside(self) -> None:
        """A second mesh, beside the first."""
        self._ask("Open beside", MESH_FILES, self._context.session.open_beside)

    def _ask(self, title: str, files: str, take: Callable[[str], None]) -> None:
        context = self._context
        path, _ = QtWidgets.QFileDialog.getOpenFileName(context.widget, title, context.folder, files)
        if path:
            context.folder = os.path.dirname(path)
            take(path)

    def open(self, path: str) -> None:
        """A mesh, a session or recipe, or a curve for distances to start from."""
        if not path.lower().endswith(".json"):
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
    def export_figure(self) -> None:
        """Open the dialog of figures."""
        from .figure_actions import export_figure

        export_figure(self._context)

    def export_movie(self) -> None:
        """Open the dialog of movies."""
        from .figure_actions import export_movie

        export_movie(self._context)

    def export_page(self) -> None:
        """Open the dialog of web pages."""
        from .figure_actions import export_page

        export_page(self._context)

    def copy(self, what: str) -> None:
        """Copy the figure: "picture", or the line that makes it: "command", "python"."""
        from .figure_actions import copy

        copy(self._context, what)

    def choose_screenshot(self) -> None:
        """Ask for a file, and save a picture of the window there."""
        name = file_name([self._context.session.first_surface.name], "window")
        path = ask_path(self._context, "Save a picture of the window", name, (".png",))
        if path:
            try:
                self.save_screenshot(path)
            except BihdistError as error:
                self._context.fail(error)

    def save_screenshot(self, path: str) -> None:
        """The window as a PNG; OutputError if it cannot be written, and then what was there stays."""
        check_output(path, (".png",))
        if self._context.is_built:
            self._context.grid.draw_in_full()
        with whole_file(path) as temporary:
            if not self._context.widget.grab().toImage().save(str(temporary), "PNG"):
                raise OutputError(f"{path} could not be written.")
        self._context.tell(f"Saved {os.path.basename(path)}")
