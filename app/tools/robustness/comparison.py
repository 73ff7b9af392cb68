"""A document that shows what distances withstand: each before and after a change to the mesh, and the difference."""

from dataclasses import replace

from bihdist_core.applications.changes import Perturbation
from bihdist_core.errors import ParameterError

from ...document.derived_surfaces import COLUMNS, changed_mesh, numbered, without_changed
from ...document.document import Document, Panel, Point
from ...document.edits import MOST_ADDED, add_another
from ...document.quantities import DistanceFrom
from .quantity import ChangeOf

CHANGED = "B"
"""The name of the changed mesh in documents."""


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
        panels.append(Panel(k + 2, ChangeOf(image.spec, image.point), name))
    numbers = {panel.id: COLUMNS * k for k, panel in enumerate(meant)}
    numbers |= {panel.id: len(panels) + k for k, panel in enumerate(others)}
    panels += [replace(panel, id=numbers[panel.id]) for panel in others]
    starts = dict.fromkeys(point for panel in meant for point in panel.shows.points)
    return numbered(
        replace(
            document,
            surfaces=(mesh, replace(mesh, name=name, change=change)),
            points=(*document.points, *(Point(image_name(point), None, name, point) for point in starts)),
        ),
        panels,
        numbers,
    )


def image_name(point: str) -> str:
    """Of the point on the changed mesh that another becomes."""
    return f"{point} after"


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


def change_mesh(document: Document, change: Perturbation) -> Document:
    """With the first mesh changed like this and in no other way; its panels alone if that changes nothing.

    Where it has been changed already the panels stay as they are.  ParameterError as `with_changed`.
    """
    if change.changes_nothing:
        return without_changed(document)
    now = changed_mesh(document)
    if now is None:
        return with_changed(document, change, with_others=True)
    meshes = tuple(replace(mesh, change=change) if mesh.name == now.name else mesh for mesh in document.surfaces)
    # Where the images are is found anew: what was nearest may be gone, or there again.
    points = tuple(replace(p, at=None) if p.image_of and p.surface == now.name else p for p in document.points)
    return replace(document, surfaces=meshes, points=points)


def change_as(document: Document) -> Perturbation:
    """What is done to the first mesh."""
    mesh = changed_mesh(document)
    return Perturbation() if mesh is None or mesh.change is None else mesh.change


def can_change(document: Document) -> bool:
    """Whether there is one mesh, or a second that is made from it, and a panel with a distance."""
    alone = len(document.surfaces) == 1 or changed_mesh(document) is not None
    return alone and any(panel.shows.is_distance for panel in document.panels)


def add_row(document: Document) -> Document | None:
    """One more distance of a changed mesh, before and after and the difference, in panels at the end of the others.

    Where there are many already the document as it is; None without a changed mesh.
    """
    if changed_mesh(document) is None:
        return None
    if len(document.panels) > MOST_ADDED:
        return document
    change = change_as(document)
    return with_changed(add_another(without_changed(document)), change, with_others=True)


def refuse_change(document: Document) -> None:
    """ParameterError, in a sentence, where `can_change` says no."""
    if len(document.surfaces) > 1 and changed_mesh(document) is None:
        raise ParameterError("Close the mesh beside first: its place is that of the changed mesh.")
    if not can_change(document):
        raise ParameterError("What a change does is shown of distances; let a panel show one.")
