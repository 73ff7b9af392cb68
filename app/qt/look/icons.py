"""Icons: drawings of one colour in `assets/icons`, painted in the colours of the theme at any scale."""

from functools import lru_cache

import qtpy
from qtpy import QtCore, QtGui, QtSvg, QtWidgets

from ...samples import SAMPLES
from .look import LOOK
from .style_sheet import ICONS

SIDE = 20
"""Side of an icon in logical pixels."""

SCALES = (1, 2, 3)
"""Device pixels per logical pixel that an icon has pictures for."""


def icon_names() -> list[str]:
    """Return the names of all icons, sorted."""
    return sorted(path.stem for path in ICONS.glob("*.svg"))


def icon(name: str, colour: str = "") -> QtGui.QIcon:
    """Return an icon in the colours of the theme, also disabled and checked, or in one colour."""
    # Otherwise it takes the pictures for scale 1; Qt 6 needs no telling.
    if qtpy.QT5:
        QtCore.QCoreApplication.setAttribute(QtCore.Qt.ApplicationAttribute.AA_UseHighDpiPixmaps)
    theme, mode, state = LOOK.theme, QtGui.QIcon.Mode, QtGui.QIcon.State
    found = QtGui.QIcon()
    for scale in SCALES:
        found.addPixmap(pixmap(name, colour or theme.text, scale), mode.Normal, state.Off)
        found.addPixmap(pixmap(name, colour or theme.accent, scale), mode.Normal, state.On)
        for each in state.Off, state.On:
            found.addPixmap(pixmap(name, theme.disabled, scale), mode.Disabled, each)
    return found


def window_icon() -> QtGui.QIcon:
    """Return the program's own icon, in all sizes."""
    found = QtGui.QIcon()
    for picture in sorted((SAMPLES / "application").glob("*.png")):
        found.addFile(str(picture))
    return found


@lru_cache(maxsize=512)
def pixmap(name: str, colour: str, scale: float = 1, side: int = SIDE) -> QtGui.QPixmap:
    """Return a picture of an icon whose side is in logical pixels."""
    drawing = (ICONS / f"{name}.svg").read_text(encoding="utf-8").replace("currentColor", colour)
    found = QtGui.QPixmap(round(side * scale), round(side * scale))
    found.fill(QtCore.Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(found)
    QtSvg.QSvgRenderer(drawing.encode()).render(painter)
    painter.end()
    found = found.copy()  # without the painter's buffers, which a picture keeps and which are twice its size
    found.setDevicePixelRatio(scale)
    return found


def put_icon(owner: "QtWidgets.QAbstractButton | QtWidgets.QAction", name: str, colour_of: str = "") -> None:
    """Give a button or an action an icon that keeps up with the theme.

    `colour_of` is the name of the theme's colour in which it is painted whatever its state; "" for the usual ones.
    """

    def paint() -> None:
        owner.setIcon(icon(name, getattr(LOOK.theme, colour_of) if colour_of else ""))

    paint()
    LOOK.follow(owner, paint)
