"""What every instrument is: a widget that shows a part of the session's document, and of its answers.

An instrument decides nothing: what is done in it becomes an edit of the document, which comes back by `show_document`.
"""

from typing import ClassVar

from qtpy import QtCore, QtWidgets

from ...document.document import Document
from ..context import Context

NO_FIELD = "The panel shows no field now."
"""Of one that shows colours, or a surface as it is."""


class Instrument(QtWidgets.QWidget):
    """word: the tool's; title: for the user; area: "right" or "below".

    Only instruments in open docks are told anything; one that is opened gets `show_document` first.
    """

    word: ClassVar[str]
    title: ClassVar[str]
    area: ClassVar[str] = "right"

    note_changed = QtCore.Signal(str)  # a note beside the title

    def __init__(self, context: Context) -> None:
        super().__init__()
        self.context = context
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_StyledBackground)

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        """Buttons and choices for the dock's head, from left to right."""
        return []

    def title_widgets(self) -> list[QtWidgets.QWidget]:
        """Buttons and choices beside the title, from left to right."""
        return []

    def on_opened(self) -> None:
        """The user has opened the dock."""

    def show_document(self, document: Document, before: Document | None) -> None:
        """Another document is there; before: the one that was shown, None if none was."""

    def show_answer(self, panel: int) -> None:
        """Another field is there, or what is known of it has changed."""

    def show_again(self) -> None:
        """The panels have forgotten what was drawn on them."""

    def end(self) -> None:
        """The window closes: stop what is being computed."""

    def show_closed(self) -> None:
        """The dock has been closed: take away what it has put elsewhere."""

    def show_stopped(self) -> None:
        """The user has stopped what was being computed, or opened."""

    def leave(self) -> None:
        """The user has closed the dock: end what makes no sense without it."""

    @property
    def pointed_surface(self) -> str:
        """The name of the surface that it is about."""
        return self.context.document.surfaces[0].name

    def show_pointed(self, vertex: int | None) -> None:
        """The pointer is at a vertex of that surface in some panel, or at none."""
