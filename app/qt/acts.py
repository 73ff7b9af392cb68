"""All that can be done by a menu, a key or a button, in one table."""

from collections.abc import Callable, Sequence
from functools import partial
from operator import methodcaller
from types import ModuleType
from typing import TYPE_CHECKING

from qtpy import QtCore, QtWidgets

from ..document.camera import ANATOMICAL, SAME_VIEWS
from ..document.document import Document
from ..document.on_surface import SOURCE, SurfaceItem, by_products, clear_surface, remove_items, surface_items
from ..document.panel_edits import ADD, panel_edits
from ..document.settings import BANDS, EQUAL_STEPS, FLIP_SCALARS, ISOLINE_LABELS, SHOW_EDGES, SWITCHES, Setting
from ..document.tools import Tool, docked_tools
from ..scene.style import style_of
from .actions import Action, actions_of_tools
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
"""Menu texts of views whose access key is not the first letter."""

BRAIN_VIEWS = ANATOMICAL[:6]
BRAIN_SYNONYMS = {new: old for old, new in SAME_VIEWS.items()}

if TYPE_CHECKING:
    from .docks.docks import Docks
    from .gestures import Gestures

NO_SECOND = "open a second mesh first"


def _gestures(context: Context) -> "Gestures":
    from .gestures import Gestures  # with the panels: the window is shown before

    return context[Gestures]


def _docks(context: Context) -> "Docks":
    from .docks.docks import Docks  # with the panels: the window is shown before

    return context[Docks]


def _figure_actions() -> ModuleType:
    from .files import figure_actions  # with the figures, which take long to import

    return figure_actions


def stop(context: Context) -> None:
    """Esc: leave a box, the live source or the full screen; or stop what is being computed; or clear.

    What is cleared are selections and borders whose tool is closed.
    """
    box, session = context[TypedSource].box, context.session
    if box.hasFocus():
        box.give_up()
        context.focus_panels()
    elif context.is_built and _gestures(context).cancel():
        return
    elif session.progress or not context[Choices].is_full_screen:
        if not session.progress:
            clear_by_products(context, of_closed=True)
        session.cancel()
        context[ProgressDisplay].show()
        if context.is_built:
            _docks(context).show_stopped()
    else:
        context[Choices].toggle_full_screen()


def clear_by_products(context: Context, of_closed: bool = False) -> None:
    """Remove selections and borders, and say so; with `of_closed` only those whose tool is closed."""
    items = by_products(context.document, of_closed)
    if items:
        context.session.show(remove_items(context.document, items))
        context.tell(f"Cleared: {', '.join(item.name.lower() for item in items)}. Ctrl+Z brings them back.")


def _change_part(context: Context) -> None:
    """Switch the focus from the panels to the tool bar, and back."""
    window = context.widget
    bar = window.findChild(QtWidgets.QToolBar, "tools")
    if bar.isAncestorOf(window.focusWidget() or window):
        context.focus_panels()
    else:
        bar.findChild(QtWidgets.QWidget, "open").setFocus(QtCore.Qt.FocusReason.TabFocusReason)


def _on_view(method: str, *numbers: float) -> Callable[[Context], object]:
    """Return a function that calls a method of the active panel's view."""
    do = methodcaller(method, *numbers)
    return lambda context: do(context.active.view) if context.active else None


def _see_from(name: str, context: Context) -> None:
    with context.errors_shown():  # a side of which hemisphere?
        context[Views].reset(name)


def _edit_panel(word: str, context: Context) -> None:
    context[Choices].edit_panel(context.grid.active, word)


NO_FACES = "points have no faces"


def _dock(tool: Tool) -> Action:
    """Return the action that opens and closes the dock of a tool."""
    return Action(
        f"dock {tool.word}",
        tool.text,
        lambda c: _docks(c).toggle(tool.word),
        (tool.key,),
        tool.tip,
        tool.icon,
        is_check=True,
        can_run=_has_faces if tool.needs_faces else None,
        lack=NO_FACES if tool.needs_faces else "",
        synonyms=tool.synonyms,
    )


