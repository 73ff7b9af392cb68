"""The line at the bottom of the window: what is open, what is remarkable about it, and what the pointer is at.

Nothing in it has a width that the window would have to follow.
"""

from collections.abc import Callable, Sequence

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import Surface
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.counts import counted
from bihdist_core.distances.answers import Answer
from bihdist_core.tetrahedra import SolidBoundary

from ..document.page import Recipe
from ..drawing.numbers import coordinates
from ..drawing.painters.qt import number_width, paint_number
from ..scene.style import Style
from .look.form import in_row
from .look.icons import pixmap
from .look.look import LOOK, paint_rounded, smooth_painter

HEIGHT = 28
SAID_MS = 8000
LISTED = 20
"""Sentences of a badge's list at most, as a higher menu would go into columns; all of them can be copied."""

WIDEST_PLACE = "−0.00000"
"""A coordinate of the usual width; those of a surface have the room that its ends need."""


class StatusBar(QtWidgets.QStatusBar):
    """The status bar; `marks_wanted` is emitted by a click on the badge of marks."""

    marks_wanted = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizeGripEnabled(False)
        self.counts = Words("quiet")
        self.notes = ListBadge(("note", "notes"), ("Warnings", "Repairs", "Facts"))
        self.accuracy = ListBadge(("panel not exact", "panels not exact"), ("",))
        self.marks = StatusBadge("eye")
        self.marks.clicked.connect(lambda *_: self.marks_wanted.emit())
        self.time = Words("quiet", is_meant=True)
        self.message = Words("quiet", is_meant=True)
        self.progress = Words("quiet", is_meant=True)
        self.vertex, self.place = Words("text", is_right=True), Words("text", is_right=True)
        self._row = QtWidgets.QWidget()
        left = self.counts, self.notes, self.accuracy, self.marks, self.time
        right = self.progress, self.vertex, self.place
        in_row(*left, (self.message, 1), *right, of=self._row, spacing=12, margins=(12, 0, 12, 0))
        self._row.installEventFilter(self)
        self._row.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)
        self.addPermanentWidget(self._row, 1)
        self._vertices, self._faces = "", ""
        self._ends: list[list[str]] = []  # the least and the greatest coordinates of the surfaces, as text
        self._holds: Callable[[], bool] | None = None
        self._forget_soon = QtCore.QTimer(self, singleShot=True, interval=SAID_MS, timeout=self._forget)
        LOOK.changed.connect(self._fit)
        self.show_surface(None)
        self._fit()

    def insert(self, widget: QtWidgets.QWidget) -> None:
        """Insert a widget left of the position of the pointer."""
        layout = self._row.layout()
        layout.insertWidget(layout.indexOf(self.vertex), widget)

    # ------------------------------------------------------------------ what is said
    def show_surface(self, surface: Surface | None, more: Sequence[str] = (), beside: Sequence[Surface] = ()) -> None:
        """Show the counts and notes of the surfaces, and `more` facts."""
        if surface is None:
            self._vertices, self._faces = "No mesh", ""
            self.show_time("")
            self.notes.show_lists()
        else:
            self._vertices = _size(surface)
            self._faces = counted(len(surface.faces), "face") if len(surface.faces) else "no faces"
            if isinstance(surface, SolidBoundary):
                self._faces = counted(len(surface.tetrahedra), "tetrahedron", "tetrahedra")
            lettered = [("", surface)]
            if beside:
                lettered = list(zip("ABCDEFGH", (surface, *beside), strict=False))
                self._vertices = "   ".join(f"{k}  {_size(each)}" for k, each in lettered)
                self._faces = ""
            notes = [(f"{letter}: " if letter else "", surface_notes(each)) for letter, each in lettered]
            self.notes.show_lists(
                [mark + text for mark, each in notes for text in each.warnings],
                [mark + text for mark, each in notes for text in each.repairs],
                [*(mark + text for mark, each in notes for text in each.facts), *more],
            )
        shown = [] if surface is None else [surface, *beside]
        self._ends = [
            coordinates(end, each.mean_edge_length).split("  ")
            for each in shown
            for end in (each.vertices.min(axis=0), each.vertices.max(axis=0))
        ]
        self.accuracy.show_lists()
        self.show_place(None)
        self._fit()

    def show_inexact(self, answers: Sequence[Answer]) -> None:
        """Show which answers are not exact, and their accuracy."""
        poor = dict.fromkeys(f"{a.label}: only {a.accuracy.text}" for a in answers if a.accuracy.is_poor)
        self.accuracy.show_lists(list(poor))

    def show_time(self, text: str) -> None:
        """Show how long the last fields took, "" for nothing."""
        self.time.show_text(text)

    def show_marks(self, shown: int, hidden: int) -> None:
        """Show how many things are on the surface besides the source, and how many are hidden."""
        words = [f"{shown:,} on the surface"] * bool(shown) + [f"{hidden:,} hidden"] * bool(hidden)
        self.marks.show_words(", ".join(words), "click for the list (A)")

    def show_place(
        self,
        vertex: int | None,
        position: Sequence[float] | None = None,
        surface: Surface | None = None,
        letter: str = "",
    ) -> None:
        """Show the vertex of a surface under the pointer and its position, with the letter of one of two surfaces."""
        name, place = "", ""
        if vertex is not None and position is not None and surface is not None:
            name = f"{surface.nouns[0]} {vertex}" + (f" on {letter}" if letter else "")
            place = coordinates(position, surface.mean_edge_length)
        self.vertex.show_text(name)
        self.place.show_text(place)

    def say(self, text: str, holds: Callable[[], bool] | None = None) -> None:
        """Show a message for a while, but only as long as `holds()` after changes of the document."""
        self._holds = holds
        self.message.show_text(text)
        self._forget_soon.start()

    def document_changed(self) -> None:
        """Hide a message that no longer holds."""
        if self._holds is not None and not self._holds():
            self._forget_soon.stop()
            self._forget()

    def show_rate(self, text: str) -> None:
        """Show how fast fields follow the source, "" for nothing."""
        self._forget_soon.stop()
        self._holds = None
        self.message.show_text(text)

    def _forget(self) -> None:
        self._holds = None
        self.message.show_text("")

    def show_progress(self, text: str) -> None:
        """Show work that is not a panel's."""
        self.progress.show_text(text)

    # ------------------------------------------------------------------ how it fits
    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Hide the time, then the faces, then the position where there is no room, and shorten the message last."""
        font = LOOK.font(12.5)
        self.setFixedHeight(round(HEIGHT * LOOK.scale))
        self._row.setFixedHeight(self.height() - 2)
        width = self.width()
        is_narrow = width < 800 * LOOK.scale
        self.counts.show_text(self._vertices if is_narrow or not self._faces else f"{self._vertices}  {self._faces}")
        self.counts.fix(number_width(font, self.counts.text) + 4)
        on = " on B" if "   " in self._vertices else ""
        self.vertex.fix(number_width(font, f"vertex 0000000{on}"))
        axes = zip([WIDEST_PLACE] * 3, *self._ends, strict=True)
        widths = [max(number_width(font, text) for text in texts) for texts in axes]
        self.place.fix(sum(widths) + 2 * number_width(font, "  ") + 2)
        self.time.setVisible(width >= 1000 * LOOK.scale)
        self.progress.setMaximumWidth(width // 3)
        self._fit_place()

    def _fit_place(self) -> None:
        layout = self._row.layout()
        widgets = [layout.itemAt(k).widget() for k in range(layout.count())]
        needed = [max(w.minimumWidth(), w.sizeHint().width()) for w in widgets if w is self.place or not w.isHidden()]
        self.place.setVisible(sum(needed) + layout.spacing() * len(needed) + 12 <= self.width())

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        """Make room for a message or a badge."""
        if event.type() == QtCore.QEvent.Type.LayoutRequest:
            self._fit_place()
        return False

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, self.height())


class Words(QtWidgets.QWidget):
    """A line of words that takes the room it gets: what does not fit ends in dots and is in the tooltip.

    With `is_meant` it asks for the room that it needs.
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
            if self.sizePolicy().horizontalPolicy() == QtWidgets.QSizePolicy.Policy.Preferred:
                self.updateGeometry()
            self.update()

    def fix(self, width: float) -> None:
        """Keep a fixed width."""
        self.setFixedWidth(round(width))
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Fixed, QtWidgets.QSizePolicy.Policy.Preferred)

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(round(number_width(LOOK.font(12.5), self.text)) + 2, HEIGHT - 4)

    @property
    def fitting(self) -> str:
        """Return the text cut short to the width."""
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


