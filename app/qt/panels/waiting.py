"""The progress of a panel's computation with a way to stop it, and what is shown once it has been stopped."""

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.sources.words import short_words_of

from ...drawing.numbers import progress_share
from ...drawing.painters.qt import number_width, paint_number
from ...session.answering import Shown
from ..look.form import in_column
from ..look.look import LOOK, paint_rounded, smooth_painter, translucent
from .flat_button import ICON_SIDE, FlatButton

HEIGHT, COMPACT_HEIGHT = 28, 18
LINE = 2
"""Logical pixels of the words' height, and of the line above them."""

MARGIN, ABOVE = 24, 12
"""Least logical pixels from the note on a stopped computation to the sides of the view, and to its lower edge."""


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
        """Show words such as "eigenpairs", and the fraction done; NaN where that is not known."""
        self._fraction, self._words = fraction, words
        self.setAccessibleDescription(self.text)
        self.setToolTip("" if self._has_words else self.text)
        self.show()
        self.raise_()
        self.update()

    @property
    def text(self) -> str:
        """The work that is waited for, with the percentage done where that is known."""
        share = progress_share(self._fraction)
        return f"{self._words}, {share}" if share else f"{self._words}…"

    def fit(self, top: int, width: int, is_compact: bool, has_words: bool) -> None:
        """Lie at this height of the panel, with words or only the line and the cross."""
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


class Stopped(QtWidgets.QWidget):
    """Low in a view, where it hides little of a shape; `retried` by its button."""

    retried = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.words = QtWidgets.QLabel(self, wordWrap=True)
        self.words.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
        self.button = QtWidgets.QPushButton("Retry", self, autoDefault=False)
        self.button.setToolTip("Compute this panel again from the start")
        self.button.clicked.connect(self.retried)
        button = self.button, 0, QtCore.Qt.AlignmentFlag.AlignCenter
        in_column(self.words, button, of=self, spacing=8, margins=(12, 8, 12, 10))
        self.hide()

    def show_words(self, words: str) -> None:
        """Show why there is no field, and the button that starts it again."""
        self.words.setText(words)
        self.fit()
        self.show()
        self.raise_()

    def is_saying(self, words: str) -> bool:
        """Return whether these words are shown, whose button somebody may be about to press."""
        return not self.isHidden() and self.words.text() == words

    def fit(self) -> None:
        """Lie low in the view, as narrow as the words are."""
        view = self.parentWidget().rect()
        margins, metrics = self.layout().contentsMargins(), QtGui.QFontMetrics(LOOK.font())
        beside = margins.left() + margins.right()
        room = max(view.width() - 2 * MARGIN - beside, 1)
        room_for_all, wrap = QtCore.QRect(0, 0, room, 10_000), int(QtCore.Qt.TextFlag.TextWordWrap)
        words = metrics.boundingRect(room_for_all, wrap, self.words.text())
        width = max(words.width() + 2, self.button.sizeHint().width())
        self.words.setFixedSize(width, words.height())
        size = QtCore.QSize(width + beside, self.layout().totalSizeHint().height())
        top = max(view.height() - size.height() - ABOVE, 0)
        self.setGeometry(QtCore.QRect(QtCore.QPoint((view.width() - size.width()) // 2, top), size))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        paint_rounded(smooth_painter(self), QtCore.QRectF(self.rect()), 6, translucent(LOOK.theme.canvas, 0.88))


def stopped_words(shown: Shown | None) -> str:
    """Return words on a panel that was stopped: it shows the answer to its last question, a preview, or nothing."""
    if shown is None or shown.answer.field is None:
        return "Stopped. Nothing is shown."
    at = getattr(shown.question, "at", None)
    where = "" if at is None else f", from {'vertex ' if isinstance(at, int) else ''}{short_words_of(at)}"
    return f"Stopped. Shown: {shown.answer.label}{where}."
