"""The user's preferences, kept from one start to the next in `preferences.ini` in the folder for application data.

Whatever stands there, the program starts: each value is checked by itself, and a file that cannot be read is put aside.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import Field, fields
from pathlib import Path
from typing import Any

from qtpy import QtCore, QtWidgets

from ..document.settings import Preferences, Setting
from ..document.tools import docked_tools
from . import remembered

VERSION = 1
"""Version of the file; one of a newer program is left alone."""

FIRST_SIZE = QtCore.QSize(1400, 860)
"""Size of the first window in logical pixels, where the screen has room for it."""

MARGIN = 40
"""Logical pixels by which a screen is larger than the first window, in each direction."""

REACHABLE = QtCore.QSize(120, 12)
"""Part of a window's top that has to be on a screen, so that the user can drag it."""


def path() -> Path:
    """Return the path of the file with the preferences."""
    return remembered.folder() / "preferences.ini"


def load() -> Preferences:
    """Load the preferences; what is missing or makes no sense is as at first."""
    with _file() as settings:
        if settings is None:
            return Preferences()
        read = {field.name: _read(field, _value(settings, field.name)) for field in fields(Preferences)}
        return Preferences(**{name: value for name, value in read.items() if value is not None})


def save(preferences: Preferences) -> None:
    """Other entries of the file stay; where nothing can be written, nothing is."""
    with suppress(OSError):
        remembered.folder().mkdir(parents=True, exist_ok=True)
    with _file() as settings:
        if settings is not None:
            settings.setValue("version", VERSION)
            for field in fields(Preferences):
                value = getattr(preferences, field.name)
                settings.setValue(field.name, value.hex() if isinstance(value, bytes) else value)


@contextmanager
def _file() -> Iterator[QtCore.QSettings | None]:
    """The file, written at the end as far as it was changed; None if it is a newer program's."""
    _put_aside_if_damaged()
    settings = _opened()
    yield settings if (_version(settings) or VERSION) <= VERSION else None
    settings.sync()


def _opened() -> QtCore.QSettings:
    return QtCore.QSettings(str(path()), QtCore.QSettings.Format.IniFormat)


def _version(settings: QtCore.QSettings) -> int | None:
    return _whole(_value(settings, "version"), 1, 10**9)


def _put_aside_if_damaged() -> None:
    """Put a file aside that is there and is none of ours."""
    here = path()
    if os.path.lexists(here) and not (here.is_file() and _is_ours(here)):
        with suppress(OSError):
            os.replace(here, here.with_name(here.name + ".damaged"))


def _is_ours(here: Path) -> bool:
    try:
        whole = here.read_bytes()
    except OSError:
        return True  # it may be sound, and only not for us
    if not whole.strip():
        return True
    settings = _opened()
    return settings.status() == QtCore.QSettings.Status.NoError and _version(settings) is not None


# ---------------------------------------------------------------------- values
def _value(settings: QtCore.QSettings, name: str) -> Any:
    """Return a value as it stands in the file; None for what Qt cannot read."""
    try:
        return settings.value(name)
    except Exception:  # whatever reading an object of some other program raises
        return None


def _whole(value: Any, low: int, high: int) -> int | None:
    try:
        found = int(value) if isinstance(value, str | int) else None
    except ValueError:
        return None
    return found if found is not None and low <= found <= high else None


def _docks(value: Any) -> str | None:
    """Return the docks that there still are; one with commas comes from Qt as a list."""
    words = value if isinstance(value, list) else str(value or "").split(",")
    known = (str(word).strip() for word in words)
    return ",".join(dict.fromkeys(word for word in known if word in docked_tools()))


def _hexadecimal(value: Any) -> bytes | None:
    try:
        return bytes.fromhex(value) if isinstance(value, str) else None
    except ValueError:
        return None


def _read(field: "Field[Any]", value: Any) -> Any:
    """Return a preference from what stands in the file for it; None if that is none."""
    setting: Setting | None = field.metadata.get("setting")
    if field.name == "docks":
        return _docks(value)
    if isinstance(field.default, bool):
        return {"true": True, "false": False}.get(str(value).lower())
    if isinstance(field.default, int):
        return _whole(value, 0, setting.most if setting else 10**9)
    if isinstance(field.default, bytes):
        return _hexadecimal(value)
    is_known = isinstance(value, str) and not (setting and setting.choices and value not in setting.choices)
    return value if is_known else None


# ---------------------------------------------------------------------- where the window is
def fit_to_screen(window: QtWidgets.QWidget) -> None:
    """The first place of a window."""
    window.setGeometry(first_place(window.screen().availableGeometry()))


def restore_geometry(window: QtWidgets.QWidget, preferences: Preferences) -> None:
    """Put a window where it was, as far as there still is a screen; called before it is shown."""
    if not (preferences.geometry and window.restoreGeometry(QtCore.QByteArray(preferences.geometry))):
        fit_to_screen(window)
        return
    states = QtCore.Qt.WindowState
    is_maximized = bool(window.windowState() & states.WindowMaximized)
    # A talk's full screen is over, and a window that starts as an icon looks like one that does not start.
    window.setWindowState(states.WindowNoState)
    screens = [screen.availableGeometry() for screen in QtWidgets.QApplication.screens()]
    window.setGeometry(brought_back(window.geometry(), screens))
    if is_maximized:
        window.setWindowState(states.WindowMaximized)


def first_place(available: QtCore.QRect) -> QtCore.QRect:
    """Return the place in the middle of what a screen has."""
    return _centred(FIRST_SIZE, available)


def brought_back(place: QtCore.QRect, screens: list[QtCore.QRect]) -> QtCore.QRect:
    """Return a place that can be seen and reached: the same if it can, else one on the first screen.

    `screens` has the available part of each screen.
    """
    top = QtCore.QRect(place.topLeft(), QtCore.QSize(place.width(), 2 * REACHABLE.height()))
    for available in screens:
        seen = top.intersected(available)
        if seen.width() >= REACHABLE.width() and seen.height() >= REACHABLE.height():
            is_too_large = place.width() > available.width() or place.height() > available.height()
            return _centred(place.size(), available) if is_too_large else place
    return _centred(place.size(), screens[0]) if screens else place


def _centred(size: QtCore.QSize, available: QtCore.QRect) -> QtCore.QRect:
    size = size.boundedTo(available.size() - QtCore.QSize(MARGIN, MARGIN))
    place = QtCore.QRect(QtCore.QPoint(0, 0), size)
    place.moveCenter(available.center())
    return place
