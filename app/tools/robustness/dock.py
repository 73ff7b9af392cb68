"""The dock of robustness: changes to the mesh, and how far each distance changes with it."""

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.applications.changes import Perturbation, count_of
from bihdist_core.arrays import IntArray
from bihdist_core.counts import counted
from bihdist_core.formats.surface_output import MESH_FORMATS, write_mesh

from ...document.derived_surfaces import changed_mesh, without_changed
from ...document.document import Document
from ...document.file_names import file_name
from ...qt.context import Context
from ...qt.docks.brushing import Brushing
from ...qt.docks.instrument import PAD, Instrument
from ...qt.docks.plain import fill
from ...qt.docks.slider_box import Scale, SliderBox
from ...qt.files.saving import MESH_FILES, ask_file, save
from ...qt.look.controls import ElidedLabel, Segments
from ...qt.look.form import (
    Form,
    add_parts,
    describe,
    hairline,
    heading,
    in_column,
    in_row,
    keep_room,
    push_button,
    quiet_label,
)
from ...qt.look.look import LOOK
from ...qt.panels.flat_button import icon_button
from .perturbed_documents import check_can_perturb, cut_by, has_other_mesh, perturb_mesh, perturbation_of
from .table import ChangeTable

REQUEST_INTERVAL_MS = 60
"""Milliseconds between two requests while a slider moves."""

PATIENCE_S = 4.0
"""Seconds for which the last perturbation may go on before the next takes its place, so that some arrive while a
slider moves."""


class PerturbationRequests(QtCore.QObject):
    """Asks for the perturbation `wanted`, None once that is done; `lost` is emitted if it cannot be made."""

    lost = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.wanted: Perturbation | None = None
        self._key = ""
        self._mesh = ""
        self._asked, self._asked_at = Perturbation(), 0.0
        self._soon = QtCore.QTimer(self, singleShot=True, interval=REQUEST_INTERVAL_MS)
        self._soon.timeout.connect(self._ask)
        context.refused.connect(self._refused)

    def want(self, change: Perturbation, key: str = "", is_live: bool = False) -> None:
        """Ask for a perturbation, as a step of the history with the key; with `is_live`, more are to come."""
        self.wanted, self._key = change, key
        self._mesh = self._context.document.surfaces[0].sha256
        if not is_live:
            self._soon.stop()
            self._ask(at_once=True)
        elif not self._soon.isActive():
            self._soon.start()

    def forget(self) -> None:
        """Ask for nothing any more."""
        self.wanted = None
        self._soon.stop()

    def _ask(self, at_once: bool = False) -> None:
        session = self._context.session
        if self.wanted is None or session.document.surfaces[0].sha256 != self._mesh:
            self.forget()  # another mesh has been opened
            return
        if session.is_opening and not at_once and time.monotonic() - self._asked_at < PATIENCE_S:
            self._soon.start()
            return
        wanted, self.wanted = self.wanted, None
        if wanted == (self._asked if session.is_opening else perturbation_of(session.document)):
            return
        self._asked, self._asked_at = wanted, time.monotonic()
        session.apply(lambda document: perturb_mesh(document, wanted), self._key)

    def _refused(self, _: str) -> None:
        if self.wanted is None:
            self.lost.emit()


BOX_WIDTH_PX, UNIT_WIDTH_PX = 60, 40
"""Logical pixels of boxes, and of what stands behind them."""


class AmountRow(SliderBox):
    """An amount with a slider and a box, its `name` for screen readers and tips, and a `unit` behind the box."""

    def __init__(self, name: str, unit: str, scale: Scale, is_good: Callable[[float], bool], wrong: str) -> None:
        super().__init__(scale, BOX_WIDTH_PX, is_good, wrong)
        self.name_value(name, name)
        behind = quiet_label(unit)
        behind.setFixedWidth(round(UNIT_WIDTH_PX * LOOK.scale))
        in_row((self.slider, 1), self.box, behind, of=self, spacing=8)


class ChosenRow(QtWidgets.QWidget):
    """A button, what has been chosen by it, and a cross that takes that away."""

    removed = QtCore.Signal()

    def __init__(self, words: str, button: str, tip: str, is_check: bool = False) -> None:
        super().__init__()
        self.button = push_button(button)
        self.button.setCheckable(is_check)
        describe(self.button, f"{words}: {button}", tip)
        self.note = ElidedLabel(QtCore.Qt.TextElideMode.ElideMiddle)
        self.note.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Preferred)
        self.note.setAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
        self.cross = icon_button(self, "close", f"{words}: remove", self.removed.emit)
        keep_room(self.cross)
        in_row(self.button, (self.note, 1), self.cross, of=self, spacing=8)
        self.show_chosen("")

    def show_chosen(self, words: str) -> None:
        """Show what is chosen, "" for nothing."""
        self.note.setText(words)
        self.note.setToolTip(words)
        self.cross.setVisible(bool(words))


