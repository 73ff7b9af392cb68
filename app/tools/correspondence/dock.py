"""The dock of correspondence: pairs of points on two surfaces, and what is waited for."""

from pathlib import Path

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.formats.vertex_maps import PAIR_FORMATS, read_pairs, write_pairs

from ...document.document import Document
from ...document.file_names import file_name
from ...document.quantities import kind_name
from ...qt.context import Context
from ...qt.docks.dock import PAD
from ...qt.docks.instrument import Instrument
from ...qt.docks.plain import fill
from ...qt.files.files import Files
from ...qt.files.saving import save
from ...qt.look.look import LOOK
from ...qt.panels.flat_button import FlatButton
from ...scene.style import PINS, WAITING
from ...session.questions import vertex_at
from .gestures import PairGestures
from .map_errors import MapErrors
from .maps import shows_maps
from .pair_locations import vertex_pairs
from .pairs import Pair, Pairs, add_pairs, half_pair, number_of, remove_pairs
from .prediction import predict, predicts, show_distances
from .row import PairRow, column_ends

ALONE = "Pairs are of points on two meshes: open a second one beside this."
NO_PANEL = "Panels can show where points of one mesh are on the other, by their distances."
HINT = "Click a point on either mesh, then its partner on the other."
NEXT = "Click the next point on either mesh."
READ = f"Pairs ({' '.join(f'*{extension}' for extension in PAIR_FORMATS)});;All files (*)"


