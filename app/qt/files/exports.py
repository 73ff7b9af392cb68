"""Files that are drawn in the background, charts among them, and the badge in the status bar with their progress."""

import os
import threading
import time
from collections.abc import Callable
from functools import partial

from qtpy import QtCore, QtWidgets

from bihdist_core import OutputError
from bihdist_core.file_output import check_output

from ...document.page import Page
from ...figures.worker import FigureJob
from ...scene.style import style_of
from ..context import Context
from ..look.form import in_row
from ..look.icons import put_icon
from ..look.theme import DARK, LIGHT, Theme, lightness
from .preview import PreviewRenderer
from .saving import ask_path

PATIENCE = 5.0
"""Seconds that closing waits for drawings to stop; what still goes on then stops by itself, without a file."""


class Export(QtCore.QObject):
    """A file that is being drawn; made by `Exports.start`.

    Attributes
    ----------
    path
        The path of the file.
    what
        "Movie" or "Figure".
    fraction
        The fraction that is done, from 0 to 1.
    words
        What is being done.
    """

    saved = QtCore.Signal(str)  # the path
    failed = QtCore.Signal(str)  # a sentence
    _progress = QtCore.Signal(float, str)
    _ended = QtCore.Signal(object)

    def __init__(self, work: Callable[..., object], path: str, what: str, exports: "Exports") -> None:
        super().__init__(exports)
        self.path, self.what = path, what
        self.fraction, self.words = 0.0, "starting…"
        self.is_stopping = False
        self._exports = exports
        self._progress.connect(self._go_on)
        self._ended.connect(self._end)
        self._line = _Line()
        self.destroyed.connect(self._line.cut)
        progress, ended = (partial(self._line.pass_on, signal) for signal in (self._progress, self._ended))
        self.job = FigureJob(work, progress, ended)

    @property
    def percent(self) -> int:
        """Return the progress in percent, 100 only at the end."""
        return int(100 * self.fraction)

    def _go_on(self, fraction: float, words: str) -> None:
        if not self.is_stopping:
            self.fraction, self.words = fraction, words or "writing the file…"
            self._exports.changed.emit()

    def _end(self, message: str | None) -> None:
        """Report the end: None if the file is there, "" if it was cancelled, otherwise why it could not be made."""
        if not self._exports.forget(self):
            return
        if message is None:
            self.saved.emit(self.path)
            self._exports.saved.emit(self.path)
        elif message:
            self.failed.emit(message)
            self._exports.failed.emit(message)
        self.deleteLater()


