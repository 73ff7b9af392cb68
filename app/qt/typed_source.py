"""The source as typed in the tool bar's box."""

import re
from collections.abc import Mapping

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, ParameterError
from bihdist_core.sources.source import Curve, Source
from bihdist_core.sources.words import EMPTY, source_from_words, words_of

from ..document.edits import move_source
from ..document.source_edits import members_of
from ..session.questions import source_at
from .context import Context
from .files.curve_files import CurveFiles
from .look.controls import TextBox, mark_wrong
from .look.look import LOOK

PAD = 9
"""Pixels at each side of the words: the style sheet's border and padding, and two that Qt leaves in every line."""

WIDEST_SENTENCE = 420

WHAT = "12, 12+40+7, f311:0.2,0.5, loop:0 or curve.json"
SHOWN_MS = 6000
"""Time for which an error is shown."""


class SourceBox(TextBox):
    """`chosen(source, files)` by Enter, with the files its curves were read from; what is not a source is said
    under the box, with those that there are.
    """

    chosen = QtCore.Signal(object, object)
    left = QtCore.Signal()  # the keys are wanted elsewhere again

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("Source")
        self.setPlaceholderText("–")
        self._source: Source | None = None
        self._count = 0
        self.wrong = QtWidgets.QLabel(self.window(), QtCore.Qt.WindowType.ToolTip)
        self.wrong.setProperty("error", True)
        self.wrong.setMargin(6)
        self.wrong.setWordWrap(True)
        self._hide_soon = QtCore.QTimer(self, singleShot=True, interval=SHOWN_MS, timeout=self.forgive)
        self.returnPressed.connect(self._choose)
        self.textEdited.connect(self.forgive)
        self.show_source(None, 0)

    def show_source(self, source: Source | None, count: int, noun: str = "vertex") -> None:
        """Show the source, None if there is none, of a surface with `count` vertices, each called by a noun."""
        words = "" if source is None else words_of(source)
        self._source, self._count, self._noun = source, count, noun
        self.setEnabled(source is not None)
        self.setText(words)
        self.setCursorPosition(0)
        self.setModified(False)
        self.forgive()
        known = f"\nNow: {words if len(words) < 200 else words[:200] + '…'}" if len(words) > 10 else ""
        self.setToolTip(f"Source (G): what distances start from; type {WHAT} and press Enter{known}")

    @property
    def _room(self) -> QtCore.QRect:
        """The rectangle of the text."""
        margins = self.textMargins()
        return self.rect().adjusted(margins.left() + PAD, 0, -margins.right() - PAD, 0)

    @property
    def seen(self) -> str:
        """The text as it is painted while nobody types, cut short where it has no room."""
        cut = QtCore.Qt.TextElideMode.ElideRight
        return str(self.fontMetrics().elidedText(self.text(), cut, self._room.width()))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if self.hasFocus() or self.seen == self.text():
            super().paintEvent(event)
            return
        painter, option = QtGui.QPainter(self), QtWidgets.QStyleOptionFrame()
        self.initStyleOption(option)
        self.style().drawPrimitive(QtWidgets.QStyle.PrimitiveElement.PE_PanelLineEdit, option, painter, self)
        painter.setPen(QtGui.QColor(LOOK.theme.text if self.isEnabled() else LOOK.theme.disabled))
        painter.drawText(self._room, QtCore.Qt.AlignmentFlag.AlignVCenter, self.seen)

    def value(self) -> Source:
        """Return the source that is shown, -1 if there is none."""
        return -1 if self._source is None else self._source

    def ask(self) -> None:
        """Take the keyboard focus with the text selected."""
        self.setFocus(QtCore.Qt.FocusReason.ShortcutFocusReason)
        self.selectAll()

    def refuse(self, sentence: str) -> None:
        """Show an error under the box."""
        mark_wrong(self, True)
        theme = LOOK.theme
        self.wrong.setStyleSheet(
            f"background: {theme.error_ground}; color: {theme.error}; border: 1px solid {theme.error};"
        )
        self.wrong.setText(sentence)
        asked = QtGui.QFontMetrics(LOOK.font()).horizontalAdvance(sentence) + 20
        self.wrong.setFixedWidth(min(asked, round(WIDEST_SENTENCE * LOOK.scale)))
        self.wrong.setMinimumHeight(0)  # what a longer sentence needed
        self.wrong.setFixedHeight(self.wrong.heightForWidth(self.wrong.width()))
        self.wrong.move(self.mapToGlobal(QtCore.QPoint(0, self.height() + 4)))
        self.wrong.setVisible(self.isVisible())
        self._hide_soon.start()

    def forgive(self) -> None:
        """Hide the error."""
        self._hide_soon.stop()
        self.wrong.hide()
        mark_wrong(self, False)

    def give_up(self) -> None:
        """Discard what was typed."""
        self.show_source(self._source, self._count, self._noun)

    def _choose(self) -> None:
        text = self.text().strip()
        if self._source is not None and text == words_of(self._source):
            self.left.emit()  # a curve has no words that could be read
            return
        if re.fullmatch("[0-9]{1,3}(,[0-9]{3})+", text):
            text = text.replace(",", "")
        if not text or (text.isascii() and text.isdigit() and int(text) >= self._count):
            self._refuse(f"No {self._noun} {text[:20] or 'of no id'} here: 0 to {self._count - 1}")
            return
        # The words of a curve, which has a file of its own, mean the one that is there.
        curves = [(words_of(member), member) for member in members_of(self._source) if isinstance(member, Curve)]
        known = {words: curve for words, curve in curves if [each for each, _ in curves].count(words) == 1}
        files: dict[Curve, str] = {}
        try:
            source = source_from_words(text, known, files)
        except ParameterError as error:
            self._refuse(str(error))
            return
        self.chosen.emit(source, files)
        if not self.wrong.isVisible() and not self.property("wrong"):
            self.left.emit()

    def _refuse(self, sentence: str) -> None:
        self.refuse(sentence)
        self.selectAll()

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() != QtCore.Qt.FocusReason.PopupFocusReason:
            self.give_up()


class TypedSource:
    """The source of the first panel, with the `box` in which it is typed."""

    def __init__(self, context: Context) -> None:
        self._context, self.box = context, SourceBox(context.widget)
        context[CurveFiles].taken.connect(self.choose)
        self.box.chosen.connect(self.choose)
        self.box.left.connect(context.focus_panels)

    def choose(self, source: Source, files: Mapping[Curve, str] = EMPTY) -> None:
        """Move the source, or show why that is not possible; `files` are those of its curves."""
        session = self._context.session
        document = session.document
        if session.loaded() is not None and document.panels:
            try:
                source = source_at(source, session.mesh(document.panels[0].id).surface)
            except BihdistError as error:
                self._context.refused.emit(str(error))
                self.box.refuse(str(error))
                return
            self._context[CurveFiles].paths.update(files)
            session.show(move_source(document, document.panels[0].id, source))
            self.show()

    def ask(self) -> None:
        """Give the box the keyboard focus."""
        if self.box.isEnabled():
            self.box.ask()

    def show(self) -> None:
        """Show the source in the box."""
        session = self._context.session
        document = session.document
        point = next((document.point(name) for panel in document.panels for name in panel.shows.points), None)
        loaded = session.loaded() if point is None else session.loaded(point.surface)
        if loaded is None:
            self.box.show_source(None, 0)
        else:
            source = None if point is None else source_at(point.at, loaded.surface)
            self.box.show_source(source, len(loaded.surface.vertices), loaded.surface.nouns[0])
