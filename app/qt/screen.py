"""Whether a window can be shown here.  Asked before Qt and VTK, which do not raise but end the process.

Nothing is imported here that needs what is asked for.
"""

import ctypes
import os
import re
import sys
import threading
from importlib import import_module
from importlib.util import find_spec

from bihdist_core.errors import BihdistError

DRAWING = ("libEGL.so.1", "libGL.so.1")
"""Libraries that VTK opens by itself."""

PACKAGES = (
    "libegl1 libgl1 libglib2.0-0 libfontconfig1 libdbus-1-3 libxkbcommon-x11-0 libxcb-icccm4 libxcb-image0 "
    "libxcb-keysyms1 libxcb-render-util0 libxcb-shape0 libxcb-xinerama0 libxcursor1"
)
"""Packages of Debian and Ubuntu that the wheels of VTK and Qt need."""

WITHOUT_ONE = "`bihdist figure` draws without one, and in notebooks `bihdist.widget` shows it"

ANSWER_S = 10.0
"""Time after which a display that does not answer is taken as missing."""

_held: dict[str, int] = {}
"""A connection to each display that has answered: a server such as Xvfb starts anew, and for a moment lets nobody in,
when its last client leaves, which would be just before Qt comes."""

_BINDINGS = ("PyQt5", "PySide6", "PyQt6", "PySide2")


def check_screen() -> None:
    """Raise BihdistError where a display or a library is missing, or the display does not answer."""
    check_display()
    check_libraries()


def check_display() -> None:
    """Raise BihdistError where there is no display, or where it does not answer."""
    if not sys.platform.startswith("linux"):
        return
    display = os.environ.get("DISPLAY", "")
    if not (display or os.environ.get("WAYLAND_DISPLAY")):
        raise BihdistError(f"The viewer needs a display and there is none (DISPLAY is not set); {WITHOUT_ONE}.")
    if _uses_x() and not _answers(display):
        raise BihdistError(
            f"The viewer needs a display, and the one that DISPLAY names ({display}) does not answer; {WITHOUT_ONE}."
        )


def check_libraries() -> None:
    """Raise BihdistError, with what to install, where Qt or VTK lacks libraries of the system."""
    is_linux = sys.platform.startswith("linux")
    try:
        for library in DRAWING if is_linux else ():
            ctypes.CDLL(library)
        for part in ("QtCore", "QtGui", "QtWidgets"):
            import_module(f"qtpy.{part}")
        if is_linux:
            _check_platform()
        if is_linux and _uses_x():
            _load_x_plugin()
    except (ImportError, OSError) as error:
        reason = _reason(error)
        missing = re.match(r"lib[\w.+-]+\.so[.\d]*", reason)
        if missing is None:
            raise BihdistError(f"The window needs Qt, which cannot be loaded: {reason}.") from None
        raise BihdistError(
            f"The window needs {missing[0]}, which is not installed; on Debian or Ubuntu: apt-get install {PACKAGES}"
        ) from None


def _uses_x() -> bool:
    """Return whether Qt will show its windows through X."""
    platform = os.environ.get("QT_QPA_PLATFORM", "")
    return platform.startswith("xcb") if platform else bool(os.environ.get("DISPLAY"))


def _answers(display: str) -> bool:
    """Return whether an X server lets this user in."""
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError:
        return True  # the libraries are looked at next
    xcb.xcb_connect.restype = ctypes.c_void_p
    xcb.xcb_connect.argtypes = ctypes.c_char_p, ctypes.c_void_p
    xcb.xcb_connection_has_error.argtypes = xcb.xcb_disconnect.argtypes = (ctypes.c_void_p,)
    errors: list[int] = []

    def connect() -> None:
        connection = xcb.xcb_connect(os.fsencode(display), None)
        errors.append(xcb.xcb_connection_has_error(connection))
        if errors[0] or _held.setdefault(display, connection) != connection:
            xcb.xcb_disconnect(connection)

    # On a thread, as a computer that is not there lets one wait for minutes.
    thread = threading.Thread(target=connect, name="display", daemon=True)
    thread.start()
    thread.join(ANSWER_S)
    return errors == [0]


def _check_platform() -> None:
    """Raise BihdistError where Qt has no plug-in for its platform, which would end the process."""
    asked = os.environ.get("QT_QPA_PLATFORM") or ("xcb" if _uses_x() else "wayland")
    wanted = [word.partition(":")[0] for word in asked.split(";")]
    folders = [*os.environ.get("QT_QPA_PLATFORM_PLUGIN_PATH", "").split(":"), _platforms()]
    files = [name for folder in folders if os.path.isdir(folder) for name in os.listdir(folder)]
    # Some have names such as libqwayland-generic.so.
    if not any(name.startswith(f"libq{word}") for name in files for word in wanted):
        there = ", ".join(sorted(name[4:-3] for name in files if name.startswith("libq") and name.endswith(".so")))
        remedy = f"there are {there}; choose one with QT_QPA_PLATFORM" if there else f"there is none in {_platforms()}"
        raise BihdistError(f"The window needs Qt, which has no plug-in for the platform {asked}: {remedy}.")


def _platforms() -> str:
    """Return the folder of Qt's plug-ins for platforms."""
    info = import_module("qtpy.QtCore").QLibraryInfo
    kinds = getattr(info, "LibraryPath", None) or getattr(info, "LibraryLocation", info)
    return os.path.join((getattr(info, "path", None) or info.location)(kinds.PluginsPath), "platforms")


def _load_x_plugin() -> None:
    """Raise OSError, which names the library, where Qt's plug-in for X cannot be loaded."""
    plugin = os.path.join(_platforms(), "libqxcb.so")
    if os.path.exists(plugin):
        ctypes.CDLL(plugin)


def _reason(error: Exception) -> str:
    """Return the reason for which an import failed; if no binding can be imported, that of the first installed one."""
    if type(error).__name__ == "QtBindingsNotFoundError":
        for binding in _BINDINGS:
            if find_spec(binding):
                try:
                    import_module(f"{binding}.QtCore")
                except ImportError as first:
                    return str(first)
    return str(error)
