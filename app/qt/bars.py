"""The window's tool bar and menus."""

from collections.abc import Callable

from qtpy import QtCore, QtGui, QtWidgets

from ..document.document import MOST_ISOLINES
from ..samples import mesh_path, sample_names, thumbnail
from . import remembered
from .look import LargeIcons

ANY_VERTEX = 2**31 - 1
"""The box takes every id, and the session refuses those that are none: a box that knows the largest one silently makes
999 of 99999."""


class NumberBox(QtWidgets.QSpinBox):
    """A box for a whole number; undo and redo are the window's, except while something is being typed."""

    def __init__(self) -> None:
        super().__init__()
        self.setKeyboardTracking(False)

    def event(self, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.ShortcutOverride and not self.lineEdit().isModified():
            keys = QtGui.QKeySequence.StandardKey
            if event.matches(keys.Undo) or event.matches(keys.Redo):
                event.ignore()
                return True
        return super().event(event)


def fill_tool_bar(window) -> tuple[QtWidgets.QSpinBox, QtWidgets.QSpinBox]:
    """Gives the boxes for the source and for the number of isolines."""
    bar = window.addToolBar("Main")
    bar.setMovable(False)
    bar.addAction("Open …", window.choose_file)
    bar.addSeparator()
    bar.addWidget(QtWidgets.QLabel(" Source vertex "))
    source = NumberBox()
    source.setRange(0, ANY_VERTEX)
    source.setMinimumWidth(100)
    source.setToolTip("Type a vertex id and press Enter")
    source.valueChanged.connect(window.choose_source)
    source.lineEdit().returnPressed.connect(window.leave_boxes)
    bar.addWidget(source)
    bar.addSeparator()
    bar.addWidget(QtWidgets.QLabel(" Isolines "))
    isolines = NumberBox()
    isolines.setRange(0, MOST_ISOLINES)
    isolines.setValue(window.session.document.isolines)
    isolines.setToolTip("Equal steps from 0 to each panel's maximum; 0 for no lines")
    isolines.valueChanged.connect(window.choose_isolines)
    isolines.lineEdit().returnPressed.connect(window.leave_boxes)
    bar.addWidget(isolines)
    bar.addSeparator()
    bar.addAction("Reset view", window.reset_view)
    bar.addAction("Screenshot …", window.choose_screenshot)
    return source, isolines


def show_source(box: QtWidgets.QSpinBox, vertex: int) -> None:
    """Let the box of the source say a vertex, whatever was being typed."""
    with QtCore.QSignalBlocker(box):
        box.setEnabled(True)
        box.setSpecialValueText("")
        box.setRange(0, ANY_VERTEX)
        box.setValue(vertex)
        box.lineEdit().setText(str(vertex))


def no_source(box: QtWidgets.QSpinBox) -> None:
    """Let it say that there is none."""
    with QtCore.QSignalBlocker(box):
        box.setRange(-1, ANY_VERTEX)
        box.setSpecialValueText("–")
        box.setValue(-1)
        box.setEnabled(False)


def fill_menus(window) -> tuple[QtWidgets.QAction, QtWidgets.QAction]:
    """Gives the entries for undo and redo."""
    file = window.menuBar().addMenu("&File")
    _action(file, "&Open …", window.choose_file, QtGui.QKeySequence.StandardKey.Open)
    samples = file.addMenu("&Samples")
    large_icons = LargeIcons()
    large_icons.setParent(samples)
    samples.setStyle(large_icons)
    for name in sample_names():
        action = samples.addAction(QtGui.QIcon(str(thumbnail(name))), name.replace("_", " "))
        action.triggered.connect(lambda *_, name=name: window.open(mesh_path(name)))
    recent = file.addMenu("Re&cent")
    recent.aboutToShow.connect(lambda: _fill_recent(recent, window))
    file.addSeparator()
    _action(file, "Open s&ession or recipe …", window.choose_session, "Ctrl+R")
    _action(file, "&Save session", lambda: window.session_file.save_or_say(), "Ctrl+S")
    _action(file, "Save session &as …", lambda: window.session_file.choose_and_save(), "Ctrl+Shift+S")
    file.addSeparator()
    _action(file, "S&creenshot …", window.choose_screenshot, "Ctrl+P")
    _action(file, "&Export figure …", window.export_figure, "Ctrl+E")
    _action(file, "Export &movie …", window.export_movie, "Ctrl+M")
    file.addSeparator()
    _action(file, "&Quit", window.close, QtGui.QKeySequence.StandardKey.Quit)
    edit = window.menuBar().addMenu("&Edit")
    undo = _action(edit, "&Undo", window.session.undo, "Ctrl+Z")
    redo = _action(edit, "&Redo", window.session.redo, "Ctrl+Shift+Z")
    edit.addSeparator()
    _action(edit, "&Add a panel", window.add_panel, "Ctrl+T")
    view = window.menuBar().addMenu("&View")
    _action(view, "&Reset", window.reset_view, "R")
    for key, name in enumerate(("front", "back", "left", "right", "top", "bottom"), 1):
        _action(view, f"&{name.capitalize()}", lambda *_, name=name: window.reset_view(name), str(key))
    view.addSeparator()
    _action(view, "The view be&fore", window.views.back, "Ctrl+[")
    _action(view, "The view af&ter", window.views.on, "Ctrl+]")
    go = window.menuBar().addMenu("&Source")
    _action(go, "&Type a vertex id", lambda *_: (window.source_box.setFocus(), window.source_box.selectAll()), "G")
    _action(go, "The source be&fore", lambda: window.session.walk_sources(-1), "Alt+Left")
    _action(go, "The source af&ter", lambda: window.session.walk_sources(1), "Alt+Right")
    _action(go, "&Cancel what is being computed", window.cancel, "Esc")
    about = window.menuBar().addMenu("&Help")
    _action(about, "&Mouse and keys", lambda: QtWidgets.QMessageBox.information(window, "Mouse and keys", HELP), "F1")
    for action in (undo, redo):
        action.setEnabled(False)  # until there is a step
    return undo, redo


def _fill_recent(menu: QtWidgets.QMenu, window) -> None:
    menu.clear()
    for path in remembered.recent():
        action = menu.addAction(path if len(path) <= 70 else f"… {path[-68:]}")
        action.triggered.connect(lambda *_, path=path: window.open_any(path))
    if menu.isEmpty():
        menu.addAction("Nothing yet").setEnabled(False)


def _action(menu: QtWidgets.QMenu, text: str, slot: Callable, key: object) -> QtWidgets.QAction:
    action = menu.addAction(text)
    action.setShortcut(QtGui.QKeySequence(key))
    action.triggered.connect(lambda *_: slot())
    return action


HELP = """\
Click a point: distances are measured from the nearest vertex.
Drag the mark of the source: it wanders, and the fields follow.
Drag: rotate all panels.  Shift-drag or middle button: move.  Wheel: zoom.
Point at the surface: its value in every panel.

Ctrl+O  open a mesh (or drop it on the window)
Ctrl+Z, Ctrl+Shift+Z  undo, redo      Ctrl+T  add a panel (⋯ over a panel: duplicate, move, remove)
Ctrl+[, Ctrl+]  the view before, after      Alt+Left, Alt+Right  the source before, after
G  type the source's vertex id
R  reset the view      1 … 6  front, back, left, right, top, bottom
Ctrl+P  save a picture of the window      Ctrl+E  export a figure      Ctrl+M  a movie
Ctrl+S  save the session      Ctrl+R  open a session or a figure's recipe
Esc  cancel what is being computed"""
