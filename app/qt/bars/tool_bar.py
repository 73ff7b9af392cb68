"""The tool bar: what one needs all the time, with the value that is chosen.

Where it is narrow words go first, and then what has no room at all goes into the menu of a button, ⋯.
"""

from qtpy import QtCore, QtGui, QtWidgets

from ...document.tools import tools
from ..context import Context
from ..look.look import LOOK
from ..typed_source import TypedSource
from .menus import Menus
from .tool_button import FULL, ICONS, VALUES, ToolButton

HEIGHT = 44

DOCKS = {f"dock {tool.word}": tool.icon for tool in tools() if tool.in_bar}
"""Tools with a button of their own, and its icon; the others are in the menu Tools."""

FIRST_TO_GO = ("preferences", "up", *reversed(DOCKS), "views", "range", "colours", "isolines", "redo", "tools", "undo")
FIRST_TO_GO += ("add panel", "live")
"""Where even the icons have no room: which buttons go into the menu of ⋯, the first of these first."""

LAST_IN_WORDS = ("export", "open", "live", "add panel", "isolines", "colours", "range", "views", "up")
"""Beside values that have room these keep their words as long as there is any, the last of these the shortest."""


class ToolBar(QtWidgets.QToolBar):
    """buttons: by name."""

    def __init__(self, context: Context, menus: Menus) -> None:
        super().__init__("Tools", context.widget)
        self.setObjectName("tools")  # the places of docks are kept with it
        self.setMovable(False)
        self.setFloatable(False)
        self.setContextMenuPolicy(QtCore.Qt.ContextMenuPolicy.PreventContextMenu)
        self.buttons: dict[str, ToolButton] = {}
        self._shown_as: dict[str, QtWidgets.QAction] = {}
        self._lines: list[QtWidgets.QAction] = []
        self._acts: dict[str, QtWidgets.QAction] = {}  # of buttons without a menu
        self._left_out: tuple[str, ...] = ()
        self._menu("open", "open", "Open", menus.open, "Open a mesh, a recent file or a sample (Ctrl+O)")
        self._line()
        self._button("undo", "undo", "", context.actions["undo"])
        self._button("redo", "redo", "", context.actions["redo"])
        self._line()
        self._menu("tools", "source", "", menus.tools, "The source: type it, step along edges, live")
        for word, icon in DOCKS.items():
            self._button(word, icon, "", context.actions[word])
        self.source_box = context[TypedSource].box
        label = QtWidgets.QLabel("Source")
        label.setProperty("quiet", True)
        label.setBuddy(self.source_box)
        label.setContentsMargins(6, 0, 2, 0)
        self._shown_as["source label"] = self.addWidget(label)
        self.addWidget(self.source_box)
        self._button("live", "live", "Live", context.actions["live"])
        self._line()
        self._menu("isolines", "isolines", "Isolines", menus.isolines, "How many isolines there are, and where")
        self._menu("colours", "colours", "Colours", menus.colours, "The colours of the fields")
        self._menu("range", "range", "Range", menus.range, "Where the colours end: in each panel, or in all alike")
        self._menu("views", "views", "View", menus.views, "Standard views (1 to 7, R), views before and after")
        self._menu("up", "up-axis", "Up", menus.up, "Which axis points up (U, Shift+U)")
        self._line()
        self._button("add panel", "add-panel", "Panel", context.actions["add panel"])
        gap = QtWidgets.QWidget()
        gap.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Preferred)
        self.addWidget(gap)
        self._button("export", "export-figure", "Export", context.actions["figure"], is_meant=True)
        self._button("preferences", "settings", "", context.actions["preferences"])
        self._rest = QtWidgets.QMenu(self)
        self._menu("more", "more", "", self._rest, "More: what there is no room for")
        LOOK.changed.connect(self.fit)
        self.fit()

    def allow(self, has_mesh: bool) -> None:
        """Enable the buttons that need a mesh, or disable them."""
        for name in ("tools", "isolines", "colours", "range", "views", "up"):
            # The action a button is put in by enables it whenever it is shown or hidden.
            self._shown_as[name].setEnabled(has_mesh)

    @property
    def left_out(self) -> tuple[str, ...]:
        """The names of buttons that are in the menu of ⋯, as they stand in the bar."""
        return self._left_out

    def fit(self) -> None:
        """Write as much as there is room for."""
        room = self.width()
        self.setFixedHeight(round(HEIGHT * max(1, LOOK.scale)))
        for detail in (FULL, VALUES, ICONS):
            if self._width_with(detail, set()) <= room:
                break
        left_out: set[str] = set()
        for name in FIRST_TO_GO:
            if self._width_with(detail, left_out) <= room:
                break
            left_out.add(name)
        spare = room - self._width_with(detail, left_out)
        in_words = set()
        for name in LAST_IN_WORDS if detail == VALUES else ():
            button = self.buttons[name]
            spare -= button.width_with(FULL) - button.width_with(detail)
            if spare < 0:
                break
            in_words.add(name)
        for name, button in self.buttons.items():
            button.show_detail(FULL if name in in_words else detail)
            self._shown_as[name].setVisible(name not in left_out and (name != "more" or bool(left_out)))
        self._shown_as["source label"].setVisible(detail != ICONS)
        self._offer(tuple(name for name in self.buttons if name in left_out))

    def _offer(self, names: tuple[str, ...]) -> None:
        """Let the menu of ⋯ have what these buttons do."""
        if names == self._left_out:
            return
        self._left_out = names
        self._rest.clear()
        for name in names:
            if name == "preferences" and len(names) > 1:
                self._rest.addSeparator()
            self._rest.addAction(self._acts[name] if name in self._acts else self.buttons[name].menu().menuAction())

    def _width_with(self, detail: int, left_out: set[str]) -> int:
        spacing = 4
        gone = left_out if left_out else {"more"}
        widths = [button.width_with(detail) for name, button in self.buttons.items() if name not in gone]
        widths += [13] * len(self._lines) + [self.source_box.width(), 24]
        if detail != ICONS:
            widths.append(QtGui.QFontMetrics(LOOK.font()).horizontalAdvance("Source") + 8)
        return sum(widths) + spacing * (len(widths) + 2)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit()

    def event(self, event: QtCore.QEvent) -> bool:
        done = super().event(event)
        if event.type() == QtCore.QEvent.Type.LayoutRequest:
            self.fit()  # a value or the source has become wider or narrower
        return bool(done)

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, self.height())

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, round(HEIGHT * max(1, LOOK.scale)))

    def _line(self) -> None:
        self._lines.append(self.addSeparator())

    def _menu(self, name: str, icon: str, words: str, menu: QtWidgets.QMenu, tip: str) -> None:
        button = ToolButton(icon, words)
        button.setMenu(menu)
        button.setToolTip(tip)
        button.setAccessibleName(words or tip.partition(":")[0])
        self._put(name, button)

    def _button(self, name: str, icon: str, words: str, action: QtWidgets.QAction, is_meant: bool = False) -> None:
        """One that does what an action does."""
        button = ToolButton(icon, words, is_meant)
        button.setCheckable(action.isCheckable())
        button.setToolTip(action.toolTip())
        button.setAccessibleName(words or action.text().replace("&", ""))

        self._put(name, button)
        self._acts[name] = action

        def follow() -> None:
            self._shown_as[name].setEnabled(action.isEnabled())
            button.setChecked(action.isChecked())

        action.changed.connect(follow)
        button.clicked.connect(lambda *_: action.trigger())
        follow()

    def _put(self, name: str, button: ToolButton) -> None:
        self.buttons[name] = button
        button.setObjectName(name)
        self._shown_as[name] = self.addWidget(button)
