"""Messages: dialogs with an error or a question, a choice of files, and a notice above the panels."""

import os
from collections.abc import Callable, Sequence

from qtpy import QtCore, QtGui, QtWidgets

from ..look.controls import lines_of
from ..look.form import in_column, in_row
from ..look.icons import pixmap, put_icon
from ..look.look import LOOK

QUESTION_SIGN = 32
"""Side of the icon in logical pixels."""


# ---------------------------------------------------------------------- a message
class Message(QtWidgets.QDialog):
    """A dialog with a sentence, and details that can be unfolded; both can be selected and copied."""

    def __init__(self, sentence: str, details: str = "", parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Biharmonic distance")
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
        self._whole = f"{sentence}\n\n{details}" if details else sentence
        self.sentence = QtWidgets.QLabel(sentence, wordWrap=True)
        self.sentence.setTextFormat(QtCore.Qt.TextFormat.PlainText)
        flag = QtCore.Qt.TextInteractionFlag
        self.sentence.setTextInteractionFlags(flag.TextSelectableByMouse | flag.TextSelectableByKeyboard)
        self.sentence.setAccessibleName(sentence)
        # Qt would otherwise guess a width, and make long sentences narrow towers.
        self.sentence.setMinimumWidth(min(400, QtGui.QFontMetrics(LOOK.font()).horizontalAdvance(sentence) + 16))
        self.fold = QtWidgets.QPushButton("Show details", objectName="link", visible=bool(details), autoDefault=False)
        self.fold.setToolTip("Show the full report")
        self.fold.clicked.connect(self._unfold)
        self.details = QtWidgets.QPlainTextEdit(
            details, readOnly=True, visible=False, minimumHeight=140, accessibleName="Details"
        )
        self.copy = QtWidgets.QPushButton("Copy", self, autoDefault=False, toolTip="Copy the message to the clipboard")
        self.copy.clicked.connect(self._copy)
        shut = QtWidgets.QPushButton("Close", self, default=True, toolTip="Close this message (Esc)")
        shut.clicked.connect(self.accept)
        shut.setFocus()
        self._sign = QtWidgets.QLabel("")
        self._paint_sign()
        LOOK.changed.connect(self._paint_sign)
        align = QtCore.Qt.AlignmentFlag
        words = in_column(self.sentence, (self.fold, 0, align.AlignLeft), spacing=4)
        top = in_row((self._sign, 0, align.AlignTop), (words, 1), spacing=12)
        buttons = in_row(self.copy, None, shut)
        self._layout = in_column(top, (self.details, 1), 8, buttons, of=self, spacing=8, margins=(24, 20, 24, 16))

    def _paint_sign(self) -> None:
        self._sign.setPixmap(pixmap("warning", LOOK.theme.warning, self.devicePixelRatioF()))

    def _unfold(self) -> None:
        is_open = self.details.isHidden()
        self.details.setVisible(is_open)
        self.fold.setText("Hide details" if is_open else "Show details")
        self._layout.activate()
        wide = max(self.width(), 520) if is_open else self.width()
        self.resize(wide, max(self._layout.heightForWidth(wide), self.minimumSizeHint().height()))

    def _copy(self) -> None:
        QtWidgets.QApplication.clipboard().setText(self._whole)
        self.copy.setText("Copied")


def tell(window: QtWidgets.QWidget | None, sentence: str, details: str = "") -> Message:
    """Show a message without waiting; its parent is the open dialog, if any, so that it gets the keyboard focus."""
    message = Message(sentence, details, QtWidgets.QApplication.activeModalWidget() or window)
    message.open()
    return message


class Question(QtWidgets.QMessageBox):
    """A question with an icon and buttons; `chosen` is the text of the one that was pressed."""

    def __init__(
        self, text: str, buttons: dict[str, QtWidgets.QMessageBox.ButtonRole], parent: QtWidgets.QWidget, sign: str = ""
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Biharmonic distance")
        self.setTextFormat(QtCore.Qt.TextFormat.PlainText)
        self.setText(text)
        colour = LOOK.theme.warning if sign == "warning" else LOOK.theme.accent
        self.setIconPixmap(pixmap(sign or "info", colour, self.devicePixelRatioF(), QUESTION_SIGN))
        self.words = {words: self.addButton(words, role) for words, role in buttons.items()}
        self.setDefaultButton(next(iter(self.words.values())))

    @property
    def chosen(self) -> str:
        """The text of the button that was pressed."""
        return next((words for words, button in self.words.items() if button is self.clickedButton()), "")


# ---------------------------------------------------------------------- which of several
class Which(QtWidgets.QDialog):
    """A dialog in which one of several is chosen: rows of a name, quiet words under it, and a tip.

    `what` is what they are called, and `do` what the button does with the chosen one.
    """

    def __init__(
        self, question: str, rows: Sequence[tuple[str, str, str]], what: str, do: str, parent: QtWidgets.QWidget | None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(f"Choose {what}")
        words = QtWidgets.QLabel(question, wordWrap=True)
        self.list = QtWidgets.QListWidget(accessibleName=question.replace("&", ""))
        self.list.setItemDelegate(_Rows(self.list))
        self.list.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        words.setBuddy(self.list)
        for name, quiet, tip in rows:
            item = QtWidgets.QListWidgetItem(name, self.list)
            item.setData(QtCore.Qt.ItemDataRole.UserRole, quiet)
            item.setToolTip(tip)
            item.setData(QtCore.Qt.ItemDataRole.AccessibleTextRole, f"{name}, {quiet}")
        self.list.setCurrentRow(0)
        self.list.itemDoubleClicked.connect(lambda item: self.accept())
        role = QtWidgets.QDialogButtonBox.ButtonRole
        buttons = QtWidgets.QDialogButtonBox(self)
        choose = buttons.addButton(do, role.AcceptRole)
        choose.setDefault(True)
        choose.setToolTip(f"{do} the selected one (Enter)")
        leave = buttons.addButton("Cancel", role.RejectRole)
        leave.setAutoDefault(False)
        leave.setToolTip("None of them (Esc)")
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        in_column(words, (self.list, 1), buttons, of=self, spacing=12, margins=(24, 20, 24, 16))
        high = min(max(len(rows), 2), 6) * _Rows.HIGH + 2
        self.list.setMinimumHeight(2 * _Rows.HIGH)
        self.resize(460, self.sizeHint().height() - self.list.sizeHint().height() + high)
        self.list.setFocus()

    def ask(self) -> int | None:
        """Wait for the answer, and return the number of the chosen one; None for none."""
        answer = self.list.currentRow() if self.exec() else None
        self.deleteLater()
        return answer


class WhichFile(Which):
    """A dialog in which one of several files is chosen."""

    def __init__(self, paths: Sequence[str], parent: QtWidgets.QWidget | None = None) -> None:
        question = f"{len(paths)} files were dropped. &Which one do you want to open?"
        super().__init__(
            question, [(os.path.basename(path), _folder(path), path) for path in paths], "a file", "Open", parent
        )


class _Rows(QtWidgets.QStyledItemDelegate):
    """Rows with a name and under it quiet words, shortened in the middle, as both ends tell folders apart."""

    HIGH = 46

    def sizeHint(self, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex) -> QtCore.QSize:
        return QtCore.QSize(100, self.HIGH)

    def paint(self, painter: QtGui.QPainter, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex) -> None:
        theme = LOOK.theme
        name, quiet = (index.data(getattr(QtCore.Qt.ItemDataRole, role)) for role in ("DisplayRole", "UserRole"))
        state, middle = QtWidgets.QStyle.StateFlag, QtCore.Qt.TextElideMode.ElideMiddle
        painter.save()
        if option.state & state.State_Selected:
            painter.fillRect(option.rect, QtGui.QColor(theme.selection))
        elif option.state & state.State_MouseOver:
            painter.fillRect(option.rect, QtGui.QColor(theme.hover))
        box = option.rect.adjusted(12, 5, -12, -5)
        for font, colour, words, align in (
            (LOOK.font(), theme.text, name, QtCore.Qt.AlignmentFlag.AlignTop),
            (LOOK.font(12), theme.quiet, quiet, QtCore.Qt.AlignmentFlag.AlignBottom),
        ):
            painter.setFont(font)
            painter.setPen(QtGui.QColor(colour))
            shortened = QtGui.QFontMetrics(font).elidedText(words, middle, box.width())
            painter.drawText(box, align | QtCore.Qt.TextFlag.TextSingleLine, shortened)
        painter.restore()


def from_home(folder: str) -> str:
    """Return a folder with "~" for the home folder."""
    home = os.path.expanduser("~")
    inside = folder == home or folder.startswith(home.rstrip(os.sep) + os.sep)
    return "~" + folder[len(home.rstrip(os.sep)) :] if inside and home != os.sep else folder


def _folder(path: str) -> str:
    return from_home(os.path.dirname(os.path.abspath(path)))


def ask_which(window: QtWidgets.QWidget | None, paths: Sequence[str]) -> str | None:
    """Ask which of several files to open, wait for the answer, and return it; None if none."""
    chosen = WhichFile(paths, window).ask()
    return None if chosen is None else paths[chosen]


# ---------------------------------------------------------------------- a line above the panels
class Notice(QtWidgets.QWidget):
    """A coloured line with a sentence, a button and ✕; hidden while there is nothing to tell."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.kind = "plain"
        self._act: Callable[[], None] | None = None
        self._sign = QtWidgets.QLabel("")
        self.words = _TwoLines(self)
        self.button = QtWidgets.QPushButton(objectName="link", clicked=self._do)
        self.shut = QtWidgets.QToolButton(toolTip="Close this message", accessibleName="Close this message")
        self.shut.setIconSize(QtCore.QSize(14, 14))
        self.shut.clicked.connect(self.clear)
        put_icon(self.shut, "close")
        self._soon = QtCore.QTimer(self, singleShot=True, timeout=self.clear)
        in_row(self._sign, (self.words, 1), self.button, self.shut, of=self, spacing=8, margins=(12, 6, 8, 6))
        policy = QtWidgets.QSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        LOOK.changed.connect(self._paint)
        self.setVisible(False)

    def show_text(
        self,
        text: str,
        kind: str = "plain",
        action: tuple[str, Callable[[], None]] | None = None,
        seconds: float = 0,
    ) -> None:
        """Show a text as "plain", "warning" or "error", with a button, for some seconds or until it is closed."""
        self.kind = kind
        self._soon.stop()
        self.words.setText(text)
        self.button.setVisible(action is not None)
        self.button.setText(action[0] if action else "")
        self._act = action[1] if action else None
        self._sign.setVisible(kind != "plain")
        self._paint()
        self.setVisible(bool(text))
        if text and seconds:
            self._soon.start(round(1000 * seconds))

    def clear(self) -> None:
        """Hide the notice."""
        self.show_text("")

    def _do(self) -> None:
        act = self._act
        self.clear()  # first: what it does may have something to say
        if act:
            act()

    @property
    def colours(self) -> tuple[str, str]:
        """The colours of the background and the text."""
        theme = LOOK.theme
        return {
            "warning": (theme.warning_ground, theme.warning),
            "error": (theme.error_ground, theme.error),
        }.get(self.kind, (theme.hover, theme.text))

    def _paint(self) -> None:
        colour = self.colours[1]
        self._sign.setPixmap(pixmap("warning", colour, self.devicePixelRatioF()))
        self.words.colour = colour
        self.words.updateGeometry()
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.fillRect(self.rect(), QtGui.QColor(self.colours[0]))
        line = QtCore.QRect(0, self.height() - 1, self.width(), 1)
        painter.fillRect(line, QtGui.QColor(LOOK.theme.border))


class _TwoLines(QtWidgets.QWidget):
    """A text on one or two lines; if it is cut short the whole text is in the tooltip."""

    MOST = 2

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._text, self.colour = "", LOOK.theme.text
        policy = QtWidgets.QSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)

    def text(self) -> str:
        return self._text

    def setText(self, text: str) -> None:
        self._text = " ".join(text.split())
        self.setAccessibleName(self._text)
        self._note_width()
        self.updateGeometry()
        self.update()

    def lines(self, width: int) -> list[str]:
        """Return the lines at a width in logical pixels."""
        font, metrics = LOOK.font(), QtGui.QFontMetrics(LOOK.font())
        found = lines_of(self._text, font, max(width, 1), self.MOST, QtGui.QTextOption.WrapMode.WordWrap)
        return [metrics.elidedText(line, QtCore.Qt.TextElideMode.ElideRight, max(width, 1)) for line in found]

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(200, self.heightForWidth(max(self.width(), 200)))

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(40, QtGui.QFontMetrics(LOOK.font()).height())

    def hasHeightForWidth(self) -> bool:
        return True

    def heightForWidth(self, width: int) -> int:
        return int(max(len(self.lines(width)), 1) * QtGui.QFontMetrics(LOOK.font()).lineSpacing() + 2)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._note_width()

    def _note_width(self) -> None:
        whole = "".join(self.lines(self.width()))
        self.setToolTip(self._text if "…" in whole and whole != self._text else "")

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, step = QtGui.QPainter(self), QtGui.QFontMetrics(LOOK.font()).lineSpacing()
        painter.setFont(LOOK.font())
        painter.setPen(QtGui.QColor(self.colour))
        lines = self.lines(self.width())
        top = (self.height() - len(lines) * step) // 2
        for number, line in enumerate(lines):
            box = QtCore.QRect(0, top + number * step, self.width(), step)
            painter.drawText(box, QtCore.Qt.AlignmentFlag.AlignVCenter | QtCore.Qt.TextFlag.TextSingleLine, line)
