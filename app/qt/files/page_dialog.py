"""The dialog of File > Export web page."""

from collections.abc import Callable
from functools import partial

from bihdist_core.counts import counted
from bihdist_core.file_output import check_output

from ...document.page import Recipe
from ...figures.export import Surfaces
from ...web.contents import Contents
from ...web.export import EIGENPAIR_BYTES, check_size, eigenpair_bytes, needed_eigenpairs, size_words, write_page
from ...web.stored_mesh import PRECISIONS
from ..context import Context
from ..look.form import Choice, quiet_label
from .job_dialog import FileKind, JobDialog

PRECISION_NAMES = dict(zip(PRECISIONS, ("24 bits", "Single precision"), strict=True))


class PageDialog(JobDialog):
    """A web page of what the window shows, in which a click computes new distances."""

    what = "Web page"
    file_kinds = (FileKind(".html", "HTML", "Web page"),)

    def __init__(self, context: Context, recipe: Recipe, surfaces: Surfaces) -> None:
        super().__init__(context, recipe, surfaces)
        self._allowed: int | None = None  # eigenpairs for each distance; None for as many as usual
        self.form.section("Mesh")
        self.precision = Choice(PRECISION_NAMES, PRECISIONS[0])
        tip = "Precision of the stored vertices, from which the page computes its distances"
        self.form.row("&Coordinates", self.precision, tip)
        self.carried = quiet_label()
        self.form.add(self.carried)
        with self.refusals_shown():
            self.check()

    def check(self) -> None:
        document = self._recipe.document
        contents = Contents.of(document)
        loaded = self._surfaces[document.surfaces[0].name]
        check_size(loaded.surface.name, len(loaded.surface.vertices), loaded.mesh.path, loaded.surface)
        needed = needed_eigenpairs(contents).values()
        size = eigenpair_bytes(sum(needed), len(loaded.surface.vertices))
        self._allowed = None if size <= EIGENPAIR_BYTES else max(needed)
        self.carried.setText(f"{counted(sum(needed), 'eigenpair')} in the file, about {size_words(size)}")
        self.carried.setVisible(bool(needed))

    def work(self, path: str) -> Callable[..., object]:
        check_output(path, (".html",))
        precision = self.precision.currentData()
        return partial(write_page, self._recipe, path, self._given, precision, self._allowed)
