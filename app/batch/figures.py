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
from ..figures.contact_sheet import as_jpeg, thumbnail
from ..figures.draw import save_figure
from ..figures.export import Surfaces, check_drawable, compute, figure_of, open_document
from ..scene.camera import aimed, frame
from ..session.array_store import ArrayStore
from .jobs import BatchMesh, Computed
from .storage import Folder
from .work_order import SIZE, thumbnail_name


def recipe_for(path: str, mesh: BatchMesh) -> Recipe:
    """Return the recipe with one of the meshes."""
    recipe = recipe_from_text(mesh.wanted.recipe)
    surface = replace(recipe.document.surfaces[0], path=path, sha256="", repairs=mesh.wanted.repairs)
    return replace(recipe, document=replace(recipe.document, surfaces=(surface,)))


def _computed(path: str, mesh: BatchMesh) -> tuple[Recipe, Document, Surfaces, list[Any]]:
    recipe = recipe_for(path, mesh)
    document, surfaces = open_document(recipe, ArrayStore())
    recipe = replace(recipe, document=document)
    check_drawable(recipe, surfaces)
    return recipe, document, surfaces, compute(document, surfaces)


# ---------------------------------------------------------------------- ranges
def length_power(unit: str) -> float:
    """Return the p of a unit mesh units^p, as `Distance.unit` writes it; 0 for units that do not scale with a mesh."""
    word, _, power = unit.removeprefix("1 / ").partition("^")
    sign = 1 if unit.startswith(word) else -1
    return 0.0 if word != "mesh units" else sign * float(power or 1)


def compute_maxima(path: str, mesh: BatchMesh) -> Computed:
    """Compute the largest value (p,) of each panel, 0 where it failed, and the scale of its unit on this mesh.

    The scale is the root of the area to the power of the unit.
    """
    *_, answers = _computed(path, mesh)
    maxima = [float(answer.maximum) for answer in answers]
    root = float(np.sqrt(mesh.surface.face_areas.sum()))
    scales = [root ** length_power(answer.unit) for answer in answers]
    return Computed({"maxima": np.array(maxima)}, {"maxima": maxima, "scales": scales})


def shared_maxima(metadata: Sequence[dict[str, Any]], range: str) -> tuple[float, ...]:
    """Return the maxima of the panels on all meshes, over each mesh's scale with SIZE."""
    if not metadata:
        return ()
    maxima, scales = (np.array([each[name] for each in metadata]) for name in ("maxima", "scales"))
    return tuple(np.max(maxima / scales if range == SIZE else maxima, axis=0).tolist())


def _ended(document: Document, mesh: BatchMesh, answers: Sequence[Any]) -> Document:
    """Return the document with the shared ends of colours; those of the recipe stay."""
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
    """Describe the end of a panel's colours on all meshes, such as "0.6 √area of each mesh"."""
    sign, power = "±" * is_signed, length_power(unit)
    if range != SIZE or not power:
        in_unit = f" {unit}" if power or unit == PERCENTAGE_POINTS else ""
        return f"{sign}{end:.4g}{in_unit} on all meshes"
    known = {1.0: " √area", -1.0: " / √area"}
    return f"{sign}{end:.4g}{known.get(power, f' √area^{power:g}')} of each mesh"


# ---------------------------------------------------------------------- drawing
def draw_figure(path: str, mesh: BatchMesh, folder: Folder, file: str) -> dict[str, Any]:
    """Draw the recipe of a mesh into a file, and a thumbnail; return the metadata.

    Raises SolverError if a panel failed.
    """
    recipe, document, surfaces, answers = _computed(path, mesh)
    failures = [f"{answer.label}: {answer.failure}" for answer in answers if answer.failure]
    if failures:
        raise SolverError(" ".join(failures))
    document = replace(document, camera=_fit(document.camera, mesh.surface, document))
    document = _ended(document, mesh, answers)
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
            "accuracy_sources": answer.accuracy.sources,
        }
        for panel, answer, end in zip(document.panels, answers, ends, strict=True)
    ]
    return {"panels": panels, "range": mesh.wanted.range}


def _fit(view: View, surface: Surface, document: Document) -> View:
    """Return a standard view as it is, and a camera of the same direction that fits the shape."""
    if not isinstance(view, Camera):
        return view
    axes, used = frame(view), surface.vertices[surface.component_of_vertex >= 0]
    return aimed(used, 1.0, axes[:, 2], axes[:, 1], 0.0, document.parallel_projection)
