"""The window: shows what a `Session` shows, and hands on what the user does.  Decides nothing itself.

It opens at once and imports what draws (VTK) only then.
"""

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from qtpy import QtCore, QtGui, QtWidgets

from ..document.camera import View as CameraView
from ..document.document import Document
from ..document.page import Page, Recipe
from ..scene.prepared import prepare
from ..scene.style import STYLES
from ..session.loaded_mesh import LoadedMesh
from ..session.session import Session
from . import remembered
from .actions import Actions
from .bars.menus import Menus
from .bars.status_bar import StatusBar, unseen
from .bars.tool_bar import ToolBar
from .changes import Changes
from .choices import Choices
from .files.curve_files import CurveFiles
from .files.exports import ExportChip, Exports
from .files.field_files import FieldFiles
from .files.files import Files
from .files.session_actions import SessionFile
from .held_keys import HeldKeys
from .look.look import LOOK
from .pages.guide import Guide
from .pages.messages import Notice, tell
from .preferences import Preferences, fit_to_screen
from .progress_display import ProgressDisplay
from .typed_source import TypedSource
from .views import Views

if TYPE_CHECKING:
    from .panels.view import View


LONGEST_NOTICE = 160
"""Letters of a message that needs no dialog."""

NOTICE_SECONDS = 20


