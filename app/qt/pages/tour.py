"""The tour: a card about one part of the window after the other, while the user can try what it says.

It stays in its place, so that whoever clicks twice does not click what lies under it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from qtpy import QtCore, QtGui, QtWidgets

from ..look.icons import put_icon
from ..look.layouts import in_column, in_row, quiet_label
from ..look.look import LOOK
from ..look.painting import paint_rounded, smooth_painter

WIDE, GAP, MARGIN = 300, 12, 8
"""Logical pixels: the card's width, between it and what it is about, and to the window's edge."""

OUTLINE, ROUND = 2, 6
"""Of what it is about: how thick, and the radius of its corners."""

LOOK_AGAIN_MS = 150
"""How often it is seen where the parts of the window have gone."""


@dataclass(frozen=True)
class Step:
    """where: gives the widget it is about as it is now, or None."""

    title: str
    text: str
    where: Callable[[], QtWidgets.QWidget | None]


def steps(window: QtWidgets.QWidget, panels: Callable[[], Sequence[Any]]) -> list[Step]:
    """The five of this window; parts that it does not have, or not yet, are None.  panels: asks for those there are."""

    def part_of_panel(name: str) -> QtWidgets.QWidget | None:
        there = panels()
        return getattr(there[0], name) if there else None

    def bar() -> QtWidgets.QWidget | None:
        return window.findChild(QtWidgets.QToolBar, "tools")

    def export() -> QtWidgets.QWidget | None:
        there = bar()
        return None if there is None else there.findChild(QtWidgets.QWidget, "export")

    return [
        Step(
            "Click a place",
            "The distances from there appear in all panels. Drag the yellow mark and they follow; drag anywhere else "
            "to turn the surface.",
            lambda: part_of_panel("view"),
        ),
        Step(
            "Compare the panels",
            "Move the pointer over a surface. Each panel says its value at that place, and a tick on its colour bar "
            "shows where it lies.",
            lambda: part_of_panel("bar"),
        ),
        Step(
            "Choose another distance",
            "A panel's name is a menu of distances. The parameters of the one it shows stand beside the name.",
            lambda: part_of_panel("head"),
        ),
        Step(
            "Change the look",
            "Isolines, colours, range and view are here, for all panels at once. Undo takes back any step.",
            bar,
        ),
        Step(
            "Export a figure",
            "What the panels show becomes a figure for a paper, a slide or a poster, with its colour bars.",
            export,
        ),
    ]


class Tour(QtCore.QObject):
    """`start()` shows the first step, `ended` is emitted once when it is over, however that comes about."""

    ended = QtCore.Signal()

    def __init__(self, window: QtWidgets.QWidget, steps: Sequence[Step]) -> None:
        super().__init__(window)
        self.window, self.steps, self.at = window, list(steps), 0
        self.card, self.outline = Card(window, self.steps), Outline(window)
        # What the second click of two meets where the card was: nothing.
        self._shield = QtWidgets.QWidget(window, visible=False)
        self._shield_gone = QtCore.QTimer(self, singleShot=True, timeout=self._shield.hide)
        self.card.back.clicked.connect(lambda: self.go(self.at - 1))
        self.card.next.clicked.connect(lambda: self.go(self.at + 1))
        self.card.close_button.clicked.connect(self.end)
        # Panels come and go and docks move them: watching the window alone would not do.
        self._again = QtCore.QTimer(self, interval=LOOK_AGAIN_MS, timeout=self.place)
        LOOK.changed.connect(self._fit)

    @property
    def is_on(self) -> bool:
        """Whether the tour is under way."""
        return bool(self._again.isActive())

    def start(self) -> None:
        """From the first step, also when it is on already."""
        self.window.installEventFilter(self)
        self._again.start()
        self.go(0)
        self.card.next.setFocus(QtCore.Qt.FocusReason.OtherFocusReason)

    def go(self, step: int) -> None:
        """To a step, counted from 0; after the last the tour ends."""
        if step >= len(self.steps):
            self.end()
            return
        self.at = max(step, 0)
        self.card.show_step(self.at)
        self.card.fit()
        self.card.show()
        self.place()

    def end(self) -> None:
        """End the tour, if it is under way."""
        if not self.is_on:
            return
        self._again.stop()
        self.window.removeEventFilter(self)
        self._shield.setGeometry(self.card.geometry())
        self._shield.show()
        self._shield.raise_()
        self._shield_gone.start(QtWidgets.QApplication.doubleClickInterval())
        self.card.hide()
        self.outline.hide()
        self.ended.emit()

    def place(self) -> None:
        """Put the outline round the step's widget as it is now, and the card to where it hides the part of no step."""
        targets = [step.where() for step in self.steps]
        parts = [None if target is None else rectangle_in(target, self.window) for target in targets]
        about = parts[self.at]
        self.outline.setVisible(about is not None)
        if about is not None:
            self.outline.setGeometry(about.adjusted(-OUTLINE, -OUTLINE, OUTLINE, OUTLINE) & self.window.rect())
            self.outline.raise_()
        seen = [part for part in parts if part is not None]
        self.card.move(place_beside(seen, self.card.size(), room_of(self.window)))
        self.card.raise_()

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.Resize:
            # What is in the window has not moved yet.
            QtCore.QTimer.singleShot(0, self._fit)
        return False

    def _fit(self) -> None:
        if self.is_on:
            self.card.fit()
            self.place()


