"""Where a colour bar ends: a number to type, or the field's own maximum."""

from qtpy import QtWidgets

from ...document.looks import LARGEST
from ..look.numbers import MINUS, number
from .number_box import TypedPopUp


class EndPopUp(TypedPopUp):
    """`chosen(float)` for a number, `chosen(None)` for the field's own maximum."""

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__("The colours end at", parent)
        self.box.setFixedWidth(110)
        self.box.setAccessibleName("Where the colours end")
        self.own = QtWidgets.QPushButton("Its own maximum", self, clicked=lambda: self._choose(None))
        self._lay_out(self.box, self.own)

    def ask(self, control: QtWidgets.QWidget, end: float, maximum: float, unit: str) -> None:
        """Open under the colour bar; end: where the colours end now; maximum: the field's own."""
        self.words.setText(f"The colours end at{f' ({unit})' if unit else ''}")
        self.box.setText(f"{end:.6g}")
        self.own.setToolTip(number(maximum))
        self.own.setEnabled(end != maximum)
        self._complain("")
        self.adjustSize()
        self.open_under(control, (control.width() - self.width()) // 2)

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
