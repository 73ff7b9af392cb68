"""The menu of colours: styles, which are all of the look, and maps, each with a strip of its colours."""

from functools import lru_cache

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from ...document.looks import Colours, Stops
from ...drawing.colour_maps import MAPS, backwards, colours_at
from ...drawing.style import STYLES, map_of, style_of
from ..look.canvas import STYLE_NAMES

WIDTH, HEIGHT = 56, 14
"""Of a strip, in logical pixels."""


class StripIcons(QtWidgets.QProxyStyle):
    """For menus whose icons are strips of colours."""

    def pixelMetric(self, metric, option=None, widget=None) -> int:
        if metric == QtWidgets.QStyle.PixelMetric.PM_SmallIconSize:
            return WIDTH
        return super().pixelMetric(metric, option, widget)


class ColourMenu(QtWidgets.QMenu):
    """Entries have words as data: a style's, or ("map", a map's).  `window` is the main window."""

    def __init__(self, window) -> None:
        super().__init__("&Colours", window)
        self._window = window
        strips = StripIcons()
        strips.setParent(self)
        self.setStyle(strips)
        self.setToolTipsVisible(True)
        self.addSection("Style")
        self._styles = QtWidgets.QActionGroup(self)
        for word in STYLES:
            action = self._entry(self._styles, STYLE_NAMES.get(word, word), word)
            action.triggered.connect(lambda *_, word=word: window.choices.style(word))
        self.addSection("Colours of the distance")
        self._maps = QtWidgets.QActionGroup(self)
        for word, text in [("", "Those of the style"), *((word, each.name) for word, each in MAPS.items())]:
            action = self._entry(self._maps, text, ("map", word))
            action.setToolTip(MAPS[word].hint if word else "As the style has them")
            action.triggered.connect(lambda *_, word=word: window.choices.colour_map(word))
        self._own = self._entry(self._maps, "", ("map", None))
        self.addAction("From a file …", window.choices.ask_colours)
        self.addSeparator()
        self.reversed = self._tick("Reversed", "From the other end", window.choices.reverse_colours)
        self.bands = self._tick("Bands", "One colour from each isoline to the next", window.choices.band_colours)

    def show_choice(self, style: str, colours: Colours) -> None:
        """Tick what is chosen, in its colours."""
        word = None if colours.stops else colours.map
        for action in self.actions():
            if action.data() is not None:
                action.setChecked(action.data() in (style, ("map", word)))
        self._own.setVisible(bool(colours.stops))
        self._own.setText(colours.map.replace("&", "&&") or "Own colours")
        for action in self._styles.actions():
            action.setIcon(_strip(style_of(action.data()).stops if STYLES[action.data()].coloured else ()))
        for action in self._maps.actions():
            of = action.data()[1]
            stops = colours.stops if of is None else map_of(Colours(of)) or style_of(style).stops
            action.setIcon(_strip(backwards(stops) if colours.reversed else stops))
        has_colours = STYLES[style].coloured if style in STYLES else True
        for action in (*self._maps.actions(), self.reversed, self.bands):
            action.setEnabled(has_colours)
        self.reversed.setChecked(colours.reversed)
        self.bands.setChecked(colours.bands)

    def _entry(self, group: QtWidgets.QActionGroup, text: str, data: object) -> QtWidgets.QAction:
        action = self.addAction(text)
        action.setData(data)
        action.setCheckable(True)
        action.setIconVisibleInMenu(True)
        group.addAction(action)
        return action

    def _tick(self, text: str, tip: str, choose) -> QtWidgets.QAction:
        action = self.addAction(text)
        action.setCheckable(True)
        action.setToolTip(tip)
        action.triggered.connect(lambda is_on: choose(is_on))
        return action


def colours_in_words(style: str, colours: Colours) -> str:
    """For the button: "Paper", "Ember, bands"."""
    name = STYLE_NAMES.get(style, style)
    if colours.map or colours.stops:
        name = colours.map if colours.stops else MAPS[colours.map].name
        name = name if len(name) <= 14 else f"{name[:13]}…"
    if style in STYLES and not STYLES[style].coloured:
        return STYLE_NAMES.get(style, style)
    return ", ".join([name, *["reversed"] * colours.reversed, *["bands"] * colours.bands])


@lru_cache(maxsize=64)
def _strip(stops: Stops) -> QtGui.QIcon:
    """A map from left to right; white with lines where there are no colours."""
    QtCore.QCoreApplication.setAttribute(QtCore.Qt.ApplicationAttribute.AA_UseHighDpiPixmaps)
    found = QtGui.QIcon()
    for scale in (1, 2):
        picture = QtGui.QPixmap(WIDTH * scale, WIDTH * scale)
        picture.fill(QtCore.Qt.GlobalColor.transparent)
        picture.setDevicePixelRatio(scale)
        painter = QtGui.QPainter(picture)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        box = QtCore.QRectF(0.5, (WIDTH - HEIGHT) / 2 + 0.5, WIDTH - 1, HEIGHT - 1)
        gradient = QtGui.QLinearGradient(box.topLeft(), box.topRight())
        places = np.linspace(0, 1, 33)
        for place, rgb in zip(places, colours_at(stops, places) if stops else np.ones((33, 3)), strict=True):
            gradient.setColorAt(float(place), QtGui.QColor.fromRgbF(*np.clip(rgb, 0, 1)))
        painter.setBrush(gradient)
        painter.setPen(QtGui.QPen(QtGui.QColor(128, 128, 128, 160), 1))
        painter.drawRoundedRect(box, 2, 2)
        if not stops:
            painter.setPen(QtGui.QPen(QtCore.Qt.GlobalColor.black, 1))
            for k in range(1, 6):
                x = box.left() + k * box.width() / 6
                painter.drawLine(QtCore.QPointF(x, box.top()), QtCore.QPointF(x, box.bottom()))
        painter.end()
        found.addPixmap(picture)
    return found
