"""The dialog of Edit > Preferences."""

from dataclasses import replace

from qtpy import QtCore, QtGui, QtWidgets

from ...document.settings import PREFERENCES, Preferences, Setting
from ..look.controls import Segments
from ..look.form import in_column, in_row, quiet_label
from ..look.look import LOOK

RESET = "Defaults restored."
LABELS = 88
"""The width of the column of labels."""


class PreferencesDialog(QtWidgets.QDialog):
    """Starts from `preferences`; the theme is seen at once, and is again what it was when the dialog is cancelled."""

    def __init__(self, preferences: Preferences, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Preferences")
        self._preferences = preferences  # what the dialog has no control for comes from here
        self._theme_before = LOOK.choice
        self.controls: dict[str, Segments | QtWidgets.QSpinBox] = {each.word: _control(each) for each in PREFERENCES}
        self.controls["theme"].chosen.connect(LOOK.choose)
        self.again = QtWidgets.QPushButton("Reset all preferences", objectName="link", autoDefault=False)
        self.again.setToolTip("Restore defaults, also the window's place; Cancel undoes it")
        self.again.clicked.connect(self.reset)
        self.note = quiet_label()
        self.note.setMinimumWidth(QtGui.QFontMetrics(LOOK.font()).horizontalAdvance(RESET) + 4)
        column = in_column(self._rows(), self._footer(), of=self, spacing=0)
        column.setSizeConstraint(QtWidgets.QLayout.SizeConstraint.SetFixedSize)
        self._show(preferences)
        self.rejected.connect(lambda: LOOK.choose(self._theme_before))
        LOOK.apply_theme(self)

    def chosen(self) -> Preferences:
        """Return the preferences as the dialog stands."""
        controls = self.controls.items()
        values = {word: each.choice() if isinstance(each, Segments) else each.value() for word, each in controls}
        return replace(self._preferences, **values)

    def reset(self) -> None:
        """Restore all defaults, also of what has no control here."""
        self._preferences = Preferences()
        self._show(self._preferences)
        LOOK.choose(self._preferences.theme)
        self.note.setText(RESET)

    def _show(self, preferences: Preferences) -> None:
        for word, control in self.controls.items():
            value = getattr(preferences, word)
            if isinstance(control, Segments):
                control.choose(value)
            else:
                control.setValue(value)

    def _rows(self) -> QtWidgets.QLayout:
        rows = QtWidgets.QGridLayout()
        rows.setContentsMargins(24, 24, 24, 24)
        rows.setHorizontalSpacing(16)
        rows.setVerticalSpacing(16)
        rows.setColumnMinimumWidth(0, LABELS)
        left = QtCore.Qt.AlignmentFlag.AlignLeft | QtCore.Qt.AlignmentFlag.AlignVCenter
        for row, (setting, control) in enumerate(zip(PREFERENCES, self.controls.values(), strict=True)):
            label = QtWidgets.QLabel(setting.title)
            label.setBuddy(control)
            rows.addWidget(label, row, 0, left)
            beside = [quiet_label(setting.unit)] if setting.unit else []
            rows.addLayout(in_row(control, *beside, spacing=8), row, 1, left)
        rows.setColumnStretch(1, 1)
        return rows

    def _footer(self) -> QtWidgets.QWidget:
        footer = QtWidgets.QFrame(objectName="footer")
        buttons = QtWidgets.QDialogButtonBox()
        accept = buttons.addButton(QtWidgets.QDialogButtonBox.StandardButton.Ok)
        refuse = buttons.addButton(QtWidgets.QDialogButtonBox.StandardButton.Cancel)
        refuse.setAutoDefault(False)
        accept.setObjectName("fill")
        accept.setToolTip("Save preferences")
        refuse.setToolTip("Discard changes")
        for button in (accept, refuse):
            button.setMinimumWidth(76)
            button.setIcon(type(button.icon())())  # some desktops put pictures on them
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        in_row(self.again, self.note, None, buttons, of=footer, spacing=12, margins=(22, 12, 24, 12))
        return footer


def _control(setting: Setting) -> Segments | QtWidgets.QSpinBox:
    """Return a control for a preference: one of several values, or a whole number."""
    name = setting.title.replace("&", "")
    if setting.choices:
        control = Segments({text: value for value, text in setting.choices.items()}, name)
    else:
        control = QtWidgets.QSpinBox(maximum=setting.most, accessibleName=f"{name} {setting.unit}")
        control.setFixedWidth(84)
    control.setToolTip(setting.tip)
    return control