class StatusBadge(QtWidgets.QToolButton):
    """A few words with an icon, to be clicked; hidden while there are none."""

    def __init__(self, icon: str) -> None:
        super().__init__()
        self.words, self.is_warning, self._icon = "", False, icon
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        self.setCursor(QtCore.Qt.CursorShape.PointingHandCursor)
        self.hide()

    def show_words(self, words: str, tip: str) -> None:
        """Show words, "" for none; the tip tells what a click does."""
        self.words = words
        self.setVisible(bool(words))
        self.setAccessibleName(words)
        self.setToolTip(f"{words}: {tip}")
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(QtGui.QFontMetrics(LOOK.font(12)).horizontalAdvance(self.words) + 42, 20)

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(30, 20)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, smooth_painter(self)
        box = QtCore.QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        ground, line = theme.warning_ground if self.is_warning else theme.hover, theme.accent if self.hasFocus() else ""
        paint_rounded(painter, box, min(10, box.height() / 2), ground, line, 2)
        colour = theme.warning if self.is_warning else theme.quiet
        sign = pixmap("warning" if self.is_warning else self._icon, colour, self.devicePixelRatioF(), 14)
        painter.drawPixmap(QtCore.QPointF(8, (self.height() - 14) / 2), sign)
        painter.setFont(LOOK.font(12))
        painter.setPen(QtGui.QColor(colour))
        room = QtCore.QRectF(27, 0, self.width() - 33, self.height())
        words = painter.fontMetrics().elidedText(self.words, QtCore.Qt.TextElideMode.ElideRight, int(room.width()) + 1)
        painter.drawText(room, QtCore.Qt.AlignmentFlag.AlignVCenter, words)


