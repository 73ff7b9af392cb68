"""Ambient occlusion in the window: the share of the light that reaches each vertex, computed once for a surface."""

from contextlib import suppress
from threading import Thread
from weakref import WeakSet

import numpy as np
from qtpy import QtCore
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from bihdist_core import BihdistError
from bihdist_core.analysis.ambient_light import light_reached
from bihdist_core.arrays import AnyArray

from ...scene.drawable import copies_of, faces_of
from ...scene.prepared import Meshes


class AmbientOcclusion(QtCore.QObject):
    """Computes light on threads while the user wants it; each surface keeps its own."""

    made = QtCore.Signal()  # that of a surface
    failed = QtCore.Signal(str)  # why there is none

    def __init__(self, parent: QtCore.QObject | None = None) -> None:
        super().__init__(parent)
        self.is_on = False
        self._begun = WeakSet[Meshes]()

    def light(self, meshes: Meshes) -> AnyArray | None:
        """Return the light (n,) of a surface, None where there is to be none, or none yet."""
        if not self.is_on:
            return None
        if meshes.light is None and meshes not in self._begun:
            self._begun.add(meshes)
            Thread(target=self._make, args=(meshes,), name="light", daemon=True).start()
        return meshes.light

    def _make(self, meshes: Meshes) -> None:
        with suppress(RuntimeError):  # the window may have been closed meanwhile
            try:
                meshes.light = light_at_vertices(meshes.usual.mesh)
            except BihdistError as error:
                self.failed.emit(str(error))
            else:
                self.made.emit()


def light_at_vertices(mesh: vtkPolyData) -> AnyArray:
    """Return the share (n,) float32 of an even sky's light that reaches each vertex of a surface made by `drawable`.

    Raises
    ------
    BihdistError
        Without the compiled kernel.
    """
    copies, x = copies_of(mesh), vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    all_normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
    n = len(x) - len(copies)
    # A vertex on a sharp edge is lit from both sides of it.
    normals = all_normals[:n].copy()
    np.add.at(normals, copies, all_normals[n:])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    light = light_reached(x, faces_of(mesh), (x[:n], normals, normals), lambda directions: np.ones(len(directions)))
    return light.astype(np.float32)
