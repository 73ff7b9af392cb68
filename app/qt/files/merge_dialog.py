"""The dialog of File > Merge vertices: a tolerance, and how many vertices would be left."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import MeshError, Surface
from bihdist_core.coincident_points import least_apart
from bihdist_core.counts import counted
from bihdist_core.progress import Progress

from ..background import Background
from ..look.layouts import in_column, in_row, quiet_label
from ..look.look import LOOK
from ..look.numbers import MINUS, number
from ..look.text_box import TextBox, mark_wrong

WIDTH = 470
"""Of its words, in logical pixels."""
USUAL = 1e-6
"""Of the extent: what single precision tells apart."""
SOON_MS = 150
"""From the last key to the count."""
WHAT = (
    "Vertices that are no farther apart become one, at the place of that with the least id; faces that lose a corner "
    "are dropped. Vertices are then numbered anew."
)


@dataclass(frozen=True, eq=False)
class MergeCount:
    """What a tolerance asks of a surface; surface(): reads it."""

    surface: Callable[[], Surface]
    tolerance: float


def merge_in_words(question: MergeCount, progress: Progress) -> Iterator[tuple[bool, str]]:
    """Whether vertices of the surface would be merged, and how many, in words."""
    surface = question.surface()
    try:
        merged, _ = surface.merged(question.tolerance)
    except MeshError:
        yield False, f"No face would be left within {question.tolerance:g}."
        return
    n, gone = surface.n_vertices, surface.n_vertices - merged.n_vertices
    if gone:
        dropped = surface.n_faces - merged.n_faces
        with_faces = f", with {counted(dropped, 'face')}" if dropped else ", and no face"
        yield True, f"{gone:,} of {n:,} vertices would go{with_faces}."
        return
    yield False, f"No two vertices are so near; the nearest are {number(least_apart(surface.vertices))} apart."


class MergeDialog(QtWidgets.QDialog):
    """`chosen` is emitted with the tolerance, in mesh units.

    extent: the length of the diagonal of the mesh; surface(): reads it as it is before it is merged; tolerance: to
    start from, None for the usual.
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
        about = QtWidgets.QLabel(WHAT, wordWrap=True)
        about.setFixedWidth(WIDTH)
        self.box = TextBox(f"{usual_tolerance(extent) if tolerance is None else tolerance:g}")
        self.box.setFixedWidth(110)
        self.box.setToolTip("A length in mesh units; 0 for what is exactly in one place")
        self.box.setAccessibleName("Tolerance")
        label = QtWidgets.QLabel("&Tolerance")
        label.setBuddy(self.box)
        label.setMinimumWidth(QtGui.QFontMetrics(LOOK.font()).horizontalAdvance("Tolerance") + 4)
        units = quiet_label(f"mesh units; the mesh is {number(extent)} across")
        self.count = quiet_label("")
        self.count.setFixedWidth(WIDTH)
        self.count.setWordWrap(True)
        self.count.setMinimumHeight(2 * QtGui.QFontMetrics(LOOK.font()).lineSpacing() + 2)
        self.count.setAlignment(QtCore.Qt.AlignmentFlag.AlignLeft | QtCore.Qt.AlignmentFlag.AlignTop)
        row = in_row(label, self.box, units, None, spacing=10)
        words = in_column(about, row, self.count, spacing=14, margins=(24, 22, 24, 14))
        column = in_column(words, self._footer(), of=self, spacing=0)
        column.setSizeConstraint(QtWidgets.QLayout.SizeConstraint.SetFixedSize)
        self._soon = QtCore.QTimer(self, singleShot=True, interval=SOON_MS, timeout=self._ask)
        self.box.textEdited.connect(self._edited)
        background.answered.connect(self._answered)
        background.failed.connect(self._failed)
        self.finished.connect(self._end)
        LOOK.apply_theme(self)
        self.box.selectAll()
        self._ask()

    @property
    def tolerance(self) -> float | None:
        """What is typed; None where that is no length."""
        try:
            value = float(self.box.text().strip().replace(MINUS, "-"))
        except ValueError:
            return None
        return value if math.isfinite(value) and value >= 0 else None

    def accept(self) -> None:
        """Merge, where it is known that there is something to merge."""
        tolerance = self.tolerance
        if tolerance is not None and self.merge.isEnabled():
            super().accept()
            self.chosen.emit(tolerance)

    def _footer(self) -> QtWidgets.QWidget:
        footer, role = QtWidgets.QFrame(objectName="footer"), QtWidgets.QDialogButtonBox.ButtonRole
        buttons = QtWidgets.QDialogButtonBox(self)  # which a default button must know of
        self.merge = buttons.addButton("&Merge", role.AcceptRole)
        self.merge.setDefault(True)
        self.merge.setEnabled(False)
        self.merge.setToolTip("Merge them; Undo takes it back")
        cancel = buttons.addButton("Cancel", role.RejectRole)
        cancel.setAutoDefault(False)
        cancel.setToolTip("All stays as it is (Esc)")
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
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
            self.count.setText(f"{self.box.text().strip()!r} is not a length, a number from 0.")
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
    """A power of ten, a millionth of the extent or less."""
    return 10.0 ** math.floor(math.log10(USUAL * extent)) if extent > 0 else 0.0
