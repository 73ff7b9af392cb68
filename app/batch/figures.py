"""One recipe on many meshes, and where their colours end."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from bihdist_core import Surface
from bihdist_core.distances.difference import PERCENTAGE_POINTS
from bihdist_core.errors import SolverError

from ..document.camera import Camera, View
from ..document.document import Document
from ..document.file import recipe_from_text
from ..document.page import Recipe
from ..document.repairs import Repairs
from ..figures.contact_sheet import as_jpeg, thumbnail
from ..figures.draw import save_figure
from ..figures.export import Surfaces, check_drawable, compute, figure_of, open_document
from ..scene.camera import Margins, aimed, frame
from ..session.array_store import ArrayStore
from .storage import Folder
from .work_order import SIZE, thumbnail_name
from .works import Made, Mesh


def recipe_for(path: str, mesh: Mesh) -> Recipe:
    """The recipe of all meshes on one of them."""
    recipe = recipe_from_text(mesh.wanted.recipe)
    repairs = Repairs(cut=mesh.wanted.file_for(mesh.wanted.cut, mesh.name), merge=mesh.wanted.merge)
    surface = replace(recipe.document.surfaces[0], path=path, sha256="", repairs=repairs)
    return replace(recipe, document=replace(recipe.document, surfaces=(surface,)))


def _computed(path: str, mesh: Mesh) -> tuple[Recipe, Document, Surfaces, list[Any]]:
    recipe = recipe_for(path, mesh)
    document, surfaces = open_document(recipe, ArrayStore())
    recipe = replace(recipe, document=document)
    check_drawable(recipe, surfaces)
    return recipe, document, surfaces, compute(document, surfaces)


# ---------------------------------------------------------------------- ranges
def length_power(unit: str) -> float:
    """The p of a unit that is mesh units^p, as `Distance.unit` writes it; 0 for what does not scale with a mesh."""
    if unit == "1 / mesh units":
        return -1.0
    word, _, power = unit.partition("^")
    return 0.0 if word != "mesh units" else float(power or 1)


def maxima_made(path: str, mesh: Mesh) -> Made:
    """(p,) the largest value of each panel, 0 where it failed; and what a panel's unit is on this mesh, in mesh units:
    the root of its area to the unit's power."""
    *_, answers = _computed(path, mesh)
    maxima = [float(answer.maximum) for answer in answers]
    root = float(np.sqrt(mesh.surface.face_areas.sum()))
    scales = [root ** length_power(answer.unit) for answer in answers]
    return Made({"maxima": np.array(maxima)}, {"maxima": maxima, "scales": scales})


def shared_ends(facts: Sequence[dict[str, Any]], range: str) -> tuple[float, ...]:
    """Where the panels end: at the largest value of all meshes, over each mesh's scale with SIZE."""
    if not facts:
        return ()
    maxima, scales = (np.array([each[name] for each in facts]) for name in ("maxima", "scales"))
    return tuple(np.max(maxima / scales if range == SIZE else maxima, axis=0).tolist())


def _ended(document: Document, mesh: Mesh, answers: Sequence[Any]) -> Document:
    """With the ends that all meshes share; those that the recipe names stay."""
    wanted = mesh.wanted
    if not wanted.maxima:
        return document
    root = float(np.sqrt(mesh.surface.face_areas.sum())) if wanted.range == SIZE else 1.0
    panels = tuple(
        replace(panel, maximum=end * root ** length_power(answer.unit) / answer.scale or None)
        if panel.maximum is None
        else panel
        for panel, end, answer in zip(document.panels, wanted.maxima, answers, strict=True)
    )
    return replace(document, panels=panels)


def end_in_words(end: float, unit: str, range: str, is_signed: bool) -> str:
    """Where the colours of a panel end on all meshes: 0.6 √area of each mesh."""
    sign, power = "±" * is_signed, length_power(unit)
    if range != SIZE or not power:
        in_unit = f" {unit}" if power or unit == PERCENTAGE_POINTS else ""
        return f"{sign}{end:.4g}{in_unit} on all meshes"
    known = {1.0: " √area", -1.0: " / √area"}
    return f"{sign}{end:.4g}{known.get(power, f' √area^{power:g}')} of each mesh"


# ---------------------------------------------------------------------- drawing
def figure_made(path: str, mesh: Mesh, folder: Folder, file: str) -> dict[str, Any]:
    """Draw the recipe of a mesh into a file, and a thumbnail; what is to be said of it.

    SolverError if a panel of it failed.
    """
    recipe, document, surfaces, answers = _computed(path, mesh)
    failures = [f"{answer.label}: {answer.failure}" for answer in answers if answer.failure]
    if failures:
        raise SolverError(" ".join(failures))
    document = _ended(_fitted(document, mesh.surface), mesh, answers)
    views = tuple(_fit(view, mesh.surface, document) for view in recipe.page.views)
    recipe = replace(recipe, document=document, page=replace(recipe.page, views=views))
    figure = replace(figure_of(recipe, surfaces, answers), is_of_set=bool(mesh.wanted.maxima))
    with folder.writing(file) as temporary:
        save_figure(figure, temporary)
        small = as_jpeg(thumbnail(temporary.read_bytes()))
    folder.write(thumbnail_name(mesh.name), small)
    ends = mesh.wanted.maxima or [0.0] * len(answers)
    panels = [
        {
            "shows": str(panel.shows).replace(" - ", " − "),
            "label": answer.label,
            "unit": answer.unit,
            "maximum": float(answer.maximum),
            "colours_end_at": float(answer.maximum if panel.maximum is None else panel.maximum * answer.scale),
            "of_set": end_in_words(end, answer.unit, mesh.wanted.range, answer.is_signed),
            "accuracy": answer.accuracy.share,
            "accuracy_text": answer.accuracy.text,
        }
        for panel, answer, end in zip(document.panels, answers, ends, strict=True)
    ]
    return {"panels": panels, "range": mesh.wanted.range}


def _fitted(document: Document, surface: Surface) -> Document:
    return replace(document, camera=_fit(document.camera, surface, document))


def _fit(view: View, surface: Surface, document: Document) -> View:
    """A standard view as it is, which fits any shape; of a camera the direction and what is up, as near as it fits."""
    if not isinstance(view, Camera):
        return view
    axes, used = frame(view), surface.vertices[surface.component_of_vertex >= 0]
    return aimed(used, 1.0, axes[:, 2], axes[:, 1], Margins(0, 0, 0), document.projection == "orthographic")