# ---------------------------------------------------------------------- places
def room_of(window: QtWidgets.QWidget) -> QtCore.QRect:
    """Where a card may be: the window without its edge and its status bar, which is a native window over all others."""
    room = window.rect().adjusted(MARGIN, MARGIN, -MARGIN, -MARGIN)
    status = window.findChild(QtWidgets.QStatusBar)
    if status is not None and status.isVisible():
        room.setBottom(min(room.bottom(), status.mapTo(window, QtCore.QPoint(0, 0)).y() - MARGIN))
    return room


def rectangle_in(target: QtWidgets.QWidget, window: QtWidgets.QWidget) -> QtCore.QRect | None:
    """What is seen of a widget, in the window's coordinates; None if nothing is, or if it is in another window."""
    if not window.isAncestorOf(target) or target.visibleRegion().isEmpty():
        return None
    return QtCore.QRect(target.mapTo(window, QtCore.QPoint(0, 0)), target.size()) & window.rect()


def place_beside(parts: Sequence[QtCore.QRect], card: QtCore.QSize, room: QtCore.QRect) -> QtCore.QPoint:
    """The card's corner: below, right of, left of or above one of the parts, the first place that is clear of all.

    Where there is none, in the largest part, at its lower right if that is clear of the others; without parts in the
    middle.
    """
    if not parts:
        return room.center() - QtCore.QPoint(card.width() // 2, card.height() // 2)
    largest = max(parts, key=lambda part: part.width() * part.height())
    others = [part for part in parts if part != largest]
    within = largest.bottomRight() - QtCore.QPoint(card.width() + GAP, card.height() + GAP)
    beside = [corner for part in parts for corner in _corners(part, card)]
    for corners, kept_clear in ((beside, parts), ([within, *beside], others)):
        for corner in corners:
            place = QtCore.QRect(_into(room, corner, card), card)
            if not any(place.intersects(part) for part in kept_clear):
                return place.topLeft()
    return _into(room, within, card)


def _corners(part: QtCore.QRect, card: QtCore.QSize) -> list[QtCore.QPoint]:
    """Of the card below, right of, left of and above a part."""
    level = part.center().x() - card.width() // 2
    return [
        QtCore.QPoint(level, part.bottom() + GAP),
        QtCore.QPoint(part.right() + GAP, part.top() + GAP),
        QtCore.QPoint(part.left() - GAP - card.width(), part.top() + GAP),
        QtCore.QPoint(level, part.top() - GAP - card.height()),
    ]


def _into(room: QtCore.QRect, corner: QtCore.QPoint, card: QtCore.QSize) -> QtCore.QPoint:
    """Not beyond the room; where it is too small for the card, at its upper left."""
    x = max(min(corner.x(), room.right() + 1 - card.width()), room.left())
    y = max(min(corner.y(), room.bottom() + 1 - card.height()), room.top())
    return QtCore.QPoint(x, y)


# ---------------------------------------------------------------------- what is seen
class Card(QtWidgets.QWidget):
    """One step: its title and text, the way on, back and out."""

    def __init__(self, parent: QtWidgets.QWidget, steps: Sequence[Step]) -> None:
        super().__init__(parent, visible=False)
        self._steps = steps
        self.title, self.text, self.count = QtWidgets.QLabel(), quiet_label(), quiet_label()
        self.title.setProperty("heading", True)
        self.text.setWordWrap(True)
        self.close_button = QtWidgets.QToolButton(toolTip="End the tour (Esc)", accessibleName="End the tour")
        put_icon(self.close_button, "close", colour_of="quiet")
        self.back, self.next = QtWidgets.QPushButton("Back"), QtWidgets.QPushButton("Next", objectName="fill")
        for button in (self.back, self.next):
            button.setAutoDefault(True)  # Enter presses it
        for other in (self.back, self.close_button):
            other.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)  # a click leaves the keys to the way on
        # The cross, not its button, ends where the text does.
        top, words = in_row((self.title, 1), self.close_button), in_row(self.text, margins=(0, 0, 8, 0))
        bottom = in_row((self.count, 1), self.back, self.next, spacing=8, margins=(0, 0, 8, 0))
        in_column(top, words, 12, None, bottom, of=self, spacing=4, margins=(16, 8, 8, 16))

    def show_step(self, at: int) -> None:
        """By its place, from 0."""
        step, count = self._steps[at], len(self._steps)
        self.title.setText(step.title)
        self.text.setText(step.text)
        self.count.setText(f"{at + 1} of {count}")
        self.back.setEnabled(at > 0)
        self.next.setText("Done" if at == count - 1 else "Next")
        self.setAccessibleName(f"{step.title}. {step.text}")

    def fit(self) -> None:
        """As wide as cards are, as high as the longest text needs, so that the buttons stay where they are."""
        self.setFixedWidth(round(WIDE * LOOK.scale))
        shown, heights = self.text.text(), []
        for step in self._steps:
            self.text.setText(step.text)
            self.layout().activate()
            heights.append(self.layout().totalHeightForWidth(self.width()))
        self.text.setText(shown)
        self.resize(self.width(), max(heights))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        box = QtCore.QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        paint_rounded(smooth_painter(self), box, 8, LOOK.theme.raised, LOOK.theme.strong)

    # A click on the card is not one on what lies under it.
    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        event.accept()


class Outline(QtWidgets.QWidget):
    """Round what a step is about; the mouse does not notice it."""

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent, visible=False)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        LOOK.changed.connect(self.update)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        inset = OUTLINE / 2
        box = QtCore.QRectF(self.rect()).adjusted(inset, inset, -inset, -inset)
        paint_rounded(smooth_painter(self), box, ROUND, line=LOOK.theme.accent, width=OUTLINE)
