"""The dock of correspondence: pairs of points on two surfaces, and what is waited for."""

from functools import partial
from pathlib import Path

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.formats.landmarks import LANDMARKS
from bihdist_core.formats.vertex_maps import PAIR_FORMATS, read_pairs, write_pairs

from ...document.document import Document
from ...document.file_names import file_name
from ...document.quantities import kind_name
from ...drawing.painters.qt import number_width
from ...qt.context import Context
from ...qt.docks.instrument import PAD, Instrument
from ...qt.docks.plain import RowList, fill
from ...qt.files.files import Files
from ...qt.files.saving import ask_file, file_filter, save
from ...qt.look.form import in_column, in_row, push_button, quiet_label
from ...qt.look.look import LOOK, baseline
from ...scene.style import PINS, WAITING
from ...session.questions import vertex_at
from .answers import vertex_pairs
from .error_section import ErrorSection
from .gestures import PairGestures
from .maps import shows_maps
from .pairs import Pair, Pairs, add_pairs, half_pair, number_of, remove_pairs
from .quantity import predict, predicts, show_distances
from .row import PairRow, column_ends

ALONE = "Pairs need two meshes: open a second one."
NO_PANEL = "Panels can show where points of one mesh are on the other, by their distances."
HINT = "Click a point on either mesh, then its partner on the other."
NEXT = "Click the next point on either mesh."


