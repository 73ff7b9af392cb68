"""A dialog that asks how a file shall be, closes, and has the file drawn in the background."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import ClassVar

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError

from ..look.layouts import in_column, in_row
from ..look.look import LOOK
from ..look.segments import Segments
from ..look.text_box import mark_wrong
from .exports import Exports

WIDTH = 388
"""Of the column of choices, at the usual size of letters, in logical pixels."""

BESIDE = 316
"""The same beside a picture."""

LARGE = (1140, 780)
"""Of a dialog with a picture in it, where there is room."""

LABEL, LABEL_BESIDE = 116, 96
"""Of the words before a box."""


@dataclass(frozen=True)
class FileKind:
    """extension: with its dot; name: on the button; words: in the file dialog."""

    extension: str
    name: str
    words: str


class WrongBox(BihdistError):
    """What stands in a box makes no sense; the message says why."""

    def __init__(self, message: str, box: QtWidgets.QWidget) -> None:
        super().__init__(message)
        self.box = box


@contextmanager
def blamed_on(box: QtWidgets.QWidget) -> Iterator[None]:
    """What is refused inside is the fault of what stands in the box."""
    try:
        yield
    except WrongBox:  # of another one
        raise
    except BihdistError as error:
        raise WrongBox(str(error), box) from error


class JobDialog(QtWidgets.QDialog):
    """`started` is emitted with the `Export`; then the dialog is closed.  What is refused is said in the dialog.

    A class of its own for each sort of file adds sections and rows, and makes the work in `work(path)`.  what: it
    draws, "Movie"; file_kinds: the formats that there are.
    """

    what: ClassVar[str]
    file_kinds: ClassVar[tuple[FileKind, ...]]

    started = QtCore.Signal(object)

    def __init__(
        self,
        name: str,
        exports: Exports,
        parent: QtWidgets.QWidget | None = None,
        side: QtWidgets.QWidget | None = None,
    ) -> None:
        """name: of the file, as a proposal and without an extension; side: what stands beside the choices."""
        super().__init__(parent)
        self.setWindowTitle(f"Export {self.what.lower()}")
        self._name, self._exports = name, exports
        self._sentences: dict[QtWidgets.QWidget, QtWidgets.QLabel] = {}
        self._side = side
        self._fill()
        self.kinds = Segments({kind.name: kind.name for kind in self.file_kinds}, "The format of the file", self)
        self.kinds.choose(self.file_kinds[0].name)
        self.kinds.setVisible(len(self.file_kinds) > 1)
        if len(self.file_kinds) > 1:
            self.section("Format")
            self.column.addWidget(self.kinds, 0, QtCore.Qt.AlignmentFlag.AlignLeft)

    def check(self) -> None:
        """BihdistError, or `WrongBox`, for what stands in the dialog and makes no sense."""
        raise NotImplementedError

    def work(self, path: str) -> Callable[..., object]:
        """What draws the file at `path`; BihdistError if it cannot be."""
        raise NotImplementedError

    def export(self, path: str) -> None:
        """Have it drawn to a path, and close; what is refused is said here instead."""
        with self.refusals_shown():
            self.check()
            self.started.emit(self._exports.start(self.work(path), path, self.what))
            self.accept()

    def choose_path(self) -> None:
        """Ask where to, if all in the dialog makes sense."""
        with self.refusals_shown():
            self.check()
            self._ask_path()

    def _ask_path(self) -> None:
        kind = next(kind for kind in self.file_kinds if kind.name == self.kinds.choice())
        files = QtWidgets.QFileDialog(
            self, self.windowTitle(), self._exports.folder, f"{kind.words} (*{kind.extension})"
        )
        files.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
        files.setAcceptMode(QtWidgets.QFileDialog.AcceptMode.AcceptSave)
        files.setDefaultSuffix(kind.extension.removeprefix("."))
        files.selectFile(self._name + kind.extension)
        files.fileSelected.connect(self.export)
        files.open()

    # ------------------------------------------------------------------ what is wrong
    @contextmanager
    def refusals_shown(self) -> Iterator[None]:
        """A context in which errors are shown at the box they are about, or under all boxes."""
        self._forget_wrong()
        try:
            yield
        except WrongBox as wrong:
            self._show_wrong(wrong.box, str(wrong))
        except BihdistError as error:
            self._show(self.refusal, str(error))

    def _show_wrong(self, box: QtWidgets.QWidget, sentence: str) -> None:
        self._show(self._sentences[box], sentence)
        mark_wrong(box, True)
        box.setAccessibleDescription(sentence)
        box.setFocus()
        self.scroll.ensureWidgetVisible(self._sentences[box])

    def _show(self, label: QtWidgets.QLabel, sentence: str) -> None:
        label.setText(sentence)
        label.setVisible(True)
        self._fit()

    def _forget_wrong(self) -> None:
        self.refusal.setVisible(False)
        for box, sentence in self._sentences.items():
            if not sentence.isHidden():
                sentence.setVisible(False)
                box.setAccessibleDescription("")
                mark_wrong(box, False)

    # ------------------------------------------------------------------ how it is made
    def section(self, title: str) -> None:
        """A title; what is added next stands under it."""
        label = QtWidgets.QLabel(title)
        label.setProperty("heading", True)
        if self.column.count():
            self.column.addSpacing(12)
        self.column.addWidget(label)

    def row(self, label: str, box: QtWidgets.QWidget, tip: str) -> None:
        """A box with words before it, and a place for what is wrong under it; label: with its access key."""
        words = QtWidgets.QLabel(label, toolTip=tip)
        words.setBuddy(box)
        words.setMinimumWidth(round((LABEL if self._side is None else LABEL_BESIDE) * LOOK.scale))
        self.name_box(box, label, tip)
        self.column.addLayout(in_row(words, (box, 1)))
        self.room_for_wrong(box)

    def tick(self, words: str, is_on: bool, tip: str) -> QtWidgets.QCheckBox:
        """Add a box that can be ticked."""
        box = QtWidgets.QCheckBox(words, checked=is_on)
        self.name_box(box, words, tip)
        self.column.addWidget(box)
        return box

    def button(self, words: str, tip: str) -> QtWidgets.QPushButton:
        """One more at the foot, before those that close the dialog."""
        button = QtWidgets.QPushButton(words, autoDefault=False)
        self.name_box(button, words, tip)
        self._feet.insertWidget(self._feet.count() - 1, button)
        return button

    def room_for_wrong(self, box: QtWidgets.QWidget) -> None:
        """Where the sentence stands if what is in the box makes no sense."""
        self._sentences[box] = _sentence()
        self.column.addWidget(self._sentences[box])

    @staticmethod
    def name_box(box: QtWidgets.QWidget, name: str, tip: str) -> None:
        """Say what a box is for; name: with or without its access key."""
        box.setAccessibleName(name.replace("&", ""))
        box.setToolTip(tip)

    def _fill(self) -> None:
        choices = QtWidgets.QWidget()
        self.column = in_column(of=choices, spacing=8, margins=(24, 20, 24, 20))
        self.scroll = QtWidgets.QScrollArea(widgetResizable=True)
        self.scroll.setWidget(choices)
        self.scroll.viewport().setAutoFillBackground(False)
        choices.setAutoFillBackground(False)
        self.scroll.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.scroll.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        self.refusal = _sentence()
        role = QtWidgets.QDialogButtonBox.ButtonRole
        buttons = QtWidgets.QDialogButtonBox(self)  # which a default button must know of
        self.save = buttons.addButton("Export…", role.AcceptRole)
        self.save.setDefault(True)
        self.save.setToolTip("Choose where the file goes; it is drawn in the background")
        self.cancel = buttons.addButton("Cancel", role.RejectRole)
        self.cancel.setAutoDefault(False)
        self.cancel.setToolTip("Close without a file (Esc)")
        buttons.accepted.connect(self.choose_path)
        buttons.rejected.connect(self.reject)
        self._feet = in_row((buttons, 1), spacing=8)
        self._foot = in_column(self.refusal, self._feet, spacing=8, margins=(24, 12, 24, 12))
        body = in_row(self.scroll, (self._side, 1), spacing=0) if self._side is not None else in_row(self.scroll)
        in_column((body, 1), QtWidgets.QFrame(objectName="hairline"), self._foot, of=self, spacing=0)

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        if not event.spontaneous():
            self.ensurePolished()
            self._fit()
        super().showEvent(event)

    def _fit(self) -> None:
        """As high as all choices need, where the screen is; the rest is scrolled to."""
        choices = self.scroll.widget()
        narrow = WIDTH if self._side is None else BESIDE
        wide = max(round(narrow * LOOK.scale), choices.minimumSizeHint().width())
        needed = 1 + _height(self.column, wide)
        screen = self.screen().availableGeometry()
        foot = _height(self._foot, max(self.width(), wide))
        most = screen.height() - 60 - foot
        bar = 0 if needed <= most else self.scroll.verticalScrollBar().sizeHint().width()
        if self._side is None:
            self.setMinimumWidth(wide + bar)
            self.resize(max(self.width(), wide + bar), min(max(self.height(), needed + foot), most + foot))
        else:
            self.scroll.setFixedWidth(wide + self.scroll.verticalScrollBar().sizeHint().width())
            if not self.testAttribute(QtCore.Qt.WidgetAttribute.WA_Resized):
                self.resize(self._beside(screen.size()))

    def _beside(self, screen: QtCore.QSize) -> QtCore.QSize:
        """As large as the window that it stands over leaves it, with a picture beside the choices."""
        over = self.parentWidget().window().size() if self.parentWidget() else screen
        usual = QtCore.QSize(round(LARGE[0] * LOOK.scale), round(LARGE[1] * LOOK.scale))
        return usual.boundedTo(over - QtCore.QSize(40, 40)).boundedTo(screen - QtCore.QSize(20, 60))


class Choice(QtWidgets.QComboBox):
    """A list of texts by the words they stand for; it does not insist on the width of its longest entry."""

    def __init__(self, texts: Mapping[str, str], now: str) -> None:
        super().__init__()
        for word, text in texts.items():
            self.addItem(text, word)
        self.setCurrentIndex(max(self.findData(now), 0))
        self.setSizeAdjustPolicy(QtWidgets.QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(12)


class Count(QtWidgets.QSpinBox):
    """A whole number, written or changed with the arrow keys."""

    def __init__(self, least: int, most: int, value: int, suffix: str = "", nothing: str = "") -> None:
        """nothing: what is said instead of the least number."""
        super().__init__(minimum=least, maximum=most, value=value, suffix=suffix, specialValueText=nothing)
        self.setButtonSymbols(QtWidgets.QAbstractSpinBox.ButtonSymbols.NoButtons)


def _height(layout: QtWidgets.QLayout, width: int) -> int:
    """What it needs at a width; sentences of several lines depend on it."""
    layout.activate()
    return int(layout.totalHeightForWidth(width) if layout.hasHeightForWidth() else layout.totalSizeHint().height())


def _sentence() -> QtWidgets.QLabel:
    label = QtWidgets.QLabel("", wordWrap=True, visible=False)
    label.setTextFormat(QtCore.Qt.TextFormat.PlainText)
    label.setTextInteractionFlags(QtCore.Qt.TextInteractionFlag.TextSelectableByMouse)
    label.setProperty("error", True)
    return label
