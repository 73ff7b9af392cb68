"""A dialog that asks, draws in the background with progress and Cancel, and closes when the file is there."""

import os
from collections.abc import Callable

from qtpy import QtCore, QtGui, QtWidgets

from ..figures.job import FigureJob


class JobDialog(QtWidgets.QDialog):
    """`saved` is emitted with the path, `failed` with a sentence.

    A class of its own for each kind of file puts rows into `rows` and starts the work in `export(path)`.
    """

    saved = QtCore.Signal(str)
    failed = QtCore.Signal(str)
    _progress = QtCore.Signal(float, str)
    _ended = QtCore.Signal(object)

    def __init__(self, title: str, name: str, files: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self._name, self._files = name, files
        self.job: FigureJob | None = None
        self._path = ""
        self._fill()
        self._progress.connect(self._show_progress)
        self._ended.connect(self._finish)

    def export(self, path: str) -> None:
        raise NotImplementedError

    def start(self, work: Callable[..., None], path: str) -> None:
        """Run the work, whose result is the file at `path`."""
        self._path = path
        self._set_busy(True)
        self.job = FigureJob(work, self._progress.emit, self._ended.emit)

    def reject(self) -> None:
        """Close; while something is drawn, stop that first."""
        if self.job:
            self.job.cancel()
        else:
            super().reject()

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        if self.job:
            self.job.cancel()
            self.job.wait(10)
        super().closeEvent(event)

    # ------------------------------------------------------------------ how it goes
    def _show_progress(self, fraction: float, text: str) -> None:
        self.bar.setValue(round(1000 * fraction))
        self.doing.setText(text)

    def _finish(self, message: str | None) -> None:
        self.job = None
        self._set_busy(False)
        if message is None:
            self.saved.emit(self._path)
            self.accept()
        elif message:
            self.failed.emit(message)

    def _set_busy(self, busy: bool) -> None:
        self.form.setEnabled(not busy)
        self.save.setEnabled(not busy)
        self.bar.setVisible(busy)
        self.doing.setVisible(busy)

    def _choose_path(self) -> None:
        path, chosen = QtWidgets.QFileDialog.getSaveFileName(self, self.windowTitle(), self._name, self._files)
        if path:
            extension = chosen[chosen.find("*") + 1 : chosen.find(")")]
            self.export(path if os.path.splitext(path)[1] else path + extension)

    # ------------------------------------------------------------------ how it is made
    def _fill(self) -> None:
        self.form = QtWidgets.QWidget()
        self.rows = QtWidgets.QFormLayout(self.form)
        self.rows.setContentsMargins(0, 0, 0, 0)
        self.bar = QtWidgets.QProgressBar(maximum=1000, textVisible=False, visible=False)
        self.doing = QtWidgets.QLabel("", visible=False)
        self.save = QtWidgets.QPushButton("Export …", default=True)
        self.save.clicked.connect(self._choose_path)
        cancel = QtWidgets.QPushButton("Cancel")
        cancel.clicked.connect(self.reject)
        buttons = QtWidgets.QHBoxLayout()
        buttons.addWidget(self.bar, 1)
        buttons.addWidget(self.doing)
        buttons.addStretch(0)
        buttons.addWidget(self.save)
        buttons.addWidget(cancel)
        layout = QtWidgets.QVBoxLayout(self)
        layout.addWidget(self.form)
        layout.addLayout(buttons)
