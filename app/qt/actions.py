"""The window's actions: one for each row of the table of what can be done (`acts`)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from ..document.tools import tools
from .context import Context
from .look.icons import put_icon


@dataclass(frozen=True)
class Act:
    """word: its name here; do: what it does.

    keys: the first is the one that is shown.  of_view: they work where a panel has the keys, and not in a box.
    needs_mesh: it makes no sense without one.  is_on: a check is ticked at first.  lack: why it cannot be done where it
    is disabled although there is a mesh.
    """

    word: str
    text: str
    do: Callable[[Context], object]
    keys: tuple[str, ...] = ()
    tip: str = ""
    icon: str = ""
    of_view: bool = False
    needs_mesh: bool = True
    is_check: bool = False
    is_on: bool = False
    lack: str = ""


def acts_of_tools() -> tuple[Act, ...]:
    """What tools add to the menus and keys, beside opening their docks."""
    return tuple(act for tool in tools() if tool.actions for act in tool.load(tool.actions))


class Actions:
    """The window's actions by their words; each also has its keys, wherever the focus is."""

    def __init__(self, context: Context, acts: Sequence[Act]) -> None:
        self._context = context
        self._made = context.actions
        self._of_view: dict[str, QtWidgets.QAction] = {}
        self._acts = acts
        for act in acts:
            self._made[act.word] = self._new(act)

    def __getitem__(self, word: str) -> QtWidgets.QAction:
        return self._made[word]

    def allow(self, has_mesh: bool) -> None:
        """What needs a mesh can be done while there is one."""
        for act in self._acts:
            if act.needs_mesh:
                self._made[act.word].setEnabled(has_mesh)

    def key_of_view(self, event: QtGui.QKeyEvent) -> bool:
        """Do what a key means in a panel that has the keys; whether it means anything."""
        modifiers = event.modifiers() & ~QtCore.Qt.KeyboardModifier.KeypadModifier
        is_tab_back = event.key() == QtCore.Qt.Key.Key_Backtab
        key = QtCore.Qt.Key.Key_Tab if is_tab_back else event.key()
        # The plus stands on a key with or without shift, as the keyboard has it.
        plain = modifiers if key not in (QtCore.Qt.Key.Key_Plus, QtCore.Qt.Key.Key_Equal) else 0
        # Of Qt 6 modifiers are no numbers, but have one.
        number = int(getattr(plain, "value", plain)) | int(key)
        action = self._of_view.get(QtGui.QKeySequence(number).toString())
        if action is None or not action.isEnabled():
            return False
        action.trigger()
        return True

    def _new(self, act: Act) -> QtWidgets.QAction:
        action = QtWidgets.QAction(act.text, self._context.widget, objectName=act.word)
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
        action.triggered.connect(lambda *_: act.do(self._context))
        if act.of_view:
            # Shown in the menu; a box and a slider have arrows of their own.
            action.setShortcutContext(QtCore.Qt.ShortcutContext.WidgetShortcut)
            self._of_view.update({QtGui.QKeySequence(key).toString(): action for key in act.keys})
        else:
            self._context.widget.addAction(action)
        return action
