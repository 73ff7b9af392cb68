"""Rows of the dock of changes: an amount with its slider and its box, and what is chosen by a button."""

from collections.abc import Callable

from qtpy import QtCore, QtWidgets

from ...qt.docks.slider_box import Scale, SliderBox
from ...qt.look.form import describe
from ...qt.look.layouts import in_row, keep_room, push_button, quiet_label
from ...qt.look.look import LOOK
from ...qt.look.text_lines import ElidedLabel
from ...qt.panels.flat_button import icon_button

BOX_WIDTH_PX, UNIT_WIDTH_PX = 60, 40
"""Logical pixels of boxes, and of what stands behind them."""


class AmountRow(SliderBox):
    """An amount with a slider and a box, its `name` for screen readers and tips, and a `unit` behind the box."""

    def __init__(self, name: str, unit: str, scale: Scale, is_good: Callable[[float], bool], wrong: str) -> None:
        super().__init__(scale, BOX_WIDTH_PX, is_good, wrong)
        self.name_value(name, name)
        behind = quiet_label(unit)
        behind.setFixedWidth(round(UNIT_WIDTH_PX * LOOK.scale))
        in_row((self.slider, 1), self.box, behind, of=self, spacing=8)


class ChosenRow(QtWidgets.QWidget):
    """A button, what has been chosen by it, and a cross that takes that away."""

    removed = QtCore.Signal()

    def __init__(self, words: str, button: str, tip: str, is_check: bool = False) -> None:
        super().__init__()
        self.button = push_button(button)
        self.button.setCheckable(is_check)
        describe(self.button, f"{words}: {button}", tip)
        self.note = ElidedLabel(QtCore.Qt.TextElideMode.ElideMiddle)
        self.note.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Preferred)
        self.note.setAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
        self.cross = icon_button(self, "close", f"{words}: remove", self.removed.emit)
        keep_room(self.cross)
        in_row(self.button, (self.note, 1), self.cross, of=self, spacing=8)
        self.show_chosen("")

    def show_chosen(self, words: str) -> None:
        """Show what is chosen, "" for nothing."""
        self.note.setText(words)
        self.note.setToolTip(words)
        self.cross.setVisible(bool(words))


def beside(*widgets: QtWidgets.QWidget) -> QtWidgets.QWidget:
    """Return widgets side by side, at the left of what room there is."""
    row = QtWidgets.QWidget()
    in_row(*widgets, None, of=row, spacing=8)
    return row