class ListBadge(StatusBadge):
    """A badge with a number of sentences, such as "2 notes", which a click lists."""

    def __init__(self, counted: tuple[str, str], heads: tuple[str, ...]) -> None:
        """Take the words for one and for several sentences, and headings of kinds of them, of which the first warn."""
        super().__init__("info")
        self._counted, self._heads = counted, heads
        self._lists: list[list[str]] = [[] for _ in heads]
        self.clicked.connect(self._list)

    def show_lists(self, *lists: list[str]) -> None:
        """Show the sentences of each kind; kinds at the end can be left out."""
        self._lists = [*lists, *([] for _ in self._heads[len(lists) :])]
        self.is_warning = bool(self._lists[0])
        count = len(self.sentences)
        self.show_words(f"{count:,} {self._counted[count != 1]}" if count else "", "click for the list")

    @property
    def sentences(self) -> list[str]:
        """All sentences, for copying."""
        return [sentence for some in self._lists for sentence in some]

    def _list(self) -> None:
        menu = QtWidgets.QMenu(self, toolTipsVisible=True)
        metrics = QtGui.QFontMetrics(LOOK.font())
        for some, head in zip(self._lists, self._heads, strict=True):
            if some and head:
                menu.addAction(head).setEnabled(False)
            for sentence in some[:LISTED]:
                shown = metrics.elidedText(sentence, QtCore.Qt.TextElideMode.ElideRight, 560)
                menu.addAction(shown).setToolTip(sentence)
            if len(some) > LISTED:
                menu.addAction(f"and {len(some) - LISTED:,} more").setEnabled(False)
        menu.addSeparator()
        menu.addAction("Copy", lambda: QtWidgets.QApplication.clipboard().setText("\n".join(self.sentences)))
        menu.aboutToHide.connect(menu.deleteLater)
        menu.popup(self.mapToGlobal(QtCore.QPoint(0, -menu.sizeHint().height())))


def _size(surface: Surface) -> str:
    return counted(len(surface.vertices), *surface.nouns)


def unseen(recipe: Recipe, style: Style) -> list[str]:
    """Return the parts of a recipe that panels do not show."""
    words = [f"views but the first of {len(recipe.views)}"] if len(recipe.views) > 1 else []
    words += ["outlines"] if style.outline else []
    return [f"in figures only: {', '.join(words)}"] if words else []