class PairsDock(Instrument):
    """The list of pairs, with the errors of the maps that they make below it."""

    word = "pairs"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._list = RowList(self._new_row)
        self.rows: dict[str, PairRow] = self._list.rows
        self.hint = quiet_label(HINT, wraps=True)
        self.start = push_button("Show predictions", self.begin)
        self.back = push_button("Show distances", self.end_tool, "Panels show their distances again; the pairs stay")
        choose = context[Files].choose_second_mesh
        self.open_second_mesh = push_button("Open second mesh…", choose)
        self._gestures = context[PairGestures]
        self._gestures.chosen.connect(self.choose)
        self.accept = push_button("Accept", self._gestures.accept, "Take the best candidate as the partner (Enter)")
        self.accept.setObjectName("fill")
        self.or_click = quiet_label(wraps=True)
        self._head = _Columns()
        self.errors = ErrorSection(context)
        context.grid.activated.connect(lambda *_: self._show_rows(self.document))
        self._waiting, inside = QtWidgets.QWidget(), QtWidgets.QWidget()
        in_row(self.accept, (self.or_click, 1), of=self._waiting, spacing=8)
        parts = self._waiting, self.hint, self.start, self.back, self.open_second_mesh
        under = in_column(*parts, spacing=8, margins=(PAD, 10, PAD, 10))
        in_column(self._head, self._list, under, None, self.errors, of=inside, spacing=0)
        fill(self, inside)
        read = partial(ask_file, context, "Read pairs", file_filter("Pairs", (*PAIR_FORMATS, *LANDMARKS)), self.read)
        self.add_head_button("open", "Read pairs (lines i,j)…", read)
        self.add_head_button("save", "Save the pairs…", self.choose_and_save)
        menu = {
            "Discard the point without a partner\tEsc": self._gestures.cancel,
            "": None,
            "Remove all pairs": self.remove_all,
        }
        self.add_head_button("more", "More about pairs", menu)

    # ------------------------------------------------------------------ what is told
    def on_opened(self) -> None:
        """Let panels predict, if there are two surfaces and none does yet."""
        if len(self.document.surfaces) > 1 and not (predicts(self.document) or shows_maps(self.document)):
            self.begin()

    def show_document(self, document: Document, before: Document | None) -> None:
        self.note_changed.emit(str(len(document[Pairs].pairs)) if document[Pairs].pairs else "")
        self._show_rows(document)
        self.errors.show_document(document)

    def show_answer(self, panel: int) -> None:
        self._show_rows(self.document)
        self.errors.show_answer()

    def show_again(self) -> None:
        self.errors.show_again()

    def show_closed(self) -> None:
        self.errors.show_closed()
        self.context.grid.marks.highlight(self.word, ())

    def _show_rows(self, document: Document) -> None:
        half = half_pair(document)
        found = self._gestures.candidate(may_be_late=True) if half is not None else None
        wanted = {pair.points[0]: pair for pair in document[Pairs].pairs}
        self._list.show_rows(wanted)
        for point, pair in wanted.items():
            row = self.rows[point]
            guess = "" if found is None else f"{found[1].vertex} ?"
            colour = WAITING if pair.is_half else PINS[pair.colour]
            number = number_of(document, pair)
            row.show_pair(
                number, colour, self._place(pair.first) or guess, self._place(pair.second) or guess, pair.is_half
            )
            row.show_chosen(pair.points[0] in self.context.grid.marks.highlighted(self.word))
        is_alone, is_on = len(document.surfaces) < 2, predicts(document)
        other = "" if half is None else "B" if half.first else "A"
        self._head.setVisible(bool(document[Pairs].pairs))
        self._waiting.setVisible(half is not None and is_on)
        self.accept.setVisible(found is not None)
        hint = f"Click its partner on\u00a0{other}"
        if found is not None:
            by = kind_name(document.panel(found[0]).shows.specs[0].distance_type).lower()
            hint = f"Enter takes\u00a0{found[1].vertex}, by\u00a0{by}; or click another\u00a0vertex on\u00a0{other}"
        self.or_click.setText(hint)
        has_maps = shows_maps(document)  # the section of errors leads back to predictions
        self.hint.setVisible(is_alone or (not is_on and not has_maps) or (is_on and half is None))
        self.hint.setText(ALONE if is_alone else NO_PANEL if not is_on else NEXT if document[Pairs].pairs else HINT)
        self.start.setVisible(not is_alone and not is_on and not has_maps)
        self.back.setVisible(is_on or has_maps)
        self.open_second_mesh.setVisible(is_alone)

    def _place(self, name: str) -> str:
        """Return the vertex of a point in words, "" for no point."""
        if not name:
            return ""
        point = self.document.point(name)
        loaded = self.context.session.loaded(point.surface)
        return "" if loaded is None else str(vertex_at(point.at, loaded.surface))

    def _new_row(self, point: str) -> PairRow:
        row = PairRow(point)
        row.chosen.connect(self._gestures.choose)
        row.removed.connect(self._remove)
        row.stepped.connect(self._step)
        row.accepted.connect(self._gestures.accept)
        return row

    def choose(self, point: str) -> None:
        """Highlight the row of this point's pair."""
        if self.word not in self.document.docks:
            return
        for row in self.rows.values():
            row.show_chosen(bool(point) and point in self._pair(row.point).points)

    # ------------------------------------------------------------------ edits
    def _pair(self, point: str) -> Pair:
        return next(pair for pair in self.document[Pairs].pairs if point in pair.points)

    def begin(self) -> None:
        """Show the first surface in one panel, and the second in a panel for each distance, which predicts by it."""
        self.context.session.show(predict(self.document))

    def end_tool(self) -> None:
        """Show distances again in place of predictions and maps."""
        document = predict(self.document) if shows_maps(self.document) else self.document
        self.context.session.show(show_distances(document))

    def leave(self) -> None:
        """Let panels show distances again."""
        if predicts(self.document) or shows_maps(self.document):
            self.end_tool()
            self.context.tell("The panels show distances again; Ctrl+Z brings the predictions back")

    def _remove(self, point: str) -> None:
        """Remove a pair, and give the focus to the next row or the last."""
        had_keys = self.rows[point].hasFocus()
        after = self._list.after_removal(point) if had_keys else ""
        self.context.session.show(remove_pairs(self.document, [self._pair(point)]))
        self._gestures.choose(after)
        if after:
            self.rows[after].setFocus()

    def _step(self, point: str, by: int) -> None:
        """Move the focus to the row above or below."""
        beside = self._list.beside(point, by)
        if beside:
            self.rows[beside].setFocus(QtCore.Qt.FocusReason.TabFocusReason)
            self._gestures.choose(beside)

    def remove_all(self) -> None:
        """Remove all pairs."""
        self.context.session.show(remove_pairs(self.document, self.document[Pairs].pairs))

    # ------------------------------------------------------------------ files
    def read(self, path: str) -> None:
        """Add the pairs of a file, or say why it cannot be read."""
        session, document = self.context.session, self.document
        loaded = [session.loaded(mesh.name) for mesh in document.surfaces[:2]]
        with self.context.errors_shown():
            surfaces = [each.surface for each in loaded if each is not None]
            facts: list[str] = []
            found = read_pairs(path, surfaces if len(surfaces) == 2 else (), facts.append)
            changed = add_pairs(document, [(int(i), int(j)) for i, j in found])
            session.show(changed)
            new = len(changed[Pairs].pairs) - len(document[Pairs].pairs)
            known = f", {len(found) - new} of them already there" if new < len(found) else ""
            self.context.tell(" ".join([f"Read {len(found):,} pairs from {Path(path).name}{known}", *facts]))

    def choose_and_save(self) -> None:
        """Ask for a file, and write the pairs."""
        session, document = self.context.session, self.document
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
        y = round(baseline(painter, self.height() / 2))
        for letter, right in zip("AB", column_ends(self.width()), strict=True):
            painter.drawText(QtCore.QPointF(right - number_width(painter.font(), letter), y), letter)
        painter.fillRect(0, self.height() - 1, self.width(), 1, QtGui.QColor(theme.border))
