"""The tool bar: what one needs all the time, with the value that is chosen.

Where it is narrow words go first, and then what has no room at all goes into the menu of a button, ⋯.
"""

from collections.abc import Collection, Mapping

from qtpy import QtCore, QtGui, QtWidgets

from ..context import Context
from ..look.look import LOOK
from ..typed_source import SourceBox, TypedSource
from .menus import Menus
from .tool_button import FULL, ICONS, VALUES, ToolButton

HEIGHT = 44

WITHOUT_MESH = ("open", "preferences")
"""The buttons that are there before a mesh is."""

FIRST_TO_GO = ("preferences", "views", "range", "colours", "isolines", "redo", "tools", "undo", "add panel")
"""Where even the icons have no room: which buttons go into the menu of ⋯, the first of these first."""

STEPS = (
    *(("tools", FULL), ("export", FULL), ("range", FULL), ("views", FULL), ("isolines", VALUES), ("colours", VALUES)),
    *(("open", FULL), ("add panel", FULL), ("isolines", FULL), ("colours", FULL)),
)
"""How much buttons write, from icons alone on: each step is taken where there is room, and no step after it before."""


class ToolBar(QtWidgets.QToolBar):
    """The toolbar of a window; `buttons` holds its buttons by name."""

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
        self._has_mesh = False
        self._menu("open", "open", "Open", menus.open, "Open (Ctrl+O): a mesh, a recent file or a sample")
        self._line()
        self._button("undo", "undo", "", context.actions["undo"])
        self._button("redo", "redo", "", context.actions["redo"])
        self._line()
        self.source = SourceControl(context, menus.source)
        self._source_action = self.addWidget(self.source)
        self._menu(
            "tools", "profile", "Tools", menus.tools, "Tools: pins, profile, scatter and others, with their keys"
        )
        gap = QtWidgets.QWidget()
        gap.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Preferred)
        self.addWidget(gap)
        self._menu("isolines", "isolines", "Isolines", menus.isolines, "Isolines: how many there are, and where")
        self._menu("colours", "colours", "Colours", menus.colours, "Colours: of the fields")
        self._menu("range", "range", "Range", menus.range, "Range: where the colours end")
        tip = "View: standard views (1 to 7, R), previous and next view, up axis"
        self._menu("views", "views", "View", menus.views, tip)
        self._line()
        self._button("add panel", "add-panel", "Panel", context.actions["add panel"])
        self._button("export", "export-figure", "Export", context.actions["figure"], is_meant=True)
        self._button("preferences", "settings", "", context.actions["preferences"])
        self._rest = QtWidgets.QMenu(self)
        self._menu("more", "more", "", self._rest, "More: controls that do not fit")
        LOOK.changed.connect(self.fit)
        self.fit()

    def allow(self, has_mesh: bool) -> None:
        """Show the buttons that need a mesh, or hide them."""
        self._has_mesh = has_mesh
        self.fit()

    @property
    def source_box(self) -> SourceBox:
        """The box where the source is typed."""
        return self.source.box

    @property
    def _there(self) -> list[str]:
        """The names of the buttons that make sense now, but for ⋯."""
        return [name for name in self.buttons if name != "more" and (self._has_mesh or name in WITHOUT_MESH)]

    @property
    def left_out(self) -> tuple[str, ...]:
        """The names of buttons that are in the menu of ⋯, as they stand in the bar."""
        return self._left_out

    def fit(self) -> None:
        """Write as much as there is room for."""
        room = self.width()
        self.setFixedHeight(round(HEIGHT * max(1, LOOK.scale)))
        details, left_out = dict.fromkeys(self.buttons, ICONS), set[str]()
        for name in FIRST_TO_GO if self._has_mesh else ():
            if self.width_with(details, left_out) <= room:
                break
            left_out.add(name)
        for name, detail in STEPS:
            more = {**details, name: detail}
            if self.width_with(more, left_out) > room:
                break
            details = more
        for name, button in self.buttons.items():
            button.show_detail(details[name])
            is_there = bool(left_out) if name == "more" else name in self._there
            self._shown_as[name].setVisible(is_there and name not in left_out)
        for action in (self._source_action, *self._lines):
            action.setVisible(self._has_mesh)
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

    def width_with(self, details: Mapping[str, int], left_out: Collection[str] = ()) -> int:
        """Return the width of all buttons with so much written on each; those left out are in the menu of ⋯."""
        spacing = 4
        names = [name for name in self._there if name not in left_out] + ["more"] * bool(left_out)
        widths = [self.buttons[name].width_with(details[name]) for name in names]
        if self._has_mesh:
            widths += [13] * len(self._lines) + [self.source.width(), 24]
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
        button.setAccessibleName(words or action.text().replace("&", ""))
        self._put(name, button)
        self._acts[name] = action
        _follow(button, action, self._shown_as[name])

    def _put(self, name: str, button: ToolButton) -> None:
        self.buttons[name] = button
        button.setObjectName(name)
        self._shown_as[name] = self.addWidget(button)


