"""The line over a panel: what it shows, the parameters, and the panel's own menu."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from html import escape

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import Surface
from bihdist_core.distances.distance_types import Spec, Value

from ...document.panel_edits import panel_edits
from ...document.quantities import Difference, Quantity, kind_name, quantity_name
from ...document.repairs import OPERATORS
from ...drawing.painters.qt import paint, rgba_of
from ...drawing.shapes import Box, Path, Shape, Text, disc, rounded
from ..look.form import in_column
from ..look.icons import pixmap
from ..look.look import LOOK, smooth_painter
from .flat_button import ICON_SIDE, FlatButton
from .number_box import ReadPopUp
from .parameters import ChoiceControl, Control, FixedWord, NumberControl, parameter_control, signs
from .quantity_menu import RAW_WORDS, Choices, fill_menu, offered_kinds

HEIGHT, COMPACT_HEIGHT = 36, 32

SLIDERS_FROM, ALL_FROM, FIRST_FROM = 440, 300, 200
"""Widths from which there are sliders and the button with remarks, all parameters, the first of them."""

MARGIN, BETWEEN = 8, 4
WARNING_ROOM = 22
LETTER_SIDE, LETTER_ROOM = 18, 24
"""Side of the badge with the letter of the surface, and its room with the space beside it."""

EXACT = "exact"
"""The method of quantities that leave out no eigenpair."""

DOT_ROOM, DOT = 13, 4.0
"""Room for the dot of a curve, and its radius."""


class PanelHead(QtWidgets.QWidget):
    """One line that says what a panel shows and changes it.

    `changed(Quantity)` for each choice; `asked(str)`, the text of a `PanelEdit`; `save_wanted()` for a file of the
    field; `clicked()` when it is pressed or reached by keyboard.  With less room, words go into the menus; the name is
    cut last.
    """

    changed = QtCore.Signal(object)
    let_go = QtCore.Signal()  # of a slider
    asked = QtCore.Signal(str)
    save_wanted = QtCore.Signal()
    clicked = QtCore.Signal()

    def __init__(self, shows: Quantity, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.shows = shows
        self.controls: list[Control] = []
        self._choices = Choices()
        self._made_of: object = None
        self._method: tuple[tuple[Spec, ...], str, bool] = ((), "", False)
        self._info = self._warning = self._dot = self.letter = self._plain = self._name = ""
        # Panels are equally wide whatever is in here.
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)
        self.name = FlatButton(self, bold=True)
        menu = QtWidgets.QMenu(self, toolTipsVisible=True)
        menu.aboutToShow.connect(lambda: self._fill_name_menu(menu))
        self.name.setMenu(menu)
        self.warning = QtWidgets.QLabel(self, visible=False)
        self.info = FlatButton(self, "info")
        self.info.setAccessibleName("What to look for, and how exact it is")
        self.info.activated.connect(lambda: self._open_info(self.info))
        self.more = FlatButton(self, "more")
        self.more.setToolTip("Add, duplicate, move or remove panels, save the field")
        self.more.setAccessibleName("The panel: add, duplicate, move, remove, save")
        self.more.setMenu(QtWidgets.QMenu(self, toolTipsVisible=True))
        self._about = self.more.menu().addAction("What to look for…")
        self._about.triggered.connect(lambda: QtCore.QTimer.singleShot(0, lambda: self._open_info(self.more)))
        self._line_under_about = self.more.menu().addSeparator()
        self.edits = {word: self.more.menu().addAction(word) for word in panel_edits()}
        for word, action in self.edits.items():
            action.setCheckable(panel_edits()[word].is_on is not None)
            action.triggered.connect(lambda *_, word=word: self.asked.emit(word))
        self.more.menu().addSeparator()
        self.more.menu().addAction("Save field…").triggered.connect(self.save_wanted)
        self._sheet = ReadPopUp(self)
        self._sheet_words = QtWidgets.QLabel(self._sheet, wordWrap=True)
        self._sheet_words.setFixedWidth(280)
        in_column(self._sheet_words, of=self._sheet, margins=(12, 10, 12, 12))
        for widget in (self.name, self.info, self.more):
            widget.installEventFilter(self)
        self.set_compact(False)
        LOOK.changed.connect(self._restyle)
        self.show_quantity(shows)
        self.show_info("")
        self.show_warning("")

    # ------------------------------------------------------------------ what is told
    def show_quantity(self, shows: Quantity, fields: Sequence[str] | None = None) -> None:
        """Show a quantity, without emitting; `fields` are the user's own that are there to choose."""
        self.shows = shows
        if fields is not None:
            self._choices.fields = tuple(fields)
        self._choices.keep(shows)
        bounded = [self._choices.bounded(p) for spec in shows.parametrised for p in spec.distance_type.parameters]
        made_of = (type(shows), *(part.word for part in shows.parts), *bounded)
        # Controls that fit stay, as a hand may be on one of them.
        if made_of != self._made_of:
            self._made_of = made_of
            self._make_controls()
        self._name = self._plain or quantity_name(shows)
        self._show_values()
        self._show_method()
        self.name.setToolTip(f"{self._name}\nClick to show something else here")
        self.name.setAccessibleName(f"Shown here: {self._name}")
        self.show_info(self._info)

    def show_surface(self, surface: Surface | None) -> None:
        """Show which surface it is on, where parameters have their bounds; None for none any more."""
        self._choices.surface, self._method = surface, ((), "", False)
        if surface is not None:
            self.show_quantity(self.shows)

    def allow(self, words: set[str], ticked: set[str]) -> None:
        """Let the panel's edits be offered that are possible, with ticks at those that are on."""
        for word, action in self.edits.items():
            action.setEnabled(word in words)
            action.setChecked(word in ticked)

    def show_method(self, specs: tuple[Spec, ...], label: str, is_preview: bool = False) -> None:
        """Show what the field has been computed by, "geodesic, heat method", for the control that says "auto", and of a
        stand-in for any; and another operator than the paper's."""
        operator = label.rpartition(", ")[2]
        for control in self.controls:
            if isinstance(control, FixedWord):
                control.setText(f"{EXACT}, {operator}" if operator in OPERATORS else EXACT)
                self._lay_out()
        self._method = specs, label.partition(", ")[2].partition(",")[0], is_preview
        self._show_method()

    def _show_method(self) -> None:
        specs, method, is_preview = self._method
        control = self._of_parameter.get((0, "method"))
        if isinstance(control, ChoiceControl) and not self.shows.is_difference:
            control.show_actual(method if specs == self.shows.specs else "", is_preview)
            self._lay_out()

    def show_info(self, text: str) -> None:
        """Show what to look for, the accuracy and remarks, as rich text; empty for the hint alone."""
        self._info = text
        hint = self.shows.hint
        html = text or f"{escape(hint[:1].upper() + hint[1:])}."
        if self._warning:
            html += f"<p>{escape(self._warning)}</p>"
        # A plain sentence on one line would become a tip as wide as the screen.
        self.info.setToolTip(f"<qt>{html}</qt>")
        self._sheet_html = html  # laid out when somebody wants to read it

    def show_warning(self, text: str) -> None:
        """Warn that the answer is poor, and why; empty for one that is not."""
        if text == self._warning:
            return
        self._warning = text
        self.warning.setToolTip(text)
        self.warning.setAccessibleName(text)
        self.show_info(self._info)
        self._restyle()

    def show_letter(self, letter: str, name: str) -> None:
        """Show the letter of the panel's surface, where there are two, and that surface's name; "" for none."""
        self.setToolTip(f"{letter}: {name}" if letter else "")
        self._choices.has_other = bool(letter)
        if letter != self.letter:
            self.letter = letter
            self._lay_out()
            self.update()

    def show_plain(self, name: str) -> None:
        """Show the name of a surface without a field; "" where the head says what is shown on it."""
        if name != self._plain:
            self._plain = name
            self.show_quantity(self.shows)

    def show_dot(self, colour: str) -> None:
        """Show the dot of the panel's curve in a plot that is open; "" for none."""
        if colour != self._dot:
            self._dot = colour
            self._lay_out()
            self.update()

    def set_compact(self, compact: bool) -> None:
        """Set whether the head is lower, for a panel with little height."""
        self._is_compact = compact
        self.setFixedHeight(round((COMPACT_HEIGHT if compact else HEIGHT) * LOOK.scale))

    # ------------------------------------------------------------------ choices
    @property
    def is_held(self) -> bool:
        """Whether the user holds the slider of a parameter."""
        return any(isinstance(control, NumberControl) and control.is_held for control in self.controls)

    def _choose(self, shows: Quantity) -> None:
        if shows != self.shows:
            self.show_quantity(shows)
            self.changed.emit(shows)

    def _set(self, place: int, name: str, value: object) -> None:
        parts = list(self.shows.parts)
        (spec,) = parts[place].parametrised
        parts[place] = parts[place].with_spec(spec.changed(**{name: value}))
        self._choose(self.shows.with_parts(tuple(parts)))

    def _subtract(self, raw: bool) -> None:
        if isinstance(self.shows, Difference):
            self._choose(replace(self.shows, raw=raw))

    def _fill_name_menu(self, menu: QtWidgets.QMenu) -> None:
        fill_menu(menu, self.shows, self._choices, self._choose)
        # How a difference is taken stands in this menu anyway.
        hidden = [c for c in self.controls if not c.isVisibleTo(self) and c is not self._mode]
        if any(not isinstance(control, FixedWord) for control in hidden):
            menu.addSeparator()
        for control in hidden:
            control.add_to(menu)

    def _open_info(self, control: QtWidgets.QWidget) -> None:
        self._sheet_words.setText(self._sheet_html)
        self._sheet.open_under(control)

    # ------------------------------------------------------------------ parameters
    def _make_controls(self) -> None:
        for control in self.controls:
            control.hide()
            control.deleteLater()
        having = [part.parametrised[0] for part in self.shows.parts if part.parametrised]
        signed = iter(signs([p for spec in having for p in spec.distance_type.parameters]))
        self._mode: ChoiceControl | None = None
        self._by: ChoiceControl | None = None
        self._of_parameter: dict[tuple[int, str], Control] = {}
        is_difference = self.shows.is_difference
        for place, part in enumerate(self.shows.parts):
            for parameter in part.parametrised[0].distance_type.parameters if part.parametrised else ():
                of_what = f" ({('first', 'second')[place]}: {part.heading})" if is_difference else ""
                bounded = self._choices.bounded(parameter)
                control = parameter_control(self, bounded, next(signed), of_what)
                control.chosen.connect(partial(self._set, place, parameter.name))
                if isinstance(control, NumberControl):
                    control.let_go.connect(self.let_go)
                self._of_parameter[place, parameter.name] = control
        self.controls = list(self._of_parameter.values())
        if is_difference:
            self._mode = ChoiceControl(self, RAW_WORDS, "How the two are subtracted")
            self._mode.chosen.connect(self._subtract)
            self.controls.append(self._mode)
        elif self.shows.done:
            words: dict[Value, str] = {kind.word: f"by {kind_name(kind).lower()}" for kind in offered_kinds()}
            short: dict[Value, str] = {
                kind.word: f"by {(kind.short or kind_name(kind)).lower()}" for kind in offered_kinds()
            }
            self._by = ChoiceControl(self, words, f"By which distance it is {self.shows.done}", short)
            self._by.chosen.connect(lambda word: self._choose(self._choices.with_part(self.shows, 0, word)))
            self.controls.insert(0, self._by)
        elif not self.controls and any(spec.distance_type.is_complete for spec in self.shows.parametrised):
            self.controls.append(FixedWord(self, EXACT, "Uses all eigenpairs; nothing to choose"))
        order: list[QtWidgets.QWidget] = [self.name]
        for control in self.controls:
            inside: list[QtWidgets.QWidget] = [control]
            if isinstance(control, NumberControl):
                inside = [control.slider, control.button]
            order += [each for each in inside if not isinstance(control, FixedWord)]
            for each in inside:
                each.installEventFilter(self)
        for before, after in zip(order, [*order[1:], self.info], strict=True):
            self.setTabOrder(before, after)
        self.setTabOrder(self.info, self.more)

    def _show_values(self) -> None:
        for (place, name), control in self._of_parameter.items():
            control.show_value(self.shows.parts[place].parametrised[0][name])
        if self._mode is not None and isinstance(self.shows, Difference):
            self._mode.show_value(self.shows.raw)
        if self._by is not None:
            self._by.show_value(self.shows.specs[0].word)
        self._lay_out()

    # ------------------------------------------------------------------ where things are
    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(2 * MARGIN + 2 * ICON_SIDE, self.height())

    sizeHint = minimumSizeHint

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._lay_out()

    def _restyle(self) -> None:
        """Follow the colours and font size of the window."""
        self.warning.setPixmap(pixmap("warning", LOOK.theme.warning, self.devicePixelRatioF(), 16))
        for control in self.controls:
            if isinstance(control, NumberControl):
                control.show_value(control.value)
        self.set_compact(self._is_compact)
        self._lay_out()
        self.update()

    def _lay_out(self) -> None:
        """Lay out name, warning and parameters from the left, and the two buttons from the right."""
        controls = [c for c in self.controls if not (self._plain or (self._warning and isinstance(c, FixedWord)))]
        self.name.setText(self._name)
        left = MARGIN + self._letter_room + (DOT_ROOM if self._dot else 0)
        right = self.width() - MARGIN - ICON_SIDE
        self.more.setGeometry(right, self._top(ICON_SIDE), ICON_SIDE, ICON_SIDE)
        name = self.name.sizeHint().width()
        warning = WARNING_ROOM if self._warning else 0
        for is_short in (False, True):
            if self._by is not None:
                self._by.shorten(is_short)
            shown, sliders, has_info = self._fitting(controls, right - left - name - warning)
            if self._by in shown:
                break
        if self._by is not None and self._by in controls and self._by not in shown:
            self._by.shorten(False)
            # By which distance it is tells panels apart, and what it is does not.
            self.name.setText(f"{self._by.text()[:1].upper()}{self._by.text()[1:]}")
            name = self.name.sizeHint().width()
        elif self.shows.short_heading and not self._plain and name + warning > right - left:
            self.name.setText(self.shows.short_heading)
            name = self.name.sizeHint().width()
        if has_info:
            right -= ICON_SIDE
            self.info.setGeometry(right, self._top(ICON_SIDE), ICON_SIDE, ICON_SIDE)
        self.info.setVisible(has_info)
        self._about.setVisible(not has_info)
        self._line_under_about.setVisible(not has_info)
        taken = sum(BETWEEN + control.least(sliders) for control in shown)
        name = max(min(name, right - left - warning - taken), 0)
        self.name.setGeometry(left, self._top(self.name.sizeHint().height()), name, self.name.sizeHint().height())
        left += name
        self.warning.setVisible(bool(self._warning))
        if self._warning:
            self.warning.setGeometry(left + 3, self._top(16), 16, 16)
            left += warning
        for control in self.controls:
            if control not in shown:
                control.hide()
        spare = right - left - taken
        for control in shown:
            control.show_slider(sliders)
            more = min(control.most(sliders) - control.least(sliders), max(spare, 0))
            width, height = control.least(sliders) + more, self.name.sizeHint().height()
            control.setGeometry(left + BETWEEN, self._top(height), width, height)
            control.show()
            left, spare = left + BETWEEN + width, spare - more

    def _fitting(self, controls: list[Control], room: int) -> tuple[list[Control], bool, bool]:
        """Return the controls there is room for, whether with sliders, and whether beside the button with remarks."""
        wide = self.width()
        most = len(controls) if wide >= ALL_FROM else 1 if wide >= FIRST_FROM else 0
        plans = [(most, True, True)] if wide >= SLIDERS_FROM else []
        # The button goes before the parameters, since its words stand in the menu beside it, too.
        for count in range(min(most, len(controls)), -1, -1):
            plans += [(count, False, has_info) for has_info in ((True, False) if wide >= SLIDERS_FROM else (False,))]
        for count, sliders, has_info in plans:
            taken = sum(BETWEEN + control.least(sliders) for control in controls[:count])
            if taken + (ICON_SIDE if has_info else 0) <= room:
                return controls[:count], sliders, has_info
        return [], False, False

    def _top(self, height: int) -> int:
        return int((self.height() - height) // 2)

    # ------------------------------------------------------------------ events
    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        kinds, reasons = QtCore.QEvent.Type, QtCore.Qt.FocusReason
        by_keyboard = reasons.TabFocusReason, reasons.BacktabFocusReason
        is_reached = event.type() == kinds.FocusIn and event.reason() in by_keyboard
        if is_reached or event.type() == kinds.MouseButtonPress:
            self.clicked.emit()
        return bool(super().eventFilter(watched, event))

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.clicked.emit()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, middle = LOOK.theme, self.height() / 2
        shapes: list[Shape] = []
        if self._dot:
            shapes.append(disc((MARGIN + self._letter_room + 8, middle), DOT, rgba_of(self._dot)))
        if self.letter:
            side = round(LETTER_SIDE * LOOK.scale)
            badge = Box(MARGIN + 4, self._top(side), side, side)
            text = Text(self.letter, *badge.middle, 11 * LOOK.scale, rgba_of(theme.text), True, "centre", "line")
            shapes += [Path(rounded(badge, 4), rgba_of(theme.pressed)), text]
        paint(smooth_painter(self, theme.canvas), shapes)

    @property
    def _letter_room(self) -> int:
        return round(LETTER_ROOM * LOOK.scale) if self.letter else 0
