"""All that can be done by a menu, a key or a button, in one table."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from operator import methodcaller
from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from ..document.panel_edits import ADD, panel_edits
from ..document.tools import Tool, docked_tools
from .actions import Act, acts_of_tools
from .choices import Choices
from .context import Context
from .files.curve_files import CurveFiles
from .files.field_files import FieldFiles
from .files.files import Files
from .files.mesh_repairs import MeshRepairs
from .files.session_actions import SessionFile
from .guide import Guide
from .progress_display import ProgressDisplay
from .snapping import Snapping
from .typed_source import TypedSource
from .views import Views

VIEWS = ("front", "back", "left", "right", "top", "bottom", "source")
VIEW_TEXTS = {"right": "Ri&ght", "bottom": "Botto&m", "source": "From the &source"}
"""Where not the first letter is the key in a menu."""

if TYPE_CHECKING:
    from .docks.docks import Docks
    from .gestures import Gestures

NO_SECOND = "open a mesh beside first"


def _gestures(context: Context) -> "Gestures":
    from .gestures import Gestures  # with the panels: the window is shown before

    return context[Gestures]


def _docks(context: Context) -> "Docks":
    from .docks.docks import Docks  # with the panels: the window is shown before

    return context[Docks]


def stop(context: Context) -> None:
    """Esc: out of the tour, a box, the live source or the full screen; otherwise stop what is being computed."""
    box, session = context[TypedSource].box, context.session
    if context[Guide].end_tour():
        return
    if box.hasFocus():
        box.give_up()
        context.focus_panels()
    elif context.is_built and _gestures(context).put_down():
        return
    elif session.progress or not context[Choices].is_full_screen:
        session.cancel()
        context[ProgressDisplay].show()
        if context.is_built:
            _docks(context).show_stopped()
    else:
        context[Choices].toggle_full_screen()


def _change_part(context: Context) -> None:
    """From the panels to the tool bar, and back."""
    window = context.widget
    bar = window.findChild(QtWidgets.QToolBar, "tools")
    if bar.isAncestorOf(window.focusWidget() or window):
        context.focus_panels()
    else:
        bar.findChild(QtWidgets.QWidget, "open").setFocus(QtCore.Qt.FocusReason.TabFocusReason)


def _on_view(method: str, *numbers: float) -> Callable[[Context], object]:
    """Calls a method of the active panel's view."""
    do = methodcaller(method, *numbers)
    return lambda context: do(context.active.view) if context.active else None


def _see_from(name: str, context: Context) -> None:
    context[Views].reset(name)


def _edit_panel(word: str, context: Context) -> None:
    context[Choices].edit_panel(context.grid.active, word)


def _dock(tool: Tool) -> Act:
    """Opens and closes the dock of a tool."""
    act = Act(f"dock {tool.word}", tool.text, lambda c: _docks(c).toggle(tool.word), (tool.key,), tool.tip, tool.icon)
    return replace(act, is_check=True)


