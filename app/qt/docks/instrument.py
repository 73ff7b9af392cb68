"""Instruments: widgets in docks that show a part of the session's document, and of its answers; and these docks.

An instrument decides nothing: what is done in it becomes an edit of the document, which comes back by `show_document`.
"""

from typing import ClassVar

from qtpy import QtCore, QtGui, QtWidgets

from ...document.document import Document
from ..context import Context
from ..look.controls import ElidedLabel
from ..look.form import heading, in_row
from ..look.look import LOOK
from ..panels.flat_button import Do, FlatButton, icon_button

NO_FIELD = "The panel shows no field."
"""Shown for a panel with colours, or with a surface as it is."""


class Instrument(QtWidgets.QWidget):
    """The content of a tool's dock, at first in an `area` of the window, "right" or "below".

    `head` and `beside_title` are the buttons and choices in the dock's head, from left to right.  Only instruments in
    open docks are told anything; one that is opened gets `show_document` first.
    """

    word: ClassVar[str]
    area: ClassVar[str] = "right"

    note_changed = QtCore.Signal(str)  # a note beside the title

    def __init__(self, context: Context) -> None:
        super().__init__()
        self.context = context
        self.head: list[QtWidgets.QWidget] = []
        self.beside_title: list[QtWidgets.QWidget] = []
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_StyledBackground)

    @property
    def document(self) -> Document:
        """The document as it is now; docks are not told when the camera moves."""
        return self.context.document

    def add_head_button(self, icon: str, tip: str, do: Do, name: str = "") -> FlatButton:
        """Add a button to the dock's head that calls a function or opens a menu."""
        button = icon_button(self, icon, tip, do, name)
        self.head.append(button)
        return button

    def on_opened(self) -> None:
        """Take note that the user has opened the dock."""

    def show_document(self, document: Document, before: Document | None) -> None:
        """Show a document in place of the one before, which is None at first."""

    def show_answer(self, panel: int) -> None:
        """Show a panel's new answer, or what more is known of it."""

    def show_again(self) -> None:
        """Draw again what the panels have lost."""

    def end(self) -> None:
        """Stop what is being computed, as the window closes."""

    def show_closed(self) -> None:
        """Remove what it shows elsewhere, as the dock has been closed."""

    def show_stopped(self) -> None:
        """Show that the user has cancelled what was being computed or opened."""

    def leave(self) -> None:
        """End what makes no sense without the dock, as the user has closed it."""

    @property
    def pointed_surface(self) -> str:
        """The name of the surface whose vertices `show_pointed` gets."""
        return self.context.document.surfaces[0].name

    def show_pointed(self, vertex: int | None) -> None:
        """Show where the pointer is on that surface, in whichever panel."""


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
