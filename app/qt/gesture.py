"""The base class of a tool's gestures: what the mouse and some keys do on the panels."""

from typing import ClassVar

from qtpy import QtCore, QtWidgets

from ..document.document import Document
from ..scene.picking import Hit
from .context import Context
from .panels.events import Click

FIRST, LAST = -1, 1
"""The turns of gestures that are asked before, and after, those of tools whether an event is meant for them."""


class Gesture(QtCore.QObject):
    """The handling of clicks and drags by a tool, whose row names it (`gesture`); each window has one from its start.

    Attributes
    ----------
    tool
        The name of the tool whose pin markers can be dragged, "" for none.
    turn
        FIRST if it handles what is meant for no other tool, whatever the panel shows; LAST if it handles what no other
        does.
    follows
        Whether what it moves may follow the pointer without a button held.
    """

    tool: ClassVar[str] = ""
    turn: ClassVar[int] = 0
    follows: ClassVar[bool] = False

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.context = context

    @property
    def document(self) -> Document:
        """The document that is shown now."""
        return self.context.document

    def is_on(self, panel: int) -> bool:
        """Return whether what is done in a panel, by its id, is meant for the tool."""
        return False

    def begin(self) -> None:
        """Start on another surface."""

    # ------------------------------------------------------------------ the mouse
    def takes(self, panel: int, click: Click) -> bool:
        """Return whether a click is meant for the tool."""
        return click.is_plain and self.is_on(panel)

    def click(self, panel: int, click: Click) -> None:
        """Handle a click on a surface."""

    def click_mark(self, panel: int, number: int, has_ctrl: bool) -> None:
        """Handle a click on one of the tool's pin markers."""

    def drag(self, panel: int, number: int, hit: Hit) -> None:
        """Handle a drag of one of the tool's pin markers, or of the source's marks, to a place."""

    def release(self) -> None:
        """End a drag, or a source's way after the pointer."""

    def follow(self, panel: int, hit: Hit) -> None:
        """Move what the tool moves to where the pointer is."""

    def offer(self, menu: QtWidgets.QMenu, panel: int, hit: Hit) -> None:
        """Add entries to the menu of a place, where the tool is on."""

    def offer_always(self, menu: QtWidgets.QMenu, panel: int, hit: Hit | None, where: QtCore.QPoint) -> None:
        """Add entries whatever tool is on, also beside the surface; `where` is on the screen."""

    # ------------------------------------------------------------------ the keys
    def cancel(self) -> bool:
        """Handle Esc: cancel what the pointer does besides its usual work; return whether there was anything."""
        return False

    def remove_chosen(self) -> bool:
        """Handle Del: remove what is highlighted; return whether there was anything."""
        return False

    def accept(self) -> None:
        """Handle Enter: accept what is proposed."""
