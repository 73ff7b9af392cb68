"""Edits of a document that shows what distances withstand (`changing`); pure functions, as in `edits`."""

from dataclasses import replace

import numpy as np

from bihdist_core.applications.changes import Perturbation, Runs
from bihdist_core.arrays import IntArray
from bihdist_core.errors import ParameterError

from .document import Document
from .edits import add_another, show_in
from .perturbation import changed_mesh, with_changed, without_changed
from .quantities import Quantity
from .runs import ids_of, runs_of


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


def cut_by(cut: Runs, faces: IntArray, is_restored: bool = False) -> Runs:
    """What is cut out of a surface, with more faces (k,) or, if they are restored, without these."""
    known = ids_of(cut) if cut else np.empty(0, np.int64)
    return runs_of(np.setdiff1d(known, faces) if is_restored else np.union1d(known, faces))


def add_row(document: Document) -> Document:
    """One more distance of a changed mesh, before and after and the difference, in panels at the end of the others."""
    change = change_as(document)
    return with_changed(add_another(without_changed(document)), change, with_others=True)


def show_in_row(document: Document, panel: int, shows: Quantity) -> Document:
    """Show another quantity in a panel; another distance goes into all three panels of a change.

    Of these, before and after are compared with each other.
    """
    before = document.panel(panel)
    if changed_mesh(document) is None or not _is_in_row(shows):
        return show_in(document, panel, shows)
    if not _is_in_row(before.shows):
        return show_in(document, panel, shows)
    old, roots = before.shows.specs, {point.name: point.image_of or point.name for point in document.points}
    root = roots[before.shows.points[0]]
    for other in document.panels:
        now = other.shows
        if _is_in_row(now) and now.specs == old and roots[now.points[0]] == root:
            document = show_in(document, other.id, now.with_spec(shows.specs[0]))
    return document


def _is_in_row(shows: Quantity) -> bool:
    """Whether it is a distance before or after a change, or what the change does to it."""
    return shows.is_distance or shows.compares_meshes


def refuse_change(document: Document) -> None:
    """ParameterError, in a sentence, where `can_change` says no."""
    if len(document.surfaces) > 1 and changed_mesh(document) is None:
        raise ParameterError("Close the mesh beside first: its place is that of the changed mesh.")
    if not can_change(document):
        raise ParameterError("What a change does is shown of distances; let a panel show one.")
