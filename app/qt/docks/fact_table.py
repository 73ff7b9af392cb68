"""Facts, one below the other: what, in quiet words, and how much, at the right."""

from collections.abc import Sequence

from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK
from ..look.numbers import number_width, paint_number

LINE = 22.0
"""Height of a line, in logical pixels."""

GAP = 14.0


class FactTable(QtWidgets.QWidget):
    """Where there is no room for the words only the first numbers are left; then words are cut."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.facts: Sequence[tuple[str, ...]] = ()
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        LOOK.follow(self, self._fit)

    def show_facts(self, facts: Sequence[tuple[str, ...]]) -> None:
        """Each a word with a number, or more numbers that stand in columns."""
        if list(facts) != list(self.facts):
            self.facts = facts
            self.setAccessibleDescription("; ".join(" ".join(fact) for fact in facts))
            self._fit()

    def _fit(self) -> None:
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(160, round(len(self.facts) * LINE * LOOK.scale))

    def minimumSizeHint(self) -> QtCore.QSize:
        return self.sizeHint()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        painter.setFont(LOOK.font(13))
        metrics = QtGui.QFontMetricsF(painter.font())
        count = max((len(fact) - 1 for fact in self.facts), default=0)
        widths = [
            max((number_width(painter.font(), fact[1 + k]) for fact in self.facts if len(fact) > 1 + k), default=0.0)
            for k in range(count)
        ]
        longest = max((number_width(painter.font(), fact[0]) for fact in self.facts), default=0.0)
        while len(widths) > 1 and longest + sum(width + GAP for width in widths) > self.width():
            widths.pop()  # words before second numbers
        step = LINE * LOOK.scale
        for line, (words, *numbers) in enumerate(self.facts):
            baseline = line * step + (step + metrics.ascent() - metrics.descent()) / 2
            right = float(self.width())
            painter.setPen(QtGui.QColor(theme.text))
            shown = numbers[: len(widths)]
            for text, width in reversed(list(zip(shown, widths[len(widths) - len(shown) :], strict=True))):
                paint_number(painter, right - number_width(painter.font(), text), baseline, text)
                right -= width + GAP
            painter.setPen(QtGui.QColor(theme.quiet))
            room = max(right, 0)
            cut = metrics.elidedText(words, QtCore.Qt.TextElideMode.ElideRight, room)
            paint_number(painter, 0, baseline, words if number_width(painter.font(), words) <= room else cut)
