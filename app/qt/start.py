"""Start Qt, show the window, open a mesh."""

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
from ..samples import SAMPLES
from .application import application, check_screen
from .files.files import Files
from .files.session_actions import SessionFile, offer_lost_state
from .look.look import LOOK
from .look.own_folder import remove_own_folder
from .main_window import MainWindow
from .preferences import Preferences, load, restore_geometry
from .unexpected_errors import take_all_exceptions

PAINTED_MS = 50

M_ARENA_MAX = -8
"""The GNU C library's word for the number of arenas."""


_alive: list[object] = []
"""The window, which must not be taken down when `run_viewer` returns."""


def run_viewer(
    shown: Document | str,
    is_empty: bool = False,
    screenshot: str | None = None,
    save_session: str | None = None,
    theme: str = "",
) -> int:
    """Show a document, or a session's file, in the window until that is closed, or until its picture is saved.

    is_empty: the document's mesh is chosen in the window.  theme: "light", "dark" or "desktop"; "" for what the user
    prefers.
    Returns the exit status.
    """
    check_screen()
    share_arenas()
    app = application()
    take_all_exceptions()
    preferences = Preferences(theme="light") if screenshot else load()
    LOOK.choose(theme or preferences.theme)
    if isinstance(shown, Document):
        shown = as_preferred(shown, preferences)
    preferences = beginning_at(preferences, shown)
    window = MainWindow(None if isinstance(shown, str) else shown, preferences)
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
    elif not is_empty:
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
    """A document as the user wants what is opened anew."""
    return replace(document, isolines=Isolines(preferences.isolines), snap=preferences.snap)


def beginning_at(preferences: Preferences, shown: Document | str) -> Preferences:
    """With dialogs that begin at the folder of a document's mesh, or of a session, unless that is a sample."""
    path = shown if isinstance(shown, str) else "".join(mesh.path for mesh in shown.surfaces[:1])
    folder = os.path.dirname(os.path.abspath(path))
    is_own = os.path.isfile(path) and folder != str(SAMPLES)
    return replace(preferences, last_folder=folder) if is_own else preferences


def share_arenas() -> None:
    """Let all threads have memory from one arena of the C library's.

    Each panel works on a thread of its own; what these leave in arenas of their own is seldom used again, and the
    process grows by a hundred megabytes in a few hundred clicks.
    """
    if sys.platform == "linux" and "MALLOC_ARENA_MAX" not in os.environ:
        with suppress(OSError, AttributeError):  # another C library
            ctypes.CDLL(None).mallopt(M_ARENA_MAX, 1)


def save_once(window: MainWindow, path: str) -> None:
    """Save the session as soon as the window is complete; from then on it is the session's file."""

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
