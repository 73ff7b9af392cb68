"""The menu Help: the palette of commands, the guide, the tour, about."""

from typing import TYPE_CHECKING, Any

from qtpy import QtCore, QtGui

from bihdist_core.errors import MissingInputError
from bihdist_core.kernel.library import description

from ..guide_pages import guide_page
from ..samples import mesh_path
from ..version import version
from .context import Context
from .pages.messages import tell

if TYPE_CHECKING:
    from .pages.commands import Command
    from .panels.panel import DistancePanel

ABOUT = (
    "The distance of Lipman, Rustamov and Funkhouser, Biharmonic Distance, ACM Transactions on Graphics 29(3), 2010: "
    "exact, beside geodesic and diffusion distances."
)


class Guide:
    """See the module."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._tour: Any = None
        self._recent: list[str] = []  # commands by their titles, the last first

    def commands(self) -> "list[Command]":
        """Those of the menus, and of what the active panel can show."""
        from .pages.commands import commands_of

        context = self._context
        menus = [("", action.menu()) for action in context.widget.menuBar().actions() if action.menu() is not None]
        if context.active is not None:
            menus.append(("Show here", context.active.head.name.menu()))
        return commands_of(menus, context.session.surface is not None)

    def show_commands(self) -> None:
        """Open the list of all commands and gestures."""
        from .pages.commands import GESTURES
        from .pages.palette import Palette

        Palette([*self.commands(), *GESTURES], self._recent, self._context.widget).open()

    def open_guide(self) -> None:
        """Open the guide in the browser; say how to build it where it is not built, and where it is if none opens."""
        try:
            page = guide_page()
        except MissingInputError as error:
            self._context.fail(error)
            return
        if QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(str(page))):
            self._context.tell("The guide is open in the browser")
        else:
            self._context.fail(f"No browser could be started; open {page} in one.")

    def start_tour(self) -> None:
        """Of what is shown, of a sample if nothing is open."""
        from .pages.tour import Tour, steps

        context = self._context
        if self._tour is None:
            self._tour = Tour(context.widget, steps(context.widget, self._panels))
        if context.session.surface is not None:
            self._tour.start()
            return

        def begin() -> None:
            context.complete.disconnect(begin)
            self._tour.start()

        context.complete.connect(begin)
        context.open(mesh_path("figure"))

    def _panels(self) -> "list[DistancePanel]":
        return self._context.grid.panels if self._context.is_built else []

    @property
    def tour(self) -> Any:
        """The tour, if it has been started."""
        return self._tour

    @property
    def is_touring(self) -> bool:
        """Whether the tour is under way."""
        return self._tour is not None and self._tour.is_on

    def end_tour(self) -> bool:
        """Whether there was one."""
        is_on = self.is_touring
        if is_on:
            self._tour.end()
        return is_on

    def go_on(self) -> bool:
        """The next step of the tour; whether there is one."""
        is_on = self.is_touring
        if is_on:
            self._tour.go(self._tour.at + 1)
        return is_on

    def show_about(self) -> None:
        """Tell the program's version, where it comes from, and whether its solver runs compiled."""
        words = f"{ABOUT}\n\nSolver: {description()}."
        tell(self._context.widget, f"Biharmonic distance {version()}", words)
