"""A row of the list of anchors: an eye, a name, a slider and a box for the value, and a cross."""

import math

from qtpy import QtCore, QtGui

from ...qt.docks.instrument import PAD
from ...qt.docks.slider_box import Scale, SliderBox
from ...qt.look.controls import TextBox
from ...qt.look.form import in_row, keep_room
from ...qt.look.look import LOOK
from ...qt.panels.flat_button import FlatButton

SLIDER_STEPS = 1000
ROW_HEIGHT_PX, BOX_WIDTH_PX = 34, 54
"""Logical pixels of a row, and of the box for its value."""


class AnchorRow(SliderBox):
    """An anchor in the list, by the name of its point; changes are emitted, and shown when `show_anchor` is called."""

    named = QtCore.Signal(str)
    left_out = QtCore.Signal(bool)
    removed = QtCore.Signal()
    chosen = QtCore.Signal()
    stepped = QtCore.Signal(int)  # to the row above (-1) or below

    def __init__(self, point: str) -> None:
        super().__init__(Scale(0.0, 1.0, steps=SLIDER_STEPS), BOX_WIDTH_PX)
        self.point = point
        self._is_chosen = self._is_out = False
        self.eye, self.cross = FlatButton(self, "eye"), FlatButton(self, "delete")
        self.name = TextBox()
        self.name.setFrame(False)
        self.name.setProperty("plain", True)
        self.name.setMinimumWidth(40)
        keep_room(self.cross)
        self.cross.hide()
        parts = self.eye, (self.name, 1), (self.slider, 1), self.box, self.cross
        in_row(*parts, of=self, spacing=4, margins=(6, 0, PAD, 0))
        self.setFixedHeight(round(ROW_HEIGHT_PX * LOOK.scale))
        self.eye.activated.connect(lambda: self.left_out.emit(not self._is_out))
        self.cross.activated.connect(self.removed)
        self.name.editingFinished.connect(lambda: self.named.emit(self.name.text().strip()))
        self.slider.sliderPressed.connect(self.chosen)
        for widget in (self.name, self.box, self.slider):
            widget.installEventFilter(self)

    # ------------------------------------------------------------------ what is told
    def show_anchor(self, name: str, value: float, is_out: bool, ends: tuple[float, float]) -> None:
        """Show an anchor; `ends` are those of the slider."""
        self._is_out = is_out
        if not self.name.hasFocus():
            self.name.setText(name)
            self.name.setCursorPosition(0)
        self.name.setToolTip(f"Name of {name}")
        self.name.setAccessibleName(f"Name of {name}")
        eye = f"Include {name} again" if is_out else f"Exclude {name} from the interpolants"
        for button, words in ((self.eye, eye), (self.cross, f"Remove {name}")):
            button.setAccessibleName(words)
            button.setToolTip(words)
        self.eye.icon_name = "eye-off" if is_out else "eye"
        self.eye.update()
        self.name_value(f"Value of {name}")
        low, high = ends
        # As round as a step of the slider allows.
        digits = max(0, math.ceil(-math.log10((high - low) / SLIDER_STEPS))) if high > low else 0
        self.show_value(value, Scale(low, high, digits=digits, steps=SLIDER_STEPS))
        self.slider.setEnabled(not is_out)

    def show_chosen(self, is_chosen: bool) -> None:
        """Highlight the row, or no longer."""
        if is_chosen != self._is_chosen:
            self._is_chosen = is_chosen
            self._show_cross()
            self.update()

    def _show_cross(self) -> None:
        """Show the cross on the row that is chosen or under the pointer."""
        self.cross.setVisible(self._is_chosen or self.underMouse())

    def enterEvent(self, event: QtCore.QEvent) -> None:
        self._show_cross()

    leaveEvent = enterEvent

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if self._is_chosen:
            QtGui.QPainter(self).fillRect(self.rect(), QtGui.QColor(LOOK.theme.selection))

    # ------------------------------------------------------------------ what the user does
    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.FocusIn:
            self.chosen.emit()
        if event.type() == QtCore.QEvent.Type.KeyPress and self._pressed(watched, event.key()):
            return True
        return bool(super().eventFilter(watched, event))

    def _pressed(self, widget: QtCore.QObject, key: int) -> bool:
        """Handle the keys of the list, Up, Down and Delete; return whether it was one of them."""
        keys = QtCore.Qt.Key
        if key in (keys.Key_Up, keys.Key_Down):
            self.stepped.emit(1 if key == keys.Key_Down else -1)
        elif key in (keys.Key_Delete, keys.Key_Backspace) and widget is self.slider:
            self.removed.emit()
        else:
            return False
        return True

    def take_keys(self, like: "AnchorRow") -> None:
        """Give the focus to the part of this row that has it in another row."""
        for mine, theirs in ((self.name, like.name), (self.box, like.box), (self.slider, like.slider)):
            if theirs.hasFocus():
                mine.setFocus(QtCore.Qt.FocusReason.TabFocusReason)
                return

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.chosen.emit()
        super().mousePressEvent(event)
