"""Choices of the user: panels, isolines, colours, ranges, preferences."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.scalars import with_decimal_point

from ..document.document import Document
from ..document.edits import MOST_ADDED, add_another, end_at, pass_through, pass_through_none, show_in_row
from ..document.looks import MOST_ISOLINES, Colours
from ..document.panel_edits import ADD, panel_edits, possible_edits
from ..document.quantities import Quantity
from ..document.settings import THEME, Preferences, Setting
from ..document.tools import tools
from ..scene.colour_file import read_stops
from ..scene.levels import levels, too_many
from ..session.base import no_scalars
from .context import Context
from .dragging import Dragging
from .files.taken_ends import TakenEnds
from .look.canvas import map_word
from .look.look import LOOK, TALK

COLOUR_FILES = "Colour maps (*.txt *.csv *.json);;All files (*)"

LEAST_ANGLE = 0.1
"""In degrees."""


class Choices:
    """Edits of the document, of the page and of the preferences."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.is_full_screen = False
        self.ends = context[TakenEnds]

    # ------------------------------------------------------------------ panels
    def add_panel(self) -> None:
        """Add a panel with a distance that is not shown yet."""
        session = self._context.session
        if self.can_add_panel and not self._add_panels():
            active = {panel.id: panel.surface for panel in session.document.panels}
            session.show(add_another(session.document, active.get(self._context.grid.active)))

    @property
    def can_add_panel(self) -> bool:
        """Whether a panel can be added."""
        session = self._context.session
        if session.loaded() is None:
            return False
        several = self._with_panels_of_tools()
        return len(session.document.panels) < MOST_ADDED if several is None else several != session.document

    def _with_panels_of_tools(self) -> Document | None:
        """Return the document with the panels that a tool adds at once; None where no tool does."""
        document = self._context.document
        documents = (tool.load(tool.add_panel)(document) for tool in tools() if tool.add_panel)
        return next((each for each in documents if each is not None), None)

    def _add_panels(self) -> bool:
        """Add the panels that a tool adds at once, and return whether a tool does."""
        document = self._with_panels_of_tools()
        if document is not None and document != self._context.document:
            self._context.session.show(document)
        return document is not None

    def edit_panel(self, panel: int, word: str) -> None:
        """Run an entry of the menu over a panel, where that is possible."""
        session = self._context.session
        is_there = any(shown.id == panel for shown in session.document.panels)
        if is_there and word == ADD and self._add_panels():
            return
        if is_there and word in possible_edits(session.document, panel):
            session.show(panel_edits()[word].edit(session.document, panel))

    def choose(self, panel: int, shows: Quantity) -> None:
        """Show another quantity in a panel, as one step; values that a slider passes are one step, too."""
        document, is_held = self._context.document, self._context.grid.panel(panel).head.is_held
        if is_held:
            self._context[Dragging].begin(keeps_steps=False)
            self._context[Dragging].is_on = True
        key = f"{shows.word} in {panel}" if document.panel(panel).shows.is_alike(shows) else ""
        self._context.session.show(show_in_row(document, panel, shows), key, live=is_held)

    def let_go(self) -> None:
        """End the drag of a slider: ask for the final answers."""
        self._context[Dragging].is_on = False
        self._context[Dragging].end()
        self._context.session.show(self._context.document)

    # ------------------------------------------------------------------ settings
    def set(self, setting: Setting, value: Any) -> None:
        """Change a setting."""
        context = self._context
        if setting is THEME:
            LOOK.choose(value)
        if setting.is_preference:
            context.prefer(**{setting.word: value})
        elif value != setting.value(context):
            context.session.show(setting.changed(context.document, value))
        context.choice_changed.emit()

    def toggle(self, setting: Setting) -> None:
        """Switch a setting on or off."""
        self.set(setting, setting.off if setting.is_on(self._context) else setting.on)

    def ask_feature_angle(self) -> None:
        """Ask from which angle on an edge is sharp."""
        session, shading = self._context.session, self._context.document.shading
        words = "Split normals where faces meet at more than this many degrees:"
        angle, chosen = QtWidgets.QInputDialog.getDouble(
            self._context.widget, "Feature angle", words, shading.feature_angle, LEAST_ANGLE, 180 - LEAST_ANGLE, 1
        )
        if chosen:
            shading = replace(shading, feature_angle=angle, normals="creased")
            session.show(replace(session.document, shading=shading))

    def ask_unit(self) -> None:
        """Ask for the unit of the meshes' lengths."""
        session = self._context.session
        words = "Unit of the mesh's lengths, such as mm; empty if it is not known:"
        now, edit = session.document.unit, QtWidgets.QLineEdit.EchoMode.Normal
        unit, chosen = QtWidgets.QInputDialog.getText(self._context.widget, "Unit of lengths", words, edit, now)
        if chosen:
            with self._context.errors_shown():
                session.show(replace(session.document, unit=unit.strip()))

    def style(self, word: str) -> None:
        """Choose a style for panels and later figures; the colour map stays as it is."""
        context = self._context
        chosen = map_word(context.page.style, context.document.colours)
        context.page = replace(context.page, style=word)
        context.style_changed.emit()
        if chosen is not None:
            self.colour_map(chosen)
        self._context.choice_changed.emit()

    # ------------------------------------------------------------------ colours
    def _colour(self, colours: Colours) -> None:
        session = self._context.session
        if colours != session.document.colours:
            session.show(replace(session.document, colours=colours))
        self._context.choice_changed.emit()

    def colour_map(self, word: str) -> None:
        """Choose a colour map; the document does not name that of the style."""
        now = self._context.document.colours
        is_own = word == map_word(self._context.page.style, Colours())
        self._colour(Colours("" if is_own else word, (), now.reversed, now.bands))

    def ask_colours(self) -> None:
        """Ask for a file with a colour map, and choose that."""
        if path := self._ask_path("Colours from a file", COLOUR_FILES):
            self.take_colours(path)

    def _ask_path(self, title: str, files: str) -> str:
        context = self._context
        return str(QtWidgets.QFileDialog.getOpenFileName(context.widget, title, context.folder, files)[0])

    def take_colours(self, path: str) -> None:
        """Choose the colour map in a file, or tell why it cannot be read."""
        now = self._context.document.colours
        with self._context.errors_shown():
            self._colour(Colours(Path(path).stem, read_stops(path), now.reversed, now.bands))

    def base(self, scalars: str) -> None:
        """Draw scalars in grey under the isolines, or nothing."""
        session = self._context.session
        document = session.document
        field = next((each for each in document.fields if each.name == scalars), None)
        loaded = None if field is None else session.loaded(field.surface)
        if field is not None and loaded is not None and loaded.own_field(field).field is None:
            self._context.fail(ParameterError(no_scalars(scalars)))
        elif scalars != document.base.scalars:
            session.show(replace(document, base=replace(document.base, scalars=scalars)))
        self._context.choice_changed.emit()

    # ------------------------------------------------------------------ ranges
    def end_at(self, panel: int, end: float | None) -> None:
        """Let a panel's colour bar end at a value, its own maximum if None."""
        session = self._context.session
        session.show(end_at(session.document, panel, end))

    def ask_end(self) -> None:
        """Let the end of the active panel's colour bar be typed."""
        panel = self._context.active
        if panel is not None:
            panel.ask_end()
        self._context.choice_changed.emit()  # nothing has been chosen yet

    def ask_ends(self) -> None:
        """Ask for a session or recipe, and take its colour limits."""
        if path := self._ask_path("Ranges from a session or recipe", "Sessions and recipes (*.json)"):
            self.ends.take(path)

    # ------------------------------------------------------------------ the window
    def toggle_full_screen(self) -> None:
        """Show only panels and their bars, in larger text, or leave the full screen."""
        state, full = self._context.widget.windowState(), QtCore.Qt.WindowState.WindowFullScreen
        self._show_full_screen(not self.is_full_screen)
        self._context.widget.setWindowState(state | full if self.is_full_screen else state & ~full)

    def window_state_changed(self) -> None:
        """Leave the full screen where the desktop has ended it."""
        if self.is_full_screen and not self._context.widget.isFullScreen():
            self._show_full_screen(False)

    def _show_full_screen(self, is_full: bool) -> None:
        context, self.is_full_screen = self._context, is_full
        bars = context.widget.findChildren(QtWidgets.QToolBar, options=QtCore.Qt.FindChildOption.FindDirectChildrenOnly)
        for bar in (context.widget.menuBar(), *bars, context.status):
            bar.setVisible(not is_full)
        LOOK.enlarge(TALK if is_full else 1.0)
        context.choice_changed.emit()

    def remember_place(self) -> None:
        """Remember the window's place and the open docks for the next start."""
        if not self.is_full_screen:
            geometry = bytes(self._context.widget.saveGeometry())
            self._context.prefer(geometry=geometry, docks=",".join(self._context.document.docks))

    def ask_preferences(self) -> None:
        """Open the dialog of preferences."""
        from .pages.preferences_dialog import PreferencesDialog

        dialog = PreferencesDialog(self._context.preferences, self._context.widget)
        dialog.accepted.connect(lambda: self._take(dialog.chosen()))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _take(self, preferences: Preferences) -> None:
        self._context.prefer(**vars(preferences))
        self.set(THEME, preferences.theme)


