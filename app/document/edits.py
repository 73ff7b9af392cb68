"""From one document to the next: pure functions, for what `dataclasses.replace` alone does not do."""

from dataclasses import replace

from .document import Document, MeshFile, Panel, Place, Point, Quantity


def open_mesh(document: Document, mesh: MeshFile, source: int | None = None) -> Document:
    """Another mesh under the same name; seen from home, and its points are where the first source is.

    What was tied to vertices of the old one (insets, anchors, colour bars with an end of their own) is left out.
    """
    surfaces = tuple(mesh if other.name == mesh.name else other for other in document.surfaces)
    points = tuple(replace(p, at=source) if p.surface == mesh.name else p for p in document.points)
    gone = {point.name for point in points if point.surface == mesh.name}
    shown = {name for panel in document.panels for name in panel.shows.points}
    return replace(
        document,
        surfaces=surfaces if mesh in surfaces else (*surfaces, mesh),
        points=tuple(point for point in points if point.name in shown or point.surface != mesh.name),
        panels=tuple(replace(p, maximum=None) if p.surface == mesh.name else p for p in document.panels),
        anchors=tuple(anchor for anchor in document.anchors if anchor.point not in gone),
        zooms=(),
        height=0.0,
        camera="home",
    )


def put_point(document: Document, name: str, at: int | Place | None, surface: str = "A") -> Document:
    """Move a named point, or add it."""
    point = Point(name, at, surface)
    if all(other.name != name for other in document.points):
        return replace(document, points=(*document.points, point))
    return replace(document, points=tuple(point if other.name == name else other for other in document.points))


def move_source(document: Document, panel: int, at: int | Place) -> Document:
    """What a click in a panel does: the point that its quantity starts from goes there."""
    shown = document.panel(panel)
    return put_point(document, shown.shows.points[0], at, shown.surface)


def show_in(document: Document, panel: int, shows: Quantity) -> Document:
    """Show another quantity in a panel; a colour bar with an end of its own belonged to the old one."""
    return replace(
        document,
        panels=tuple(
            replace(p, shows=shows, maximum=None) if p.id == panel and p.shows != shows else p for p in document.panels
        ),
    )


def add_panel(document: Document, shows: Quantity, surface: str = "A") -> Document:
    """One more panel, at the end, with an id that no panel has had."""
    panel = Panel(document.next_id, shows, surface)
    return replace(document, panels=(*document.panels, panel), next_id=document.next_id + 1)


def remove_panel(document: Document, panel: int) -> Document:
    return replace(document, panels=tuple(p for p in document.panels if p.id != document.panel(panel).id))


def move_panel(document: Document, panel: int, place: int) -> Document:
    """Put a panel at a place among the others, 0 for the first."""
    others = [p for p in document.panels if p.id != panel]
    others.insert(place, document.panel(panel))
    return replace(document, panels=tuple(others))
