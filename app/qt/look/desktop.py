"""The theme of the desktop, light or dark."""

import sys
from collections.abc import Callable
from typing import Any

from qtpy import QtCore, QtGui, QtWidgets

from .theme import DARK, LIGHT, Theme, lightness

PERSONALIZE = r"HKEY_CURRENT_USER\Software\Microsoft\Windows\CurrentVersion\Themes\Personalize"


class Desktop(QtCore.QObject):
    """Watches the desktop; `changed` is emitted when its theme may have changed."""

    changed = QtCore.Signal()

    def __init__(self) -> None:
        super().__init__()
        self._portal: Any = None
        self._is_asked = False

    def theme(self) -> Theme:
        """Return the theme of the desktop; the first call starts watching it."""
        if QtWidgets.QApplication.instance() is None:
            return LIGHT
        if not self._is_asked:
            self._is_asked = True
            self._watch()
        sources: tuple[Callable[[], bool | None], ...] = (self._portal_is_dark, registry_is_dark, palette_is_dark)
        answers = (source() for source in sources)
        return DARK if next((is_dark for is_dark in answers if is_dark is not None), False) else LIGHT

    def _watch(self) -> None:
        app = QtWidgets.QApplication.instance()
        app.paletteChanged.connect(lambda *_: self.changed.emit())
        # Windows tells nobody who does not draw with it: it is asked again when the user comes back from its settings.
        app.applicationStateChanged.connect(lambda *_: self.changed.emit())
        self._portal = portal()
        if self._portal is not None:
            self._portal.changed.connect(self.changed)

    def _portal_is_dark(self) -> bool | None:
        return None if self._portal is None else self._portal.is_dark


def portal() -> Any:
    """Return the `DesktopPortal` of a Linux desktop, None where there is none."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        from . import portal as found  # needs Qt's D-Bus, which not every installation has
    except (ImportError, RuntimeError):
        return None
    return found.DesktopPortal() if found.has_bus() else None


def registry_is_dark() -> bool | None:
    """Return whether Windows is set to dark; None on other systems."""
    if sys.platform != "win32":
        return None
    value = QtCore.QSettings(PERSONALIZE, QtCore.QSettings.Format.NativeFormat).value("AppsUseLightTheme")
    return None if value is None else value in (0, "0")


def palette_is_dark() -> bool:
    """Return whether the palette that Qt took from the desktop is dark."""
    ground = QtWidgets.QApplication.palette().color(QtGui.QPalette.ColorRole.Window)
    return lightness(ground.name()) < 0.2


DESKTOP = Desktop()
"""The desktop of this process."""
