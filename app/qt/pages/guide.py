"""The menu Help: the palette of commands, the tour, about.  `window` is the main window."""

from typing import TYPE_CHECKING, Any

from ...samples import mesh_path
from ...version import version
from .messages import tell

if TYPE_CHECKING:
    from .commands import Command

ABOUT = (
    "The distance of Lipman, Rustamov and Funkhouser, Biharmonic Distance, ACM Transactions on Graphics 29(3), 2010: "
    "exact, beside geodesic and diffusion distances."
)


class Guide:
    """See the module."""

    def __init__(self, window) -> None:
        self._window = window
        self._tour: Any = None
        self._recent: list[str] = []  # commands by their titles, the last first

    def commands(self) -> "list[Command]":
        """Those of the menus, and of what the active panel can show."""
        from .commands import commands_of

        window = self._window
        menus = [("", action.menu()) for action in window.menuBar().actions() if action.menu() is not None]
        has_mesh = window.session.surface is not None
        if has_mesh and window.grid.active >= 0:
            menus.append(("Show here", window.grid.panel(window.grid.active).head.name.menu()))
        return commands_of(menus, has_mesh)

    def show_commands(self) -> None:
        from .commands import GESTURES
        from .palette import Palette

        Palette([*self.commands(), *GESTURES], self._recent, self._window).open()

    def start_tour(self) -> None:
        """Of what is shown, of a sample if nothing is open."""
        from .tour import Tour, steps

        window = self._window
        if self._tour is None:
            self._tour = Tour(window, steps(window))
        if window.session.surface is not None:
            self._tour.start()
            return

        def begin() -> None:
            window.complete.disconnect(begin)
            self._tour.start()

        window.complete.connect(begin)
        window.open(mesh_path("figure"))

    @property
    def tour(self) -> Any:
        """The tour, if it has been started."""
        return self._tour

    @property
    def is_touring(self) -> bool:
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
        tell(self._window, f"Biharmonic distance {version()}", ABOUT)
