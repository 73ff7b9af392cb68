"""Rows of the dock of changes: an amount with its slider and its box, and what is chosen by a button."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from qtpy import QtCore, QtWidgets

from ...qt.look.look import LOOK
from ...qt.look.numbers import MINUS, tick
from ...qt.look.text_box import TextBox, mark_wrong
from ...qt.panels.flat_button import FlatButton

STEPS = 400
LABEL, BOX, UNIT = 72, 60, 40
"""Logical pixels of the words at the left, of boxes, and of what stands behind these."""


@dataclass(frozen=True)
class Scale:
    """Amounts from low to high, with so many digits after the point; closer to each other when small: power above 1."""

    low: float
    high: float
    power: float = 1.0
    digits: int = 0

    def at(self, step: int) -> float:
        """The value at a step of the slider."""
        return round(self.low + (self.high - self.low) * float((step / STEPS) ** self.power), self.digits)

    def step_of(self, value: float) -> int:
        """The step of the slider that is nearest to a value."""
        share = (value - self.low) / (self.high - self.low) if self.high > self.low else 0.0
        return round(STEPS * float(min(max(share, 0.0), 1.0) ** (1 / self.power)))


class AmountRow(QtWidgets.QWidget):
    """words: at the left; name: for those who do not see it; unit: at the right, behind the box.

    `chosen` is emitted with the amount, and whether the slider is on its way.  is_good: of what is typed.
    """

    chosen = QtCore.Signal(float, bool)

    def __init__(
        self, words: str, name: str, unit: str, scale: Scale, is_good: Callable[[float], bool], wrong: str
    ) -> None:
        super().__init__()
        self._scale, self._is_good, self._wrong, self._tip = scale, is_good, wrong, name
        self.value = scale.low
        self.slider = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal)
        self.slider.setRange(0, STEPS)
        self.slider.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.slider.setMinimumWidth(40)
        self.box = TextBox()
        self.box.setFixedWidth(round(BOX * LOOK.scale))
        self.box.setAlignment(QtCore.Qt.AlignmentFlag.AlignRight)
        for widget, more in ((self.slider, ""), (self.box, ", typed")):
            widget.setAccessibleName(f"{name}{more}")
            widget.setToolTip(name)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(8)
        self._unit = quiet(unit)
        self._unit.setFixedWidth(round(UNIT * LOOK.scale))
        row.addWidget(label(words))
        row.addWidget(self.slider, 1)
        row.addWidget(self.box)
        row.addWidget(self._unit)
        self.slider.valueChanged.connect(self._slide)
        self.slider.sliderReleased.connect(self._settle)
        self.box.editingFinished.connect(self._type)

    def show_value(self, value: float, scale: Scale | None = None) -> None:
        """Without emitting.  scale: another one."""
        self._scale = scale or self._scale
        self.value = value
        if not (self.box.hasFocus() and self.box.isModified()):
            self.box.setText(tick(value))
            self.box.setModified(False)
            mark_wrong(self.box, False)
            self.box.setToolTip(self._tip)
        if not self.slider.isSliderDown():
            with QtCore.QSignalBlocker(self.slider):
                self.slider.setValue(self._scale.step_of(value))

    def _slide(self, step: int) -> None:
        self.value = self._scale.at(step)
        self.box.setText(tick(self.value))
        self.box.setModified(False)
        mark_wrong(self.box, False)
        self.chosen.emit(self.value, self.slider.isSliderDown())

    def _settle(self) -> None:
        self.chosen.emit(self.value, False)

    def _type(self) -> None:
        if not self.box.isModified():
            return
        try:
            value = float(self.box.text().replace(MINUS, "-").replace(",", "").strip())
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and self._is_good(value)):
            mark_wrong(self.box, True)
            self.box.setToolTip(self._wrong)
            return
        self.box.setModified(False)
        self.chosen.emit(value, False)


class ChosenRow(QtWidgets.QWidget):
    """A button, what has been chosen by it, and a cross that takes that away."""

    removed = QtCore.Signal()

    def __init__(self, words: str, button: str, tip: str, is_check: bool = False) -> None:
        super().__init__()
        self.button = QtWidgets.QPushButton(button, autoDefault=False, checkable=is_check)
        self.button.setToolTip(tip)
        self.button.setAccessibleName(f"{words}: {button}")
        self.note = MessageLabel()
        self.cross = FlatButton(self, "close")
        self.cross.setToolTip(f"{words}: take it back")
        self.cross.setAccessibleName(self.cross.toolTip())
        self.cross.activated.connect(self.removed)
        keeps = self.cross.sizePolicy()
        keeps.setRetainSizeWhenHidden(True)
        self.cross.setSizePolicy(keeps)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(8)
        row.addWidget(label(words))
        row.addWidget(self.button)
        row.addWidget(self.note, 1)
        row.addWidget(self.cross)
        self.show_chosen("")

    def show_chosen(self, words: str) -> None:
        """ "" for nothing."""
        self.note.setText(words)
        self.note.setToolTip(words)
        self.cross.setVisible(bool(words))


class MessageLabel(QtWidgets.QLabel):
    """Words that are cut short in the middle where there is no room."""

    def __init__(self) -> None:
        super().__init__()
        self.setAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, super().minimumSizeHint().height())

    def sizeHint(self) -> QtCore.QSize:
        return self.minimumSizeHint()

    def paintEvent(self, event: object) -> None:
        painter = QtWidgets.QStylePainter(self)
        shown = self.fontMetrics().elidedText(self.text(), QtCore.Qt.TextElideMode.ElideMiddle, self.width())
        painter.setPen(self.palette().color(self.foregroundRole()))
        painter.drawText(self.rect(), int(self.alignment()), shown)


def label(words: str) -> QtWidgets.QLabel:
    """At the left of a row, as wide as all of these."""
    found = QtWidgets.QLabel(words)
    found.setFixedWidth(round(LABEL * LOOK.scale))
    return found


def quiet(words: str) -> QtWidgets.QLabel:
    """A label in the quiet colour of secondary text."""
    found = QtWidgets.QLabel(words)
    found.setProperty("quiet", True)
    return found
