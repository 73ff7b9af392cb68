"""One number to be set: a slider, and pop-ups with a box for the exact value or for where a colour bar ends."""

from functools import cache
from math import exp, inf, log

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.distances.distance_types import Parameter, Value
from bihdist_core.scalars import with_decimal_point

from ...document.looks import LARGEST
from ...drawing.numbers import MINUS, number
from ..look.controls import TextBox, mark_wrong
from ..look.look import LOOK, smooth_painter
from .flat_button import paint_ring

STEPS = 240
"""Positions of a slider, in equal steps of the parameter, or of its logarithm."""

SYMBOLS = {"alpha": "α"}


def value_of_step(parameter: Parameter, step: int) -> float:
    """Return the value at a slider position; one of the marks where it is within half a step."""
    mark = _marks(parameter).get(step)
    if mark is not None:
        return mark
    low, high = _ends(parameter)
    value = low + (high - low) * step / STEPS
    value = exp(value) if parameter.logarithmic else value
    return round(value) if parameter.is_whole else float(f"{value:.3g}")


@cache
def _marks(parameter: Parameter) -> dict[int, float]:
    """Return the marks by their steps."""
    return {step_of_value(parameter, mark): mark for mark in reversed(parameter.marks)}


def step_of_value(parameter: Parameter, value: float) -> int:
    """Return the slider position of a value; outside of 0 to STEPS for what no slider offers."""
    low, high = _ends(parameter)
    if parameter.logarithmic and value <= 0:
        return 0
    return round(STEPS * ((log(value) if parameter.logarithmic else value) - low) / (high - low))


def _ends(parameter: Parameter) -> tuple[float, float]:
    low, high = parameter.shown
    return (log(low), log(high)) if parameter.logarithmic else (low, high)


def symbol(parameter: Parameter) -> str:
    """Return the symbol of a parameter, such as t, or its name."""
    return SYMBOLS.get(parameter.name, parameter.name)


def meaning(parameter: Parameter) -> str:
    """Return the parameter's meaning as a sentence begins."""
    return f"{parameter.meaning[:1].upper()}{parameter.meaning[1:]}"


def shown_value(parameter: Parameter, value: Value) -> str:
    """Return a value as the head shows it: a mark as a fraction, else three digits, or four where three are too few."""
    if isinstance(value, str):
        return value
    if parameter.is_whole:
        return f"{value:,}".replace("-", MINUS)
    written = parameter.written(value)
    if value in parameter.marks and "/" in written:
        return written
    text = number(value)
    is_short = "." in text and "e" not in text and float(f"{value:.3g}") == value
    return text[:-1].rstrip(".") if is_short and text.endswith("0") else text


