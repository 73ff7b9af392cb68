"""The dialogs of File > Export figure and File > Export movie: how it shall be, and how far it is."""

import os
from dataclasses import replace
from functools import partial

from qtpy import QtWidgets

from bihdist_core import BihdistError, ParameterError
from bihdist_core.distances.answers import Answer

from ..document.document import MOST_PANELS
from ..document.page import Recipe
from ..drawing.style import STYLES
from ..figures.export import Surfaces, check_export, figure_of, write_figure
from ..figures.movie import Movie, check_movie, write_movie
from ..session.given import Given
from .job_dialog import JobDialog

FIGURE_FILES = "PNG picture (*.png);;PDF with vector isolines (*.pdf);;SVG with vector isolines (*.svg)"
MOVIE_FILES = "MP4 movie (*.mp4);;GIF (*.gif)"
STYLE_NAMES = {
    "paper": "The paper's colours",
    "uniform": "Perceptually uniform",
    "lines": "Isolines only, black and white",
    "dark": "Dark, for slides",
}
VIEWS = {"As in the window": None, "Front and back": ("front", "back"), "Front": ("front",), "Home": ("home",)}


class _Looks(JobDialog):
    """What figures and movies have in common: recipe is what the window shows."""

    def __init__(
        self, recipe: Recipe, title: str, extension: str, files: str, parent: QtWidgets.QWidget | None
    ) -> None:
        name = os.path.splitext(os.path.basename(recipe.document.surfaces[0].path))[0] or "figure"
        super().__init__(title, name + extension, files, parent)
        self._recipe = recipe
        self.size_text = QtWidgets.QLineEdit(recipe.page.size)
        self.size_text.setPlaceholderText("8000px, 160mm@300dpi; empty: usual")
        self.size_text.setMinimumWidth(330)
        self.style_box = QtWidgets.QComboBox()
        for word in STYLES:
            self.style_box.addItem(STYLE_NAMES.get(word, word), word)
        self.style_box.setCurrentIndex(max(self.style_box.findData(recipe.page.style), 0))
        self.columns = QtWidgets.QSpinBox(maximum=MOST_PANELS, specialValueText="all in one row")
        self.columns.setValue(recipe.page.columns or 0)
        self.shared = QtWidgets.QCheckBox("One colour bar for all panels", checked=recipe.document.shared_range)
        self.hints = QtWidgets.QCheckBox("What to look for, under the headings", checked=recipe.page.hints)
        for label, widget in [
            ("Size", self.size_text),
            ("Style", self.style_box),
            ("Columns", self.columns),
            ("", self.shared),
            ("", self.hints),
        ]:
            self.rows.addRow(label, widget)

    def chosen(self) -> Recipe:
        """The recipe as the dialog stands."""
        page = replace(
            self._recipe.page,
            size=self.size_text.text().strip(),
            style=self.style_box.currentData(),
            columns=self.columns.value() or None,
            hints=self.hints.isChecked(),
        )
        return replace(
            self._recipe, page=page, document=replace(self._recipe.document, shared_range=self.shared.isChecked())
        )


class ExportDialog(_Looks):
    """A figure of what the window shows; answers: one for each panel."""

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        given: Given,
        answers: list[Answer],
        version: str,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        super().__init__(recipe, "Export figure", ".png", FIGURE_FILES, parent)
        self._surfaces, self._given, self._answers, self._version = surfaces, given, answers, version
        self.view = QtWidgets.QComboBox()
        self.view.addItems(list(VIEWS))
        self.transparent = QtWidgets.QCheckBox("Transparent background", checked=recipe.page.transparent)
        self.crop = QtWidgets.QCheckBox("Without the empty margins", checked=recipe.page.crop)
        for label, widget in [("View", self.view), ("", self.transparent), ("", self.crop)]:
            self.rows.addRow(label, widget)

    def chosen(self) -> Recipe:
        views = VIEWS[self.view.currentText()]
        recipe = super().chosen()
        page = replace(recipe.page, transparent=self.transparent.isChecked(), crop=self.crop.isChecked())
        return replace(recipe, page=page if views is None else replace(page, views=views))

    def export(self, path: str) -> None:
        """Start drawing to a path; a size that is none, or a path that cannot be written, is refused at once."""
        recipe = self.chosen()
        try:
            check_export(recipe.document, path)
            figure = figure_of(recipe, self._surfaces, self._answers)
        except BihdistError as error:
            self.failed.emit(str(error))
            return
        self.start(partial(write_figure, figure, recipe, self._given, path, self._version), path)


class MovieDialog(_Looks):
    """A movie of what the window shows."""

    def __init__(self, recipe: Recipe, given: Given, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(recipe, "Export movie", ".mp4", MOVIE_FILES, parent)
        self._given = given
        self.size_text.setPlaceholderText("840x320, 1280px; empty: the usual")
        self.turn = QtWidgets.QSpinBox(minimum=-3600, maximum=3600, value=360, suffix="°")
        self.path_text = QtWidgets.QLineEdit()
        self.path_text.setPlaceholderText("ids such as 12,900; empty: it stays")
        self.frames = QtWidgets.QSpinBox(minimum=2, maximum=10_000, value=120)
        self.fps = QtWidgets.QSpinBox(minimum=1, maximum=50, value=25)
        for label, widget in [
            ("Turn by", self.turn),
            ("Source goes through", self.path_text),
            ("Frames", self.frames),
            ("Frames a second", self.fps),
        ]:
            self.rows.addRow(label, widget)

    def export(self, path: str) -> None:
        """Start drawing to a path; what makes no sense is refused at once."""
        try:
            check_movie(path)
            movie = Movie(self.chosen(), self.turn.value(), self._stops(), self.frames.value(), self.fps.value())
        except BihdistError as error:
            self.failed.emit(str(error))
            return
        self.start(partial(write_movie, movie, path, given=self._given), path)

    def _stops(self) -> tuple[int, ...]:
        text = self.path_text.text().strip()
        try:
            return tuple(int(word) for word in text.split(",")) if text else ()
        except ValueError:
            raise ParameterError(f"{text!r} is not vertex ids with commas between them.") from None
