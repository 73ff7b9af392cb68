"""A button without an outline: an icon, or words with the arrow of a menu, cut short where there is no room."""

from qtpy import QtCore, QtGui, QtWidgets

from ..look.bare_button import BareButton
from ..look.icons import pixmap
from ..look.look import LOOK
from ..look.numbers import number_width, paint_number
from ..look.painting import baseline, paint_rounded, smooth_painter

HEIGHT = 26
PAD = 6
"""Between the words and the edge."""

GAP = 6
"""Between a symbol and its value."""

ARROW = 14
"""The room of the arrow, whose drawing has air of its own."""

ICON_SIDE = 28


class FlatButton(BareButton):
    """Paints itself; with a menu or a pop-up it opens on Space, Enter and Down.

    text: what it says; symbol: quiet, before the text where there is room; icon_name: instead of words.
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
    """The outline of what has the focus by keyboard."""
    paint_rounded(painter, around.adjusted(1, 1, -1, -1), 6, line=LOOK.theme.accent, width=2)
