"""What there is to see of the instruments, for the contact sheet: by mouse and keys, as users open and use them."""

from collections.abc import Callable
from itertools import combinations

from app.document.shared_parts.pins import Pins
from app.document.shared_parts.selections import Selections
from tests.qt.parts import parts

from .driver import Driver
from .pointer import (
    click_near,
    close_docks,
    dock_of,
    drag_along,
    place_on,
    point_near,
    press,
    rest,
    scroll_of,
    to_panels,
    type_source,
)  # fmt: skip

PINNED = ((0.2, 0.3), (0.8, 0.25), (0.3, 0.8), (0.75, 0.8), (0.5, 0.4))
"""Places of a view near which pins go, as shares of its width and height."""

SOURCE = (0.55, 0.5)


def instruments(d: Driver) -> None:
    """All of them on a closed surface with limbs, then what needs a boundary."""
    from app.samples import mesh_path

    d.open(mesh_path(d.closed))
    for scene in (_pins, _profile, _section, _scatter, _statistics, _quality, _regions, _all_open):
        scene(d)
        close_docks(d)
    _interpolation(d)
    close_docks(d)
    _robustness(d)
    close_docks(d)
    _sources(d)
    _live(d)
    d.open(mesh_path(d.bounded))
    _loop(d)


# ---------------------------------------------------------------------- the scenes
def _pins(d: Driver) -> None:
    click_near(d, 0, *SOURCE)
    for place in PINNED:
        click_near(d, 0, *place, key="shift")
    dock = dock_of(d, "pins", "p")
    d.pointer("mousemove", *place_on(d, dock.distances.cells, 0.7, 0.3))
    d.shot("pins and the distances among them")
    rest(d)
    press(d, dock.box)
    d.pointer("type", "12, 40, 99999999")
    d.pointer("key", "Return")
    d.shot("a pin at no vertex")
    d.pointer("key", "Escape")
    dock.table.selectRow(1)
    d.shot("a pin stands out")
    dock.table.clearSelection()


def _profile(d: Driver) -> None:
    dock = dock_of(d, "profile", "f")
    d.until(lambda: dock.path is not None)
    dock_of(d, "pins", "p")
    d.pointer("mousemove", *place_on(d, dock.chart, 0.45, 0.4))
    d.shot("profile through the pins")
    rest(d)
    press(d, dock.scale.buttons["value"])
    d.complete()
    d.shot("profile in values")
    press(d, dock.scale.buttons["share"])
    d.complete()


def _section(d: Driver) -> None:
    """Through the first two of the pins that a section joins."""
    from app.tools.profile.dock import FINDING
    from app.tools.profile.part import Profile

    dock = dock_of(d, "profile", "f")
    before = d.window.session.document
    for points in combinations([pin.point for pin in before[Pins].pins], 2):
        path = dock.path
        d.window.session.show(before.with_part(Profile(points, "section", dock.view_direction())))
        d.until(lambda path=path: dock.path is not path or dock.chart.sentence not in ("", FINDING))
        if dock.path is not None:
            break
    d.complete()
    d.pointer("mousemove", *place_on(d, dock.chart, 0.6, 0.5))
    d.shot("section by a plane")
    d.window.session.show(before)
    d.complete()


def _scatter(d: Driver) -> None:
    dock = dock_of(d, "scatter", "s")
    d.until(lambda: dock.chart.scatter is not None)
    d.spin(1.0)
    d.shot("scatter")
    corners = ((0.5, 0.5), (0.6, 0.2), (0.8, 0.15), (0.9, 0.3), (0.8, 0.5), (0.6, 0.6))
    drag_along(d, [place_on(d, dock.chart, *corner) for corner in corners], then=lambda: d.shot("lasso"))
    d.complete()
    point_near(d, 0, 0.3, 0.5)
    d.pointer("keydown", "b")
    d.pointer("mousedown", 1)
    for step in range(8):
        point_near(d, 0, 0.3 + 0.02 * step, 0.5)
    d.shot("brush on the surface")
    d.pointer("mouseup", 1)
    d.pointer("keyup", "b")
    d.complete()
    d.shot("scatter with selections")
    while d.window.session.document[Selections].selections:
        d.window.session.undo()


