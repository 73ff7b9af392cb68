"""The window's figures: File > Export figure, Export movie, Open recipe.  `window` is the main window."""

from dataclasses import replace

from qtpy import QtWidgets

from bihdist_core import BihdistError

from ..camera import Camera, camera_seen, show_camera
from ..recipe import Recipe, RecipeCamera, RecipePanel, checksum, read_recipe
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
    return _opened(
        ExportDialog(recipe, window.session.surface, list(window.session.answers), version(), window), window
    )


def export_movie(window) -> MovieDialog | None:
    """The same for a movie."""
    recipe = _complete_recipe(window)
    return None if recipe is None else _opened(MovieDialog(recipe, window), window)


def _complete_recipe(window) -> Recipe | None:
    if not window.session.is_complete:
        window.failed("The panels are not complete yet; a figure can be exported once they are.")
        return None
    try:
        return shown_recipe(window)
    except BihdistError as error:
        window.failed(str(error))
        return None


def _opened(dialog: JobDialog, window) -> JobDialog:
    dialog.saved.connect(lambda path: window.statusBar().showMessage(f"Saved {path}", 8000))
    dialog.failed.connect(window.failed)
    dialog.open()
    return dialog


def shown_recipe(window) -> Recipe:
    """What the window shows; looks (size, style, ...) from the recipe that was opened last."""
    state = window.session.state
    seen = camera_seen(window.camera, window.aspect)
    return replace(
        window.recipe or Recipe("", ()),
        mesh=window.session.path,
        sha256=checksum(window.session.path),
        panels=tuple(RecipePanel(panel, state.source) for panel in state.panels),
        areas=state.areas,
        isolines=state.isolines,
        views=(RecipeCamera(seen.position, seen.focal_point, seen.up, seen.extent),),
        zooms=(),
        anchors=(),
        height=0.0,
    )


def choose_recipe(window) -> None:
    path, _ = QtWidgets.QFileDialog.getOpenFileName(window, "Open a recipe", "", RECIPES)
    if path:
        open_recipe(window, path)


def open_recipe(window, path: str) -> None:
    """Show a recipe's mesh, distances, first source and first view; a sentence where that cannot be."""
    try:
        recipe = read_recipe(path)
        mesh = mesh_path(recipe.mesh)
        found = checksum(mesh)
    except BihdistError as error:
        window.failed(str(error))
        return
    if recipe.sha256 and found != recipe.sha256:
        window.failed(
            f"The mesh {recipe.mesh} is not what it was when the recipe was written; it is shown all the same."
        )

    def arrived() -> None:
        window.recipe = recipe
        window.show_isolines(recipe.isolines)
        for panel, chosen in zip(window.panels, recipe.panels, strict=False):
            panel.controls.show_spec(chosen.spec)
        first = recipe.views[0] if recipe.views else "home"
        if isinstance(first, RecipeCamera):
            camera = Camera(first.position, first.focal_point, first.up, first.extent)
            window.look_from(lambda: show_camera(window.camera, camera, window.aspect))
        else:
            window.reset_view(first)

    source = recipe.panels[0].source if recipe.panels else None
    # Nothing changes before the mesh is there: it may not open.
    window.open(mesh, source, areas=recipe.areas, panels=[chosen.spec for chosen in recipe.panels], arrived=arrived)
