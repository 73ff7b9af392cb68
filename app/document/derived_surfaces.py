"""Surfaces of a document that are made from others: which they are, and the document without them."""

from dataclasses import replace

from bihdist_core.distances.distance_types import Spec

from .document import Document, MeshFile, Panel
from .quantities import DistanceFrom
from .removal import without_surfaces

COLUMNS = 3
"""Panels in a row where there is one: before, after, difference."""


def changed_mesh(document: Document) -> MeshFile | None:
    """Return the mesh that is made from another, if there is one."""
    return next((mesh for mesh in document.surfaces if mesh.change is not None), None)


def numbered(document: Document, panels: list[Panel], numbers: dict[int, int]) -> Document:
    """Return the document with these panels alone, and their ids renumbered by `numbers`, old to new, everywhere."""
    parts = tuple(part.renumbered(numbers) for part in document.parts)
    return replace(document, panels=tuple(panels), parts=parts, next_id=len(panels))


def without_changed(document: Document) -> Document:
    """Remove meshes that are made from others, and all that is on them."""
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
        second_views=tuple(each for each in document.second_views if each.surface not in made),
    )
    return numbered(document, [replace(panel, id=numbers[panel.id]) for panel in panels], numbers)


def _panels_before(document: Document) -> list[Panel]:
    """Return a panel of the first surface, where all that there are show another."""
    first, panel = document.surfaces[0].name, document.panels[0]
    points = [document.point(name).image_of for name in panel.shows.points]
    points += [point.name for point in document.points if point.surface == first]
    spec = panel.shows.specs[0] if panel.shows.specs else Spec.of("biharmonic")
    return [Panel(panel.id, DistanceFrom(spec, next(filter(None, points))), first)]


def partner(document: Document, panel: Panel) -> Panel | None:
    """Return the panel that shows the same distance after the change, or before it, if there is one."""
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
