"""The context of a window for docks, gestures, dialogs and file actions: what is shown, and whom to tell."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar, cast

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.progress import Progress

from ..document.document import Document
from ..document.page import Page
from ..document.settings import Preferences
from ..session.session import Session
from .background import Background
from .preferences import save
from .status_bar import StatusBar

if TYPE_CHECKING:
    from ..scene.picking import Hit
    from .panels.grid import PanelGrid
    from .panels.panel import DistancePanel

Kind = TypeVar("Kind")


class Context(QtCore.QObject):
    """The state that the parts of a window share.

    `context[Brushing]` is the window's one `Brushing`, made when it is first asked for.

    Attributes
    ----------
    widget
        The window, which dialogs stand over and docks are put in.
    page
        The page of the recipe that was opened last, for the figures that are exported.
    actions
        The actions of the window, by the words of their `Action`.
    quiet
        Whether no questions are asked and no messages shown.
    remembers
        Whether recent files, preferences and, in case of a crash, what is shown are kept.
    hit, hit_in
        The hit under the pointer, and the panel that it is in.
    """

    document_changed = QtCore.Signal(object)  # from the document before
    answer_changed = QtCore.Signal(int)  # of a panel
    pointed = QtCore.Signal(object, str)  # a vertex or None, and the name of its surface
    found_changed = QtCore.Signal(type)  # of something that is found beside the window's thread for panels
    panels_cleared = QtCore.Signal()  # they have forgotten what was drawn on them
    page_changed = QtCore.Signal()
    style_changed = QtCore.Signal()  # of the page or the theme: what is shown looks otherwise at once
    choice_changed = QtCore.Signal()  # or may have: menus and buttons have to say what it is
    preferred = QtCore.Signal(object)  # from the preferences before
    picked = QtCore.Signal(int, object)  # a panel, and the `Hit` that was clicked in it, before anything is done
    refused = QtCore.Signal(str)  # a message the user was shown
    failed = QtCore.Signal(str)  # a message that the user is to be shown
    opening = QtCore.Signal()  # another mesh
    complete = QtCore.Signal()  # every panel has been painted with its final answer
    closed = QtCore.Signal()
    _posted = QtCore.Signal(object)

    session: Session

    def __init__(self, widget: QtWidgets.QMainWindow, preferences: Preferences, status: StatusBar) -> None:
        super().__init__(widget)
        self.widget, self.preferences, self.status = widget, preferences, status
        self.page = Page()
        self.actions: dict[str, QtWidgets.QAction] = {}
        self.quiet, self.remembers = False, True
        self.hit: Hit | None = None
        self.hit_in = -1
        self._grid: PanelGrid | None = None
        self._waiting: list[Callable[[], None]] = []
        self._made: dict[type, Any] = {}
        self.is_closed = False
        self._posted.connect(self._run)
        self.closed.connect(self._end)

    def __getitem__(self, kind: type[Kind]) -> Kind:
        if kind not in self._made:
            self._made[kind] = cast("Callable[[Context], Kind]", kind)(self)
        return cast("Kind", self._made[kind])

    # ------------------------------------------------------------------ what is shown
    @property
    def document(self) -> Document:
        """The document that is shown now."""
        return self.session.document

    def take_page(self, page: Page) -> None:
        """Look as figures on this page do, from the next change of the document on."""
        if page != self.page:
            self.page = page
            self.page_changed.emit()

    def open(self, path: str, source: int | None = None) -> None:
        """Open a mesh in the place of the one that is shown, also before there are panels."""
        self.opening.emit()
        self.session.open(path, source)

    # ------------------------------------------------------------------ the panels
    @property
    def has_faces(self) -> bool:
        """Return whether the first mesh has faces, and is not of points."""
        loaded = self.session.loaded()
        return loaded is not None and bool(len(loaded.surface.faces))

    @property
    def is_built(self) -> bool:
        """Return whether there are panels: the window is shown before what draws has been imported."""
        return self._grid is not None

    @property
    def grid(self) -> "PanelGrid":
        """The panels; RuntimeError before they are built."""
        if self._grid is None:
            raise RuntimeError("There are no panels yet; see once_built.")
        return self._grid

    def build(self, grid: "PanelGrid", kinds: Iterable[type]) -> None:
        """Take the panels, and call what waited for them; from now on there is one of each of these kinds, too."""
        self._grid = grid
        for kind in kinds:
            self[kind]
        waiting, self._waiting = self._waiting, []
        for function in waiting:
            function()

    def once_built(self, function: Callable[[], None]) -> None:
        """Call a function when there are panels."""
        if self.is_built:
            function()
        else:
            self._waiting.append(function)

    def show_found(self, panel: int, kind: type[Kind], found: Kind | None) -> None:
        """Mark in a panel what has been found for it, by its type; None for nothing."""
        if found is not self.found(panel, kind):
            self.grid.marks.show_found(panel, kind, found)
            self.found_changed.emit(kind)

    def found(self, panel: int, kind: type[Kind]) -> Kind | None:
        """Return the finding of a type for a panel; None for nothing, and for a panel that is gone."""
        return next((shown.marks.found.get(kind) for shown in self.grid.panels if shown.id == panel), None)

    @property
    def active(self) -> "DistancePanel | None":
        """The panel that the keys go to."""
        grid = self._grid
        return None if grid is None or self.session.loaded() is None or grid.active < 0 else grid.panel(grid.active)

    def focus_panels(self) -> None:
        """Give the panels the keys."""
        if self._grid is not None:
            self._grid.focus()

    # ------------------------------------------------------------------ the user
    def tell(self, text: str, holds: Callable[[], bool] | None = None) -> None:
        """Show a text in the status bar for a while, as long as `holds`, asked as the document changes."""
        self.status.say(text, holds)

    def copy(self, text: str, told: str) -> None:
        """Put a text on the clipboard, and tell the user so."""
        QtWidgets.QApplication.clipboard().setText(text)
        self.tell(told)

    def fail(self, error: Exception | str) -> None:
        """Say why something cannot be done."""
        self.failed.emit(error if isinstance(error, str) else failure_in_words(error))

    @contextmanager
    def errors_shown(self) -> Iterator[None]:
        """Show the user an error of what is done within, which ends there."""
        try:
            yield
        except BihdistError as error:
            self.fail(error)

    def prefer(self, **changes: object) -> None:
        """Change some preferences, also for the next start."""
        before = self.preferences
        self.preferences = replace(before, **cast("dict[str, Any]", changes))
        self.preferred.emit(before)
        if self.remembers:
            save(self.preferences)

    @property
    def folder(self) -> str:
        """The folder of the file that was opened or saved last."""
        return self.preferences.last_folder

    @folder.setter
    def folder(self, folder: str) -> None:
        self.preferences = replace(self.preferences, last_folder=folder)

    def background(
        self,
        name: str,
        compute: Callable[[Any, Progress], Iterator[Any]],
        answered: Callable[[Any, Any], object] | None = None,
        failed: Callable[[Any, str], object] | None = None,
        progressed: Callable[[Any], object] | None = None,
    ) -> Background:
        """Return a `Background` that computes beside the window's thread, until the window is closed.

        The functions take its signals.
        """
        made = Background(name, compute, self)
        for signal, take in ((made.answered, answered), (made.failed, failed), (made.progressed, progressed)):
            if take is not None:
                signal.connect(take)
        self.closed.connect(made.close)
        return made

    def post(self, function: Callable[[], None]) -> None:
        """Run a function on the window's thread, from any other, unless the window is closed by then."""
        with suppress(RuntimeError):  # the window may be gone
            self._posted.emit(function)

    def _run(self, function: Callable[[], None]) -> None:
        if not self.is_closed:
            function()

    def _end(self) -> None:
        self.is_closed = True
