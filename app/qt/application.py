"""Qt's application and its event loop, for the command and for scripts."""

import locale
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import qtpy
from qtpy import QtCore, QtWidgets

from .look.look import LOOK
from .screen import check_screen as check_screen

POLL_MS = 20
"""Interval at which the condition is checked."""

PROGRAM = "bihdist"
"""Name of the entry in a desktop's menu, and of the windows' class."""

_kept: list[QtWidgets.QApplication] = []
"""Qt's application, which has to outlive all windows."""


def application() -> QtWidgets.QApplication:
    """Return Qt's application, made if needed; the environment and the locale stay as they are."""
    known = QtWidgets.QApplication.instance()
    if known is not None:
        return known
    for word in ("AA_EnableHighDpiScaling", "AA_UseHighDpiPixmaps"):
        # Qt 6 does it by itself.
        if qtpy.QT5:
            QtWidgets.QApplication.setAttribute(getattr(QtCore.Qt.ApplicationAttribute, word))
    policy = QtCore.Qt.HighDpiScaleFactorRoundingPolicy
    # X servers make up sizes of screens, and at 1.04 every line is blurred; letters still take the size that is meant.
    is_x = sys.platform.startswith("linux")
    QtWidgets.QApplication.setHighDpiScaleFactorRoundingPolicy(policy.RoundPreferFloor if is_x else policy.PassThrough)
    spoken = locale.setlocale(locale.LC_ALL)
    with _drawn_through_x():
        _kept.append(QtWidgets.QApplication(sys.argv[:1]))
    # By these desktops find the entry in their menu to which windows belong.
    _kept[-1].setApplicationName(PROGRAM)
    _kept[-1].setDesktopFileName(PROGRAM)
    # Qt takes the user's, and then C libraries write 0,5 for a half.
    locale.setlocale(locale.LC_ALL, spoken)
    # The one that looks the same everywhere, and takes our colours.
    _kept[-1].setStyle("Fusion")
    if is_x:
        LOOK.fit_to(_kept[-1].primaryScreen().logicalDotsPerInch())
    return _kept[-1]


@contextmanager
def _drawn_through_x() -> Iterator[None]:
    """Have Qt use X, through which alone VTK draws."""
    both = os.environ.get("DISPLAY") and os.environ.get("WAYLAND_DISPLAY")
    is_ours = bool(both) and "QT_QPA_PLATFORM" not in os.environ
    if is_ours:
        os.environ["QT_QPA_PLATFORM"] = "xcb"
    try:
        yield
    finally:
        if is_ours:
            del os.environ["QT_QPA_PLATFORM"]


def run_until(condition: Callable[[], bool]) -> None:
    """Run the event loop until a condition holds; KeyboardInterrupt if the user presses Ctrl+C."""
    loop = QtCore.QEventLoop()
    timer = QtCore.QTimer(interval=POLL_MS, timeout=loop.quit)
    timer.start()
    with interrupts_noted():
        while not (condition() or _interrupts):
            loop.exec()
        if _interrupts:
            raise KeyboardInterrupt


_interrupts: list[int] = []


def _note(number: int, frame: object) -> None:
    _interrupts.append(number)


@contextmanager
def interrupts_noted() -> Iterator[None]:
    """Note Ctrl+C, and raise it at the end; within a slot it would end the process."""
    is_python = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if not is_python or threading.current_thread() is not threading.main_thread():
        yield
        return
    signal.signal(signal.SIGINT, _note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        noted = bool(_interrupts)
        _interrupts.clear()
    if noted:
        raise KeyboardInterrupt
