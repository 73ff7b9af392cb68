"""Cutting an open mesh by a mask, merging its vertices, and undoing both, as steps of the history."""

from collections.abc import Callable
from functools import partial

import numpy as np
from qtpy import QtCore

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
from .saving import ask_file
from .writing import Writing

MASKS = "Masks, 1 for each vertex to keep (*.npy *.txt *.gii *.gii.gz *.annot *.label lh.* rh.*);;All files (*)"


class MeshRepairs(QtCore.QObject):
    """Repairs of the mesh that the active panel shows."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._counting = context.background("merging", merge_in_words)
        context.document_changed.connect(self._tell_merged)

    @property
    def _mesh(self) -> MeshFile:
        """The mesh, or the original where the panel shows one made from it."""
        document, active = self._context.document, self._context.active
        shown = document.mesh(document.panel(active.id).surface if active else document.surfaces[0].name)
        which = shown.path, shown.sha256
        if shown.change is None:
            return shown
        return next(mesh for mesh in document.surfaces if mesh.change is None and (mesh.path, mesh.sha256) == which)

    # ------------------------------------------------------------------ cutting
    def choose_cut(self) -> None:
        """Ask for a mask, and cut the mesh by it."""
        ask_file(self._context, f"Cut {self._name(self._mesh)} by a mask", MASKS, self.cut)

    def cut(self, path: str) -> None:
        """Cut the mesh by a mask, or tell why that is not possible."""
        surface = self._mesh.name
        self._context.session.apply(lambda document: with_repairs(document, surface, cut=path))

    # ------------------------------------------------------------------ merging
    def ask_merge(self) -> None:
        """Ask for a tolerance, and merge the vertices within it."""
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
        """Merge the vertices of a surface within a tolerance."""
        self._context.session.apply(lambda document: with_repairs(document, surface, merge=tolerance))

    def save_ids(self, path: str = "") -> None:
        """Write the new id of each vertex of the file; asks for a path if none is given."""
        mesh = self._mesh
        ids = self._ids(mesh)
        if ids is None:
            self._context.tell("No vertices of this mesh have been merged.")
            return
        name = file_name([mesh.path or mesh.name], "ids")
        self._context[Writing].save("Save vertex id table", name, (".csv",), partial(write_ids, ids=ids), path)

    def _name(self, mesh: MeshFile) -> str:
        """Return the name of a mesh for the user."""
        loaded = self._context.session.loaded(mesh.name)
        return mesh.name if loaded is None else loaded.surface.name

    def _ids(self, mesh: MeshFile) -> IntArray | None:
        loaded = self._context.session.loaded(mesh.name)
        return None if loaded is None else loaded.new_ids

    def _is_refused(self) -> bool:
        """Tell the user of a mesh made from this one, whose ids would change, and return whether there is one."""
        made = changed_mesh(self._context.document)
        if made is not None:
            self._context.fail(
                f"{self._name(made)} has a perturbed copy with the same vertex ids; "
                "remove it first (Tools > Robustness)."
            )
        return made is not None

    def _tell_merged(self, before: Document) -> None:
        """Tell how many vertices were merged, once they are."""
        context = self._context
        merges = {mesh.name: mesh.repairs.merge for mesh in before.surfaces if mesh.change is None}
        for mesh in context.document.surfaces:
            ids = self._ids(mesh) if mesh.name in merges and merges[mesh.name] != mesh.repairs.merge else None
            if ids is not None:
                left = int(ids.max()) + 1
                gone = counted(len(ids) - left, "vertex", "vertices")
                where = "File > Repair mesh > Save vertex id table… saves the old and new ids"
                context.tell(f"{gone} merged, {left:,} left; {where}", _same(mesh, context))

    # ------------------------------------------------------------------ components
    def keep_largest_component(self) -> None:
        """Keep only the component with most vertices."""
        surface = self._mesh.name
        self._context.session.apply(lambda document: with_repairs(document, surface, largest_component=True))

    # ------------------------------------------------------------------ the operator
    @property
    def operator(self) -> str:
        """The operator of the mesh, "" without a mesh."""
        return self._mesh.repairs.operator if self._context.document.surfaces else ""

    def choose_operator(self, word: str) -> None:
        """Let distances on the mesh be by another operator."""
        surface = self._mesh.name
        self._context.session.apply(lambda document: with_repairs(document, surface, operator=word))

    # ------------------------------------------------------------------ putting back
    def put_back(self) -> None:
        """Restore the mesh of the file, without repairs."""
        mesh = self._mesh
        if not mesh.repairs.is_any:
            self._context.tell("This mesh has not been cut or merged.")
        elif mesh.repairs.merge is None or not self._is_refused():
            self._context.session.apply(lambda document: without_repairs(document, mesh.name))


def _same(mesh: MeshFile, context: Context) -> Callable[[], bool]:
    """Return a function that tells whether the document still has a mesh."""
    return lambda: mesh in context.document.surfaces
