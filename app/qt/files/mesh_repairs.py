"""What is cut out of a mesh that is open and merged in it, and put back: steps of the history like any other."""

import os
from collections.abc import Callable
from functools import partial

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import Surface
from bihdist_core.arrays import IntArray
from bihdist_core.counts import counted

from ...document.derived_surfaces import changed_mesh
from ...document.document import Document, MeshFile
from ...document.file_names import file_name
from ...document.repairs import with_repairs, without_repairs
from ...session.loaded_mesh import unmerged
from ...session.repaired_surface import write_ids
from ..context import Context
from .merge_dialog import MergeDialog, merge_in_words
from .writing import Writing

MASKS = "Masks, 1 for each vertex that stays (*.npy *.txt *.gii *.gii.gz *.annot *.label lh.* rh.*);;All files (*)"


class MeshRepairs(QtCore.QObject):
    """Of the mesh that the active panel shows."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._counting = context.background("merging", merge_in_words)
        context.document_changed.connect(self._tell_merged)

    @property
    def _mesh(self) -> MeshFile:
        """The mesh itself, also where the panel shows what is made from it."""
        document, active = self._context.document, self._context.active
        shown = document.mesh(document.panel(active.id).surface if active else document.surfaces[0].name)
        which = shown.path, shown.sha256
        return next(mesh for mesh in document.surfaces if mesh.change is None and (mesh.path, mesh.sha256) == which)

    # ------------------------------------------------------------------ cutting
    def choose_cut(self) -> None:
        """Ask for a mask, and cut out what it says."""
        context = self._context
        title = f"Cut out of {self._name(self._mesh)} by a mask"
        path, _ = QtWidgets.QFileDialog.getOpenFileName(context.widget, title, context.folder, MASKS)
        if path:
            context.folder = os.path.dirname(path)
            self.cut(path)

    def cut(self, path: str) -> None:
        """Cut out what a mask says, which is said in the window where it cannot be."""
        surface = self._mesh.name
        self._context.session.apply(lambda document: with_repairs(document, path, None, surface))

    # ------------------------------------------------------------------ merging
    def ask_merge(self) -> None:
        """Ask for a tolerance, and merge what is so near to each other."""
        context, mesh = self._context, self._mesh
        loaded = context.session.loaded(mesh.name)
        if loaded is None or self._is_refused():
            return
        corners = loaded.surface.bounds
        extent = float(np.linalg.norm(corners[1] - corners[0]))
        tolerance = mesh.repairs.merge
        # That of the file is read again only where vertices have been merged before.
        found: list[Surface] = [loaded.surface] if tolerance is None else []

        def surface() -> Surface:
            if not found:
                found.append(unmerged(mesh, context.session.given))
            return found[0]

        dialog = MergeDialog(self._name(mesh), extent, surface, tolerance, self._counting, context.widget)
        dialog.chosen.connect(partial(self.merge, mesh.name))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def merge(self, surface: str, tolerance: float) -> None:
        """Merge the vertices of a surface that are no farther apart."""
        self._context.session.apply(lambda document: with_repairs(document, None, tolerance, surface))

    def save_ids(self, path: str = "") -> None:
        """Write the new id of each vertex of the file; with "" a file is asked for."""
        mesh = self._mesh
        ids = self._ids(mesh)
        if ids is None:
            self._context.tell("No vertices of this mesh have been merged.")
            return
        name = file_name([mesh.path or mesh.name], "ids")
        self._context[Writing].save("Save the table of ids", name, (".csv",), partial(write_ids, ids=ids), path)

    def _name(self, mesh: MeshFile) -> str:
        """For the user."""
        loaded = self._context.session.loaded(mesh.name)
        return mesh.name if loaded is None else loaded.surface.name

    def _ids(self, mesh: MeshFile) -> IntArray | None:
        loaded = self._context.session.loaded(mesh.name)
        return None if loaded is None else loaded.new_ids

    def _is_refused(self) -> bool:
        """Whether a mesh is there that is made from another, by ids that would be others."""
        made = changed_mesh(self._context.document)
        if made is not None:
            self._context.fail(
                f"{self._name(made)} has a changed copy, whose vertices are numbered as its own; "
                "close that first (Tools > Robustness)."
            )
        return made is not None

    def _tell_merged(self, before: Document) -> None:
        """How many have gone, once they have."""
        context = self._context
        merges = {mesh.name: mesh.repairs.merge for mesh in before.surfaces if mesh.change is None}
        for mesh in context.document.surfaces:
            ids = self._ids(mesh) if mesh.name in merges and merges[mesh.name] != mesh.repairs.merge else None
            if ids is not None:
                left = int(ids.max()) + 1
                gone = counted(len(ids) - left, "vertex", "vertices")
                words = f"{gone} merged, {left:,} left; File > Save table of ids… has their numbers"
                context.tell(words, _same(mesh, context))

    # ------------------------------------------------------------------ putting back
    def put_back(self) -> None:
        """The mesh as it is in its file, with what was cut out of it, and nothing merged."""
        mesh = self._mesh
        if not mesh.repairs.is_any:
            self._context.tell("Nothing has been cut out of this mesh or merged.")
        elif mesh.repairs.merge is None or not self._is_refused():
            self._context.session.apply(lambda document: without_repairs(document, mesh.name))


def _same(mesh: MeshFile, context: Context) -> Callable[[], bool]:
    """Whether a mesh is as it was."""
    return lambda: mesh in context.document.surfaces
