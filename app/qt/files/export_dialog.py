"""The dialog of File > Export figure: the figure itself, beside what can be chosen of it."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.distances.answers import Answer

from ...document.page import FORMATS, Recipe
from ...figures.description import Figure
from ...figures.draw import FIGURE_FORMATS
from ...figures.export import Surfaces, check_export, figure_of, write_figure
from ...figures.preview import Preview, preview
from ...figures.size import NAMED
from ...session.array_store import ArrayStore
from ..look.icons import put_icon
from .exports import Exports
from .job_dialog import Choice, FileKind
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
    ("Usual", "", "follows the panels"),
    *((SIZE_NAMES.get(word, word), word, in_words(word)) for word in NAMED),
)
NAMES = {"heading": "Over the panels", "caption": "Under the panels", "none": "Nowhere"}
"""Where a panel's name stands."""

BOTH = ("front", "back")
SMALLEST = {True: 6.0, False: 10.0}
"""Points, and pixels where nothing is printed: smaller letters are hard to read."""

WAIT = 120
"""Milliseconds after a change before a figure is drawn: somebody writes, or steps through a list."""


class ExportDialog(LooksDialog):
    """A figure of what the window shows; answers: one for each panel.

    `copying` is emitted with "picture", "command" or "python", and the recipe.
    """

    what, file_kinds, sizes = "Figure", FIGURE_KINDS, FIGURE_SIZES
    copying = QtCore.Signal(str, object)

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        given: ArrayStore,
        answers: list[Answer],
        version: str,
        exports: Exports,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        self.pane = PreviewPane()
        super().__init__(recipe, surfaces, given, exports, parent, self.pane)
        self._answers, self._version = answers, version
        self.kinds.choose((recipe.page.format or FORMATS[0]).upper())
        self.section("Show")
        self.names = Choice(NAMES, recipe.page.title)
        self.row("&Names", self.names, "Where the name of each panel stands")
        self.add_shares()
        self.both = self.tick("&Front and back", recipe.page.views == BOTH, "Each panel from both sides")
        self.transparent = self.tick("No &background", recipe.page.transparent, "Transparent where nothing is drawn")
        self.crop = self.tick("Without the empty &margins", recipe.page.crop, "Cut to what is drawn")
        self.values: QtWidgets.QCheckBox | None = None
        if any(part.has_values for part in recipe.document.parts):
            self.values = self.tick("&Values at anchors", recipe.page.anchor_values, "The number beside each anchor")
        self.section("Look")
        self.add_look()
        self.letters = QtWidgets.QDoubleSpinBox(decimals=1, maximum=72, singleStep=0.5, suffix=" pt")
        self.letters.setSpecialValueText("As they fit")
        self.letters.setButtonSymbols(QtWidgets.QAbstractSpinBox.ButtonSymbols.NoButtons)
        self.letters.setValue(recipe.page.text or 0.0)
        self.row("&Text", self.letters, "The size of labels in points, the others in proportion; 0: as they fit")
        self._add_copying()
        self._number, self._asked = 0, set[int]()
        self._soon = QtCore.QTimer(self, singleShot=True, interval=WAIT, timeout=self._draw)
        exports.previews.answered.connect(self._show_preview)
        exports.previews.refused.connect(self._show_refusal)
        self.pane.resized.connect(self._soon.start)
        self.on_change(self._changed)

    def chosen(self) -> Recipe:
        recipe = super().chosen()
        views = recipe.page.views
        if self.both.isChecked() != (views == BOTH):
            views = BOTH if self.both.isChecked() else ()
        page = replace(
            recipe.page,
            transparent=self.transparent.isChecked(),
            crop=self.crop.isChecked(),
            title=self.names.currentData(),
            views=views,
            text=self._text(),
            format=self.kinds.choice().lower(),
            anchor_values=recipe.page.anchor_values if self.values is None else self.values.isChecked(),
        )
        return replace(recipe, page=page)

    def _text(self) -> float | None:
        """As it was where nobody has changed it: the box has one digit."""
        value, was = self.letters.value(), self._recipe.page.text
        if was is not None and abs(value - was) < 0.05:
            return was
        return max(value, 2.0) if value else None

    def check(self) -> None:
        self.check_size(self.chosen())

    def work(self, path: str) -> Callable[..., None]:
        recipe = self.chosen()
        check_export(recipe.document, path)
        return partial(write_figure, self._figure(recipe), recipe, self._given, path, self._version)

    def _figure(self, recipe: Recipe) -> Figure:
        return figure_of(recipe, self._surfaces, self._answers)

    # ------------------------------------------------------------------ what it will be like
    def _changed(self, *_: object) -> None:
        self._number = 0
        self.pane.wait()
        self._soon.start()

    def _draw(self) -> None:
        """Have it drawn as the dialog stands now, if that makes sense."""
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
        return f"{words}, which is hard to read." if is_small else f"{words}.", is_small

    # ------------------------------------------------------------------ copies
    def _add_copying(self) -> None:
        self.copy_picture = self.button("&Copy picture", "The figure as an image, to be pasted elsewhere")
        put_icon(self.copy_picture, "copy")
        self.copy_picture.clicked.connect(lambda: self._copy("picture"))
        self.copy_line = self.button("Copy as co&mmand or Python", "One line that makes this figure")
        self.copy_line.setProperty("chevron", True)
        menu = QtWidgets.QMenu(self.copy_line)
        menu.addAction("As a command line", partial(self._copy, "command"))
        menu.addAction("As Python", partial(self._copy, "python"))
        self.copy_line.setMenu(menu)

    def _copy(self, what: str) -> None:
        with self.refusals_shown():
            self.check()
            self.copying.emit(what, self.chosen())
