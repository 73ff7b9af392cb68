"""What the user chooses: panels, isolines, colours, ranges, preferences.  `window` is the main window throughout."""

from dataclasses import replace

from qtpy import QtCore, QtWidgets

from ..document.edits import MOST_ADDED, PANEL_EDITS, add_another, possible_edits
from ..document.looks import MOST_ISOLINES
from .look.canvas import STYLE_NAMES
from .look.look import LOOK, TALK
from .preferences import Preferences, save


class Choices:
    """Edits of the document and of the page; menus and buttons say what is chosen."""

    def __init__(self, window) -> None:
        self._window = window
        self.is_full_screen = False

    def show(self) -> None:
        """Let menus and buttons say what is chosen."""
        window, document, style = self._window, self._window.session.document, self._window.page.style
        self.show_view()
        for name, value in {
            "isolines": str(document.isolines.count),
            "colours": STYLE_NAMES.get(style, style),
            "range": document.range.capitalize(),
        }.items():
            window.tools[name].show_value(value)
        menus = window.menus
        menus.show_choice(menus.isolines, str(document.isolines.count))
        menus.show_choice(menus.colours, style)
        menus.show_choice(menus.range, document.range)
        menus.show_choice(menus.theme, LOOK.choice)

    def show_view(self) -> None:
        """Let the button of views say what is seen."""
        camera = self._window.session.document.camera
        self._window.tools["views"].show_value(camera.capitalize() if isinstance(camera, str) else "Free")

    # ------------------------------------------------------------------ panels
    def add_panel(self) -> None:
        """One more, with a distance that is not shown yet."""
        session = self._window.session
        if session.surface is not None and len(session.document.panels) < MOST_ADDED:
            session.show(add_another(session.document))

    def edit_panel(self, panel: int, word: str) -> None:
        """One of PANEL_EDITS, where it is possible."""
        session = self._window.session
        is_there = any(shown.id == panel for shown in session.document.panels)
        if is_there and word in possible_edits(session.document, panel, MOST_ADDED):
            session.show(PANEL_EDITS[word](session.document, panel))

    # ------------------------------------------------------------------ how fields are shown
    def isolines(self, count: int) -> None:
        session = self._window.session
        now = session.document.isolines
        session.show(replace(session.document, isolines=replace(now, count=count)), key="isolines")

    def ask_isolines(self) -> None:
        now = self._window.session.document.isolines.count
        count, chosen = QtWidgets.QInputDialog.getInt(
            self._window, "Isolines", "Equal steps from 0 to each panel's maximum:", now, 0, MOST_ISOLINES
        )
        if chosen:
            self.isolines(count)

    def range(self, word: str) -> None:
        """ "own" or "shared"."""
        session = self._window.session
        session.show(replace(session.document, range=word))

    def style(self, word: str) -> None:
        """One of the drawing's styles, for the panels and for the figures to come."""
        window = self._window
        window.page = replace(window.page, style=word)
        window.wear()
        self.show()

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
        self._prefer(preferences)
        self.theme(preferences.theme)
        if window.grid is not None:
            window.grid.turn_wheel(-1.0 if preferences.wheel_reversed else 1.0)

    def _prefer(self, preferences: Preferences) -> None:
        self._window.preferences = preferences
        if self._window.remembers:
            save(preferences)