class MainWindow(QtWidgets.QMainWindow):
    """`complete` is emitted whenever every panel has been painted with its final answer.

    page: of the recipe that was opened last, for the figures that are exported.  quiet: no questions and no messages.
    remembers: recent files, preferences and, in case of a crash, what is shown.
    """

    complete = QtCore.Signal()
    refused = QtCore.Signal(str)  # a message the user was shown
    picked = QtCore.Signal(int, object)  # a panel, and the `Hit` that was clicked in it, before the source goes there
    closed = QtCore.Signal()
    _posted = QtCore.Signal(object)

    def __init__(self, document: Document | None = None, preferences: Preferences | None = None) -> None:
        super().__init__()
        self.setWindowTitle("Biharmonic distance[*]")
        self.preferences = preferences or Preferences()
        self._posted.connect(lambda function: function())
        self.session = Session(self, self._posted.emit, prepare, document, remembered.up_of)
        self.page = Page()
        self.session_file = SessionFile(self)
        self.files, self.choices, self.guide = Files(self), Choices(self), Guide(self)
        self.exports, self.curve_files, self.field_files = Exports(self), CurveFiles(self), FieldFiles(self)
        self.grid: Any = None  # a PanelGrid, once what draws has been imported
        self.gestures: Any = None  # what the mouse means in it
        self.docks: Any = None  # the instruments
        self.held_keys: Any = None
        self._start_page: Any = None
        self._waiting: list[Callable[[], None]] = []
        self.quiet = False
        self.remembers = True
        self.actions_by_word = Actions(self)
        self.menus = Menus(self)
        self.tool_bar = ToolBar(self, self.actions_by_word, self.menus)
        self.tools = self.tool_bar.buttons
        self.source_box = self.tool_bar.source_box
        self.typed_source = TypedSource(self)
        self.addToolBar(self.tool_bar)
        self.status = StatusBar(self, ExportChip(self.exports))
        self.setStatusBar(self.status)
        self.views, self.changes = Views(self), Changes(self)
        self.progress_display = ProgressDisplay(self)
        self.notice = Notice()
        self._opening = QtWidgets.QLabel("Opening…")
        self._opening.setProperty("quiet", True)
        self._opening.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
        # However long a file's name is, the window may be narrow.
        self._opening.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Preferred)
        self._stack = QtWidgets.QStackedWidget()
        self._stack.addWidget(self._opening)
        middle = QtWidgets.QWidget()
        column = QtWidgets.QVBoxLayout(middle)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.notice)
        column.addWidget(self._stack, 1)
        self.setCentralWidget(middle)
        LOOK.apply_theme(self)
        LOOK.follow(self, self.apply_theme)
        fit_to_screen(self)
        self.setMinimumSize(320, 240)
        self._allow(False)
        self.choices.show()

    # ------------------------------------------------------------------ start and end
    def build_panels(self) -> None:
        """Import what draws and make the panels; called once, after the window is on the screen."""
        if self.grid is not None:
            return
        from .docks.docks import Docks
        from .gestures import Gestures
        from .panels.grid import PanelGrid

        self.grid = PanelGrid(self.session)
        self.grid.keys = self.actions_by_word.key_of_view
        self.grid.wheel_factor = -1.0 if self.preferences.wheel_reversed else 1.0
        self.grid.eye.is_turntable = self.preferences.turntable
        self.held_keys = HeldKeys(self)
        self.gestures = Gestures(self)
        self.docks = Docks(self)
        self.grid.chosen.connect(self.gestures.choose)
        self.grid.asked.connect(self.choices.edit_panel)
        self.grid.ended.connect(self.choices.end_at)
        self.grid.looked.connect(self.views.moved)
        self.grid.cancelled.connect(self.progress_display.stop)
        self.grid.retried.connect(self.progress_display.retry)
        self.grid.save_wanted.connect(self.field_files.save)
        self.apply_theme()
        self._scroll = QtWidgets.QScrollArea()
        self._scroll.setWidgetResizable(True)
        self._scroll.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        self._scroll.setWidget(self.grid)
        self._stack.addWidget(self._scroll)
        waiting, self._waiting = self._waiting, []
        for function in waiting:
            function()
        if self.session.surface is None and not self.session.is_opening:
            self.show_start()

    def open(self, path: str, source: int | None = None) -> None:
        """Open a mesh, also before the panels are made."""
        self.notice.clear()
        self.session.open(path, source)

    def show_document(
        self, document: Document, page: Page | None = None, arrived: Callable[[], None] = lambda: None
    ) -> None:
        """Show a document from elsewhere, also before the panels are made.

        page: in whose style, the present one's if None; arrived: called when it is there.
        """

        def arriving() -> None:
            if page is not None:
                self.take_page(page)

        def restoring() -> None:
            self.once_built(lambda: self.docks.restore(document.dock_places))
            self.session_file.take_as_given()
            arrived()

        self.session.show_instead(document, arriving, restoring)

    def once_built(self, function: Callable[[], None]) -> None:
        if self.grid is None:
            self._waiting.append(function)
        else:
            function()

    def show_opening(self, words: str) -> None:
        """The first mesh is being read."""
        room, cut = self._stack.width() - 48, QtCore.Qt.TextElideMode.ElideMiddle
        self._opening.setText(self._opening.fontMetrics().elidedText(words, cut, room))
        self._stack.setCurrentWidget(self._opening)

    def show_start(self) -> None:
        """Nothing is open: how to begin."""
        if self._start_page is None:
            from .pages.start_page import StartPage

            self._start_page = StartPage()
            self._start_page.open_wanted.connect(self.files.choose)
            self._start_page.chosen.connect(self.files.open)
            self._start_page.tour_wanted.connect(self.guide.start_tour)
            self._start_page.commands_wanted.connect(self.guide.show_commands)
            self._stack.addWidget(self._start_page)
        self._stack.setCurrentWidget(self._start_page)

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        if not (self.quiet or self.session_file.may_close(self._ask_about_changes)):
            event.ignore()
            return
        self.session_file.forget()
        if self.remembers:
            self.choices.remember_place()
        self.exports.close()
        self.session.close()
        if self.grid is not None:
            self.docks.close_all()
            self.grid.close_views()
        if self.choices.is_full_screen:
            LOOK.enlarge(1.0)
        super().closeEvent(event)
        self.closed.emit()

    def _ask_about_changes(self, question: str) -> str:
        button = QtWidgets.QMessageBox.StandardButton
        answer = QtWidgets.QMessageBox.question(
            self, "Biharmonic distance", question, button.Save | button.Discard | button.Cancel, button.Save
        )
        return {button.Save: "save", button.Discard: "discard"}.get(answer, "cancel")

    def changeEvent(self, event: QtCore.QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QtCore.QEvent.Type.WindowStateChange:
            self.choices.window_state_changed()

    # ------------------------------------------------------------------ what the session tells
    def document_changed(self, before: Document) -> None:
        self.build_panels()
        self._stack.setCurrentWidget(self._scroll)
        self.changes.show(before)
        self._offer_steps()
        self.choices.show()
        self.docks.document_changed()
        self.status.document_changed()
        self.progress_display.expect(before)
        self.session_file.document_changed()

    def take_page(self, page: Page) -> None:
        """Look as figures on this page do, from the next change of the document on."""
        if page != self.page:
            self.page = page
            self.changes.apply_theme_next()

    def surface_changed(self, loaded: LoadedMesh, *beside: LoadedMesh) -> None:
        """Another surface comes into the panels, or beside that which is there."""
        self._allow(True)
        self.views.begin()
        self.surface_remade(loaded, *beside)
        self.leave_boxes()
        for each in (*beside, loaded) if self.remembers else ():
            if each.mesh.path and os.path.exists(each.mesh.path):
                remembered.remember(each.mesh.path)

    def surface_remade(self, loaded: LoadedMesh, *beside: LoadedMesh) -> None:
        """The same of surfaces that are made from the first, which stays: whoever made them goes on."""
        self.gestures.begin()
        recipe = Recipe(self.session.document, self.page)
        more = unseen(recipe, STYLES[self.page.style])
        self.status.show_surface(loaded.surface, more, [each.surface for each in beside])

    def answer_changed(self, panel: int) -> None:
        self.grid.show_answer(panel)
        self.gestures.sources.rate.note()
        self.gestures.pairs.show_meant()
        self.docks.answer_changed(panel)
        self.progress_display.note(panel)
        self._say_what_is_inexact()

    def error_estimate_changed(self, panel: int) -> None:
        self.grid.show_error_estimate(panel)
        self.docks.answer_changed(panel)
        self.progress_display.note(panel)
        self._say_what_is_inexact()
        self.announce_soon()

    def _say_what_is_inexact(self) -> None:
        self.status.show_inexact([shown.answer for shown in self.session.shown.values() if not shown.is_preview])

    def _offer_steps(self) -> None:
        self.actions_by_word["undo"].setEnabled(self.session.can_undo)
        self.actions_by_word["redo"].setEnabled(self.session.can_redo)

    def progress_changed(self) -> None:
        self._offer_steps()
        self.progress_display.progress_changed()

    def failed(self, message: str) -> None:
        self.refused.emit(message)
        if self.session.surface is None and self.grid is not None:
            self.progress_display.end()
            self.show_start()
            self._start_page.show_message(message)
        elif not self.quiet:
            self._tell(message)

    def _tell(self, message: str) -> None:
        """Above the panels; what is longer, or said while a dialog is open, in a dialog."""
        if len(message) > LONGEST_NOTICE or QtWidgets.QApplication.activeModalWidget() is not None:
            tell(self, message)
            return

        def copy() -> None:
            QtWidgets.QApplication.clipboard().setText(message)

        self.notice.show_text(message, "error", ("Copy", copy), NOTICE_SECONDS)

    def announce_soon(self) -> None:
        """Once the repaints that are queued have been done."""
        if self.session.is_complete and not self.session.progress:
            QtCore.QTimer.singleShot(0, self._announce)

    def _announce(self) -> None:
        if self.session.is_complete and not self.session.progress:
            self.complete.emit()

    # ------------------------------------------------------------------ what the user chooses
    def cancel(self) -> None:
        """Esc: out of the tour, a box, the live source or the full screen; otherwise stop what is being computed."""
        if self.guide.end_tour():
            return
        if self.source_box.hasFocus():
            self.source_box.give_up()
            self.leave_boxes()
        elif self.docks is not None and self.docks.put_down():
            return
        elif self.gestures is not None and self.gestures.sources.is_drawing:
            self.actions_by_word["draw source"].trigger()
        elif self.gestures is not None and self.gestures.is_live:
            self.actions_by_word["live"].trigger()
        elif self.gestures is not None and self.gestures.pairs.drop():
            return
        elif self.session.progress or not self.choices.is_full_screen:
            self.session.cancel()
            self.progress_display.show()
            if self.docks is not None:
                self.docks.show_stopped()
        else:
            self.choices.toggle_full_screen()

    def with_view(self, do: "Callable[[View], object]") -> None:
        """Do something to the view of the active panel."""
        if self.session.surface is not None and self.grid.active >= 0:
            do(self.grid.panel(self.grid.active).view)

    def reset_view(self, view: CameraView = "auto") -> None:
        """See the surface from a standard view, or from where a camera is."""
        if self.session.surface is not None:
            self.views.see(view)

    # ------------------------------------------------------------------ how it looks
    def apply_theme(self) -> None:
        """Other colours, or another style of the fields."""
        self.changes.apply_theme()

    def _allow(self, has_mesh: bool) -> None:
        self.actions_by_word.allow(has_mesh)
        self.menus.allow(has_mesh)
        self.tool_bar.allow(has_mesh)
        self._offer_steps()

    # ------------------------------------------------------------------ the keys
    def leave_boxes(self) -> None:
        """Give the keys to the panels."""
        if self.grid is not None:
            self.grid.focus()

    def focusNextPrevChild(self, is_next: bool) -> bool:
        """Tab; but what is hidden or disabled while it has the keys gives them to the panels, not to the next."""
        now = self.focusWidget()
        is_lost = now is not None and not (now.isVisible() and now.isEnabled())
        if is_lost and self.grid is not None and self._stack.currentWidget() is self._scroll:
            self.leave_boxes()
            return True
        return super().focusNextPrevChild(is_next)

    def change_part(self) -> None:
        """From the panels to the tool bar, and back."""
        if self.tool_bar.isAncestorOf(self.focusWidget() or self):
            self.leave_boxes()
        else:
            self.tools["open"].setFocus(QtCore.Qt.FocusReason.TabFocusReason)

    def show_dropping(self, is_dropping: bool) -> None:
        """Whether something is held over the window that may be dropped."""
        if self._start_page is not None:
            self._start_page.set_dropping(is_dropping)

    def say(self, text: str, holds: Callable[[], bool] | None = None) -> None:
        """In the status bar, for a while; holds: whether it is true, asked as the document changes."""
        self.status.say(text, holds)
