"""What the user chooses: panels, isolines, colours, ranges, preferences."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError

from ..document.edits import MOST_ADDED, add_another, end_at, show_in_row, with_range
from ..document.looks import Colours
from ..document.panel_edits import ADD, panel_edits, possible_edits
from ..document.quantities import Quantity
from ..document.tools import tools
from ..scene.colour_file import read_stops
from .context import Context
from .files.taken_ends import TakenEnds
from .isoline_choices import IsolineChoices
from .look.canvas import map_word
from .look.look import LOOK, TALK
from .preferences import Preferences

COLOUR_FILES = "Colour maps (*.txt *.csv *.json);;All files (*)"

LEAST_CREASE = 0.1
"""Degrees."""


class Choices:
    """Edits of the document, of the page and of the preferences."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.is_full_screen = False
        self.ends, self.isoline = context[TakenEnds], context[IsolineChoices]

    # ------------------------------------------------------------------ panels
    def add_panel(self) -> None:
        """One more, with a distance that is not shown yet."""
        session = self._context.session
        if session.surface is not None and not self._add_panels() and len(session.document.panels) < MOST_ADDED:
            active = {panel.id: panel.surface for panel in session.document.panels}
            session.show(add_another(session.document, active.get(self._context.grid.active)))

    def _add_panels(self) -> bool:
        """Several that a tool adds at once; whether one does."""
        session = self._context.session
        documents = (tool.load(tool.add_panel)(session.document) for tool in tools() if tool.add_panel)
        document = next((each for each in documents if each is not None), None)
        if document is not None and document != session.document:
            session.show(document)
        return document is not None

    def edit_panel(self, panel: int, word: str) -> None:
        """Do what an entry of the menu over a panel says, where that is possible."""
        session = self._context.session
        is_there = any(shown.id == panel for shown in session.document.panels)
        if is_there and word == ADD and self._add_panels():
            return
        if is_there and word in possible_edits(session.document, panel):
            session.show(panel_edits()[word].edit(session.document, panel))

    def choose(self, panel: int, shows: Quantity) -> None:
        """Let a panel show something else, which is a step; the values that a slider passes are one."""
        document = self._context.document
        words = [tuple(part.word for part in each.parts) for each in (document.panel(panel).shows, shows)]
        key = f"{words[0]} in {panel}" if words[0] == words[1] else ""
        self._context.edit(show_in_row(document, panel, shows), key)

    # ------------------------------------------------------------------ how fields are shown
    def isolines(self, count: int) -> None:
        """Draw about so many isolines at round values, 0 for none."""
        self.isoline.steps(count)

    def shading(self, word: str) -> None:
        """One of NORMALS."""
        self._shade(normals=word)

    def wireframe(self, is_shown: bool) -> None:
        """Draw the edges of the faces, or no longer."""
        self._shade(wireframe=is_shown)

    def ask_crease(self) -> None:
        """Ask for the angle beyond which an edge is drawn as a crease."""
        shading = self._context.document.shading
        words = "Normals are split where faces meet at more than so many degrees:"
        crease, chosen = QtWidgets.QInputDialog.getDouble(
            self._context.widget, "Creases", words, shading.crease, LEAST_CREASE, 180 - LEAST_CREASE, 1
        )
        if chosen:
            self._shade(crease=crease, normals="creased")

    def _shade(self, **changes: Any) -> None:
        session = self._context.session
        session.show(replace(session.document, shading=replace(session.document.shading, **changes)))

    def style(self, word: str) -> None:
        """One of the drawing's styles, for the panels and for the figures to come; the map stays as it is."""
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
        """One of the drawing's maps; that of the style is not named."""
        now = self._context.document.colours
        is_own = word == map_word(self._context.page.style, Colours())
        self._colour(Colours("" if is_own else word, (), now.reversed, now.bands))

    def reverse_colours(self, is_on: bool) -> None:
        """Run the colour map backwards, or no longer."""
        self._colour(replace(self._context.document.colours, reversed=is_on))

    def band_colours(self, is_on: bool) -> None:
        """Fill the space between isolines with one colour, or no longer."""
        self._colour(replace(self._context.document.colours, bands=is_on))

    def ask_colours(self) -> None:
        """A map from a file."""
        if path := self._ask_path("Colours from a file", COLOUR_FILES):
            self.take_colours(path)

    def _ask_path(self, title: str, files: str) -> str:
        context = self._context
        return str(QtWidgets.QFileDialog.getOpenFileName(context.widget, title, context.folder, files)[0])

    def take_colours(self, path: str) -> None:
        """The map in a file, or a sentence why there is none."""
        now = self._context.document.colours
        try:
            self._colour(Colours(Path(path).stem, read_stops(path), now.reversed, now.bands))
        except ParameterError as error:
            self._context.fail(error)

    # ------------------------------------------------------------------ ranges
    def range(self, word: str) -> None:
        """One of RANGES."""
        session = self._context.session
        session.show(with_range(session.document, word))
        self._context.choice_changed.emit()

    def end_at(self, panel: int, end: float | None) -> None:
        """Where a panel's colour bar ends, its own maximum if None."""
        session = self._context.session
        session.show(end_at(session.document, panel, end))

    def ask_end(self) -> None:
        """Let the active panel's be typed."""
        panel = self._context.active
        if panel is not None:
            panel.ask_end()
        self._context.choice_changed.emit()  # nothing has been chosen yet

    def ask_ends(self) -> None:
        """Those of a session or recipe."""
        if path := self._ask_path("Ranges from a session or recipe", "Sessions and recipes (*.json)"):
            self.ends.take(path)

    # ------------------------------------------------------------------ the window
    def theme(self, word: str) -> None:
        """ "light", "dark" or "desktop"."""
        LOOK.choose(word)
        self._context.prefer(theme=word)
        self._context.choice_changed.emit()

    def toggle_full_screen(self) -> None:
        """Panels and their bars only, in larger letters; and back."""
        state, full = self._context.widget.windowState(), QtCore.Qt.WindowState.WindowFullScreen
        self._show_full_screen(not self.is_full_screen)
        self._context.widget.setWindowState(state | full if self.is_full_screen else state & ~full)

    def window_state_changed(self) -> None:
        """The desktop may end it, too."""
        if self.is_full_screen and not self._context.widget.isFullScreen():
            self._show_full_screen(False)

    def _show_full_screen(self, is_full: bool) -> None:
        context, self.is_full_screen = self._context, is_full
        bars = context.widget.findChildren(QtWidgets.QToolBar, options=QtCore.Qt.FindChildOption.FindDirectChildrenOnly)
        for bar in (context.widget.menuBar(), *bars, context.status):
            bar.setVisible(not is_full)
        LOOK.enlarge(TALK if is_full else 1.0)
        context.actions["full screen"].setChecked(is_full)

    def remember_place(self) -> None:
        """Where the window stands, for the next start."""
        if not self.is_full_screen:
            self._context.prefer(geometry=bytes(self._context.widget.saveGeometry()))

    def ask_preferences(self) -> None:
        """Open the dialog of preferences."""
        from .pages.preferences_dialog import PreferencesDialog

        dialog = PreferencesDialog(self._context.preferences, self._context.widget)
        dialog.accepted.connect(lambda: self._take(dialog.chosen()))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _take(self, preferences: Preferences) -> None:
        context = self._context
        has_switched = preferences.snap != context.preferences.snap
        context.prefer(**vars(preferences))
        if has_switched:
            context.session.keep_snapping(preferences.snap)
        self.theme(preferences.theme)
        if context.is_built:
            context.grid.turn_wheel(-1.0 if preferences.wheel_reversed else 1.0)
            context.grid.turn_upright(preferences.turntable)
