"""The look that all windows of the process have at present, as the user has chosen it."""

from qtpy import QtCore, QtGui, QtWidgets

from .style_sheet import style_sheet
from .theme import DARK, LIGHT, THEMES, Theme, lightness, palette

TALK = 1.35
"""By how much letters are larger on the full screen of a talk."""


class Look(QtCore.QObject):
    """`changed` is emitted when the colours or the size of the letters have changed; what is painted then asks anew."""

    changed = QtCore.Signal()

    def __init__(self) -> None:
        super().__init__()
        self.choice = "desktop"
        self.theme = LIGHT
        self.scale = 1.0

    def choose(self, word: str) -> None:
        """ "light", "dark", or "desktop" for what the desktop has."""
        self.choice = word
        self._become(THEMES.get(word) or desktop_theme(), self.scale)

    def enlarge(self, scale: float) -> None:
        """Letters as a multiple of the usual size."""
        self._become(self.theme, scale)

    def dress(self, window: QtWidgets.QWidget) -> None:
        """Put a window, with all in it, into the present colours, and in those that come."""
        wearing = lambda: _put_on(window, self)  # noqa: E731  (a connection that ends with the window)
        wearing()
        self.changed.connect(wearing)
        window.destroyed.connect(lambda: self.changed.disconnect(wearing))

    def font(self, size: float = 13, bold: bool = False) -> QtGui.QFont:
        """The system's font in logical pixels."""
        font = QtGui.QFont(QtWidgets.QApplication.font())
        font.setPixelSize(max(1, round(size * self.scale)))
        font.setWeight(QtGui.QFont.Weight.DemiBold if bold else QtGui.QFont.Weight.Normal)
        return font

    def _become(self, theme: Theme, scale: float) -> None:
        if (theme, scale) != (self.theme, self.scale):
            self.theme, self.scale = theme, scale
            self.changed.emit()


def _put_on(window: QtWidgets.QWidget, look: Look) -> None:
    window.setPalette(palette(look.theme))
    window.setFont(look.font())
    window.setStyleSheet(style_sheet(look.theme, look.scale))


_desktop: list[Theme] = []


def desktop_theme() -> Theme:
    """What the desktop has, by the palette that Qt took from it."""
    if not _desktop:
        ground = QtWidgets.QApplication.palette().color(QtGui.QPalette.ColorRole.Window)
        _desktop.append(DARK if lightness(ground.name()) < 0.2 else LIGHT)
    return _desktop[0]


LOOK = Look()
"""The process's; a window is told its style sheet, but what paints itself has to ask."""
