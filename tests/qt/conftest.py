"""The real window on a real (virtual) screen."""

import os
import time
from importlib.util import find_spec

import pytest

from app.document.document import COMPARISON, comparison
from bihdist_core.distances.distance_types import Spec
from tests.conftest import write_off
from tests.qt.events import ROUNDS, send_mouse
from tests.shapes import bumpy
from tests.waiting import PATIENCE

collect_ignore_glob = [] if find_spec("qtpy") else ["test_*.py"]


@pytest.fixture(scope="session")
def application():
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        pytest.skip("there is no display; `make test` brings one")
    from app.qt.application import application

    return application()


SMALL, WHOLE = (1000, 640), (1400, 860)
"""Sizes of windows, small and as on a desktop: the processor draws each pixel, in small ones twice as fast."""
SMALL_IN = {"anchors", "beside", "closing", "colours", "controls", "docks", "drawn_sources", "export", "other_meshes"}
SMALL_IN |= {"sessions"}
"""Modules of tests, without `test_`, in which small windows show all that there is to see."""

BALL = bumpy(300)

MOST_OPEN = 2
"""Shared windows of a module that are open at once."""


class Screen:
    """A window with the event loop in the test's hands."""

    def __init__(self, application, specs=COMPARISON, size=WHOLE):
        from app.qt.main_window import MainWindow

        self.application, self.size = application, size
        self.window = MainWindow(comparison("", tuple(specs)))
        self.window.resize(*size)
        self.window.context.quiet, self.window.context.remembers = True, False
        self.refusals, self.completions = [], []
        self.left = []  # docks that a reset has taken out, for which threads may still have results
        self.window.refused.connect(self.refusals.append)
        self.window.complete.connect(lambda: self.completions.append(self.source))
        self.window.show()
        self.window.build_panels()
        self.session = self.window.session

    @property
    def panels(self):
        return self.window.grid.panels

    @property
    def document(self):
        return self.session.document

    @property
    def source(self):
        return self.document.point("source").at

    @property
    def path(self):
        """The file of the first mesh."""
        return self.document.surfaces[0].path

    @property
    def answers(self):
        return [self.session.shown[panel.id].answer for panel in self.document.panels]

    def until(self, condition, seconds=PATIENCE):
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, f"waited in vain; refused: {self.refusals}"
            self.application.processEvents()
            time.sleep(0.005)

    def activate(self):
        """Give the window the keyboard focus, which comes from the screen's server where nothing manages windows."""
        self.window.activateWindow()
        self.until(self.window.isActiveWindow)

    def settle(self, seconds=0.2):
        """Let queued repaints happen, for which the views wait for each other."""
        end, rounds = time.monotonic() + seconds, 0
        while (
            time.monotonic() < end or rounds < ROUNDS * seconds or (self._is_unpainted and time.monotonic() < end + 10)
        ):
            self.application.processEvents()
            time.sleep(0.005)
            rounds += 1

    @property
    def _is_unpainted(self):
        return self.window.context.is_built and any(panel.view.is_stale for panel in self.panels)

    def open(self, path, source=None):
        self.window.context.open(str(path), source)
        # Until it is there, what was shown before is complete.
        self.until(lambda: self.session.is_complete and not self.session.is_opening)
        self.settle(0.1)

    def has_meshes_of(self, document):
        return self.window.isVisible() and not self.session._surfaces.missing(document)

    def reset(self, document):
        """Bring back what a new window shows of a document whose meshes are open."""
        from qtpy import QtCore, QtGui, QtWidgets

        from app.document.document import Document
        from app.document.page import Page
        from app.document.work import work_in
        from app.qt.files.session_actions import _Origin
        from app.qt.preferences import Preferences
        from app.session.answering import AnswerCache
        from app.session.surfaces import Opening
        from tests.qt.parts import parts

        window, context, its = self.window, self.window.context, parts(self.window)
        for each in (window, context, window.status, self.session, context.grid, *context._made.values()):
            for name in [name for name in vars(each) if callable(getattr(type(each), name, None))]:
                delattr(each, name)  # a test has put it in the place of a method
        for other in self.application.topLevelWidgets():
            if other.isVisible() and not isinstance(other, QtWidgets.QMainWindow):
                other.close()
        its.gestures.set_live(False)
        its.held_keys.brush_held.emit(False)
        its.dragging.end()
        if its.choices.is_full_screen:
            its.choices.toggle_full_screen()
        context.quiet, context.remembers = True, False
        context.page = Page()
        context.prefer(**vars(Preferences()))
        self.panels[0].view.setFocus()
        its.session_file._at, its.session_file._origins = 0, {0: _Origin(work_in(Document()))}
        its.curve_files.paths.clear()
        its.exports.chosen.clear()
        for dock in its.docks._docks.values():
            dock.content.end()
            window.removeDockWidget(dock)
            dock.setParent(None)
            self.left.append(dock)
        its.docks._docks.clear()
        its.changes._loaded = ()  # so that all is shown anew
        self.session.cancel()
        self.session._answering.progress.clear()
        self.session._walk, self.session._answering._kept = None, AnswerCache()
        self.session._present(Opening((), lambda: self.session.history.__init__(document)))
        its.views.begin()
        its.session_file.show_title()
        context.grid.activate(document.panels[0].id)
        window.notice.clear()
        window.status.say("")
        window.raise_()
        QtGui.QCursor.setPos(self.application.primaryScreen().geometry().bottomRight())
        for panel in self.panels:
            send_mouse(panel.view, QtCore.QPoint(0, 0))
        window.setWindowState(QtCore.Qt.WindowState.WindowNoState)
        window.resize(*self.size)
        self.application.clipboard().clear()
        self.application.sendPostedEvents(None, QtCore.QEvent.Type.DeferredDelete)
        self.until(lambda: self.session.is_complete and not context.grid._once)
        self.settle(0.1)
        context.hit, context.hit_in = None, -1
        self.refusals.clear()
        self.completions.clear()

    def close(self):
        """Close the window, and delete it."""
        from qtpy import QtCore

        self.window.close()
        self.settle(0.05)
        # PySide keeps, until the sender is gone, whatever a lambda in a slot refers to: here, the window.
        for each in (*self.left, self.window):
            each.deleteLater()
        self.application.sendPostedEvents(None, QtCore.QEvent.Type.DeferredDelete)

    def pictures(self):
        """Of the surfaces, (height, width, 3) each, without what lies over them."""
        return [panel.view.shot() for panel in self.panels]

    def point_of(self, panel, vertex):
        """Where a vertex is seen in a panel's view, in its own coordinates."""
        from qtpy.QtCore import QPoint

        place = panel.view.place_of(panel.positions[vertex])
        return QPoint(round(place.x() - 0.5), round(place.y() - 0.5))

    def hover(self, at, panel=0):
        """The pointer at a place (QPoint) of a view, no button down; the screen's own goes out of the way."""
        from qtpy import QtGui

        corner = self.application.primaryScreen().geometry().bottomRight()
        if QtGui.QCursor.pos() != corner:
            QtGui.QCursor.setPos(corner)
            self.settle(0.1)
        send_mouse(self.panels[panel].view, at)
        self.application.processEvents()

    def seen(self, count, panel=0):
        """Vertices that a panel shows, far apart, none of them under a drop."""
        import numpy as np
        from qtpy.QtCore import QPoint

        shown, found = self.panels[panel], {}
        view = shown.view
        for x in range(3, 18):
            for y in range(3, 18):
                hit = view.pick(QPoint(view.width() * x // 20, view.height() * y // 20))
                at = None if hit is None else self.point_of(shown, hit.vertex)
                again = None if at is None or view.over.points.standing_at(at) is not None else view.pick(at)
                if again is not None and again.vertex == hit.vertex:
                    found[hit.vertex] = hit.position
        ids = list(found)
        chosen = [ids[0]]
        while len(chosen) < count:
            away = [min(np.linalg.norm(found[a] - found[b]) for b in chosen) for a in ids]
            chosen.append(ids[int(np.argmax(away))])
        return chosen


def _size(request):
    return SMALL if request.module.__name__.rpartition("test_")[2] in SMALL_IN else WHOLE


@pytest.fixture
def screen(application, request):
    """Makes windows."""
    screens = []

    def make(specs=COMPARISON):
        screens.append(Screen(application, specs, _size(request)))
        return screens[-1]

    yield make
    for each in screens:
        each.close()


@pytest.fixture(scope="module")
def open_screens():
    """The windows that tests of a module share, with the documents they show first, by what was asked for."""
    screens = {}
    yield screens
    for screen, _ in screens.values():
        screen.close()


@pytest.fixture
def shared_screen(application, request, open_screens, tmp_path_factory):
    """Shows a mesh in a window that the tests of a module share, as a new one would.

    Opening and painting takes a second of the processor, and showing again what is open a third of that.
    """

    def show(surface=BALL, specs=COMPARISON, source=5, size=None):
        is_file = isinstance(surface, str | os.PathLike)
        key = (surface if is_file else (surface.vertices.tobytes(), surface.faces.tobytes()), tuple(specs), source)
        screen, document = open_screens.pop(key, (None, None))
        if screen is not None and not screen.has_meshes_of(document):
            screen.close()  # a test has opened others
            screen = None
        if screen is not None:
            screen.reset(document)
        else:
            while len(open_screens) >= MOST_OPEN:
                open_screens.pop(next(iter(open_screens)))[0].close()
            screen = Screen(application, specs, size or _size(request))
            path = surface if is_file else write_off(surface, tmp_path_factory.mktemp("shared") / "mesh.off")
            screen.open(path, source)
            screen.until(lambda: screen.session.is_complete)
            screen.settle(0.1)
            document = screen.document
        open_screens[key] = screen, document  # the last one used
        return screen

    return show


@pytest.fixture
def head(application):
    """Makes lines over panels, each in a window of its own; what is chosen there is in their `choices`."""
    from qtpy import QtTest, QtWidgets

    from app.document.quantities import quantity
    from app.qt.panels.head import PanelHead

    windows = []

    def make(text="biharmonic", width=600, fields=(), point="source"):
        window = QtWidgets.QWidget()
        window.resize(1000, 100)
        window.setPalette(QtWidgets.QApplication.palette())
        made = PanelHead(quantity(text, point, fields), window)
        made.show_quantity(made.shows, fields)
        made.setGeometry(0, 0, width, made.height())
        window.show()
        assert QtTest.QTest.qWaitForWindowExposed(window)
        made.choices = []
        made.changed.connect(made.choices.append)
        windows.append(window)
        return made

    yield make
    for window in windows:
        window.close()


@pytest.fixture
def small(application, mesh_file):
    """A window with a mesh in it, that only exports."""
    from qtpy import QtTest, QtWidgets

    from app.document.settings import Preferences
    from app.qt.context import Context
    from app.qt.files.exports import ExportBadge, Exports
    from app.qt.status_bar import StatusBar
    from app.session.session import Session

    class Small(QtWidgets.QMainWindow):
        def __init__(self):
            super().__init__()
            self.context = Context(self, Preferences(), StatusBar(self))
            self.context.remembers = False
            self.said, self.refusals = [], []
            self.failed, self.context.tell = self.refusals.append, self.said.append
            self.context.failed.connect(self.refusals.append)
            document = comparison("", (Spec.of("biharmonic"),))
            self.session = self.context.session = Session(self, self.context.post, document=document)
            self.exports = self.context[Exports]
            self.chip = ExportBadge(self.exports)
            self.statusBar().addPermanentWidget(self.chip)

        def until(self, condition, seconds=PATIENCE):
            end = time.monotonic() + seconds
            while not condition():
                assert time.monotonic() < end, f"waited in vain; refused: {self.refusals}"
                application.processEvents()
                time.sleep(0.005)

        def nothing(self, *_):
            """The session tells; this window shows nothing of it."""

        document_changed = answer_changed = error_estimate_changed = progress_changed = nothing

    window = Small()
    window.show()
    window.session.open(mesh_file(bumpy(200)), 5)
    window.until(lambda: window.session.is_complete)
    yield window
    window.exports.close()
    window.session.close()
    window.close()
    window.deleteLater()
    QtTest.QTest.qWait(1)


@pytest.fixture
def out(tmp_path):
    folder = tmp_path / "out"
    folder.mkdir()
    return folder


@pytest.fixture
def own_folder(tmp_path, monkeypatch):
    """Nothing of the user's is read or written."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