def beside(*widgets: QtWidgets.QWidget) -> QtWidgets.QWidget:
    """Return widgets side by side, at the left of what room there is."""
    row = QtWidgets.QWidget()
    in_row(*widgets, None, of=row, spacing=8)
    return row


LABEL_WIDTH_PX = 72

HINT = "All changes are made to the original mesh at once."
BEGIN = "Change the mesh, and each distance is shown before and after, with the difference."
"""The hint before there is a change."""

MAX_SEED = 999_999
MAX_REDUCTION = 50
"""The simplest mesh that the slider makes has one of so many vertices."""

NOISE = Scale(0.0, 4.0, 2.0, 2)
HOLES = Scale(0, 20)
RADIUS = Scale(0.01, 0.25, 1.5, 3)


class RobustnessDock(Instrument):
    """Perturbations of the mesh, and how far each distance changes; `settings` has those that are not made as well."""

    word = "robustness"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.settings = Perturbation()
        self.asking = PerturbationRequests(context)
        self.asking.lost.connect(self._show_again)
        self._brushing = context[Brushing]
        self.noise = AmountRow("Noise, in mean edge lengths", "edges", NOISE, lambda v: v >= 0, "A number from 0")
        self.along = Segments({"x, y, z": "xyz", "Normals": "normals"}, "Noise along")
        self.seed = QtWidgets.QSpinBox(maximum=MAX_SEED, keyboardTracking=False)
        describe(self.seed, "Seed of noise and holes", "The same seed gives the same noise and holes")
        self.another = push_button("New seed", lambda: self.seed.setValue((self.seed.value() + 1) % (MAX_SEED + 1)))
        self.vertices = AmountRow(
            "Vertices to keep", "", NOISE, lambda v: v >= 4 and v == int(v), "A whole number from 4"
        )
        self.holes = AmountRow(
            "Holes at random vertices", "holes", HOLES, lambda v: v >= 0 and v == int(v), "A whole number"
        )
        tip = "Radius of holes, in roots of the area"
        self.radius = AmountRow(tip, "√area", RADIUS, lambda v: 0 < v <= 1, "A number from 0 to 1")
        tip = "Paint the faces to remove on the original surface; Ctrl restores them"
        self.cut = ChosenRow("By brush", "Cut out", tip, is_check=True)
        self.brush_size = self._brushing.size_slider()
        self.pose = ChosenRow("Pose", "Open…", "Another pose from a file with the same vertices and faces")
        self.table = ChangeTable(context)
        self.save_button = push_button("Save changed mesh…", self.choose_and_save)
        self.remove_button = push_button("Remove change", self.remove)
        self._controls = controls = Form(LABEL_WIDTH_PX)
        controls.section("Noise")
        controls.row("Amount", self.noise)
        controls.row("Along", self.along)
        controls.row("Seed", beside(self.seed, self.another))
        controls.section("Simplification")
        controls.row("Vertices", self.vertices)
        controls.section("Holes")
        controls.row("Random", self.holes)
        controls.row("Radius", self.radius)
        controls.row("By brush", self.cut)
        controls.add(self.brush_size)
        controls.section("Another pose")
        controls.row("Pose", self.pose)
        self.hint = quiet_label(BEGIN, wraps=True)
        tip = "Close the second mesh with its panels; Ctrl+Z brings them back"
        self.close_second = push_button("Close second mesh", lambda: context.session.close_second_mesh(), tip)
        inside, self._results = QtWidgets.QWidget(), QtWidgets.QWidget()
        close = (self.close_second, 0, QtCore.Qt.AlignmentFlag.AlignLeft)
        in_column(self.hint, close, controls, None, of=inside, spacing=8, margins=(PAD, 8, PAD, PAD))
        fill(self, inside)
        buttons = in_row(self.save_button, self.remove_button, None, spacing=8)
        below = heading("Change of the distances"), self.table, 4, buttons
        in_column(*below, of=self._results, spacing=8, margins=(PAD, 0, PAD, PAD))
        # Numbers are seen whatever is scrolled.
        self._line = hairline()
        self.layout().setSpacing(8)
        add_parts(self.layout(), (self._line, self._results))
        self.add_head_button("save", "Save the changed mesh…", self.choose_and_save)
        menu = {"Copy the numbers": self.copy, "Remove change": self.remove}
        self.add_head_button("more", "More about changes", menu)
        self.along.chosen.connect(lambda word: self._set(along=word))
        self.seed.valueChanged.connect(lambda seed: self._set("seed", seed=seed))
        self.noise.valued.connect(lambda amount, is_live: self._set("noise", is_live, noise=amount))
        self.vertices.valued.connect(self._simplify)
        self.holes.valued.connect(lambda count, is_live: self._set("holes", is_live, holes=int(count)))
        self.radius.valued.connect(lambda radius, is_live: self._set("radius", is_live, radius=radius))
        self.cut.button.clicked.connect(lambda is_on: self._brushing.switch(is_on, cuts=True))
        self.cut.removed.connect(lambda: self._set(cut=()))
        self._brushing.cut.connect(self._cut)
        self._brushing.cut_switched.connect(self._show_brush)
        self.pose.button.clicked.connect(lambda: ask_file(context, "Another pose", MESH_FILES, self.take_pose))
        self.pose.removed.connect(lambda: self.take_pose(""))
        for kind in (QtWidgets.QSlider, QtWidgets.QSpinBox):
            for turned in self._controls.findChildren(kind):
                turned.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
                turned.installEventFilter(self)

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
            check_can_perturb(document)
            reason = ""
        except ParameterError as error:
            reason = str(error)
        self.hint.setText(reason or (BEGIN if mesh is None else f"{HINT}{_joined(self.settings)}"))
        self.close_second.setVisible(has_other_mesh(document))
        self._controls.setEnabled(not reason)
        for widget in (self._line, self._results):
            widget.setVisible(mesh is not None)
        loaded = None if mesh is None else self.context.session.loaded(mesh.name)
        self.note_changed.emit("" if loaded is None else counted(len(loaded.surface.faces), "face"))
        self.table.show_document(document)

    def show_answer(self, panel: int) -> None:
        self.table.show_document(self.document)

    def show_stopped(self) -> None:
        self.asking.forget()
        self._show_again()

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        """Let the wheel scroll the dock, and turn only controls that have the focus."""
        if event.type() == QtCore.QEvent.Type.Wheel and not watched.hasFocus():
            event.ignore()
            return True
        return bool(super().eventFilter(watched, event))

    def show_closed(self) -> None:
        self.asking.forget()
        self._stop()

    def leave(self) -> None:
        if changed_mesh(self.document) is not None:
            self.context.session.apply(without_changed)

    def _stop(self) -> None:
        """Switch the cutting brush off."""
        if self._brushing.cuts:
            self._brushing.switch(False)

    def _show_again(self) -> None:
        """Show the settings of the document again, as a change could not be made."""
        session = self.context.session
        if self.word in session.document.docks and session.loaded() is not None:
            self.show_document(session.document, None)

    def _show_settings(self) -> None:
        change, count = self.settings, self._vertex_count
        self.noise.show_value(change.noise)
        self.along.choose(change.along)
        with QtCore.QSignalBlocker(self.seed):
            self.seed.setValue(change.seed)
        scale = Scale(max(4, count // MAX_REDUCTION), count, 2.0)
        self.vertices.show_value(count if change.simplify is None else change.simplify, scale)
        self.holes.show_value(change.holes)
        self.radius.show_value(change.radius)
        self.cut.show_chosen(counted(count_of(change.cut), "face") if change.cut else "")
        self.pose.show_chosen(Path(change.pose).name if change.pose else "")
        self._show_brush(self._brushing.cuts)

    def _show_brush(self, is_on: bool) -> None:
        self.cut.button.setChecked(is_on)
        self.brush_size.setVisible(is_on)
        with QtCore.QSignalBlocker(self.brush_size):
            self.brush_size.setValue(self._brushing.radius)

    # ------------------------------------------------------------------ edits
    def _set(self, key: str = "", is_live: bool = False, **changes: Any) -> None:
        """Change the settings; a slider that moves continues the step of the history with the key."""
        self.settings = replace(self.settings, **changes)
        self.asking.want(self.settings, f"change: {key}" if key else "", is_live)

    @property
    def _vertex_count(self) -> int:
        return int((self.context.session.mesh().surface.component_of_vertex >= 0).sum())

    def _simplify(self, count: float, is_live: bool) -> None:
        self._set("simplify", is_live, simplify=None if count >= self._vertex_count else int(count))

    def _cut(self, faces: IntArray, is_restored: bool) -> None:
        self._set(cut=cut_by(self.settings.cut, faces, is_restored))

    def take_pose(self, path: str) -> None:
        """Take the pose in a file, or say why it cannot be; that of the mesh itself if there is none."""
        self._set(pose=path, pose_sha256="")

    def remove(self) -> None:
        """Restore the original mesh, alone."""
        self._stop()
        self.asking.want(Perturbation())

    # ------------------------------------------------------------------ what is written
    def copy(self) -> None:
        """Copy the numbers to the clipboard."""
        self.context.copy(self.table.text(), "The numbers are on the clipboard")

    def choose_and_save(self) -> None:
        """Ask for a file, and write the changed mesh."""
        session = self.context.session
        mesh = changed_mesh(session.document)
        loaded = None if mesh is None else session.loaded(mesh.name)
        if loaded is None:
            self.context.fail("There is no changed mesh to save yet.")
            return
        name = file_name([loaded.surface.name], "changed")
        save(self.context, "Save the changed mesh", name, MESH_FORMATS, lambda path: write_mesh(path, loaded.surface))


def _joined(change: Perturbation) -> str:
    """Return a sentence on the weld and the handle of a change, which only the command and figures can make."""
    pairs = [f"{word} {pair[0]}:{pair[1]}" for word in ("weld", "handle") if (pair := getattr(change, word))]
    return f" With {' and '.join(pairs)}." if pairs else ""
