"""What the pictures of the guide show, scene by scene: a window of its own each, used as readers would use it."""

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import cos, sin
from pathlib import Path
from typing import Any

from .guide_tool_scenes import (
    correspondence,
    interpolation,
    pins,
    profile,
    quality,
    regions,
    robustness,
    scatter,
    statistics,
    two_meshes,
)  # fmt: skip
from .pointer import (
    choose_entry,
    click_near,
    click_vertex,
    drag_along,
    open_sample,
    place_on,
    point_at_vertex,
    source_mark,
    to_panels,
)  # fmt: skip


@dataclass(frozen=True)
class Scene:
    """act: takes the pictures of these names.  width, height: of the window in logical pixels.  is_moving: whether they
    are moving pictures, which are WebP beside the sample meshes.
    """

    act: Callable[[Any], None]
    names: tuple[str, ...]
    theme: str = "light"
    width: int = 1000
    height: int = 620
    is_moving: bool = False


SOURCE, PLACE = 2969, 4182
"""Vertices of the beast at its waist and in its hand: pages name them, and say the values there."""


def start_page(d: Any) -> None:
    d.shot("start-page")


def first_steps(d: Any) -> None:
    open_sample(d, "beast")
    d.shot("opened")
    click_vertex(d, 0, SOURCE)
    d.shot("clicked")
    point_at_vertex(d, 1, PLACE)
    d.shot("values")
    x, y = source_mark(d, 0)
    drag_along(
        d,
        [(x + 5 * step, y - step) for step in range(16)],
        then=lambda: (d.complete(), d.shot("dragged", d.without_status)),
    )


def comparing(d: Any) -> None:
    open_sample(d, "beast", "biharmonic|geodesic")
    click_vertex(d, 0, SOURCE)
    name = d.window.grid.panels[1].head.name
    choose_entry(d, name.menu(), name, "Diffusion", lambda: d.shot("quantity-menu"))
    d.rest()
    _show(d, "biharmonic|geodesic|biharmonic - geodesic")
    d.shot("difference")


def _show(d: Any, shows: str) -> None:
    """Quantities, with `|` between them, in as many panels."""
    from app.document.edits import add_panel, remove_panel
    from app.document.quantities import quantity

    document = d.window.session.document
    before = [panel.id for panel in document.panels]
    for text in shows.split("|"):
        document = add_panel(document, quantity(text))
    for panel in before:
        document = remove_panel(document, panel)
    d.window.session.show(document)
    d.complete()


def looks(d: Any) -> None:
    open_sample(d, "hand", "biharmonic|geodesic")
    buttons, menus = d.window.tool_bar.buttons, d.window.menus
    choose_entry(d, menus.isolines, buttons["isolines"], "Labels", is_chosen=True)
    choose_entry(d, menus.isolines, buttons["isolines"], "Bold every fifth", is_chosen=True)
    choose_entry(d, menus.isolines, buttons["isolines"], "Labels", lambda: d.shot("isolines"))
    d.window.session.undo()
    d.window.session.undo()
    shared = "Shared by all panels of a unit"
    choose_entry(d, menus.range, buttons["range"], shared, is_chosen=True)
    choose_entry(d, menus.range, buttons["range"], shared, lambda: d.shot("ranges"))
    d.window.session.undo()
    choose_entry(d, menus.colours, buttons["colours"], "Uniform", is_chosen=True)
    choose_entry(d, menus.colours, buttons["colours"], "Uniform", lambda: d.shot("colours"))


def dark(d: Any) -> None:
    open_sample(d, "elephant", "biharmonic|geodesic")
    click_near(d, 0, 0.2, 0.4)
    d.complete()
    d.rest()
    d.shot("dark")


def palette(d: Any) -> None:
    open_sample(d, "beast")
    to_panels(d)
    d.rest()
    d.pointer("key", "F1")
    d.tool("type", "isolines")
    d.spin(0.5)
    d.shot("palette")


def sources(d: Any) -> None:
    open_sample(d, "figure", "biharmonic|geodesic")
    for place in ((0.1, 0.5), (0.95, 0.5), (0.4, 0.95)):
        click_near(d, 0, *place, key="ctrl")
        d.complete()
    d.rest()
    d.shot("many-sources")


def drawn(d: Any) -> None:
    open_sample(d, "elephant", "biharmonic|geodesic")
    to_panels(d)
    d.pointer("key", "d")
    view = d.window.grid.panels[0].view
    arc = [(0.33 - 0.14 * cos(turn / 7), 0.45 - 0.19 * sin(turn / 7)) for turn in range(-5, 23)]
    drag_along(d, [place_on(d, view, *place) for place in arc])
    d.complete()
    d.rest()
    d.shot("sources")


def cut_out(d: Any) -> None:
    """Without the wrist."""
    import numpy as np

    from app.qt.files.mesh_repairs import MeshRepairs

    open_sample(d, "hand", "biharmonic|geodesic")
    heights = d.window.session.mesh().surface.vertices[:, 1]
    with tempfile.TemporaryDirectory() as folder:
        mask = str(Path(folder, "hand-mask.npy"))
        np.save(mask, heights > np.quantile(heights, 0.12))
        d.window.context[MeshRepairs].cut(mask)
        d.until(lambda: bool(d.window.session.document.surfaces[0].repairs.cut))
        d.complete()
        d.rest()
        d.window.status.notes.click()
        d.shot("cut-out")
        d.close_dialogs()


