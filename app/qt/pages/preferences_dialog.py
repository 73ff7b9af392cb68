"""The dialog of Edit > Preferences."""

from dataclasses import replace

from qtpy import QtCore, QtGui, QtWidgets

from ...document.looks import MOST_ISOLINES
from ..look.layouts import in_column, in_row, quiet_label
from ..look.look import LOOK
from ..look.segments import Segments
from ..preferences import Preferences

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
        self.theme = _segments(THEMES, "Theme", "The colours of the window; figures keep their own")
        self.theme.chosen.connect(LOOK.choose)
        self.isolines = QtWidgets.QSpinBox(maximum=MOST_ISOLINES, accessibleName="Isolines of new meshes")
        about = f"About how many, at round values, when the program starts: 0 to {MOST_ISOLINES}, 0 for none"
        self.isolines.setToolTip(about)
        self.isolines.setFixedWidth(84)
        self.wheel = _segments(WHEEL, "Wheel", "What turning the wheel away from you does to the view")
        on_turntable = "On a turntable, what is up stays upright while the surface is dragged"
        self.turning = _segments(TURNING, "Turning", on_turntable)
        self.snapping = _segments(SNAPPING, "Source", "Where a click and a drag put the source; V switches it")
        self.again = QtWidgets.QPushButton("Reset all preferences", objectName="link", autoDefault=False)
        self.again.setToolTip("Everything as at the first start, also the window's place; Cancel undoes it")
        self.again.clicked.connect(self.reset)
        self.note = quiet_label()
        self.note.setMinimumWidth(QtGui.QFontMetrics(LOOK.font()).horizontalAdvance(RESET) + 4)
        column = in_column(self._rows(), self._footer(), of=self, spacing=0)
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
        words = ("&Theme", "&Isolines", "&Wheel", "T&urning", "&Source")
        controls = (self.theme, self.isolines, self.wheel, self.turning, self.snapping)
        for row, (text, control) in enumerate(zip(words, controls, strict=True)):
            label = QtWidgets.QLabel(text)
            label.setBuddy(control)
            rows.addWidget(label, row, 0, left)
            beside = [quiet_label("at the start")] if control is self.isolines else []
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
        accept.setToolTip("Keep these preferences")
        refuse.setToolTip("All as it was before the dialog")
        for button in (accept, refuse):
            button.setMinimumWidth(76)
            button.setIcon(type(button.icon())())  # some desktops put pictures on them
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        in_row(self.again, self.note, None, buttons, of=footer, spacing=12, margins=(22, 12, 24, 12))
        return footer


def _segments(choices: dict[str, str], name: str, tip: str) -> Segments:
    segments = Segments(choices, name)
    segments.setToolTip(tip)
    return segments
