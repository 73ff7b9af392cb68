"""Edits of documents with a second surface beside the first; pure functions, as in `edits`."""

from dataclasses import replace

from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source

from .beside import Beside
from .camera import View, view_alike
from .document import Document, MeshFile, Panel, Point, free_names
from .edits import MOST_ADDED, add_panel, put_point, show_distances
from .quantities import DistanceFrom, Quantity, own_fields
from .removal import without_surfaces

MOST_SHOWN = 2
"""Surfaces that stand beside each other in the window."""


def open_beside(document: Document, mesh: MeshFile, at: Source | None = None) -> Document:
    """A second mesh beside the first, under a name of its own; the one that stood there goes.

    Panels of it show what those of the first do, from a source of its own, as many as there is room for.  at: that
    source, the highest vertex if None.  ParameterError where there is no room for any panel, or nothing that the mesh
    could stand beside.
    """
    if not document.surfaces:
        raise ParameterError("There is nothing to open a mesh beside; open the first one before.")
    document = close_beside(document)
    room = MOST_ADDED - len(document.panels)
    if room < 1:
        raise ParameterError(f"There are {len(document.panels)} panels already; remove one first.")
    name = _free_letter(document)
    document = replace(document, surfaces=(*document.surfaces, replace(mesh, name=name)))
    document = replace(document, beside=(*document.beside, Beside(name, view_alike(document.camera))))
    shown = list(dict.fromkeys(panel.shows for panel in document.panels if not own_fields(panel.shows)))
    points: dict[str, str] = {}
    for shows in (shown or [DistanceFrom(Spec.of("biharmonic"))])[:room]:
        for point in shows.points:
            if point not in points:
                (points[point],) = free_names("source", 1, [each.name for each in document.points])
                document = put_point(document, points[point], at, name)
        document = add_panel(document, renamed(shows, points), name)
    return document


def close_beside(document: Document) -> Document:
    """The first surface alone, without anything that belongs to others."""
    if len(document.surfaces) < 2:
        return document
    first = document.surfaces[0].name
    document = without_surfaces(document, {mesh.name for mesh in document.surfaces[1:]})
    document = replace(
        document,
        surfaces=document.surfaces[:1],
        points=tuple(point for point in document.points if point.surface == first),
        panels=document.panels_of(first),
        fields=tuple(field for field in document.fields if field.surface == first),
        beside=(),
    )
    if document.panels:
        return show_distances(document, lambda panel: panel.shows.relates_surfaces)
    if all(point.name != "source" for point in document.points):
        document = replace(document, points=(*document.points, Point("source", None, first)))
    return add_panel(document, DistanceFrom(Spec.of("biharmonic")), first)


def see(document: Document, view: View, surface: str | None = None) -> Document:
    """A surface of the document, the first if none is named, is seen from elsewhere."""
    if surface is None or not document.surfaces or surface == document.surfaces[0].name:
        # What has been seen from where the first was stays there.
        beside = tuple(_beside_of(document, mesh.name) for mesh in document.surfaces[1:])
        return replace(document, camera=view, beside=beside)
    return _with_beside(document, replace(_beside_of(document, surface), camera=view))


def stand_beside(document: Document, up: str, surface: str) -> Document:
    """Another way up of a surface that stands beside the first; a camera of one's own would now be askew."""
    before = _beside_of(document, surface)
    return document if up == before.up else _with_beside(document, Beside(surface, view_alike(before.camera), up))


def renamed(shows: Quantity, points: dict[str, str]) -> Quantity:
    """The same quantity from other points, by the names of the old ones."""
    return shows.with_parts(
        tuple(
            part.moved_to(points.get(part.points[0], part.points[0])) if part.points else part for part in shows.parts
        )
    )


def letter_of(document: Document, panel: Panel) -> str:
    """ "A" for the first surface, "B" for the second; "" where there is but one."""
    names = [mesh.name for mesh in document.surfaces]
    return chr(ord("A") + names.index(panel.surface)) if len(names) > 1 else ""


def _beside_of(document: Document, surface: str) -> Beside:
    known = (each for each in document.beside if each.surface == surface)
    return next(known, Beside(surface, document.camera, document.up))


def _with_beside(document: Document, beside: Beside) -> Document:
    others = tuple(each for each in document.beside if each.surface != beside.surface)
    return replace(document, beside=(*others, beside))


def _free_letter(document: Document) -> str:
    taken = {mesh.name for mesh in document.surfaces}
    return next(letter for letter in "BA" if letter not in taken)
