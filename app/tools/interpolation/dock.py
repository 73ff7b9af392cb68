"""The dock of interpolation: anchors with their values, how they are weighed, and the extrema that are at no anchor."""

from dataclasses import replace
from pathlib import Path

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError, ParameterError
from bihdist_core.formats.anchors import ANCHOR_FORMATS, read_anchors, write_anchors
from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields

from ...document.document import Document
from ...document.file_names import file_name
from ...document.quantities import Quantity
from ...document.shared_parts.pins import Pins
from ...qt.context import Context
from ...qt.docks.dock import PAD
from ...qt.docks.instrument import Instrument
from ...qt.docks.plain import fill
from ...qt.files.saving import save
from ...qt.look.look import LOOK
from ...qt.look.segments import Segments
from ...qt.look.text_box import TextBox, mark_wrong
from ...qt.panels.flat_button import FlatButton
from ...session.questions import vertex_at
from .clock import AnchorClock
from .extrema import AnchorExtrema
from .gestures import AnchorGestures
from .part import Anchor, Anchors, add_anchor, change_anchor, remove_anchors
from .quantity import Interpolant, interpolate, interpolated, show_distances
from .row import BOX, AnchorRow
from .samples import AnchorSamples

HINT = "Click the surface to add an anchor, drag one to move it."
NO_PANEL = "Every panel can show the interpolant of values at anchors, by its distance."
READ = f"Anchors ({' '.join(f'*{extension}' for extension in ANCHOR_FORMATS)});;All files (*)"


