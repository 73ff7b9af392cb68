"""The window: panels side by side with one camera, a status line, menus.  Shows a `Session`; decides nothing itself.

It opens at once and imports what draws (VTK, pyvista) only then.
"""

import os
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import BihdistError, OutputError
from bihdist_core.whole_file import check_output, whole_file

from ..prepared import prepare
from ..samples import mesh_path, sample_names, thumbnail
from ..session import Session
from ..state import ViewerState
from .look import STYLE_SHEET, LargeIcons
from .status_bar import StatusBar

MESH_FILES = "Meshes (*.off *.obj *.ply *.stl *.vtk *.vtp);;All files (*)"
HOVER_DELAY_MS = 25
PROGRESS_MS = 200
"""How often progress is shown at most, and from when on."""
ANY_VERTEX = 2**31 - 1
"""The box takes every id, and the session refuses those that are none: a box that knows the largest one silently makes
999 of 99999."""


class MainWindow(QtWidgets.QMainWindow):
    """`complete` is emitted whenever every panel has been painted with its final answer."""

    complete = QtCore.Signal()
    refused = QtCore.Signal(str)  # a message the user was shown
    _posted = QtCore.Signal(object)

    def __init__(self, state: ViewerState | None = None) -> None:
        super().__init__()
        self.setWindowTitle("Biharmonic distance")
        self.setAcceptDrops(True)
        self.resize(1322, 660)
        self.setStyleSheet(STYLE_SHEET)
        self._posted.connect(lambda function: function())
        self.session = Session(self, self._posted.emit, state, prepare=prepare)
        self.panels: list = []
        self._camera = None
        self._extent: tuple[float, float] | None = None  # what the camera is to see in panels of any shape
        self.recipe = None  # the one opened last
        self._hovered: int | None = None
        self._waiting: list[Callable[[], None]] = []
        self.quiet = False
        self.status = StatusBar(self)
        self.status.cancelled.connect(self.session.cancel)
        self.setStatusBar(self.status)
        self._progress_soon = QtCore.QTimer(self, singleShot=True, interval=PROGRESS_MS)
        self._progress_soon.timeout.connect(self._show_progress)
        self._fill_tool_bar()
        self._fill_menus()
        placeholder = QtWidgets.QLabel("Opening …", objectName="hint")
        placeholder.setAlignment(QtCore.Qt.AlignmentFlag.AlignCenter)
        self.setCentralWidget(placeholder)

    # ------------------------------------------------------------------ start and end
    def build_panels(self) -> None:
        """Import what draws and make the panels; called once, after the window is on the screen."""
        from vtkmodules.vtkRenderingCore import vtkCamera

        from .panel import DistancePanel

        self._camera = vtkCamera()
        middle = QtWidgets.QWidget()
        row = QtWidgets.QHBoxLayout(middle)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(1)
        for index, spec in enumerate(self.session.state.panels):
            panel = DistancePanel(spec, middle)
            panel.clicked.connect(self.session.select_source)
            panel.hovered.connect(self._hover)
            panel.moved.connect(self._repaint)
            panel.resized.connect(self._keep_in_view)
            panel.changed.connect(lambda chosen, index=index: self.session.set_panel(index, chosen))
            panel.scene.show_isolines(self.session.state.isolines)
            panel.renderer.SetActiveCamera(self._camera)
            row.addWidget(panel, 1)
            self.panels.append(panel)
        self.setCentralWidget(middle)
        self._repaint_soon = QtCore.QTimer(self, singleShot=True, interval=HOVER_DELAY_MS)
        self._repaint_soon.timeout.connect(self._repaint)
        self._leave_boxes()
        waiting, self._waiting = self._waiting, []
        for function in waiting:
            function()

    def open(self, path: str, source: int | None = None, **chosen: Any) -> None:
        """Open a mesh, also before the panels are made; chosen: see `Session.open`."""
        if self.panels:
            self.session.open(path, source, **chosen)
        else:
            self._waiting.append(lambda: self.session.open(path, source, **chosen))

    def look_from(self, place: Callable[[], None]) -> None:
        """Let the camera be placed, and keep what is then seen in view."""
        place()
        self._remember_extent()
        self._repaint()

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        self.session.close()
        for panel in self.panels:
            panel.interactor.close()
        super().closeEvent(event)

    # ------------------------------------------------------------------ what the session tells
    def mesh_changed(self) -> None:
        surface, prepared = self.session.surface, self.session.prepared
        self.setWindowTitle(f"{surface.name} - Biharmonic distance")
        for panel in self.panels:
            panel.show_surface(prepared.mesh, prepared.picker, self._camera)
        self._hovered = None
        self.reset_view()
        self._say(_summary(surface))

    def source_changed(self) -> None:
        source = self.session.state.source
        with QtCore.QSignalBlocker(self._source_box):
            self._source_box.setValue(source)
        for panel in self.panels:
            panel.scene.mark_source(self.session.surface.vertices[source])
        self._repaint()

    def answer_changed(self, index: int) -> None:
        panel, answer = self.panels[index], self.session.answers[index]
        panel.show_answer(answer)
        panel.show_value(self._hovered)
        self._note(index)

    def certificate_changed(self, index: int) -> None:
        self.panels[index].show_certificate(self.session.answers[index])
        self._note(index)
        if self.session.is_complete and not self.session.progress:
            QtCore.QTimer.singleShot(0, self._announce)

    def progress_changed(self) -> None:
        if not self.session.progress:
            self._show_progress()
        elif not self._progress_soon.isActive():
            self._progress_soon.start()

    def _show_progress(self) -> None:
        self._progress_soon.stop()
        going = [self.session.progress[name] for name in sorted(self.session.progress)]
        self.status.show_progress(going)
        for index in range(len(self.panels)):
            self._note(index)
        if self.session.is_complete and not going:
            # Once the repaints that are queued have been done.
            QtCore.QTimer.singleShot(0, self._announce)

    def _note(self, index: int) -> None:
        """Say in a panel what it is waiting for; how far that is, the status bar says, which is cheap to paint."""
        _, text = self.session.progress.get(f"panel {index}", (0, ""))
        if text:
            text = f"{text.partition(':')[0]} …"
        elif self.session.is_stopped and not self.session.is_answered(index):
            text = "stopped; click a point to ask again"
        elif self.session.surface and self.session.answers[index] is None and self.session.progress:
            text = "waiting …"
        self.panels[index].show_note(text)

    def failed(self, message: str) -> None:
        self.refused.emit(message)
        if not self.quiet:
            # Above a dialog that is open, it would otherwise get no keys.
            above = QtWidgets.QApplication.activeModalWidget() or self
            box = QtWidgets.QMessageBox(
                QtWidgets.QMessageBox.Icon.Warning, "Biharmonic distance", message, parent=above
            )
            box.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
            box.open()

    # ------------------------------------------------------------------ views
    @property
    def camera(self):
        """The camera of all panels."""
        return self._camera

    @property
    def aspect(self) -> float:
        """Width / height of a panel."""
        size = self.panels[0].interactor.size()
        return size.width() / max(size.height(), 1)

    def show_isolines(self, count: int) -> None:
        """Choose a number of isolines, as the box in the tool bar does."""
        self._isolines_box.setValue(count)

    def reset_view(self, view: str = "home") -> None:
        from ..camera import place_camera

        surface = self.session.surface
        if surface is None:
            return
        place_camera(self._camera, self.session.prepared.points, self.aspect, view)
        self._remember_extent()
        self._repaint()

    def _remember_extent(self) -> None:
        from ..camera import camera_seen

        self._extent = camera_seen(self._camera, self.aspect).extent

    def _keep_in_view(self) -> None:
        """After a change of the panels' size.  Left to itself VTK keeps the height and cuts off the sides."""
        from ..camera import camera_seen, show_camera

        if self._extent is not None:
            show_camera(self._camera, replace(camera_seen(self._camera, self.aspect), extent=self._extent), self.aspect)
            self._repaint()

    def _repaint(self) -> None:
        if self.session.prepared:
            # The panels have one camera.  Left to itself VTK would go over all vertices to find the bounds.
            self.panels[0].renderer.ResetCameraClippingRange(self.session.prepared.bounds)
        for panel in self.panels:
            panel.repaint_view()

    def _announce(self) -> None:
        if self.session.is_complete and not self.session.progress:
            self.complete.emit()

    def picture(self) -> QtGui.QImage:
        """The whole window as it is on the screen."""
        picture = self.grab().toImage()
        painter = QtGui.QPainter(picture)
        for panel in self.panels:
            corner = panel.interactor.mapTo(self, QtCore.QPoint(0, 0))
            painter.drawImage(QtCore.QRect(corner, panel.interactor.size()), panel.picture())
        painter.end()
        return picture

    # ------------------------------------------------------------------ the pointer
    def _hover(self, vertex: int | None) -> None:
        if vertex == self._hovered or self.session.surface is None:
            return
        self._hovered = vertex
        surface = self.session.surface
        position = None if vertex is None else surface.vertices[vertex]
        for panel in self.panels:
            panel.scene.mark_pointer(position)
            panel.show_value(vertex)
        if vertex is None:
            self.status.pointer.setText("")
        else:
            x, y, z = position
            self.status.pointer.setText(f"vertex {vertex}   ({x:.4g}, {y:.4g}, {z:.4g})")
        self._repaint_soon.start()

    # ------------------------------------------------------------------ the user's commands
    def choose_file(self) -> None:
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self, "Open a mesh", "", MESH_FILES)
        if path:
            self.open(path)

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
        self._say(f"Saved {os.path.basename(path)}")

    def export_figure(self) -> None:
        from .figure_actions import export_figure

        export_figure(self)

    def export_movie(self) -> None:
        from .figure_actions import export_movie

        export_movie(self)

    def choose_recipe(self) -> None:
        from .figure_actions import choose_recipe

        choose_recipe(self)

    def _choose_source(self, vertex: int) -> None:
        try:
            self.session.select_source(vertex)
        except BihdistError as error:
            self.failed(str(error))
            self.source_changed()

    def _leave_boxes(self) -> None:
        """A box that has the keyboard takes digits and Ctrl+E for itself."""
        self.panels[0].interactor.setFocus()

    def _choose_isolines(self, count: int) -> None:
        self.session.set_isolines(count)
        for panel in self.panels:
            panel.scene.show_isolines(count)
        self._repaint()

    def dragEnterEvent(self, event: QtGui.QDragEnterEvent) -> None:
        if event.mimeData().hasUrls():
            event.acceptProposedAction()

    def dropEvent(self, event: QtGui.QDropEvent) -> None:
        self.open(event.mimeData().urls()[0].toLocalFile())

    # ------------------------------------------------------------------ how it is made
    def _fill_tool_bar(self) -> None:
        bar = self.addToolBar("Main")
        bar.setMovable(False)
        bar.addAction("Open …", self.choose_file)
        bar.addSeparator()
        bar.addWidget(QtWidgets.QLabel(" Source vertex "))
        self._source_box = QtWidgets.QSpinBox()
        self._source_box.setKeyboardTracking(False)
        self._source_box.setRange(0, ANY_VERTEX)
        self._source_box.setMinimumWidth(100)
        self._source_box.setToolTip("Type a vertex id and press Enter")
        self._source_box.valueChanged.connect(self._choose_source)
        self._source_box.lineEdit().returnPressed.connect(self._leave_boxes)
        bar.addWidget(self._source_box)
        bar.addSeparator()
        bar.addWidget(QtWidgets.QLabel(" Isolines "))
        self._isolines_box = QtWidgets.QSpinBox()
        self._isolines_box.setRange(0, 200)
        self._isolines_box.setValue(self.session.state.isolines)
        self._isolines_box.setToolTip("Equal steps from 0 to each panel's maximum; 0 for no lines")
        self._isolines_box.valueChanged.connect(self._choose_isolines)
        self._isolines_box.lineEdit().returnPressed.connect(self._leave_boxes)
        bar.addWidget(self._isolines_box)
        bar.addSeparator()
        bar.addAction("Reset view", self.reset_view)
        bar.addAction("Screenshot …", self.choose_screenshot)

    def _fill_menus(self) -> None:
        file = self.menuBar().addMenu("&File")
        _action(file, "&Open …", self.choose_file, QtGui.QKeySequence.StandardKey.Open)
        samples = file.addMenu("&Samples")
        self._large_icons = LargeIcons()
        samples.setStyle(self._large_icons)
        for name in sample_names():
            action = samples.addAction(QtGui.QIcon(str(thumbnail(name))), name.replace("_", " "))
            action.triggered.connect(lambda *_, name=name: self.open(mesh_path(name)))
        _action(file, "S&creenshot …", self.choose_screenshot, "Ctrl+P")
        _action(file, "&Export figure …", self.export_figure, "Ctrl+E")
        _action(file, "Export &movie …", self.export_movie, "Ctrl+M")
        _action(file, "Open &recipe …", self.choose_recipe, "Ctrl+R")
        file.addSeparator()
        _action(file, "&Quit", self.close, QtGui.QKeySequence.StandardKey.Quit)
        view = self.menuBar().addMenu("&View")
        _action(view, "&Reset", self.reset_view, "R")
        for key, name in enumerate(("front", "back", "left", "right", "top", "bottom"), 1):
            _action(view, f"&{name.capitalize()}", lambda *_, name=name: self.reset_view(name), str(key))
        go = self.menuBar().addMenu("&Source")
        _action(go, "&Type a vertex id", lambda *_: (self._source_box.setFocus(), self._source_box.selectAll()), "G")
        _action(go, "&Cancel what is being computed", self.session.cancel, "Esc")
        about = self.menuBar().addMenu("&Help")
        _action(about, "&Mouse and keys", self._show_help, "F1")

    def _say(self, text: str) -> None:
        self.status.message.setText(text)

    def _show_help(self) -> None:
        QtWidgets.QMessageBox.information(self, "Mouse and keys", HELP)


HELP = """\
Click a point: distances are measured from the nearest vertex.
Drag: rotate all panels.  Shift-drag or middle button: move.  Wheel: zoom.
Point at the surface: its value in every panel.

Ctrl+O  open a mesh (or drop it on the window)
G  type the source's vertex id
R  reset the view      1 … 6  front, back, left, right, top, bottom
Ctrl+P  save a picture of the window      Ctrl+E  export a figure      Ctrl+M  a movie
Ctrl+R  open a figure's recipe
Esc  cancel what is being computed"""


def _summary(surface) -> str:
    words = [f"{len(surface.vertices):,} vertices", f"{len(surface.faces):,} faces"]
    if surface.component_count > 1:
        words.append(f"{surface.component_count} components (grey: not connected to the source)")
    if surface.unreferenced_count:
        words.append(f"{surface.unreferenced_count:,} vertices without a face")
    return "  ·  ".join([*words, *surface.remarks])


def _action(menu: QtWidgets.QMenu, text: str, slot: Callable, key: object) -> None:
    action = menu.addAction(text)
    action.setShortcut(QtGui.QKeySequence(key))
    action.triggered.connect(lambda *_: slot())
