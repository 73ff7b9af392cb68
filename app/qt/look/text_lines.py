"""Texts broken into lines, or cut short to one."""

from qtpy import QtCore, QtGui, QtWidgets

ANYWHERE = QtGui.QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere


def lines_of(
    text: str, font: QtGui.QFont, width: float, most: int, wrap: QtGui.QTextOption.WrapMode = ANYWHERE
) -> list[str]:
    """Break a text into at most `most` lines of a width; what does not fit ends in dots."""
    text = " ".join(text.split())
    layout = QtGui.QTextLayout(text, font)
    option = QtGui.QTextOption()
    option.setWrapMode(wrap)
    layout.setTextOption(option)
    found: list[str] = []
    layout.beginLayout()
    while (line := layout.createLine()).isValid():
        line.setLineWidth(max(width, 1))
        rest = text[line.textStart() :]
        if len(found) == most - 1:
            found.append(QtGui.QFontMetrics(font).elidedText(rest, QtCore.Qt.TextElideMode.ElideRight, int(width)))
            break
        found.append(rest[: line.textLength()].rstrip())
    layout.endLayout()
    return found


class ElidedLabel(QtWidgets.QLabel):
    """A line of text that is cut short where there is no room, and gone if `least` characters would not be left."""

    def __init__(self, cut: QtCore.Qt.TextElideMode, least: int = 0) -> None:
        super().__init__()
        self._cut, self._least = cut, least

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, super().minimumSizeHint().height())

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        shown = self.fontMetrics().elidedText(self.text(), self._cut, self.width())
        if len(shown) > self._least or shown == self.text():
            painter.drawText(self.rect(), int(self.alignment()), shown)
