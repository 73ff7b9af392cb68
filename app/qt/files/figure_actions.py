"""Export of figures, movies and web pages, and copies to the clipboard."""

import os
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from qtpy import QtCore

from bihdist_core.distances.answers import Answer

from ...document.document import Document
from ...document.page import Recipe
from ...figures.export import Surfaces
from ...session.recipe_file import written_recipe
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


class OnceComplete(QtCore.QObject):
    """Runs the latest action that was asked for while panels were still being computed, once they are complete."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._do: Callable[[], object] | None = None
        context.complete.connect(self._end)
        context.document_changed.connect(self._forget_closed)

    def wait(self, do: Callable[[], object], words: str) -> None:
        """Run an action once the panels are complete, unless another mesh is opened before; `words` tell of it."""
        self._do = do
        self._context.tell(f"{words} once the panels are complete", lambda: self._do is not None)

    def _end(self) -> None:
        do, self._do = self._do, None
        if do is not None:
            self._context.tell("")
            do()

    def _forget_closed(self, before: Document) -> None:
        if before.surfaces != self._context.document.surfaces:
            self._do = None


def export_figure(context: Context) -> ExportDialog | None:
    """Open the dialog of figures; None while panels are computed, after which it opens."""
    recipe = _complete_recipe(context, partial(export_figure, context))
    if recipe is None:
        return None
    dialog = ExportDialog(context, recipe, _surfaces(context, recipe), _answers(context, recipe))
    dialog.copying.connect(partial(_copy, context))
    _begin_as_last(dialog, context)
    return _opened(dialog, context)


def export_movie(context: Context) -> MovieDialog | None:
    """Open the dialog of movies; None while panels are computed, after which it opens."""
    recipe = _complete_recipe(context, partial(export_movie, context))
    if recipe is None:
        return None
    dialog = MovieDialog(context, recipe, _surfaces(context, recipe))
    _begin_as_last(dialog, context)
    return _opened(dialog, context)


def export_page(context: Context) -> "PageDialog | None":
    """Open the dialog of web pages; None while panels are computed, after which it opens."""
    from .page_dialog import PageDialog

    recipe = _complete_recipe(context, partial(export_page, context))
    if recipe is None:
        return None
    return _opened(PageDialog(context, recipe, _surfaces(context, recipe)), context)


def copy(context: Context, what: str) -> None:
    """Copy the figure that would be exported, as a "picture", a "command" or "python"."""
    recipe = _complete_recipe(context, partial(copy, context, what), "It is copied")
    if recipe is not None:
        with context.errors_shown():
            _copy(context, what, recipe)


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


def _complete_recipe(context: Context, again: Callable[[], object], words: str = "The dialog opens") -> Recipe | None:
    """Return the recipe of the window; None while panels are computed, after which `again` is called."""
    if not context.session.is_complete:
        if context.session.is_stopped:
            context.fail("A panel was stopped; press Retry in it or remove it, then export.")
        else:
            context[OnceComplete].wait(again, words)
        return None
    if not context.document.panels:
        context.fail("There are no panels; add one first.")
        return None
    return shown_recipe(context)


def _begin_as_last(dialog: LooksDialog, context: Context) -> None:
    """Offer the format and the size chosen last, or those of an opened recipe of a figure."""
    what, page, preferences = dialog.what.lower(), context.page, context.preferences
    format, size = getattr(preferences, f"{what}_format"), page.size or getattr(preferences, f"{what}_size")
    usual = (page.format.upper(), page.size) if page.format else (format, size)
    dialog.choose(*context[Exports].chosen.get((what, page), usual))

    def remember(_: Export) -> None:
        format, size = dialog.kinds.choice(), dialog.size.text()
        context[Exports].chosen[what, page] = format, size
        context.prefer(**{f"{what}_format": format, f"{what}_size": size})

    dialog.started.connect(remember)
    answers = [shown.answer for shown in context.session.shown.values()]
    dialog.allow_sharing(len({answer.unit for answer in answers if answer.field is not None}) <= 1)


def _saved(path: str, what: str) -> str:
    beside = f", and beside it its recipe {written_recipe(path).name}" if what == ExportDialog.what else ""
    return f"Saved {os.path.basename(path)}{beside}"


def _opened(dialog: Dialog, context: Context) -> Dialog:
    def announce(export: Export) -> None:
        export.saved.connect(lambda path: context.tell(_saved(path, dialog.what)))
        export.failed.connect(lambda sentence: context.fail(f"{os.path.basename(export.path)}: {sentence}"))

    dialog.started.connect(announce)
    dialog.finished.connect(dialog.deleteLater)
    dialog.open()
    return dialog


def shown_recipe(context: Context) -> Recipe:
    """Return the recipe of the window, on the page of the one opened last; with one view if turned since."""
    document, page = context.document, context.page
    is_turned = bool(page.views) and document.camera != page.views[0]
    return Recipe(document, replace(page, views=()) if is_turned else page)
