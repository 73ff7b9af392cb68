"""What the dialogs of figures and movies have in common: the size, and how it looks."""

from collections.abc import Callable
from dataclasses import replace
from typing import ClassVar

from qtpy import QtWidgets

from bihdist_core.distances.answers import Answer

from ...document.document import MOST_PANELS
from ...document.file_names import file_name
from ...document.page import Recipe
from ...figures.export import Surfaces, figure_of
from ...figures.layout import lay_out
from ...session.array_store import ArrayStore
from ..look.canvas import offered_styles, style_name
from .exports import Exports
from .job_dialog import Choice, Count, JobDialog, blamed_on
from .size_boxes import SizeBoxes, SizeNames


class LooksDialog(JobDialog):
    """recipe: what the window shows, on these surfaces; given: arrays that it names.  sizes: that are offered."""

    sizes: ClassVar[SizeNames]

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        given: ArrayStore,
        exports: Exports,
        parent: QtWidgets.QWidget | None = None,
        side: QtWidgets.QWidget | None = None,
    ) -> None:
        name = file_name([each.path for each in recipe.document.surfaces], self.what.lower())
        super().__init__(name, exports, parent, side)
        self._recipe, self._surfaces, self._given, self._has_one_unit = recipe, surfaces, given, True
        self.section("Size")
        self.size = SizeBoxes(self.sizes)
        self.size.write(recipe.page.size)
        self.column.addWidget(self.size)
        self.room_for_wrong(self.size.width_box)

    def add_shares(self) -> None:
        """One colour bar, and what to look for."""
        self.hints = self.tick("&What to look for", self._recipe.page.hints, "A line under each heading")
        is_shared, tip = self._recipe.document.range != "own", "The same colour means the same value everywhere"
        self.shared = self.tick("&One colour bar for all", is_shared, tip)

    def add_look(self) -> None:
        """Style and columns."""
        page = self._recipe.page
        self.style_box = Choice({word: style_name(word) for word in offered_styles(page.style)}, page.style)
        self.columns = Count(0, MOST_PANELS, page.columns or 0, nothing="Automatic")
        self.row("St&yle", self.style_box, "The colours and lines of the drawing")
        self.row("Co&lumns", self.columns, "How many panels stand side by side")

    def allow_sharing(self, has_one_unit: bool) -> None:
        """Panels of different units share a bar of shares."""
        self._has_one_unit = has_one_unit
        if not has_one_unit:
            words = "&One colour bar, in fractions of the maximum"
            self.shared.setText(words)
            tip = "The panels have different units; the same colour means the same fraction everywhere"
            self.name_box(self.shared, words, tip)

    def chosen(self) -> Recipe:
        """The recipe as the dialog stands; ParameterError for a size that is none."""
        document, page = self._recipe.document, self._recipe.page
        with blamed_on(self.size.width_box):
            size = self.size.text()
        style, columns = self.style_box.currentData(), self.columns.value() or None
        page = replace(page, size=size, style=style, columns=columns, hints=self.hints.isChecked())
        if self.shared.isChecked() != (document.range != "own"):
            word = "shared" if self._has_one_unit else "shares"
            document = replace(document, range=word if self.shared.isChecked() else "own")
        return replace(self._recipe, page=page, document=document)

    def check_size(self, recipe: Recipe) -> None:
        """WrongBox for a size that is none, or with which there would be no picture."""
        with blamed_on(self.size.width_box):
            nothing_yet = [Answer(label="")] * len(recipe.document.panels)
            lay_out(figure_of(recipe, self._surfaces, nothing_yet))

    def on_change(self, function: Callable[..., None]) -> None:
        """Call a bound method whenever something else is chosen."""
        self.size.changed.connect(function)
        self.kinds.chosen.connect(function)
        for box in (self.style_box, *self.findChildren(QtWidgets.QComboBox)):
            if box is not self.size.unit:
                box.currentIndexChanged.connect(function)
        for tick in self.findChildren(QtWidgets.QCheckBox):
            tick.toggled.connect(function)
        for number in (*self.findChildren(QtWidgets.QSpinBox), *self.findChildren(QtWidgets.QDoubleSpinBox)):
            number.valueChanged.connect(function)
