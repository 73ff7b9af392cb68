"""The size of a figure: named sizes, and boxes for a custom one."""

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.scalars import with_decimal_point

from ...figures.size import PRINT_DPI, Size
from ..look.form import in_column, in_row, quiet_label
from ..look.look import LOOK

UNITS = {"mm": "millimetres", "px": "pixels"}

SizeNames = tuple[tuple[str, str, str], ...]
"""The name of each size, its text for `Size.parse`, and the detail beside it."""


class SizeBoxes(QtWidgets.QWidget):
    """Rows of sizes over boxes for a custom one; `changed` is emitted when the size changes."""

    changed = QtCore.Signal()

    def __init__(self, sizes: SizeNames, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._sizes, self._written = sizes, ""
        self.rows = QtWidgets.QButtonGroup(self)
        column = in_column(of=self, spacing=0)
        for number, (name, _, detail) in enumerate((*sizes, ("Custom", "", ""))):
            row = _SizeRow(name, detail)
            row.setToolTip(f"{name}: {detail}" if detail else "The size in the boxes below")
            row.setAccessibleName(f"Size: {name}, {detail}" if detail else f"Size: {name}")
            self.rows.addButton(row, number)
            column.addWidget(row)
        self.width_box, self.height_box = self._box("Width"), self._box("Height")
        about = "Millimetres as printed, or pixels"
        self.unit = QtWidgets.QComboBox(accessibleName="Unit of the size", toolTip=about)
        self.unit.addItems(list(UNITS))
        self.dpi = self._box("Pixels per inch")
        sides = (self.width_box, 1), QtWidgets.QLabel("×"), (self.height_box, 1)
        line = in_row(*sides, self.unit, (self.dpi, 1), quiet_label("dpi"), spacing=6, margins=(0, 8, 0, 0))
        column.addLayout(line)
        self.rows.idClicked.connect(self._take_row)
        for box in (self.width_box, self.height_box, self.dpi):
            box.textEdited.connect(self._written_by_hand)
        self.unit.activated.connect(self._written_by_hand)
        self.write("")

    def text(self) -> str:
        """Return the size for `Size.parse`, empty for the default, and unchanged text where the size is unchanged."""
        text = self._text()
        return self._written if _read(text) == _read(self._written) else text

    def _text(self) -> str:
        number = self.rows.checkedId()
        if 0 <= number < len(self._sizes):
            return str(self._sizes[number][1])
        width, height, dpi = (with_decimal_point(box.text()) for box in (self.width_box, self.height_box, self.dpi))
        if not width and not height and not dpi:
            return ""
        short = self.unit.currentText()
        for number, unit in ((width, UNITS[short]), (height, UNITS[short]), (dpi, "dpi")):
            if number and not _is_number(number):
                raise ParameterError(f"{number!r} is not a number of {unit}.")
        if height and not width:
            raise ParameterError("A height needs a width.")
        return f"{width}{'x' if height else ''}{height}{short}{'@' if dpi else ''}{dpi}"

    def name(self) -> str:
        """Return the name of the chosen row."""
        return str(self.rows.checkedButton().text())

    def write(self, text: str) -> None:
        """Show a size by its row, or as a custom one."""
        self._written = text
        text = text.strip().replace("×", "x")
        known = [_read(written) for _, written, _ in self._sizes]
        size = _read(text)
        self.rows.button(known.index(size) if size is not None and size in known else len(known)).setChecked(True)
        self._fill(text)
        self.changed.emit()

    def _fill(self, text: str) -> None:
        known = _read(text)
        size = Size() if known is None else known
        for box, number in ((self.width_box, size.width), (self.height_box, size.height), (self.dpi, size.dpi)):
            box.setText("" if number is None else f"{number:g}")
        if known is None:
            self.width_box.setText(text)
        self.unit.setCurrentText(size.unit)
        self._show_usual()

    def _show_usual(self) -> None:
        """Show what an empty box stands for."""
        for box in (self.width_box, self.height_box):
            box.setPlaceholderText("auto")
        self.dpi.setPlaceholderText(f"{PRINT_DPI:g}" if self.unit.currentText() == "mm" else "auto")

    def _take_row(self, number: int) -> None:
        if number < len(self._sizes):
            self._fill(self._sizes[number][1])
        else:
            self.width_box.setFocus()
            self.width_box.selectAll()
        self.changed.emit()

    def _written_by_hand(self, *_: object) -> None:
        self.rows.button(len(self._sizes)).setChecked(True)
        self._show_usual()
        self.changed.emit()

    def _box(self, name: str) -> QtWidgets.QLineEdit:
        called = f"{name} of the figure" if name != "Pixels per inch" else name
        box = QtWidgets.QLineEdit(accessibleName=called, toolTip=f"{name}; leave empty for automatic")
        box.setMinimumWidth(round(46 * LOOK.scale))
        return box


def in_words(text: str) -> str:
    """Return a size in words: "85 mm", "1920 × 1080 px"."""
    size = Size.parse(text)
    return f"{' × '.join(f'{side:g}' for side in (size.width, size.height) if side is not None)} {size.unit}"


def _read(text: str) -> Size | None:
    try:
        return Size.parse(text) if text else Size(unit="mm")
    except ParameterError:
        return None


def _is_number(text: str) -> bool:
    try:
        return 0 < float(text) < float("inf")
    except ValueError:
        return False


class _SizeRow(QtWidgets.QRadioButton):
    """A radio button with a quiet detail at its end."""

    def __init__(self, name: str, detail: str) -> None:
        super().__init__(name)
        self._detail = detail
        self.setProperty("row", True)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        painter = QtGui.QPainter(self)
        painter.setFont(LOOK.font())
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        align = QtCore.Qt.AlignmentFlag
        painter.drawText(self.rect().adjusted(0, 0, -8, 0), align.AlignRight | align.AlignVCenter, self._detail)
