"""The base of dialogs that have a file drawn in the background."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import ClassVar

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError

from ...document.file_names import file_name
from ...document.page import Recipe
from ...figures.export import Surfaces
from ..context import Context
from ..look.controls import Segments
from ..look.form import Form, closing_buttons, describe, error_label, hairline, in_column, in_row, push_button
from ..look.look import LOOK
from .exports import Exports

WIDTH = 388
"""Width of the form at the usual font size, in logical pixels."""

BESIDE = 316
"""Width of the form beside a picture."""

LARGE = (1140, 780)
"""Size of a dialog with a picture, where there is room."""

LABEL, LABEL_BESIDE = 128, 96
"""Width of labels, and beside a picture."""


@dataclass(frozen=True)
class FileKind:
    """A format: what its usual name ends with, its name on the button, and its words in the file dialog."""

    extension: str
    name: str
    words: str


class WrongBox(BihdistError):
    """An error about the value of one control."""

    def __init__(self, message: str, box: QtWidgets.QWidget) -> None:
        super().__init__(message)
        self.box = box


@contextmanager
def blamed_on(box: QtWidgets.QWidget) -> Iterator[None]:
    """A context whose errors are shown at a control."""
    try:
        yield
    except WrongBox:  # of another one
        raise
    except BihdistError as error:
        raise WrongBox(str(error), box) from error


class JobDialog(QtWidgets.QDialog):
    """A dialog that starts an export; `started` is emitted with the `Export`, then the dialog is closed.

    Errors are shown in the dialog. A subclass for each kind of file adds sections and rows, and makes the work in
    `work(path)`.

    Attributes
    ----------
    what
        What is drawn, such as "Movie".
    file_kinds
        The formats to choose from.
    """

    what: ClassVar[str]
    file_kinds: ClassVar[tuple[FileKind, ...]]

    started = QtCore.Signal(object)

    def __init__(
        self, context: Context, recipe: Recipe, surfaces: Surfaces, side: QtWidgets.QWidget | None = None
    ) -> None:
        """Begin with a recipe on surfaces; `side` stands beside the form."""
        super().__init__(context.widget)
        self.setWindowTitle(f"Export {self.what.lower()}")
        self._recipe, self._surfaces, self._given = recipe, surfaces, context.session.given
        self._name = file_name([each.path for each in recipe.document.surfaces], self.what.lower().split()[-1])
        self._exports, self._side = context[Exports], side
        self._fill()
        self.kinds = Segments({kind.name: kind.name for kind in self.file_kinds}, "The format of the file", self)
        self.kinds.choose(self.file_kinds[0].name)
        self.kinds.setVisible(len(self.file_kinds) > 1)
        self.kinds.chosen.connect(lambda *_: self.form.changed.emit())
        if len(self.file_kinds) > 1:
            self.form.section("Format")
            self.form.add(in_row(self.kinds, *self.beside_kinds(), None, spacing=10))

    def beside_kinds(self) -> list[QtWidgets.QWidget]:
        """Return the widgets beside the formats."""
        return []

    def check(self) -> None:
        """Raise BihdistError, or `WrongBox`, for a wrong value."""
        raise NotImplementedError

    def work(self, path: str) -> Callable[..., object]:
        """Return the function that draws the file at `path`; BihdistError if it cannot be drawn."""
        raise NotImplementedError

    def export(self, path: str) -> None:
        """Have the file drawn and close, or show the error."""
        with self.refusals_shown():
            self.check()
            self.started.emit(self._exports.start(self.work(path), path, self.what))
            self.accept()

    def choose_path(self) -> None:
        """Ask for a path if all values are right."""
        with self.refusals_shown():
            self.check()
            self._ask_path()

    def _ask_path(self) -> None:
        kind = next(kind for kind in self.file_kinds if kind.name == self.kinds.choice())
        ending = kind.extension.rpartition(".")[2]
        files = QtWidgets.QFileDialog(self, self.windowTitle(), self._exports.folder, f"{kind.words} (*.{ending})")
        files.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
        files.setAcceptMode(QtWidgets.QFileDialog.AcceptMode.AcceptSave)
        files.setDefaultSuffix(ending)
        files.selectFile(self._name + kind.extension)
        files.fileSelected.connect(self.export)
        files.open()

    # ------------------------------------------------------------------ what is wrong
    @contextmanager
    def refusals_shown(self) -> Iterator[None]:
        """A context in which errors are shown at the box they are about, or under all boxes."""
        self.refusal.setVisible(False)
        self.form.clear_errors()
        try:
            yield
        except WrongBox as wrong:
            self.form.show_error(wrong.box, str(wrong))
            self._fit()
            self.scroll.ensureWidgetVisible(self.form.errors[wrong.box])
        except BihdistError as error:
            self.refusal.setText(str(error))
            self.refusal.setVisible(True)
            self._fit()

    # ------------------------------------------------------------------ how it is made
    def button(self, text: str, tip: str, do: Callable[..., object] | None = None) -> QtWidgets.QPushButton:
        """Add a button at the foot, before those that close the dialog."""
        button = push_button(text, do)
        describe(button, text, tip)
        self._feet.insertWidget(self._feet.count() - 1, button)
        return button

    def _fill(self) -> None:
        self.form = Form(LABEL if self._side is None else LABEL_BESIDE, margins=(24, 20, 24, 20))
        self.scroll = QtWidgets.QScrollArea(widgetResizable=True)
        self.scroll.setWidget(self.form)
        self.scroll.viewport().setAutoFillBackground(False)
        self.form.setAutoFillBackground(False)
        self.scroll.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.scroll.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        self.refusal = error_label()
        tips = "Choose a file; it is drawn in the background", "Close without exporting (Esc)"
        buttons, self.save, self.cancel = closing_buttons(self, "Export…", *tips)
        buttons.accepted.connect(self.choose_path)
        self._feet = in_row((buttons, 1), spacing=8)
        self._foot = in_column(self.refusal, self._feet, spacing=8, margins=(24, 12, 24, 12))
        body = in_row(self.scroll, (self._side, 1), spacing=0) if self._side is not None else in_row(self.scroll)
        in_column((body, 1), hairline(), self._foot, of=self, spacing=0)

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        if not event.spontaneous():
            self.ensurePolished()
            self._fit()
        super().showEvent(event)

    def _fit(self) -> None:
        """Take the height that the form needs, or scroll it where the screen is too low."""
        narrow = WIDTH if self._side is None else BESIDE
        wide = max(round(narrow * LOOK.scale), self.form.minimumSizeHint().width())
        needed = 1 + _height(self.form.column, wide)
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
        """Return the size of a dialog with a picture, within its window and the screen."""
        over = self.parentWidget().window().size() if self.parentWidget() else screen
        usual = QtCore.QSize(round(LARGE[0] * LOOK.scale), round(LARGE[1] * LOOK.scale))
        return usual.boundedTo(over - QtCore.QSize(40, 40)).boundedTo(screen - QtCore.QSize(20, 60))


def _height(layout: QtWidgets.QLayout, width: int) -> int:
    """Return the height that a layout needs at a width, on which wrapped labels depend."""
    layout.activate()
    return int(layout.totalHeightForWidth(width) if layout.hasHeightForWidth() else layout.totalSizeHint().height())
