"""Facts, one below the other: what, in quiet words, and how much, at the right."""

from collections.abc import Mapping, Sequence

from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK
from ..look.numbers import number_width, paint_number
from .chart import paint_dot

LINE = 22.0
"""Height of a line, in logical pixels."""

GAP = 14.0

DOTTED = 14.0
"""Logical pixels from a dot to the words after it."""


class FactTable(QtWidgets.QWidget):
    """Where there is no room for the words only the first numbers are left; then words are cut."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.facts: Sequence[tuple[str, ...]] = ()
        self._dots: Mapping[int, str] = {}
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        LOOK.follow(self, self._fit)

    def show_facts(self, facts: Sequence[tuple[str, ...]], dots: Mapping[int, str] | None = None) -> None:
        """Each a word with a number, or more numbers that stand in columns.

        dots: by the place of a fact, the field of `Theme` with the colour of its curve beside the table.
        """
        self._dots = dots or {}
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
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setFont(LOOK.font(13))
        metrics = QtGui.QFontMetricsF(painter.font())
        count = max((len(fact) - 1 for fact in self.facts), default=0)
        widths = [
            max((number_width(painter.font(), fact[1 + k]) for fact in self.facts if len(fact) > 1 + k), default=0.0)
            for k in range(count)
        ]
        longest = max((number_width(painter.font(), fact[0]) for fact in self.facts), default=0.0)
        longest += DOTTED if self._dots else 0.0
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
            left = 0.0
            if line in self._dots:
                left = DOTTED
                middle = QtCore.QPointF(4, baseline - metrics.xHeight() / 2)
                paint_dot(painter, middle, getattr(theme, self._dots[line]))
            painter.setPen(QtGui.QColor(theme.quiet))
            room = max(right - left, 0)
            cut = metrics.elidedText(words, QtCore.Qt.TextElideMode.ElideRight, room)
            paint_number(painter, left, baseline, words if number_width(painter.font(), words) <= room else cut)
