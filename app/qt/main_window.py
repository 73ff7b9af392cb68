"""The window: shows what a `Session` shows, and hands on what the user does.  Decides nothing itself.

It opens at once and imports what draws (VTK, pyvista) only then.
"""

import os
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, OutputError
from bihdist_core.whole_file import check_output, whole_file

from ..document.document import Document
from ..document.edits import PANEL_EDITS, add_another, move_source, show_in
from ..document.page import Page, Recipe
from ..document.quantities import Quantity
from ..drawing.prepared import prepare
from ..drawing.style import STYLES
from ..session.opened import Opened
from ..session.questions import vertex_at
from ..session.session import Session
from . import remembered
from .bars import fill_menus, fill_tool_bar, no_source, show_source
from .controls import MOST_PANELS
from .look import STYLE_SHEET
from .session_actions import MESH_FILES, SESSIONS, SessionFile
from .status_bar import StatusBar, summary, unseen
from .views import Views

if TYPE_CHECKING:
    from ..drawing.picking import Met

PROGRESS_MS = 200
"""How often progress is shown at most, and from when on."""


class MainWindow(QtWidgets.QMainWindow):
    """`complete` is emitted whenever every panel has been painted with its final answer.

    page: of the recipe that was opened last, for the figures that are exported.  quiet: no questions and no messages.
    remembers: recent files and, in case of a crash, what is shown.
    """

    complete = QtCore.Signal()
    refused = QtCore.Signal(str)  # a message the user was shown
    picked = QtCore.Signal(int, object)  # a panel, and the `Met` that was clicked in it, before the source goes there
    closed = QtCore.Signal()
    _posted = QtCore.Signal(object)

    def __init__(self, document: Document | None = None) -> None:
        super().__init__()
        self.setWindowTitle("Biharmonic distance")
        self.setAcceptDrops(True)
        self.resize(1322, 660)
        self.setStyleSheet(STYLE_SHEET)
        self._posted.connect(lambda function: function())
        self.session = Session(self, self._posted.emit, prepare, document)
        self.page = Page()
        self.session_file = SessionFile(self)
        self.grid: Any = None  # a PanelGrid, once what draws has been imported
        self._opened: Opened | None = None  # the surface in the panels
        self._hovered: int | None = None
        self._waiting: list[Callable[[], None]] = []
        self.quiet = False
        self.remembers = True
        self.status = StatusBar(self)
        self.status.cancelled.connect(self.session.cancel)
        self.setStatusBar(self.status)
        self.views = Views(self)
        self._progress_soon = QtCore.QTimer(self, singleShot=True, interval=PROGRESS_MS)
        self._progress_soon.timeout.connect(self._show_progress)
        self.source_box, self.isolines_box = fill_tool_bar(self)
        self._undo, self._redo = fill_menus(self)
        self._empty = QtWidgets.QLabel("Opening …", objectName="hint")
        self._empty.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
        self._middle = QtWidgets.QStackedWidget()
        self._middle.addWidget(self._empty)
        self.setCentralWidget(self._middle)
        no_source(self.source_box)

    # ------------------------------------------------------------------ start and end
    def build_panels(self) -> None:
        """Import what draws and make the panels; called once, after the window is on the screen."""
        from .panel_grid import PanelGrid

        self.grid = PanelGrid(self.session)
        self.grid.clicked.connect(self._click)
        self.grid.dragged.connect(self._drag)
        self.grid.released.connect(lambda: self.session.show(self.session.document))
        self.grid.chosen.connect(self._choose)
        self.grid.asked.connect(self._edit_panels)
        self.grid.hovered.connect(self._hover)
        self.grid.looked.connect(self.views.moved)
        self._middle.addWidget(self.grid)
        self._middle.setCurrentWidget(self.grid)
        self.leave_boxes()
        waiting, self._waiting = self._waiting, []
        for function in waiting:
            function()

    def open(self, path: str, source: int | None = None) -> None:
        """Open a mesh, also before the panels are made."""
        self._once_built(lambda: self.session.open(path, source))

    def show_document(
        self, document: Document, page: Page | None = None, arrived: Callable[[], None] = lambda: None
    ) -> None:
        """Show a document from elsewhere, also before the panels are made.

        page: in whose style, the present one's if None; arrived: called when it is there.
        """

        def arriving() -> None:
            if page is not None:
                self._take_page(page)

        self._once_built(lambda: self.session.show_instead(document, arriving, arrived))

    def _once_built(self, function: Callable[[], None]) -> None:
        if self.grid is None:
            self._waiting.append(function)
        else:
            function()

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        if not (self.quiet or self.session_file.may_close(self._ask_about_changes)):
            event.ignore()
            return
        self.session_file.forget()
        self.session.close()
        if self.grid is not None:
            self.grid.close_views()
        super().closeEvent(event)
        self.closed.emit()

    def _ask_about_changes(self, question: str) -> str:
        button = QtWidgets.QMessageBox.StandardButton
        answer = QtWidgets.QMessageBox.question(
            self, "Biharmonic distance", question, button.Save | button.Discard | button.Cancel, button.Save
        )
        return {button.Save: "save", button.Discard: "discard"}.get(answer, "cancel")

    # ------------------------------------------------------------------ what the session tells
    def document_changed(self, before: Document) -> None:
        document, opened = self.session.document, self.session.opened()
        self._middle.setCurrentWidget(self.grid)
        is_other = opened is not self._opened
        other_panels = is_other or (document.panels, document.fields) != (before.panels, before.fields)
        if other_panels:
            self.grid.show_panels(document)
        if is_other:
            self._show_surface(opened)
        if other_panels or document.points != before.points:
            self.grid.mark_points(document)
            self._show_source()
        if other_panels or (document.points, document.anchors) != (before.points, before.anchors):
            self.grid.mark_anchors(document)
        if other_panels or document.zooms != before.zooms:
            self.grid.show_insets(document)
        if is_other or document.isolines != before.isolines:
            with QtCore.QSignalBlocker(self.isolines_box):
                self.isolines_box.setValue(document.isolines)
            self.grid.show_isolines(document.isolines)
        is_raised = document.height != before.height
        if other_panels or is_raised or document.shared_range != before.shared_range:
            for panel in document.panels:
                if self.session.is_answered(panel.id):
                    self.answer_changed(panel.id)
        if is_other or is_raised or document.camera != before.camera:
            self.grid.look(document.camera)
            self.views.rest_soon()
        self._offer_steps()
        self.grid.repaint_views()
        self.session_file.document_changed()

    def _take_page(self, page: Page) -> None:
        """Look as figures on this page do, from the next change of the document on."""
        if page != self.page:
            self.grid.show_style(STYLES[page.style])
            self.page, self._opened = page, None  # all is shown anew

    def _say_what_is_open(self) -> None:
        recipe = Recipe(self.session.document, self.page)
        self.say("  ·  ".join([*summary(self.session.surface), *unseen(recipe, STYLES[self.page.style])]))

    def _show_surface(self, opened: Opened) -> None:
        self._opened, self._hovered = opened, None
        self.views.begin()
        self.setWindowTitle(f"{opened.surface.name} - Biharmonic distance")
        self.grid.show_surface()
        self._say_what_is_open()
        if self.remembers and opened.mesh.path and os.path.exists(opened.mesh.path):
            remembered.remember(opened.mesh.path)

    def answer_changed(self, panel: int) -> None:
        self.grid.show_answer(panel)
        self.grid.panel(panel).show_value(self._hovered)
        self._note(panel)

    def certificate_changed(self, panel: int) -> None:
        self.grid.show_certificate(panel)
        self._note(panel)
        if self.session.is_complete and not self.session.progress:
            QtCore.QTimer.singleShot(0, self._announce)

    def _offer_steps(self) -> None:
        self._undo.setEnabled(self.session.can_undo)
        self._redo.setEnabled(self.session.can_redo)

    def progress_changed(self) -> None:
        self._offer_steps()
        if not self.session.progress:
            self._show_progress()
        elif not self._progress_soon.isActive():
            self._progress_soon.start()

    def _show_progress(self) -> None:
        self._progress_soon.stop()
        going = [self.session.progress[name] for name in sorted(self.session.progress, key=str)]
        self.status.show_progress(going)
        for panel in self.session.document.panels if self.grid is not None else ():
            self._note(panel.id)
        if self.session.is_complete and not going:
            # Once the repaints that are queued have been done.
            QtCore.QTimer.singleShot(0, self._announce)

    def _note(self, panel: int) -> None:
        """Say in a panel what it is waiting for; how far that is, the status bar says, which is cheap to paint."""
        session = self.session
        _, text = session.progress.get(panel, (0, ""))
        if text:
            text = f"{text.partition(':')[0]} …"
        elif session.is_stopped and not session.is_answered(panel):
            text = "stopped; click a point to ask again"
        elif session.surface and panel not in session.shown and session.progress:
            text = "waiting …"
        self.grid.panel(panel).show_note(text)

    def failed(self, message: str) -> None:
        self.refused.emit(message)
        if self.session.surface is None:
            self._empty.setText(
                "No mesh is open. Open one with Ctrl+O, drop a file here, or choose one of File > Samples."
            )
            self._middle.setCurrentWidget(self._empty)
        if not self.quiet:
            # Above a dialog that is open, it would otherwise get no keys.
            above = QtWidgets.QApplication.activeModalWidget() or self
            box = QtWidgets.QMessageBox(
                QtWidgets.QMessageBox.Icon.Warning, "Biharmonic distance", message, parent=above
            )
            box.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
            box.open()

    def _announce(self) -> None:
        if self.session.is_complete and not self.session.progress:
            self.complete.emit()

    # ------------------------------------------------------------------ gestures
    def _click(self, panel: int, met: "Met") -> None:
        self.picked.emit(panel, met)
        self.session.show(move_source(self.session.document, panel, met.vertex))

    def _drag(self, panel: int, vertex: int) -> None:
        self.session.show(move_source(self.session.document, panel, vertex), key=f"drag in {panel}", live=True)

    def _choose(self, panel: int, shows: Quantity) -> None:
        """Another quantity is a step; the values that a slider passes are one."""
        before = self.session.document.panel(panel).shows
        words = [tuple(part.word for part in each.parts) for each in (before, shows)]
        key = f"{words[0]} in {panel}" if words[0] == words[1] else ""
        self.session.show(show_in(self.session.document, panel, shows), key)

    def add_panel(self) -> None:
        """One more, with a distance that is not shown yet."""
        document = self.session.document
        if self.session.surface is not None and len(document.panels) < MOST_PANELS:
            self.session.show(add_another(document))

    def _edit_panels(self, panel: int, word: str) -> None:
        self.session.show(PANEL_EDITS[word](self.session.document, panel))

    def choose_isolines(self, count: int) -> None:
        self.session.show(replace(self.session.document, isolines=count), key="isolines")

    def choose_source(self, vertex: int) -> None:
        """The vertex that the first panel's field starts from."""
        document = self.session.document
        if self.session.surface is not None and document.panels:
            self.session.show(move_source(document, document.panels[0].id, vertex))
            self._show_source()

    def _show_source(self) -> None:
        """Let the box say which vertex the first panel's field starts from."""
        sources = self.session.document.sources
        if self.session.surface is None or not sources:
            no_source(self.source_box)
        else:
            show_source(self.source_box, vertex_at(sources[0], self.session.surface))

    def cancel(self) -> None:
        """Esc: out of a box, which then says what it said before; elsewhere, stop what is being computed."""
        if self.source_box.hasFocus() or self.isolines_box.hasFocus():
            self._show_source()
            with QtCore.QSignalBlocker(self.isolines_box):
                self.isolines_box.setValue(self.session.document.isolines)
                self.isolines_box.lineEdit().setText(str(self.session.document.isolines))
            self.leave_boxes()
        else:
            self.session.cancel()

    def _hover(self, vertex: int | None) -> None:
        if vertex == self._hovered or self.session.surface is None:
            return
        self._hovered = vertex
        self.grid.point_at(vertex)
        if vertex is None:
            self.status.pointer.setText("")
        else:
            x, y, z = self.session.surface.vertices[vertex]
            self.status.pointer.setText(f"vertex {vertex}   ({x:.4g}, {y:.4g}, {z:.4g})")

    def dragEnterEvent(self, event: QtGui.QDragEnterEvent) -> None:
        if event.mimeData().hasUrls():
            event.acceptProposedAction()

    def dropEvent(self, event: QtGui.QDropEvent) -> None:
        self.open_any(event.mimeData().urls()[0].toLocalFile())

    # ------------------------------------------------------------------ the user's commands
    def reset_view(self, view: str = "home") -> None:
        """See the surface from a standard view."""
        if self.session.surface is not None:
            self.views.see(view)

    def leave_boxes(self) -> None:
        """A box that has the keyboard takes digits and Ctrl+E for itself."""
        if self.grid.panels:
            self.grid.panels[0].interactor.setFocus()

    def choose_file(self) -> None:
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self, "Open a mesh", "", MESH_FILES)
        if path:
            self.open(path)

    def picture(self) -> QtGui.QImage:
        """The whole window as it is on the screen."""
        picture = self.grab().toImage()
        painter = QtGui.QPainter(picture)
        self.grid.paint_into(painter, self)
        painter.end()
        return picture

    def choose_screenshot(self) -> None:
        dialog = QtWidgets.QFileDialog(self, "Save a picture of the window", "bihdist.png", "Pictures (*.png)")
        dialog.setAcceptMode(QtWidgets.QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix("png")
        if dialog.exec():
            try:
                self.save_screenshot(dialog.selectedFiles()[0])
            except BihdistError as error:
                self.failed(str(error))

    def save_screenshot(self, path: str) -> None:
        """The window as a PNG; OutputError if it cannot be written, and then what was there stays."""
        check_output(path, (".png",))
        with whole_file(path) as temporary:
            if not self.picture().save(str(temporary), "PNG"):
                raise OutputError(f"{path} could not be written.")
        self.say(f"Saved {os.path.basename(path)}")

    def export_figure(self) -> None:
        from .figure_actions import export_figure

        export_figure(self)

    def export_movie(self) -> None:
        from .figure_actions import export_movie

        export_movie(self)

    def choose_session(self) -> None:
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self, "Open a session or recipe", "", SESSIONS)
        if path:
            self.session_file.open(path)

    def open_any(self, path: str) -> None:
        """A mesh, or a session or recipe."""
        if path.lower().endswith(".json"):
            self._once_built(lambda: self.session_file.open(path))
        else:
            self.open(path)

    def say(self, text: str) -> None:
        """In the status bar."""
        self.status.message.setText(text)