def _switch(setting: Setting) -> Action:
    """Return the action that switches a setting."""
    return Action(
        setting.word,
        setting.label,
        lambda c: c[Choices].toggle(setting),
        setting.keys,
        setting.tip,
        needs_mesh=not setting.is_preference,
        is_on=setting.is_on,
        can_run=CAN_SWITCH.get(setting.word),
        lack=NO_FACES if CAN_SWITCH.get(setting.word) is _has_faces else "",
        synonyms=setting.synonyms,
    )


def _has_faces(context: Context) -> bool:
    return context.has_faces


def _has_two(context: Context) -> bool:
    return len(context.document.surfaces) > 1


def _is_repaired(context: Context) -> bool:
    return any(mesh.repairs.is_any for mesh in context.document.surfaces)


def _has_components(context: Context) -> bool:
    found = (context.session.loaded(mesh.name) for mesh in context.document.surfaces)
    return any(loaded is not None and loaded.surface.n_components > 1 for loaded in found)


def _is_merged(context: Context) -> bool:
    return any(mesh.repairs.merge is not None for mesh in context.document.surfaces)


def _has_removable(items: Callable[[Document], Sequence[SurfaceItem]]) -> Callable[[Context], bool]:
    return lambda context: any(item.remove is not None and item.word != SOURCE for item in items(context.document))


def _has_colours(context: Context) -> bool:
    return style_of(context.page.style).coloured


def _has_steps(context: Context) -> bool:
    isolines = context.document.isolines
    return bool(context.document.surfaces) and isolines.spacing is None and not isolines.values


CAN_SWITCH = {
    **{BANDS.word: _has_colours, FLIP_SCALARS.word: _has_colours, EQUAL_STEPS.word: _has_steps},
    **{SHOW_EDGES.word: _has_faces, ISOLINE_LABELS.word: _has_faces},
}
"""When a setting can be switched that cannot always be."""