class PairsDock(Instrument):
    """See the module.  errors: what is made of the pairs."""

    word, title = "pairs", "Pairs"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.rows: dict[str, PairRow] = {}
        self.hint = QtWidgets.QLabel(HINT, wordWrap=True)
        self.hint.setProperty("quiet", True)
        self.start = QtWidgets.QPushButton("Show predictions", autoDefault=False)
        self.start.clicked.connect(self.begin)
        self.open_beside = QtWidgets.QPushButton("Open beside…", autoDefault=False)
        self.open_beside.clicked.connect(self._open_beside)
        self.accept = QtWidgets.QPushButton("Accept", autoDefault=False, objectName="fill")
        self.accept.setToolTip("The best candidate is the partner (Enter)")
        self.accept.clicked.connect(self._accept)
        self.or_click = QtWidgets.QLabel(wordWrap=True)
        self.or_click.setProperty("quiet", True)
        self._head = _Columns()
        self._gestures = context[PairGestures]
        self._gestures.chosen.connect(self.choose)
        self.errors = MapErrors(context)
        self._lay_out()
        context.grid.activated.connect(lambda *_: self._show_rows(self._document))

    def _lay_out(self) -> None:
        self._list = QtWidgets.QVBoxLayout()
        self._list.setSpacing(0)
        self._waiting = QtWidgets.QWidget()
        waiting = QtWidgets.QHBoxLayout(self._waiting)
        waiting.setContentsMargins(0, 0, 0, 0)
        waiting.setSpacing(8)
        waiting.addWidget(self.accept)
        waiting.addWidget(self.or_click, 1)
        under = QtWidgets.QVBoxLayout()
        under.setContentsMargins(PAD, 10, PAD, 10)
        under.setSpacing(8)
        for widget in (self._waiting, self.hint, self.start, self.open_beside):
            under.addWidget(widget)
        inside = QtWidgets.QWidget()
        whole = QtWidgets.QVBoxLayout(inside)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addWidget(self._head)
        whole.addLayout(self._list)
        whole.addLayout(under)
        whole.addStretch(1)
        whole.addWidget(self.errors)
        fill(self, inside)

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        read, write, more = (FlatButton(self, icon) for icon in ("open", "save", "more"))
        for button, tip, do in (
            (read, "Read pairs: a line i,j for each…", self.choose_and_read),
            (write, "Save the pairs…", self.choose_and_save),
        ):
            button.setToolTip(tip)
            button.setAccessibleName(tip)
            button.activated.connect(do)
        menu = QtWidgets.QMenu(more)
        menu.addAction("Give the waiting point up\tEsc", self._drop)
        menu.addSeparator()
        menu.addAction("Show distances again", self.end_tool)
        menu.addAction("Remove all pairs", self.remove_all)
        more.setMenu(menu)
        more.setToolTip("More about pairs")
        more.setAccessibleName("More about pairs")
        return [read, write, more]

    # ------------------------------------------------------------------ what is told
    def on_opened(self) -> None:
        """The tool is wanted: panels predict, where there are two surfaces and none does yet."""
        if len(self._document.surfaces) > 1 and not (predicts(self._document) or shows_maps(self._document)):
            self.begin()

    def show_document(self, document: Document, before: Document | None) -> None:
        self.note_changed.emit(str(len(document[Pairs].pairs)) if document[Pairs].pairs else "")
        self._show_rows(document)
        self.errors.show_document(document)

    def show_answer(self, panel: int) -> None:
        self._show_rows(self._document)
        self.errors.show_answer()

    def show_again(self) -> None:
        self.errors.show_again()

    def show_closed(self) -> None:
        self.errors.show_closed()
        self.context.grid.marks.light(self.word, ())

    def _show_rows(self, document: Document) -> None:
        half = half_pair(document)
        found = self._gestures.candidate(may_be_late=True) if half is not None else None
        wanted = {pair.points[0]: pair for pair in document[Pairs].pairs}
        for point in [point for point in self.rows if point not in wanted]:
            gone = self.rows.pop(point)
            gone.hide()
            gone.deleteLater()
        for place, (point, pair) in enumerate(wanted.items()):
            if point not in self.rows:
                self.rows[point] = self._new_row(point)
            row = self.rows[point]
            if self._list.indexOf(row) != place:
                self._list.removeWidget(row)
                self._list.insertWidget(place, row)
            guess = "" if found is None else f"{found[1].vertex} ?"
            colour = WAITING if pair.is_half else PINS[pair.colour]
            number = number_of(document, pair)
            row.show_pair(
                number, colour, self._place(pair.first) or guess, self._place(pair.second) or guess, pair.is_half
            )
            row.show_chosen(pair.points[0] in self.context.grid.marks.lit(self.word))
        is_alone, is_on = len(document.surfaces) < 2, predicts(document)
        other = "" if half is None else "B" if half.first else "A"
        self._head.setVisible(bool(document[Pairs].pairs))
        self._waiting.setVisible(half is not None and is_on)
        self.accept.setVisible(found is not None)
        hint = f"Click its partner on\u00a0{other}"
        if found is not None:
            by = kind_name(document.panel(found[0]).shows.specs[0].kind).lower()
            hint = f"Enter takes\u00a0{found[1].vertex}, by\u00a0{by}; or click another\u00a0vertex on\u00a0{other}"
        self.or_click.setText(hint)
        has_maps = shows_maps(document)  # the section of errors leads back to predictions
        self.hint.setVisible(is_alone or (not is_on and not has_maps) or (is_on and half is None))
        self.hint.setText(ALONE if is_alone else NO_PANEL if not is_on else NEXT if document[Pairs].pairs else HINT)
        self.start.setVisible(not is_alone and not is_on and not has_maps)
        self.open_beside.setVisible(is_alone)

    def _place(self, name: str) -> str:
        """The vertex of a point; empty for none."""
        if not name:
            return ""
        point = self._document.point(name)
        loaded = self.context.session.loaded(point.surface)
        return "" if loaded is None else str(vertex_at(point.at, loaded.surface))

    def _new_row(self, point: str) -> PairRow:
        row = PairRow(point)
        row.chosen.connect(self._choose)
        row.removed.connect(self._remove)
        row.stepped.connect(self._step)
        row.accepted.connect(self._accept)
        return row

    def choose(self, point: str) -> None:
        """Let the row of this point's pair stand out."""
        if self.word not in self._document.docks:
            return
        for row in self.rows.values():
            row.show_chosen(bool(point) and point in self._pair(row.point).points)

    # ------------------------------------------------------------------ edits
    @property
    def _document(self) -> Document:
        return self.context.document

    def _pair(self, point: str) -> Pair:
        return next(pair for pair in self._document[Pairs].pairs if point in pair.points)

    def begin(self) -> None:
        """The first surface in one panel, the second in one for each distance, which predicts."""
        self.context.edit(predict(self._document))

    def end_tool(self) -> None:
        """Show distances again in place of predictions and maps."""
        self.context.edit(show_distances(self._document))

    def _open_beside(self) -> None:
        self.context[Files].choose_beside()

    def _choose(self, point: str) -> None:
        self._gestures.choose(point)

    def _accept(self) -> None:
        self._gestures.accept()

    def _drop(self) -> None:
        self._gestures.put_down()

    def _remove(self, point: str) -> None:
        """The next row, or the last, has the keys then."""
        rows = list(self.rows)
        left = [name for name in rows if name != point]
        number = min(rows.index(point), len(left) - 1)
        had_keys = self.rows[point].hasFocus()
        self.context.edit(remove_pairs(self._document, [self._pair(point)]))
        if left and had_keys:
            self._choose(left[number])
            self.rows[left[number]].setFocus()
        else:
            self._choose("")

    def _step(self, point: str, by: int) -> None:
        """To the row above or below."""
        rows = list(self.rows)
        number = rows.index(point) + by
        if 0 <= number < len(rows):
            self.rows[rows[number]].setFocus(QtCore.Qt.FocusReason.TabFocusReason)
            self._choose(rows[number])

    def remove_all(self) -> None:
        """Remove all pairs."""
        self.context.edit(remove_pairs(self._document, self._document[Pairs].pairs))

    # ------------------------------------------------------------------ files
    def choose_and_read(self) -> None:
        """Ask for a file of pairs, and read it."""
        folder = self.context.folder
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self, "Read pairs", folder, READ)
        if path:
            self.read(path)

    def read(self, path: str) -> None:
        """Pairs of a file besides those that there are, or why not."""
        session, document = self.context.session, self._document
        loaded = [session.loaded(mesh.name) for mesh in document.surfaces[:2]]
        try:
            surfaces = [each.surface for each in loaded if each is not None]
            found = read_pairs(path, *surfaces) if len(surfaces) == 2 else read_pairs(path)
            changed = add_pairs(document, [(int(i), int(j)) for i, j in found])
        except BihdistError as error:
            self.context.fail(error)
            return
        session.show(changed)
        new = len(changed[Pairs].pairs) - len(document[Pairs].pairs)
        known = f", {len(found) - new} of them known already" if new < len(found) else ""
        self.context.tell(f"Read {len(found):,} pairs from {Path(path).name}{known}")

    def choose_and_save(self) -> None:
        """Ask for a file, and write the pairs."""
        session, document = self.context.session, self._document
        loaded = [session.loaded(mesh.name) for mesh in document.surfaces[:2]]
        name = file_name([each.surface.name for each in loaded if each is not None], "pairs")

        def write(path: str) -> None:
            first, second = (each.surface for each in loaded if each is not None)
            write_pairs(path, vertex_pairs(document, first, second))

        if len(loaded) < 2:
            self.context.fail(ALONE)
        else:
            save(self.context, "Save pairs", name, PAIR_FORMATS, write)


class _Columns(QtWidgets.QWidget):
    """The letters of both surfaces, over their columns."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(round(26 * LOOK.scale))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme = QtGui.QPainter(self), LOOK.theme
        painter.setFont(LOOK.font(12))
        painter.setPen(QtGui.QColor(theme.quiet))
        metrics = painter.fontMetrics()
        baseline = round((self.height() + metrics.ascent() - metrics.descent()) / 2)
        for letter, right in zip("AB", column_ends(self.width()), strict=True):
            painter.drawText(QtCore.QPointF(right - metrics.horizontalAdvance(letter), baseline), letter)
        painter.fillRect(0, self.height() - 1, self.width(), 1, QtGui.QColor(theme.border))
