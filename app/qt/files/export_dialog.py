"""The dialog of File > Export figure, with a preview."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.distances.answers import Answer

from ...document.page import FORMATS, Recipe
from ...document.shared_parts.pins import Pins
from ...figures.description import Figure
from ...figures.draw import FIGURE_FORMATS, Preview, preview
from ...figures.export import Surfaces, check_export, figure_of, write_figure
from ...figures.look_options import suits_one_bar
from ...figures.size import NAMED, is_column
from ...version import version
from ..context import Context
from ..look.form import Choice, quiet_label
from ..look.icons import put_icon
from .job_dialog import FileKind
from .looks_dialog import LooksDialog
from .preview import PreviewPane
from .size_boxes import SizeNames, in_words

KINDS = (
    FileKind(".png", "PNG", "PNG picture"),
    FileKind(".pdf", "PDF", "PDF with vector isolines"),
    FileKind(".svg", "SVG", "SVG with vector isolines"),
    FileKind(".eps", "EPS", "EPS with vector isolines"),
)
FIGURE_KINDS = tuple(kind for kind in KINDS if kind.extension in FIGURE_FORMATS)
SIZE_NAMES = {"column": "One column", "double": "Two columns", "slide": "Slide", "A0": "Poster A0"}
FIGURE_SIZES: SizeNames = (
    ("Default", "", "follows the panels"),
    *((SIZE_NAMES.get(word, word), word, in_words(word)) for word in NAMED),
)
NAMES = {"heading": "Above the panels", "caption": "Below the panels", "none": "None"}
"""Where a panel's name is written."""

KINDS_OF_ROW = {
    "": "Automatic",
    "source": "Sources",
    "mesh": "Meshes",
    "distance": "Distances",
    "t": "Times t",
    "alpha": "Powers α",
    "k": "Numbers k of eigenpairs",
    "method": "Methods",
}
"""What has a row each."""

CHARTS = {"": "None", "profile": "Profile", "scatter": "Scatter", "histogram": "Histogram", "errors": "Errors of maps"}
"""At the end of rows."""

BOTH = ("front", "back")
SMALLEST = {True: 6.0, False: 10.0}
"""Font size, in points in print and else in pixels, below which text is hard to read."""

WAIT = 120
"""Milliseconds from the last change to the preview, as the user may go on typing."""


class _LetterBox(QtWidgets.QDoubleSpinBox):
    """A size with a decimal point, as everywhere in the program, whatever the desktop's; a comma is understood."""

    def __init__(self, **properties: object) -> None:
        super().__init__(locale=QtCore.QLocale.c(), **properties)

    def validate(self, text: str, at: int) -> tuple[Any, str, int]:
        state, text, at = super().validate(text.replace(",", "."), at)
        return state, text, at

    def valueFromText(self, text: str) -> float:
        return float(super().valueFromText(text.replace(",", ".")))