class ValueSlider(QtWidgets.QSlider):
    """A parameter on a slider; `chosen(value)` by the user.

    A whole number, which counts what has to be computed, is chosen when the slider is let go.
    """

    chosen = QtCore.Signal(object)

    def __init__(self, parameter: Parameter, parent: QtWidgets.QWidget) -> None:
        super().__init__(QtCore.Qt.Orientation.Horizontal, parent)
        self.parameter = parameter
        self.setRange(0, STEPS)
        self.setPageStep(STEPS // 10)
        self.setTracking(not parameter.is_whole)
        # A wheel that scrolls past must not change what is shown.
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.setToolTip(meaning(parameter))
        self.setAccessibleName(meaning(parameter))
        self.valueChanged.connect(lambda step: self.chosen.emit(value_of_step(parameter, step)))
        self._by_keyboard = False
        LOOK.changed.connect(self.update)

    def show_value(self, value: Value) -> None:
        """Show a value without emitting, and not under the user's hand."""
        if not self.isSliderDown():
            with QtCore.QSignalBlocker(self):
                self.setValue(min(max(step_of_value(self.parameter, float(value)), 0), STEPS))

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        self._by_keyboard = event.reason() != QtCore.Qt.FocusReason.MouseFocusReason
        super().focusInEvent(event)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        if self._by_keyboard and self.hasFocus():
            paint_ring(smooth_painter(self), QtCore.QRectF(self.rect()))


class PopUp(QtWidgets.QFrame):
    """A small sheet under a control, gone at a click beside it or Esc."""

    closed = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget, objectName: str = "popUp") -> None:
        super().__init__(parent, QtCore.Qt.WindowType.Popup | QtCore.Qt.WindowType.FramelessWindowHint)
        self.setObjectName(objectName)
        self._under = parent
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_StyledBackground)
        # The click that closes it does not also press what is under it, which might open it again.
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_NoMouseReplay)

    def open_under(self, control: QtWidgets.QWidget, right: int = 0) -> None:
        """Open below a control and within the screen, so far to the right of its left side."""
        self._under = control
        self.adjustSize()
        place = control.mapToGlobal(QtCore.QPoint(right, control.height() + 2))
        screen = control.screen().availableGeometry() if control.screen() else QtCore.QRect(place, self.size())
        place.setX(max(screen.left(), min(place.x(), screen.right() - self.width())))
        if place.y() + self.height() > screen.bottom():
            place.setY(control.mapToGlobal(QtCore.QPoint(0, 0)).y() - self.height() - 2)
        self.move(place)
        self.show()

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        # The second press of a double click on the control is no click beside the sheet that the first has opened.
        if self.rect().contains(event.pos()):
            super().mouseDoubleClickEvent(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == QtCore.Qt.Key.Key_Escape:
            self.close()
        else:
            super().keyPressEvent(event)

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        super().hideEvent(event)
        self._under.update()  # the pointer may have left it meanwhile
        self.closed.emit()


class ReadPopUp(PopUp):
    """A sheet that is only read: pointing goes on under it, and so does the first key, which closes it."""

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        # A popup would have the keys and the pointer to itself.
        self.setWindowFlags(QtCore.Qt.WindowType.ToolTip | QtCore.Qt.WindowType.FramelessWindowHint)

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        QtWidgets.QApplication.instance().installEventFilter(self)

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        QtWidgets.QApplication.instance().removeEventFilter(self)
        super().hideEvent(event)

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        kinds, kind = QtCore.QEvent.Type, event.type()
        if watched in (self, self.windowHandle()) or watched.parent() is self:
            return False
        if kind == kinds.ShortcutOverride and event.key() == QtCore.Qt.Key.Key_Escape:
            event.accept()  # it comes as a key then, and closes this alone
            return True
        if kind not in (
            kinds.ShortcutOverride,
            kinds.KeyPress,
            kinds.MouseButtonPress,
            kinds.Wheel,
            kinds.WindowDeactivate,
        ):
            return False
        self.close()
        # A click beside it only closes it.
        return bool(
            kind == kinds.MouseButtonPress or (kind == kinds.KeyPress and event.key() == QtCore.Qt.Key.Key_Escape)
        )


class TypedPopUp(PopUp):
    """Words, a box for what they mean with something beside it, and what is wrong with what was typed.

    `chosen(value)` by the user; `_typed` reads the box.
    """

    chosen = QtCore.Signal(object)

    def __init__(self, words: str, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.words = QtWidgets.QLabel(words, self)
        self.words.setProperty("quiet", True)
        self.box = TextBox(self)
        self.box.returnPressed.connect(self._typed)
        self.box.textEdited.connect(lambda: self._complain(""))
        self.complaint = QtWidgets.QLabel("", self, wordWrap=True, visible=False)
        self.complaint.setProperty("error", True)

    def open_under(self, control: QtWidgets.QWidget, right: int = 0) -> None:
        super().open_under(control, right)
        self.box.setFocus(QtCore.Qt.FocusReason.PopupFocusReason)
        self.box.selectAll()

    def _lay_out(self, left: QtWidgets.QWidget, right: QtWidgets.QWidget) -> None:
        grid = QtWidgets.QGridLayout(self)
        grid.setContentsMargins(12, 10, 12, 12)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(8)
        grid.addWidget(self.words, 0, 0, 1, 2)
        grid.addWidget(left, 1, 0)
        grid.addWidget(right, 1, 1)
        grid.addWidget(self.complaint, 2, 0, 1, 2)
        self.setTabOrder(left, right)

    def _typed(self) -> None:
        raise NotImplementedError

    def _complain(self, text: str) -> None:
        if text != self.complaint.text():
            self.complaint.setText(text)
            self.complaint.setVisible(bool(text))
            mark_wrong(self.box, bool(text))
            self.adjustSize()


class NumberPopUp(TypedPopUp):
    """The slider and the box of one number."""

    def __init__(self, parameter: Parameter, parent: QtWidgets.QWidget) -> None:
        super().__init__(meaning(parameter), parent)
        self.parameter = parameter
        self._value: Value = 0.0
        self.slider = ValueSlider(parameter, self)
        self.slider.setMinimumWidth(150)
        self.slider.sliderMoved.connect(lambda step: self._write(value_of_step(parameter, step)))
        self.slider.chosen.connect(self.chosen)
        self.box.setFixedWidth(76)
        self.box.setAccessibleName(f"{meaning(parameter)}, the exact value")
        most = "" if parameter.at_most == inf else f" and at most {parameter.at_most:,}, as the mesh has them"
        self.box.setToolTip(f"{symbol(parameter)}: any number above {parameter.above:g}{most}; Enter sets it")
        self._lay_out(self.slider, self.box)

    def show_value(self, value: Value) -> None:
        """Show a value without emitting; what is being typed stays."""
        self._value = value
        self.slider.show_value(value)
        if not (self.isVisible() and self.box.isModified()):
            self._write(value)

    def open_under(self, control: QtWidgets.QWidget, right: int = 0) -> None:
        self._write(self._value)
        super().open_under(control, right)

    def _write(self, value: Value) -> None:
        self.box.setText(self.parameter.written(value))
        self._complain("")

    def _typed(self) -> None:
        try:
            value = self.parameter.parsed(with_decimal_point(self.box.text()))
        except ParameterError as error:
            self._complain(str(error))
            return
        self.box.setModified(False)
        self.close()
        if value != self._value:
            self.chosen.emit(value)


class EndPopUp(TypedPopUp):
    """Asks where a colour bar ends; `chosen(None)` for the field's own maximum."""

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__("The colours end at", parent)
        self.box.setFixedWidth(110)
        self.box.setAccessibleName("Where the colours end")
        self.own = QtWidgets.QPushButton("Its own maximum", self, clicked=lambda: self._choose(None))
        self._lay_out(self.box, self.own)

    def ask(self, control: QtWidgets.QWidget, end: float, maximum: float, unit: str) -> None:
        """Open under the colour bar, whose colours end at `end`; the field's own maximum is proposed beside it."""
        self.words.setText(f"The colours end at{f' ({unit})' if unit else ''}")
        self.box.setText(f"{end:.6g}")
        self.own.setToolTip(number(maximum))
        self.own.setEnabled(end != maximum)
        self._complain("")
        self.adjustSize()
        self.open_under(control, (control.width() - self.width()) // 2)

    def _typed(self) -> None:
        text = with_decimal_point(self.box.text())
        try:
            end = float(text)
        except ValueError:
            end = float("nan")
        if not 1 / LARGEST <= end <= LARGEST:
            self._complain(f"{text!r} is not a positive number.")
            return
        self._choose(end)

    def _choose(self, end: float | None) -> None:
        self.close()
        self.chosen.emit(end)