class SourceControl(QtWidgets.QWidget):
    """The source as one control: the menu of what can be done with it, the box where it is typed, and *Live*.

    The frame is the box's; the buttons lie on it.
    """

    WIDTH, HEIGHT, MENU, LIVE = 172, 28, 46, 34
    """Logical pixels: always the same, whatever the source is; of the buttons on it."""

    def __init__(self, context: Context, menu: QtWidgets.QMenu) -> None:
        super().__init__()
        self.box = context[TypedSource].box
        self.box.setParent(self)
        self.menu_button, self.live = ToolButton("source"), ToolButton("live")
        self.menu_button.setMenu(menu)
        self.menu_button.setAccessibleName("Source")
        self._draw = context.actions["draw source"]
        self._draw.changed.connect(self._show_mode)
        for button in (self.menu_button, self.live):
            button.setParent(self)
        self.live.setAccessibleName("Live")
        _follow(self.live, context.actions["live"])
        self._lay_out()
        LOOK.follow(self, self._lay_out)
        self._show_mode()

    def _show_mode(self) -> None:
        """Light the button while drags draw a source."""
        is_drawing = self._draw.isChecked()
        self.menu_button.show_icon("draw" if is_drawing else "source")
        self.menu_button.setCheckable(is_drawing)
        self.menu_button.setChecked(is_drawing)
        drawing = "Drawing a source (D): drag over the surface; Esc ends"
        self.menu_button.setToolTip(drawing if is_drawing else "Source: type, draw, step back, live")

    def sizeHint(self) -> QtCore.QSize:
        return self.minimumSize()

    def _lay_out(self) -> None:
        scale = LOOK.scale
        width, height = round(self.WIDTH * scale), round(self.HEIGHT * scale)
        self.setFixedSize(width, height)
        self.box.setMinimumHeight(0)  # that of larger text stays until the style sheet is replaced
        self.box.setGeometry(0, 0, width, height)
        self.box.setTextMargins(self.MENU - 6, 0, self.LIVE - 4, 0)
        self.menu_button.setGeometry(1, 1, self.MENU, height - 2)
        self.live.setGeometry(width - self.LIVE - 1, 1, self.LIVE, height - 2)
        for button in (self.menu_button, self.live):
            button.raise_()


def _follow(button: ToolButton, action: QtWidgets.QAction, place: QtWidgets.QAction | None = None) -> None:
    """Let a button trigger an action, with its state and tool tip; `place` is the button's action in a toolbar."""
    button.setCheckable(action.isCheckable())

    def follow() -> None:
        # The action a button is put in by enables it whenever it is shown or hidden.
        (place or button).setEnabled(action.isEnabled())
        button.setChecked(action.isChecked())
        lack = "" if action.isEnabled() else action.property("lack")
        button.setToolTip(f"{action.toolTip()}\nNot now: {lack}" if lack else action.toolTip())

    action.changed.connect(follow)
    button.clicked.connect(lambda *_: action.trigger())
    follow()
