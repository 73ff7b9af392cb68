"""A button of the tool bar: an icon, quiet words, the value that is chosen; words go first where room is short."""

from qtpy import QtCore, QtGui

from ..look.controls import BareButton
from ..look.icons import SIDE, pixmap
from ..look.look import LOOK

HEIGHT, PADDING, GAP = 32, 8, 6
CHEVRON = 12

FULL, VALUES, ICONS = 2, 1, 0
"""How much is written: words and values, values, nothing."""


class ToolButton(BareButton):
    """A button of the toolbar, which shows less as room gets scarce.

    Parameters
    ----------
    icon
        A name of `assets/icons`.
    words
        The button's name.
    is_meant
        Whether it is the one button that is filled.
    """

    def __init__(self, icon: str, words: str = "", is_meant: bool = False) -> None:
        super().__init__()
        self._icon, self._words, self._value = icon, words, ""
        self._is_meant, self._detail = is_meant, FULL
        self._widths: dict[int, int] = {}  # by detail; a tool bar that is laid out asks thousands of times
        self.setCursor(QtCore.Qt.CursorShape.ArrowCursor)
        LOOK.changed.connect(self._refit)

    def show_value(self, value: str) -> None:
        """Show the present choice beside the button's name."""
        if value != self._value:
            self._value = value
            self.setAccessibleDescription(value)
            self._refit()

    def show_icon(self, icon: str) -> None:
        """Show another icon."""
        self._icon = icon
        self.update()

    def show_detail(self, detail: int) -> None:
        """Show as much as FULL, VALUES or ICONS says."""
        if detail != self._detail:
            self._detail = detail
            self._refit()

    def width_with(self, detail: int) -> int:
        """Return the width of the button at a level of detail."""
        if detail not in self._widths:
            metrics = QtGui.QFontMetrics(self._font)
            words = sum(GAP + metrics.horizontalAdvance(text) for text, _ in self._texts(detail))
            self._widths[detail] = 2 * PADDING + SIDE + words
        return self._widths[detail] + (GAP - 2 + CHEVRON if self._has_arrow else 0)

    @property
    def _has_arrow(self) -> bool:
        """Whether it is to be seen that there is a menu; three dots say so themselves."""
        return self.menu() is not None and self._icon != "more"

    @property
    def _font(self) -> QtGui.QFont:
        return LOOK.font(13, bold=self._is_meant)

    def _texts(self, detail: int) -> list[tuple[str, bool]]:
        """Return the texts that are written, and whether each is quiet."""
        words, value = (self._words, bool(self._value)), (self._value, False)
        shown = {FULL: [words, value], VALUES: [value], ICONS: []}[detail]
        return [(text, quiet) for text, quiet in shown if text]

    def _refit(self) -> None:
        self._widths = {}
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(self.width_with(self._detail), round(HEIGHT * max(1, LOOK.scale)))

    def minimumSizeHint(self) -> QtCore.QSize:
        return self.sizeHint()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        is_on = self.isEnabled()
        is_filled = self._is_meant and is_on
        is_pressed = is_on and (self.isDown() or (self.menu() is not None and self.menu().isVisible()))
        ground = theme.fill if is_filled else ""
        if self.isChecked():
            ground = theme.selection
        if is_on and self.is_pointed and not is_filled:
            ground = theme.hover
        if is_pressed and not is_filled:
            ground = theme.pressed
        box = QtCore.QRectF(self.rect()).adjusted(1, 1, -1, -1)
        if ground:
            painter.setPen(QtCore.Qt.PenStyle.NoPen)
            painter.setBrush(QtGui.QColor(ground))
            painter.drawRoundedRect(box, 6, 6)
        if self.has_keys:
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.text if is_filled else theme.accent), 2))
            painter.drawRoundedRect(box, 6, 6)
        colour = theme.on_fill if is_filled else theme.text if is_on else theme.disabled
        if self.isChecked() and is_on:
            colour = theme.accent
        ratio = self.devicePixelRatioF()
        x, middle = PADDING, self.height() / 2
        painter.drawPixmap(QtCore.QPointF(x, middle - SIDE / 2), pixmap(self._icon, colour, ratio))
        x += SIDE
        painter.setFont(self._font)
        metrics = painter.fontMetrics()
        baseline = middle + (metrics.ascent() - metrics.descent()) / 2
        for text, is_quiet in self._texts(self._detail):
            x += GAP
            painter.setPen(QtGui.QColor(theme.quiet if is_quiet and is_on else colour))
            painter.drawText(QtCore.QPointF(x, baseline), text)
            x += metrics.horizontalAdvance(text)
        if self._has_arrow:
            side = CHEVRON
            chevron = pixmap("chevron", theme.quiet if is_on else theme.disabled, ratio, side)
            painter.drawPixmap(QtCore.QPointF(x + GAP - 2, middle - side / 2), chevron)
