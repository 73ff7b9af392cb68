"""The dock of pins: a list with what every panel has there, and below it the distances among them."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import ParameterError, VertexError
from bihdist_core.distances.answers import Answer
from bihdist_core.sources.words import short_words_of, source_from_words

from ...document.document import Document
from ...document.quantities import quantity_name
from ...document.shared_parts.pins import Pin, Pins, add_pins, change_pin, move_pin, remove_pins
from ...qt.context import Context
from ...qt.docks.instrument import Instrument
from ...qt.look.numbers import number, percent, share
from ...qt.look.segments import Segments
from ...qt.look.text_box import TextBox, mark_wrong
from ...qt.panels.events import MarkClick
from ...qt.panels.flat_button import FlatButton
from ...scene.style import PINS
from ...session.questions import source_at
from .distances import PinDistances
from .files import PinFiles
from .locations import LocatedPin, located_pins
from .menus import PinMenu
from .part import PinsListing
from .table import PinRow, PinTable

PAD = 12
EMPTY = "Shift+click a surface to pin a point, or type vertex ids."
WORD = re.compile(r"f[0-9]+:[^,;\s]*,[^,;\s]*|[^,;\s]+")
"""Of what is typed: a place in a face has a comma of its own."""


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
    """See the module."""

    word, title = "pins", "Pins"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.places: tuple[LocatedPin, ...] = ()
        self._is_split = False
        self.files = PinFiles(context, lambda: self.places)
        self.menu = PinMenu(self)
        self.box = IdBox(placeholderText="Add ids, e.g. 12, 40")
        self.box.setAccessibleName("Add pins at vertex ids")
        self.box.returnPressed.connect(self._add)
        self.box.textEdited.connect(self._forgive)
        self.box.left.connect(context.focus_panels)
        self.ways = Segments({"Value": "value", "% of max": "share"}, "Values")
        self.ways.chosen.connect(self._choose_way)
        self.wrong = QtWidgets.QLabel(visible=False, wordWrap=True)
        self.wrong.setProperty("error", True)
        self.table = PinTable(self)
        self.table.chosen.connect(partial(context.grid.marks.light, "pins"))
        context.grid.events.on(MarkClick, self._choose)
        self.table.rows.named.connect(self.rename)
        self.table.moved.connect(self.move_to)
        self.table.removed.connect(self.remove)
        self.table.menu_wanted.connect(self.menu.open_for_rows)
        self.empty = QtWidgets.QLabel(EMPTY, wordWrap=True)
        self.empty.setProperty("quiet", True)
        self.empty.setContentsMargins(PAD, 4, PAD, 4)
        self.empty.setAlignment(QtCore.Qt.AlignmentFlag.AlignTop)
        self.distances = PinDistances(context)
        self._soon = QtCore.QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._show_rows)
        self._lay_out()

    def _lay_out(self) -> None:
        top = QtWidgets.QHBoxLayout()
        top.setContentsMargins(PAD, 8, PAD, 4)
        top.setSpacing(8)
        top.addWidget(self.box, 1)
        top.addWidget(self.ways)
        self.wrong.setContentsMargins(PAD, 0, PAD, 4)
        upper = QtWidgets.QWidget()
        column = QtWidgets.QVBoxLayout(upper, spacing=0)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(top)
        column.addWidget(self.wrong)
        column.addWidget(self.empty)
        column.addWidget(self.table, 1)
        self._splitter = QtWidgets.QSplitter(QtCore.Qt.Orientation.Vertical, childrenCollapsible=False)
        self._splitter.setHandleWidth(1)
        self._splitter.addWidget(upper)
        self._splitter.addWidget(self.distances)
        self._splitter.splitterMoved.connect(self._keep_split)
        whole = QtWidgets.QVBoxLayout(self, spacing=0)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(self._splitter)
        self.table.setMinimumHeight(90)

    def _keep_split(self, *_: int) -> None:
        self._is_split = True

    def _split(self) -> None:
        """As much for the list as it needs, unless the user has said where it ends."""
        if not self._is_split:
            rows = self.table.verticalHeader().defaultSectionSize() * (len(self.places) + 1)
            upper = rows + self.box.height() + 44
            self._splitter.setSizes([upper, max(self.height() - upper, 1)])

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._split()

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        copy, save, more = (FlatButton(self, icon) for icon in ("copy", "save", "more"))
        for button, tip, do in (
            (copy, "Copy the list, with all digits", self.copy_list),
            (save, "Save pins…", self.files.choose_and_save),
        ):
            button.setToolTip(tip)
            button.setAccessibleName(tip)
            button.activated.connect(do)
        more.setToolTip("Read, copy, rename, colour, move, remove")
        more.setAccessibleName("More about pins")
        more.setMenu(self.menu.whole)
        return [copy, save, more]

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
        """A pin marker has been clicked: its row is selected, or only it is no longer; with Ctrl besides the others."""
        if mark.tool == self.word in self.context.document.docks:
            point, chosen = self.context.document[Pins].pins[mark.number - 1].point, set(self.table.points)
            self.table.select(tuple(chosen ^ {point}) if mark.has_ctrl else () if chosen == {point} else (point,))

    def end(self) -> None:
        self.distances.end()

    def show_closed(self) -> None:
        self.table.clearSelection()

    # ------------------------------------------------------------------ the list
    def answers(self) -> list[tuple[str, Answer, bool]]:
        """Of each panel: the head of its column, what it shows, and whether that is still to change."""
        session = self.context.session
        document, name = session.document, session.document.surfaces[0].name
        panels = [panel for panel in document.panels if panel.surface == name]
        names = [quantity_name(panel.shows) for panel in panels]
        found = []
        for panel, short in zip(panels, names, strict=True):
            shown = session.shown.get(panel.id)
            title = str(panel.shows) if names.count(short) > 1 else short
            answer = shown.answer if shown is not None else Answer(label=title)
            found.append((title, answer, not session.is_answered(panel.id)))
        return found

    def _show_rows(self) -> None:
        surface = self.context.session.surface
        if surface is None:
            return
        answers = self.answers()
        listed = self.context.document[PinsListing]
        rows = []
        for place in self.places:
            at = place.position(surface.vertices)
            values = [number(x) for x in at] if listed.positions else []
            tips, quiet = [""] * len(values), [False] * len(values)
            for title, answer, is_old in answers:
                one, other = written(place, answer)
                values.append(other if listed.shares else one)
                tips.append(f"{answer.label or title}: {one} {answer.unit}{f' ({other})' if other else ''}")
                quiet.append(is_old)
            where = place.words
            text = f"{place.name}: {short_words_of(place.at)} at {' '.join(number(x) for x in at)}"
            colour = PINS[place.pin.colour]
            rows.append(
                PinRow(
                    place.point,
                    place.number,
                    colour,
                    place.pin.name,
                    where,
                    text,
                    tuple(values),
                    tuple(tips),
                    tuple(quiet),
                )
            )
        titles = [title for title, _, _ in answers]
        labels = [answer.label or title for title, answer, _ in answers]
        if listed.positions:
            titles, labels = [*"xyz", *titles], [*["Position"] * 3, *labels]
        self.table.show_rows(rows, titles, labels)

    def _choose_way(self, word: str) -> None:
        self.list_otherwise(shares=word == "share")

    @property
    def has_positions(self) -> bool:
        """Whether the list has columns of places."""
        return self.context.document[PinsListing].positions

    def show_positions(self, is_on: bool) -> None:
        """Show x, y and z in the list, or no longer."""
        self.list_otherwise(positions=is_on)

    def list_otherwise(self, **changes: Any) -> None:
        """Fields of the document's `PinsListing`."""
        self._show(lambda document: document.with_part(replace(document[PinsListing], **changes)))

    def copy_matrix(self) -> None:
        """The distances among the pins."""
        matrix = self.distances.matrix()
        if matrix is not None and len(matrix) > 1:
            self.files.copy_matrix(matrix)

    def copy_list(self) -> None:
        """Copy the list to the clipboard with all digits."""
        if self.places:
            self.files.copy_list([(title, answer) for title, answer, _ in self.answers()])

    # ------------------------------------------------------------------ edits
    def _show(self, make: Callable[[Document], Document], key: str = "") -> None:
        """Show what an edit makes of the document, or say why it cannot be."""
        session = self.context.session
        try:
            session.show(make(session.document), key)
        except ParameterError as error:
            self.context.fail(error)

    def _add(self) -> None:
        """Pins at the vertices, or the places in faces, that are typed."""
        surface = self.context.session.first_surface
        words = WORD.findall(self.box.text())
        if not words:
            return
        for word in words:
            is_place = word.startswith("f")
            if not is_place and (not (word.isascii() and word.isdigit()) or int(word) >= len(surface.vertices)):
                self._refuse(f"No vertex {word[:20]} here: 0 to {len(surface.vertices) - 1}")
                return
        try:
            places = [source_at(source_from_words(word), surface) for word in words]
            document = self.context.document
            pinned = add_pins(document, places, document.surfaces[0].name)
        except (VertexError, ParameterError) as error:
            self._refuse(str(error))
            return
        if pinned == document:
            one = f"Vertex {places[0]}" if isinstance(places[0], int) else "This place"
            self._refuse(f"{one} has a pin already." if len(set(places)) == 1 else "These have pins already.")
            return
        self.context.edit(pinned)
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
        self._show(lambda document: change_pin(document, replace(self._pin(point), name=name)))

    def recolour(self, colour: int) -> None:
        """The pins whose rows are selected."""

        def coloured(document: Document) -> Document:
            for point in self.table.points:
                document = change_pin(document, replace(self._pin(point), colour=colour))
            return document

        self._show(coloured)

    def move_to(self, point: str, place: int) -> None:
        """Put a pin at a place among the others, 0 for the first."""
        self._show(lambda document: move_pin(document, point, place))

    def move(self, step: int) -> None:
        """The pin whose row is selected, so many places on."""
        if len(self.table.points) == 1:
            points = [place.point for place in self.places]
            place = points.index(self.table.points[0]) + step
            if 0 <= place < len(points):
                self.move_to(self.table.points[0], place)

    def remove(self, points: Sequence[str]) -> None:
        """Remove the pins at these points."""
        self._show(lambda document: remove_pins(document, points))

    def _pin(self, point: str) -> Pin:
        return next(place.pin for place in self.places if place.point == point)


def written(place: LocatedPin, answer: Answer) -> tuple[str, str]:
    """An answer's value at a place, and its fraction of the maximum; "–" where there is none."""
    value = np.nan if answer.field is None else place.value(answer.field)
    if np.isnan(value):
        return "–", "–"
    text = number(value, answer.is_signed) + percent(answer.unit)
    if answer.signs:
        return text, text  # in percentage points, or in a unit of which no maximum is a whole
    return text, share(value / answer.maximum, answer.is_signed) if answer.maximum > 0 else "–"
