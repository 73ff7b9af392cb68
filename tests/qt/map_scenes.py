"""What there is to see of errors and full maps, for the contact sheet: two poses, and two meshes without a truth."""

from .driver import Driver
from .pair_scenes import far_apart
from .pointer import close_docks, dock_of, open_second_mesh, place_on


def full_maps(d: Driver) -> None:
    """The curves, the truth's menu, a map in colours by mouse, and meshes of which nobody knows what is right."""
    from app.document.second_mesh_edits import close_second_mesh
    from app.samples import mesh_path
    from app.tools.correspondence.pairs import add_pairs

    d.open(mesh_path("beast"))
    session = d.window.session
    open_second_mesh(d, "beast_pose2")
    dock = dock_of(d, "pairs", "m")
    d.complete()
    section = dock.errors
    d.shot("errors without pairs")
    session.show(
        add_pairs(session.document, [(vertex, vertex) for vertex in far_apart(session.mesh().surface.vertices)])
    )
    d.complete()
    d.until(lambda: section.errors is not None)
    d.shot("errors so far")
    d.until(lambda: section.is_whole)
    scroll = _scrolled(section)
    if scroll is not None:
        scroll.ensureWidgetVisible(section.full)
    d.shot("errors of predictions")
    d.pointer("mousemove", *place_on(d, section.chart, 0.4, 0.4))
    d.shot("errors at the pointer")
    d.shot_while(section.truth.button.click, "menu of the truth")
    d.pointer("mousemove", *place_on(d, section.full, 0.5, 0.5), "click", 1)
    d.complete()
    d.shot("a full map")
    d.point_at_surface(1)
    d.shot("where a vertex is mapped")
    d.shot_while(section.save.click, "menu of full maps")
    d.pointer("mousemove", *place_on(d, section.full, 0.5, 0.5), "click", 1)
    d.complete()
    open_second_mesh(d, "figure")
    d.complete()
    d.shot("errors without a truth")
    close_docks(d)
    session.show(close_second_mesh(session.document))
    d.complete()


def _scrolled(widget: object) -> object:
    """What scrolls a widget, if anything does."""
    from qtpy import QtWidgets

    above = widget
    while above is not None and not isinstance(above, QtWidgets.QScrollArea):
        above = above.parentWidget()
    return above
