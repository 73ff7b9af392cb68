"""What the mouse and some keys do on the panels: the base class of what a tool makes of them."""

from typing import TYPE_CHECKING, ClassVar

from qtpy import QtCore, QtWidgets

from .context import Context

if TYPE_CHECKING:
    from ..scene.picking import Hit
    from .panels.events import Click

FIRST, LAST = -1, 1
"""Of the gestures of tools, when they are asked whether something is meant for them."""


class Gesture(QtCore.QObject):
    """One for each window, from its beginning on; a tool's row names it (`gesture`).

    tool: the word of the one whose pin markers can be dragged, "" for none.  turn: FIRST if what it takes is meant for
    no other tool, whatever the panel shows, LAST if it takes what no other does.  follows: what it moves may be led by
    the pointer, without a button.
    """

    tool: ClassVar[str] = ""
    turn: ClassVar[int] = 0
    follows: ClassVar[bool] = False

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.context = context

    def is_on(self, panel: int) -> bool:
        """Whether what is done in a panel, by its id, is meant for the tool."""
        return False

    def begin(self) -> None:
        """Another surface is there."""

    # ------------------------------------------------------------------ the mouse
    def takes(self, panel: int, click: "Click") -> bool:
        """Whether a click is meant for the tool."""
        return click.is_plain and self.is_on(panel)

    def click(self, panel: int, click: "Click") -> None:
        """On a surface."""

    def click_mark(self, panel: int, number: int, has_ctrl: bool) -> None:
        """On one of the tool's pin markers."""

    def drag(self, panel: int, number: int, hit: "Hit") -> None:
        """One of the tool's pin markers, or of the marks of what the panel starts from, is over a place."""

    def release(self) -> None:
        """What was dragged, or led by the pointer, has arrived."""

    def follow(self, panel: int, hit: "Hit") -> None:
        """The pointer leads what the tool moves."""

    def offer(self, menu: QtWidgets.QMenu, panel: int, hit: "Hit") -> None:
        """In the menu of a place, where the tool is on."""

    def offer_always(self, menu: QtWidgets.QMenu, panel: int, hit: "Hit | None", where: QtCore.QPoint) -> None:
        """The same whatever tool is on, also beside the surface; where: on the screen."""

    # ------------------------------------------------------------------ the keys
    def put_down(self) -> bool:
        """Esc: let the pointer mean what it usually does; whether it has meant something else."""
        return False

    def remove_chosen(self) -> bool:
        """Del: without what stands out; whether there was something."""
        return False

    def accept(self) -> None:
        """Enter: what is proposed is meant."""
