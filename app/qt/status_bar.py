"""The line at the bottom of the window: what is open, what is remarkable about it, and what the pointer is at.

Nothing in it has a width that the window would have to follow.
"""

from collections.abc import Callable, Sequence

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import Surface
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.distances.answers import Answer

from ..document.page import Recipe
from ..scene.style import Style
from .look.icons import pixmap
from .look.layouts import in_row
from .look.look import LOOK
from .look.numbers import number, number_width, paint_number
from .look.painting import paint_rounded, smooth_painter

HEIGHT = 28
SAID_MS = 8000
LISTED = 20
"""Sentences of a chip's list at most, as a higher menu would go into columns; all of them can be copied."""

WIDEST_PLACE = "−0.00000"
"""A coordinate as wide as they get, most often; wider ones are cut at the left."""


class StatusBar(QtWidgets.QStatusBar):
    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizeGripEnabled(False)
        self.counts = Words("quiet")
        self.notes = Chip(("warning", "warnings"), ("repair", "repairs"), ("fact", "facts"))
        self.accuracy = Chip(("panel not exact", "panels not exact"))
        self.message = Words("quiet")
        self.progress = Words("quiet", is_meant=True)
        self.vertex, self.place = Words("text", is_right=True), Words("text", is_right=True)
        self._row = QtWidgets.QWidget()
        left, right = (self.counts, self.notes, self.accuracy), (self.progress, self.vertex, self.place)
        in_row(*left, (self.message, 1), *right, of=self._row, spacing=12, margins=(12, 0, 12, 0))
        self._row.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)
        self.addPermanentWidget(self._row, 1)
        self._vertices, self._faces = "", ""
        self._holds: Callable[[], bool] | None = None
        self._forget_soon = QtCore.QTimer(self, singleShot=True, interval=SAID_MS, timeout=self._forget)
        LOOK.changed.connect(self._fit)
        self.show_surface(None)
        self._fit()

    def insert(self, widget: QtWidgets.QWidget) -> None:
        """Something of its own, left of what the pointer is at."""
        layout = self._row.layout()
        layout.insertWidget(layout.indexOf(self.vertex), widget)

    # ------------------------------------------------------------------ what is said
    def show_surface(self, surface: Surface | None, more: Sequence[str] = (), beside: Sequence[Surface] = ()) -> None:
        """Its counts and its notes, and those of surfaces beside it; more: other facts."""
        if surface is None:
            self._vertices, self._faces = "No mesh", ""
            self.notes.show_lists()
        else:
            self._vertices, self._faces = f"{len(surface.vertices):,} vertices", f"{len(surface.faces):,} faces"
            lettered = [("", surface)]
            if beside:
                lettered = list(zip("ABCDEFGH", (surface, *beside), strict=False))
                self._vertices = "   ".join(f"{k}  {len(each.vertices):,} vertices" for k, each in lettered)
                self._faces = ""
            notes = [(f"{letter}: " if letter else "", surface_notes(each)) for letter, each in lettered]
            self.notes.show_lists(
                [mark + text for mark, each in notes for text in each.warnings],
                [mark + text for mark, each in notes for text in each.repairs],
                [*(mark + text for mark, each in notes for text in each.facts), *more],
            )
        self.accuracy.show_lists()
        self.show_place(None, None)
        self._fit()

    def show_inexact(self, answers: Sequence[Answer]) -> None:
        """Which of the panels' answers are not exact, and by how much."""
        poor = dict.fromkeys(f"{a.label}: only {a.accuracy.text}" for a in answers if a.accuracy.is_poor)
        self.accuracy.show_lists(list(poor))

    def show_place(self, vertex: int | None, position: Sequence[float] | None, letter: str = "") -> None:
        """letter: of the surface, where there are two."""
        where = f" on {letter}" if letter else ""
        self.vertex.show_text("" if vertex is None else f"vertex {vertex}{where}")
        self.place.show_text("" if position is None else "  ".join(number(x) for x in position))

    def say(self, text: str, holds: Callable[[], bool] | None = None) -> None:
        """For a while; holds: whether it is true, asked as the document changes."""
        self._holds = holds
        self.message.show_text(text)
        self._forget_soon.start()

    def document_changed(self) -> None:
        """What was said of the document before may no longer hold."""
        if self._holds is not None and not self._holds():
            self._forget_soon.stop()
            self._forget()

    def show_rate(self, text: str) -> None:
        """How quickly fields follow, as long as they do; "" afterwards."""
        self._forget_soon.stop()
        self._holds = None
        self.message.show_text(text)

    def _forget(self) -> None:
        self._holds = None
        self.message.show_text("")

    def show_progress(self, text: str) -> None:
        """What goes on beside the panels."""
        self.progress.show_text(text)
        self.progress.updateGeometry()

    # ------------------------------------------------------------------ how it fits
    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """In a narrow window the faces, then the message, then the position go."""
        font = LOOK.font(12.5)
        self.setFixedHeight(round(HEIGHT * LOOK.scale))
        self._row.setFixedHeight(self.height() - 2)
        width = self.width()
        is_narrow = width < 800 * LOOK.scale
        self.counts.show_text(self._vertices if is_narrow or not self._faces else f"{self._vertices}  {self._faces}")
        self.counts.fix(number_width(font, self.counts.text) + 4)
        on = " on B" if "   " in self._vertices else ""
        self.vertex.fix(number_width(font, f"vertex 0000000{on}"))
        self.place.fix(3 * number_width(font, WIDEST_PLACE) + 2 * number_width(font, "  "))
        self.place.setVisible(width >= 640 * LOOK.scale)
        self.progress.setMaximumWidth(width // 3)

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, self.height())


