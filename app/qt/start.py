"""Start of the viewer: Qt, the window, the mesh."""

import ctypes
import gc
import os
import sys
from contextlib import suppress
from dataclasses import replace

from qtpy import QtCore

from bihdist_core import BihdistError

from ..document.document import Document
from ..document.looks import Isolines
from ..document.settings import Preferences
from ..samples import SAMPLES
from ..session.array_store import ArrayStore
from .application import application, check_screen
from .files.files import Files
from .files.session_actions import SessionFile, offer_lost_state
from .look.look import LOOK
from .look.own_folder import remove_own_folder
from .main_window import MainWindow
from .preferences import load, restore_geometry
from .unexpected_errors import take_all_exceptions

PAINTED_MS = 50

ALLOCATION = (
    ("MALLOC_ARENA_MAX", -8, 1),
    ("MALLOC_MMAP_THRESHOLD_", -3, 1 << 20),
    ("MALLOC_TRIM_THRESHOLD_", -1, 4 << 20),
)
"""Options of the GNU C library: the environment variable, the number and the viewer's value of each."""


_alive: list[object] = []
"""The window, which has to outlive `run_viewer`."""


def run_viewer(
    shown: Document | str,
    is_empty: bool = False,
    screenshot: str | None = None,
    save_session: str | None = None,
    theme: str = "",
    given: ArrayStore | None = None,
) -> int:
    """Show a document, or a session's file, in the window until it is closed, or until its picture is saved.

    `given` has the fields that the document names.
    With `is_empty` the document's mesh is chosen in the window. `theme` is "light", "dark" or "desktop"; "" for the
    user's preference. Returns the exit status.
    """
    check_screen()
    set_up_allocation()
    app = application()
    take_all_exceptions()
    preferences = Preferences(theme="light") if screenshot else load()
    LOOK.choose(theme or preferences.theme)
    if isinstance(shown, Document):
        shown = as_preferred(shown, preferences)
    preferences = beginning_at(preferences, shown)
    window = MainWindow(None if isinstance(shown, str) else shown, preferences)
    window.session.given.update(given or ArrayStore())
    restore_geometry(window, preferences)
    _alive.append(window)
    failures: list[str] = []
    if screenshot:
        window.context.quiet, window.context.remembers = True, False

        def refuse(message: str) -> None:
            failures.append(message)
            window.close()

        def save() -> None:
            try:
                window.context[Files].save_screenshot(screenshot)
                if save_session:
                    window.context[SessionFile].save(save_session)
            except BihdistError as error:
                failures.append(str(error))
            window.close()

        window.refused.connect(refuse)
        window.complete.connect(save)
    elif save_session:
        save_once(window, save_session)

    def give_up(message: str) -> None:
        failures.append(message)
        app.exit()

    window.undrawable = give_up
    # The mesh is read while the panels are made.
    if isinstance(shown, str):
        window.context[Files].open(shown)
    elif is_empty:
        window.show_start()  # which needs nothing that draws
    else:
        window.show_document(shown)
    window.show()
    # Once the window has been painted: the imports take a second.
    QtCore.QTimer.singleShot(PAINTED_MS, lambda: build_panels(window))
    app.exec()
    remove_own_folder()
    for message in failures:
        print(f"bihdist: {message}", file=sys.stderr)
    answers = [shown.answer for shown in window.session.shown.values()]
    failed = dict.fromkeys(f"{answer.label}: {answer.failure}" for answer in answers if answer.failure)
    if screenshot and not failures:
        for message in failed:
            print(f"bihdist: {message}", file=sys.stderr)
    return 2 if failures else 1 if screenshot and failed else 0


def as_preferred(document: Document, preferences: Preferences) -> Document:
    """Return a document with the user's preferences for new meshes."""
    docks = tuple(dict.fromkeys(word for word in (*document.docks, *preferences.docks.split(",")) if word))
    return replace(document, isolines=Isolines(preferences.isolines), snap=preferences.snap, docks=docks)


def beginning_at(preferences: Preferences, shown: Document | str) -> Preferences:
    """Begin file dialogs at the folder of the mesh or session, unless it is a sample."""
    path = shown if isinstance(shown, str) else "".join(mesh.path for mesh in shown.surfaces[:1])
    folder = os.path.dirname(os.path.abspath(path))
    is_own = os.path.isfile(path) and folder != str(SAMPLES)
    return replace(preferences, last_folder=folder) if is_own else preferences


def set_up_allocation() -> None:
    """Let the C library return memory to the system when it is freed.

    All threads share one arena: each panel works on a thread of its own; what these leave in arenas of their own is
    seldom used again, and the process grows by a hundred megabytes in a few hundred clicks.

    Blocks of a megabyte or more, such as pictures, are mapped by themselves.  Without a fixed threshold the library
    raises it to the largest block that was freed, and the next ones leave gaps between small blocks that stay.
    """
    if sys.platform == "linux":
        with suppress(OSError, AttributeError):  # another C library
            set_option = ctypes.CDLL(None).mallopt
            for variable, option, value in ALLOCATION:
                if variable not in os.environ:
                    set_option(option, value)


def save_once(window: MainWindow, path: str) -> None:
    """Save the session as soon as the window is complete."""

    def save() -> None:
        window.complete.disconnect(save)
        window.context[SessionFile].save_or_say(path)

    window.complete.connect(save)


def build_panels(window: MainWindow) -> None:
    """Make the panels.  What was imported for them stays, so the garbage collector need not look at it again: each time
    it does, the window stands still for a tenth of a second."""
    window.build_panels()
    gc.freeze()
    if window.context.remembers:
        offer_lost_state(window.context)
