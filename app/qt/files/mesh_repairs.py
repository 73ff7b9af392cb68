"""Cutting an open mesh by a mask, merging its vertices by a dialog, and undoing both, as steps of the history."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import MeshError, Surface
from bihdist_core.arrays import IntArray
from bihdist_core.coincident_points import least_apart
from bihdist_core.counts import counted
from bihdist_core.progress import Progress
from bihdist_core.scalars import with_decimal_point

from ...document.derived_surfaces import changed_mesh
from ...document.document import Document, MeshFile
from ...document.file_names import file_name
from ...document.repairs import with_repairs, without_repairs
from ...drawing.numbers import number
from ...session.loaded_mesh import unmerged
from ...session.repaired_surface import write_ids
from ..background import Background
from ..context import Context
from ..look.controls import TextBox, mark_wrong
from ..look.form import Form, closing_buttons, in_column, in_row, quiet_label
from ..look.look import LOOK
from .saving import Writing, ask_file

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


MASKS = "Masks, 1 for each vertex to keep (*.npy *.txt *.gii *.gii.gz *.annot *.label lh.* rh.*);;All files (*)"


class MeshRepairs(QtCore.QObject):
    """Repairs of the mesh that the active panel shows."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._counting = context.background("merging", merge_in_words)
        context.document_changed.connect(self._tell_merged)

    @property
    def _mesh(self) -> MeshFile:
        """The mesh, or the original where the panel shows one made from it."""
        document, active = self._context.document, self._context.active
        shown = document.mesh(document.panel(active.id).surface if active else document.surfaces[0].name)
        which = shown.path, shown.sha256
        if shown.change is None:
            return shown
        return next(mesh for mesh in document.surfaces if mesh.change is None and (mesh.path, mesh.sha256) == which)

    # ------------------------------------------------------------------ cutting
    def choose_cut(self) -> None:
        """Ask for a mask, and cut the mesh by it."""
        ask_file(self._context, f"Cut {self._name(self._mesh)} by a mask", MASKS, self.cut)

    def cut(self, path: str) -> None:
        """Cut the mesh by a mask, or tell why that is not possible."""
        surface = self._mesh.name
        self._context.session.apply(lambda document: with_repairs(document, surface, cut=path))

    # ------------------------------------------------------------------ merging
    def ask_merge(self) -> None:
        """Ask for a tolerance, and merge the vertices within it."""
        context, mesh = self._context, self._mesh
        loaded = context.session.loaded(mesh.name)
        if loaded is None or self._is_refused():
            return
        corners = loaded.surface.bounds
        extent = float(np.linalg.norm(corners[1] - corners[0]))
        tolerance = mesh.repairs.merge
        # That of the file is read again only where vertices have been merged before.
        found: list[Surface] = [loaded.surface] if tolerance is None else []

        def surface() -> Surface:
            if not found:
                found.append(unmerged(mesh, context.session.given))
            return found[0]

        dialog = MergeDialog(self._name(mesh), extent, surface, tolerance, self._counting, context.widget)
        dialog.chosen.connect(partial(self.merge, mesh.name))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def merge(self, surface: str, tolerance: float) -> None:
        """Merge the vertices of a surface within a tolerance."""
        self._context.session.apply(lambda document: with_repairs(document, surface, merge=tolerance))

    def save_ids(self, path: str = "") -> None:
        """Write the new id of each vertex of the file; asks for a path if none is given."""
        mesh = self._mesh
        ids = self._ids(mesh)
        if ids is None:
            self._context.tell("No vertices of this mesh have been merged.")
            return
        name = file_name([mesh.path or mesh.name], "ids")
        self._context[Writing].save("Save vertex id table", name, (".csv",), partial(write_ids, ids=ids), path)

    def _name(self, mesh: MeshFile) -> str:
        """Return the name of a mesh for the user."""
        loaded = self._context.session.loaded(mesh.name)
        return mesh.name if loaded is None else loaded.surface.name

    def _ids(self, mesh: MeshFile) -> IntArray | None:
        loaded = self._context.session.loaded(mesh.name)
        return None if loaded is None else loaded.new_ids

    def _is_refused(self) -> bool:
        """Tell the user of a mesh made from this one, whose ids would change, and return whether there is one."""
        made = changed_mesh(self._context.document)
        if made is not None:
            self._context.fail(
                f"{self._name(made)} has a perturbed copy with the same vertex ids; "
                "remove it first (Tools > Robustness)."
            )
        return made is not None

    def _tell_merged(self, before: Document) -> None:
        """Tell how many vertices were merged, once they are."""
        context = self._context
        merges = {mesh.name: mesh.repairs.merge for mesh in before.surfaces if mesh.change is None}
        for mesh in context.document.surfaces:
            ids = self._ids(mesh) if mesh.name in merges and merges[mesh.name] != mesh.repairs.merge else None
            if ids is not None:
                left = int(ids.max()) + 1
                gone = counted(len(ids) - left, "vertex", "vertices")
                where = "File > Repair mesh > Save vertex id table… saves the old and new ids"
                context.tell(f"{gone} merged, {left:,} left; {where}", partial(self._has, mesh))

    def _has(self, mesh: MeshFile) -> bool:
        return mesh in self._context.document.surfaces

    # ------------------------------------------------------------------ components
    def keep_largest_component(self) -> None:
        """Keep only the component with most vertices."""
        surface = self._mesh.name
        self._context.session.apply(lambda document: with_repairs(document, surface, largest_component=True))

    # ------------------------------------------------------------------ the operator
    @property
    def operator(self) -> str:
        """The operator of the mesh, "" without a mesh."""
        return self._mesh.repairs.operator if self._context.document.surfaces else ""

    def choose_operator(self, word: str) -> None:
        """Let distances on the mesh be by another operator."""
        surface = self._mesh.name
        self._context.session.apply(lambda document: with_repairs(document, surface, operator=word))

    # ------------------------------------------------------------------ putting back
    def put_back(self) -> None:
        """Restore the mesh of the file, without repairs."""
        mesh = self._mesh
        if not mesh.repairs.is_any:
            self._context.tell("This mesh has not been cut or merged.")
        elif mesh.repairs.merge is None or not self._is_refused():
            self._context.session.apply(lambda document: without_repairs(document, mesh.name))
