"""A slider and a box for the same number, in rows of docks."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from qtpy import QtCore, QtWidgets

from bihdist_core.scalars import with_decimal_point

from ...drawing.numbers import tick
from ..look.controls import TextBox, mark_wrong
from ..look.form import describe
from ..look.look import LOOK


@dataclass(frozen=True)
class Scale:
    """Amounts from low to high, with so many digits after the point; closer to each other when small: power above 1."""

    low: float
    high: float
    power: float = 1.0
    digits: int = 0
    steps: int = 400

    def at(self, step: int) -> float:
        """Return the value at a step of the slider."""
        return round(self.low + (self.high - self.low) * float((step / self.steps) ** self.power), self.digits)

    def step_of(self, value: float) -> int:
        """Return the step of the slider that is nearest to a value."""
        share = (value - self.low) / (self.high - self.low) if self.high > self.low else 0.5
        return round(self.steps * float(min(max(share, 0.0), 1.0) ** (1 / self.power)))


class SliderBox(QtWidgets.QWidget):
    """A row with a slider and a box, which a subclass lays out.

    `valued` is emitted with the number, and whether the slider is still being dragged.  `is_good` checks a typed
    number, and `wrong` is the box's tip where that fails.
    """

    valued = QtCore.Signal(float, bool)

    def __init__(
        self,
        scale: Scale,
        box_width: int,
        is_good: Callable[[float], bool] = lambda value: True,
        wrong: str = "Not a number",
    ) -> None:
        super().__init__()
        self._scale, self._is_good, self._wrong, self._tip = scale, is_good, wrong, ""
        self.value = scale.low
        self.slider = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal, minimum=0, maximum=scale.steps)
        self.slider.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.slider.setMinimumWidth(40)
        self.box = TextBox()
        self.box.setFixedWidth(round(box_width * LOOK.scale))
        self.box.setAlignment(QtCore.Qt.AlignmentFlag.AlignRight)
        self.slider.valueChanged.connect(self._slide)
        self.slider.sliderReleased.connect(lambda: self.valued.emit(self.value, False))
        self.box.editingFinished.connect(self._type)

    def name_value(self, name: str, tip: str = "") -> None:
        """Name the number for screen readers, and in tips."""
        self._tip = tip
        describe(self.slider, name, tip)
        describe(self.box, f"{name}, typed", tip)

    def show_value(self, value: float, scale: Scale | None = None) -> None:
        """Show a value, on another scale if one is given, without emitting it."""
        self._scale, self.value = scale or self._scale, value
        if not (self.box.hasFocus() and self.box.isModified()):
            self._write()
        if not self.slider.isSliderDown():
            with QtCore.QSignalBlocker(self.slider):
                self.slider.setValue(self._scale.step_of(value))

    def _write(self) -> None:
        self.box.setText(tick(self.value))
        self.box.setCursorPosition(0)  # of a long one the first digits are seen
        self._mark_wrong(False)

    def _mark_wrong(self, is_wrong: bool) -> None:
        mark_wrong(self.box, is_wrong)
        self.box.setToolTip(self._wrong if is_wrong else self._tip)

    def _slide(self, step: int) -> None:
        self.value = self._scale.at(step)
        self._write()
        self.valued.emit(self.value, self.slider.isSliderDown())

    def _type(self) -> None:
        if not self.box.isModified():
            return
        try:
            value = float(with_decimal_point(self.box.text()))
        except ValueError:
            value = math.nan
        if math.isfinite(value) and self._is_good(value):
            self.box.setModified(False)
            self.valued.emit(value, False)
        else:
            self._mark_wrong(True)
