"""Keys that act while they are held, whichever widget has the focus."""

from qtpy import QtCore, QtWidgets

from .context import Context

BRUSH, LIVE = QtCore.Qt.Key.Key_B, QtCore.Qt.Key.Key_L
"""The key with which drags paint a selection, and the key with which the source follows the pointer."""

TEXTS = (QtWidgets.QLineEdit, QtWidgets.QTextEdit, QtWidgets.QPlainTextEdit)
"""Widgets in which keys are typed text."""


class HeldKeys(QtCore.QObject):
    """Sees the keys before any widget of the window does."""

    brush_held = QtCore.Signal(bool)  # its key is down, or up again
    live_key_up = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._widgets: dict[QtCore.QObject, QtWidgets.QWidget] = {}  # by what Qt calls their windows
        self.watch(context.widget)

    def watch(self, widget: QtWidgets.QWidget) -> None:
        """Watch the keys of a window, or of a dock that floats over it."""
        widget.winId()  # from now on it has one
        self._widgets[widget.windowHandle()] = widget
        widget.windowHandle().installEventFilter(self)

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:
        kinds = QtCore.QEvent.Type
        if event.type() == kinds.FocusOut:
            self.brush_held.emit(False)
        if event.type() not in (kinds.KeyPress, kinds.KeyRelease) or event.key() not in (BRUSH, LIVE):
            return False
        is_down, is_live = event.type() == kinds.KeyPress, event.key() == LIVE
        is_text = isinstance(self._widgets[watched].focusWidget(), TEXTS)
        if is_live:
            if not (is_down or is_text or event.isAutoRepeat()):
                self.live_key_up.emit()
            return False
        if is_down and (is_text or event.modifiers()):
            return False
        if not event.isAutoRepeat():
            self.brush_held.emit(is_down)
        return bool(is_down)
