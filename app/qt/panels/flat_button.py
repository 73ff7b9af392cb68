"""A button without an outline: an icon, or words with the arrow of a menu, cut short where there is no room."""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from qtpy import QtCore, QtGui, QtWidgets

from ...drawing.painters.qt import number_width, paint_number
from ..look.controls import BareButton
from ..look.icons import pixmap
from ..look.look import LOOK, baseline, paint_rounded, smooth_painter

HEIGHT = 26
PAD = 6
"""Between the words and the edge."""

GAP = 6
"""Between a symbol and its value."""

ARROW = 14
"""The room of the arrow, whose drawing has air of its own."""

ICON_SIDE = 28

Do: TypeAlias = Callable[..., object] | Mapping[str, Callable[..., object] | None] | QtWidgets.QMenu
"""What a button does, or its menu, or what the entries of a new one do, with "" for a separator."""


class FlatButton(BareButton):
    """A button that paints itself; its menu or pop-up opens on Space, Enter and Down, too.

    Attributes
    ----------
    symbol
        Quiet words before the text, where there is room.
    icon_name
        Icon in place of words.
    """

    activated = QtCore.Signal()  # by mouse or keyboard, where there is no menu

    def __init__(
        self,
        parent: QtWidgets.QWidget,
        icon_name: str = "",
        bold: bool = False,
        quiet: bool = False,
        has_arrow: bool = True,
    ) -> None:
        super().__init__(parent)
        self.symbol, self.icon_name = "", icon_name
        self.bold, self.quiet = bold, quiet
        self.has_arrow = has_arrow and not icon_name
        self.clicked.connect(self.activated)
        LOOK.changed.connect(self.update)

    def sizeHint(self) -> QtCore.QSize:
        if self.icon_name:
            return QtCore.QSize(ICON_SIDE, ICON_SIDE)
        symbol = self._width(self.symbol) + GAP if self.symbol else 0
        arrow = ARROW if self.has_arrow else 0
        return QtCore.QSize(round(2 * PAD + symbol + self._width(self.text()) + arrow + 0.5), HEIGHT)

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(0, HEIGHT)

    def _width(self, text: str) -> float:
        return number_width(LOOK.font(bold=self.bold), text)

    # ------------------------------------------------------------------ keys
    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        keys = QtCore.Qt.Key
        opens = event.key() in (keys.Key_Return, keys.Key_Enter, keys.Key_Space, keys.Key_Down)
        if not opens or event.modifiers() & ~QtCore.Qt.KeyboardModifier.KeypadModifier:
            super().keyPressEvent(event)
        elif self.menu() is not None:
            self.showMenu()
        else:
            self.click()

    # ------------------------------------------------------------------ painting
    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, smooth_painter(self)
        is_open = self.isDown() or (self.menu() is not None and self.menu().isVisible())
        if self.isEnabled() and (is_open or self.is_pointed):
            paint_rounded(painter, QtCore.QRectF(self.rect()), 6, theme.pressed if is_open else theme.hover)
        if self.has_keys:
            paint_ring(painter, QtCore.QRectF(self.rect()))
        text, quiet = (theme.text, theme.quiet) if self.isEnabled() else (theme.disabled, theme.disabled)
        if self.icon_name:
            side = 20
            picture = pixmap(self.icon_name, quiet, self.devicePixelRatioF(), side)
            painter.drawPixmap((self.width() - side) // 2, (self.height() - side) // 2, picture)
            return
        self._paint_words(painter, text, quiet)

    def _paint_words(self, painter: QtGui.QPainter, text: str, quiet: str) -> None:
        painter.setFont(LOOK.font(bold=self.bold))
        y = round(baseline(painter, self.height() / 2))
        x: float = PAD
        words, beside = self.text(), PAD + (ARROW if self.has_arrow else 0)
        symbol = self._width(self.symbol) + GAP if self.symbol else 0
        if symbol and self._width(words) <= self.width() - x - symbol - beside + 0.5:
            painter.setPen(QtGui.QColor(quiet))
            x = paint_number(painter, x, y, self.symbol) + GAP
        room = self.width() - x - beside
        if self._width(words) > room + 0.5:
            metrics = QtGui.QFontMetricsF(painter.font())
            words = metrics.elidedText(words, QtCore.Qt.TextElideMode.ElideRight, max(room, 0))
        painter.setPen(QtGui.QColor(quiet if self.quiet else text))
        x = paint_number(painter, x, y, words)
        if self.has_arrow:
            side = 16
            picture = pixmap("chevron", quiet, self.devicePixelRatioF(), side)
            painter.drawPixmap(QtCore.QPointF(round(x + 3), (self.height() - side) // 2 + 1), picture)


def paint_ring(painter: QtGui.QPainter, around: QtCore.QRectF) -> None:
    """Paint the outline of a widget that has the focus by keyboard."""
    paint_rounded(painter, around.adjusted(1, 1, -1, -1), 6, line=LOOK.theme.accent, width=2)


def icon_button(parent: QtWidgets.QWidget, icon: str, tip: str, do: Do, name: str = "") -> FlatButton:
    """Return a button with an icon, whose accessible name is its tip if no other is given."""
    button = FlatButton(parent, icon)
    button.setToolTip(tip)
    button.setAccessibleName(name or tip)
    if not isinstance(do, Mapping | QtWidgets.QMenu):
        button.activated.connect(do)
        return button
    menu = do if isinstance(do, QtWidgets.QMenu) else QtWidgets.QMenu(button)
    for text, entry in do.items() if isinstance(do, Mapping) else ():
        add_entry(menu, text, entry) if entry is not None else menu.addSeparator()
    button.setMenu(menu)
    return button


def menu_button(
    parent: QtWidgets.QWidget,
    fill: Callable[[QtWidgets.QMenu], object],
    tip: str,
    name: str = "",
    icon: str = "",
    quiet: bool = False,
) -> FlatButton:
    """Return a button whose menu a function fills each time that it is opened."""
    button = FlatButton(parent, icon, quiet=quiet)
    button.setToolTip(tip)
    button.setAccessibleName(name or tip)
    menu = QtWidgets.QMenu(button)

    def fill_anew() -> None:
        menu.clear()
        for inner in menu.findChildren(QtWidgets.QMenu, options=QtCore.Qt.FindChildOption.FindDirectChildrenOnly):
            inner.deleteLater()  # which `clear` leaves in memory
        fill(menu)

    menu.aboutToShow.connect(fill_anew)
    button.setMenu(menu)
    return button


def add_entry(
    menu: QtWidgets.QMenu, text: str, do: Callable[[], object], is_on: bool | None = None, can: bool = True
) -> QtWidgets.QAction:
    """Add an entry to a menu, with a tick unless `is_on` is None, and disabled unless it `can` be chosen."""
    action = menu.addAction(text, lambda *_: do())
    action.setCheckable(is_on is not None)
    action.setChecked(bool(is_on))
    action.setEnabled(can)
    return action
