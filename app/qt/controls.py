"""The controls over a panel: which distance, and its parameters.  All of it comes from the table of distances."""

from collections.abc import Callable, Sequence
from math import exp, log

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.distances.kinds import Parameter, Spec, Value, kind_of, kinds

from ..document.document import COMPARISON
from ..document.edits import PANEL_EDITS
from ..document.quantities import Difference, DistanceFrom, OwnField, Part, Quantity

STEPS = 240
"""Positions of a slider, in equal steps of the parameter's logarithm."""

SYMBOLS = {"alpha": "α"}

NARROWEST, SLIDER_FROM = 56, 250
"""Pixels of a menu or box at least, and of the controls of one distance from which a slider has room."""

MOST_PANELS = 6
"""Up to which panels can be added; a recipe may have more."""


class PanelControls(QtWidgets.QWidget):
    """Which quantity a panel shows; emits `changed(Quantity)` for each choice.

    One distance with its parameters, or two and a minus between them; the button after the second takes it away.
    """

    changed = QtCore.Signal(object)
    asked = QtCore.Signal(str)  # a word of PANEL_EDITS

    def __init__(self, shows: Quantity, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_StyledBackground)
        self.shows = shows
        self.first = DistanceControl(self, offers_difference=True)
        self.minus = QtWidgets.QLabel("−", self)
        self.second = DistanceControl(self)
        self.alone = QtWidgets.QToolButton(self, text="×", autoRaise=True)
        self.alone.setToolTip("Show the first distance alone")
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(8, 6, 8, 2)
        self.more = QtWidgets.QToolButton(self, text="⋯", autoRaise=True)
        self.more.setToolTip("Add, duplicate, move or remove panels")
        self.more.setPopupMode(QtWidgets.QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QtWidgets.QMenu(self.more)
        self.edits = {word: menu.addAction(word) for word in PANEL_EDITS}
        for word, action in self.edits.items():
            action.triggered.connect(lambda *_, word=word: self.asked.emit(word))
        self.more.setMenu(menu)
        for widget in (self.first, self.minus, self.second, self.alone):
            row.addWidget(widget)
        row.addStretch(0)
        row.addWidget(self.more)
        self._controls_row = row
        # Panels are equally wide whatever is in here: in a narrow one the menus' words are cut.
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)
        self.first.chosen.connect(lambda spec: self._choose(spec, 0))
        self.second.chosen.connect(lambda spec: self._choose(spec, 1))
        self.first.difference_wanted.connect(self._subtract)
        self.alone.clicked.connect(self._leave_alone)
        self.show_quantity(shows)

    def show_quantity(self, shows: Quantity, fields: Sequence[str] | None = None) -> None:
        """Make the controls say what is shown, without emitting.  fields: the user's own that are there to choose."""
        self.shows = shows
        for control in (self.first, self.second) if fields is not None else ():
            control.offer_fields(fields)
        self.first.show_part(shows.parts[0])
        is_difference = isinstance(shows, Difference)
        for widget in (self.minus, self.second, self.alone):
            widget.setVisible(is_difference)
        if is_difference:
            self.second.show_part(shows.parts[1])
        for control in (self.first, self.second):
            # A slider takes the room there is.
            is_wide = any(each.parameter.logarithmic for each in control.parameters.values())
            self._controls_row.setStretchFactor(control, int(is_wide))

        self._fit()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Where there is no room for sliders their values remain."""
        count = len(self.shows.parts)
        for control in (self.first, self.second):
            control.show_sliders(self.width() >= SLIDER_FROM * count)

    def allow(self, words: set[str]) -> None:
        """Which of the panel's edits are possible."""
        for word, action in self.edits.items():
            action.setEnabled(word in words)

    def _choose(self, chosen: Spec | OwnField, place: int) -> None:
        parts = list(self.shows.parts)
        # Where distances start, nobody chooses here.
        points = [*parts[place].points, *self.shows.points, "source"]
        parts[place] = chosen if isinstance(chosen, OwnField) else DistanceFrom(chosen, points[0])
        self._emit(self.shows.with_parts(tuple(parts)))

    def _subtract(self) -> None:
        """From what is shown the first other distance of those usually compared."""
        if isinstance(self.shows, Difference):
            self.first.show_part(self.shows.minuend)
            return
        other = next(spec for spec in COMPARISON if spec.word != self.shows.word)
        self._emit(Difference(self.shows, DistanceFrom(other, [*self.shows.points, "source"][0])))

    def _leave_alone(self) -> None:
        if isinstance(self.shows, Difference):
            self._emit(self.shows.minuend)

    def _emit(self, shows: Quantity) -> None:
        self.show_quantity(shows)
        self.changed.emit(shows)


