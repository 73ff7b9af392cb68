"""The menus of colours, styles and maps with a strip of their colours each, and of isolines."""

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from ...document.looks import CURVATURE, Colours, Isolines, Stops
from ...document.settings import switches_in
from ...drawing.numbers import tick
from ...scene.colour_maps import MAPS, backwards, colours_at
from ...scene.style import map_of, style_of
from ..choices import Choices, IsolineChoices
from ..context import Context
from ..look.canvas import map_word, offered_styles, style_entry, style_name
from ..look.look import LOOK

WIDTH, HEIGHT, MARGIN = 64, 12, 12
"""Size of a strip, and the margin right of it, in logical pixels."""

LONGEST = 14
"""Letters of a file's name on the button."""

FAINT = 0.35
"""Opacity of a strip that cannot be chosen."""


class BaseMenu(QtWidgets.QMenu):
    """The menu of what is drawn in grey under isolines: curvature, or a field of the user's own."""

    def __init__(self, context: Context) -> None:
        super().__init__("Base in grey", context.widget)
        self.menuAction().setToolTip("Grey surface with isolines in the colours of the field")
        self._context = context
        self._group = QtWidgets.QActionGroup(self)
        self.aboutToShow.connect(self._fill)

    def _fill(self) -> None:
        document = self._context.document
        self.clear()
        names = {field.name: field.name.replace("&", "&&") for field in document.fields}
        for name, text in ({"": "None", CURVATURE: "Mean curvature"} | names).items():
            action = self.addAction(text)
            action.setCheckable(True)
            action.setChecked(name == document.base.scalars)
            action.setData(name)
            action.setProperty("synonyms", "sulci sulcal depth thickness brain cortex anatomy background underlay")
            self._group.addAction(action)
            action.triggered.connect(lambda *_, name=name: self._context[Choices].base(name))
        self.addSeparator()
        for word in switches_in("base"):
            self._context.actions[word].setEnabled(bool(document.base.scalars))
            self.addAction(self._context.actions[word])


class ColourMenu(QtWidgets.QMenu):
    """Entries have words as data: a style's, or ("map", a map's), with None for a file's."""

    def __init__(self, context: Context) -> None:
        super().__init__("Co&lours", context.widget)
        self.setToolTipsVisible(True)
        # Room for the strips, which are painted where no icon could stand beside a tick.
        self.setStyleSheet(f"QMenu::item {{ padding-right: {WIDTH + 2 * MARGIN + 8}px; }}")
        self._strips: dict[QtWidgets.QAction, Stops] = {}
        self._head("Style")
        self._styles = QtWidgets.QActionGroup(self)
        for word in offered_styles(""):
            action = self._entry(self._styles, style_entry(word), word)
            if word != "lines":
                action.setToolTip("Background of figures and movies; that of the window is its theme's (Preferences)")
            action.triggered.connect(lambda *_, word=word: context[Choices].style(word))
        self.addSeparator()
        self._head("Colour map")
        self._maps = QtWidgets.QActionGroup(self)
        for word, each in MAPS.items():
            action = self._entry(self._maps, each.name, ("map", word))
            action.setToolTip(each.hint)
            action.triggered.connect(lambda *_, word=word: context[Choices].colour_map(word))
        self._own = self._entry(self._maps, "", ("map", None))
        self._file = self.addAction("From file…", context[Choices].ask_colours)
        self._file.setToolTip("Rows of red, green and blue, or ParaView's .json")
        self.addSeparator()
        self.addActions([context.actions[word] for word in switches_in("colours")])
        self.addSeparator()
        self.addMenu(BaseMenu(context))

    def show_choice(self, style: str, colours: Colours) -> None:
        """Tick what is chosen, in its colours."""
        chosen = (style_entry(style), ("map", map_word(style, colours)))
        for action in self._styles.actions():
            action.setChecked(action.text() == chosen[0])
        for action in self._maps.actions():
            action.setChecked(action.data() == chosen[1])
        self._own.setVisible(bool(colours.stops))
        self._own.setText(colours.map.replace("&", "&&") or "Your own")
        for action in self._styles.actions():
            each = style_of(action.data(), colours)
            self._strips[action] = each.stops if each.coloured else ()
        has_colours = style_of(style).coloured
        ground = style if has_colours else "paper"
        for action in self._maps.actions():
            of = action.data()[1]
            stops = map_of(colours) if of is None else style_of(ground, Colours(of)).stops
            self._strips[action] = backwards(stops) if colours.reversed and stops else stops
        for action in (*self._maps.actions(), self._file):
            action.setEnabled(has_colours)

    def _head(self, text: str) -> None:
        head = self.addAction(text)
        head.setEnabled(False)
        head.setProperty("heading", True)

    def _entry(self, group: QtWidgets.QActionGroup, text: str, data: object) -> QtWidgets.QAction:
        action = self.addAction(text)
        action.setData(data)
        action.setCheckable(True)
        group.addAction(action)
        return action

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        for action, stops in self._strips.items():
            if action.isVisible():
                place = self.actionGeometry(action)
                left, top = place.right() - MARGIN - WIDTH, place.center().y() - HEIGHT // 2
                painter.setOpacity(1.0 if action.isEnabled() else FAINT)
                _paint_strip(painter, QtCore.QRectF(left + 0.5, top + 0.5, WIDTH - 1, HEIGHT - 1), stops)


