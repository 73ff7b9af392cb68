"""The look of all windows of the process: theme and font size, and how widgets paint themselves with them."""

from collections.abc import Callable

from qtpy import QtCore, QtGui, QtWidgets

from ...drawing.painters.qt import number_width, paint_number
from .desktop import DESKTOP
from .style_sheet import style_sheet
from .theme import LIGHT, THEMES, Theme, palette

TALK = 1.35
"""Factor of the font size in full screen, for talks."""


USUAL_DOTS = 96.0
LEAST_LARGER = 1.1
"""Factor of a screen's density from which on it counts."""


class Look(QtCore.QObject):
    """The theme and the font size; `changed` is emitted when either changes, and painted widgets then ask again."""

    changed = QtCore.Signal()

    def __init__(self) -> None:
        super().__init__()
        self.choice = "desktop"
        self.theme = LIGHT
        self.scale = self._usual = 1.0
        DESKTOP.changed.connect(self._follow_desktop)

    def choose(self, word: str) -> None:
        """Choose "light", "dark", or "desktop" to follow the system."""
        self.choice = word
        self._become(THEMES.get(word) or DESKTOP.theme(), self.scale)

    def enlarge(self, scale: float) -> None:
        """Set the font size as a multiple of the usual one."""
        self._become(self.theme, self._usual * scale)

    def fit_to(self, dots_per_inch: float) -> None:
        """Use the font size that is usual on a screen."""
        share = dots_per_inch / USUAL_DOTS
        self._usual = share if share >= LEAST_LARGER else 1.0
        self._become(self.theme, self._usual)

    def apply_theme(self, window: QtWidgets.QWidget) -> None:
        """Apply the theme to a window, now and whenever it changes."""
        _put_on(window, self)
        self.follow(window, lambda: _put_on(window, self))

    def follow(self, owner: QtCore.QObject, function: Callable[[], None]) -> None:
        """Call a function whenever the look has changed, as long as its owner lives."""
        self.changed.connect(_Follower(owner, function).follow)

    def font(self, size: float = 13, bold: bool = False) -> QtGui.QFont:
        """Return the system's font, with its size in logical pixels."""
        font = QtGui.QFont(QtWidgets.QApplication.font())
        font.setPixelSize(max(1, round(size * self.scale)))
        font.setWeight(QtGui.QFont.Weight.DemiBold if bold else QtGui.QFont.Weight.Normal)
        return font

    def _follow_desktop(self) -> None:
        if self.choice not in THEMES:
            self.choose(self.choice)

    def _become(self, theme: Theme, scale: float) -> None:
        if (theme, scale) != (self.theme, self.scale):
            self.theme, self.scale = theme, scale
            self.changed.emit()


class _Follower(QtCore.QObject):
    """Calls a function as long as its owner, the parent, lives."""

    def __init__(self, owner: QtCore.QObject, function: Callable[[], None]) -> None:
        super().__init__(owner)
        self._function = function

    def follow(self) -> None:
        self._function()


def _put_on(window: QtWidgets.QWidget, look: Look) -> None:
    window.setPalette(palette(look.theme))
    window.setStyleSheet(style_sheet(look.theme, look.scale))


LOOK = Look()
"""The process's; a window is told its style sheet, but what paints itself has to ask."""


def smooth_painter(widget: QtWidgets.QWidget, ground: str = "") -> QtGui.QPainter:
    """Return a painter on a widget, with smooth edges.

    Parameters
    ----------
    widget
        What is painted.
    ground
        The colour to fill it with first, "" for none.  That has no smooth edges: at a fractional scale what was there
        before would be seen through them.
    """
    painter = QtGui.QPainter(widget)
    if ground:
        painter.fillRect(widget.rect(), QtGui.QColor(ground))
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    return painter


def paint_rounded(
    painter: QtGui.QPainter,
    box: QtCore.QRectF,
    radius: float,
    ground: QtGui.QColor | str = "",
    line: str = "",
    width: float = 1.0,
) -> None:
    """Paint a box with round corners, its ground and its outline, "" for none; the painter's pen and brush stay so."""
    painter.setPen(QtGui.QPen(QtGui.QColor(line), width) if line else QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(QtGui.QColor(ground) if ground else QtCore.Qt.BrushStyle.NoBrush)
    painter.drawRoundedRect(box, radius, radius)


def paint_elided(painter: QtGui.QPainter, x: float, y: float, text: str, room: float) -> float:
    """Write a text at a baseline, cut short where it is wider than its room, and return where it ends."""
    if number_width(painter.font(), text) > room:
        cut = QtCore.Qt.TextElideMode.ElideRight
        text = QtGui.QFontMetricsF(painter.font()).elidedText(text, cut, max(room, 0.0))
    return paint_number(painter, x, y, text)


def translucent(colour: str, opacity: float) -> QtGui.QColor:
    """Return a colour with an opacity, 0 to 1."""
    found = QtGui.QColor(colour)
    found.setAlphaF(opacity)
    return found


def baseline(painter: QtGui.QPainter, middle: float) -> float:
    """Return the baseline of words in the painter's font whose middle is at a height."""
    metrics = QtGui.QFontMetricsF(painter.font())
    return float(middle + (metrics.ascent() - metrics.descent()) / 2)
