"""The dialog of File > Repair mesh > Merge vertices: a tolerance, and how many vertices it merges."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import MeshError, Surface
from bihdist_core.coincident_points import least_apart
from bihdist_core.counts import counted
from bihdist_core.progress import Progress
from bihdist_core.scalars import with_decimal_point

from ...drawing.numbers import number
from ..background import Background
from ..look.form import Form, closing_buttons
from ..look.layouts import in_column, in_row, quiet_label
from ..look.look import LOOK
from ..look.text_box import TextBox, mark_wrong

WIDTH = 470
"""Width of the text, in logical pixels."""
LABEL_WIDTH = 72
"""Width of the label at the usual font size, in logical pixels: wide enough for its access key's underline."""
USUAL_FRACTION = 1e-6
"""Fraction of the extent that single precision tells apart."""
COUNT_MS = 150
"""Time from the last key to the count."""
EXPLANATION = (
    "Vertices within the tolerance become one, at the position of that with the least id. Faces that lose a corner are "
    "dropped, and vertices are renumbered."
)


@dataclass(frozen=True, eq=False)
class MergeCount:
    """A request for the number of vertices that a tolerance merges; `surface()` reads the mesh."""

    surface: Callable[[], Surface]
    tolerance: float


def merge_in_words(question: MergeCount, progress: Progress) -> Iterator[tuple[bool, str]]:
    """Yield whether vertices of the surface would be merged, with a sentence."""
    surface = question.surface()
    try:
        merged, _ = surface.merged(question.tolerance)
    except MeshError:
        yield False, f"No face would be left with a tolerance of {question.tolerance:g}."
        return
    n, gone = surface.n_vertices, surface.n_vertices - merged.n_vertices
    if gone:
        dropped = surface.n_faces - merged.n_faces
        with_faces = f", with {counted(dropped, 'face')}" if dropped else ", and no face"
        yield True, f"{gone:,} of {n:,} vertices would be removed{with_faces}."
        return
    yield False, f"No two vertices are that close; the closest are {number(least_apart(surface.vertices))} apart."


class MergeDialog(QtWidgets.QDialog):
    """A dialog that asks for the tolerance of a merge; `chosen` is emitted with it, in mesh units.

    Parameters
    ----------
    extent
        The length of the diagonal of the mesh.
    surface
        Reads the mesh as it is before it is merged.
    tolerance
        The tolerance to start from; None for the usual one.
    """

    chosen = QtCore.Signal(float)

    def __init__(
        self,
        name: str,
        extent: float,
        surface: Callable[[], Surface],
        tolerance: float | None,
        background: Background,
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(f"Merge vertices of {name}")
        self._surface, self._background = surface, background
        about = QtWidgets.QLabel(EXPLANATION, wordWrap=True)
        about.setFixedWidth(WIDTH)
        self.box = TextBox(f"{usual_tolerance(extent) if tolerance is None else tolerance:g}")
        self.box.setFixedWidth(110)
        self.count = quiet_label("")
        self.count.setFixedWidth(WIDTH)
        self.count.setWordWrap(True)
        self.count.setMinimumHeight(2 * QtGui.QFontMetrics(LOOK.font()).lineSpacing() + 2)
        self.count.setAlignment(QtCore.Qt.AlignmentFlag.AlignLeft | QtCore.Qt.AlignmentFlag.AlignTop)
        form = Form(LABEL_WIDTH, spacing=14, margins=(24, 22, 24, 14))
        form.add(about)
        tip = "A length in mesh units; 0 merges only identical positions"
        form.row("&Tolerance", self.box, tip, unit=f"mesh units; the mesh is {number(extent)} across")
        form.add(self.count)
        column = in_column(form, self._footer(), of=self, spacing=0)
        column.setSizeConstraint(QtWidgets.QLayout.SizeConstraint.SetFixedSize)
        self._soon = QtCore.QTimer(self, singleShot=True, interval=COUNT_MS, timeout=self._ask)
        self.box.textEdited.connect(self._edited)
        background.answered.connect(self._answered)
        background.failed.connect(self._failed)
        self.finished.connect(self._end)
        LOOK.apply_theme(self)
        self.box.selectAll()
        self._ask()

    @property
    def tolerance(self) -> float | None:
        """The tolerance that is typed; None where it is not a length."""
        try:
            value = float(with_decimal_point(self.box.text()))
        except ValueError:
            return None
        return value if math.isfinite(value) and value >= 0 else None

    def accept(self) -> None:
        """Merge, if it is known that there is something to merge."""
        tolerance = self.tolerance
        if tolerance is not None and self.merge.isEnabled():
            super().accept()
            self.chosen.emit(tolerance)

    def _footer(self) -> QtWidgets.QWidget:
        footer = QtWidgets.QFrame(objectName="footer")
        tips = "Merge them; Undo reverts it", "Close without merging (Esc)"
        buttons, self.merge, _ = closing_buttons(self, "&Merge", *tips)
        self.merge.setEnabled(False)
        buttons.accepted.connect(self.accept)
        in_row((buttons, 1), of=footer, spacing=8, margins=(22, 12, 24, 12))
        return footer

    def _edited(self) -> None:
        self.merge.setEnabled(False)
        self._soon.start()

    def _ask(self) -> None:
        tolerance = self.tolerance
        mark_wrong(self.box, tolerance is None)
        if tolerance is None:
            self._background.ask(None)
            self.count.setText(f"{self.box.text().strip()!r} is not a length of 0 or more.")
            return
        self.count.setText("Counting…")
        self._background.ask(MergeCount(self._surface, tolerance))

    def _answered(self, question: object, answer: tuple[bool, str]) -> None:
        is_any, words = answer
        self.count.setText(words)
        self.merge.setEnabled(is_any)

    def _failed(self, question: object, sentence: str) -> None:
        self.count.setText(sentence)

    def _end(self) -> None:
        self._soon.stop()
        self._background.ask(None)
        self._background.answered.disconnect(self._answered)
        self._background.failed.disconnect(self._failed)


def usual_tolerance(extent: float) -> float:
    """Return the power of ten that is a millionth of the extent or less."""
    return 10.0 ** math.floor(math.log10(USUAL_FRACTION * extent)) if extent > 0 else 0.0
