"""What is cut out of a mesh that is open, by a file, and put back: steps of the history like any other."""

import os
from dataclasses import replace

from qtpy import QtCore, QtWidgets

from bihdist_core import BihdistError
from bihdist_core.formats.whole_numbers import read_whole_numbers

from ...document.document import Document
from ...document.repairs import with_repairs
from ..context import Context

MASKS = "Masks, 1 for each vertex that stays (*.npy *.txt *.gii *.gii.gz *.annot lh.* rh.*);;All files (*)"


class MeshRepairs(QtCore.QObject):
    """Of the mesh that the active panel shows."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context

    @property
    def _surface(self) -> str:
        document, active = self._context.document, self._context.active
        return document.panel(active.id).surface if active else document.surfaces[0].name

    def choose_cut(self) -> None:
        """Ask for a mask, and cut out what it says."""
        context = self._context
        path, _ = QtWidgets.QFileDialog.getOpenFileName(context.widget, "Cut out by a file", context.folder, MASKS)
        if path:
            context.folder = os.path.dirname(path)
            self.cut(path)

    def cut(self, path: str) -> None:
        """Cut out what a mask says, which is said in the window where it cannot be."""
        surface = self._surface
        try:
            mask = read_whole_numbers(path, "mask").tolist()
        except BihdistError as error:
            self._context.fail(error)
            return

        def edit(document: Document) -> Document:
            # Sources in what goes start where a field does at first.
            points = tuple(
                replace(point, at=None)
                if point.surface == surface and isinstance(point.at, int) and not any(mask[point.at : point.at + 1])
                else point
                for point in document.points
            )
            return replace(with_repairs(document, path, None, surface), points=points)

        self._context.session.apply(edit)

    def put_back(self) -> None:
        """The mesh as it is in its file, with what was cut out of it."""
        surface = self._surface
        if self._context.document.mesh(surface).repairs.cut:
            self._context.session.apply(lambda document: with_repairs(document, "", None, surface))
        else:
            self._context.tell("Nothing has been cut out of this mesh.")
