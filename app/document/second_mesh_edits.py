"""Pure edits of documents with a second mesh, and of how each mesh is seen."""

from collections.abc import Sequence
from dataclasses import replace

from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source

from .camera import SecondMeshView, View, view_alike
from .document import Document, MeshFile, Panel, Point, free_names
from .edits import MOST_ADDED, add_panel, put_point, show_distances
from .quantities import DistanceFrom, Quantity, column_names, own_fields
from .removal import without_surfaces

MOST_SHOWN = 2
"""Surfaces that stand beside each other in the window."""


def open_second_mesh(document: Document, mesh: MeshFile, at: Source | None = None) -> Document:
    """Add a second mesh beside the first, under a name of its own, instead of the one that was there.

    Its panels show the same quantities as those of the first, as many as there is room for, from a source of its own at
    `at`, by default the highest vertex. ParameterError where there is no room for any panel, or no first mesh.
    """
    if not document.surfaces:
        raise ParameterError("Open a first mesh before a second one.")
    document = close_second_mesh(document)
    room = MOST_ADDED - len(document.panels)
    if room < 1:
        raise ParameterError(f"There are {len(document.panels)} panels already; remove one first.")
    name = _free_letter(document)
    document = replace(document, surfaces=(*document.surfaces, replace(mesh, name=name)))
    document = replace(
        document, second_views=(*document.second_views, SecondMeshView(name, view_alike(document.camera)))
    )
    shown = list(dict.fromkeys(panel.shows for panel in document.panels if not own_fields(panel.shows)))
    points: dict[str, str] = {}
    for shows in (shown or [DistanceFrom(Spec.of("biharmonic"))])[:room]:
        for point in shows.points:
            if point not in points:
                (points[point],) = free_names("source", 1, [each.name for each in document.points])
                document = put_point(document, points[point], at, name)
        document = add_panel(document, renamed(shows, points), name)
    return document


def close_second_mesh(document: Document) -> Document:
    """Return the first surface alone, without anything that belongs to others."""
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
        second_views=(),
    )
    if document.panels:
        return show_distances(document, lambda panel: panel.shows.relates_surfaces)
    if all(point.name != "source" for point in document.points):
        document = replace(document, points=(*document.points, Point("source", None, first)))
    return add_panel(document, DistanceFrom(Spec.of("biharmonic")), first)


def set_view(document: Document, view: View, surface: str | None = None) -> Document:
    """See a surface of the document, the first if none is named, from elsewhere."""
    if surface is None or not document.surfaces or surface == document.surfaces[0].name:
        # What has been seen from where the first was stays there.
        others = tuple(_view_of(document, mesh.name) for mesh in document.surfaces[1:])
        return replace(document, camera=view, second_views=others)
    return _with_view(document, replace(_view_of(document, surface), camera=view))


def set_up_axis(document: Document, up: str, surface: str | None = None) -> Document:
    """Let another axis of a surface, the first if none is named, point up.

    A camera of one's own would now be askew, and a view that shows the shape is chosen anew.
    """
    if surface is None or not document.surfaces or surface == document.surfaces[0].name:
        return document if up == document.up else replace(document, up=up, camera=view_alike(document.camera))
    before = _view_of(document, surface)
    return document if up == before.up else _with_view(document, SecondMeshView(surface, view_alike(before.camera), up))


def renamed(shows: Quantity, points: dict[str, str]) -> Quantity:
    """Return the same quantity from other points, by the names of the old ones."""
    return shows.with_parts(
        tuple(
            part.moved_to(points.get(part.points[0], part.points[0])) if part.points else part for part in shows.parts
        )
    )


def letter_of(document: Document, panel: Panel) -> str:
    """ "A" for the first surface, "B" for the second; "" where there is but one."""
    names = [mesh.name for mesh in document.surfaces]
    return chr(ord("A") + names.index(panel.surface)) if len(names) > 1 else ""


def panel_names(document: Document, panels: Sequence[Panel], are_short: bool = False) -> list[str]:
    """Return the names of panels for the columns of a table, with the letters of their surfaces where there are two."""
    names = column_names([panel.shows for panel in panels], are_short)
    return [f"{letter_of(document, panel)} {name}".strip() for panel, name in zip(panels, names, strict=True)]


def _view_of(document: Document, surface: str) -> SecondMeshView:
    known = (each for each in document.second_views if each.surface == surface)
    return next(known, SecondMeshView(surface, document.camera, document.up))


def _with_view(document: Document, view: SecondMeshView) -> Document:
    others = tuple(each for each in document.second_views if each.surface != view.surface)
    return replace(document, second_views=(*others, view))


def _free_letter(document: Document) -> str:
    taken = {mesh.name for mesh in document.surfaces}
    return next(letter for letter in "BA" if letter not in taken)
