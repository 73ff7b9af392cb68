"""Where a colour bar ends: a number to type, or the field's own maximum."""

from qtpy import QtCore, QtWidgets

from ...document.looks import LARGEST
from ..look.numbers import MINUS, number
from ..look.text_box import TextBox, mark_wrong
from .number_box import PopUp


class EndPopUp(PopUp):
    """`chosen(float)` for a number, `chosen(None)` for the field's own maximum."""

    chosen = QtCore.Signal(object)

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.words = QtWidgets.QLabel("The colours end at", self)
        self.words.setProperty("quiet", True)
        self.box = TextBox(self)
        self.box.setFixedWidth(110)
        self.box.setAccessibleName("Where the colours end")
        self.box.returnPressed.connect(self._typed)
        self.box.textEdited.connect(lambda: self._complain(""))
        self.own = QtWidgets.QPushButton("Its own maximum", self)
        self.own.clicked.connect(lambda: self._choose(None))
        self.complaint = QtWidgets.QLabel("", self)
        self.complaint.setProperty("error", True)
        self.complaint.setWordWrap(True)
        self.complaint.hide()
        grid = QtWidgets.QGridLayout(self)
        grid.setContentsMargins(12, 10, 12, 12)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(8)
        grid.addWidget(self.words, 0, 0, 1, 2)
        grid.addWidget(self.box, 1, 0)
        grid.addWidget(self.own, 1, 1)
        grid.addWidget(self.complaint, 2, 0, 1, 2)

    def ask(self, control: QtWidgets.QWidget, end: float, maximum: float, unit: str) -> None:
        """Open under the colour bar; end: where the colours end now; maximum: the field's own."""
        self.words.setText(f"The colours end at{f' ({unit})' if unit else ''}")
        self.box.setText(f"{end:.6g}")
        self.own.setToolTip(number(maximum))
        self.own.setEnabled(end != maximum)
        self._complain("")
        self.adjustSize()
        self.open_under(control, (control.width() - self.width()) // 2)
        self.box.setFocus(QtCore.Qt.FocusReason.PopupFocusReason)
        self.box.selectAll()

    def _typed(self) -> None:
        text = self.box.text().strip().replace(MINUS, "-")
        try:
            end = float(text.replace(",", "")) if text.count(",") != 1 or "." in text else float(text.replace(",", "."))
        except ValueError:
            end = float("nan")
        if not 1 / LARGEST <= end <= LARGEST:
            self._complain(f"{text!r} is not a positive number.")
            return
        self._choose(end)

    def _choose(self, end: float | None) -> None:
        self.close()
        self.chosen.emit(end)

    def _complain(self, text: str) -> None:
        self.complaint.setText(text)
        self.complaint.setVisible(bool(text))
        mark_wrong(self.box, bool(text))
        self.adjustSize()
