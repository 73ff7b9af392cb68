"""Whether a Linux desktop is dark, as it tells every program (org.freedesktop.portal.Settings, over D-Bus)."""

import os
from contextlib import suppress
from pathlib import Path
from typing import Any

from qtpy import QtCore, QtDBus

SERVICE, PLACE = "org.freedesktop.portal.Desktop", "/org/freedesktop/portal/desktop"
INTERFACE = "org.freedesktop.portal.Settings"
GROUP, KEY = "org.freedesktop.appearance", "color-scheme"
ANSWER_MS = 40
"""Time to wait for an answer at the start; a later one is taken as a change."""
DARK, LIGHT = 1, 2
"""Values of the setting; 0 stands for no preference."""


def has_bus() -> bool:
    """Return whether the session has a bus; D-Bus would otherwise start one and wait for it."""
    folder = os.environ.get("XDG_RUNTIME_DIR")
    return bool(os.environ.get("DBUS_SESSION_BUS_ADDRESS") or (folder and (Path(folder) / "bus").exists()))


def darkness(words: Any) -> bool | None:
    """Return the value of a setting wrapped in variants, once or twice; None if there is none."""
    while isinstance(words, QtDBus.QDBusVariant):
        words = words.variant()
    return {DARK: True, LIGHT: False}.get(words) if isinstance(words, int) else None


class DesktopPortal(QtCore.QObject):
    """The setting of a desktop; `is_dark` is None where it has none, and `changed` is emitted on a change."""

    changed = QtCore.Signal()

    def __init__(self) -> None:
        super().__init__()
        self.is_dark: bool | None = None
        self._bus = QtDBus.QDBusConnection.sessionBus()
        if not self._bus.isConnected():
            return
        # Not every binding of Qt connects to signals of the bus in this way: then the answer is that of the start.
        with suppress(TypeError, AttributeError):
            self._bus.connect(SERVICE, PLACE, INTERFACE, "SettingChanged", self._told)
        question = QtDBus.QDBusMessage.createMethodCall(SERVICE, PLACE, INTERFACE, "Read")
        question.setArguments([GROUP, KEY])
        reply = self._bus.call(question, QtDBus.QDBus.CallMode.Block, ANSWER_MS)
        if reply.type() == QtDBus.QDBusMessage.MessageType.ReplyMessage:
            self._take(reply)
        elif reply.errorName().endswith((".NoReply", ".Timeout", ".TimedOut")):
            with suppress(TypeError, AttributeError):
                self._bus.callWithCallback(question, self._take, self._refused)

    @QtCore.Slot(QtDBus.QDBusMessage)
    def _take(self, reply: QtDBus.QDBusMessage) -> None:
        self._become(darkness((reply.arguments() or [None])[0]))

    @QtCore.Slot(QtDBus.QDBusError, QtDBus.QDBusMessage)
    def _refused(self, error: QtDBus.QDBusError, message: QtDBus.QDBusMessage) -> None:
        """Take note that no portal answers."""

    @QtCore.Slot(QtDBus.QDBusMessage)
    def _told(self, message: QtDBus.QDBusMessage) -> None:
        words = message.arguments()
        if len(words) == 3 and words[:2] == [GROUP, KEY]:
            self._become(darkness(words[2]))

    def _become(self, is_dark: bool | None) -> None:
        if is_dark != self.is_dark:
            self.is_dark = is_dark
            self.changed.emit()