class AnchorsDock(Instrument):
    """See the module."""

    word, title = "anchors", "Anchors"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.rows: dict[str, AnchorRow] = {}
        self.hint = QtWidgets.QLabel(HINT, wordWrap=True)
        self.hint.setProperty("quiet", True)
        self.start = QtWidgets.QPushButton("Show interpolants", autoDefault=False)
        self.start.clicked.connect(self.begin)
        self.exponent, self.smoothness = TextBox(), TextBox()
        for box, name, tip in (
            (self.exponent, "Exponent of the weights", "Larger: flatter at anchors, steeper between them; 0.1 to 20"),
            (self.smoothness, "Smoothness of the weights", "How far around anchors cones are rounded, from 0 to 1"),
        ):
            box.setAccessibleName(name)
            box.setToolTip(tip)
            box.setFixedWidth(round(BOX * LOOK.scale))
            box.editingFinished.connect(self._weigh)
        self.shows = Segments({"Interpolant": "interpolant", "Weights": "total"}, "What panels show")
        self.shows.chosen.connect(self._show_total)
        self.extrema = AnchorExtrema(context)
        self.samples = AnchorSamples(context)
        self.save_field = QtWidgets.QPushButton("Save field…", autoDefault=False)
        self.save_field.setToolTip("What panels show of interpolants, a column for each")
        self.save_field.clicked.connect(self.save_fields)
        self._clock = AnchorClock(context)
        self._gestures = context[AnchorGestures]
        self._gestures.chosen.connect(self.choose)
        self._lay_out()

    def _lay_out(self) -> None:
        self._list = QtWidgets.QVBoxLayout()
        self._list.setSpacing(0)
        below = QtWidgets.QVBoxLayout()
        below.setContentsMargins(PAD, 6, PAD, PAD)
        below.setSpacing(8)
        below.addWidget(self.hint)
        below.addWidget(self.start)
        self._more = QtWidgets.QWidget()
        more = QtWidgets.QVBoxLayout(self._more)
        more.setContentsMargins(0, 0, 0, 0)
        more.setSpacing(8)
        form = QtWidgets.QFormLayout()
        form.setHorizontalSpacing(10)
        form.addRow("Exponent p", self.exponent)
        form.addRow("Smoothness", self.smoothness)
        form.addRow("Show", self.shows)
        for widget in (_line(), _heading("Weights")):
            more.addWidget(widget)
        more.addLayout(form)
        self._besides = QtWidgets.QWidget()
        besides = QtWidgets.QVBoxLayout(self._besides)
        besides.setContentsMargins(0, 0, 0, 0)
        besides.setSpacing(8)
        for widget in (_line(), _heading("Extrema besides the anchors"), self.extrema):
            besides.addWidget(widget)
        for widget in (self._besides, _line()):
            more.addWidget(widget)
        more.addWidget(self.samples)
        more.addWidget(self.save_field, 0, QtCore.Qt.AlignmentFlag.AlignLeft)
        below.addWidget(self._more)
        inside = QtWidgets.QWidget()
        whole = QtWidgets.QVBoxLayout(inside)
        whole.setContentsMargins(0, 4, 0, 0)
        whole.setSpacing(0)
        whole.addLayout(self._list)
        whole.addLayout(below)
        whole.addStretch(1)
        fill(self, inside)

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        read, write, more = (FlatButton(self, icon) for icon in ("open", "save", "more"))
        for button, tip, do in (
            (read, "Read anchors: CSV, JSON, MeshLab's picked points…", self.choose_and_read),
            (write, "Save the anchors…", self.choose_and_save),
        ):
            button.setToolTip(tip)
            button.setAccessibleName(tip)
            button.activated.connect(do)
        menu = QtWidgets.QMenu(more)
        menu.addAction("Save the interpolants as fields…", self.save_fields)
        menu.addAction("Pins become anchors", self.take_pins)
        menu.addSeparator()
        menu.addAction("Show distances again", self.end_tool)
        menu.addAction("Remove all anchors", self.remove_all)
        more.setMenu(menu)
        more.setToolTip("More about anchors")
        more.setAccessibleName("More about anchors")
        return [read, write, more]

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        anchors = self._anchors(document)
        self.note_changed.emit(str(len(anchors)) if anchors else "")
        self._show_rows(anchors)
        parts = [part for panel in document.panels for part in panel.shows.parts if isinstance(part, Interpolant)]
        is_on = bool(parts)
        self.start.setVisible(not is_on)
        self.hint.setText(HINT if is_on else NO_PANEL)
        self._more.setVisible(is_on)
        weights = document[Anchors].weights
        for box, value in ((self.exponent, weights.exponent), (self.smoothness, weights.smoothness)):
            if not box.isModified():
                box.setText(f"{value:.6g}")
                mark_wrong(box, False)
        self.shows.choose("total" if parts and all(part.total for part in parts) else "interpolant")
        self._besides.setVisible(any(interpolated(panel.shows) for panel in document.panels_of()))
        self.extrema.show_document(document)

    def show_answer(self, panel: int) -> None:
        self.extrema.show_counts()
        self._clock.note()

    def show_again(self) -> None:
        self.extrema.show_counts()

    def show_closed(self) -> None:
        self.extrema.leave()
        self.context.grid.marks.light(self.word, ())

    def _anchors(self, document: Document) -> list[Anchor]:
        surface = document.surfaces[0].name
        return [
            a for a in document[Anchors].anchors if document.point(a.point).surface == surface and a.value is not None
        ]

    def _show_rows(self, anchors: list[Anchor]) -> None:
        names = [anchor.point for anchor in anchors]
        for point in [point for point in self.rows if point not in names]:
            gone = self.rows.pop(point)
            gone.hide()
            gone.deleteLater()
        lit = self.context.grid.marks.lit(self.word)
        values = [anchor.value for anchor in anchors if anchor.value is not None]
        ends = (min([0.0, *values]), max([1.0, *values]))
        for number, anchor in enumerate(anchors):
            if anchor.point not in self.rows:
                self.rows[anchor.point] = self._new_row(anchor.point)
            row = self.rows[anchor.point]
            if self._list.indexOf(row) != number:
                self._list.removeWidget(row)
                self._list.insertWidget(number, row)
            row.show_anchor(anchor.name or anchor.point, anchor.value or 0.0, anchor.left_out, ends)
            row.show_chosen(anchor.point in lit)

    def _new_row(self, point: str) -> AnchorRow:
        row = AnchorRow(point)
        row.valued.connect(self._value)
        row.named.connect(self._name)
        row.left_out.connect(self._leave_out)
        row.removed.connect(self._remove)
        row.chosen.connect(self._choose)
        row.stepped.connect(self._step)
        return row

    def choose(self, point: str) -> None:
        """Let the row of this point stand out."""
        if self.word not in self._document.docks:
            return
        for row in self.rows.values():
            row.show_chosen(row.point == point)

    def _choose(self, point: str) -> None:
        self._gestures.choose(point)

    # ------------------------------------------------------------------ edits
    def _show(self, document: Document, key: str = "", live: bool = False) -> None:
        self.context.edit(document, key, live)

    @property
    def _document(self) -> Document:
        return self.context.document

    def _anchor(self, point: str) -> Anchor:
        return next(anchor for anchor in self._document[Anchors].anchors if anchor.point == point)

    def begin(self) -> None:
        """Every panel shows the interpolant by its distance."""
        self._show(interpolate(self._document))

    def end_tool(self) -> None:
        """Show distances again in place of interpolants."""
        self._show(show_distances(self._document))

    def _value(self, point: str, value: float, is_live: bool) -> None:
        self._choose(point)
        changed = change_anchor(self._document, replace(self._anchor(point), value=value))
        self._clock.begin(changed[Anchors].anchors)
        self._show(changed, f"value of {point}", is_live)

    def _name(self, point: str, name: str) -> None:
        anchor = self._anchor(point)
        name = "" if name == anchor.point else name
        if name != anchor.name:
            try:
                self._show(change_anchor(self._document, replace(anchor, name=name)))
            except ParameterError as error:
                self.context.fail(error)

    def _leave_out(self, point: str, is_out: bool) -> None:
        self._show(change_anchor(self._document, replace(self._anchor(point), left_out=is_out)))

    def _remove(self, point: str) -> None:
        """The next row, or the last, has the keys then."""
        rows = list(self.rows)
        left = [name for name in rows if name != point]
        number = min(rows.index(point), len(left) - 1)
        had_keys = self.rows[point].isAncestorOf(QtWidgets.QApplication.focusWidget() or self)
        self._show(remove_anchors(self._document, [point]))
        if left:
            self._choose(left[number])
            if had_keys:
                self.rows[left[number]].slider.setFocus()

    def _step(self, point: str, by: int) -> None:
        """To the row above or below, at the same box."""
        rows = list(self.rows)
        number = rows.index(point) + by
        if 0 <= number < len(rows):
            row = self.rows[rows[number]]
            row.take_keys(like=self.rows[point])
            self._choose(row.point)

    def remove_all(self) -> None:
        """Remove all anchors."""
        self._show(remove_anchors(self._document, [anchor.point for anchor in self._anchors(self._document)]))

    def _weigh(self) -> None:
        for box, name in ((self.exponent, "exponent"), (self.smoothness, "smoothness")):
            if not box.isModified():
                continue
            try:
                weights = replace(self._document[Anchors].weights, **{name: float(box.text())})
            except (ValueError, ParameterError):
                mark_wrong(box, True)
                continue
            box.setModified(False)
            self._show(self._document.with_part(replace(self._document[Anchors], weights=weights)), name)

    def _show_total(self, word: str) -> None:
        def shown(shows: Quantity) -> Quantity:
            parts = (replace(p, total=word == "total") if isinstance(p, Interpolant) else p for p in shows.parts)
            return shows.with_parts(tuple(parts))

        document = self._document
        self._show(replace(document, panels=tuple(replace(p, shows=shown(p.shows)) for p in document.panels)))

    def take_pins(self) -> None:
        """An anchor at each pin that is at a vertex, from 0 for the first to 1 for the last."""
        document = self._document
        pins = [(pin.name, document.point(pin.point)) for pin in document[Pins].pins]
        there = [(name, point.at, point.surface) for name, point in pins if isinstance(point.at, int)]
        for k, (name, vertex, surface) in enumerate(there):
            value = round(k / max(1, len(there) - 1), 3)
            document, _ = add_anchor(document, vertex, value, surface, name)
        self._show(document)

    # ------------------------------------------------------------------ files
    def choose_and_read(self) -> None:
        """Ask for a file of anchors, and read it."""
        folder = self.context.folder
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self, "Read anchors", folder, READ)
        if path:
            self.read(path)

    def read(self, path: str) -> None:
        """Anchors of a file besides those that there are, or why not; how far they were moved to vertices is said."""
        session, document = self.context.session, self._document
        try:
            found = read_anchors(path, session.first_surface)
            for vertex, value, name in zip(found.vertices.tolist(), found.values.tolist(), found.names, strict=True):
                document, _ = add_anchor(document, vertex, value, document.surfaces[0].name, name)
        except BihdistError as error:
            self.context.fail(error)
            return
        self._show(document)
        far = float(found.moved.max())
        moved = f", moved to vertices by up to {far:.3g}" if far > 0 else ""
        self.context.tell(f"Read {len(found):,} anchors from {Path(path).name}{moved}")

    def choose_and_save(self) -> None:
        """Ask for a file, and write the anchors."""
        document, surface = self._document, self.context.session.first_surface
        anchors = self._anchors(document)
        vertices = [vertex_at(document.point(anchor.point).at, surface) for anchor in anchors]
        values = [anchor.value for anchor in anchors if anchor.value is not None]
        names = tuple(anchor.name for anchor in anchors)

        def write(path: str) -> None:
            write_anchors(path, surface, vertices, values, names)

        save(self.context, "Save anchors", file_name([surface.name], "anchors"), ANCHOR_FORMATS, write)

    def save_fields(self) -> None:
        """What the panels show of interpolants."""
        session, surface = self.context.session, self.context.session.first_surface
        fields = {}
        for panel in session.document.panels_of():
            shown = session.shown.get(panel.id)
            is_meant = any(isinstance(part, Interpolant) for part in panel.shows.parts)
            if is_meant and shown is not None and shown.answer.field is not None:
                fields[str(panel.shows)] = shown.answer.field
        name = file_name([surface.name], "interpolants")
        save(self.context, "Save interpolants", name, FIELD_FORMATS, lambda path: write_fields(path, surface, fields))


def _line() -> QtWidgets.QFrame:
    return QtWidgets.QFrame(objectName="hairline")


def _heading(text: str) -> QtWidgets.QLabel:
    label = QtWidgets.QLabel(text)
    label.setProperty("heading", True)
    return label