def _statistics(d: Driver) -> None:
    dock = dock_of(d, "statistics", "h")
    d.until(lambda: dock.statistics is not None)
    d.shot("statistics")
    scroll = scroll_of(dock)
    scroll.ensureWidgetVisible(dock.truncation.button)
    press(d, dock.truncation.button)
    d.until(lambda: dock.truncation.loss is not None)
    scroll.ensureWidgetVisible(dock.truncation.facts)
    d.shot("truncation")
    scroll.ensureWidgetVisible(dock.levels.low)
    for box, words in ((dock.levels.low, "25 %"), (dock.levels.high, "50 %")):
        press(d, box)
        d.pointer("type", words)
    d.until(lambda: dock.levels.band is not None)
    scroll.ensureWidgetVisible(dock.levels.note)
    dock.levels.select()
    d.complete()
    d.shot("region between two values")
    while d.window.session.document[Selections].selections:
        d.window.session.undo()


def _quality(d: Driver) -> None:
    dock = dock_of(d, "quality", "q")
    d.until(lambda: "…" not in dock.text())
    d.spin(1.0)
    d.shot("quality with extrema")


def _regions(d: Driver) -> None:
    dock = dock_of(d, "regions", "n")
    for panel in d.window.grid.panels[:2]:
        d.pointer("mousemove", *place_on(d, dock.ticks[panel.id], 0.03, 0.5), "click", 1)
    d.complete()
    d.spin(1.0)
    d.shot("regions of the pins")
    d.window.status.marks.click()
    parts(d.window).docks._docks["surface"].content.rows["borders"].eye.click()
    d.complete()
    d.shot("list of what is on the surface")
    d.window.session.undo()
    before = d.window.session.document
    dock.sampler.count.setValue(8)
    scroll_of(dock).ensureWidgetVisible(dock.sampler.pin)
    press(d, dock.sampler.pin)
    d.until(lambda: len(d.window.session.document[Pins].pins) > len(before[Pins].pins))
    d.complete()
    d.spin(1.0)
    d.shot("farthest points")
    d.window.session.show(before)
    d.complete()


ANCHORED = ((0.45, 0.2), (0.5, 0.85), (0.25, 0.4), (0.7, 0.3), (0.5, 0.55))
VALUES = ("0", "1", "0.35", "0.7", "0.55")


def _interpolation(d: Driver) -> None:
    before = d.window.session.document
    dock = dock_of(d, "anchors", "i")
    d.shot("no anchors yet")
    press(d, dock.start)
    d.complete()
    for place in ANCHORED:
        click_near(d, 0, *place)
        d.complete()
    for row, value in zip(dock.rows.values(), VALUES, strict=False):
        d.pointer("mousemove", *place_on(d, row.box, 0.5, 0.5), "click", 1, "key", "ctrl+a")
        d.pointer("type", value)
        d.pointer("key", "Return")
        d.complete()
    d.until(lambda: parts(d.window).quality.is_complete and "…" not in str(dock.extrema.facts))
    d.shot("anchors")
    row = list(dock.rows.values())[3]
    x, y = place_on(d, row.slider, 0.7, 0.5)
    drag_along(d, [(x - 3 * step * d.look.scale, y) for step in range(10)], then=lambda: d.shot("a value on its way"))
    d.complete()
    scroll_of(dock).ensureWidgetVisible(dock.samples.add)
    press(d, dock.samples.add)
    d.until(lambda: len(dock.rows) > len(ANCHORED))
    d.complete()
    d.until(lambda: parts(d.window).quality.is_complete)
    d.shot("samples as anchors")
    scroll_of(dock).ensureWidgetVisible(dock.shows)
    d.pointer("mousemove", *place_on(d, dock.shows, 0.75, 0.5), "click", 1)
    d.complete()
    d.shot("the sum of weights")
    d.window.session.show(before)
    d.complete()


