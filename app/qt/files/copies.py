"""Copies of what the window shows: a picture, and a line of code that draws it."""

import hashlib
from dataclasses import replace
from pathlib import Path
from typing import Any

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError, SurfacePoint
from bihdist_core.arrays import AnyArray
from bihdist_core.distances.answers import Answer

from ...document.file import recipe_text
from ...document.file_names import file_name
from ...document.option import curves_in
from ...document.page import Recipe
from ...figures import one_line
from ...figures.draw import whole_picture
from ...figures.export import Surfaces, figure_of
from ...session.questions import vertex_at
from ...session.recipe_file import recipe_written
from ...version import version
from .. import remembered
from ..context import Context
from .curve_files import CurveFiles
from .exports import Exports
from .preview import image_of

MOST = 8000
"""The longest side of a picture on the clipboard, in pixels."""

SHOWN = 70
"""Characters of a copied line in the message about it."""

INCH = 0.0254


def copy_line(context: Context, recipe: Recipe, surfaces: Surfaces, is_python: bool) -> str:
    """Put the line that draws a figure on the clipboard, tell the user, and return the line."""
    recipe = _at_vertices(recipe, surfaces)
    output = f"{_file_name(recipe)}.{recipe.page.format or 'png'}"
    reason = one_line.why_not(recipe)
    if not reason:
        files = {curve: context[CurveFiles].path_of(curve) for curve in curves_in(recipe.document)}
        line = (one_line.python_line if is_python else one_line.command_line)(recipe, output, files)
    else:
        path = str(_kept(recipe, context.session.given))
        line = (one_line.recipe_python_line if is_python else one_line.recipe_command_line)(path, output)
    short = line if len(line) <= SHOWN else f"{line[: SHOWN - 2]}…"
    context.copy(line, f"{reason} The copied line uses a saved recipe." if reason else f"Copied: {short}")
    return line


def copy_picture(context: Context, recipe: Recipe, surfaces: Surfaces, answers: list[Answer]) -> None:
    """Draw the figure in the background, then put it on the clipboard."""
    renderer, figure = context[Exports].previews, figure_of(recipe, surfaces, answers)
    _Waiting(renderer, context).number = renderer.ask("copy", whole_picture, figure, MOST)
    context.tell("Drawing the picture…")


class _Waiting(QtCore.QObject):
    """Waits for one picture."""

    def __init__(self, renderer: QtCore.QObject, context: Context) -> None:
        super().__init__(renderer)
        self._context, self.number = context, 0
        renderer.answered.connect(self._take)
        renderer.refused.connect(self._refuse)
        renderer.dropped.connect(self._ends)

    def _ends(self, number: int) -> bool:
        is_own = number == self.number
        if is_own:
            self.deleteLater()
        return is_own

    def _take(self, number: int, found: tuple[AnyArray, float]) -> None:
        if self._ends(number):
            pixels, per_inch = found
            image = image_of(pixels)
            image.setDotsPerMeterX(round(per_inch / INCH))
            image.setDotsPerMeterY(round(per_inch / INCH))
            QtWidgets.QApplication.clipboard().setImage(image)
            self._context.tell(f"Copied the picture, {image.width()} × {image.height()} pixels")

    def _refuse(self, number: int, sentence: str) -> None:
        if self._ends(number):
            self._context.fail(sentence)


def _at_vertices(recipe: Recipe, surfaces: Surfaces) -> Recipe:
    """Return the recipe with marks in faces at the vertices where they are drawn, but for sources."""
    document = recipe.document
    shown = {name for panel in document.panels for name in panel.shows.points} | set(document.isolines.through)
    points = tuple(
        replace(point, at=vertex_at(point.at, surfaces[point.surface].surface))
        if isinstance(point.at, SurfacePoint) and point.name not in shown
        else point
        for point in document.points
    )
    return replace(recipe, document=replace(document, points=points))


def _file_name(recipe: Recipe) -> str:
    return file_name([each.path for each in recipe.document.surfaces], "figure")


def _kept(recipe: Recipe, given: Any) -> Path:
    """Save a recipe that no line can express among the program's data, and return its path."""
    folder = remembered.folder() / "recipes"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BihdistError(f"The recipe cannot be saved in {folder}: {error.strerror or error}.") from error
    text = recipe_text(recipe, version())
    name = f"{_file_name(recipe)}-{hashlib.sha256(text.encode()).hexdigest()[:8]}.json"
    with recipe_written(recipe, given, folder / name, version(), format=recipe.page.format):
        pass
    return folder / name
