"""A document that shows what distances withstand: each before and after a change to the mesh, and the difference."""

from dataclasses import replace

from bihdist_core.applications.changes import Perturbation
from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError

from .document import Document, MeshFile, Panel, Point
from .quantities import DistanceFrom, quantity
from .removal import without_surfaces

COLUMNS = 3
"""Before, after, difference."""

CHANGED = "B"

CHANGE = "change of "
"""What the words of a change begin with."""


def changed_mesh(document: Document) -> MeshFile | None:
    """The mesh that is made from another, if there is one."""
    return next((mesh for mesh in document.surfaces if mesh.change is not None), None)


def with_changed(document: Document, change: Perturbation, with_others: bool = False) -> Document:
    """A document of one mesh, with the changed mesh besides: three panels for each of a distance.

    with_others: whether panels that show no distance stay, behind those that do.

    ParameterError for several meshes, for a panel that shows no distance if those do not stay, and where none does.
    """
    if len(document.surfaces) != 1:
        raise ParameterError(f"One mesh is changed at a time, and here there are {len(document.surfaces)}.")
    (mesh,) = document.surfaces
    name = CHANGED if mesh.name != CHANGED else "A"
    meant = [panel for panel in document.panels if panel.shows.is_distance]
    others = [panel for panel in document.panels if panel not in meant]
    if others and not with_others:
        raise ParameterError(f"What a change does is shown of distances, and {others[0].shows} is none.")
    if not meant:
        raise ParameterError("What a change does is shown of distances; let a panel show one.")
    panels: list[Panel] = []
    for panel in meant:
        image = DistanceFrom(panel.shows.specs[0], image_name(panel.shows.points[0]))
        k = len(panels)
        panels.append(replace(panel, id=k))
        panels.append(Panel(k + 1, image, name, panel.maximum))
        panels.append(Panel(k + 2, quantity(f"{CHANGE}{image.spec.in_full}", image.point), name))
    numbers = {panel.id: COLUMNS * k for k, panel in enumerate(meant)}
    numbers |= {panel.id: len(panels) + k for k, panel in enumerate(others)}
    panels += [replace(panel, id=numbers[panel.id]) for panel in others]
    starts = dict.fromkeys(point for panel in meant for point in panel.shows.points)
    return _numbered(
        replace(
            document,
            surfaces=(mesh, MeshFile(name, mesh.path, mesh.sha256, change)),
            points=(*document.points, *(Point(image_name(point), None, name, point) for point in starts)),
        ),
        panels,
        numbers,
    )


def _numbered(document: Document, panels: list[Panel], numbers: dict[int, int]) -> Document:
    """With these panels, and all that names panels by their numbers before."""
    parts = tuple(part.renumbered(numbers) for part in document.parts)
    return replace(document, panels=tuple(panels), parts=parts, next_id=len(panels))


def image_name(point: str) -> str:
    """Of the point on the changed mesh that another becomes."""
    return f"{point} after"


def without_changed(document: Document) -> Document:
    """Without meshes that are made from others, and all that is on them."""
    made = {mesh.name for mesh in document.surfaces if mesh.change is not None}
    if not made:
        return document
    document = without_surfaces(document, made)
    here = [panel for panel in document.panels if panel.surface not in made]
    panels = [panel for panel in here if not any(part.relates_surfaces for part in panel.shows.parts)]
    panels = panels or _panels_before(document)
    numbers = {panel.id: k for k, panel in enumerate(panels)}
    document = replace(
        document,
        surfaces=tuple(mesh for mesh in document.surfaces if mesh.name not in made),
        points=tuple(point for point in document.points if point.surface not in made),
        panels=tuple(panels),
        fields=tuple(field for field in document.fields if field.surface not in made),
        beside=tuple(each for each in document.beside if each.surface not in made),
    )
    return _numbered(document, [replace(panel, id=numbers[panel.id]) for panel in panels], numbers)


def _panels_before(document: Document) -> list[Panel]:
    """A panel of the first surface, where all that there are show another."""
    first, panel = document.surfaces[0].name, document.panels[0]
    points = [document.point(name).image_of for name in panel.shows.points]
    points += [point.name for point in document.points if point.surface == first]
    spec = panel.shows.specs[0] if panel.shows.specs else Spec.of("biharmonic")
    return [Panel(panel.id, DistanceFrom(spec, next(filter(None, points))), first)]


def partner(document: Document, panel: Panel) -> Panel | None:
    """The panel that shows the same distance after the change, or before it, if there is one."""
    if not panel.shows.is_distance:
        return None
    spec, here = panel.shows.specs[0], document.point(panel.shows.points[0])
    for other in document.panels:
        if not other.shows.is_distance or other.shows.specs[0] != spec or other.surface == panel.surface:
            continue
        there = document.point(other.shows.points[0])
        if there.image_of == here.name or here.image_of == there.name:
            return other
    return None


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
    is_so = _content(again) == _content(replace(document, beside=()))
    return (base, changes[0]) if is_so else (document, None)


def _content(document: Document) -> Document:
    """But for what is known only once the meshes are there."""
    points = (replace(point, at=None) if point.image_of else point for point in document.points)
    return replace(document, points=tuple(points), surfaces=document.surfaces)
