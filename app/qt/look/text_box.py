"""Text boxes that leave shortcuts to the window, and the outline of wrong values."""

from qtpy import QtCore, QtGui, QtWidgets


class TextBox(QtWidgets.QLineEdit):
    """A text box that leaves the window's shortcuts to the window."""

    def event(self, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.ShortcutOverride and not self._edits(event):
            event.ignore()
            return True
        return bool(super().event(event))

    def _edits(self, event: QtGui.QKeyEvent) -> bool:
        """Return whether a key is for the text rather than for the window."""
        modifier, keys = QtCore.Qt.KeyboardModifier, QtGui.QKeySequence.StandardKey
        if not event.modifiers() & (modifier.ControlModifier | modifier.AltModifier | modifier.MetaModifier):
            return True
        if event.matches(keys.Undo):
            return bool(self.isUndoAvailable())
        if event.matches(keys.Redo):
            return bool(self.isRedoAvailable())
        always = (keys.SelectAll, keys.Copy, keys.Cut, keys.Paste)
        moves = (keys.MoveToNextWord, keys.MoveToPreviousWord, keys.SelectNextWord, keys.SelectPreviousWord)
        deletes = (keys.DeleteStartOfWord, keys.DeleteEndOfWord)
        return any(event.matches(key) for key in (*always, *moves, *deletes))


def mark_wrong(box: QtWidgets.QWidget, is_wrong: bool) -> None:
    """Show or remove the outline of a wrong value."""
    if bool(box.property("wrong")) != is_wrong:
        box.setProperty("wrong", is_wrong)
        box.style().unpolish(box)
        box.style().polish(box)
