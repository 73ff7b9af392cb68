"""Rows and columns of widgets, filled where they are made, and forms of labelled controls in dialogs and docks."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias, TypeVar

from qtpy import QtCore, QtGui, QtWidgets

from .controls import Segments, mark_wrong
from .look import LOOK

Part: TypeAlias = QtWidgets.QWidget | QtWidgets.QLayout | int | None
"""A widget, a layout, so many pixels of space, or None for what takes all that is left."""

Parts: TypeAlias = Part | tuple[Part, int] | tuple[Part, int, QtCore.Qt.AlignmentFlag]
"""A part by itself, or with its stretch and alignment."""

Box = TypeVar("Box", bound=QtWidgets.QBoxLayout)


def in_row(
    *parts: Parts,
    of: QtWidgets.QWidget | None = None,
    spacing: int = -1,
    margins: Sequence[int] = (0, 0, 0, 0),
) -> QtWidgets.QHBoxLayout:
    """Lay out parts from left to right, in a widget if one is given; a negative spacing is that of the style."""
    return _filled(QtWidgets.QHBoxLayout(), parts, of, spacing, margins)


def in_column(
    *parts: Parts,
    of: QtWidgets.QWidget | None = None,
    spacing: int = -1,
    margins: Sequence[int] = (0, 0, 0, 0),
) -> QtWidgets.QVBoxLayout:
    """Lay out parts one below the other, in a widget if one is given; a negative spacing is that of the style."""
    return _filled(QtWidgets.QVBoxLayout(), parts, of, spacing, margins)


def _filled(
    layout: Box, parts: Sequence[Parts], of: QtWidgets.QWidget | None, spacing: int, margins: Sequence[int]
) -> Box:
    if of is not None:
        of.setLayout(layout)
    layout.setSpacing(spacing)
    layout.setContentsMargins(*margins)
    add_parts(layout, parts)
    return layout


def add_parts(layout: QtWidgets.QBoxLayout, parts: Sequence[Parts]) -> None:
    """Add parts at the end of a row or a column."""
    for each in parts:
        part, *how = each if isinstance(each, tuple) else (each,)
        if part is None:
            layout.addStretch(1)
        elif isinstance(part, int):
            layout.addSpacing(part)
        elif isinstance(part, QtWidgets.QLayout):
            layout.addLayout(part, *how)
        else:
            layout.addWidget(part, *how)


def keep_room(widget: QtWidgets.QWidget) -> None:
    """Let a widget have its room in a row while it is hidden as well."""
    policy = widget.sizePolicy()
    policy.setRetainSizeWhenHidden(True)
    widget.setSizePolicy(policy)


# ---------------------------------------------------------------------- small widgets
def quiet_label(text: str = "", wraps: bool = False) -> QtWidgets.QLabel:
    """Return a label in the colour of secondary text."""
    label = QtWidgets.QLabel(text, wordWrap=wraps)
    label.setProperty("quiet", True)
    return label


def heading(text: str, tip: str = "") -> QtWidgets.QLabel:
    """Return the title of a section."""
    label = QtWidgets.QLabel(text, toolTip=tip)
    label.setProperty("heading", True)
    return label


def hairline() -> QtWidgets.QFrame:
    """Return a thin line between sections."""
    return QtWidgets.QFrame(objectName="hairline")


def push_button(text: str, do: Callable[..., object] | None = None, tip: str = "") -> QtWidgets.QPushButton:
    """Return a button that Enter in a box does not press."""
    button = QtWidgets.QPushButton(text, autoDefault=False, toolTip=tip)
    if do is not None:
        button.clicked.connect(do)
    return button


class Choice(QtWidgets.QComboBox):
    """A list of texts by the words they stand for; it does not insist on the width of its longest entry."""

    def __init__(self, texts: Mapping[str, str], now: str) -> None:
        super().__init__()
        for word, text in texts.items():
            self.addItem(text, word)
        self.setCurrentIndex(max(self.findData(now), 0))
        self.setSizeAdjustPolicy(QtWidgets.QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(12)


class Count(QtWidgets.QSpinBox):
    """A whole number, written or changed with the arrow keys; `nothing` is shown instead of the least number."""

    def __init__(self, least: int, most: int, value: int, suffix: str = "", nothing: str = "") -> None:
        super().__init__(minimum=least, maximum=most, value=value, suffix=suffix, specialValueText=nothing)
        self.setButtonSymbols(QtWidgets.QAbstractSpinBox.ButtonSymbols.NoButtons)


class Form(QtWidgets.QWidget):
    """A column of headings, of controls with labels before them, and of other widgets.

    `changed` is emitted when a control is changed; `values()` has those of the rows with a name.  An error can be
    shown under the control it is about.
    """

    changed = QtCore.Signal()

    def __init__(self, label_width: int = 0, spacing: int = 8, margins: Sequence[int] = (0, 0, 0, 0)) -> None:
        super().__init__()
        self._label_width = label_width
        self._named: dict[str, QtWidgets.QWidget] = {}
        self.errors: dict[QtWidgets.QWidget, QtWidgets.QLabel] = {}
        self.column = in_column(of=self, spacing=spacing, margins=margins)

    def add(self, *parts: Parts) -> None:
        """Add widgets, layouts, spaces or stretches below what is there."""
        add_parts(self.column, parts)

    def section(self, title: str, tip: str = "") -> QtWidgets.QLabel:
        """Add the title of what is added next."""
        label = heading(title, tip)
        self.add(*((12, label) if self.column.count() else (label,)))
        return label

    def row(self, label: str, control: QtWidgets.QWidget, tip: str = "", name: str = "", unit: str = "") -> None:
        """Add a control with a label before it, which has its access key, and its unit after it."""
        words = QtWidgets.QLabel(label, toolTip=tip)
        words.setBuddy(control)
        words.setMinimumWidth(round(self._label_width * LOOK.scale))
        describe(control, label, tip)
        is_fixed = control.sizePolicy().horizontalPolicy() == QtWidgets.QSizePolicy.Policy.Fixed
        is_fixed |= control.minimumWidth() == control.maximumWidth()
        after = (quiet_label(unit),) if unit else ()
        self.add(in_row(words, *((control, *after, None) if is_fixed else ((control, 1), *after))))
        self.add_error(control)
        self._follow(control, name)

    def tick(self, text: str, is_on: bool, tip: str = "", name: str = "") -> QtWidgets.QCheckBox:
        """Add a check box."""
        box = QtWidgets.QCheckBox(text, checked=is_on)
        describe(box, text, tip)
        self.add(box)
        self._follow(box, name)
        return box

    # ------------------------------------------------------------------ the wheel
    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        for kind in (QtWidgets.QComboBox, QtWidgets.QAbstractSpinBox, QtWidgets.QSlider):
            for control in self.findChildren(kind):
                control.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
                control.installEventFilter(self)

    def eventFilter(self, control: QtCore.QObject, event: QtCore.QEvent) -> bool:
        """Let the wheel scroll the form, and not change a control that happens to come under the pointer."""
        is_scroll = event.type() == QtCore.QEvent.Type.Wheel and not control.hasFocus()
        if is_scroll:
            event.ignore()
        return is_scroll or bool(super().eventFilter(control, event))

    # ------------------------------------------------------------------ values
    def values(self) -> dict[str, Any]:
        """Return the values of the named rows; None for a number where its box shows words instead."""
        return {name: value_of(control) for name, control in self._named.items()}

    def _follow(self, control: QtWidgets.QWidget, name: str) -> None:
        for kind, signal in SIGNALS.items():
            if isinstance(control, kind):
                getattr(control, signal).connect(lambda *_: self.changed.emit())
        if name:
            self._named[name] = control

    # ------------------------------------------------------------------ errors
    def add_error(self, control: QtWidgets.QWidget) -> None:
        """Add the place where an error about a control is shown."""
        self.errors[control] = error_label()
        self.add(self.errors[control])

    def show_error(self, control: QtWidgets.QWidget, sentence: str) -> None:
        """Show what is wrong with a control, and give it the keyboard focus."""
        self.errors[control].setText(sentence)
        self.errors[control].setVisible(True)
        mark_wrong(control, True)
        control.setAccessibleDescription(sentence)
        control.setFocus()

    def clear_errors(self) -> None:
        """Hide all errors."""
        for control, label in self.errors.items():
            if not label.isHidden():
                label.setVisible(False)
                control.setAccessibleDescription("")
                mark_wrong(control, False)


SIGNALS = {
    QtWidgets.QCheckBox: "toggled",
    QtWidgets.QComboBox: "currentIndexChanged",
    QtWidgets.QSpinBox: "valueChanged",
    QtWidgets.QDoubleSpinBox: "valueChanged",
    QtWidgets.QLineEdit: "textEdited",
    Segments: "chosen",
}
"""The signal of each kind of control that tells of a change."""


def value_of(control: QtWidgets.QWidget) -> Any:
    """Return the value of a control; None for a number where the box shows words instead."""
    if isinstance(control, QtWidgets.QCheckBox):
        return control.isChecked()
    if isinstance(control, QtWidgets.QComboBox):
        return control.currentData()
    if isinstance(control, Segments):
        return control.choice()
    if isinstance(control, QtWidgets.QLineEdit):
        return control.text()
    is_special = control.specialValueText() and control.value() == control.minimum()
    return None if is_special else control.value()


def describe(control: QtWidgets.QWidget, name: str, tip: str) -> None:
    """Give a control its accessible name, here with or without an access key, and its tip."""
    control.setAccessibleName(name.replace("&", ""))
    control.setToolTip(tip)


def closing_buttons(
    dialog: QtWidgets.QDialog, accept: str, tip: str, cancel_tip: str
) -> tuple[QtWidgets.QDialogButtonBox, QtWidgets.QPushButton, QtWidgets.QPushButton]:
    """Return the box of the buttons that close a dialog, with its default button and Cancel, which is connected."""
    role = QtWidgets.QDialogButtonBox.ButtonRole
    box = QtWidgets.QDialogButtonBox(dialog)  # which a default button must know of
    default, cancel = box.addButton(accept, role.AcceptRole), box.addButton("Cancel", role.RejectRole)
    default.setDefault(True)
    default.setToolTip(tip)
    cancel.setAutoDefault(False)
    cancel.setToolTip(cancel_tip)
    box.rejected.connect(dialog.reject)
    return box, default, cancel


def error_label() -> QtWidgets.QLabel:
    """Return a hidden label for an error, which can be selected."""
    label = QtWidgets.QLabel("", wordWrap=True, visible=False)
    label.setTextFormat(QtCore.Qt.TextFormat.PlainText)
    label.setTextInteractionFlags(QtCore.Qt.TextInteractionFlag.TextSelectableByMouse)
    label.setProperty("error", True)
    return label
