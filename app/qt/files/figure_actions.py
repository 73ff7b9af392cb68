"""The window's figures: exported, as movies and web pages, and copied."""

import os
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from bihdist_core import BihdistError
from bihdist_core.distances.answers import Answer

from ...document.page import Recipe
from ...figures.export import Surfaces
from ...version import version
from ..context import Context
from .copies import copy_line, copy_picture
from .export_dialog import ExportDialog
from .exports import Export, Exports
from .job_dialog import JobDialog
from .looks_dialog import LooksDialog
from .movie_dialog import MovieDialog

if TYPE_CHECKING:
    from .page_dialog import PageDialog

Dialog = TypeVar("Dialog", bound=JobDialog)


def export_figure(context: Context) -> ExportDialog | None:
    """Open the dialog for what the window shows; None, with a word to the user, while it is not complete."""
    recipe = _complete_recipe(context)
    if recipe is None:
        return None
    given, surfaces, answers = context.session.given, _surfaces(context, recipe), _answers(context, recipe)
    dialog = ExportDialog(recipe, surfaces, given, answers, version(), context[Exports], context.widget)
    dialog.copying.connect(partial(_copy, context))
    _allow_sharing(dialog, context)
    return _opened(dialog, context)


def export_movie(context: Context) -> MovieDialog | None:
    """The same for a movie."""
    recipe = _complete_recipe(context)
    if recipe is None:
        return None
    given, surfaces = context.session.given, _surfaces(context, recipe)
    dialog = MovieDialog(recipe, surfaces, given, context[Exports], context.widget)
    _allow_sharing(dialog, context)
    return _opened(dialog, context)


def export_page(context: Context) -> "PageDialog | None":
    """Open the dialog of a web page of what the window shows; the same."""
    from .page_dialog import PageDialog

    recipe = _complete_recipe(context)
    if recipe is None:
        return None
    given, surfaces = context.session.given, _surfaces(context, recipe)
    return _opened(PageDialog(recipe, surfaces, given, context[Exports], context.widget), context)


def copy(context: Context, what: str) -> None:
    """Copy what the window shows, as it would be exported: what is "picture", "command" or "python"."""
    recipe = _complete_recipe(context)
    if recipe is not None:
        try:
            _copy(context, what, recipe)
        except BihdistError as error:
            context.fail(error)


def _copy(context: Context, what: str, recipe: Recipe) -> None:
    surfaces = _surfaces(context, recipe)
    if what == "picture":
        copy_picture(context, recipe, surfaces, _answers(context, recipe))
    else:
        copy_line(context, recipe, surfaces, is_python=what == "python")


def _answers(context: Context, recipe: Recipe) -> list[Answer]:
    return [context.session.shown[panel.id].answer for panel in recipe.document.panels]


def _surfaces(context: Context, recipe: Recipe) -> Surfaces:
    return {mesh.name: context.session.mesh(mesh.name) for mesh in recipe.document.surfaces}


def _complete_recipe(context: Context) -> Recipe | None:
    if not context.session.is_complete:
        if context.session.is_stopped:
            context.fail("A panel was stopped; press Retry in it, or remove it, and export then.")
        else:
            context.fail("The panels are not complete yet; a figure can be exported once they are.")
        return None
    if not context.document.panels:
        context.fail("There are no panels; add one first.")
        return None
    return shown_recipe(context)


def _allow_sharing(dialog: LooksDialog, context: Context) -> None:
    answers = [shown.answer for shown in context.session.shown.values()]
    dialog.allow_sharing(len({answer.unit for answer in answers if answer.field is not None}) <= 1)


def _opened(dialog: Dialog, context: Context) -> Dialog:
    def announce(export: Export) -> None:
        export.saved.connect(lambda path: context.tell(f"Saved {os.path.basename(path)}"))
        export.failed.connect(lambda sentence: context.fail(f"{os.path.basename(export.path)}: {sentence}"))

    dialog.started.connect(announce)
    dialog.finished.connect(dialog.deleteLater)
    dialog.open()
    return dialog


def shown_recipe(context: Context) -> Recipe:
    """What the window shows, on the page of the recipe that was opened last; turned since, with one view."""
    document, page = context.document, context.page
    is_turned = bool(page.views) and document.camera != page.views[0]
    return Recipe(document, replace(page, views=()) if is_turned else page)
