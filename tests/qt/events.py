"""What a pointer and keys do, in the form that all bindings of Qt take, and how long they take."""

ROUNDS = 50
"""Of events in a second of waiting, at least: on a busy machine one may take longer than all that is waited."""


def send_mouse(widget, place, button=None, buttons=None, keys=None, kind=None):
    """Send a mouse event at a place of a widget; a move if no other kind is named, without buttons and keys."""
    from qtpy import QtCore, QtGui, QtWidgets

    nothing, place = QtCore.Qt.MouseButton.NoButton, QtCore.QPointF(place)
    keys = QtCore.Qt.KeyboardModifier.NoModifier if keys is None else keys
    kind = QtCore.QEvent.Type.MouseMove if kind is None else kind
    on_screen = QtCore.QPointF(widget.mapToGlobal(place.toPoint()))
    button, buttons = nothing if button is None else button, nothing if buttons is None else buttons
    QtWidgets.QApplication.sendEvent(widget, QtGui.QMouseEvent(kind, place, on_screen, button, buttons, keys))


def turn_wheel(widget):
    """Turn the wheel by one notch in the middle of a widget; return whether that uses it, and nothing around it can."""
    from qtpy import QtCore, QtGui, QtWidgets

    place, on_screen = QtCore.QPointF(widget.rect().center()), widget.mapToGlobal(widget.rect().center())
    notch, nothing = QtCore.QPoint(0, 120), (QtCore.Qt.MouseButton.NoButton, QtCore.Qt.KeyboardModifier.NoModifier)
    phase = QtCore.Qt.ScrollPhase.NoScrollPhase
    event = QtGui.QWheelEvent(place, QtCore.QPointF(on_screen), QtCore.QPoint(), notch, *nothing, phase, False)
    QtWidgets.QApplication.sendEvent(widget, event)
    return event.isAccepted()


def press(widget, name):
    """Press and release what is written "Shift+Left" on a widget."""
    from qtpy import QtCore, QtGui, QtTest

    code = QtGui.QKeySequence(name)[0]
    if hasattr(code, "toCombined"):  # of Qt 6
        code = code.toCombined()
    key, modifiers = code & 0x01FFFFFF, code & ~0x01FFFFFF
    held = QtCore.Qt.KeyboardModifier.NoModifier
    for each in ("Shift", "Control", "Alt", "Meta"):
        modifier = getattr(QtCore.Qt.KeyboardModifier, f"{each}Modifier")
        if modifiers & int(getattr(modifier, "value", modifier)):
            held |= modifier
    QtTest.QTest.keyClick(widget, QtCore.Qt.Key(key), held)
