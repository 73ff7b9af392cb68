"""The window's figures: File > Export figure, Export movie, Open recipe.  `window` is the main window."""

from dataclasses import replace

from ..document.page import Recipe
from ..version import version
from .export_dialog import ExportDialog, MovieDialog
from .job_dialog import JobDialog


def export_figure(window) -> ExportDialog | None:
    """Open the dialog for what the window shows; None, with a word to the user, while it is not complete."""
    recipe = _complete_recipe(window)
    if recipe is None:
        return None
    session = window.session
    surfaces = {mesh.name: session.opened(mesh.name) for mesh in recipe.document.surfaces}
    answers = [session.shown[panel.id].answer for panel in recipe.document.panels]
    return _opened(ExportDialog(recipe, surfaces, session.given, answers, version(), window), window)


def export_movie(window) -> MovieDialog | None:
    """The same for a movie."""
    recipe = _complete_recipe(window)
    return None if recipe is None else _opened(MovieDialog(recipe, window.session.given, window), window)


def _complete_recipe(window) -> Recipe | None:
    if not window.session.is_complete:
        window.failed("The panels are not complete yet; a figure can be exported once they are.")
        return None
    if not window.session.document.panels:
        window.failed("There are no panels; add one first.")
        return None
    return shown_recipe(window)


def _opened(dialog: JobDialog, window) -> JobDialog:
    dialog.saved.connect(lambda path: window.statusBar().showMessage(f"Saved {path}", 8000))
    dialog.failed.connect(window.failed)
    dialog.open()
    return dialog


def shown_recipe(window) -> Recipe:
    """What the window shows, on the page of the recipe that was opened last; turned since, with one view."""
    document, page = window.session.document, window.page
    is_turned = bool(page.views) and document.camera != page.views[0]
    return Recipe(document, replace(page, views=()) if is_turned else page)