# fmt: off
FILE = (
    Act("open", "&Open…", lambda c: c[Files].choose(), ("Ctrl+O",), "Open a mesh, a session or a recipe", "open",
        needs_mesh=False),
    Act("open beside", "Open beside…", lambda c: c[Files].choose_beside(), ("Ctrl+Shift+O",),
        "A second mesh, with panels and a camera of its own"),
    Act("close beside", "Close the mesh beside", lambda c: c.session.close_beside(),
        tip="The first mesh alone, without the panels of the second", lack=NO_SECOND),
    Act("cut", "Cut out by a mask…", lambda c: c[MeshRepairs].choose_cut(),
        tip="Vertices go with their faces, and nothing crosses what is gone: a mask has 1 for each that stays"),
    Act("merge", "Merge vertices…", lambda c: c[MeshRepairs].ask_merge(),
        tip="Vertices in one place, or within a tolerance, become one, so that distances step between their faces"),
    Act("save ids", "Save table of ids…", lambda c: c[MeshRepairs].save_ids(),
        tip="The new id of each vertex of the file, after vertices have been merged", lack="merge vertices first"),
    Act("put back", "Put back the mesh of the file", lambda c: c[MeshRepairs].put_back(),
        tip="With all that is cut out, and nothing merged", lack="nothing is cut out or merged"),
    Act("save", "&Save session", lambda c: c[SessionFile].save_or_say(), ("Ctrl+S",), icon="save"),
    Act("save as", "Save session &as…", lambda c: c[SessionFile].choose_and_save(), ("Ctrl+Shift+S",)),
    Act("figure", "&Export figure…", lambda c: c[Files].export_figure(), ("Ctrl+E",),
        "A figure of what is shown, for a paper or a slide", "export-figure"),
    Act("movie", "Export &movie…", lambda c: c[Files].export_movie(), ("Ctrl+M",)),
    Act("page", "Export &web page…", lambda c: c[Files].export_page(),
        tip="An HTML file in which distances are computed anew wherever one clicks, without a network"),
    Act("screenshot", "S&creenshot of the window…", lambda c: c[Files].choose_screenshot(), ("Ctrl+P",)),
    Act("save fields", "Save all &fields…", lambda c: c[FieldFiles].save_all(),
        tip="The values of all panels at the vertices, in one file"),
    Act("quit", "&Quit", lambda c: c.widget.close(), ("Ctrl+Q",), needs_mesh=False),
)
EDIT = (
    Act("undo", "&Undo", lambda c: c.session.undo(), ("Ctrl+Z",), "Undo the last change", "undo", needs_mesh=False,
        lack="nothing to undo"),
    Act("redo", "&Redo", lambda c: c.session.redo(), ("Ctrl+Shift+Z", "Ctrl+Y"), "Do it again", "redo",
        needs_mesh=False, lack="nothing to redo"),
    Act("copy camera", "Copy ca&mera", lambda c: c[Views].copy(), ("Ctrl+Alt+C",),
        "As text, for another window or bihdist figure --camera"),
    Act("paste camera", "P&aste camera", lambda c: c[Views].paste(), ("Ctrl+Alt+V",),
        "Look from where a copied camera looked"),
    Act("copy picture", "&Copy picture", lambda c: c[Files].copy("picture"), ("Ctrl+Shift+C",),
        "The figure as an image, to be pasted elsewhere", "copy"),
    Act("copy command", "Copy as command &line", lambda c: c[Files].copy("command"),
        tip="One line for a shell that makes the figure of what is shown"),
    Act("copy python", "Copy as P&ython", lambda c: c[Files].copy("python"),
        tip="One line of Python that makes the figure of what is shown"),
    Act("preferences", "&Preferences…", lambda c: c[Choices].ask_preferences(), ("Ctrl+,",), icon="settings",
        needs_mesh=False),
)
VIEW = (
    Act("reset", "Hom&e", lambda c: c[Views].reset(), ("R", "Home"), "See all of it", "reset-view"),
    *(
        Act(f"view {name}", VIEW_TEXTS.get(name, f"&{name.capitalize()}"), partial(_see_from, name), (str(number),))
        for number, name in enumerate(VIEWS, 1)
    ),
    Act("centre", "&Centre the view here", lambda c: _gestures(c).centre_here(), ("C",),
        "What is under the pointer comes into the middle, and is turned about"),
    Act("zoom to", "&Zoom to it", lambda c: _gestures(c).zoom_here(), ("Z",), "What is pointed at, larger"),
    Act("link", "Link the two cameras", lambda c: c[Views].link(), ("K",), "Turning one of two meshes turns the other",
        is_check=True, is_on=True, lack=NO_SECOND),
    Act("next up", "The &next axis up", lambda c: c[Views].next_up(), ("U",)),
    Act("other end up", "Upside &down", lambda c: c[Views].other_end_up(), ("Shift+U",)),
    Act("orthographic", "&Orthographic", lambda c: c[Views].project(), ("O",),
        "What is farther away is drawn as large", is_check=True),
    Act("axes", "A&xes", lambda c: c[Views].show_axes(), ("X",), "Where x, y and z point to, in a corner",
        is_check=True),
    Act("turntable", "Turn as on a tur&ntable", lambda c: c[Views].turn_upright(),
        tip="What is up stays upright while the surface turns", needs_mesh=False, is_check=True),
    Act("view before", "The &view before", lambda c: c[Views].back(), ("Ctrl+[",)),
    Act("view after", "The view &after", lambda c: c[Views].on(), ("Ctrl+]",)),
    Act("wireframe", "&Wireframe", lambda c: c[Choices].wireframe(c.actions["wireframe"].isChecked()), ("W",),
        "The edges of the mesh", is_check=True),
    Act("crease", "&Angle of creases…", lambda c: c[Choices].ask_crease()),
    Act("full screen", "&Full screen for talks", lambda c: c[Choices].toggle_full_screen(), ("F11",),
        "Panels and bars only, in larger text", needs_mesh=False, is_check=True),
)
TURNS = (
    Act("turn left", "Turn to the left", _on_view("turn_by", -1, 0), ("Left",), of_view=True),
    Act("turn right", "Turn to the right", _on_view("turn_by", 1, 0), ("Right",), of_view=True),
    Act("turn up", "Turn up", _on_view("turn_by", 0, 1), ("Up",), of_view=True),
    Act("turn down", "Turn down", _on_view("turn_by", 0, -1), ("Down",), of_view=True),
    Act("move left", "Move to the left", _on_view("shift_by", -1, 0), ("Shift+Left",), of_view=True),
    Act("move right", "Move to the right", _on_view("shift_by", 1, 0), ("Shift+Right",), of_view=True),
    Act("move up", "Move up", _on_view("shift_by", 0, 1), ("Shift+Up",), of_view=True),
    Act("move down", "Move down", _on_view("shift_by", 0, -1), ("Shift+Down",), of_view=True),
    Act("nearer", "Nearer", _on_view("zoom", 1.2), ("+", "="), of_view=True),
    Act("farther", "Farther", _on_view("zoom", 1 / 1.2), ("-",), of_view=True),
    Act("remove anchor", "Remove the chosen anchor or pair", lambda c: _gestures(c).remove_chosen(), ("Delete",),
        of_view=True),
    Act("accept pair", "Accept the predicted partner", lambda c: None if c[Guide].go_on() else _gestures(c).accept(),
        ("Return", "Enter"), of_view=True),
)
PANELS = (
    Act("add panel", "&Add a panel", lambda c: c[Choices].add_panel(), ("Ctrl+T",), "One more panel", "add-panel"),
    *(Act(f"panel {word}", word, partial(_edit_panel, word)) for word in panel_edits() if word != ADD),
    Act("save field", "Save &field…", lambda c: c[FieldFiles].save(c.grid.active),
        tip="The values of the active panel at the vertices"),
    Act("next panel", "&Next panel", lambda c: c.grid.focus(1), ("Tab",), of_view=True),
    Act("previous panel", "&Previous panel", lambda c: c.grid.focus(-1), ("Shift+Tab",), of_view=True),
    Act("panels and bars", "Between panels and tool bar", _change_part, ("F6",), needs_mesh=False),
)
TOOLS = (
    Act("source id", "&Type a source", lambda c: c[TypedSource].ask(), ("G",), icon="source"),
    Act("snap", "Snap to &vertices", lambda c: c[Snapping].set(c.actions["snap"].isChecked()), ("V",),
        "The source is put on vertices, and not anywhere in faces", is_check=True, is_on=True),
    Act("save curve", "Save the drawn curve…", lambda c: c[CurveFiles].save_source(c.grid.active),
        tip="The curve that distances start from, as curve.json: a source in words and on the command line"),
    Act("source before", "The source be&fore", lambda c: c.session.walk_sources(-1), ("Alt+Left",)),
    Act("source after", "The source &after", lambda c: c.session.walk_sources(1), ("Alt+Right",)),
    Act("live", "&Live: the source follows the pointer", lambda c: _gestures(c).set_live(c.actions["live"].isChecked()),
        ("L",), "The source follows the pointer while the key is held, or until this is switched off", "live",
        is_check=True),
    Act("stop", "&Stop what is being computed", stop, ("Esc",), needs_mesh=False),
)
HELP = (
    Act("keys", "All &commands and gestures", lambda c: c[Guide].show_commands(), ("F1",), icon="info",
        needs_mesh=False),
    Act("guide", "&Guide", lambda c: c[Guide].open_guide(), tip="How-to pages, examples and reference, in the browser",
        needs_mesh=False),
    Act("tour", "A &tour in five steps", lambda c: c[Guide].start_tour(), needs_mesh=False),
    Act("about", "&About", lambda c: c[Guide].show_about(), needs_mesh=False),
)
# fmt: on
INSTRUMENTS = tuple(map(_dock, docked_tools().values()))
"""The docks, in the order of the menu."""

ALL = (*FILE, *EDIT, *VIEW, *TURNS, *PANELS, *TOOLS, *acts_of_tools(), *INSTRUMENTS, *HELP)
