"""From a recipe to a file: the fields computed, the figure drawn, and the recipe written beside it."""

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from bihdist_core import Laplacian, OutputError, ParameterError, Surface, read_surface
from bihdist_core.progress import Progress, part
from bihdist_core.whole_file import check_output, whole_file

from .camera import Camera
from .figure_size import Size
from .figures import FIGURE_FORMATS, Figure, FigurePanel, Mark, Zoom, check_offscreen, save_figure
from .recipe import Recipe, RecipePanel, checksum, is_recipe, mesh_reference, recipe_text
from .samples import mesh_path
from .session import first_source
from .state import PanelState
from .style import STYLES


def check_export(path: str | os.PathLike[str]) -> Path:
    """Before long work: that a figure and its recipe can be written; the recipe's path.  OutputError if not."""
    check_output(path, FIGURE_FORMATS)
    check_offscreen()
    recipe_path = Path(path).with_suffix(".json")
    check_output(recipe_path, (".json",))
    if recipe_path.exists() and not is_recipe(recipe_path):
        raise OutputError(f"{recipe_path}, where the recipe would go, is another file; give the figure another name.")
    return recipe_path


def load_mesh(recipe: Recipe) -> tuple[Surface, Recipe]:
    """The recipe's surface, and the recipe with its checksum and sources.

    Raises ParameterError if the mesh is missing or has changed since the recipe was written.
    """
    path = mesh_path(recipe.mesh)
    if not os.path.exists(path):
        raise ParameterError(f"The mesh {recipe.mesh} is not there; name another with --mesh.")
    surface, found = read_surface(path), checksum(path)
    if recipe.sha256 and found != recipe.sha256:
        raise ParameterError(
            f"The mesh {recipe.mesh} is not what it was when the recipe was written (its checksum differs); "
            "with --mesh it is drawn all the same."
        )
    panels = tuple(replace(p, source=first_source(surface)) if p.source is None else p for p in recipe.panels)
    return surface, replace(recipe, sha256=found, panels=panels)


def compute(recipe: Recipe, surface: Surface, progress: Progress | None = None) -> list[tuple[np.ndarray, str, str]]:
    """For each panel its field (n,), and the label and unit of its distance."""
    surface.check_vertices([panel.source for panel in recipe.panels])
    laplacian = Laplacian(surface, recipe.areas)
    built: dict[PanelState, object] = {}
    answers = []
    for k, panel in enumerate(recipe.panels):
        step = part(progress, k / len(recipe.panels), (k + 1) / len(recipe.panels))
        if panel.state not in built:
            built[panel.state] = panel.state.build(laplacian, part(step, 0, 0.9))
        distance = built[panel.state]
        answers.append((distance.from_source(panel.source, part(step, 0.9, 1)), distance.label, distance.unit))
    return answers


def figure_of(recipe: Recipe, surface: Surface, answers: Sequence[tuple[np.ndarray, str, str]]) -> Figure:
    """The figure a recipe describes, from its panels' fields, labels and units."""
    if recipe.style not in STYLES:
        raise ParameterError(f"There is no style {recipe.style!r}; choose one of {', '.join(STYLES)}.")
    if not recipe.panels:
        raise ParameterError("The recipe has no panels.")
    several = len({panel.source for panel in recipe.panels}) > 1
    panels = tuple(
        _figure_panel(recipe, panel, surface, answer, several)
        for panel, answer in zip(recipe.panels, answers, strict=True)
    )
    return Figure(
        panels,
        columns=recipe.columns,
        size=Size.parse(recipe.size) if recipe.size else Size(),
        style=STYLES[recipe.style],
        shared_range=recipe.shared_range,
        transparent=recipe.transparent,
        crop=recipe.crop,
    )


def write_figure(figure: Figure, recipe: Recipe, path: str, version: str, progress: Progress | None = None) -> None:
    """The figure at `path` and its recipe beside it, both or neither."""
    recipe_path = check_export(path)
    written = replace(recipe, mesh=mesh_reference(recipe.mesh, recipe_path))
    with whole_file(recipe_path) as temporary:
        temporary.write_text(recipe_text(written, version), encoding="utf-8")
        save_figure(figure, path, progress)


def export(recipe: Recipe, path: str, version: str, progress: Progress | None = None) -> tuple[Figure, Recipe]:
    """Everything: read, compute, draw, write.  Returns the figure, and the recipe with its sources."""
    check_export(path)
    surface, recipe = load_mesh(recipe)
    # What cannot be drawn is refused before the long work, with fields that are nothing.
    nothing = np.zeros(len(surface.vertices))
    figure_of(recipe, surface, [(nothing, "", "")] * len(recipe.panels))
    figure = figure_of(recipe, surface, compute(recipe, surface, part(progress, 0.0, 0.6)))
    write_figure(figure, recipe, path, version, part(progress, 0.6, 1.0))
    return figure, recipe


def _figure_panel(
    recipe: Recipe, panel: RecipePanel, surface: Surface, answer: tuple[np.ndarray, str, str], several: bool
) -> FigurePanel:
    field, label, unit = answer
    return FigurePanel(
        surface,
        field,
        heading=f"{label}, from {panel.source}" if several else label,
        hint=panel.state.hint if recipe.hints else "",
        label=label,
        unit=unit,
        maximum=panel.maximum,
        isolines=recipe.isolines,
        views=tuple(
            v if isinstance(v, str) else Camera(v.position, v.focal_point, v.up, v.extent) for v in recipe.views
        ),
        marks=(Mark(panel.source), *(Mark(v, _anchor_value(v, value, field)) for v, value in recipe.anchors)),
        zooms=tuple(Zoom(z.vertex, z.factor, z.corner) for z in recipe.zooms),
        height=recipe.height,
    )


def _anchor_value(vertex: int, value: float | None, field: np.ndarray) -> float:
    """An anchor without a value of its own shows the field's."""
    if value is not None:
        return value
    return float(np.nan_to_num(field[vertex])) if 0 <= vertex < len(field) else 0.0
