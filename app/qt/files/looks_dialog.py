"""The base of the dialogs of figures and movies: the size and the look."""

from dataclasses import replace
from typing import ClassVar

from qtpy import QtWidgets

from bihdist_core.distances.answers import Answer

from ...document.document import MOST_PANELS
from ...document.page import Recipe
from ...figures.export import Surfaces, figure_of
from ...figures.layout import lay_out
from ..context import Context
from ..look.canvas import offered_styles, style_name
from ..look.form import Choice, Count, describe
from .job_dialog import JobDialog, blamed_on
from .size_boxes import SizeBoxes, SizeNames


class LooksDialog(JobDialog):
    """A dialog with the size and the look of a drawing; a class offers `sizes`."""

    sizes: ClassVar[SizeNames]

    def __init__(
        self, context: Context, recipe: Recipe, surfaces: Surfaces, side: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(context, recipe, surfaces, side)
        self._has_one_unit = True
        self.form.section("Size")
        self.size = SizeBoxes(self.sizes)
        self.size.write(recipe.page.size)
        self.size.changed.connect(self.form.changed)
        self.form.add(self.size)
        self.form.add_error(self.size.width_box)

    def choose(self, format: str, size: str) -> None:
        """Begin with a format, if it is offered, and a size."""
        if format in self.kinds.buttons:
            self.kinds.choose(format)
        self.size.write(size)

    def add_shares(self) -> None:
        """Add the rows of hints and of the shared colour bar."""
        tip = "A line under each title on what to look for"
        self.hints = self.form.tick("&What to look for", self._recipe.page.hints, tip, "hints")
        is_shared, tip = self._recipe.document.range != "own", "The same colour means the same value everywhere"
        self.shared = self.form.tick("&One colour bar for all", is_shared, tip)

    def add_look(self) -> None:
        """Add the rows of the style and the number of columns."""
        page = self._recipe.page
        self.style_box = Choice({word: style_name(word) for word in offered_styles(page.style)}, page.style)
        self.columns = Count(0, MOST_PANELS, page.columns or 0, nothing="Automatic")
        self.form.row("St&yle", self.style_box, "The colours and lines of the drawing", "style")
        self.form.row("Co&lumns", self.columns, "How many panels stand side by side", "columns")

    def allow_sharing(self, has_one_unit: bool) -> None:
        """Offer a shared bar in the common unit, or in fractions where units differ."""
        self._has_one_unit = has_one_unit
        if not has_one_unit:
            words = "&One colour bar, in fractions of the maximum"
            self.shared.setText(words)
            tip = "The panels have different units; the same colour means the same fraction everywhere"
            describe(self.shared, words, tip)

    def chosen(self) -> Recipe:
        """Return the recipe with the values of the dialog; ParameterError for a wrong size."""
        document, page = self._recipe.document, self._recipe.page
        with blamed_on(self.size.width_box):
            size = self.size.text()
        page = replace(page, size=size, **self.form.values())
        if self.shared.isChecked() != (document.range != "own"):
            word = "shared" if self._has_one_unit else "fraction"
            document = replace(document, range=word if self.shared.isChecked() else "own")
        return replace(self._recipe, page=page, document=document)

    def check_size(self, recipe: Recipe) -> None:
        """Raise WrongBox for a wrong size, or one without room for the panels."""
        with blamed_on(self.size.width_box):
            nothing_yet = [Answer(label="")] * len(recipe.document.panels)
            lay_out(figure_of(recipe, self._surfaces, nothing_yet))