class DistanceControl(QtWidgets.QWidget):
    """One distance: a menu and its parameters; or a field of the user's own.

    `chosen(Spec | OwnField)` by the user; a distance chosen again has its old parameters.
    """

    chosen = QtCore.Signal(object)
    difference_wanted = QtCore.Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None, offers_difference: bool = False) -> None:
        super().__init__(parent)
        self.shown: Spec | OwnField = COMPARISON[0]
        self._before: dict[str, Spec] = {}
        self.distance = QtWidgets.QComboBox(self)
        for word in kinds():
            try:
                self.distance.addItem(kind_of(word).name, word)
            except ParameterError:
                continue  # somebody else's that cannot be loaded; asked for by its word it says why
        if offers_difference:
            self.distance.insertSeparator(self.distance.count())
            self.distance.addItem("Difference of two", None)
        self._fields: dict[str, OwnField] = {}
        self._fields_from = self.distance.count()
        self.distance.setToolTip("The distance this panel shows")
        self.distance.setMinimumWidth(NARROWEST)
        self._row = QtWidgets.QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.addWidget(self.distance)
        self._row.addStretch(0)
        self._of_word = ""
        self.parameters: dict[str, ParameterControl] = {}
        self.distance.currentIndexChanged.connect(self._choose_distance)

    def offer_fields(self, names: Sequence[str]) -> None:
        """The user's own, after the distances."""
        with QtCore.QSignalBlocker(self.distance):
            while self.distance.count() > self._fields_from:
                self.distance.removeItem(self._fields_from)
            if names:
                self.distance.insertSeparator(self.distance.count())
            self._fields = {field.word: field for field in map(OwnField, names)}
            for word, field in self._fields.items():
                self.distance.addItem(field.name, word)

    def show_part(self, part: Part) -> None:
        """Make the controls say what is shown, without emitting."""
        self._show(part if isinstance(part, OwnField) else part.spec)

    def _show(self, shown: Spec | OwnField) -> None:
        self.shown = shown
        with QtCore.QSignalBlocker(self.distance):
            self.distance.setCurrentIndex(self.distance.findData(shown.word))
        if shown.word != self._of_word:
            self._make_parameters(() if isinstance(shown, OwnField) else shown.kind.parameters)
            self._of_word = shown.word
        if isinstance(shown, Spec):
            self._before[shown.word] = shown
            for name, value in shown.values:
                self.parameters[name].show_value(value)

    def _make_parameters(self, parameters: Sequence[Parameter]) -> None:
        for control in self.parameters.values():
            self._row.removeWidget(control)
            control.deleteLater()
        self.parameters = {}
        for parameter in parameters:
            control = ParameterControl(parameter, self)
            control.chosen.connect(lambda value, name=parameter.name: self._choose(**{name: value}))
            self._row.insertWidget(self._row.count() - 1, control, int(parameter.logarithmic))
            control.show()
            self.parameters[parameter.name] = control

    def show_sliders(self, shown: bool) -> None:
        for control in self.parameters.values():
            if control.parameter.logarithmic:
                control.widget.setVisible(shown)

    def _choose_distance(self) -> None:
        word = self.distance.currentData()
        if word is None:
            self.difference_wanted.emit()
            return
        self._show(self._fields.get(word) or self._before.get(word) or Spec.of(word))
        self.chosen.emit(self.shown)

    def _choose(self, **choice: object) -> None:
        self._show(self.shown.changed(**choice))
        self.chosen.emit(self.shown)


class ParameterControl(QtWidgets.QWidget):
    """A menu for a word, a slider for a number with a logarithm, a box for another; `chosen(value)` by the user."""

    chosen = QtCore.Signal(object)

    def __init__(self, parameter: Parameter, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.parameter = parameter
        self._label = QtWidgets.QLabel(self)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        if parameter.choices:
            self.widget, self._put = self._menu()
        elif parameter.logarithmic:
            self.widget, self._put = self._slider()
        else:
            self.widget, self._put = self._box()
        self.widget.setMinimumWidth(NARROWEST)
        self.widget.setToolTip(f"{parameter.meaning[0].upper()}{parameter.meaning[1:]}")
        row.addWidget(self.widget, 1)
        row.addWidget(self._label)
        self._label.setVisible(parameter.logarithmic)
        if not parameter.logarithmic:
            # No wider than what is in it.
            self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Maximum, QtWidgets.QSizePolicy.Policy.Preferred)

    def show_value(self, value: Value) -> None:
        """Without emitting."""
        with QtCore.QSignalBlocker(self.widget):
            self._put(value)
        if self.parameter.logarithmic:
            written = self.parameter.written(value)
            self._label.setText(f"{self._symbol} = {written if '/' in written else f'{value:.3g}'}")

    @property
    def _symbol(self) -> str:
        return SYMBOLS.get(self.parameter.name, self.parameter.name)

    def _menu(self) -> tuple[QtWidgets.QWidget, Callable]:
        menu = QtWidgets.QComboBox(self)
        for word in self.parameter.choices:
            menu.addItem(word, word)
        menu.currentIndexChanged.connect(lambda: self.chosen.emit(menu.currentData()))
        return menu, lambda value: menu.setCurrentIndex(menu.findData(value))

    def _slider(self) -> tuple[QtWidgets.QWidget, Callable]:
        slider = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal, self)
        slider.setRange(0, STEPS)
        slider.valueChanged.connect(lambda step: self.chosen.emit(value_of_step(self.parameter, step)))
        return slider, lambda value: slider.setValue(step_of_value(self.parameter, value))

    def _box(self) -> tuple[QtWidgets.QWidget, Callable]:
        box = QtWidgets.QSpinBox(self) if self.parameter.is_whole else QtWidgets.QDoubleSpinBox(self)
        low, high = self.parameter.shown
        box.setRange(*((int(low), int(high)) if self.parameter.is_whole else (low, high)))
        box.setSingleStep(1 if self.parameter.is_whole else 0.25)
        box.setPrefix(f"{self._symbol} = ")
        box.setKeyboardTracking(False)
        box.valueChanged.connect(self.chosen.emit)
        return box, box.setValue


def value_of_step(parameter: Parameter, step: int) -> float:
    """The value at a slider position; one of the marks where it is within half a step."""
    for mark in parameter.marks:
        if step_of_value(parameter, mark) == step:
            return mark
    low, high = (log(end) for end in parameter.shown)
    return float(f"{exp(low + (high - low) * step / STEPS):.3g}")


def step_of_value(parameter: Parameter, value: float) -> int:
    low, high = (log(end) for end in parameter.shown)
    return round(STEPS * (log(value) - low) / (high - low))
