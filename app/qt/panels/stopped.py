"""What a panel says that was stopped: what it shows all the same, and a button that asks again."""

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.sources.words import short_words_of

from ...session.answering import Shown
from ..look.layouts import in_column
from ..look.look import LOOK
from ..look.painting import paint_rounded, smooth_painter, translucent

MARGIN, ABOVE = 24, 12
"""Between it and the sides of the view, and its lower edge."""


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
        """Whether it is there, with these words: then somebody may be about to press the button."""
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
    """What a panel that was stopped shows: the answer to what it was asked before, a quick look, or nothing."""
    if shown is None or shown.answer.field is None:
        return "Stopped. Nothing is shown."
    at = getattr(shown.asked, "at", None)
    where = "" if at is None else f", from {'vertex ' if isinstance(at, int) else ''}{short_words_of(at)}"
    return f"Stopped. Shown: {shown.answer.label}{where}."
