"""Instruments: widgets in docks that show a part of the session's document, and of its answers.

An instrument decides nothing: what is done in it becomes an edit of the document, which comes back by `show_document`.
"""

from typing import ClassVar

from qtpy import QtCore, QtWidgets

from ...document.document import Document
from ..context import Context
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
