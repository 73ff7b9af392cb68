"""The dialog of Edit > Preferences."""

from dataclasses import replace

from qtpy import QtCore, QtGui, QtWidgets

from ...document.looks import MOST_ISOLINES
from ..look.look import LOOK
from ..look.segments import Segments
from ..preferences import Preferences, load, save

THEMES = {"As the desktop": "desktop", "Light": "light", "Dark": "dark"}
TURNING = {"Freely": "", "Turntable": "turntable"}
SNAPPING = {"On vertices": "", "Anywhere in faces": "faces"}
WHEEL = {"Forwards goes closer": "", "Forwards goes away": "reversed"}
RESET = "All as at the first start."
LABELS = 88
"""The width of the column of labels."""


class PreferencesDialog(QtWidgets.QDialog):
    """Starts from `preferences`; the theme is seen at once, and is again what it was when the dialog is cancelled."""

    def __init__(self, preferences: Preferences, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Preferences")
        self._preferences = preferences  # what the dialog has no control for comes from here
        self._theme_before = LOOK.choice
        self.theme = Segments(THEMES, "Theme")
        self.theme.setToolTip("The colours of the window; figures keep their own")
        self.theme.chosen.connect(LOOK.choose)
        self.isolines = QtWidgets.QSpinBox(maximum=MOST_ISOLINES, accessibleName="Isolines of new meshes")
        self.isolines.setFixedWidth(84)
        self.isolines.setToolTip(
            f"About how many, at round values, when the program starts: 0 to {MOST_ISOLINES}, 0 for none"
        )
        self.wheel = Segments(WHEEL, "Wheel")
        self.wheel.setToolTip("What turning the wheel away from you does to the view")
        self.turning = Segments(TURNING, "Turning")
        self.turning.setToolTip("On a turntable, what is up stays upright while the surface is dragged")
        self.snapping = Segments(SNAPPING, "Source")
        self.snapping.setToolTip("Where a click and a drag put the source; V switches it")
        self.again = QtWidgets.QPushButton("Reset all preferences", objectName="link", autoDefault=False)
        self.again.setToolTip("Everything as at the first start, also the window's place; Cancel undoes it")
        self.again.clicked.connect(self.reset)
        self.note = QtWidgets.QLabel("")
        self.note.setProperty("quiet", True)
        self.note.setMinimumWidth(QtGui.QFontMetrics(LOOK.font()).horizontalAdvance(RESET) + 4)
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self._rows())
        column.addWidget(self._footer())
        column.setSizeConstraint(QtWidgets.QLayout.SizeConstraint.SetFixedSize)
        self._show(preferences)
        self.rejected.connect(lambda: LOOK.choose(self._theme_before))
        LOOK.apply_theme(self)

    def chosen(self) -> Preferences:
        """As the dialog stands."""
        return replace(
            self._preferences,
            theme=self.theme.choice(),
            isolines=self.isolines.value(),
            wheel_reversed=bool(self.wheel.choice()),
            turntable=bool(self.turning.choice()),
            snap=not self.snapping.choice(),
        )

    def reset(self) -> None:
        """All as at the first start, what has no control here too."""
        self._preferences = Preferences()
        self._show(self._preferences)
        LOOK.choose(self._preferences.theme)
        self.note.setText(RESET)

    def _show(self, preferences: Preferences) -> None:
        self.theme.choose(preferences.theme)
        self.isolines.setValue(preferences.isolines)
        self.wheel.choose("reversed" if preferences.wheel_reversed else "")
        self.turning.choose("turntable" if preferences.turntable else "")
        self.snapping.choose("" if preferences.snap else "faces")

    def _rows(self) -> QtWidgets.QLayout:
        rows = QtWidgets.QGridLayout()
        rows.setContentsMargins(24, 24, 24, 24)
        rows.setHorizontalSpacing(16)
        rows.setVerticalSpacing(16)
        rows.setColumnMinimumWidth(0, LABELS)
        left = QtCore.Qt.AlignmentFlag.AlignLeft | QtCore.Qt.AlignmentFlag.AlignVCenter
        beside = QtWidgets.QLabel("at the start")
        beside.setProperty("quiet", True)
        isolines = QtWidgets.QHBoxLayout()
        isolines.setSpacing(8)
        isolines.addWidget(self.isolines)
        isolines.addWidget(beside)
        for row, (text, content, control) in enumerate(
            [
                ("&Theme", self.theme, self.theme),
                ("&Isolines", isolines, self.isolines),
                ("&Wheel", self.wheel, self.wheel),
                ("T&urning", self.turning, self.turning),
                ("&Source", self.snapping, self.snapping),
            ]
        ):
            label = QtWidgets.QLabel(text)
            label.setBuddy(control)
            rows.addWidget(label, row, 0, left)
            add = rows.addLayout if isinstance(content, QtWidgets.QLayout) else rows.addWidget
            add(content, row, 1, left)
        rows.setColumnStretch(1, 1)
        return rows

    def _footer(self) -> QtWidgets.QWidget:
        footer = QtWidgets.QFrame(objectName="footer")
        row = QtWidgets.QHBoxLayout(footer)
        row.setContentsMargins(22, 12, 24, 12)
        row.setSpacing(12)
        buttons = QtWidgets.QDialogButtonBox()
        accept = buttons.addButton(QtWidgets.QDialogButtonBox.StandardButton.Ok)
        refuse = buttons.addButton(QtWidgets.QDialogButtonBox.StandardButton.Cancel)
        refuse.setAutoDefault(False)
        accept.setObjectName("fill")
        accept.setToolTip("Keep these preferences")
        refuse.setToolTip("All as it was before the dialog")
        for button in (accept, refuse):
            button.setMinimumWidth(76)
            button.setIcon(type(button.icon())())  # some desktops put pictures on them
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        row.addWidget(self.again)
        row.addWidget(self.note)
        row.addStretch(1)
        row.addWidget(buttons)
        return footer


def ask_preferences(parent: QtWidgets.QWidget | None = None) -> Preferences | None:
    """Let the user change the preferences, and save them; None if the dialog was cancelled."""
    dialog = PreferencesDialog(load(), parent)
    try:
        if not dialog.exec():
            return None
        save(dialog.chosen())
        return dialog.chosen()
    finally:
        dialog.deleteLater()
