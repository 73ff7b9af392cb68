"""The dock of robustness: changes to the mesh, and how far each distance changes with it."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.applications.changes import Perturbation, count_of
from bihdist_core.arrays import IntArray
from bihdist_core.counts import counted
from bihdist_core.formats.mesh_output import MESH_FORMATS, write_mesh

from ...document.derived_surfaces import changed_mesh, without_changed
from ...document.document import Document
from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.docks.brushing import RADII, Brushing
from ...qt.docks.dock import PAD
from ...qt.docks.instrument import Instrument
from ...qt.docks.plain import fill
from ...qt.files.saving import MESH_FILES, save
from ...qt.look.segments import Segments
from ...qt.panels.flat_button import FlatButton
from ...session.loaded_mesh import LoadedMesh
from .comparison import refuse_change
from .confirmation import ChangeAsking
from .cuts import cut_by
from .gestures import ChangeGestures
from .rows import AmountRow, ChosenRow, Scale, label, quiet
from .table import ChangeTable

HINT = "Made together, from the mesh as it was."
BEGIN = "Change the mesh, and each distance is shown before and after, with the difference."
"""What the dock says at first."""

MOST_SEEDS = 999_999
FEWEST = 50
"""The simplest mesh that the slider makes has one of so many vertices."""

NOISE = Scale(0.0, 4.0, 2.0, 2)
HOLES = Scale(0, 20)
RADIUS = Scale(0.01, 0.25, 1.5, 3)


class RobustnessDock(Instrument):
    """See the module.  `settings`: what is set, also of changes that are not made."""

    word, title = "robustness", "Robustness"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.settings = Perturbation()
        self.asking = ChangeAsking(context)
        self.asking.lost.connect(self._show_again)
        self._brushing, self._picking = context[Brushing], context[ChangeGestures]
        self.noise = AmountRow(
            "Amount", "Noise, in mean edge lengths", "edges", NOISE, lambda v: v >= 0, "A number from 0"
        )
        self.along = Segments({"x, y, z": "xyz", "Normals": "normals"}, "Noise along")
        self.seed = QtWidgets.QSpinBox()
        self.seed.setRange(0, MOST_SEEDS)
        self.seed.setAccessibleName("Seed of noise and holes")
        self.seed.setToolTip("Equal seeds make equal noise and holes")
        self.seed.setKeyboardTracking(False)
        self.another = QtWidgets.QPushButton("Another seed", autoDefault=False)
        self.vertices = AmountRow("Vertices", "Vertices that stay", "", NOISE, _is_count, "A whole number from 4")
        self.holes = AmountRow("Random", "Holes at random vertices", "holes", HOLES, _is_number, "A whole number")
        self.radius = AmountRow(
            "Radius",
            "Radius of holes, in roots of the area",
            "√area",
            RADIUS,
            _is_radius,
            "A number from 0 to 1",
        )
        tip = "Paint over the surface before the change: these faces go; with Ctrl they come back"
        self.cut = ChosenRow("By brush", "Cut out", tip, is_check=True)
        self.brush_size = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal)
        self.brush_size.setRange(*RADII)
        self.brush_size.setToolTip("Size of the brush")
        self.brush_size.setAccessibleName("Size of the brush")
        self.weld = ChosenRow("Weld", "Pick two", "Let the surface grow together at two places", is_check=True)
        self.handle = ChosenRow("Handle", "Pick two", "A thin tube from one place to another", is_check=True)
        self.pose = ChosenRow("Pose", "Open…", "Another pose from a file with the same vertices and faces")
        self.table = ChangeTable(context)
        self.save_button = QtWidgets.QPushButton("Save changed mesh…", autoDefault=False)
        self.remove_button = QtWidgets.QPushButton("Remove change", autoDefault=False)
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        inside = QtWidgets.QWidget()
        column = QtWidgets.QVBoxLayout(inside)
        column.setContentsMargins(PAD, 8, PAD, PAD)
        column.setSpacing(8)
        self.hint = quiet(BEGIN)
        self.hint.setWordWrap(True)
        column.addWidget(self.hint)
        self._controls = QtWidgets.QWidget()
        column.addWidget(self._controls)
        column.addStretch(1)
        rows = QtWidgets.QVBoxLayout(self._controls)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(8)
        sections: tuple[tuple[str, tuple[QtWidgets.QWidget, ...]], ...] = (
            ("Noise", (self.noise, _row("Along", self.along), _row("Seed", self.seed, self.another))),
            ("Simplification", (self.vertices,)),
            ("Holes", (self.holes, self.radius, self.cut, _row("", self.brush_size))),
            ("Topology", (self.weld, self.handle)),
            ("Another pose", (self.pose,)),
        )
        for number, (words, widgets) in enumerate(sections):
            if number:
                rows.addWidget(QtWidgets.QFrame(objectName="hairline"))
            rows.addWidget(_heading(words))
            for widget in widgets:
                rows.addWidget(widget)
        self._size_row = self.brush_size.parentWidget()
        fill(self, inside)
        self._results = QtWidgets.QWidget()
        below = QtWidgets.QVBoxLayout(self._results)
        below.setContentsMargins(PAD, 0, PAD, PAD)
        below.setSpacing(8)
        below.addWidget(_heading("Change of the distances"))
        below.addWidget(self.table)
        buttons = QtWidgets.QHBoxLayout()
        buttons.setSpacing(8)
        buttons.addWidget(self.save_button)
        buttons.addWidget(self.remove_button)
        buttons.addStretch(1)
        below.addSpacing(4)
        below.addLayout(buttons)
        # Numbers are seen whatever is scrolled.
        self._line = QtWidgets.QFrame(objectName="hairline")
        self.layout().setSpacing(8)
        self.layout().addWidget(self._line)
        self.layout().addWidget(self._results)

    def _connect(self) -> None:
        self.noise.chosen.connect(self._make_noise)
        self.along.chosen.connect(self._choose_way)
        self.seed.valueChanged.connect(self._choose_seed)
        self.another.clicked.connect(self._take_another_seed)
        self.vertices.chosen.connect(self._simplify)
        self.holes.chosen.connect(self._punch)
        self.radius.chosen.connect(self._widen)
        self.cut.button.clicked.connect(self._switch_brush)
        self.cut.removed.connect(self._fill_cut)
        self.brush_size.valueChanged.connect(self._brushing.enlarge)
        self._brushing.cut.connect(self._cut)
        self._brushing.cut_switched.connect(self._show_brush)
        self._picking.changed.connect(self._show_picked)
        for word, row in self._joins.items():
            row.button.clicked.connect(lambda _=False, word=word: self._pick(word))
            row.removed.connect(lambda word=word: self._join(word, None, word))
        self.pose.button.clicked.connect(self.choose_pose)
        self.pose.removed.connect(self._stand_again)
        self.save_button.clicked.connect(self.choose_and_save)
        self.remove_button.clicked.connect(self.remove)

        for kind in (QtWidgets.QSlider, QtWidgets.QSpinBox):
            for turned in self._controls.findChildren(kind):
                turned.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
                turned.installEventFilter(self)

    @property
    def _joins(self) -> dict[str, ChosenRow]:
        return {"weld": self.weld, "handle": self.handle}

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        write, more = FlatButton(self, "save"), FlatButton(self, "more")
        write.setToolTip("Save the changed mesh…")
        write.setAccessibleName("Save the changed mesh")
        write.activated.connect(self.choose_and_save)
        menu = QtWidgets.QMenu(more)
        menu.addAction("Copy the numbers", self.copy)
        menu.addAction("Remove change", self.remove)
        more.setMenu(menu)
        more.setToolTip("More about changes")
        more.setAccessibleName("More about changes")
        return [write, more]

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        mesh = changed_mesh(document)
        if self.asking.wanted is None:
            now = Perturbation() if mesh is None or mesh.change is None else mesh.change
            # What is not made keeps how it would be made.
            kept = (
                {} if not now.changes_nothing else {n: getattr(self.settings, n) for n in ("along", "radius", "seed")}
            )
            self.settings = replace(now, **kept)
        self._show_settings()
        try:
            refuse_change(document)
            reason = ""
        except ParameterError as error:
            reason = str(error)
        self.hint.setText(reason or (BEGIN if mesh is None else HINT))
        self._controls.setEnabled(not reason)
        for widget in (self._line, self._results):
            widget.setVisible(mesh is not None)
        self.note_changed.emit("" if mesh is None else _size_of(self.context.session.loaded(mesh.name)))
        self.table.show_document(document)
        self._show_ends()

    def show_answer(self, panel: int) -> None:
        self.table.show_document(self.context.document)

    def show_again(self) -> None:
        self._show_ends()

    def show_stopped(self) -> None:
        self.asking.forget()
        self._show_again()

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        """The wheel scrolls the dock, and turns only what has been chosen before."""
        if event.type() == QtCore.QEvent.Type.Wheel and not watched.hasFocus():
            event.ignore()
            return True
        return bool(super().eventFilter(watched, event))

    def show_closed(self) -> None:
        self.asking.forget()
        self._stop()
        for panel in self.context.grid.panels:
            panel.marks.mark_ends()

    def leave(self) -> None:
        if changed_mesh(self.context.document) is not None:
            self.context.session.apply(without_changed)

    def _stop(self) -> None:
        """Let the pointer mean what it usually does."""
        self._picking.stop()
        if self._brushing.cuts:
            self._brushing.switch(False)

    def _show_again(self) -> None:
        """A change could not be made: what is set is what is shown."""
        session = self.context.session
        if self.word in session.document.docks and session.surface is not None:
            self.show_document(session.document, None)

    def _show_settings(self) -> None:
        change, surface = self.settings, self.context.session.first_surface
        count = int((surface.component_of_vertex >= 0).sum())
        self.noise.show_value(change.noise)
        self.along.choose(change.along)
        with QtCore.QSignalBlocker(self.seed):
            self.seed.setValue(change.seed)
        scale = Scale(max(4, count // FEWEST), count, 2.0)
        self.vertices.show_value(count if change.simplify is None else change.simplify, scale)
        self.holes.show_value(change.holes)
        self.radius.show_value(change.radius)
        self.cut.show_chosen(counted(count_of(change.cut), "face") if change.cut else "")
        for word, row in self._joins.items():
            pair = getattr(change, word)
            row.show_chosen("" if pair is None else f"{pair[0]}, {pair[1]}")
        self.pose.show_chosen(Path(change.pose).name if change.pose else "")
        self._show_brush(self._brushing.cuts)
        self._show_picked()

    def _show_brush(self, is_on: bool) -> None:
        self.cut.button.setChecked(is_on)
        self._size_row.setVisible(is_on)
        with QtCore.QSignalBlocker(self.brush_size):
            self.brush_size.setValue(self._brushing.radius)

    def _show_picked(self) -> None:
        for word, row in self._joins.items():
            row.button.setChecked(self._picking.word == word)
        if self.word in self.context.document.docks:
            self._show_ends()

    def _show_ends(self) -> None:
        """Of what is welded, of handles, and of what is picked, on the surface before."""
        document = self.context.document
        joined = [vertex for pair in (self.settings.weld, self.settings.handle) for vertex in pair or ()]
        for panel in self.context.grid.panels:
            is_first = panel.surface == document.surfaces[0].name
            panel.marks.mark_ends([*joined, *self._picking.picked] if is_first else ())

    # ------------------------------------------------------------------ edits
    def _set(self, key: str = "", is_live: bool = False, **changes: Any) -> None:
        """key: of the step of the history, which a slider that moves goes on with."""
        self.settings = replace(self.settings, **changes)
        self._show_ends()
        self.asking.want(self.settings, f"change: {key}" if key else "", is_live)

    def _join(self, word: str, pair: tuple[int, int] | None, key: str = "") -> None:
        self._set(key, False, **{word: pair})

    def _make_noise(self, amount: float, is_live: bool) -> None:
        self._set("noise", is_live, noise=amount)

    def _choose_way(self, word: str) -> None:
        self._set(along=word)

    def _choose_seed(self, seed: int) -> None:
        self._set("seed", seed=seed)

    def _take_another_seed(self) -> None:
        self.seed.setValue((self.seed.value() + 1) % (MOST_SEEDS + 1))

    def _simplify(self, count: float, is_live: bool) -> None:
        surface = self.context.session.first_surface
        whole = int((surface.component_of_vertex >= 0).sum())
        self._set("simplify", is_live, simplify=None if count >= whole else int(count))

    def _punch(self, count: float, is_live: bool) -> None:
        self._set("holes", is_live, holes=int(count))

    def _widen(self, radius: float, is_live: bool) -> None:
        self._set("radius", is_live, radius=radius)

    def _switch_brush(self, is_on: bool) -> None:
        self._picking.stop()
        self._brushing.switch(is_on, cuts=True)

    def _cut(self, faces: IntArray, is_restored: bool) -> None:
        self._set(cut=cut_by(self.settings.cut, faces, is_restored))

    def _fill_cut(self) -> None:
        self._set(cut=())

    def _pick(self, word: str) -> None:
        if self._picking.word == word:
            self._picking.stop()
            return
        if self._brushing.cuts:
            self._brushing.switch(False)
        self._picking.pick(word, lambda pair: self._join(word, pair))

    def choose_pose(self) -> None:
        """Ask for the file of another pose, and take it."""
        folder = self.context.folder
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self, "Another pose", folder, MESH_FILES)
        if path:
            self.take_pose(path)

    def take_pose(self, path: str) -> None:
        """The pose in a file, or why not."""
        self._set(pose=path, pose_sha256="")

    def _stand_again(self) -> None:
        self._set(pose="", pose_sha256="")

    def remove(self) -> None:
        """The mesh as it was, alone."""
        self._stop()
        self.asking.want(Perturbation())

    # ------------------------------------------------------------------ what is written
    def copy(self) -> None:
        """Copy the numbers to the clipboard."""
        QtWidgets.QApplication.clipboard().setText(self.table.text())
        self.context.tell("The numbers are in the clipboard")

    def choose_and_save(self) -> None:
        """Ask for a file, and write the changed mesh."""
        session = self.context.session
        mesh = changed_mesh(session.document)
        loaded = None if mesh is None else session.loaded(mesh.name)
        if loaded is None:
            self.context.fail("There is no change yet that a mesh could be saved with.")
            return
        name = file_name([loaded.surface.name], "changed")
        save(self.context, "Save the changed mesh", name, MESH_FORMATS, lambda path: write_mesh(path, loaded.surface))


def _size_of(loaded: LoadedMesh | None) -> str:
    return "" if loaded is None else f"{len(loaded.surface.faces):,} faces"


def _is_number(value: float) -> bool:
    return value >= 0 and value == int(value)


def _is_count(value: float) -> bool:
    return value >= 4 and value == int(value)


def _is_radius(value: float) -> bool:
    return 0 < value <= 1


def _row(words: str, *widgets: QtWidgets.QWidget) -> QtWidgets.QWidget:
    """Widgets behind a label."""
    found = QtWidgets.QWidget()
    row = QtWidgets.QHBoxLayout(found)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(8)
    row.addWidget(label(words))
    for widget in widgets:
        is_wide = isinstance(widget, QtWidgets.QSlider)
        row.addWidget(widget, 1 if is_wide else 0)
    if not is_wide:
        row.addStretch(1)
    return found


def _heading(text: str) -> QtWidgets.QLabel:
    found = QtWidgets.QLabel(text)
    found.setProperty("heading", True)
    return found
