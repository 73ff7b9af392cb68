"""From a recipe to a file: the fields computed, the figure drawn, and the recipe written beside it."""

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from bihdist_core import Laplacian, OutputError, ParameterError, SolverError, Surface, read_surface
from bihdist_core.distances.kinds import Spec
from bihdist_core.progress import Progress, part
from bihdist_core.whole_file import check_output, whole_file

from .answers import Answer, Asked
from .camera import Camera
from .figure_size import Size
from .figures import FIGURE_FORMATS, Figure, FigurePanel, Mark, Zoom, check_offscreen, save_figure
from .recipe import Recipe, RecipePanel, checksum, is_recipe, mesh_reference, recipe_text
from .samples import mesh_path
from .session import first_source
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
        name = recipe.mesh if len(recipe.mesh) <= 200 else f"{recipe.mesh[:100]}..."
        raise ParameterError(f"The mesh {name} is not there; name another with --mesh.")
    surface, found = read_surface(path), checksum(path)
    if recipe.sha256 and found != recipe.sha256:
        raise ParameterError(
            f"The mesh {recipe.mesh} is not what it was when the recipe was written (its checksum differs); "
            "with --mesh it is drawn all the same."
        )
    panels = tuple(replace(p, source=first_source(surface)) if p.source is None else p for p in recipe.panels)
    return surface, replace(recipe, sha256=found, panels=panels)


def asked(laplacian: Laplacian, spec: Spec) -> Asked:
    """A panel's distance, not yet made."""
    return Asked(lambda progress: spec.build(laplacian, progress), str(spec))


def compute(recipe: Recipe, surface: Surface, progress: Progress | None = None) -> list[Answer]:
    """For each panel its answer; SolverError if all of them are failures."""
    surface.check_vertices([panel.source for panel in recipe.panels])
    laplacian = Laplacian(surface, recipe.areas)
    distances: dict[Spec, Asked] = {}
    answers = []
    for k, panel in enumerate(recipe.panels):
        step = part(progress, k / len(recipe.panels), (k + 1) / len(recipe.panels))
        distance = distances.setdefault(panel.spec, asked(laplacian, panel.spec))
        answers.append(distance.answer(panel.source, step))
    refuse_if_nothing(answers)
    return answers


def refuse_if_nothing(answers: Sequence[Answer]) -> None:
    """SolverError if all of them are failures: a figure of bare shapes helps nobody."""
    if answers and all(answer.failure for answer in answers):
        raise SolverError(" ".join(dict.fromkeys(answer.failure for answer in answers)))


def figure_of(recipe: Recipe, surface: Surface, answers: Sequence[Answer]) -> Figure:
    """The figure a recipe describes, from its panels' answers."""
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


def export(
    recipe: Recipe, path: str, version: str, progress: Progress | None = None
) -> tuple[Figure, Recipe, list[Answer]]:
    """Everything: read, compute, draw, write.  Returns the figure, the recipe with its sources, and the answers."""
    check_export(path)
    surface, recipe = load_mesh(recipe)
    # What cannot be drawn is refused before the long work.
    figure_of(recipe, surface, [Answer(label="")] * len(recipe.panels))
    answers = compute(recipe, surface, part(progress, 0.0, 0.6))
    figure = figure_of(recipe, surface, answers)
    write_figure(figure, recipe, path, version, part(progress, 0.6, 1.0))
    return figure, recipe, answers


def _figure_panel(recipe: Recipe, panel: RecipePanel, surface: Surface, answer: Answer, several: bool) -> FigurePanel:
    return FigurePanel(
        surface,
        answer.field,
        heading=f"{answer.label}, from {panel.source}" if several else answer.label,
        hint=panel.spec.kind.hint if recipe.hints else "",
        label="" if answer.failure else answer.label,
        unit=answer.unit,
        failure=answer.failure,
        maximum=panel.maximum,
        isolines=recipe.isolines,
        views=tuple(
            v if isinstance(v, str) else Camera(v.position, v.focal_point, v.up, v.extent) for v in recipe.views
        ),
        marks=(Mark(panel.source), *(Mark(v, _anchor_value(v, value, answer)) for v, value in recipe.anchors)),
        zooms=tuple(Zoom(z.vertex, z.factor, z.corner) for z in recipe.zooms),
        height=0.0 if answer.failure else recipe.height,
    )


def _anchor_value(vertex: int, value: float | None, answer: Answer) -> float:
    """An anchor without a value of its own shows the field's."""
    if value is not None:
        return value
    known = answer.field is not None and 0 <= vertex < len(answer.field)
    return float(answer.field[vertex]) if known and answer.field[vertex] > 0 else 0.0
