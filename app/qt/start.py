"""Start Qt, show the window, open a mesh."""

import gc
import sys
import traceback

from qtpy import QtCore

from bihdist_core import BihdistError

from ..document.document import Document
from .application import application, check_screen
from .main_window import MainWindow
from .session_actions import offer_lost_state

PAINTED_MS = 50


_alive: list[object] = []
"""The window, which must not be taken down when `run_viewer` returns."""


def run_viewer(shown: Document | str, screenshot: str | None, save_session: str | None = None) -> int:
    """Show a document, or a session's file, in the window until that is closed, or until its picture is saved.

    Returns the exit status.
    """
    check_screen()
    app = application()
    # PyQt5 ends the process on an exception in a slot unless there is a hook.
    sys.excepthook = lambda *error: traceback.print_exception(*error)
    window = MainWindow(None if isinstance(shown, str) else shown)
    _alive.append(window)
    failures: list[str] = []
    if screenshot:
        window.quiet, window.remembers = True, False

        def refuse(message: str) -> None:
            failures.append(message)
            window.close()

        def save() -> None:
            try:
                window.save_screenshot(screenshot)
                if save_session:
                    window.session_file.save(save_session)
            except BihdistError as error:
                failures.append(str(error))
            window.close()

        window.refused.connect(refuse)
        window.complete.connect(save)
    elif save_session:
        save_once(window, save_session)
    window.show()
    if isinstance(shown, str):
        window.open_any(shown)
    else:
        window.show_document(shown)
    # Once the window has been painted: the imports take a second.
    QtCore.QTimer.singleShot(PAINTED_MS, lambda: build_panels(window))
    app.exec()
    for message in failures:
        print(f"bihdist: {message}", file=sys.stderr)
    answers = [shown.answer for shown in window.session.shown.values()]
    failed = dict.fromkeys(f"{answer.label}: {answer.failure}" for answer in answers if answer.failure)
    if screenshot and not failures:
        for message in failed:
            print(f"bihdist: {message}", file=sys.stderr)
    return 2 if failures else 1 if screenshot and failed else 0


def save_once(window: MainWindow, path: str) -> None:
    """Save the session as soon as the window is complete; from then on it is the session's file."""

    def save() -> None:
        window.complete.disconnect(save)
        window.session_file.save_or_say(path)

    window.complete.connect(save)


def build_panels(window: MainWindow) -> None:
    """Make the panels.  What was imported for them stays, so the garbage collector need not look at it again: each time
    it does, the window stands still for a tenth of a second."""
    window.build_panels()
    gc.freeze()
    if window.remembers:
        offer_lost_state(window)
