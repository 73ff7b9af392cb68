"""Texts broken into lines."""

from qtpy import QtCore, QtGui

ANYWHERE = QtGui.QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere


def lines_of(
    text: str, font: QtGui.QFont, width: float, most: int, wrap: QtGui.QTextOption.WrapMode = ANYWHERE
) -> list[str]:
    """A text broken into at most so many lines of a width; what does not fit ends in dots."""
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