def _robustness(d: Driver) -> None:
    before = d.window.session.document
    dock = dock_of(d, "robustness", "e")
    d.shot("no change yet")
    x, y = place_on(d, dock.noise.slider, 0.03, 0.5)
    width = dock.noise.slider.width() * d.look.scale
    drag_along(d, [(round(x + width * 0.03 * k), y) for k in range(10)], then=lambda: d.shot("noise on its way"))
    d.complete()
    point_near(d, 4 if len(d.window.grid.panels) > 4 else 1, 0.5, 0.5)
    d.shot("noise before and after")
    rest(d)
    dock.remove()
    _wait(d, lambda: len(d.window.session.document.surfaces) == 1)
    scroll_of(dock).ensureWidgetVisible(dock.cut)
    press(d, dock.cut.button)
    d.spin(0.5)
    places = []
    for step in range(10):
        point_near(d, 0, 0.42 + 0.02 * step, 0.5)
        from qtpy import QtGui

        places.append((QtGui.QCursor.pos().x() * d.look.scale, QtGui.QCursor.pos().y() * d.look.scale))
    drag_along(d, places, then=lambda: d.shot("faces to be cut out"))
    _wait(d, lambda: len(d.window.session.document.surfaces) == 2)
    d.pointer("key", "Escape")
    rest(d)
    d.shot("a hole")
    d.window.session.show(before)
    d.complete()


def _wait(d: Driver, is_so: Callable[[], bool]) -> None:
    """Until a change has been made, and all is shown."""
    d.until(lambda: is_so() and not d.window.session.is_opening)
    d.complete()
    d.spin(0.3)


def _all_open(d: Driver) -> None:
    for word, key in (
        ("statistics", "h"), ("quality", "q"), ("regions", "n"), ("pins", "p"), ("scatter", "s"), ("profile", "f"),
    ):  # fmt: skip
        dock_of(d, word, key)
    d.spin(1.5)
    d.shot("all docks")


def _sources(d: Driver) -> None:
    before = d.window.session.document
    click_near(d, 0, 0.3, 0.6, key="ctrl")
    click_near(d, 0, 0.7, 0.3, key="ctrl")
    d.complete()
    d.shot("a set as source")
    for text, name in (("f311:0.2,0.5", "a place in a face"), ("12+40+f7:0.3,0.3", "a set as words")):
        type_source(d, text)
        d.shot(name)
    to_panels(d)
    d.window.actions_by_word["draw source"].trigger()
    view = d.window.grid.panels[0].view
    places = []
    for step in range(12):
        point_near(d, 0, 0.4 + 0.015 * step, 0.45 + 0.01 * step)
        from qtpy import QtGui

        at = QtGui.QCursor.pos()
        places.append((at.x() * d.look.scale, at.y() * d.look.scale))
    assert view is not None
    drag_along(d, places, then=lambda: d.shot("drawing a source"))
    d.complete()
    rest(d)
    d.shot("a curve as source")
    d.pointer("key", "Escape")
    d.window.session.show(before)
    d.complete()


def _live(d: Driver) -> None:
    """The source's mark is dragged, and kept where it is while the picture is taken."""
    from qtpy import QtCore

    view = d.window.grid.panels[0].view
    at = view.mapToGlobal(view.place_of(view.handles[0]).toPoint()) * d.look.scale
    assert isinstance(at, QtCore.QPoint)
    places = [(at.x() + round(3 * step * d.look.scale), at.y() - step * d.look.scale) for step in range(14)]
    places += places[::-1][:12]
    drag_along(d, places, then=lambda: d.shot("live drag"))
    d.complete()


def _loop(d: Driver) -> None:
    type_source(d, "loop:0")
    d.shot("a boundary as source")
