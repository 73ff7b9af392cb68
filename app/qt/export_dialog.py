"""The dialog of File > Export figure: how the figure shall be, and how far it is."""

import os
from dataclasses import replace

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError

from ..figure_export import check_export, figure_of
from ..figure_job import FigureJob
from ..recipe import Recipe
from ..style import STYLES

FILES = "PNG picture (*.png);;PDF with vector isolines (*.pdf);;SVG with vector isolines (*.svg)"
STYLE_NAMES = {
    "paper": "The paper's colours",
    "uniform": "Perceptually uniform",
    "lines": "Isolines only, black and white",
    "dark": "Dark, for slides",
}
VIEWS = {"As in the window": None, "Front and back": ("front", "back"), "Front": ("front",), "Home": ("home",)}


class ExportDialog(QtWidgets.QDialog):
    """Asks, draws in the background, and closes when the figure is there.

    recipe: what the window shows; answers: for each panel its field (n,), label and unit.  `saved` is emitted with
    the path, `failed` with a sentence.
    """

    saved = QtCore.Signal(str)
    failed = QtCore.Signal(str)
    _progress = QtCore.Signal(float, str)
    _ended = QtCore.Signal(object)

    def __init__(
        self, recipe: Recipe, surface, answers: list, version: str, parent: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Export figure")
        self._recipe, self._surface, self._answers, self._version = recipe, surface, answers, version
        self._job: FigureJob | None = None
        self._path = ""
        self.recipe: Recipe | None = None  # of the last export
        self._fill()
        self._progress.connect(self._show_progress)
        self._ended.connect(self._finish)

    def chosen(self) -> Recipe:
        """The recipe as the dialog stands."""
        views = VIEWS[self.view.currentText()]
        return replace(
            self._recipe,
            size=self.size_text.text().strip(),
            style=self.style_box.currentData(),
            columns=self.columns.value() or None,
            shared_range=self.shared.isChecked(),
            hints=self.hints.isChecked(),
            transparent=self.transparent.isChecked(),
            crop=self.crop.isChecked(),
            **({} if views is None else {"views": views}),
        )

    def export(self, path: str) -> None:
        """Start drawing to a path; a size that is none, or a path that cannot be written, is refused at once."""
        recipe = self.chosen()
        try:
            check_export(path)
            figure = figure_of(recipe, self._surface, self._answers)
        except BihdistError as error:
            self.failed.emit(str(error))
            return
        self._path, self.recipe = path, recipe
        self._set_busy(True)
        self._job = FigureJob(figure, recipe, path, self._version, self._progress.emit, self._ended.emit)

    def reject(self) -> None:
        """Close; while a figure is drawn, stop that first."""
        if self._job:
            self._job.cancel()
        else:
            super().reject()

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        if self._job:
            self._job.cancel()
            self._job.wait(10)
        super().closeEvent(event)

    # ------------------------------------------------------------------ how it goes
    def _show_progress(self, fraction: float, text: str) -> None:
        self.bar.setValue(round(1000 * fraction))
        self.doing.setText(text)

    def _finish(self, message: str | None) -> None:
        self._job = None
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
        name = os.path.splitext(os.path.basename(self._recipe.mesh))[0] or "figure"
        path, chosen = QtWidgets.QFileDialog.getSaveFileName(self, "Export figure", f"{name}.png", FILES)
        if path:
            extension = chosen[chosen.find("*") + 1 : chosen.find(")")]
            self.export(path if os.path.splitext(path)[1] else path + extension)

    # ------------------------------------------------------------------ how it is made
    def _fill(self) -> None:
        recipe = self._recipe
        self.form = QtWidgets.QWidget()
        rows = QtWidgets.QFormLayout(self.form)
        rows.setContentsMargins(0, 0, 0, 0)
        self.size_text = QtWidgets.QLineEdit(recipe.size)
        self.size_text.setPlaceholderText("1680x640, 8000px, 160mm@300dpi; empty: the usual")
        self.size_text.setMinimumWidth(330)
        self.style_box = QtWidgets.QComboBox()
        for word in STYLES:
            self.style_box.addItem(STYLE_NAMES.get(word, word), word)
        self.style_box.setCurrentIndex(max(self.style_box.findData(recipe.style), 0))
        self.view = QtWidgets.QComboBox()
        self.view.addItems(list(VIEWS))
        self.columns = QtWidgets.QSpinBox(maximum=12, specialValueText="all in one row")
        self.columns.setValue(recipe.columns or 0)
        self.shared = QtWidgets.QCheckBox("One colour bar for all panels", checked=recipe.shared_range)
        self.hints = QtWidgets.QCheckBox("What to look for, under the headings", checked=recipe.hints)
        self.transparent = QtWidgets.QCheckBox("Transparent background", checked=recipe.transparent)
        self.crop = QtWidgets.QCheckBox("Without the empty margins", checked=recipe.crop)
        for name, widget in [
            ("Size", self.size_text),
            ("Style", self.style_box),
            ("View", self.view),
            ("Columns", self.columns),
            ("", self.shared),
            ("", self.hints),
            ("", self.transparent),
            ("", self.crop),
        ]:
            rows.addRow(name, widget)
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
