"""A dock with the head of a panel: its title, buttons, and a cross that closes it."""

from qtpy import QtCore, QtGui, QtWidgets

from ..look.layouts import heading, in_row
from ..look.look import LOOK
from ..look.text_lines import ElidedLabel
from ..panels.flat_button import icon_button

HEAD = 36
"""Height of the head, in logical pixels."""

PAD = 12

LEAST_NOTE = 5
"""Characters of a note that is cut short; it is hidden where fewer would be left."""


class DockHead(QtWidgets.QWidget):
    """The head of a dock: its title, a quiet note beside it, buttons, and a cross that closes it."""

    closed = QtCore.Signal()

    def __init__(self, title: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._note = ElidedLabel(QtCore.Qt.TextElideMode.ElideRight, LEAST_NOTE)
        self._note.setProperty("quiet", True)
        self.close_button = icon_button(self, "close", f"Close {title.lower()}", self.closed.emit)
        parts = heading(title), self._note, None, self.close_button
        self._row = in_row(*parts, of=self, spacing=8, margins=(PAD, 0, 4, 0))
        self.setFixedHeight(HEAD)
        LOOK.follow(self, self.update)

    def sizeHint(self) -> QtCore.QSize:
        """Return the height that a dock gives its head."""
        return QtCore.QSize(super().sizeHint().width(), HEAD)

    def add(self, widget: QtWidgets.QWidget, after_title: bool = False) -> None:
        """Add a widget before the cross, or beside the title."""
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
    """A dock of the window with an instrument, its `content`; `word` is that of the instrument's tool."""

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
        """Leave it to the document to close a floating dock by the desktop's own cross."""
        event.ignore()
        self._close()
