"""What the user chooses: panels, isolines, colours, ranges, preferences.  `window` is the main window throughout."""

from dataclasses import replace
from pathlib import Path

from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError

from ..document.edits import ADD, MOST_ADDED, PANEL_EDITS, add_another, end_at, has_ends, possible_edits, with_range
from ..document.looks import Colours
from ..document.perturbation import changed_mesh
from ..document.perturbation_edits import add_row
from ..scene.colour_file import read_stops
from .bars.colour_menu import colours_in_words
from .bars.isoline_menu import isolines_in_words
from .bars.menus import RANGE_NAMES
from .files.taken_ends import TakenEnds
from .isoline_choices import IsolineChoices
from .look.canvas import map_word
from .look.look import LOOK, TALK
from .preferences import Preferences, save

COLOUR_FILES = "Colour maps (*.txt *.csv *.json);;All files (*)"

LEAST_CREASE = 0.1
"""Degrees."""


class Choices:
    """Edits of the document and of the page; menus and buttons say what is chosen."""

    def __init__(self, window) -> None:
        self._window = window
        self.is_full_screen = False
        self.ends = TakenEnds(window)
        self.isoline = IsolineChoices(window)

    def show(self) -> None:
        """Let menus and buttons say what is chosen."""
        window, document, style = self._window, self._window.session.document, self._window.page.style
        shown_range = "typed" if document.range == "own" and has_ends(document) else document.range
        window.views.show()
        for name, value in {
            "isolines": isolines_in_words(document.isolines),
            "colours": colours_in_words(style, document.colours),
            "range": RANGE_NAMES[shown_range],
        }.items():
            window.tools[name].show_value(value)
        menus = window.menus
        menus.isolines.show_choice(document.isolines)
        menus.colours.show_choice(style, document.colours)
        menus.show_choice(menus.range, shown_range)
        menus.show_choice(menus.theme, LOOK.choice)
        menus.show_choice(menus.shading, document.shading.normals)
        window.actions_by_word["wireframe"].setChecked(document.shading.wireframe)
        window.actions_by_word["snap"].setChecked(document.snap)
        window.actions_by_word["link"].setChecked(document.linked)
        for word in ("link", "close beside"):
            window.actions_by_word[word].setEnabled(len(document.surfaces) > 1)

    # ------------------------------------------------------------------ panels
    def add_panel(self) -> None:
        """One more, with a distance that is not shown yet."""
        session = self._window.session
        if session.surface is not None and changed_mesh(session.document) is not None:
            self._add_row()
        elif session.surface is not None and len(session.document.panels) < MOST_ADDED:
            active = {panel.id: panel.surface for panel in session.document.panels}
            session.show(add_another(session.document, active.get(self._window.grid.active)))

    def _add_row(self) -> None:
        """The same of a changed mesh: before, after and difference."""
        session = self._window.session
        if len(session.document.panels) <= MOST_ADDED:
            session.show(add_row(session.document))

    def edit_panel(self, panel: int, word: str) -> None:
        """One of PANEL_EDITS, where it is possible."""
        session = self._window.session
        is_there = any(shown.id == panel for shown in session.document.panels)
        if is_there and word == ADD and changed_mesh(session.document) is not None:
            self._add_row()
        elif is_there and word in possible_edits(session.document, panel, MOST_ADDED):
            session.show(PANEL_EDITS[word](session.document, panel))

    # ------------------------------------------------------------------ how fields are shown
    def isolines(self, count: int) -> None:
        self.isoline.steps(count)

    def shading(self, word: str) -> None:
        """One of NORMALS."""
        self._shade(normals=word)

    def wireframe(self, is_shown: bool) -> None:
        self._shade(wireframe=is_shown)

    def ask_crease(self) -> None:
        shading = self._window.session.document.shading
        words = "Normals are split where faces meet at more than so many degrees:"
        crease, chosen = QtWidgets.QInputDialog.getDouble(
            self._window, "Creases", words, shading.crease, LEAST_CREASE, 180 - LEAST_CREASE, 1
        )
        if chosen:
            self._shade(crease=crease, normals="creased")

    def _shade(self, **changes) -> None:
        session = self._window.session
        session.show(replace(session.document, shading=replace(session.document.shading, **changes)))

    def style(self, word: str) -> None:
        """One of the drawing's styles, for the panels and for the figures to come; the map stays as it is."""
        window = self._window
        chosen = map_word(window.page.style, window.session.document.colours)
        window.page = replace(window.page, style=word)
        window.apply_theme()
        if chosen is not None:
            self.colour_map(chosen)
        self.show()

    # ------------------------------------------------------------------ colours
    def _colour(self, colours: Colours) -> None:
        session = self._window.session
        if colours != session.document.colours:
            session.show(replace(session.document, colours=colours))
        self.show()

    def colour_map(self, word: str) -> None:
        """One of the drawing's maps; that of the style is not named."""
        now = self._window.session.document.colours
        is_own = word == map_word(self._window.page.style, Colours())
        self._colour(Colours("" if is_own else word, (), now.reversed, now.bands))

    def reverse_colours(self, is_on: bool) -> None:
        self._colour(replace(self._window.session.document.colours, reversed=is_on))

    def band_colours(self, is_on: bool) -> None:
        self._colour(replace(self._window.session.document.colours, bands=is_on))

    def ask_colours(self) -> None:
        """A map from a file."""
        window = self._window
        path, _ = QtWidgets.QFileDialog.getOpenFileName(
            window, "Colours from a file", window.preferences.last_folder, COLOUR_FILES
        )
        if path:
            self.take_colours(path)

    def take_colours(self, path: str) -> None:
        """The map in a file, or a sentence why there is none."""
        now = self._window.session.document.colours
        try:
            self._colour(Colours(Path(path).stem, read_stops(path), now.reversed, now.bands))
        except ParameterError as error:
            self._window.failed(str(error))

    # ------------------------------------------------------------------ ranges
    def range(self, word: str) -> None:
        """One of RANGES."""
        session = self._window.session
        session.show(with_range(session.document, word))
        self.show()

    def end_at(self, panel: int, end: float | None) -> None:
        """Where a panel's colour bar ends, its own maximum if None."""
        session = self._window.session
        session.show(end_at(session.document, panel, end))

    def ask_end(self) -> None:
        """Let the active panel's be typed."""
        grid = self._window.grid
        if grid is not None and grid.active >= 0:
            grid.panel(grid.active).ask_end()
        self.show()  # nothing has been chosen yet

    def ask_ends(self) -> None:
        """Those of a session or recipe."""
        window = self._window
        path, _ = QtWidgets.QFileDialog.getOpenFileName(
            window, "Ranges from a session or recipe", window.preferences.last_folder, "Sessions and recipes (*.json)"
        )
        if path:
            self.ends.take(path)

    # ------------------------------------------------------------------ the window
    def theme(self, word: str) -> None:
        """ "light", "dark" or "desktop"."""
        LOOK.choose(word)
        self._prefer(replace(self._window.preferences, theme=word))
        self.show()

    def toggle_full_screen(self) -> None:
        """Panels and their bars only, in larger letters; and back."""
        state, full = self._window.windowState(), QtCore.Qt.WindowState.WindowFullScreen
        self._show_full_screen(not self.is_full_screen)
        self._window.setWindowState(state | full if self.is_full_screen else state & ~full)

    def window_state_changed(self) -> None:
        """The desktop may end it, too."""
        if self.is_full_screen and not self._window.isFullScreen():
            self._show_full_screen(False)

    def _show_full_screen(self, is_full: bool) -> None:
        window, self.is_full_screen = self._window, is_full
        for bar in (window.menuBar(), window.tool_bar, window.status):
            bar.setVisible(not is_full)
        LOOK.enlarge(TALK if is_full else 1.0)
        window.actions_by_word["full screen"].setChecked(is_full)

    def remember_place(self) -> None:
        """Where the window stands, for the next start."""
        if not self.is_full_screen:
            self._prefer(replace(self._window.preferences, geometry=bytes(self._window.saveGeometry())))

    def ask_preferences(self) -> None:
        from .pages.preferences_dialog import PreferencesDialog

        dialog = PreferencesDialog(self._window.preferences, self._window)
        dialog.accepted.connect(lambda: self._take(dialog.chosen()))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _take(self, preferences: Preferences) -> None:
        window = self._window
        has_switched = preferences.snap != window.preferences.snap
        self._prefer(preferences)
        if has_switched:
            window.session.keep_snapping(preferences.snap)
        self.theme(preferences.theme)
        if window.grid is not None:
            window.grid.turn_wheel(-1.0 if preferences.wheel_reversed else 1.0)
            window.grid.turn_upright(preferences.turntable)

    def prefer(self, **changes) -> None:
        """Other values of some preferences."""
        self._prefer(replace(self._window.preferences, **changes))

    def _prefer(self, preferences: Preferences) -> None:
        self._window.preferences = preferences
        if self._window.remembers:
            save(preferences)