def _paint_strip(painter: QtGui.QPainter, box: QtCore.QRectF, stops: Stops) -> None:
    """A map from left to right; lines on white where there are no colours."""
    gradient = QtGui.QLinearGradient(box.topLeft(), box.topRight())
    places = np.linspace(0, 1, 33)
    for place, rgb in zip(places, colours_at(stops, places) if stops else np.ones((33, 3)), strict=True):
        gradient.setColorAt(float(place), QtGui.QColor.fromRgbF(*np.clip(rgb, 0, 1)))
    painter.setBrush(gradient)
    painter.setPen(QtGui.QPen(QtGui.QColor(LOOK.theme.strong), 1) if not stops else QtCore.Qt.PenStyle.NoPen)
    painter.drawRoundedRect(box, 2, 2)
    if not stops:
        painter.setPen(QtGui.QPen(QtCore.Qt.GlobalColor.black, 1))
        for k in range(1, 6):
            x = round(box.left() + k * box.width() / 6) + 0.5
            painter.drawLine(QtCore.QPointF(x, box.top() + 1), QtCore.QPointF(x, box.bottom() - 1))


def colours_in_words(style: str, colours: Colours) -> str:
    """Return the text of the button: "Paper", "Ember, bands", "Lines only"."""
    if not style_of(style).coloured:
        return style_name(style)
    word = map_word(style, colours)
    name = colours.map if word is None else MAPS[word].name
    name = name if len(name) <= LONGEST else f"{name[: LONGEST - 1]}…"
    return ", ".join([name, *["reversed"] * colours.reversed, *["bands"] * colours.bands])


ISOLINES = (0, 10, 20, 30, 50)


class IsolineMenu(QtWidgets.QMenu):
    """Entries for numbers of lines have them, as words, as data."""

    def __init__(self, context: Context) -> None:
        super().__init__("&Isolines", context.widget)
        choices = context[IsolineChoices]
        self.setToolTipsVisible(True)
        self._where = QtWidgets.QActionGroup(self)
        for count in ISOLINES:
            action = self._entry(f"About {count}" if count else "None", str(count))
            action.triggered.connect(lambda *_, count=count: choices.steps(count))
        self.addSeparator()
        self._other = self._entry("Another number…", "other")
        self._other.triggered.connect(choices.ask_steps)
        self._spacing = self._entry("Spacing…", "spacing")
        self._spacing.setToolTip("Put isolines at multiples of a number, in all panels of a unit")
        self._spacing.triggered.connect(choices.ask_spacing)
        self._values = self._entry("Values…", "values")
        self._values.setToolTip("Put isolines at given values")
        self._values.triggered.connect(choices.ask_values)
        self.addSeparator()
        self.addActions([context.actions[word] for word in switches_in("isolines")])
        self.addSeparator()
        self.through = self.addAction("Remove isolines through points", choices.pass_through_none)
        self.through.setToolTip("Add one through a point by a right click on the surface")

    def show_choice(self, isolines: Isolines) -> None:
        """Tick what is chosen."""
        word = str(isolines.count)
        if isolines.spacing is not None:
            word = "spacing"
        elif isolines.values:
            word = "values"
        elif isolines.count not in ISOLINES:
            word = "other"
        for action in self._where.actions():
            action.setChecked(action.data() == word)
        self._other.setText(f"Another number ({isolines.count})…" if word == "other" else "Another number…")
        self._spacing.setText(f"Spacing ({tick(isolines.spacing)})…" if isolines.spacing is not None else "Spacing…")
        self._values.setText(f"Values ({len(isolines.values)})…" if word == "values" else "Values…")
        self.through.setEnabled(bool(isolines.through))

    def _entry(self, text: str, word: str) -> QtWidgets.QAction:
        action = self.addAction(text)
        action.setData(word)
        action.setCheckable(True)
        self._where.addAction(action)
        return action


def isolines_in_words(isolines: Isolines) -> str:
    """Return the text of the button: "20", "20 equal", "None", "0.05 apart", "3 values"."""
    if isolines.spacing is not None:
        return f"{tick(isolines.spacing)} apart"
    if isolines.values:
        return "1 value" if len(isolines.values) == 1 else f"{len(isolines.values)} values"
    return f"{isolines.count}{'' if isolines.round else ' equal'}" if isolines.count else "None"