# fmt: off
FILE = (
    Action("open", "&Open…", lambda c: c[Files].choose(), ("Ctrl+O",), "Open a mesh, a session or a recipe", "open",
        needs_mesh=False, synonyms="load import read file"),
    Action("open beside", "Open second mesh…", lambda c: c[Files].choose_second_mesh(), ("Ctrl+Shift+O",),
        "Show another mesh, with panels and a camera of its own", synonyms="load second two compare correspondence"),
    Action("add field", "Add field…", lambda c: c[FieldFiles].choose(),
        tip="Show values at vertices, or labels, that another program has written",
        synonyms="load import scalars values thickness curvature labels annot parcels overlay data npy csv mat gii"),
    Action("close mesh", "Close mesh", lambda c: c.session.close_meshes(), ("Ctrl+W",),
        "Return to the start page; undo opens it again", synonyms="start page new empty"),
    Action("close beside", "Close second mesh", lambda c: c.session.close_second_mesh(),
        tip="Keep the first mesh alone", can_run=_has_two, lack=NO_SECOND, synonyms="remove second"),
    Action("cut", "Cut out by mask…", lambda c: c[MeshRepairs].choose_cut(),
        tip="Remove vertices with their faces; a mask has 1 for each vertex to keep",
        synonyms="mask medial wall remove vertices hole cortex"),
    Action("merge", "Merge vertices…", lambda c: c[MeshRepairs].ask_merge(),
        tip="Merge vertices in one place or within a tolerance, so that distances cross between their faces",
        synonyms="weld join coincident duplicate double vertices seams soup tolerance"),
    Action("largest", "Keep largest component", lambda c: c[MeshRepairs].keep_largest_component(),
        tip="Remove the faces of all other components", can_run=_has_components, lack="the mesh has one component",
        synonyms="part piece island floating disconnected remove small clean"),
    Action("save ids", "Save vertex id table…", lambda c: c[MeshRepairs].save_ids(),
        tip="Save the new id of each vertex of the file", can_run=_is_merged,
        lack="merge vertices first", synonyms="export write merged numbers map"),
    Action("put back", "Restore original mesh", lambda c: c[MeshRepairs].put_back(),
        tip="Undo cutting out, merging, keeping one component and choosing an operator", can_run=_is_repaired,
        lack="the mesh is as in its file",
        synonyms="mask whole again fill unmerge original"),
    Action("save", "&Save session", lambda c: c[SessionFile].save_or_say(), ("Ctrl+S",), icon="save",
        synonyms="store keep project"),
    Action("save as", "Save session &as…", lambda c: c[SessionFile].choose_and_save(), ("Ctrl+Shift+S",),
        synonyms="store keep project"),
    Action("figure", "&Export figure…", lambda c: _figure_actions().export_figure(c), ("Ctrl+E",),
        "Save what is shown for a paper or a slide", "export-figure",
        synonyms="save picture image pdf svg png print paper latex resolution dpi font text size transparent "
            "background"),
    Action("movie", "Export &movie…", lambda c: _figure_actions().export_movie(c), ("Ctrl+M",),
        synonyms="save video animation animate gif mp4"),
    Action("page", "Export &web page…", lambda c: _figure_actions().export_page(c),
        tip="Save an HTML file that computes distances from wherever one clicks, offline",
        synonyms="save html browser internet interactive share"),
    Action("screenshot", "S&creenshot of window…", lambda c: c[Files].choose_screenshot(), ("Ctrl+P",),
        synonyms="save picture image grab png"),
    Action("save fields", "Save all &fields…", lambda c: c[FieldFiles].save_all(),
        tip="Save the vertex values of all panels in one file",
        synonyms="export write values distances data npy csv ply vtp obj glb blender colours colors"),
    Action("quit", "&Quit", lambda c: c.widget.close(), ("Ctrl+Q",), needs_mesh=False, synonyms="exit close end"),
)
EDIT = (
    Action("undo", "&Undo", lambda c: c.session.undo(), ("Ctrl+Z",), "Undo the last change", "undo", needs_mesh=False,
        lack="nothing to undo", synonyms="back revert"),
    Action("redo", "&Redo", lambda c: c.session.redo(), ("Ctrl+Shift+Z", "Ctrl+Y"), "Redo the last undone change",
        "redo",
        needs_mesh=False, lack="nothing to redo", synonyms="again repeat"),
    Action("copy camera", "Copy ca&mera", lambda c: c[Views].copy(), ("Ctrl+Alt+C",),
        "Copy as text, for another window or bihdist figure --camera", synonyms="view viewpoint"),
    Action("paste camera", "P&aste camera", lambda c: c[Views].paste(), ("Ctrl+Alt+V",),
        "Use a copied camera", synonyms="view viewpoint"),
    Action("copy picture", "&Copy picture", lambda c: _figure_actions().copy(c, "picture"), ("Ctrl+Shift+C",),
        "Copy the figure as an image", "copy", synonyms="image clipboard"),
    Action("copy command", "Copy as command &line", lambda c: _figure_actions().copy(c, "command"),
        tip="Copy a shell command that draws what is shown", synonyms="shell terminal script"),
    Action("copy python", "Copy as P&ython", lambda c: _figure_actions().copy(c, "python"),
        tip="Copy a line of Python that draws what is shown", synonyms="script code notebook"),
    Action("clear by-products", "Clear selections and &borders", lambda c: clear_by_products(c),
        tip="Remove selections and borders of regions", can_run=_has_removable(by_products),
        lack="there are none", synonyms="hatching lasso regions deselect unselect stripes"),
    Action("clear surface", "Clear all but the &source", lambda c: c.session.show(clear_surface(c.document)),
        tip="Remove pins, selections, borders, anchors and other marks", can_run=_has_removable(surface_items),
        lack="nothing else is there", synonyms="reset marks pins anchors empty"),
    Action("preferences", "&Preferences…", lambda c: c[Choices].ask_preferences(), ("Ctrl+,",), icon="settings",
        needs_mesh=False, synonyms="settings options configure"),
)
VIEW = (
    Action("reset", "Hom&e", lambda c: c[Views].reset(), ("R", "Home"), "Fit to view", "reset-view",
        synonyms="home reset fit all whole view camera"),
    *(
        Action(f"view {name}", VIEW_TEXTS.get(name, f"&{name.capitalize()}"), partial(_see_from, name), (str(number),))
        for number, name in enumerate(VIEWS, 1)
    ),
    *(
        Action(f"view {name}", name.capitalize(), partial(_see_from, name), tip="Where z points up and y to the front",
            synonyms=f"brain cortex RAS {BRAIN_SYNONYMS.get(name, '')}")
        for name in BRAIN_VIEWS
    ),
    Action("centre", "&Centre view here", lambda c: _gestures(c).centre_here(), ("C",),
        "Centre what is under the pointer, and turn about it", synonyms="middle pivot focus look at"),
    Action("zoom to", "&Zoom in here", lambda c: _gestures(c).zoom_here(), ("Z",), "Enlarge what is under the pointer",
        synonyms="nearer closer focus"),
    Action("link", "Link cameras", lambda c: c[Views].link(), ("K",), "Turn both meshes together",
        is_on=lambda c: c.document.linked, can_run=_has_two, lack=NO_SECOND, synonyms="synchronise together"),
    Action("next up", "&Next axis up", lambda c: c[Views].next_up(), ("U",)),
    Action("other end up", "Upside &down", lambda c: c[Views].other_end_up(), ("Shift+U",)),
    Action("view before", "&Previous view", lambda c: c[Views].back(), ("Ctrl+[",), synonyms="back camera undo"),
    Action("view after", "Next vie&w", lambda c: c[Views].on(), ("Ctrl+]",), synonyms="forward camera redo"),
    Action("feature angle", "Feature &angle…", lambda c: c[Choices].ask_feature_angle(),
        tip="Choose from which angle on edges are sharp", synonyms="crease sharp edges normals"),
    Action("unit", "Unit of lengths…", lambda c: c[Choices].ask_unit(), tip="Name the unit of the mesh, such as mm",
        synonyms="scale bar millimetres metres"),
    Action("full screen", "&Full screen for talks", lambda c: c[Choices].toggle_full_screen(), ("F11",),
        "Show panels and bars only, in larger text", needs_mesh=False,
        is_on=lambda c: c[Choices].is_full_screen, synonyms="fullscreen presentation present maximise"),
)
TURNS = (
    Action("turn left", "Turn left", _on_view("turn_by", -1, 0), ("Left",), of_view=True),
    Action("turn right", "Turn right", _on_view("turn_by", 1, 0), ("Right",), of_view=True),
    Action("turn up", "Turn up", _on_view("turn_by", 0, 1), ("Up",), of_view=True),
    Action("turn down", "Turn down", _on_view("turn_by", 0, -1), ("Down",), of_view=True),
    Action("move left", "Move left", _on_view("shift_by", -1, 0), ("Shift+Left",), of_view=True),
    Action("move right", "Move right", _on_view("shift_by", 1, 0), ("Shift+Right",), of_view=True),
    Action("move up", "Move up", _on_view("shift_by", 0, 1), ("Shift+Up",), of_view=True),
    Action("move down", "Move down", _on_view("shift_by", 0, -1), ("Shift+Down",), of_view=True),
    Action("nearer", "Zoom in", _on_view("zoom", 1.2), ("+", "="), of_view=True, synonyms="zoom in larger closer"),
    Action("farther", "Zoom out", _on_view("zoom", 1 / 1.2), ("-",), of_view=True, synonyms="zoom out smaller"),
    Action("remove anchor", "Remove chosen anchor or pair", lambda c: _gestures(c).remove_chosen(), ("Delete",),
        of_view=True),
    Action("accept pair", "Accept predicted partner", lambda c: _gestures(c).accept(), ("Return", "Enter"),
        of_view=True),
)
PANELS = (
    Action("add panel", "&Add panel", lambda c: c[Choices].add_panel(), ("Ctrl+T",), "Show one more distance",
        "add-panel",
        can_run=lambda c: c[Choices].can_add_panel, lack="there are six panels already; remove one first",
        synonyms="new compare distance more"),
    *(
        Action(f"panel {word}", word, partial(_edit_panel, word), synonyms=edit.synonyms)
        for word, edit in panel_edits().items() if word != ADD
    ),
    Action("save field", "Save &field…", lambda c: c[FieldFiles].save(c.grid.active),
        tip="Save the vertex values of the active panel",
        synonyms="export write values distance data npy csv ply vtp obj glb blender colours colors"),
    Action("next panel", "&Next panel", lambda c: c.grid.focus(1), ("Tab",), of_view=True, synonyms="focus switch"),
    Action("previous panel", "&Previous panel", lambda c: c.grid.focus(-1), ("Shift+Tab",), of_view=True,
        synonyms="focus switch"),
    Action("panels and bars", "Switch focus to toolbar", _change_part, ("F6",), needs_mesh=False,
        synonyms="focus switch keyboard"),
)
TOOLS = (
    Action("source id", "&Type source…", lambda c: c[TypedSource].ask(), ("G",), icon="source",
        synonyms="vertex number go find select"),
    Action("snap", "Snap to &vertices", lambda c: c[Snapping].set(not c.document.snap), ("V",),
        "Put sources on vertices, not inside faces", is_on=lambda c: c.document.snap, synonyms="magnet nearest"),
    Action("save curve", "Save drawn curve…", lambda c: c[CurveFiles].save_source(c.grid.active),
        tip="Save the source curve as curve.json, a source for the command line", synonyms="export write source"),
    Action("source before", "Pr&evious source", lambda c: c.session.walk_sources(-1), ("Alt+Left",),
        synonyms="back history"),
    Action("source after", "Ne&xt source", lambda c: c.session.walk_sources(1), ("Alt+Right",),
        synonyms="forward history"),
    Action("live", "&Live source", lambda c: _gestures(c).set_live(c.actions["live"].isChecked()),
        ("L",), "Let the source follow the pointer, while the key is held or until switched off", "live",
        is_check=True, synonyms="hover drag follow mouse"),
    Action("stop", "Cancel co&mputation", stop, ("Esc",), needs_mesh=False, synonyms="cancel abort interrupt halt"),
)
HELP = (
    Action("keys", "&Commands and gestures…", lambda c: c[Guide].show_commands(), ("F1",), icon="info",
        needs_mesh=False, synonyms="help shortcuts palette gestures"),
    Action("guide", "&Guide", lambda c: c[Guide].open_guide(), tip="Open how-to pages, examples and reference",
        needs_mesh=False, synonyms="help manual documentation docs handbook how-to tutorial introduction tour examples "
            "gallery reference"),
    Action("about", "&About", lambda c: c[Guide].show_about(), needs_mesh=False, synonyms="version licence citation"),
)
# fmt: on
INSTRUMENTS = tuple(map(_dock, docked_tools().values()))
"""The docks, in the order of the menu."""

SETTINGS = tuple(map(_switch, SWITCHES))
ALL = (*FILE, *EDIT, *VIEW, *SETTINGS, *TURNS, *PANELS, *TOOLS, *actions_of_tools(), *INSTRUMENTS, *HELP)
