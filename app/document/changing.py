"""A document that shows what distances withstand: each before and after a change to the mesh, and the difference."""

from dataclasses import replace

from bihdist_core.applications.changes import Perturbation
from bihdist_core.errors import ParameterError

from .document import Document, MeshFile, Panel, Point
from .quantities import ChangeOf, DistanceFrom

COLUMNS = 3
"""Before, after, difference."""

CHANGED = "B"


def with_changed(document: Document, change: Perturbation) -> Document:
    """A document of one mesh, with the changed mesh besides: three panels for each of a distance.

    ParameterError for several meshes, and for a panel that shows no distance.
    """
    if len(document.surfaces) != 1:
        raise ParameterError(f"One mesh is changed at a time, and here there are {len(document.surfaces)}.")
    (mesh,) = document.surfaces
    name = CHANGED if mesh.name != CHANGED else "A"
    panels: list[Panel] = []
    for panel in document.panels:
        if not isinstance(panel.shows, DistanceFrom):
            raise ParameterError(f"What a change does is shown of distances, and {panel.shows} is none.")
        image = DistanceFrom(panel.shows.spec, image_name(panel.shows.point))
        k = len(panels)
        panels.append(replace(panel, id=k))
        panels.append(Panel(k + 1, image, name, panel.maximum))
        panels.append(Panel(k + 2, ChangeOf(image.spec, image.point), name))
    numbers = {panel.id: COLUMNS * k for k, panel in enumerate(document.panels)}
    starts = dict.fromkeys(point for panel in document.panels for point in panel.shows.points)
    return replace(
        document,
        surfaces=(mesh, MeshFile(name, mesh.path, mesh.sha256, change)),
        points=(*document.points, *(Point(image_name(point), None, name, point) for point in starts)),
        panels=tuple(panels),
        regions=tuple(numbers[id] for id in document.regions),
        next_id=len(panels),
    )


def image_name(point: str) -> str:
    """Of the point on the changed mesh that another becomes."""
    return f"{point} after"


def without_changed(document: Document) -> Document:
    """Without meshes that are made from others, and all that is on them."""
    made = {mesh.name for mesh in document.surfaces if mesh.change is not None}
    if not made:
        return document
    panels = [panel for panel in document.panels if panel.surface not in made]
    numbers = {panel.id: k for k, panel in enumerate(panels)}
    on_them = {point.name for point in document.points if point.surface in made}
    return replace(
        document,
        surfaces=tuple(mesh for mesh in document.surfaces if mesh.name not in made),
        points=tuple(point for point in document.points if point.name not in on_them),
        panels=tuple(replace(panel, id=numbers[panel.id]) for panel in panels),
        anchors=tuple(anchor for anchor in document.anchors if anchor.point not in on_them),
        pins=tuple(pin for pin in document.pins if pin.point not in on_them),
        pairs=() if any(name in on_them for pair in document.pairs for name in pair.points) else document.pairs,
        selections=tuple(each for each in document.selections if each.surface not in made),
        fields=tuple(field for field in document.fields if field.surface not in made),
        regions=tuple(numbers[id] for id in document.regions if id in numbers),
        next_id=len(panels),
    )


def split(document: Document) -> tuple[Document, Perturbation | None]:
    """The document and the change that `with_changed` has made this one from; itself and None if it has not."""
    changes = [mesh.change for mesh in document.surfaces if mesh.change is not None]
    if len(changes) != 1:
        return document, None
    base = without_changed(document)
    try:
        again = with_changed(base, changes[0])
    except ParameterError:
        return document, None
    is_so = _content(again) == _content(document)
    return (base, changes[0]) if is_so else (document, None)


def _content(document: Document) -> Document:
    """But for what is known only once the meshes are there."""
    points = (replace(point, at=None) if point.image_of else point for point in document.points)
    return replace(document, points=tuple(points), surfaces=document.surfaces)
