"""A row of the list of anchors: an eye, a name, a slider and a box for the value, and a cross."""

import math

from qtpy import QtCore, QtGui, QtWidgets

from ...qt.docks.dock import PAD
from ...qt.look.look import LOOK
from ...qt.look.numbers import MINUS, tick
from ...qt.look.text_box import TextBox, mark_wrong
from ...qt.panels.flat_button import FlatButton

STEPS = 1000
HEIGHT, BOX = 34, 54
"""Logical pixels of a row, and of the box for its value."""


class AnchorRow(QtWidgets.QWidget):
    """point: of the anchor.  Every change is told, and shown when it comes back by `show_anchor`."""

    valued = QtCore.Signal(str, float, bool)  # point, value, whether the slider is on its way
    named = QtCore.Signal(str, str)
    left_out = QtCore.Signal(str, bool)
    removed = QtCore.Signal(str)
    chosen = QtCore.Signal(str)
    stepped = QtCore.Signal(str, int)  # to the row above (-1) or below

    def __init__(self, point: str) -> None:
        super().__init__()
        self.point = point
        self._value, self._low, self._high, self._is_chosen = 0.0, 0.0, 1.0, False
        self.eye, self.cross = FlatButton(self, "eye"), FlatButton(self, "delete")
        self.name = TextBox()
        self.name.setFrame(False)
        self.name.setProperty("plain", True)
        self.slider = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal)
        self.slider.setRange(0, STEPS)
        self.slider.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.slider.setMinimumWidth(40)
        self.name.setMinimumWidth(40)
        keeps = self.cross.sizePolicy()
        keeps.setRetainSizeWhenHidden(True)
        self.cross.setSizePolicy(keeps)
        self.cross.hide()
        self.box = TextBox()
        self.box.setFixedWidth(round(BOX * LOOK.scale))
        self.box.setAlignment(QtCore.Qt.AlignmentFlag.AlignRight)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(6, 0, PAD, 0)
        row.setSpacing(4)
        for widget, stretch in ((self.eye, 0), (self.name, 1), (self.slider, 1), (self.box, 0), (self.cross, 0)):
            row.addWidget(widget, stretch)
        self.setFixedHeight(round(HEIGHT * LOOK.scale))
        self.eye.activated.connect(self._turn_eye)
        self.cross.activated.connect(self._remove)
        self.name.editingFinished.connect(self._name)
        self.slider.valueChanged.connect(self._slide)
        self.slider.sliderReleased.connect(self._settle)
        self.slider.sliderPressed.connect(self._choose)
        self.box.editingFinished.connect(self._type)
        for widget in (self.name, self.box, self.slider):
            widget.installEventFilter(self)

    # ------------------------------------------------------------------ what is told
    def show_anchor(self, name: str, value: float, is_out: bool, ends: tuple[float, float]) -> None:
        """ends: of the slider."""
        self._value, (self._low, self._high), self._is_out = value, ends, is_out
        if not self.name.hasFocus():
            self.name.setText(name)
            self.name.setCursorPosition(0)
        self.name.setToolTip(f"{name}: its name, to be typed")
        for widget, words in (
            (self.name, f"Name of {name}"),
            (self.slider, f"Value of {name}"),
            (self.box, f"Value of {name}, typed"),
            (self.eye, f"Leave {name} out of the interpolants" if not is_out else f"Take {name} in again"),
            (self.cross, f"Remove {name}"),
        ):
            widget.setAccessibleName(words)
        self.eye.setToolTip(self.eye.accessibleName())
        self.cross.setToolTip(self.cross.accessibleName())
        self.eye.icon_name = "eye-off" if is_out else "eye"
        self.eye.update()
        if not self.box.hasFocus() or not self.box.isModified():
            self.box.setText(tick(value))
            self.box.setCursorPosition(0)  # of a long one the first digits are seen
            mark_wrong(self.box, False)
        if not self.slider.isSliderDown():
            share = (value - self._low) / (self._high - self._low) if self._high > self._low else 0.5
            with QtCore.QSignalBlocker(self.slider):
                self.slider.setValue(round(STEPS * min(max(share, 0), 1)))
        self.slider.setEnabled(not is_out)

    def show_chosen(self, is_chosen: bool) -> None:
        """Let the row stand out, or no longer."""
        if is_chosen != self._is_chosen:
            self._is_chosen = is_chosen
            self._show_cross()
            self.update()

    def _show_cross(self) -> None:
        """Where it is meant: on the row that is chosen, or pointed at."""
        self.cross.setVisible(self._is_chosen or self.underMouse())

    def enterEvent(self, event: QtCore.QEvent) -> None:
        self._show_cross()

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._show_cross()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if self._is_chosen:
            QtGui.QPainter(self).fillRect(self.rect(), QtGui.QColor(LOOK.theme.selection))

    # ------------------------------------------------------------------ what the user does
    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.FocusIn:
            self._choose()
        if event.type() == QtCore.QEvent.Type.KeyPress and self._pressed(watched, event.key()):
            return True
        return bool(super().eventFilter(watched, event))

    def _pressed(self, widget: QtCore.QObject, key: int) -> bool:
        """Whether that was a key of the list: up and down, and away with it where nothing is typed."""
        keys = QtCore.Qt.Key
        if key in (keys.Key_Up, keys.Key_Down):
            self.stepped.emit(self.point, 1 if key == keys.Key_Down else -1)
        elif key in (keys.Key_Delete, keys.Key_Backspace) and widget is self.slider:
            self._remove()
        else:
            return False
        return True

    def take_keys(self, like: "AnchorRow") -> None:
        """The keys go to the same part that has them in another row."""
        for mine, theirs in ((self.name, like.name), (self.box, like.box), (self.slider, like.slider)):
            if theirs.hasFocus():
                mine.setFocus(QtCore.Qt.FocusReason.TabFocusReason)
                return

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self._choose()
        super().mousePressEvent(event)

    def _choose(self) -> None:
        self.chosen.emit(self.point)

    def _turn_eye(self) -> None:
        self.left_out.emit(self.point, not self._is_out)

    def _remove(self) -> None:
        self.removed.emit(self.point)

    def _name(self) -> None:
        self.named.emit(self.point, self.name.text().strip())

    def _slide(self, step: int) -> None:
        size = self._high - self._low
        # As round as a step of the slider allows.
        places = max(0, math.ceil(-math.log10(size / STEPS)) if size > 0 else 0)
        value = round(self._low + size * step / STEPS, places)
        self.valued.emit(self.point, value, self.slider.isSliderDown())

    def _settle(self) -> None:
        self.valued.emit(self.point, self._value, False)

    def _type(self) -> None:
        if not self.box.isModified():
            return
        try:
            value = float(self.box.text().replace(MINUS, "-"))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            mark_wrong(self.box, True)
            self.box.setToolTip("A number, please")
            return
        self.box.setModified(False)
        self.valued.emit(self.point, value, False)
