"""The window: shows what a `Session` shows, and hands on what the user does.  Decides nothing itself.

It opens at once and imports what draws (VTK) only then.
"""

import os
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, errors

from ..document.document import Document
from ..document.history import LONGEST, MOST_BYTES, History
from ..document.on_surface import item_counts
from ..document.page import Page, Recipe
from ..document.settings import Preferences
from ..document.tools import tools
from ..scene.prepared import prepare
from ..scene.style import STYLES
from ..session.loaded_mesh import LoadedMesh
from ..session.session import Session
from . import remembered
from .actions import Actions
from .acts import ALL
from .bars.menus import Menus
from .bars.ticks import Ticks
from .bars.tool_bar import ToolBar
from .changes import Changes
from .choices import Choices
from .context import Context
from .dragging import Dragging
from .files.exports import ExportBadge, Exports
from .files.field_files import FieldFiles
from .files.files import Files
from .files.session_actions import SessionFile
from .guide import Guide
from .held_keys import HeldKeys
from .look.form import in_column, quiet_label
from .look.icons import window_icon
from .look.look import LOOK
from .pages.messages import Notice, Question, tell
from .preferences import fit_to_screen
from .progress_display import ProgressDisplay
from .status_bar import StatusBar, unseen
from .unexpected_errors import UnexpectedErrors
from .views import Views

if TYPE_CHECKING:
    from .pages.start_page import StartPage
    from .panels.grid import PanelGrid

LONGEST_NOTICE = 160
"""Letters of a message that needs no dialog."""

NOTICE_SECONDS = 20

DISCARDED = f"The oldest steps can no longer be undone: {LONGEST:,} steps or {MOST_BYTES / 1e6:.0f} MB are kept."

PLACE_MS = 2000
"""The window's size is remembered so long after it has changed."""


