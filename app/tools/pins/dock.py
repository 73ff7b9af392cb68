"""The dock of pins: a list with what every panel has there, the distances among them, and files of both."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import ParameterError, Surface, VertexError
from bihdist_core.arrays import FloatArray
from bihdist_core.counts import counted
from bihdist_core.distances.answers import Answer
from bihdist_core.formats.pins import PIN_FORMATS, Pins as FilePins, read_pins, write_pins
from bihdist_core.sources.words import short_words_of, source_from_words

from ...document.document import Document
from ...document.edits import move_source
from ...document.file_names import file_name
from ...document.quantities import column_names
from ...document.shared_parts.pins import Pin, Pins, add_pins, change_pin, move_pin, remove_pins
from ...drawing.numbers import coordinates, number, percent, share
from ...qt.context import Context
from ...qt.docks.instrument import Instrument
from ...qt.files.saving import ask_file, ask_path, file_filter
from ...qt.look.controls import Segments, TextBox, mark_wrong
from ...qt.look.form import error_label, in_column, in_row, quiet_label
from ...qt.panels.badges import add_colours
from ...qt.panels.events import MarkClick
from ...qt.panels.flat_button import add_entry, menu_button
from ...qt.panels.parameters import empty_menu
from ...scene.style import PINS
from ...session.questions import source_at
from .distances import PinDistances
from .locations import LocatedPin, located_pins, matrix_text, pins_text, pins_to_write, with_pins
from .part import PinsListing
from .table import PinRow, PinTable

PIN_FILES = file_filter("Pins", PIN_FORMATS)


class PinFiles:
    """Pins in files and on the clipboard; `pins()` returns those that there are now."""

    def __init__(self, context: Context, pins: Callable[[], Sequence[LocatedPin]]) -> None:
        self._context, self._pins = context, pins

    def save(self, path: str = "") -> None:
        """Write the pins, and say how far those in faces are from the vertices that are written.

        Asks for a path if none is given.
        """
        surface = self._context.session.mesh().surface
        path = path or ask_path(self._context, "Save pins", file_name([surface.name], "pins"), PIN_FORMATS)
        if not path:
            return
        with self._context.errors_shown():
            written = pins_to_write(self._pins(), surface)
            write_pins(path, surface, written)
            remark = snapped(written, surface)
            saved = f"Saved {counted(len(written), 'pin')} in {Path(path).name}"
            self._context.tell(f"{saved}: {remark}" if remark else saved)

    def read(self, path: str) -> None:
        """Add the pins of a file, and say how far they were from vertices."""
        session = self._context.session
        document, surface = session.document, session.mesh().surface
        with self._context.errors_shown():
            found = read_pins(path, surface)
            session.show(with_pins(document, found, document.surfaces[0].name))
            read = f"Read {counted(len(found), 'pin')} from {Path(path).name}"
            self._context.tell(". ".join([snapped(found, surface) or read, *found.facts]))

    def copy_list(self, answers: Sequence[tuple[str, Answer]]) -> None:
        """Copy the list with all digits, with a tab between columns."""
        text = pins_text(self._pins(), self._context.session.mesh().surface, answers)
        self._context.copy(text, "The list of pins is on the clipboard")

    def copy_matrix(self, matrix: FloatArray) -> None:
        """Copy the distances among the pins, with a tab between columns."""
        self._context.copy(matrix_text(self._pins(), matrix), "The distances among pins are on the clipboard")


def snapped(pins: FilePins, surface: Surface) -> str:
    """Return a sentence on pins of a file that were moved to vertices, "" if none was by more than rounding."""
    size = float(np.ptp(surface.vertices, axis=0).max())
    far = np.flatnonzero(pins.moved > 1e-9 * size)
    if not len(far):
        return ""
    most = int(far[pins.moved[far].argmax()])
    of_size = share(float(pins.moved[most]) / size) if size else ""
    return (
        f"{counted(len(far), 'pin')} moved to a vertex, the farthest, {pins.ids[most]}, by "
        f"{number(float(pins.moved[most]))} ({of_size} of the mesh's size)"
    )


PAD = 12
EMPTY = "Shift+click a surface to pin a point, or type vertex ids."
WORD = re.compile(r"f[0-9]+:[^,;\s]*,[^,;\s]*|[^,;\s]+")
"""A typed word; a point in a face has a comma of its own."""


class IdBox(TextBox):
    """Enter adds; Escape leaves."""

    left = QtCore.Signal()

    def event(self, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.ShortcutOverride and event.key() == QtCore.Qt.Key.Key_Escape:
            event.accept()  # before the window takes it
            return True
        return super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == QtCore.Qt.Key.Key_Escape:
            self.clear()
            self.textEdited.emit("")  # what was wrong is gone
            self.left.emit()
        else:
            super().keyPressEvent(event)


class PinsDock(Instrument):
    """The list of pins with their values in every panel, and the distances among them."""

    word = "pins"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.places: tuple[LocatedPin, ...] = ()
        self._is_split = False
        self.files = PinFiles(context, lambda: self.places)
        self.row_menu = QtWidgets.QMenu(self)
        self.box = IdBox(placeholderText="Add ids, e.g. 12, 40", accessibleName="Add pins at vertex ids")
        self.box.returnPressed.connect(self._add)
        self.box.textEdited.connect(self._forgive)
        self.box.left.connect(context.focus_panels)
        self.ways = Segments({"Value": "value", "% of max": "share"}, "Values")
        self.ways.chosen.connect(lambda word: self.list_otherwise(shares=word == "share"))
        self.wrong = error_label()
        self.table = PinTable(self)
        self.table.chosen.connect(partial(context.grid.marks.highlight, "pins"))
        context.grid.events.on(MarkClick, self._choose)
        self.table.named.connect(self.rename)
        self.table.moved.connect(self.move_to)
        self.table.removed.connect(self.remove)
        self.table.menu_wanted.connect(self._open_row_menu)
        self.empty = quiet_label(EMPTY, wraps=True)
        self.empty.setContentsMargins(PAD, 4, PAD, 4)
        self.empty.setAlignment(QtCore.Qt.AlignmentFlag.AlignTop)
        self.distances = PinDistances(context)
        self._soon = QtCore.QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._show_rows)
        top = in_row((self.box, 1), self.ways, spacing=8, margins=(PAD, 8, PAD, 4))
        self.wrong.setContentsMargins(PAD, 0, PAD, 4)
        upper = QtWidgets.QWidget()
        in_column(top, self.wrong, self.empty, (self.table, 1), of=upper, spacing=0)
        self._splitter = QtWidgets.QSplitter(QtCore.Qt.Orientation.Vertical, childrenCollapsible=False)
        self._splitter.setHandleWidth(1)
        self._splitter.addWidget(upper)
        self._splitter.addWidget(self.distances)
        self._splitter.splitterMoved.connect(self._keep_split)
        in_column(self._splitter, of=self, spacing=0)
        self.table.setMinimumHeight(90)
        self.add_head_button("copy", "Copy the list, with all digits", self.copy_list)
        self.add_head_button("save", "Save pins…", self.files.save)
        tip = "Read, copy, rename, colour, move, remove"
        self.head.append(menu_button(self, self._fill_menu, tip, "More about pins", "more"))

    def _keep_split(self, *_: int) -> None:
        self._is_split = True

    def _split(self) -> None:
        """Give the list as much room as it needs, unless the user has moved the splitter."""
        if not self._is_split:
            rows = self.table.verticalHeader().defaultSectionSize() * (len(self.places) + 1)
            upper = rows + self.box.height() + 44
            self._splitter.setSizes([upper, max(self.height() - upper, 1)])

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._split()

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        loaded = self.context.session.loaded()
        if loaded is None:
            return
        self.places = located_pins(document, document.surfaces[0].name, loaded.surface)
        self.ways.choose("share" if document[PinsListing].shares else "value")
        self.note_changed.emit(str(len(self.places)) if self.places else "")
        self.empty.setVisible(not self.places)
        self.table.setVisible(bool(self.places))
        self._show_rows()
        self.distances.show_pins(document, self.places)
        self._split()

    def show_answer(self, panel: int) -> None:
        self._soon.start()

    def _choose(self, panel: int, mark: MarkClick) -> None:
        """Select the row of a pin marker that was clicked, or deselect it if it is the only one; with Ctrl, besides
        the others."""
        if mark.tool == self.word in self.document.docks:
            point, chosen = self.document[Pins].pins[mark.number - 1].point, set(self.table.points)
            self.table.select(tuple(chosen ^ {point}) if mark.has_ctrl else () if chosen == {point} else (point,))

    def end(self) -> None:
        self.distances.end()

    def show_closed(self) -> None:
        self.table.clearSelection()

    # ------------------------------------------------------------------ the list
    def answers(self) -> list[tuple[str, Answer, bool]]:
        """Return for each panel the head of its column, its answer, and whether that is still to change."""
        session, panels = self.context.session, self.document.panels_of()
        found = []
        for panel, title in zip(panels, column_names([panel.shows for panel in panels]), strict=True):
            answer = session.answer(panel.id) or Answer(label=title)
            found.append((title, answer, not session.is_answered(panel.id)))
        return found

    def _show_rows(self) -> None:
        loaded = self.context.session.loaded()
        if loaded is None:
            return
        answers = self.answers()
        listed = self.document[PinsListing]
        rows = []
        for place in self.places:
            at = place.position(loaded.surface.vertices)
            position = coordinates(at, loaded.surface.mean_edge_length)
            values = position.split("  ") if listed.positions else []
            tips, quiet = [""] * len(values), [False] * len(values)
            for title, answer, is_old in answers:
                one, other = value_and_fraction(place, answer)
                values.append(other if listed.shares else one)
                tips.append(f"{answer.label or title}: {one} {answer.unit}{f' ({other})' if other else ''}")
                quiet.append(is_old)
            text = f"{place.name}: {short_words_of(place.at)} at {position}"
            about = place.point, place.number, PINS[place.pin.colour], place.pin.name, place.words, text
            rows.append(PinRow(*about, tuple(values), tuple(tips), tuple(quiet)))
        titles = [title for title, _, _ in answers]
        short = column_names([panel.shows for panel in self.document.panels_of()], are_short=True)
        labels = [answer.label or title for title, answer, _ in answers]
        if listed.positions:
            titles, short, labels = [*"xyz", *titles], [*"xyz", *short], [*["Position"] * 3, *labels]
        self.table.show_rows(rows, titles, short, labels)

    def list_otherwise(self, **changes: Any) -> None:
        """Change fields of the document's `PinsListing`."""
        self.context.session.apply(lambda document: document.with_changed(PinsListing, **changes))

    def copy_matrix(self) -> None:
        """Copy the distances among the pins."""
        matrix = self.distances.matrix()
        if matrix is not None and len(matrix) > 1:
            self.files.copy_matrix(matrix)

    def copy_list(self) -> None:
        """Copy the list to the clipboard with all digits."""
        if self.places:
            self.files.copy_list([(title, answer) for title, answer, _ in self.answers()])

    # ------------------------------------------------------------------ menus
    def _open_row_menu(self, where: QtCore.QPoint) -> None:
        """Open the menu of the selected rows at a place of the screen."""
        empty_menu(self.row_menu)
        self._add_row_actions(self.row_menu)
        self.row_menu.popup(where)

    def _fill_menu(self, menu: QtWidgets.QMenu) -> None:
        has_pins, are_listed = bool(self.places), self.document[PinsListing].positions
        menu.addAction("Read pins…", lambda: ask_file(self.context, "Read pins", PIN_FILES, self.files.read))
        add_entry(menu, "Save pins…", self.files.save, can=has_pins)
        menu.addSeparator()
        add_entry(menu, "Copy the list", self.copy_list, can=has_pins)
        add_entry(menu, "Copy the distances", self.copy_matrix, can=len(self.places) > 1)
        menu.addSeparator()
        add_entry(menu, "Show positions", lambda: self.list_otherwise(positions=not are_listed), are_listed)
        if self.table.points:
            menu.addSeparator()
            self._add_row_actions(menu)
        menu.addSeparator()
        add_entry(menu, "Remove all pins", lambda: self.remove(self.document[Pins].points), can=has_pins)

    def _add_row_actions(self, menu: QtWidgets.QMenu) -> None:
        points = self.table.points
        is_one = len(points) == 1
        add_entry(menu, "Source here", lambda: self._move_source(points), can=is_one)
        add_entry(menu, "Rename\tF2", self.table.rename, can=is_one)
        add_colours(menu, self.recolour)
        add_entry(menu, "Move up\tAlt+Up", lambda: self.table.move(-1), can=is_one)
        add_entry(menu, "Move down\tAlt+Down", lambda: self.table.move(1), can=is_one)
        words = "Remove pin\tDel" if is_one else f"Remove {len(points)} pins\tDel"
        menu.addAction(words, lambda: self.remove(points))

    def _move_source(self, points: tuple[str, ...]) -> None:
        """Move the source of the active panel to the one pin among these, if it is still there."""
        for place in self.places:
            if points == (place.point,):
                self.context.session.show(move_source(self.document, self.context.grid.active, place.at))

    # ------------------------------------------------------------------ edits
    def _add(self) -> None:
        """Add pins at the vertices or points in faces that are typed."""
        surface = self.context.session.mesh().surface
        words = WORD.findall(self.box.text())
        if not words:
            return
        for word in words:
            is_place = word.startswith("f")
            if not is_place and (not (word.isascii() and word.isdigit()) or int(word) >= len(surface.vertices)):
                self._refuse(f"No {surface.nouns[0]} {word[:20]} here: 0 to {len(surface.vertices) - 1}")
                return
        try:
            places = [source_at(source_from_words(word), surface) for word in words]
            document = self.document
            pinned = add_pins(document, places, document.surfaces[0].name)
        except (VertexError, ParameterError) as error:
            self._refuse(str(error))
            return
        if pinned == document:
            one = f"Vertex {places[0]}" if isinstance(places[0], int) else "This place"
            self._refuse(f"{one} has a pin already." if len(set(places)) == 1 else "These points have pins already.")
            return
        self.context.session.show(pinned)
        self.box.clear()

    def _refuse(self, sentence: str) -> None:
        mark_wrong(self.box, True)
        self.wrong.setText(sentence)
        self.wrong.show()
        self.box.selectAll()

    def _forgive(self) -> None:
        mark_wrong(self.box, False)
        self.wrong.hide()

    def rename(self, point: str, name: str) -> None:
        """Give the pin at a point another name."""
        self.context.session.apply(lambda document: change_pin(document, replace(self._pin(point), name=name)))

    def recolour(self, colour: int) -> None:
        """Give a colour to the pins whose rows are selected."""

        def coloured(document: Document) -> Document:
            for point in self.table.points:
                document = change_pin(document, replace(self._pin(point), colour=colour))
            return document

        self.context.session.apply(coloured)

    def move_to(self, point: str, place: int) -> None:
        """Put a pin at a place among the others, 0 for the first."""
        self.context.session.apply(lambda document: move_pin(document, point, place))

    def remove(self, points: Sequence[str]) -> None:
        """Remove the pins at these points."""
        self.context.session.apply(lambda document: remove_pins(document, points))

    def _pin(self, point: str) -> Pin:
        return next(place.pin for place in self.places if place.point == point)


def value_and_fraction(place: LocatedPin, answer: Answer) -> tuple[str, str]:
    """Return an answer's value at a pin, and its fraction of the maximum; "–" where there is none."""
    value = np.nan if answer.field is None else place.value(answer.field)
    if np.isnan(value):
        return "–", "–"
    text = number(value, answer.is_signed) + percent(answer.unit)
    if answer.signs:
        return text, text  # in percentage points, or in a unit of which no maximum is a whole
    return text, share(value / answer.maximum, answer.is_signed) if answer.maximum > 0 else "–"