class Words(QtWidgets.QWidget):
    """A line of words that takes the room it gets: what does not fit ends in dots and is in the tooltip.

    is_meant: it asks for the room that it needs.
    """

    def __init__(self, colour: str, is_right: bool = False, is_meant: bool = False) -> None:
        super().__init__()
        self.text = ""
        self._colour, self._is_right = colour, is_right
        policy = QtWidgets.QSizePolicy.Policy
        self.setSizePolicy(policy.Preferred if is_meant else policy.Ignored, policy.Preferred)

    def show_text(self, text: str) -> None:
        """Show a text, "" for none."""
        if text != self.text:
            self.text = text
            self.setAccessibleName(text)
            self.update()

    def fix(self, width: float) -> None:
        """Always have this width."""
        self.setFixedWidth(round(width))
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Fixed, QtWidgets.QSizePolicy.Policy.Preferred)

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(round(number_width(LOOK.font(12.5), self.text)) + 2, HEIGHT - 4)

    @property
    def fitting(self) -> str:
        """What there is room for, with dots for the rest."""
        font = LOOK.font(12.5)
        metrics, width = QtGui.QFontMetrics(font), number_width(font, self.text)
        if width <= self.width():
            return self.text
        wider = width - metrics.horizontalAdvance(self.text)  # as digits of equal width are
        room = int(self.width() - max(wider, 0))
        return str(metrics.elidedText(self.text, QtCore.Qt.TextElideMode.ElideRight, room))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setFont(LOOK.font(12.5))
        painter.setPen(QtGui.QColor(getattr(LOOK.theme, self._colour)))
        metrics, text = painter.fontMetrics(), self.text if self._is_right else self.fitting
        width = number_width(painter.font(), text)
        self.setToolTip(self.text if text != self.text or width > self.width() else "")
        baseline = (self.height() + metrics.ascent() - metrics.descent()) / 2
        paint_number(painter, self.width() - width if self._is_right else 0.0, baseline, text)


class Chip(QtWidgets.QToolButton):
    """ "2 warnings, 1 repair": a click lists them; hidden while there are none."""

    def __init__(self, *kinds: tuple[str, str]) -> None:
        """kinds: what one and several sentences of a kind are called; those of the first are warnings."""
        super().__init__()
        self._kinds = kinds
        self._lists: list[list[str]] = [[] for _ in kinds]
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        self.setCursor(QtCore.Qt.CursorShape.PointingHandCursor)
        self.clicked.connect(self._list)
        self.hide()

    def show_lists(self, *lists: list[str]) -> None:
        """Sentences of each kind; of those at the end that are left out there are none."""
        self._lists = [*lists, *([] for _ in self._kinds[len(lists) :])]
        self.setVisible(any(lists))
        self.setAccessibleName(self.words)
        self.setToolTip(f"{self.words}: click for the list")
        self.updateGeometry()
        self.update()

    @property
    def sentences(self) -> list[str]:
        """All that is to be told, a sentence each."""
        return [sentence for some in self._lists for sentence in some]

    @property
    def words(self) -> str:
        """How many there are of each kind, in a few words."""
        counted = zip(self._lists, self._kinds, strict=True)
        return ", ".join(f"{len(some):,} {one if len(some) == 1 else many}" for some, (one, many) in counted if some)

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(QtGui.QFontMetrics(LOOK.font(12)).horizontalAdvance(self.words) + 42, 20)

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(30, 20)

    def _list(self) -> None:
        menu = QtWidgets.QMenu(self, toolTipsVisible=True)
        metrics = QtGui.QFontMetrics(LOOK.font())
        has_heads = len(self._kinds) > 1
        for some, (_, many) in zip(self._lists, self._kinds, strict=True):
            if some and has_heads:
                menu.addAction(many.capitalize()).setEnabled(False)
            for sentence in some[:LISTED]:
                shown = metrics.elidedText(sentence, QtCore.Qt.TextElideMode.ElideRight, 560)
                menu.addAction(shown).setToolTip(sentence)
            if len(some) > LISTED:
                menu.addAction(f"and {len(some) - LISTED:,} more").setEnabled(False)
        menu.addSeparator()
        menu.addAction("Copy", lambda: QtWidgets.QApplication.clipboard().setText("\n".join(self.sentences)))
        menu.aboutToHide.connect(menu.deleteLater)
        menu.popup(self.mapToGlobal(QtCore.QPoint(0, -menu.sizeHint().height())))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter, is_warning = LOOK.theme, smooth_painter(self), bool(self._lists[0])
        box = QtCore.QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        ground, line = theme.warning_ground if is_warning else theme.hover, theme.accent if self.hasFocus() else ""
        paint_rounded(painter, box, min(10, box.height() / 2), ground, line, 2)
        colour = theme.warning if is_warning else theme.quiet
        sign = pixmap("warning" if is_warning else "info", colour, self.devicePixelRatioF(), 14)
        painter.drawPixmap(QtCore.QPointF(8, (self.height() - 14) / 2), sign)
        painter.setFont(LOOK.font(12))
        painter.setPen(QtGui.QColor(colour))
        room = QtCore.QRectF(27, 0, self.width() - 33, self.height())
        words = painter.fontMetrics().elidedText(self.words, QtCore.Qt.TextElideMode.ElideRight, int(room.width()) + 1)
        painter.drawText(room, QtCore.Qt.AlignmentFlag.AlignVCenter, words)


def unseen(recipe: Recipe, style: Style) -> list[str]:
    """What a recipe has that panels do not show."""
    words = [f"views but the first of {len(recipe.views)}"] if len(recipe.views) > 1 else []
    words += ["outlines"] if style.outline else []
    return [f"in figures only: {', '.join(words)}"] if words else []