class ExportDialog(LooksDialog):
    """A dialog for a figure of what the window shows, with an answer for each panel.

    `copying` is emitted with "picture", "command" or "python", and the recipe.
    """

    what, file_kinds, sizes = "Figure", FIGURE_KINDS, FIGURE_SIZES
    copying = QtCore.Signal(str, object)

    def __init__(self, context: Context, recipe: Recipe, surfaces: Surfaces, answers: list[Answer]) -> None:
        self.pane = PreviewPane()
        super().__init__(context, recipe, surfaces, self.pane)
        self._answers = answers
        self.kinds.choose((recipe.page.format or FORMATS[0]).upper())
        self.form.section("Show")
        self.names = Choice(NAMES, recipe.page.title)
        self.form.row("&Names", self.names, "Where the name of each panel stands", "title")
        tip = "What each row has of its own; rows and columns then have headings"
        self.form.row("&Rows", Choice(KINDS_OF_ROW, recipe.page.rows), tip, "rows")
        self.form.row("Ch&art", Choice(CHARTS, recipe.page.chart), "A chart at the end of each row", "chart")
        self.add_shares()
        self.both = self.form.tick("&Front and back", recipe.page.views == BOTH, "Each panel from both sides")
        tip = "Lateral and medial views of each hemisphere of a brain"
        self.hemispheres = self.form.tick("&Hemispheres", recipe.page.layout == "hemispheres", tip)
        page = recipe.page
        tip = "Transparent where nothing is drawn"
        self.transparent = self.form.tick("Transparent &background", page.transparent, tip, "transparent")
        self.form.tick("&Ground", page.ground, "A soft shadow on the ground beneath the shape", "ground")
        tip = "Thin lines along sharp edges; the style Cover always has them"
        self.form.tick("Shar&p edges", page.feature_edges, tip, "feature_edges")
        self.crop = self.form.tick("Crop the &margins", page.crop, "Crop to what is drawn", "crop")
        self.form.tick("Panels (a), (b), (c)", page.panel_letters, "(a), (b), (c) over the panels", "panel_letters")
        self.values: QtWidgets.QCheckBox | None = None
        if any(part.has_values for part in recipe.document.parts):
            tip = "The number beside each anchor"
            self.values = self.form.tick("&Values at anchors", page.anchor_values, tip, "anchor_values")
        if any(pin.name for pin in recipe.document[Pins].pins):
            self.form.tick("Names of pins", page.pin_names, "Names of pins in place of their numbers", "pin_names")
        self.form.section("Look")
        self.add_look()
        self.letters = _LetterBox(decimals=1, maximum=72, singleStep=0.5, suffix=" pt")
        self.letters.setSpecialValueText("Automatic")
        self.letters.setButtonSymbols(QtWidgets.QAbstractSpinBox.ButtonSymbols.NoButtons)
        self.letters.setValue(recipe.page.font_size or 0.0)
        self.form.row("&Text", self.letters, "Size of labels in points, other text in proportion; 0 for automatic")
        self.size.rows.idClicked.connect(self._suit_size)
        self._add_copying()
        self._number, self._asked = 0, set[int]()
        self._soon = QtCore.QTimer(self, singleShot=True, interval=WAIT, timeout=self._draw)
        self._exports.previews.answered.connect(self._show_preview)
        self._exports.previews.refused.connect(self._show_refusal)
        self.pane.resized.connect(self._soon.start)
        self.form.changed.connect(self._changed)

    def chosen(self) -> Recipe:
        recipe = super().chosen()
        views = recipe.page.views
        if self.both.isChecked() != (views == BOTH):
            views = BOTH if self.both.isChecked() else ()
        layout = "hemispheres" if self.hemispheres.isChecked() else ""
        page = replace(
            recipe.page, views=views, layout=layout, font_size=self._font_size(), format=self.kinds.choice().lower()
        )
        return replace(recipe, page=page)

    def beside_kinds(self) -> list[QtWidgets.QWidget]:
        recipe = quiet_label("with its recipe")
        recipe.setToolTip("A .json file beside the figure, which opens in the window and redraws the figure")
        return [recipe]

    def _font_size(self) -> float | None:
        """Return the font size, unrounded where the user has not changed it."""
        value, was = self.letters.value(), self._recipe.page.font_size
        if was is not None and abs(value - was) < 0.05:
            return was
        return max(value, 2.0) if value else None

    def _suit_size(self, *_: object) -> None:
        """Crop a figure of one column, and let its panels share a bar; reset both for others."""
        is_one = is_column(self.size.text())
        has_one_bar = is_one and suits_one_bar(self._recipe)
        if has_one_bar and self._recipe.document.range == "own":
            self.allow_sharing(False)
        self.crop.setChecked(is_one or self._recipe.page.crop)
        self.shared.setChecked(has_one_bar or self._recipe.document.range != "own")

    def check(self) -> None:
        self.check_size(self.chosen())

    def work(self, path: str) -> Callable[..., None]:
        recipe = self.chosen()
        check_export(recipe.document, path)
        return partial(write_figure, self._figure(recipe), recipe, self._given, path, version())

    def _figure(self, recipe: Recipe) -> Figure:
        return figure_of(recipe, self._surfaces, self._answers)

    # ------------------------------------------------------------------ what it will be like
    def _changed(self, *_: object) -> None:
        self._number = 0
        self.pane.wait()
        self._soon.start()

    def _draw(self) -> None:
        """Draw the preview, if all values are right."""
        self._number = 0
        self.pane.wait()
        try:
            figure = self._figure(self.chosen())
        except BihdistError as error:
            self.pane.say(str(error), True)
            return
        self._number = self._exports.previews.ask("preview", preview, figure, self.pane.room())
        self._asked.add(self._number)

    def _show_preview(self, number: int, found: Preview) -> None:
        if number == self._number:
            self.pane.show_picture(found.pixels, *self._caption(found))
        elif number in self._asked and (self._number or self._soon.isActive()):
            self.pane.show_late(found.pixels)  # nearer to what is chosen than what was there
        self._asked.discard(number)

    def _show_refusal(self, number: int, sentence: str) -> None:
        if number == self._number:
            self.pane.say(sentence, True)

    def _caption(self, found: Preview) -> tuple[str, bool]:
        width, height = found.size
        unit, letters = ("mm", "pt") if found.is_printed else ("pixels", "px")
        is_small = found.smallest < SMALLEST[found.is_printed] - 0.05
        words = f"{self.size.name()}, {width:.0f} × {height:.0f} {unit}. Smallest text {found.smallest:.2g} {letters}"
        words = f"{words}, which is hard to read." if is_small else f"{words}."
        return " ".join((words, *found.remarks)), is_small or bool(found.remarks)

    # ------------------------------------------------------------------ copies
    def _add_copying(self) -> None:
        tip = "Copy the figure as an image"
        self.copy_picture = self.button("&Copy picture", tip, lambda: self._copy("picture"))
        put_icon(self.copy_picture, "copy")
        self.copy_line = self.button("Copy a&s command or Python", "One line that makes this figure")
        self.copy_line.setProperty("chevron", True)
        menu = QtWidgets.QMenu(self.copy_line)
        menu.addAction("As a command line", partial(self._copy, "command"))
        menu.addAction("As Python", partial(self._copy, "python"))
        self.copy_line.setMenu(menu)

    def _copy(self, what: str) -> None:
        with self.refusals_shown():
            self.check()
            self.copying.emit(what, self.chosen())
