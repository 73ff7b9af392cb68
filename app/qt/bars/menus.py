"""The window's menus, made of its actions."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

from qtpy import QtGui, QtWidgets

from bihdist_core.analysis.upright import DIRECTIONS

from ...document.camera import ANATOMICAL
from ...document.panel_edits import ADD, panel_edits
from ...document.repairs import OPERATORS
from ...document.settings import RANGE, SHADING, THEME, Setting, switches_in
from ...document.tools import docked_tools
from ...drawing.numbers import MINUS
from ...samples import mesh_path, sample_names, sample_title, thumbnail
from .. import remembered
from ..actions import actions_of_tools
from ..choices import Choices
from ..context import Context
from ..files.files import Files
from ..files.mesh_repairs import MeshRepairs
from ..views import Views
from .colour_menu import ColourMenu, IsolineMenu

THUMBNAIL = 56

VIEWS = ("front", "back", "left", "right", "top", "bottom", "source")
TURNS = (
    *(f"{way} {side}" for way in ("turn", "move") for side in ("left", "right", "up", "down")),
    *("nearer", "farther", "remove anchor", "accept pair"),
)
"""Actions that turn and move the camera, by their words."""


class LargeIcons(QtWidgets.QProxyStyle):
    """A style for menus whose icons are pictures."""

    def pixelMetric(self, metric: Any, option: Any = None, widget: Any = None) -> int:
        if metric == QtWidgets.QStyle.PixelMetric.PM_SmallIconSize:
            return THUMBNAIL
        return int(super().pixelMetric(metric, option, widget))


class NoUnderlines(QtWidgets.QProxyStyle):
    """A style for menu bars without underlined letters."""

    def styleHint(self, hint: Any, option: Any = None, widget: Any = None, returned: Any = None) -> int:
        if hint == QtWidgets.QStyle.StyleHint.SH_UnderlineShortcut:
            return 0
        return int(super().styleHint(hint, option, widget, returned))


def docks(menu: str) -> list[str]:
    """The words of the actions that open the docks which a menu lists."""
    return [f"dock {tool.word}" for tool in docked_tools().values() if tool.menu == menu]


class Menus:
    """The menus of a window; some have names, as the toolbar shows them, too."""

    def __init__(self, context: Context) -> None:
        self._context = context
        bar = context.widget.menuBar()
        no_underlines = NoUnderlines()
        # Gone before the bar it would take the process with it.
        no_underlines.setParent(bar)
        bar.setStyle(no_underlines)
        self.open = QtWidgets.QMenu("&Open", context.widget)
        self.samples = self._samples()
        self.recent = QtWidgets.QMenu("&Recent", context.widget)
        self.recent.aboutToShow.connect(self._fill_recent)
        self.isolines = IsolineMenu(context)
        self.colours = ColourMenu(context)
        self.range = self._choices_of(RANGE)
        self.range.addSeparator()
        typed = self.range.addAction("End of this colour bar…")
        typed.setData("typed")
        typed.setCheckable(True)  # while one does
        typed.triggered.connect(context[Choices].ask_end)
        self.range.addAction("From a session or recipe…", context[Choices].ask_ends)
        self.shading = self._choices_of(SHADING)
        self._fill(self.shading, [None, "feature angle", None, *switches_in("shading")])
        self.theme = self._choices_of(THEME)
        titles = ("&Views", "&Source", "&Tools", "Turn and move by &keys", "&Standard views", "Repair mesh")
        self.views, self.source, self.tools, keys, standard, self.repairs = (
            QtWidgets.QMenu(title, context.widget) for title in titles
        )
        brain, scale = (QtWidgets.QMenu(title, context.widget) for title in ("Brain (RAS)", "Axes and scale"))
        self._fill(scale, [*switches_in("scale"), "unit"])
        named, at_pointer = [f"view {name}" for name in VIEWS], ["centre", "zoom to"]
        cameras, walked = [*switches_in("camera"), scale, "link"], ["view before", "view after"]
        self._fill(keys, TURNS)
        self._fill(brain, [f"view {name}" for name in ANATOMICAL[:6]])
        self._fill(standard, [*named, brain, None, *walked])
        self._fill(self.open, ["open", "open beside", None, self.recent, self.samples])
        self.up = self._choices(
            "&Up", lambda word: context[Views].set_up_axis(word), [(up, up.replace("-", MINUS)) for up in DIRECTIONS]
        )
        self._fill(self.up, [None, "next up", "other end up"])
        self._fill(self.views, ["reset", *named, brain, None, self.up, *cameras, None, *at_pointer, None, *walked])
        self._fill(self.source, ["source id", "save curve", "snap", "live", None, "source before", "source after"])
        self._fill(self.source, [None, *(act.word for act in actions_of_tools())])
        self._fill(self.tools, docks("Tools"))
        self.tools.setToolTipsVisible(True)
        file, edit, view, panels, tools, about = (
            bar.addMenu(name) for name in ("&File", "&Edit", "&View", "&Panels", "&Tools", "&Help")
        )
        self._of_meshes = (panels, tools)
        self._fill(file, ["open", self.recent, self.samples, "close mesh", None])
        self._fill(file, ["open beside", "close beside", None, "add field", None])
        self.operators = self._choices(
            "Operator", lambda word: context[MeshRepairs].choose_operator(word), OPERATORS.items()
        )
        self._fill(self.repairs, ["cut", "merge", "largest", None, self.operators, None, "save ids", None, "put back"])
        self._fill(file, [self.repairs, None])
        self._fill(file, ["save", "save as", None])
        self._fill(file, ["save fields", "figure", "movie", "page", "screenshot", None, "quit"])
        self._fill(edit, ["undo", "redo", None, "copy picture", "copy command", "copy python", None])
        self._fill(edit, ["copy camera", "paste camera", None, "clear by-products", "clear surface", None])
        self._fill(edit, ["preferences"])
        # What the tool bar's menu shows one below the other has submenus here, so that all is seen on small screens.
        self._fill(view, ["reset", standard, self.up, keys, None, *cameras, None, *at_pointer, None])
        self._fill(view, [*docks("View"), None])
        self._fill(view, [self.isolines, self.colours, self.range, self.shading, None, self.theme, "full screen"])
        edits = (f"panel {word}" for word in panel_edits() if word != ADD)
        self._fill(panels, ["add panel", None, *edits, None, "save field", None])
        self._fill(panels, ["next panel", "previous panel", "panels and bars"])
        self._fill(tools, [*docks("Tools"), None, *self.source.actions(), None, "stop"])
        self._fill(about, ["keys", "guide", None, "about"])

    def allow(self, has_mesh: bool) -> None:
        """Enable the menus that need a mesh; without one, those of panels and tools are hidden."""
        for menu in self._of_meshes:
            menu.menuAction().setVisible(has_mesh)
        for menu in (self.isolines, self.colours, self.range, self.shading, self.up, self.repairs):
            menu.menuAction().setEnabled(has_mesh)

    def _fill(self, menu: QtWidgets.QMenu, entries: Sequence[object]) -> None:
        """Fill a menu: with actions by their words, None for a line, and menus and actions as they are."""
        for entry in entries:
            if entry is None:
                menu.addSeparator()
            elif isinstance(entry, QtWidgets.QMenu):
                menu.addMenu(entry)
            else:
                menu.addAction(self._context.actions[entry] if isinstance(entry, str) else entry)

    def show_choice(self, menu: QtWidgets.QMenu, word: object) -> None:
        """Tick one of a menu's choices."""
        for action in menu.actions():
            action.setChecked(action.data() == word)

    def _choices_of(self, setting: Setting) -> QtWidgets.QMenu:
        return self._choices(setting.label, partial(self._context[Choices].set, setting), setting.choices.items())

    def _choices(
        self, title: str, choose: Callable[[str], object], words: Iterable[tuple[str, str]]
    ) -> QtWidgets.QMenu:
        menu = QtWidgets.QMenu(title, self._context.widget)
        group = QtWidgets.QActionGroup(menu)
        for word, text in words:
            action = menu.addAction(text)
            action.setData(word)
            action.setCheckable(True)
            group.addAction(action)
            action.triggered.connect(lambda *_, word=word: choose(word))
        return menu

    def _samples(self) -> QtWidgets.QMenu:
        menu = QtWidgets.QMenu("Sam&ples", self._context.widget)
        large_icons = LargeIcons()
        large_icons.setParent(menu)
        menu.setStyle(large_icons)
        for name in sample_names():
            action = menu.addAction(QtGui.QIcon(str(thumbnail(name))), sample_title(name))
            action.triggered.connect(lambda *_, name=name: self._context.open(mesh_path(name)))
        return menu

    def _fill_recent(self) -> None:
        self.recent.clear()
        for path in remembered.recent():
            action = self.recent.addAction(path if len(path) <= 70 else f"… {path[-68:]}")
            action.setToolTip(path)
            action.setProperty("path", path)
            action.triggered.connect(lambda *_, path=path: self._context[Files].open(path))
        if self.recent.isEmpty():
            self.recent.addAction("Nothing yet").setEnabled(False)
