"""The parameters in a panel's head: a word with its menu, or a number with its slider or its pop-up."""

from collections.abc import Callable, Sequence
from functools import lru_cache

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.distances.distance_types import Parameter, Value

from ...drawing.painters.qt import number_width
from ..look.look import LOOK, baseline
from .flat_button import GAP, HEIGHT, PAD, FlatButton
from .number_box import STEPS, NumberPopUp, ValueSlider, meaning, shown_value, symbol, value_of_step

SLIDER_MOST, SLIDER_LEAST = 88, 72
"""Pixels of a slider in the head; where there is less room it is in the pop-up."""


class ChoiceControl(FlatButton):
    """A choice of words; emits `chosen(word)` when the user chooses.

    Parameters
    ----------
    words
        How each word is shown.
    short
        The same where there is little room.
    """

    chosen = QtCore.Signal(object)

    def __init__(
        self, parent: QtWidgets.QWidget, words: dict[Value, str], tip: str, short: dict[Value, str] | None = None
    ) -> None:
        super().__init__(parent, quiet=True)
        self.words, self.tip, self._short, self._is_short = words, tip, short or words, False
        self.value: Value = next(iter(words))
        self._actual, self._is_preview = "", False
        menu = QtWidgets.QMenu(self)
        menu.aboutToShow.connect(lambda: fill_choices(menu, words, self.value, self._choose))
        self.setMenu(menu)

    def show_value(self, value: Value) -> None:
        """Show a value without emitting."""
        self.value = value
        actual = self._actual and (f": {self._actual}" if value == "auto" else f", now {self._actual}")
        is_said = value == "auto" or self._is_preview
        words = self._short if self._is_short else self.words
        self.setText(words.get(value, str(value)) + (actual if is_said else ""))
        self.setToolTip(self.tip)
        self.setAccessibleName(f"{self.tip}: {self.text()}")

    def shorten(self, is_short: bool) -> None:
        """Show the short words, or the whole ones."""
        self._is_short = is_short
        self.show_value(self.value)

    def show_actual(self, actual: str, is_preview: bool = False) -> None:
        """Show what "auto" stands for, or with `is_preview` what is shown in place of any choice."""
        if (actual, is_preview) != (self._actual, self._is_preview):
            self._actual, self._is_preview = actual, is_preview
            self.show_value(self.value)

    def least(self, with_slider: bool) -> int:
        """Return the pixels that it needs, as many as the longest short word, so that panels are worded alike."""
        width, wide = int(self.sizeHint().width()), QtGui.QFontMetrics(LOOK.font()).horizontalAdvance
        if self._short is not self.words:
            width += max(*map(wide, self._short.values()), wide(self.text())) - wide(self.text())
        return width

    most = least

    def show_slider(self, shown: bool) -> None:
        """Do nothing, as there is no slider."""

    def add_to(self, menu: QtWidgets.QMenu) -> None:
        """Offer the same in another menu."""
        inner = menu.addMenu(f"{self.tip.partition(';')[0]}: {self.text()}")
        fill_choices(inner, self.words, self.value, self._choose)

    def _choose(self, value: Value) -> None:
        if value != self.value:
            self.show_value(value)
            self.chosen.emit(value)