class MainWindow(QtWidgets.QMainWindow):
    """The window of the program; other parts know its `context`.

    `undrawable` is called with the reason where panels cannot be drawn; without it, that is raised.
    """

    def __init__(self, document: Document | None = None, preferences: Preferences | None = None) -> None:
        super().__init__()
        self.setWindowTitle("Biharmonic distance[*]")
        self.setWindowIcon(window_icon())
        self.status = StatusBar(self)
        self.setStatusBar(self.status)
        self.context = context = Context(self, preferences or Preferences(), self.status)
        self.session = context.session = Session(self, context.post, prepare, document, remembered.up_of)
        self.complete, self.refused, self.closed = context.complete, context.refused, context.closed
        self.actions_by_word = Actions(context, ALL)
        self.menus = Menus(context)
        self.tool_bar = ToolBar(context, self.menus)
        self.addToolBar(self.tool_bar)
        self._ticks = Ticks(context, self.actions_by_word, self.menus, self.tool_bar)
        self.status.insert(ExportBadge(context[Exports]))
        self.status.marks_wanted.connect(context.actions["dock surface"].trigger)
        context.failed.connect(self.failed)
        context[Files].dropping.connect(self._show_dropping)
        _ = context[UnexpectedErrors]
        changes, display = context[Changes], context[ProgressDisplay]
        changes.answered.connect(self.answer_changed)
        changes.surfaces_changed.connect(self._show_surfaces)
        display.shown.connect(self.announce_soon)
        display.opening.connect(self.show_opening)
        display.nothing_open.connect(self.show_start)
        self.undrawable: Callable[[str], None] | None = None
        self._start_page: StartPage | None = None
        self._shortened: History | None = None  # of whose discarded steps the user knows
        self.notice = Notice()
        # Not only at the end, which may come without a word.
        self._place_soon = QtCore.QTimer(self, singleShot=True, interval=PLACE_MS)
        self._place_soon.timeout.connect(lambda: context[Choices].remember_place())
        self._opening = quiet_label()
        self._opening.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
        # However long a file's name is, the window may be narrow.
        self._opening.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Preferred)
        self._stack = QtWidgets.QStackedWidget()
        self._stack.addWidget(self._opening)
        middle = QtWidgets.QWidget()
        in_column(self.notice, (self._stack, 1), of=middle, spacing=0)
        self.setCentralWidget(middle)
        LOOK.apply_theme(self)
        LOOK.follow(self, context.style_changed.emit)
        context.opening.connect(self.notice.clear)
        context[SessionFile].left_unsaved.connect(self._offer_undo)
        fit_to_screen(self)
        self.setMinimumSize(320, 240)
        self._allow(False)
        self._ticks.show()

    # ------------------------------------------------------------------ start and end
    def build_panels(self) -> None:
        """Import what draws and make the panels; called once, after the window is on the screen."""
        context = self.context
        if context.is_built:
            return
        from .docks.brushing import Brushing
        from .docks.docks import Docks
        from .gestures import Gestures
        from .panels.grid import PanelGrid

        try:
            grid = PanelGrid(self.session)
        except BihdistError as error:  # there is no OpenGL
            if self.undrawable is None:
                raise
            self.undrawable(str(error))
            raise errors.Cancelled("Nothing can be drawn.") from None
        grid.keys = self.actions_by_word.key_of_view
        grid.follow_preferences(context.preferences)
        context.preferred.connect(lambda _: grid.follow_preferences(context.preferences))
        grid.occlusion.failed.connect(context.fail)
        self._scroll = QtWidgets.QScrollArea(widgetResizable=True)
        self._scroll.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        self._scroll.setWidget(grid)
        self._stack.addWidget(self._scroll)
        findings = [tool.load(tool.findings) for tool in tools() if tool.findings]
        for tool in tools():
            if tool.marks:
                tool.load(tool.marks)  # imported while nobody waits, and not when a mesh has come
        context.build(grid, (HeldKeys, Brushing, *findings, Gestures, Docks))
        self._docks, self._gestures = context[Docks], context[Gestures]
        choices, display = context[Choices], context[ProgressDisplay]
        grid.looked.connect(context[Views].moved)
        grid.quantity_chosen.connect(choices.choose)
        grid.slider_let_go.connect(choices.let_go)
        grid.edit_chosen.connect(choices.edit_panel)
        grid.bar_ended.connect(choices.end_at)
        grid.save_wanted.connect(context[FieldFiles].save)
        grid.cancelled.connect(display.stop)
        grid.retried.connect(display.retry)
        context.style_changed.emit()
        if self.session.loaded() is None and not self.session.is_opening:
            self.show_start()

    @property
    def grid(self) -> "PanelGrid":
        """The panels; RuntimeError before they are built."""
        return self.context.grid

    def show_document(
        self, document: Document, page: Page | None = None, on_done: Callable[[], None] = lambda: None
    ) -> None:
        """Show a document from elsewhere, see `SessionFile.show_document`."""
        self.context[SessionFile].show_document(document, page, on_done)

    def show_opening(self, words: str) -> None:
        """Say that the first mesh is being read."""
        room, cut = self._stack.width() - 48, QtCore.Qt.TextElideMode.ElideMiddle
        self._opening.setText(self._opening.fontMetrics().elidedText(words, cut, room))
        self._stack.setCurrentWidget(self._opening)

    def show_start(self) -> "StartPage":
        """Show the start page: how to begin."""
        if self._start_page is None:
            from .pages.start_page import StartPage

            self._start_page = StartPage()
            files, guide = self.context[Files], self.context[Guide]
            self._start_page.open_wanted.connect(files.choose)
            self._start_page.chosen.connect(files.open)
            self._start_page.guide_wanted.connect(guide.open_guide)
            self._stack.addWidget(self._start_page)
        self._stack.setCurrentWidget(self._start_page)
        return self._start_page

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        context, choices = self.context, self.context[Choices]
        if not (context.quiet or context[SessionFile].may_close(self._ask_about_changes)):
            event.ignore()
            return
        context[SessionFile].forget()
        self._place_soon.stop()
        if context.remembers:
            choices.remember_place()
        self.hide()  # what is still being computed may take a moment to end
        context[Exports].close()
        self.session.close()
        if context.is_built:
            self._docks.close_all()
            self.grid.close_views()
        if choices.is_full_screen:
            LOOK.enlarge(1.0)
        super().closeEvent(event)
        self.closed.emit()

    def _ask_about_changes(self, question: str) -> str:
        role = QtWidgets.QMessageBox.ButtonRole
        buttons = {"Save": role.AcceptRole, "Discard": role.DestructiveRole, "Cancel": role.RejectRole}
        box = Question(question, buttons, self, "save")
        box.exec()
        return box.chosen.lower() or "cancel"

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        if self.context.remembers:
            self._place_soon.start()

    def changeEvent(self, event: QtCore.QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QtCore.QEvent.Type.WindowStateChange:
            self.context[Choices].window_state_changed()

    # ------------------------------------------------------------------ what the session tells
    def document_changed(self, before: Document) -> None:
        """Show the session's document, where the one before is shown."""
        self.build_panels()
        context = self.context
        context[SessionFile].follow_origin()
        if self.notice.kind == "plain":
            self.notice.clear()  # its Undo would take back something else
        if self.session.loaded() is None:
            self._show_closed()
        else:
            self._stack.setCurrentWidget(self._scroll)
            context[Changes].show(before)
        self._offer_steps()
        self._ticks.show()
        context.document_changed.emit(before)
        self.status.document_changed()
        self.status.show_marks(*item_counts(self.session.document))
        context[ProgressDisplay].expect(before)
        context[SessionFile].document_changed(before)
        history = self.session.history
        if history.discarded and self._shortened is not history:
            self._shortened = history
            context.tell(DISCARDED)

    def _show_closed(self) -> None:
        """Show the start page again, when all meshes have been closed."""
        self.context[Changes].show_none()
        self._gestures.begin()
        self._allow(False)
        self.status.show_surface(None)
        self.show_start().refresh()

    def _show_surfaces(self, loaded: tuple[LoadedMesh, ...], is_remade: bool) -> None:
        """Show other surfaces in the panels.

        With `is_remade` they are made from the first, which stays, so that whoever made them goes on.
        """
        context, first, beside = self.context, loaded[0], loaded[1:]
        if not is_remade:
            self._allow(True)
            context[Views].begin()
        self._gestures.begin()
        more = unseen(Recipe(self.session.document, context.page), STYLES[context.page.style])
        self.status.show_surface(first.surface, more, [each.surface for each in beside])
        if is_remade:
            return
        context.focus_panels()
        for each in (*beside, first) if context.remembers else ():
            if each.mesh.path and os.path.exists(each.mesh.path):
                remembered.remember(each.mesh.path)

    def answer_changed(self, panel: int) -> None:
        """Show another answer in a panel."""
        self.grid.show_answer(panel)
        self.context[Dragging].rate.note()
        self._tell_of_answer(panel)

    def error_estimate_changed(self, panel: int) -> None:
        """Show in a panel's head how accurate its answer is."""
        self.grid.show_error_estimate(panel)
        self._tell_of_answer(panel)
        self.announce_soon()

    def _tell_of_answer(self, panel: int) -> None:
        self.context.answer_changed.emit(panel)
        self.context[ProgressDisplay].note(panel)
        self.status.show_inexact([shown.answer for shown in self.session.shown.values() if not shown.is_preview])

    def _offer_steps(self) -> None:
        self.actions_by_word["undo"].setEnabled(self.session.can_undo)
        self.actions_by_word["redo"].setEnabled(self.session.can_redo)

    def progress_changed(self) -> None:
        """Show how far the work is."""
        self._offer_steps()
        self.context[ProgressDisplay].progress_changed()

    def failed(self, message: str) -> None:
        """Say why something could not be opened or done."""
        self.refused.emit(message)
        if self.session.loaded() is None and self.context.is_built:
            self.context[ProgressDisplay].end()
            self.show_start().show_message(message)
        elif not (self.context.quiet or self.context[UnexpectedErrors].are_telling(message)):
            self._tell(message)

    def _tell(self, message: str) -> None:
        """Show a message above the panels, or in a dialog if it is long or another dialog is open."""
        if len(message) > LONGEST_NOTICE or QtWidgets.QApplication.activeModalWidget() is not None:
            tell(self, message)
        else:
            copy = partial(QtWidgets.QApplication.clipboard().setText, message)
            self.notice.show_text(message, "error", ("Copy", copy), NOTICE_SECONDS)

    def _offer_undo(self, sentence: str) -> None:
        """Tell what only undo brings back, as another mesh was opened."""
        if not self.context.quiet:
            self.notice.show_text(sentence, action=("Undo", self.session.undo), seconds=NOTICE_SECONDS)

    def announce_soon(self) -> None:
        """Announce that the panels are complete, once they have been repainted."""
        if self.session.is_complete and not self.session.progress:
            QtCore.QTimer.singleShot(0, self._announce)

    def _announce(self) -> None:
        if self.session.is_complete and not self.session.progress:
            self.complete.emit()

    def _allow(self, has_mesh: bool) -> None:
        for part in (self.actions_by_word, self.menus, self.tool_bar):
            part.allow(has_mesh)
        self._offer_steps()

    # ------------------------------------------------------------------ the keys
    def focusNextPrevChild(self, is_next: bool) -> bool:
        """Tab; but what is hidden or disabled while it has the keys gives them to the panels, not to the next."""
        now = self.focusWidget()
        is_lost = now is not None and not (now.isVisible() and now.isEnabled())
        if is_lost and self.context.is_built and self._stack.currentWidget() is self._scroll:
            self.context.focus_panels()
            return True
        return bool(super().focusNextPrevChild(is_next))

    def _show_dropping(self, is_dropping: bool) -> None:
        """Show on the start page whether something that can be dropped is held over the window."""
        if self._start_page is not None:
            self._start_page.set_dropping(is_dropping)
