"""All that can be done by a menu, a key or a button, in one table.  `window` is the main window throughout."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from ..document.edits import PANEL_EDITS
from ..document.tools import Tool, docked_tools

VIEWS = ("front", "back", "left", "right", "top", "bottom", "source")
VIEW_TEXTS = {"right": "Ri&ght", "bottom": "Botto&m", "source": "From the &source"}
"""Where not the first letter is the key in a menu."""

NO_SECOND = "open a mesh beside first"

ISOLINES = (0, 10, 20, 30, 50)


@dataclass(frozen=True)
class Act:
    """word: its name here; do: what it does with the window.

    keys: the first is the one that is shown.  of_view: they work where a panel has the keys, and not in a box.
    needs_mesh: it makes no sense without one.  is_on: a check is ticked at first.  lack: why it cannot be done where it
    is disabled although there is a mesh.
    """

    word: str
    text: str
    do: Callable[[Any], object]
    keys: tuple[str, ...] = ()
    tip: str = ""
    icon: str = ""
    of_view: bool = False
    needs_mesh: bool = False
    is_check: bool = False
    is_on: bool = False
    lack: str = ""


def _turn(right: int, up: int) -> Callable[[Any], object]:
    return lambda window: window.with_view(lambda view: view.turn_by(right, up))


def _shift(right: int, up: int) -> Callable[[Any], object]:
    return lambda window: window.with_view(lambda view: view.shift_by(right, up))


def _zoom(factor: float) -> Callable[[Any], object]:
    return lambda window: window.with_view(lambda view: view.zoom(factor))


def _step(right: int, up: int) -> Callable[[Any], object]:
    return lambda window: window.gestures.step_source(right, up)


def _of_view(word: str, text: str, do: Callable[[Any], object], *keys: str) -> Act:
    return Act(word, text, do, keys, of_view=True, needs_mesh=True)


def _dock(tool: Tool) -> Act:
    """Opens and closes the dock of a tool."""
    act = Act(f"dock {tool.word}", tool.text, lambda w: w.docks.toggle(tool.word), (tool.key,), tool.tip, tool.icon)
    return replace(act, needs_mesh=True, is_check=True)


FILE = (
    Act("open", "&Open…", lambda w: w.files.choose(), ("Ctrl+O",), "Open a mesh, a session or a recipe", "open"),
    Act(
        "open beside",
        "Open beside…",
        lambda w: w.files.choose_beside(),
        ("Ctrl+Shift+O",),
        "A second mesh, with panels and a camera of its own",
        needs_mesh=True,
    ),
    Act(
        "close beside",
        "Close the mesh beside",
        lambda w: w.session.close_beside(),
        tip="The first mesh alone, without the panels of the second",
        needs_mesh=True,
        lack=NO_SECOND,
    ),
    Act("save", "&Save session", lambda w: w.session_file.save_or_say(), ("Ctrl+S",), "", "save", needs_mesh=True),
    Act("save as", "Save session &as…", lambda w: w.session_file.choose_and_save(), ("Ctrl+Shift+S",), needs_mesh=True),
    Act(
        "figure",
        "&Export figure…",
        lambda w: w.files.export_figure(),
        ("Ctrl+E",),
        "A figure of what is shown, for a paper or a slide",
        "export-figure",
        needs_mesh=True,
    ),
    Act("movie", "Export &movie…", lambda w: w.files.export_movie(), ("Ctrl+M",), needs_mesh=True),
    Act(
        "screenshot", "S&creenshot of the window…", lambda w: w.files.choose_screenshot(), ("Ctrl+P",), needs_mesh=True
    ),
    Act(
        "save fields",
        "Save all &fields…",
        lambda w: w.field_files.save_all(),
        tip="The values of all panels at the vertices, in one file",
        needs_mesh=True,
    ),
    Act("quit", "&Quit", lambda w: w.close(), ("Ctrl+Q",)),
)
EDIT = (
    Act(
        "undo", "&Undo", lambda w: w.session.undo(), ("Ctrl+Z",), "Undo the last change", "undo", lack="nothing to undo"
    ),
    Act(
        "redo",
        "&Redo",
        lambda w: w.session.redo(),
        ("Ctrl+Shift+Z", "Ctrl+Y"),
        "Do it again",
        "redo",
        lack="nothing to redo",
    ),
    Act(
        "copy camera",
        "Copy ca&mera",
        lambda w: w.views.copy(),
        ("Ctrl+Alt+C",),
        "As text, for another window or bihdist figure --camera",
        needs_mesh=True,
    ),
    Act(
        "paste camera",
        "P&aste camera",
        lambda w: w.views.paste(),
        ("Ctrl+Alt+V",),
        "Look from where a copied camera looked",
        needs_mesh=True,
    ),
    Act(
        "copy picture",
        "&Copy picture",
        lambda w: w.files.copy("picture"),
        ("Ctrl+Shift+C",),
        "The figure as an image, to be pasted elsewhere",
        "copy",
        needs_mesh=True,
    ),
    Act(
        "copy command",
        "Copy as command &line",
        lambda w: w.files.copy("command"),
        tip="One line for a shell that makes the figure of what is shown",
        needs_mesh=True,
    ),
    Act(
        "copy python",
        "Copy as P&ython",
        lambda w: w.files.copy("python"),
        tip="One line of Python that makes the figure of what is shown",
        needs_mesh=True,
    ),
    Act("preferences", "&Preferences…", lambda w: w.choices.ask_preferences(), ("Ctrl+,",), "", "settings"),
)
VIEW = (
    Act("reset", "Hom&e", lambda w: w.reset_view(), ("R", "Home"), "See all of it", "reset-view", needs_mesh=True),
    *(
        Act(
            f"view {name}",
            VIEW_TEXTS.get(name, f"&{name.capitalize()}"),
            lambda w, name=name: w.reset_view(name),
            (str(number),),
            needs_mesh=True,
        )
        for number, name in enumerate(VIEWS, 1)
    ),
    Act(
        "centre",
        "&Centre the view here",
        lambda w: w.gestures.centre_here(),
        ("C",),
        "What is under the pointer comes into the middle, and is turned about",
        needs_mesh=True,
    ),
    Act(
        "zoom to",
        "&Zoom to it",
        lambda w: w.gestures.zoom_here(),
        ("Z",),
        "What is pointed at, larger",
        needs_mesh=True,
    ),
    Act(
        "link",
        "Link the two cameras",
        lambda w: w.views.link(),
        ("K",),
        "Turning one of two meshes turns the other",
        needs_mesh=True,
        is_check=True,
        is_on=True,
        lack=NO_SECOND,
    ),
    Act("next up", "The &next axis up", lambda w: w.views.next_up(), ("U",), needs_mesh=True),
    Act("other end up", "Upside &down", lambda w: w.views.other_end_up(), ("Shift+U",), needs_mesh=True),
    Act(
        "orthographic",
        "&Orthographic",
        lambda w: w.views.project(),
        ("O",),
        "What is farther away is drawn as large",
        needs_mesh=True,
        is_check=True,
    ),
    Act(
        "axes",
        "A&xes",
        lambda w: w.views.show_axes(),
        ("X",),
        "Where x, y and z point to, in a corner",
        needs_mesh=True,
        is_check=True,
    ),
    Act(
        "turntable",
        "Turn as on a tur&ntable",
        lambda w: w.views.turn_upright(),
        tip="What is up stays upright while the surface turns",
        is_check=True,
    ),
    Act("view before", "The &view before", lambda w: w.views.back(), ("Ctrl+[",), needs_mesh=True),
    Act("view after", "The view &after", lambda w: w.views.on(), ("Ctrl+]",), needs_mesh=True),
    Act(
        "wireframe",
        "&Wireframe",
        lambda w: w.choices.wireframe(w.actions_by_word["wireframe"].isChecked()),
        ("W",),
        "The edges of the mesh",
        needs_mesh=True,
        is_check=True,
    ),
    Act("crease", "&Angle of creases…", lambda w: w.choices.ask_crease(), needs_mesh=True),
    Act(
        "full screen",
        "&Full screen for talks",
        lambda w: w.choices.toggle_full_screen(),
        ("F11",),
        "Panels and bars only, in larger text",
        is_check=True,
    ),
)
TURNS = (
    Act("turn left", "Turn to the left", _turn(-1, 0), ("Left",), of_view=True, needs_mesh=True),
    Act("turn right", "Turn to the right", _turn(1, 0), ("Right",), of_view=True, needs_mesh=True),
    Act("turn up", "Turn up", _turn(0, 1), ("Up",), of_view=True, needs_mesh=True),
    Act("turn down", "Turn down", _turn(0, -1), ("Down",), of_view=True, needs_mesh=True),
    Act("move left", "Move to the left", _shift(-1, 0), ("Shift+Left",), of_view=True, needs_mesh=True),
    Act("move right", "Move to the right", _shift(1, 0), ("Shift+Right",), of_view=True, needs_mesh=True),
    Act("move up", "Move up", _shift(0, 1), ("Shift+Up",), of_view=True, needs_mesh=True),
    Act("move down", "Move down", _shift(0, -1), ("Shift+Down",), of_view=True, needs_mesh=True),
    Act("nearer", "Nearer", _zoom(1.2), ("+", "="), of_view=True, needs_mesh=True),
    Act("farther", "Farther", _zoom(1 / 1.2), ("-",), of_view=True, needs_mesh=True),
    _of_view("remove anchor", "Remove the chosen anchor or pair", lambda w: w.gestures.remove_chosen(), "Delete"),
    _of_view(
        "accept pair",
        "Accept the predicted partner",
        lambda w: w.guide.go_on() or w.gestures.pairs.accept(),
        "Return",
        "Enter",
    ),
)
PANELS = (
    Act(
        "add panel",
        "&Add a panel",
        lambda w: w.choices.add_panel(),
        ("Ctrl+T",),
        "One more panel",
        "add-panel",
        needs_mesh=True,
    ),
    *(
        Act(f"panel {word}", word, lambda w, word=word: w.choices.edit_panel(w.grid.active, word), needs_mesh=True)
        for word in PANEL_EDITS
        if word != "Add a panel"
    ),
    Act(
        "save field",
        "Save &field…",
        lambda w: w.field_files.save(w.grid.active),
        tip="The values of the active panel at the vertices",
        needs_mesh=True,
    ),
    Act("next panel", "&Next panel", lambda w: w.grid.focus(1), ("Tab",), of_view=True, needs_mesh=True),
    Act("previous panel", "&Previous panel", lambda w: w.grid.focus(-1), ("Shift+Tab",), of_view=True, needs_mesh=True),
    Act("panels and bars", "Between panels and tool bar", lambda w: w.change_part(), ("F6",)),
)
TOOLS = (
    Act("source id", "&Type a source", lambda w: w.typed_source.ask(), ("G",), "", "source", needs_mesh=True),
    Act(
        "snap",
        "Snap to &vertices",
        lambda w: w.gestures.sources.set_snapping(w.actions_by_word["snap"].isChecked()),
        ("V",),
        "The source is put on vertices, and not anywhere in faces",
        needs_mesh=True,
        is_check=True,
        is_on=True,
    ),
    Act(
        "draw source",
        "&Draw a source",
        lambda w: w.gestures.sources.set_drawing(w.actions_by_word["draw source"].isChecked()),
        ("D",),
        "Drag over the surface: distances from a curve",
        needs_mesh=True,
        is_check=True,
    ),
    Act(
        "save curve",
        "Save the drawn curve…",
        lambda w: w.curve_files.save_source(w.grid.active),
        tip="The curve that distances start from, as curve.json: a source in words and on the command line",
        needs_mesh=True,
    ),
    Act("source before", "The source be&fore", lambda w: w.session.walk_sources(-1), ("Alt+Left",), needs_mesh=True),
    Act("source after", "The source &after", lambda w: w.session.walk_sources(1), ("Alt+Right",), needs_mesh=True),
    Act(
        "live",
        "&Live: the source follows the pointer",
        lambda w: w.gestures.set_live(w.actions_by_word["live"].isChecked()),
        ("L",),
        "The source follows the pointer while the key is held, or until this is switched off",
        "live",
        needs_mesh=True,
        is_check=True,
    ),
    Act("step left", "Step along an edge to the left", _step(-1, 0), ("Ctrl+Left",), of_view=True, needs_mesh=True),
    Act("step right", "Step along an edge to the right", _step(1, 0), ("Ctrl+Right",), of_view=True, needs_mesh=True),
    Act("step up", "Step along an edge up", _step(0, 1), ("Ctrl+Up",), of_view=True, needs_mesh=True),
    Act("step down", "Step along an edge down", _step(0, -1), ("Ctrl+Down",), of_view=True, needs_mesh=True),
    Act("stop", "&Stop what is being computed", lambda w: w.cancel(), ("Esc",)),
)
INSTRUMENTS = tuple(map(_dock, docked_tools().values()))
"""The docks, in the order of the menu."""

HELP = (
    Act("keys", "All &commands and gestures", lambda w: w.guide.show_commands(), ("F1",), "", "info"),
    Act("tour", "A &tour in five steps", lambda w: w.guide.start_tour()),
    Act("about", "&About", lambda w: w.guide.show_about()),
)
ALL = (*FILE, *EDIT, *VIEW, *TURNS, *PANELS, *TOOLS, *INSTRUMENTS, *HELP)
