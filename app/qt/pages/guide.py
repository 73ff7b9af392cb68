"""The menu Help: gestures and keys, the tour, about.  `window` is the main window."""

from typing import Any

from ...samples import mesh_path
from ...version import version
from .messages import tell

ABOUT = (
    "The distance of Lipman, Rustamov and Funkhouser, Biharmonic Distance, ACM Transactions on Graphics 29(3), 2010: "
    "exact, beside geodesic and diffusion distances."
)


class Guide:
    """See the module."""

    def __init__(self, window) -> None:
        self._window = window
        self._tour: Any = None

    def show_keys(self) -> None:
        from .keys import GESTURES, KeysDialog, entries_of

        KeysDialog([GESTURES, *entries_of(self._window.menuBar())], self._window).show()

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

    def end_tour(self) -> bool:
        """Whether there was one."""
        if self._tour is None or not self._tour.is_on:
            return False
        self._tour.end()
        return True

    def show_about(self) -> None:
        tell(self._window, f"Biharmonic distance {version()}", ABOUT)
