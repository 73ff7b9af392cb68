"""The window's actions: one for each row of the table of what can be done (`acts`)."""

from qtpy import QtCore, QtGui, QtWidgets

from .acts import ALL, Act
from .look.icons import put_icon


class Actions:
    """The window's actions by their words; each also has its keys, wherever the focus is."""

    def __init__(self, window: QtWidgets.QMainWindow) -> None:
        self._window = window
        self._made: dict[str, QtWidgets.QAction] = {}
        self._of_view: dict[str, QtWidgets.QAction] = {}
        for act in ALL:
            self._made[act.word] = self._new(act)

    def __getitem__(self, word: str) -> QtWidgets.QAction:
        return self._made[word]

    def allow(self, has_mesh: bool) -> None:
        """What needs a mesh can be done while there is one."""
        for act in ALL:
            if act.needs_mesh:
                self._made[act.word].setEnabled(has_mesh)

    def key_of_view(self, event: QtGui.QKeyEvent) -> bool:
        """Do what a key means in a panel that has the keys; whether it means anything."""
        modifiers = event.modifiers() & ~QtCore.Qt.KeyboardModifier.KeypadModifier
        is_tab_back = event.key() == QtCore.Qt.Key.Key_Backtab
        key = QtCore.Qt.Key.Key_Tab if is_tab_back else event.key()
        # The plus stands on a key with or without shift, as the keyboard has it.
        plain = modifiers if key not in (QtCore.Qt.Key.Key_Plus, QtCore.Qt.Key.Key_Equal) else 0
        action = self._of_view.get(QtGui.QKeySequence(int(plain) | int(key)).toString())
        if action is None or not action.isEnabled():
            return False
        action.trigger()
        return True

    def _new(self, act: Act) -> QtWidgets.QAction:
        action = QtWidgets.QAction(act.text, self._window, objectName=act.word)
        action.setProperty("lack", act.lack)
        action.setShortcuts([QtGui.QKeySequence(key) for key in act.keys])
        action.setCheckable(act.is_check)
        action.setAutoRepeat(not act.is_check)  # or it would flicker while its key is held
        action.setChecked(act.is_on)
        shown = action.shortcut().toString(QtGui.QKeySequence.SequenceFormat.NativeText)
        words = act.tip or act.text.replace("&", "").replace("…", "")
        action.setToolTip(f"{words} ({shown})" if shown else words)
        if act.icon:
            put_icon(action, act.icon)
        action.triggered.connect(lambda *_: act.do(self._window))
        if act.of_view:
            # Shown in the menu; a box and a slider have arrows of their own.
            action.setShortcutContext(QtCore.Qt.ShortcutContext.WidgetShortcut)
            self._of_view.update({QtGui.QKeySequence(key).toString(): action for key in act.keys})
        else:
            self._window.addAction(action)
        return action
