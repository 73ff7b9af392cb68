"""What the pictures of the guide show of the tools: each with its dock, on a sample that suits it."""

from dataclasses import replace
from typing import Any

from .parts import parts
from .pointer import (
    click_near,
    dock_of,
    drag_along,
    open_sample,
    open_second_mesh,
    place_on,
    point_near,
    press,
    scroll_of,
)  # fmt: skip

FINGERS = {"little finger": (0.15, 0.2), "index finger": (0.75, 0.1), "thumb": (0.95, 0.35), "wrist": (0.5, 0.95)}


def pins(d: Any) -> None:
    open_sample(d, "hand", "biharmonic|geodesic")
    for place in FINGERS.values():
        click_near(d, 0, *place, key="shift")
    d.window.session.apply(_named)
    dock_of(d, "pins", "p")
    d.rest()
    d.shot("pins")


def _named(document: Any) -> Any:
    from app.document.shared_parts.pins import Pins, with_pins

    named = zip(document[Pins].pins, FINGERS, strict=True)
    return with_pins(document, [replace(pin, name=name) for pin, name in named])


def profile(d: Any) -> None:
    open_sample(d, "elephant", "biharmonic|geodesic")
    click_near(d, 0, 0.2, 0.4)
    d.complete()
    for place in ((0.12, 0.9), (0.95, 0.7)):
        click_near(d, 0, *place, key="shift")
    dock = dock_of(d, "profile", "f")
    d.until(lambda: dock.path is not None)
    d.complete()
    d.pointer("mousemove", *place_on(d, dock.chart, 0.45, 0.4))
    d.shot("profile")


def scatter(d: Any) -> None:
    open_sample(d, "octopus", "biharmonic|geodesic")
    dock = dock_of(d, "scatter", "s")
    d.until(lambda: dock.chart.scatter is not None)
    d.spin(1.0)
    corners = ((0.5, 0.5), (0.6, 0.2), (0.8, 0.15), (0.9, 0.3), (0.8, 0.5), (0.6, 0.6))
    drag_along(d, [place_on(d, dock.chart, *corner) for corner in corners])
    d.complete()
    d.rest()
    d.shot("scatter")


def statistics(d: Any) -> None:
    open_sample(d, "beast", "biharmonic|geodesic")
    dock = dock_of(d, "statistics", "h")
    d.until(lambda: dock.statistics is not None)
    d.rest()
    d.shot("statistics")


def quality(d: Any) -> None:
    from qtpy import QtCore

    open_sample(d, "hand", "biharmonic|geodesic(method=heat)")
    dock = dock_of(d, "quality", "q")
    d.until(lambda: "…" not in dock.text())
    d.spin(1.0)
    d.rest()
    d.shot("quality")
    head = dock.table.mapToGlobal(dock.table.rect().topLeft())
    d.shot("triangle-violations", QtCore.QRect(head, QtCore.QSize(dock.width(), 220)))


def regions(d: Any) -> None:
    open_sample(d, "hand", "biharmonic|geodesic")
    dock = dock_of(d, "regions", "n")
    dock.sampler.count.setValue(8)
    press(d, dock.sampler.pin)
    d.complete()
    for panel in d.window.grid.panels:
        d.pointer("mousemove", *place_on(d, dock.ticks[panel.id], 0.03, 0.5), "click", 1)
    d.complete()
    d.until(lambda: parts(d.window).regions.dividing.is_complete)
    d.spin(1.0)
    d.rest()
    d.shot("regions")


def interpolation(d: Any) -> None:
    open_sample(d, "beast", "biharmonic|geodesic")
    dock = dock_of(d, "anchors", "i")
    press(d, dock.start)
    d.complete()
    for place in ((0.45, 0.2), (0.5, 0.85), (0.1, 0.5), (0.9, 0.5)):
        click_near(d, 0, *place)
        d.complete()
    for row, value in zip(dock.rows.values(), ("0", "1", "0.35", "0.7"), strict=False):
        d.pointer("mousemove", *place_on(d, row.box, 0.5, 0.5), "click", 1, "key", "ctrl+a")
        d.pointer("type", value)
        d.pointer("key", "Return")
        d.complete()
    d.until(lambda: parts(d.window).quality.is_complete and "…" not in str(dock.extrema.facts))
    d.rest()
    d.shot("interpolation")


def robustness(d: Any) -> None:
    open_sample(d, "hand", "biharmonic|geodesic")
    dock = dock_of(d, "robustness", "e")
    x, y = place_on(d, dock.noise.slider, 0.03, 0.5)
    width = dock.noise.slider.width() * d.look.scale
    drag_along(d, [(round(x + width * 0.025 * k), y) for k in range(8)])
    d.until(lambda: len(d.window.session.document.surfaces) == 2 and not d.window.session.is_opening)
    d.complete()
    scroll_of(dock).ensureWidgetVisible(dock.noise)
    d.rest()
    d.complete()
    d.spin(2.0)
    d.shot("robustness")


def two_meshes(d: Any) -> None:
    open_sample(d, "beast", "biharmonic")
    open_second_mesh(d, "beast_pose2")
    point_near(d, 0, 0.5, 0.5)
    d.shot("two-meshes")


def correspondence(d: Any) -> None:
    from app.tools.correspondence.pairs import add_pairs

    from .pair_scenes import far_apart

    open_sample(d, "beast", "biharmonic")
    open_second_mesh(d, "beast_pose2")
    dock, session = dock_of(d, "pairs", "m"), d.window.session
    press(d, dock.start)
    d.complete()
    session.show(
        add_pairs(session.document, [(vertex, vertex) for vertex in far_apart(session.mesh().surface.vertices)])
    )
    d.complete()
    point_near(d, 0, 0.4, 0.3)
    d.pointer("click", 1)
    d.complete()
    d.spin(2.0)
    d.rest()
    d.shot("correspondence")
