"""What a panel says while its field is computed: how far that is, in words, and a way to stop it."""

from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK
from ..look.numbers import number_width, paint_number
from ..look.painting import translucent
from .flat_button import ICON_SIDE, FlatButton

HEIGHT, COMPACT_HEIGHT = 28, 18
LINE = 2


class Waiting(QtWidgets.QWidget):
    """A line with words under it, at the top of the view or under it; `cancelled` by its cross."""

    cancelled = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._fraction, self._words, self._has_words = 0.0, "", True
        self.stop = FlatButton(self, "close")
        self.stop.setToolTip("Stop computing this panel (Esc stops all)")
        self.stop.setAccessibleName("Stop computing this panel")
        self.stop.clicked.connect(self.cancelled)
        self.hide()

    def show_progress(self, fraction: float, words: str) -> None:
        """Words such as "eigenpairs", and the share done; NaN where that is not known."""
        self._fraction, self._words = fraction, words
        self.setAccessibleDescription(self.text)
        self.setToolTip("" if self._has_words else self.text)
        self.show()
        self.raise_()
        self.update()

    @property
    def text(self) -> str:
        """What is waited for, with how much of it is done where that is known."""
        known = 0.0 <= self._fraction <= 1.0
        return f"{self._words}, {self._fraction:.0%}".replace("%", " %") if known else f"{self._words}…"

    def fit(self, top: int, width: int, is_compact: bool, has_words: bool) -> None:
        """Lie at this height of the panel, with this width; has_words: or only the line and the cross."""
        self._has_words = has_words
        high = round((COMPACT_HEIGHT if is_compact else HEIGHT) * LOOK.scale)
        self.setGeometry(0, top, width, LINE + high)
        self.stop.setGeometry(width - ICON_SIDE - 4, LINE, ICON_SIDE, high)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        painter.fillRect(0, 0, self.width(), LINE, QtGui.QColor(theme.border))
        if 0.0 <= self._fraction <= 1.0:
            painter.fillRect(QtCore.QRectF(0, 0, self._fraction * self.width(), LINE), QtGui.QColor(theme.accent))
        if not self._has_words:
            return
        painter.setFont(LOOK.font(12))
        painter.setPen(QtGui.QColor(theme.quiet))
        metrics = painter.fontMetrics()
        text, room = self.text, self.stop.x() - 16
        if number_width(painter.font(), text) > room:
            text = metrics.elidedText(text, QtCore.Qt.TextElideMode.ElideMiddle, max(room, 0))
        # Behind the words only: what is below is the picture.
        width = number_width(painter.font(), text)
        ground = translucent(theme.canvas, 0.85)
        painter.fillRect(QtCore.QRectF(0, LINE, 14 + width + 8, self.height() - LINE), ground)
        baseline = LINE + (self.height() - LINE + metrics.ascent() - metrics.descent()) / 2
        paint_number(painter, 14, baseline, text)
