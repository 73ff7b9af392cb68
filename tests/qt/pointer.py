"""What a hand does with the window that a script drives: points at surfaces and widgets, clicks, drags, opens docks."""

from collections.abc import Callable
from typing import Any

from tests.qt.parts import parts

from .driver import Driver


def point_near(d: Driver, panel: int, x: float, y: float) -> None:
    """The pointer to the place of the surface that is nearest to a place of a view."""
    from qtpy import QtCore

    view = d.window.grid.panels[panel].view
    places = [((i + 0.5) / 40, (j + 0.5) / 40) for i in range(40) for j in range(40)]
    for near in sorted(places, key=lambda at: (at[0] - x) ** 2 + (at[1] - y) ** 2):
        at = QtCore.QPoint(round(near[0] * view.width()), round(near[1] * view.height()))
        if view.pick(at) is not None and view.mark_at(at) < 0 and view.over.points.standing_at(at) is None:
            d.point(panel, *near)
            return


def click_near(d: Driver, panel: int, x: float, y: float, key: str = "") -> None:
    point_near(d, panel, x, y)
    d.pointer(*(("keydown", key) if key else ()), "click", 1, *(("keyup", key) if key else ()))


def point_at_vertex(d: Driver, panel: int, vertex: int) -> None:
    """The pointer to a vertex that is seen in a panel."""
    shown = d.window.grid.panels[panel]
    place = shown.view.place_of(shown.positions[vertex]).toPoint()
    d.pointer("mousemove", *d.on_screen(shown.view.mapToGlobal(place)))


def click_vertex(d: Driver, panel: int, vertex: int) -> None:
    """Make a vertex the source, by a click there; RuntimeError if the click meets another."""
    point_at_vertex(d, panel, vertex)
    d.pointer("click", 1)
    d.complete()
    at = d.window.session.document.point("source").at
    if at != vertex:
        raise RuntimeError(f"The click at vertex {vertex} met {at}.")


def drag_along(
    d: Driver, places: list[tuple[int, int]], *, key: str = "", then: Callable[[], None] | None = None
) -> None:
    """Along places of the screen; then: before the button is let go."""
    first, *others = places
    d.pointer("mousemove", *first, *(("keydown", key) if key else ()), "mousedown", 1)
    for place in others:  # each by itself: moves that wait together are one
        d.tool("mousemove", *place)
        d.spin(0.03)
    if then is not None:
        then()
    d.pointer("mouseup", 1, *(("keyup", key) if key else ()))


def place_on(d: Driver, widget: Any, x: float, y: float) -> tuple[int, int]:
    """Where a place of a widget is on the screen, in device pixels."""
    from qtpy import QtCore

    return d.on_screen(widget.mapToGlobal(QtCore.QPoint(round(x * widget.width()), round(y * widget.height()))))


def press(d: Driver, widget: Any) -> None:
    d.pointer("mousemove", *place_on(d, widget, 0.5, 0.5), "click", 1)


def dock_of(d: Driver, word: str, key: str = "") -> Any:
    """An instrument, opened by its key if it is not open."""
    if key:
        to_panels(d)
        d.pointer("key", key)
    d.complete()
    return parts(d.window).docks._docks[word].content


def to_panels(d: Driver) -> None:
    """The keys go to the panels."""
    d.window.activateWindow()
    d.window.grid.focus()
    d.spin(0.1)


def close_docks(d: Driver) -> None:
    for word in d.window.session.document.docks:
        parts(d.window).docks.close(word)
    d.complete()


def rest(d: Driver) -> None:
    """The pointer beside all that answers to it."""
    d.pointer("mousemove", d.look.width * d.look.scale // 2, 8 * d.look.scale)


def scroll_of(dock: Any) -> Any:
    from qtpy import QtWidgets

    return dock.findChild(QtWidgets.QScrollArea)


def type_source(d: Driver, text: str) -> None:
    to_panels(d)
    d.pointer("key", "g")
    d.pointer("type", text)
    d.pointer("key", "Return")
    d.complete()
    rest(d)


def open_second_mesh(d: Driver, name: str) -> None:
    """Open a sample as the second mesh."""
    from app.samples import mesh_path

    session, path = d.window.session, mesh_path(name)
    session.open_second_mesh(path)
    d.until(lambda: not session.is_opening and session.document.surfaces[-1].path == path)
    d.complete()


def open_sample(d: Driver, name: str, shows: str = "", source: int | None = None) -> None:
    """Open a sample; shows: quantities, with `|` between them, in as many panels, instead of the comparison."""
    from app.document.document import comparison
    from app.samples import mesh_path
    from bihdist_core.distances.distance_types import Spec

    if shows:
        specs = tuple(Spec.parse(text) for text in shows.split("|"))
        d.window.session.show(comparison("", specs))
    d.window.context.open(mesh_path(name), source)
    d.until(lambda: not d.window.session.is_opening)
    d.complete()


def source_mark(d: Driver, panel: int) -> tuple[int, int]:
    """Where a view has the mark of the source, on the screen in device pixels."""
    view = d.window.grid.panels[panel].view
    return d.on_screen(view.mapToGlobal(view.place_of(view.handles[0]).toPoint()))


def choose_entry(
    d: Driver, menu: Any, below: Any, text: str, then: Callable[[], object] = lambda: None, is_chosen: bool = False
) -> None:
    """Open a menu below a widget and go to an entry; `then` is called, and the entry chosen if asked."""
    from qtpy import QtCore

    from app.qt.pages.palette import plain

    corner, room = below.mapToGlobal(below.rect().bottomLeft()), d.look.width - menu.sizeHint().width() - 4
    corner.setX(min(corner.x(), room))
    d.spin(1.0)  # until all that follows a choice, such as labels, is there
    menu.popup(corner)
    d.spin(0.3)
    entry = next(action for action in menu.actions() if plain(action.text()) == text)
    row = menu.actionGeometry(entry)
    for x in (14, 10):  # a menu minds the pointer from its second move on
        d.tool("mousemove", *d.on_screen(menu.mapToGlobal(QtCore.QPoint(row.left() + x, row.center().y()))))
        d.spin(0.05)
    if not menu.isVisible():
        raise RuntimeError(f"The menu with {text!r} is closed.")
    then()
    if is_chosen:
        entry.trigger()
    menu.hide()
    d.complete()
