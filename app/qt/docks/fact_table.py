"""Tables of facts: a label at the left, numbers in columns at the right."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

from qtpy import QtCore, QtGui, QtWidgets

from ...drawing.painters.qt import number_width, paint_number
from ..look.look import LOOK, baseline, paint_elided, smooth_painter
from .chart import paint_dot

DOTTED = 14.0
"""Logical pixels from a dot to the label after it."""


class FactTable(QtWidgets.QWidget):
    """A table of facts, with labels that are cut short where there is no room for them.

    Columns may have heads, and short ones where it is narrow.  Without heads labels are quiet, and only the first
    numbers are left where it is narrow.
    """

    HEADS: ClassVar[tuple[str, ...]] = ()
    SHORT_HEADS: ClassVar[tuple[str, ...]] = ()

    LINE, HEAD, GAP = 22.0, 0.0, 14.0
    """Heights of a line and of the heads, and the space before a column, in logical pixels."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.facts: Sequence[tuple[str, ...]] = ()
        self._dots: Mapping[int, str] = {}
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        LOOK.follow(self, self._fit)

    def show_facts(self, facts: Sequence[tuple[str, ...]], dots: Mapping[int, str] | None = None) -> None:
        """Show facts, each a label and one number or more.

        Parameters
        ----------
        dots
            By the place of a fact, the colour of its curve, or the field of `Theme` that has it.
        """
        dots = dots or {}
        if (list(facts), dots) != (list(self.facts), self._dots):
            self.facts, self._dots = facts, dots
            self.setAccessibleDescription("; ".join(" ".join(fact) for fact in facts))
            self._fit()

    def _fit(self) -> None:
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        height = self.HEAD + len(self.facts) * self.LINE if self.facts else 0.0
        return QtCore.QSize(160, round(height * LOOK.scale))

    def minimumSizeHint(self) -> QtCore.QSize:
        return self.sizeHint()

    # ------------------------------------------------------------------ painting
    def _columns(self, font: QtGui.QFont, small: QtGui.QFont, left: float) -> tuple[Sequence[str], list[float]]:
        """Return the heads of the columns for which there is room, and how wide these are."""
        labels = max((number_width(font, fact[0]) for fact in self.facts), default=0.0)

        def is_too_wide(widths: list[float]) -> bool:
            return bool(left + labels + sum(width + self.GAP for width in widths) > self.width())

        for heads in (self.HEADS, self.SHORT_HEADS):
            widths = [number_width(small, head) for head in heads]
            for _, *numbers in self.facts:
                widths += [0.0] * (len(numbers) - len(widths))
                for k, text in enumerate(numbers):
                    widths[k] = max(widths[k], number_width(font, text))
            if not is_too_wide(widths):
                break
        while len(widths) > 1 and not self.HEADS and is_too_wide(widths):
            widths.pop()
        return heads, widths

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if not self.facts:
            return
        theme, painter = LOOK.theme, smooth_painter(self)
        font, small, left = LOOK.font(13), LOOK.font(12), DOTTED if self._dots else 0.0
        heads, widths = self._columns(font, small, left)
        rights = [self.width() - sum(width + self.GAP for width in widths[k + 1 :]) for k in range(len(widths))]
        if heads:
            painter.setFont(small)
            painter.setPen(QtGui.QColor(theme.quiet))
            self.paint_heads(painter, heads, widths, rights)
        painter.setFont(font)
        metrics, step = QtGui.QFontMetricsF(font), self.LINE * LOOK.scale
        for line, (label, *numbers) in enumerate(self.facts):
            y = baseline(painter, self.HEAD * LOOK.scale + (line + 0.5) * step)
            painter.setPen(QtGui.QColor(theme.text))
            shown = numbers[: len(rights)]
            first = len(rights) - len(shown)
            for text, right in zip(shown, rights[first:], strict=True):
                paint_number(painter, right - number_width(font, text), y, text)
            if line in self._dots:
                colour = self._dots[line]
                paint_dot(painter, QtCore.QPointF(4, y - metrics.xHeight() / 2), getattr(theme, colour, colour), 5.0)
            painter.setPen(QtGui.QColor(theme.text if heads else theme.quiet))
            end = rights[first] - widths[first] - self.GAP if shown else float(self.width())
            paint_elided(painter, left, y, label, end - left)

    def paint_heads(
        self, painter: QtGui.QPainter, heads: Sequence[str], widths: Sequence[float], rights: Sequence[float]
    ) -> None:
        """Paint the heads over the right ends of the columns."""
        for head, right in zip(heads, rights, strict=True):
            y = baseline(painter, self.HEAD * LOOK.scale / 2)
            paint_number(painter, right - number_width(painter.font(), head), y, head)
