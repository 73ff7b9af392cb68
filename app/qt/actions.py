"""The window's actions: one for each row of the table of what can be done (`acts`)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from ..document.tools import tools
from .context import Context
from .look.icons import put_icon


@dataclass(frozen=True)
class Action:
    """An action of a menu, a key or a button.

    Parameters
    ----------
    word, text, do
        Its name here, what menus call it, and what it does.
    keys : tuple of str
        Shortcuts, the first of which is shown.
    tip : str
        What its tool tip says after its name and its key.
    icon : str
        A name of `assets/icons`.
    of_view : bool
        The keys work where a panel has the focus, and not in a box.
    needs_mesh : bool
        It makes no sense without one.
    is_check : bool
        It has a tick, which is set elsewhere.
    is_on : callable, optional
        Says whether it is ticked: asked after each change of the document and of the preferences.
    can_run : callable, optional
        Says whether it can be done; asked then, too.
    lack : str
        Why it cannot, where there is a mesh.
    synonyms : str
        Other words by which the palette finds it.
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
    is_on: Callable[[Context], bool] | None = None
    can_run: Callable[[Context], bool] | None = None
    lack: str = ""
    synonyms: str = ""


def actions_of_tools() -> tuple[Action, ...]:
    """Return the actions that tools add to menus and keys, beside opening their docks."""
    return tuple(act for tool in tools() if tool.actions for act in tool.load(tool.actions))


class Actions:
    """The window's actions by their words; each also has its keys, wherever the focus is."""

    def __init__(self, context: Context, acts: Sequence[Action]) -> None:
        self._context = context
        self._made = context.actions
        self._of_view: dict[str, QtWidgets.QAction] = {}
        self._acts = acts
        for act in acts:
            self._made[act.word] = self._new(act)

    def __getitem__(self, word: str) -> QtWidgets.QAction:
        return self._made[word]

    def allow(self, has_mesh: bool) -> None:
        """Enable the actions that need a mesh, or disable them where there is none."""
        for act in self._acts:
            if act.needs_mesh:
                self._made[act.word].setEnabled(has_mesh)

    def show(self) -> None:
        """Tick what is on, and disable what cannot be done."""
        for act in self._acts:
            if act.is_on is not None:
                self._made[act.word].setChecked(act.is_on(self._context))
            if act.can_run is not None:
                self._made[act.word].setEnabled(act.can_run(self._context))

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

    def _new(self, act: Action) -> QtWidgets.QAction:
        action = QtWidgets.QAction(act.text, self._context.widget, objectName=act.word)
        action.setProperty("lack", act.lack)
        action.setShortcuts([QtGui.QKeySequence(key) for key in act.keys])
        action.setProperty("synonyms", act.synonyms)
        is_check = act.is_check or act.is_on is not None
        action.setCheckable(is_check)
        action.setAutoRepeat(not is_check)  # or it would flicker while its key is held
        shown = action.shortcut().toString(QtGui.QKeySequence.SequenceFormat.NativeText)
        name = act.text.replace("&", "").removesuffix("…") + (f" ({shown})" if shown else "")
        action.setToolTip(f"{name}: {act.tip[0].lower()}{act.tip[1:]}" if act.tip else name)
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