IN_UNIT = "in each panel's unit (0.05 for 5 % of a difference)"


class IsolineChoices:
    """Edits of the document's isolines."""

    def __init__(self, context: Context) -> None:
        self._context = context

    def steps(self, count: int) -> None:
        """Choose about how many isolines there are, at round values, or the number of equal steps."""
        self._change("isolines", count=count, spacing=None, values=())

    def ask_steps(self) -> None:
        """Ask for the number of isolines."""
        now = self._context.document.isolines.count
        count, chosen = QtWidgets.QInputDialog.getInt(
            self._context.widget, "Isolines", "About how many in each panel:", now, 0, MOST_ISOLINES
        )
        if chosen:
            self.steps(count)
        self._context.choice_changed.emit()

    def ask_spacing(self) -> None:
        """Ask for the step from one isoline to the next."""
        now = self._context.document.isolines.spacing
        question = f"From one isoline to the next, {IN_UNIT}:"
        self._ask(question, "" if now is None else f"{now:.6g}", self.spacing)

    def spacing(self, text: str) -> None:
        """Choose a typed spacing; ParameterError if it makes more lines than can be drawn."""
        session = self._context.session
        wanted = replace(session.document.isolines, spacing=_number(text), values=())
        for shown in session.shown.values():
            answer = shown.answer
            own = answer.maximum / answer.scale
            if reason := too_many(levels(wanted, own, own, answer.is_signed), wanted, own):
                raise ParameterError(reason)
        self._change("", spacing=wanted.spacing, values=())

    def ask_values(self) -> None:
        """Ask for the values of the isolines."""
        now = self._context.document.isolines.values
        question = f"Isolines at these values, {IN_UNIT}, with spaces between them:"
        self._ask(question, " ".join(f"{value:.6g}" for value in now), self.values)

    def values(self, text: str) -> None:
        """Choose typed values."""
        words = text.replace(";", " ").replace(", ", " ").split()
        if len(words) == 1 and words[0].count(",") > 1:
            words = words[0].split(",")
        values = tuple(map(_number, words))
        if not values:
            raise ParameterError("Isolines at values need one value at least, such as 0.5.")
        self._change("", spacing=None, values=values)

    # ------------------------------------------------------------------ through points
    def pass_through(self, panel: int, vertex: int) -> None:
        """Add an isoline through a vertex of a panel's surface, in all panels of that surface."""
        session = self._context.session
        surface = session.document.panel(panel).surface
        session.show(pass_through(session.document, (vertex,), surface))

    def pass_through_none(self) -> None:
        """Remove the isolines through chosen points."""
        session = self._context.session
        session.show(pass_through_none(session.document))

    # ------------------------------------------------------------------
    def _change(self, key: str, **changes: Any) -> None:
        session = self._context.session
        isolines = replace(session.document.isolines, **changes)
        session.show(replace(session.document, isolines=isolines), key=key)
        self._context.choice_changed.emit()

    def _ask(self, question: str, now: str, take: Callable[[str], None]) -> None:
        """Ask for a text until it can be read, or the user cancels."""
        dialog = QtWidgets.QInputDialog(self._context.widget)
        dialog.setWindowTitle("Isolines")
        dialog.setTextValue(now)
        dialog.setLabelText(question)
        while dialog.exec():
            try:
                take(dialog.textValue())
                break
            except ParameterError as error:
                dialog.setLabelText(f"{question}\n{error}")
        self._context.choice_changed.emit()
        dialog.deleteLater()


def _number(text: str) -> float:
    try:
        return float(with_decimal_point(text))
    except ValueError:
        raise ParameterError(f"{text.strip()[:20] or 'Nothing'!r} is not a number.") from None
