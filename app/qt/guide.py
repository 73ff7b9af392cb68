"""The Help menu: the palette of commands, the guide and the About message."""

from typing import TYPE_CHECKING

from qtpy import QtCore, QtGui

from bihdist_core.errors import OutputError
from bihdist_core.kernel.library import description

from ..citation import bibtex
from ..guide_pages import guide_page
from ..version import version
from .context import Context
from .pages.messages import tell

if TYPE_CHECKING:
    from .pages.palette import Command

ABOUT = (
    "Exact biharmonic distances, with geodesic and diffusion distances beside them, after Lipman, Rustamov and "
    "Funkhouser, Biharmonic Distance, ACM Transactions on Graphics 29(3), 2010."
)


class Guide:
    """Opens what the Help menu offers."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._recent: list[str] = []  # commands by their titles, the last first

    def commands(self) -> "list[Command]":
        """Return the commands of the menus and those of the active panel."""
        from .pages.palette import commands_of

        context = self._context
        menus = [("", action.menu()) for action in context.widget.menuBar().actions() if action.menu() is not None]
        if context.active is not None:
            menus.append(("Show here", context.active.head.name.menu()))
        return commands_of(menus, context.session.loaded() is not None)

    def show_commands(self) -> None:
        """Open the list of all commands and gestures."""
        from .pages.palette import GESTURES, Palette

        Palette([*self.commands(), *GESTURES], self._recent, self._context.widget).open()

    def open_guide(self) -> None:
        """Open the guide in the browser, or tell where it is if none opens."""
        try:
            page = guide_page()
        except OutputError as error:
            self._context.fail(error)
            return
        if QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(str(page))):
            self._context.tell("The guide is open in the browser")
        else:
            self._context.fail(f"No browser could be started; open {page} in one.")

    def show_about(self) -> None:
        """Show the version, the reference, whether the solver is compiled, and how to cite."""
        words = f"{ABOUT}\n\nSolver: {description()}.\n\nTo cite:\n\n{bibtex()}"
        tell(self._context.widget, f"Biharmonic distance {version()}", words)
