"""A surface as VTK draws it: with normals, in the surface's own vertex ids, and copies of those at creases."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, FloatArray, IntArray

from ..document.looks import AS_IT_IS, Shading
from .creases import bends, face_normals, has_creases, point_normals, split, to_length_one
from .winding import winding

_COPIES, _BACKS = "copies", "backs"


def drawable(surface: Surface, shading: Shading = AS_IT_IS) -> vtkPolyData:
    """The surface with point normals; its memory is shared where no face has to be turned over and nothing is split.

    The faces are the surface's, in their order.  Vertex k of the surface is point k; points from n on are `copies_of`
    vertices.  Flat shading needs no normals of its own.  Safe to call on a background thread.
    """
    normals = face_normals(surface.vertices, surface.faces)
    wound = winding(surface, normals)
    to_length_one(normals)
    if wound.turn.any():
        for x in normals:
            np.negative(x, out=x, where=wound.turn)
    is_cut = np.zeros(len(surface.edges), bool)
    # Faces wound against each other have normals that point to opposite sides.
    is_cut[wound.edges] = wound.is_turned
    if shading.normals in ("auto", "creased"):
        cosines = bends(normals, wound)
        if shading.normals == "creased" or has_creases(surface, wound.edges, cosines, shading.crease):
            is_cut[wound.edges] |= cosines < np.cos(np.radians(shading.crease))
            is_cut |= surface.faces_per_edge > 2
    drawn = split(surface, wound, is_cut)
    vertices, faces = surface.vertices, wound.faces(drawn.faces)
    if len(drawn.copies):
        vertices = np.concatenate([vertices, vertices[drawn.copies]])
    mesh = poly_data(vertices, faces, point_normals(normals, faces, len(vertices)))
    copies = numpy_to_vtkIdTypeArray(drawn.copies, deep=True)
    copies.SetName(_COPIES)
    mesh.GetFieldData().AddArray(copies)
    backs = numpy_to_vtk(np.array([wound.has_backs], np.int8), deep=True)
    backs.SetName(_BACKS)
    mesh.GetFieldData().AddArray(backs)
    return mesh


def crease_of(surface: Surface, shading: Shading) -> float | None:
    """The degrees from which on faces that meet are drawn with an edge: 0 for all of them, None for none."""
    if shading.normals == "smooth":
        return None
    if shading.normals == "flat":
        return 0.0
    normals = face_normals(surface.vertices, surface.faces)
    wound = winding(surface, normals)
    to_length_one(normals)
    for x in normals:
        np.negative(x, out=x, where=wound.turn)
    is_creased = shading.normals == "creased" or has_creases(
        surface, wound.edges, bends(normals, wound), shading.crease
    )
    return shading.crease if is_creased else None


def normals_shading(shading: Shading) -> Shading:
    """The same for all kinds of shading that `drawable` makes the same mesh for."""
    if shading.normals in ("smooth", "flat"):
        return Shading("smooth")
    return Shading(shading.normals, shading.crease)


def poly_data(vertices: FloatArray, faces: IntArray, normals: AnyArray) -> vtkPolyData:
    """Vertices (n, 3) with normals (n, 3), and faces (m, 3), in their own memory."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(vertices))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(faces.ravel()))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    mesh.GetPointData().SetNormals(numpy_to_vtk(normals))
    mesh.ComputeBounds()
    return mesh


def copies_of(mesh: vtkPolyData) -> IntArray:
    """(k,) of which vertices of the surface the points behind its own are copies."""
    array = mesh.GetFieldData().GetArray(_COPIES)
    return np.empty(0, np.int64) if array is None or not array.GetNumberOfTuples() else vtk_to_numpy(array)


def faces_of(mesh: vtkPolyData) -> IntArray:
    """(m, 3) the points of its faces."""
    faces: IntArray = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return faces


def with_backs_of(mesh: vtkPolyData, other: vtkPolyData) -> None:
    """Let a mesh have an inside that can be seen, if another has."""
    array = other.GetFieldData().GetArray(_BACKS)
    if array is not None:
        mesh.GetFieldData().AddArray(array)


def has_backs(mesh: vtkPolyData) -> bool:
    """Whether the inside of a body can be seen."""
    array = mesh.GetFieldData().GetArray(_BACKS)
    return array is not None and bool(array.GetValue(0))


def outward_faces(mesh: vtkPolyData) -> IntArray | None:
    """(m, 3) vertices of the surface's faces, wound so that they go round to the left seen from outside.

    None if no inside can be seen.
    """
    return vertex_faces(mesh) if has_backs(mesh) else None


def vertex_faces(mesh: vtkPolyData) -> IntArray:
    """(m, 3) vertices of the surface's faces, wound as they are drawn."""
    copies = copies_of(mesh)
    return np.append(np.arange(mesh.GetNumberOfPoints() - len(copies)), copies)[faces_of(mesh)]