def export_figure(d: Any) -> None:
    from app.qt.files.export_dialog import ExportDialog

    open_sample(d, "beast")
    click_vertex(d, 0, SOURCE)
    d.rest()
    d.window.context.actions["figure"].trigger()
    (dialog,) = (each for each in d.application.topLevelWidgets() if isinstance(each, ExportDialog))
    dialog.size.rows.button(2).click()
    dialog.kinds.choose("PDF")
    d.until(lambda: dialog.pane.is_true)
    d.shot("export-figure", dialog)


def export_page(d: Any) -> None:
    from app.qt.files.page_dialog import PageDialog

    open_sample(d, "beast")
    d.rest()
    d.window.context.actions["page"].trigger()
    (dialog,) = (each for each in d.application.topLevelWidgets() if isinstance(each, PageDialog))
    d.shot("export-page", dialog)


def file_menu(d: Any) -> None:
    open_sample(d, "beast")
    bar = d.window.menuBar()
    for action in bar.actions():
        if action.text().strip("&") == "File":
            choose_entry(d, action.menu(), bar, "Export web page…", lambda: d.shot("file-menu"))


def parts_of_the_window(d: Any) -> None:
    from qtpy import QtCore

    open_sample(d, "beast")
    click_vertex(d, 0, SOURCE)
    point_at_vertex(d, 1, PLACE)
    window = d.window
    buttons, panels, status = window.tool_bar.buttons, window.grid.panels, window.status

    def at(widget: Any, x: float, y: float) -> Any:
        return widget.mapToGlobal(QtCore.QPoint(round(x * widget.width()), round(y * widget.height())))

    mark = panels[0].view.place_of(panels[0].view.handles[0]).toPoint()
    d.badges = [
        at(window.menuBar(), 0.4, 0.5),
        at(buttons["open"], 0.5, -0.1),
        at(window.tool_bar.source_box, 0.5, -0.15),
        at(buttons["tools"], 0.5, -0.1),
        at(buttons["isolines"], 2.0, -0.1),
        at(buttons["add panel"], 0.5, -0.1),
        at(buttons["export"], 0.5, -0.1),
        at(panels[1].head, 0.12, 0.5) + QtCore.QPoint(0, 22),
        at(panels[2].head, 0.9, 0.5) + QtCore.QPoint(0, 22),
        panels[0].view.mapToGlobal(mark) + QtCore.QPoint(-20, 0),
        at(panels[1].view, 0.61, 0.437),
        at(panels[2].view, 0.5, 0.99),
        at(status, 0.3, 0.5),
        at(status, 0.68, 0.5),
    ]
    d.shot("window-at-a-glance")


PATH = ((0.42, 0.56), (0.5, 0.46), (0.6, 0.38), (0.67, 0.42), (0.74, 0.49), (0.81, 0.56))
"""Over chest, shoulder and arm to the claws, as shares of a view's width and height."""


def _between(places: Sequence[tuple[float, float]], share: float) -> tuple[float, float]:
    """What is at a share of the way through places, each as far from the next."""
    at = share * (len(places) - 1)
    k = min(int(at), len(places) - 2)
    (x, y), (next_x, next_y) = places[k], places[k + 1]
    return x + (at - k) * (next_x - x), y + (at - k) * (next_y - y)


def click_and_drag(d: Any) -> None:
    """A click on the chest, and the source's mark dragged into a hand and back."""
    import numpy as np
    from qtpy import QtCore

    open_sample(d, "beast", "biharmonic|geodesic")
    view = d.window.grid.panels[0].view

    def along(places: Sequence[tuple[float, float]], steps: int) -> None:
        """The pointer, slowly at first and at last."""
        for share in (1 - np.cos(np.linspace(0, np.pi, steps))) / 2:
            d.tool("mousemove", *place_on(d, view, *_between(places, share)))
            d.spin(0.08)
            d.until(lambda: d.window.session.is_complete)
            d.spin(0.08)
            d.film()

    for share in np.linspace(0, 1, 40):
        x, y = _between(PATH, share)
        if view.pick(QtCore.QPoint(round(x * view.width()), round(y * view.height()))) is None:
            raise RuntimeError(f"The path leaves the surface at {x:.2f}, {y:.2f}.")

    def press(is_down: bool) -> None:
        d.tool("mousedown" if is_down else "mouseup", 1)
        d.is_pressed = is_down
        d.spin(0.1)
        d.film(3)

    along([(0.9, 0.9), PATH[0]], 18)
    press(True)
    press(False)
    d.complete()
    d.film(12)
    press(True)
    along(PATH, 44)
    d.film(6)
    along(PATH[::-1], 30)
    press(False)
    d.film(12)
    d.moving("click")


SCENES = (
    Scene(parts_of_the_window, ("window-at-a-glance",)),
    Scene(click_and_drag, ("click",), is_moving=True),
    Scene(start_page, ("start-page",)),
    Scene(first_steps, ("opened", "clicked", "values", "dragged")),
    Scene(comparing, ("quantity-menu", "difference")),
    Scene(looks, ("isolines", "ranges", "colours")),
    Scene(dark, ("dark",), theme="dark"),
    Scene(palette, ("palette",)),
    Scene(sources, ("many-sources",)),
    Scene(drawn, ("sources",)),
    Scene(cut_out, ("cut-out",)),
    Scene(export_figure, ("export-figure",)),
    Scene(export_page, ("export-page",)),
    Scene(file_menu, ("file-menu",)),
    Scene(pins, ("pins",)),
    Scene(profile, ("profile",)),
    Scene(scatter, ("scatter",)),
    Scene(statistics, ("statistics",)),
    Scene(quality, ("quality", "triangle-violations")),
    Scene(regions, ("regions",)),
    Scene(interpolation, ("interpolation",)),
    Scene(robustness, ("robustness",)),
    Scene(two_meshes, ("two-meshes",)),
    Scene(correspondence, ("correspondence",)),
)