class Exports(QtCore.QObject):
    """The files that are being drawn, a process each.

    `saved` is emitted with a path, `failed` with a sentence; neither for a file that was cancelled.

    Attributes
    ----------
    running
        The exports, in the order of their starts.
    folder
        Where the last file went, "" at first.
    chosen
        The format and size that were chosen last, by what was drawn and the page it was to be on.
    previews
        The renderer of previews for dialogs, and of pictures for the clipboard.
    """

    changed = QtCore.Signal()
    saved = QtCore.Signal(str)
    failed = QtCore.Signal(str)

    def __init__(self, parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self.running: list[Export] = []
        self.folder = ""
        self.chosen: dict[tuple[str, Page], tuple[str, str]] = {}
        self.previews = PreviewRenderer(self)

    def start(self, work: Callable[..., object], path: str, what: str) -> Export:
        """Run `work(progress=...)`, whose result is the file at `path`.

        Raises OutputError while another one is drawn to that path, and where no process can be started.
        """
        name = os.path.basename(path)
        if any(_is_same(path, export.path) for export in self.running):
            raise OutputError(f"{name} is already being drawn; wait for it, cancel it, or choose another name.")
        try:
            export = Export(work, path, what, self)
        except OSError as error:
            raise OutputError(f"{name} cannot be drawn in the background: {error.strerror or error}.") from error
        self.folder = os.path.dirname(os.path.abspath(path))
        self.running.append(export)
        self.changed.emit()
        return export

    def cancel(self, export: Export) -> None:
        """Cancel the export, which ends once its process has noticed; a file at the path stays as it was."""
        if export in self.running:
            export.is_stopping, export.words = True, "stopping…"
            export.job.cancel()
            self.changed.emit()

    def close(self) -> None:
        """Cancel all exports, and wait until they have ended."""
        self.previews.close()
        for export in self.running:
            export.is_stopping = True
            export.job.cancel()
        end = time.monotonic() + PATIENCE
        for export in self.running:
            export.job.wait(max(0.0, end - time.monotonic()))
        self.running = []
        self.changed.emit()

    def forget(self, export: Export) -> bool:
        """Forget an export that has ended, and return False if it was forgotten before."""
        if export not in self.running:
            return False
        self.running.remove(export)
        self.changed.emit()
        return True


def _is_same(path: str, other: str) -> bool:
    return os.path.normcase(os.path.realpath(path)) == os.path.normcase(os.path.realpath(other))


class _Line:
    """Passes signals from the job's thread to the window, which may be gone before the job is."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._is_cut = False

    def cut(self) -> None:
        with self._lock:
            self._is_cut = True

    def pass_on(self, signal: QtCore.SignalInstance, *words: object) -> None:
        with self._lock:
            if not self._is_cut:
                signal.emit(*words)


# ---------------------------------------------------------------------- the badge
class ExportBadge(QtWidgets.QWidget):
    """A badge in the status bar: "Movie 34 %" with a bar and ✕, "2 exports, 40 %" with a menu; hidden when idle."""

    WIDEST = 220

    def __init__(self, exports: Exports, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._exports = exports
        self.setMaximumWidth(self.WIDEST)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Maximum, QtWidgets.QSizePolicy.Policy.Fixed)
        self.menu = QtWidgets.QMenu(self)
        self._listed: list[tuple[Export, QtWidgets.QAction]] = []
        self.share = QtWidgets.QToolButton(self, iconSize=QtCore.QSize(12, 12), styleSheet="padding: 1px 6px;")
        self.share.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        self.share.setProperty("keys", True)
        self.share.setLayoutDirection(QtCore.Qt.LayoutDirection.RightToLeft)  # the arrow stands after the words
        self.share.clicked.connect(self.open_menu)
        put_icon(self.share, "chevron", "quiet")
        self.bar = QtWidgets.QProgressBar(self, textVisible=False)
        self.bar.setFixedWidth(56)
        self.stop = QtWidgets.QToolButton(self, iconSize=QtCore.QSize(14, 14))
        self.stop.setFixedSize(22, 22)
        self.stop.clicked.connect(self._cancel_one)
        put_icon(self.stop, "close")
        in_row((self.share, 1), self.bar, self.stop, of=self, spacing=2)
        exports.changed.connect(self._show)
        self._show()

    def open_menu(self) -> None:
        """List the running exports, each as an entry that cancels it."""
        self._list()
        height = self.menu.sizeHint().height()
        self.menu.popup(self.mapToGlobal(QtCore.QPoint(0, -height - 2)))

    def _cancel_one(self) -> None:
        for export in self._exports.running[:1]:
            self._exports.cancel(export)

    def _show(self) -> None:
        running = self._exports.running
        self.setVisible(bool(running))
        if not running:
            self.menu.close()
            return
        words, percent = _summary(running)
        style = QtCore.Qt.ToolButtonStyle
        self.share.setText(words)
        self.share.setToolButtonStyle(style.ToolButtonTextOnly if len(running) == 1 else style.ToolButtonTextBesideIcon)
        self.bar.setValue(percent)
        self.stop.setVisible(len(running) == 1)
        self.stop.setEnabled(not running[0].is_stopping)
        self.stop.setToolTip(f"Cancel {running[0].what.lower()} {os.path.basename(running[0].path)}")
        self.stop.setAccessibleName(self.stop.toolTip())
        whole = "\n".join(f"{export.path}\n{export.words}" for export in running)
        self.share.setToolTip(whole)
        self.share.setAccessibleDescription(whole)
        if self.menu.isVisible():
            self._list()

    def _list(self) -> None:
        """Fill the menu; one that is open keeps its entries and updates their progress."""
        running = self._exports.running
        if [export for export, _ in self._listed] != running:
            self.menu.clear()
            self._listed = [(export, self.menu.addAction("")) for export in running]
            for export, action in self._listed:
                put_icon(action, "close")
                action.triggered.connect(lambda _=False, export=export: self._exports.cancel(export))
            if len(running) > 1:
                self.menu.addSeparator()
                self.menu.addAction("Cancel all", lambda: list(map(self._exports.cancel, running)))
        for export, action in self._listed:
            middle, name = QtCore.Qt.TextElideMode.ElideMiddle, os.path.basename(export.path)
            name = self.fontMetrics().elidedText(name, middle, 240)
            how_far = "stopping…" if export.is_stopping else f"{export.percent} %"
            # An ampersand in a name would underline the letter after it.
            action.setText(f"Cancel {export.what.lower()} {name}, {how_far}".replace("&", "&&"))
            action.setEnabled(not export.is_stopping)


def _summary(running: list[Export]) -> tuple[str, int]:
    """Return the text of the badge, and the percentage of its bar."""
    percent, first = int(100 * sum(export.fraction for export in running) / len(running)), running[0]
    # A figure space for each missing digit, so that the bar stays where it is.
    share = f"{percent:\u2007>2} %"
    if len(running) > 1:
        return f"{len(running)} exports, {share}", percent
    return f"{first.what}, cancelling…" if first.is_stopping else f"{first.what} {share}", percent


FORMATS = (".pdf", ".png", ".svg", ".eps")


def paper_theme(context: Context) -> Theme:
    """Return the theme that suits the background of a figure style."""
    style = style_of(context.page.style, context.document.colours)
    ground = "#" + "".join(f"{round(255 * x):02X}" for x in style.background)
    return LIGHT if lightness(ground) > 0.5 else DARK


def save_figure(
    context: Context, title: str, name: str, save: Callable[..., None], figure: Callable[[], object], path: str = ""
) -> None:
    """Save the chart of `figure()` in the background; asks for a path if none is given."""
    from ...figures.chart_page import draw_chart

    with context.errors_shown():
        shown = figure()
        path = path or ask_path(context, title, name, FORMATS)
        if path:
            check_output(path, FORMATS)
            context[Exports].start(partial(draw_chart, save, shown, path), path, "Figure")
