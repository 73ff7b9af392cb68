"""What is handed to VTK for drawing."""

import gc

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals

from app.document.looks import Shading
from app.scene.creases import face_normals, point_normals, to_length_one
from app.scene.drawable import drawable
from bihdist_core import Surface
from tests.shapes import bumpy, fin, grid, slivers, torus, two_pieces

SHAPES = [bumpy(500), torus(), grid(3, 2), fin(), two_pieces(), slivers()]

SMOOTH = Shading("smooth")


def normals_of(surface):
    normals = face_normals(surface.vertices, surface.faces)
    to_length_one(normals)
    return point_normals(normals, surface.faces, len(surface.vertices))


@pytest.mark.parametrize("surface", SHAPES, ids=str)
def test_normals_are_those_of_vtk(surface):
    filter = vtkPolyDataNormals()
    mesh = drawable(surface, SMOOTH)
    filter.SetInputData(mesh)
    filter.SplittingOff()
    filter.ConsistencyOff()
    filter.NonManifoldTraversalOff()
    filter.Update()
    expected = vtk_to_numpy(filter.GetOutput().GetPointData().GetNormals())
    normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
    assert normals.dtype == np.float32
    # VTK adds up in single precision.
    assert np.abs(normals - expected).max() <= 4e-7


@pytest.mark.parametrize("surface", SHAPES, ids=str)
def test_normals_are_means_over_faces_taken_one_at_a_time(surface):
    sums = np.zeros((len(surface.vertices), 3))
    for face in surface.faces:
        a, b, c = surface.vertices[face]
        normal = np.cross(b - a, c - a)
        if normal.any():
            sums[face] += normal / np.linalg.norm(normal)
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    expected = np.divide(sums, lengths, out=np.zeros_like(sums), where=lengths > 0)
    assert np.abs(normals_of(surface) - expected).max() <= 1e-7  # half a step of single precision
    assert (normals_of(surface)[surface.component_of_vertex < 0] == 0).all()


def test_a_mesh_keeps_the_arrays_that_it_shares_with_its_surface():
    def alone():
        shape = bumpy(300)
        return drawable(Surface(shape.vertices, shape.faces))

    mesh, expected = alone(), bumpy(300)
    gc.collect()
    _others = [np.full(expected.vertices.shape, -1.0) for _ in range(50)]
    assert np.array_equal(vtk_to_numpy(mesh.GetPoints().GetData()), expected.vertices)
    assert np.array_equal(vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3), expected.faces)
    assert mesh.GetNumberOfCells() == len(expected.faces)
