"""The window's figures: exported, as movies, and copied.  `window` is the main window, which has the `exports`."""

import os
from dataclasses import replace
from functools import partial

from bihdist_core import BihdistError

from ...document.page import Recipe
from ...figures.export import Surfaces
from ...version import version
from .copies import copy_line, copy_picture
from .export_dialog import ExportDialog
from .exports import Export
from .job_dialog import JobDialog
from .movie_dialog import MovieDialog


def export_figure(window) -> ExportDialog | None:
    """Open the dialog for what the window shows; None, with a word to the user, while it is not complete."""
    recipe = _complete_recipe(window)
    if recipe is None:
        return None
    session = window.session
    answers = [session.shown[panel.id].answer for panel in recipe.document.panels]
    surfaces = _surfaces(window, recipe)
    dialog = ExportDialog(recipe, surfaces, session.given, answers, version(), window.exports, window)
    dialog.allow_sharing(_has_one_unit(window))
    dialog.copying.connect(partial(_copy, window))
    return _opened(dialog, window)


def export_movie(window) -> MovieDialog | None:
    """The same for a movie."""
    recipe = _complete_recipe(window)
    if recipe is None:
        return None
    surfaces = _surfaces(window, recipe)
    dialog = MovieDialog(recipe, surfaces, window.session.given, window.exports, window)
    dialog.allow_sharing(_has_one_unit(window))
    return _opened(dialog, window)


def copy(window, what: str) -> None:
    """Copy what the window shows, as it would be exported: what is "picture", "command" or "python"."""
    recipe = _complete_recipe(window)
    if recipe is not None:
        try:
            _copy(window, what, recipe)
        except BihdistError as error:
            window.failed(str(error))


def _copy(window, what: str, recipe: Recipe) -> None:
    surfaces = _surfaces(window, recipe)
    if what == "picture":
        answers = [window.session.shown[panel.id].answer for panel in recipe.document.panels]
        copy_picture(window, recipe, surfaces, answers)
    else:
        copy_line(window, recipe, surfaces, is_python=what == "python")


def _has_one_unit(window) -> bool:
    answers = [shown.answer for shown in window.session.shown.values()]
    return len({answer.unit for answer in answers if answer.field is not None}) <= 1


def _surfaces(window, recipe: Recipe) -> Surfaces:
    return {mesh.name: window.session.loaded(mesh.name) for mesh in recipe.document.surfaces}


def _complete_recipe(window) -> Recipe | None:
    if not window.session.is_complete:
        if window.session.is_stopped:
            window.failed("A panel was stopped; press Retry in it, or remove it, and export then.")
        else:
            window.failed("The panels are not complete yet; a figure can be exported once they are.")
        return None
    if not window.session.document.panels:
        window.failed("There are no panels; add one first.")
        return None
    return shown_recipe(window)


def _opened(dialog: JobDialog, window) -> JobDialog:
    def announce(export: Export) -> None:
        export.saved.connect(lambda path: window.say(f"Saved {os.path.basename(path)}"))
        export.failed.connect(lambda sentence: window.failed(f"{os.path.basename(export.path)}: {sentence}"))

    dialog.started.connect(announce)
    dialog.finished.connect(dialog.deleteLater)
    dialog.open()
    return dialog


def shown_recipe(window) -> Recipe:
    """What the window shows, on the page of the recipe that was opened last; turned since, with one view."""
    document, page = window.session.document, window.page
    is_turned = bool(page.views) and document.camera != page.views[0]
    return Recipe(document, replace(page, views=()) if is_turned else page)
