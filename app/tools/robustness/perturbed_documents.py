"""Documents that show each distance before and after a perturbation of the mesh, and the difference."""

from dataclasses import replace
from typing import TYPE_CHECKING

from bihdist_core.applications.changes import Perturbation, Runs
from bihdist_core.errors import ParameterError

from ...document.derived_surfaces import COLUMNS, changed_mesh, numbered, without_changed
from ...document.document import Document, Panel, Point
from ...document.edits import MOST_ADDED, add_another
from ...document.quantities import DistanceFrom
from .quantity import DistanceChange

if TYPE_CHECKING:
    from bihdist_core.arrays import IntArray

PERTURBED = "B"
"""The name of the perturbed mesh in documents."""


def with_perturbed(document: Document, change: Perturbation, with_others: bool = False) -> Document:
    """Return a document of one mesh with the perturbed mesh as well: three panels for each distance.

    With `with_others`, panels that show no distance stay behind those that do. Raises ParameterError for several
    meshes, for a panel without a distance otherwise, and if there is no distance at all.
    """
    if len(document.surfaces) != 1:
        raise ParameterError(f"Only one mesh can be changed, and there are {len(document.surfaces)}.")
    (mesh,) = document.surfaces
    name = PERTURBED if mesh.name != PERTURBED else "A"
    meant = [panel for panel in document.panels if panel.shows.is_distance]
    others = [panel for panel in document.panels if panel not in meant]
    if others and not with_others:
        raise ParameterError(f"Changes are shown for distances only; {others[0].shows} is not a distance.")
    if not meant:
        raise ParameterError("Changes are shown for distances; let a panel show one.")
    panels: list[Panel] = []
    for panel in meant:
        image = DistanceFrom(panel.shows.specs[0], image_name(panel.shows.points[0]))
        k = len(panels)
        panels.append(replace(panel, id=k))
        panels.append(Panel(k + 1, image, name, panel.maximum))
        panels.append(Panel(k + 2, DistanceChange(image.spec, image.point), name))
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
    """Return the name of a point's image on the perturbed mesh."""
    return f"{point} after"


def split_perturbed(document: Document) -> tuple[Document, Perturbation | None]:
    """Return the document and the perturbation that `with_perturbed` made this one from; itself and None for others."""
    changes = [mesh.change for mesh in document.surfaces if mesh.change is not None]
    if len(changes) != 1:
        return document, None
    base = without_changed(document)
    try:
        again = with_perturbed(base, changes[0])
    except ParameterError:
        return document, None
    is_so = _content(again) == _content(replace(document, second_views=()))
    return (base, changes[0]) if is_so else (document, None)


def _content(document: Document) -> Document:
    """Return the document without what is known only once the meshes are there."""
    points = (replace(point, at=None) if point.image_of else point for point in document.points)
    return replace(document, points=tuple(points), surfaces=document.surfaces)


def perturb_mesh(document: Document, change: Perturbation) -> Document:
    """Perturb the first mesh in this way only; remove the perturbed mesh if that changes nothing.

    A mesh that is perturbed already keeps its panels. Raises ParameterError as `with_perturbed`.
    """
    if change.changes_nothing:
        return without_changed(document)
    now = changed_mesh(document)
    if now is None:
        return with_perturbed(document, change, with_others=True)
    meshes = tuple(replace(mesh, change=change) if mesh.name == now.name else mesh for mesh in document.surfaces)
    # Where the images are is found anew: what was nearest may be gone, or there again.
    points = tuple(replace(p, at=None) if p.image_of and p.surface == now.name else p for p in document.points)
    return replace(document, surfaces=meshes, points=points)


def perturbation_of(document: Document) -> Perturbation:
    """Return the perturbation of the first mesh."""
    mesh = changed_mesh(document)
    return Perturbation() if mesh is None or mesh.change is None else mesh.change


def has_other_mesh(document: Document) -> bool:
    """Return whether there is a second mesh that is not made from the first."""
    return len(document.surfaces) > 1 and changed_mesh(document) is None


def add_row(document: Document) -> Document | None:
    """Add a distance of a perturbed mesh: panels of it before and after and of the difference, behind the others.

    Returns the document itself if there are many panels, None without a perturbed mesh.
    """
    if changed_mesh(document) is None:
        return None
    if len(document.panels) > MOST_ADDED:
        return document
    change = perturbation_of(document)
    return with_perturbed(add_another(without_changed(document), is_distance=True), change, with_others=True)


def check_can_perturb(document: Document) -> None:
    """Raise ParameterError unless there is one mesh, or a second made from it, and a panel with a distance."""
    if has_other_mesh(document):
        raise ParameterError("Close the second mesh first: the changed mesh takes its place.")
    if not any(panel.shows.is_distance for panel in document.panels):
        raise ParameterError("Changes are shown for distances; let a panel show one.")


def cut_by(cut: Runs, faces: "IntArray", is_restored: bool = False) -> Runs:
    """Return the faces that are cut out, with these (k,) added to them or, if they are restored, taken away."""
    import numpy as np

    from ...document.runs import ids_of, runs_of

    known = ids_of(cut) if cut else np.empty(0, np.int64)
    return runs_of(np.setdiff1d(known, faces) if is_restored else np.union1d(known, faces))
