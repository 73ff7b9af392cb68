"""The window's figures: File > Export figure, Export movie, Open recipe.  `window` is the main window."""

from dataclasses import replace

from qtpy import QtWidgets

from bihdist_core import BihdistError, ParameterError

from ..document.file import checksum, read_recipe
from ..document.page import Recipe
from ..drawing.style import STYLES
from ..samples import mesh_path
from ..version import version
from .export_dialog import ExportDialog, MovieDialog
from .job_dialog import JobDialog

RECIPES = "Recipes (*.json);;All files (*)"


def export_figure(window) -> ExportDialog | None:
    """Open the dialog for what the window shows; None, with a word to the user, while it is not complete."""
    recipe = _complete_recipe(window)
    if recipe is None:
        return None
    session = window.session
    surfaces = {mesh.name: session.opened(mesh.name) for mesh in recipe.document.surfaces}
    answers = [session.shown[panel.id].answer for panel in recipe.document.panels]
    return _opened(ExportDialog(recipe, surfaces, answers, version(), window), window)


def export_movie(window) -> MovieDialog | None:
    """The same for a movie."""
    recipe = _complete_recipe(window)
    return None if recipe is None else _opened(MovieDialog(recipe, window), window)


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
    """What the window shows; on the page of the recipe that was opened last, but seen as it is seen now."""
    document = replace(window.session.document, camera=window.grid.seen())
    return Recipe(document, replace(window.page, views=()))


def choose_recipe(window) -> None:
    path, _ = QtWidgets.QFileDialog.getOpenFileName(window, "Open a recipe", "", RECIPES)
    if path:
        open_recipe(window, path)


def open_recipe(window, path: str) -> None:
    """Show a recipe's document, and keep its page for what is exported; a sentence where that cannot be."""
    try:
        recipe = read_recipe(path)
        document = recipe.document
        if len(document.surfaces) > 1:
            raise ParameterError(f"The window shows one mesh, and {path} has {len(document.surfaces)}.")
        if recipe.page.style not in STYLES:
            raise ParameterError(f"{path}: there is no style {recipe.page.style!r}; choose one of {', '.join(STYLES)}.")
        for mesh in document.surfaces:
            if mesh.sha256 and mesh.path and checksum(mesh_path(mesh.path)) != mesh.sha256:
                window.failed(
                    f"The mesh {mesh.path} is not what it was when the recipe was written; it is shown all the same."
                )
                meshes = tuple(replace(m, sha256="") if m == mesh else m for m in document.surfaces)
                document = replace(document, surfaces=meshes)
    except BihdistError as error:
        window.failed(str(error))
        return

    def arrived() -> None:
        window.page = recipe.page

    # Nothing changes before the mesh is there: it may not open.
    window.show_document(document, arrived)
