"""A dock with the head of a panel: its title, buttons, and a cross that closes it."""

from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK
from ..panels.flat_button import FlatButton

HEAD = 36
"""Height of the head, in logical pixels."""

PAD = 12

LEAST_LETTERS = 5
"""Of a note that is cut short."""


class _Note(QtWidgets.QLabel):
    """Cut short with dots where there is no room, and gone where there is none for a word."""

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, super().minimumSizeHint().height())

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        shown = self.fontMetrics().elidedText(self.text(), QtCore.Qt.TextElideMode.ElideRight, self.width())
        if len(shown) > LEAST_LETTERS or shown == self.text():
            flags = QtCore.Qt.AlignmentFlag.AlignVCenter | QtCore.Qt.AlignmentFlag.AlignLeft
            painter.drawText(self.rect(), int(flags), shown)


class DockHead(QtWidgets.QWidget):
    """title: what it is; note: quiet, beside it; `add` puts buttons at its right, before the cross."""

    closed = QtCore.Signal()

    def __init__(self, title: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._title, self._note = QtWidgets.QLabel(title), _Note()
        self._title.setProperty("heading", True)
        self._note.setProperty("quiet", True)
        self.close_button = FlatButton(self, "close")
        self.close_button.setToolTip(f"Close {title.lower()}")
        self.close_button.setAccessibleName(f"Close {title.lower()}")
        self.close_button.activated.connect(self.closed)
        self._row = QtWidgets.QHBoxLayout(self)
        self._row.setContentsMargins(PAD, 0, 4, 0)
        self._row.setSpacing(8)
        self._row.addWidget(self._title)
        self._row.addWidget(self._note)
        self._row.addStretch(1)
        self._row.addWidget(self.close_button)
        self.setFixedHeight(HEAD)
        LOOK.follow(self, self.update)

    def sizeHint(self) -> QtCore.QSize:
        """A dock gives its head the height of this, and no other."""
        return QtCore.QSize(super().sizeHint().width(), HEAD)

    def add(self, widget: QtWidgets.QWidget, after_title: bool = False) -> None:
        """A button or a choice."""
        place = 2 if after_title else self._row.count() - 1
        self._row.insertWidget(place, widget)

    def say(self, note: str) -> None:
        """Write a short note beside the dock's title."""
        self._note.setText(note)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.fillRect(event.rect(), QtGui.QColor(LOOK.theme.window))
        painter.fillRect(0, self.height() - 1, self.width(), 1, QtGui.QColor(LOOK.theme.border))


class Dock(QtWidgets.QDockWidget):
    """An instrument's place in the window.  word: one of `DOCKS`.  What is in it is `content`."""

    wants_closed = QtCore.Signal(str)

    def __init__(self, word: str, title: str, content: QtWidgets.QWidget, parent: QtWidgets.QMainWindow) -> None:
        super().__init__(title, parent)
        self.word, self.content = word, content
        self.setObjectName(f"dock {word}")
        self.head = DockHead(title, self)
        self.head.closed.connect(self._close)
        feature = QtWidgets.QDockWidget.DockWidgetFeature
        self.setFeatures(feature.DockWidgetClosable | feature.DockWidgetMovable | feature.DockWidgetFloatable)
        self.setTitleBarWidget(self.head)
        self.setWidget(content)

    def _close(self) -> None:
        self.wants_closed.emit(self.word)

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        """By the desktop's own cross, where it floats."""
        event.ignore()
        self._close()
