"""The dialog of File > Export web page."""

from collections.abc import Callable
from functools import partial

from qtpy import QtWidgets

from bihdist_core.counts import counted
from bihdist_core.whole_file import check_output

from ...document.file_names import file_name
from ...document.page import Recipe
from ...figures.export import Surfaces
from ...session.array_store import ArrayStore
from ...web.contents import Contents
from ...web.export import check_size, eigenpair_bytes, needed_eigenpairs, size_words, write_page
from ...web.stored_mesh import PRECISIONS
from ..look.layouts import quiet_label
from .exports import Exports
from .job_dialog import Choice, FileKind, JobDialog

PRECISION_NAMES = dict(zip(PRECISIONS, ("24 bits", "Single precision"), strict=True))


class PageDialog(JobDialog):
    """A page of what the window shows, in which distances are computed anew wherever one clicks."""

    what = "Web page"
    file_kinds = (FileKind(".html", "HTML", "Web page"),)

    def __init__(
        self,
        recipe: Recipe,
        surfaces: Surfaces,
        given: ArrayStore,
        exports: Exports,
        parent: QtWidgets.QWidget | None = None,
    ) -> None:
        """recipe: what the window shows, on these surfaces; given: arrays that it names."""
        super().__init__(file_name([each.path for each in recipe.document.surfaces], "page"), exports, parent)
        self._recipe, self._surfaces, self._given = recipe, surfaces, given
        self._eigenpairs: int | None = None
        self.section("Mesh")
        self.precision = Choice(PRECISION_NAMES, PRECISIONS[0])
        self.row("&Coordinates", self.precision, "How exactly the page has them; its distances are those of its mesh")
        self.carried = quiet_label()
        self.column.addWidget(self.carried)
        with self.refusals_shown():
            self.check()

    def check(self) -> None:
        document = self._recipe.document
        contents = Contents.of(document)
        loaded = self._surfaces[document.surfaces[0].name]
        check_size(loaded.surface, loaded.mesh.path)
        if self._eigenpairs is None:
            needed = needed_eigenpairs(contents, loaded).values()
            self._eigenpairs, total = max(needed, default=0), sum(needed)
            size = size_words(eigenpair_bytes(total, len(loaded.surface.vertices)))
            self.carried.setText(f"{counted(total, 'eigenpair')} in the file, some {size}")
            self.carried.setVisible(bool(total))

    def work(self, path: str) -> Callable[..., object]:
        check_output(path, (".html",))
        precision = self.precision.currentData()
        return partial(write_page, self._recipe, path, self._given, precision, self._eigenpairs or 0)