class NumberControl(QtWidgets.QWidget):
    """A number: symbol, slider and value in a row, or symbol and value over a pop-up; `chosen(value)` by the user.

    `let_go` when the user lets go of the slider.
    """

    chosen = QtCore.Signal(object)
    let_go = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget, parameter: Parameter, sign: str, tip: str) -> None:
        super().__init__(parent)
        self.parameter, self.sign, self.tip = parameter, sign, tip
        self.value: Value = parameter.default
        self._has_slider = False
        # How many of something is typed; a slider for it is in the pop-up.
        self._may_have_slider = not parameter.is_whole
        self.slider = ValueSlider(parameter, self)
        self.slider.setToolTip(self.tip)
        self.slider.setAccessibleName(self.tip)
        self.slider.chosen.connect(self._choose)
        self.button = FlatButton(self)
        self.button.activated.connect(lambda: self.open_under(self))
        self.pop_up = NumberPopUp(parameter, self)
        self.pop_up.chosen.connect(self._choose)
        for slider in (self.slider, self.pop_up.slider):
            slider.sliderReleased.connect(self.let_go)
        self.show_slider(False)

    @property
    def is_held(self) -> bool:
        """Whether the user holds the slider."""
        return any(slider.isSliderDown() for slider in (self.slider, self.pop_up.slider))

    def show_value(self, value: Value) -> None:
        """Show a value without emitting."""
        self.value = value
        self.slider.show_value(value)
        self.pop_up.show_value(value)
        self.button.setText(shown_value(self.parameter, value))
        self.button.setToolTip(f"{self.tip}: {self.parameter.written(value)}\nClick to type a value")
        self.button.setAccessibleName(f"{self.tip}: {self.parameter.written(value)}")

    def show_slider(self, shown: bool) -> None:
        """Show the slider where there is room for one, or the value alone."""
        self._has_slider = shown and self._may_have_slider
        self.slider.setVisible(self._has_slider)
        self.button.symbol = "" if self._has_slider else self.sign
        # In a row the value looks like what it is; alone it shows that there is more.
        self.button.has_arrow = not shown
        self._lay_out()

    def least(self, with_slider: bool) -> int:
        """Return the pixels that it needs."""
        return self._needed(with_slider, SLIDER_LEAST)

    def most(self, with_slider: bool) -> int:
        """Return the pixels that it can use."""
        return self._needed(with_slider, SLIDER_MOST)

    def open_under(self, control: QtWidgets.QWidget) -> None:
        """Open the box in which the value is typed, under a control."""
        self.pop_up.open_under(control)

    def add_to(self, menu: QtWidgets.QMenu) -> None:
        """Offer the same in another menu."""
        action = menu.addAction(f"{self.tip}: {shown_value(self.parameter, self.value)}…")
        # After the menu has given back mouse and keys.
        action.triggered.connect(lambda: QtCore.QTimer.singleShot(0, lambda: self.open_under(self.parentWidget())))

    def _choose(self, value: Value) -> None:
        self.show_value(value)
        self.chosen.emit(value)

    def _needed(self, with_slider: bool, slider: int) -> int:
        if with_slider and self._may_have_slider:
            return self._sign_width() + slider + self._value_width()
        shown = self.button.symbol, self.button.has_arrow
        self.button.symbol, self.button.has_arrow = self.sign, not with_slider
        width = self.button.sizeHint().width()
        self.button.symbol, self.button.has_arrow = shown
        return int(width)

    def _sign_width(self) -> int:
        return round(PAD + number_width(LOOK.font(), self.sign) + GAP + 0.5)

    def _value_width(self) -> int:
        # Room for all that the slider gives, so that nothing moves with it.
        widest = max((self.button.text(), _longest(self.parameter)), key=lambda text: number_width(LOOK.font(), text))
        return round(2 * PAD + number_width(LOOK.font(), widest) + 0.5)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._lay_out()

    def _lay_out(self) -> None:
        left, value = (self._sign_width(), self._value_width()) if self._has_slider else (0, self.width())
        self.slider.setGeometry(left, 0, max(self.width() - left - value, 0), self.height())
        self.button.setGeometry(self.width() - value, 0, value, self.height())

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if self._has_slider:
            painter = QtGui.QPainter(self)
            painter.setFont(LOOK.font())
            painter.setPen(QtGui.QColor(LOOK.theme.quiet))
            painter.drawText(QtCore.QPointF(PAD, round(baseline(painter, self.height() / 2))), self.sign)


@lru_cache
def _longest(parameter: Parameter) -> str:
    """Return the longest text of the values that a slider gives."""
    return max((shown_value(parameter, value_of_step(parameter, step)) for step in range(STEPS + 1)), key=len)


class FixedWord(QtWidgets.QLabel):
    """A word about a distance that has no parameters."""

    def __init__(self, parent: QtWidgets.QWidget, text: str, tip: str) -> None:
        super().__init__(text, parent)
        self.setProperty("quiet", True)
        self.setToolTip(tip)
        self.setFixedHeight(HEIGHT)
        self.setContentsMargins(PAD, 0, PAD, 0)
        self.setIndent(0)

    def least(self, with_slider: bool) -> int:
        """Return the pixels that it needs."""
        return round(2 * PAD + number_width(LOOK.font(), self.text()) + 2)

    most = least

    def show_slider(self, shown: bool) -> None:
        """Do nothing, as there is no slider."""

    def add_to(self, menu: QtWidgets.QMenu) -> None:
        """Do nothing, as there is nothing to choose."""


Control = ChoiceControl | NumberControl | FixedWord
"""A control after the name in a panel's head, as high as a flat button."""


def parameter_control(parent: QtWidgets.QWidget, parameter: Parameter, sign: str, of_what: str) -> Control:
    """Return the control of a parameter; `of_what` names which of two distances it belongs to."""
    if parameter.choices:
        head, semicolon, rest = meaning(parameter).partition(";")
        words: dict[Value, str] = {word: "Dijkstra" if word == "dijkstra" else word for word in parameter.choices}
        return ChoiceControl(parent, words, f"{head}{of_what}{semicolon}{rest}")
    return NumberControl(parent, parameter, sign, f"{meaning(parameter)}{of_what}")


def fill_choices(menu: QtWidgets.QMenu, words: dict[Value, str], now: Value, choose: Callable[[Value], None]) -> None:
    """Let a menu offer these words, the present one ticked."""
    empty_menu(menu)
    for value, shown in words.items():
        action = menu.addAction(shown)
        tick(action, value == now)
        action.triggered.connect(lambda *_, value=value: choose(value))


def empty_menu(menu: QtWidgets.QMenu) -> None:
    """Remove all entries of a menu and delete the menus in it, which `clear` leaves in memory."""
    menu.clear()
    direct = QtCore.Qt.FindChildOption.FindDirectChildrenOnly
    for inner in menu.findChildren(QtWidgets.QMenu, options=direct):
        inner.deleteLater()


def tick(action: QtWidgets.QAction, is_chosen: bool) -> None:
    """Show that an entry of a menu is the one that holds."""
    action.setCheckable(True)
    action.setChecked(is_chosen)


def signs(parameters: Sequence[Parameter]) -> list[str]:
    """Return the symbols of one head's parameters: equal ones are numbered, t₁ and t₂."""
    symbols = [symbol(parameter) for parameter in parameters]
    return [
        f"{each}{'₁₂₃₄'[symbols[:place].count(each)]}" if symbols.count(each) > 1 else each
        for place, each in enumerate(symbols)
    ]
