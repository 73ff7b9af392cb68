"""The tour: a card beside one part of the window after the other, while the user can try what it says."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from ..look.icons import put_icon
from ..look.look import LOOK

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


def steps(window: QtWidgets.QWidget) -> list[Step]:
    """The five of this window; parts that it does not have, or not yet, are None."""

    def part_of_panel(name: str) -> QtWidgets.QWidget | None:
        panels = getattr(getattr(window, "grid", None), "panels", None)
        return getattr(panels[0], name, None) if panels else None

    def export() -> QtWidgets.QWidget | None:
        tools = getattr(window, "tools", None)
        return tools.get("export") if isinstance(tools, dict) else None

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
            lambda: getattr(window, "tool_bar", None),
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
        self.card, self.outline = Card(window), Outline(window)
        self.card.back.clicked.connect(lambda: self.go(self.at - 1))
        self.card.next.clicked.connect(lambda: self.go(self.at + 1))
        self.card.close_button.clicked.connect(self.end)
        self._escape = QtWidgets.QShortcut(QtGui.QKeySequence(QtCore.Qt.Key.Key_Escape), window, enabled=False)
        self._escape.activated.connect(self.end)
        self._escape.activatedAmbiguously.connect(self.end)
        # Panels come and go and docks move them: watching the window alone would not do.
        self._again = QtCore.QTimer(self, interval=LOOK_AGAIN_MS)
        self._again.timeout.connect(self.place)
        LOOK.changed.connect(self._fit)

    @property
    def is_on(self) -> bool:
        return self._again.isActive()

    def start(self) -> None:
        """From the first step, also when it is on already."""
        self.window.installEventFilter(self)
        self._escape.setEnabled(True)
        self._again.start()
        self.go(0)
        self.card.next.setFocus(QtCore.Qt.FocusReason.OtherFocusReason)

    def go(self, step: int) -> None:
        """To a step, counted from 0; after the last the tour ends."""
        if step >= len(self.steps):
            self.end()
            return
        self.at = max(step, 0)
        self.card.show_step(self.steps[self.at], self.at, len(self.steps))
        self.card.show()
        self.place()

    def end(self) -> None:
        if not self.is_on:
            return
        self._again.stop()
        self._escape.setEnabled(False)
        self.window.removeEventFilter(self)
        self.card.hide()
        self.outline.hide()
        self.ended.emit()

    def place(self) -> None:
        """Put the card and the outline to where the step's widget is now."""
        target = self.steps[self.at].where()
        room = room_of(self.window)
        about = rectangle_in(target, self.window) if target is not None else None
        self.outline.setVisible(about is not None)
        if about is not None:
            self.outline.setGeometry(about.adjusted(-OUTLINE, -OUTLINE, OUTLINE, OUTLINE) & self.window.rect())
            self.outline.raise_()
        self.card.move(beside(about, self.card.size(), room))
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


def beside(about: QtCore.QRect | None, card: QtCore.QSize, room: QtCore.QRect) -> QtCore.QPoint:
    """The card's corner: below, right of, left of or above what it is about, the first where it has room.

    Without room on any side it lies in the lower right corner of that; without anything it is about, in the middle.
    """
    if about is None:
        return room.center() - QtCore.QPoint(card.width() // 2, card.height() // 2)
    level = about.center().x() - card.width() // 2
    right_corner = about.bottomRight() - QtCore.QPoint(card.width() + GAP, card.height() + GAP)
    places = [
        QtCore.QPoint(level, about.bottom() + GAP),
        QtCore.QPoint(about.right() + GAP, about.top()),
        QtCore.QPoint(about.left() - GAP - card.width(), about.top()),
        QtCore.QPoint(level, about.top() - GAP - card.height()),
    ]
    inside = [QtCore.QRect(_into(room, place, card), card) for place in places]
    clear = [place.topLeft() for place in inside if not place.intersects(about)]
    return clear[0] if clear else _into(room, right_corner, card)


def _into(room: QtCore.QRect, corner: QtCore.QPoint, card: QtCore.QSize) -> QtCore.QPoint:
    """Not beyond the room; where it is too small for the card, at its upper left."""
    x = max(min(corner.x(), room.right() + 1 - card.width()), room.left())
    y = max(min(corner.y(), room.bottom() + 1 - card.height()), room.top())
    return QtCore.QPoint(x, y)


# ---------------------------------------------------------------------- what is seen
class Card(QtWidgets.QWidget):
    """One step: its title and text, the way on, back and out."""

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window, visible=False)
        self.title, self.text, self.count = QtWidgets.QLabel(), QtWidgets.QLabel(wordWrap=True), QtWidgets.QLabel()
        self.text.setProperty("quiet", True)
        self.count.setProperty("quiet", True)
        self.close_button = QtWidgets.QToolButton(toolTip="End the tour (Esc)", accessibleName="End the tour")
        put_icon(self.close_button, "close", colour_of="quiet")
        self.back, self.next = QtWidgets.QPushButton("Back"), QtWidgets.QPushButton("Next", objectName="fill")
        top, bottom = QtWidgets.QHBoxLayout(), QtWidgets.QHBoxLayout(spacing=8)
        top.addWidget(self.title, 1)
        top.addWidget(self.close_button)
        words = QtWidgets.QHBoxLayout()
        words.addWidget(self.text)
        bottom.addWidget(self.count, 1)
        bottom.addWidget(self.back)
        bottom.addWidget(self.next)
        lines = QtWidgets.QVBoxLayout(self, spacing=4)
        # The cross, not its button, ends where the text does.
        lines.setContentsMargins(16, 8, 8, 16)
        for row in (words, bottom):
            row.setContentsMargins(0, 0, 8, 0)
        lines.addLayout(top)
        lines.addLayout(words)
        lines.addSpacing(12)
        lines.addLayout(bottom)

    def show_step(self, step: Step, at: int, count: int) -> None:
        self.title.setText(step.title)
        self.text.setText(step.text)
        self.count.setText(f"{at + 1} of {count}")
        self.back.setEnabled(at > 0)
        self.next.setText("Done" if at == count - 1 else "Next")
        self.setAccessibleName(f"{step.title}. {step.text}")
        self.fit()

    def fit(self) -> None:
        """As wide as cards are, as high as its text needs."""
        self.title.setFont(LOOK.font(bold=True))
        self.setFixedWidth(round(WIDE * LOOK.scale))
        self.layout().activate()
        self.resize(self.width(), self.layout().totalHeightForWidth(self.width()))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setPen(QtGui.QColor(LOOK.theme.strong))
        painter.setBrush(QtGui.QColor(LOOK.theme.raised))
        painter.drawRoundedRect(QtCore.QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 8, 8)

    # A click on the card is not one on what lies under it.
    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        event.accept()


class Outline(QtWidgets.QWidget):
    """Round what a step is about; the mouse does not notice it."""

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window, visible=False)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        LOOK.changed.connect(self.update)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setPen(QtGui.QPen(QtGui.QColor(LOOK.theme.accent), OUTLINE))
        inset = OUTLINE / 2
        painter.drawRoundedRect(QtCore.QRectF(self.rect()).adjusted(inset, inset, -inset, -inset), ROUND, ROUND)
