"""A surface as VTK draws it: with normals, in the surface's own vertex ids, and copies of those at creases."""

from collections.abc import Sequence

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from bihdist_core import PointCloud, Surface
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.surface import connected

from ..document.looks import AS_IT_IS, Shading
from .clipping import Cut
from .creases import bends, face_normals, has_creases, point_normals, split, to_length_one
from .splats import hexagons, put_slopes
from .winding import Winding, winding

SPECK = 0.02
"""Fraction of the surface's extent."""

_COPIES, _BACKS = "copies", "backs"


def drawable(surface: Surface, shading: Shading = AS_IT_IS) -> vtkPolyData:
    """Return the surface for VTK, with point normals.

    The faces are the surface's, in their order.  Vertex k of the surface is point k; points from n on are `copies_of`
    vertices.  The memory is shared where no face has to be turned over and nothing is split.  Flat shading needs no
    normals
    of its own.  Safe to call on a background thread.
    """
    if isinstance(surface, PointCloud):
        return _splats(surface)
    wound, normals = _wound(surface)
    is_cut = np.zeros(len(surface.edges), bool)
    # Faces wound against each other have normals that point to opposite sides.
    is_cut[wound.edges] = wound.is_turned
    if shading.normals in ("auto", "creased"):
        cosines = bends(normals, wound)
        if shading.normals == "creased" or has_creases(surface, wound.edges, cosines, shading.feature_angle):
            is_cut[wound.edges] |= cosines < np.cos(np.radians(shading.feature_angle))
            is_cut |= surface.faces_per_edge > 2
    drawn = split(surface, wound, is_cut)
    vertices, faces = surface.vertices, wound.faces(drawn.faces)
    if len(drawn.copies):
        vertices = np.concatenate([vertices, vertices[drawn.copies]])
    mesh = poly_data(vertices, faces, point_normals(normals, faces, len(vertices)))
    _put_copies(mesh, drawn.copies)
    backs = numpy_to_vtk(np.array([wound.has_backs, wound.has_inside], np.int8), deep=True)
    backs.SetName(_BACKS)
    mesh.GetFieldData().AddArray(backs)
    return mesh


def _splats(cloud: PointCloud) -> vtkPolyData:
    """Return a cloud for VTK, as `drawable`: its points, and corners of hexagons as copies of them."""
    corners, faces, copies = hexagons(cloud)
    normals = np.concatenate([cloud.normals, cloud.normals[copies]]).astype(np.float32)
    mesh = poly_data(np.concatenate([cloud.vertices, corners]), faces, normals)
    _put_copies(mesh, copies)
    put_slopes(mesh, cloud)
    return mesh


def _put_copies(mesh: vtkPolyData, copies: IntArray) -> None:
    array = numpy_to_vtkIdTypeArray(copies, deep=True)
    array.SetName(_COPIES)
    mesh.GetFieldData().AddArray(array)


def _wound(surface: Surface) -> tuple[Winding, list[FloatArray]]:
    """Return the winding of the faces, and their normals as three arrays (m,), of length 1, wound so."""
    normals = face_normals(surface.vertices, surface.faces)
    wound = winding(surface, normals)
    to_length_one(normals)
    if wound.turn.any():
        for x in normals:
            np.negative(x, out=x, where=wound.turn)
    return wound, normals


def crease_of(surface: Surface, shading: Shading) -> float | None:
    """Return the degrees from which on faces that meet are drawn with an edge: 0 for all of them, None for none."""
    if shading.normals == "smooth" or isinstance(surface, PointCloud):
        return None
    if shading.normals == "flat":
        return 0.0
    wound, normals = _wound(surface)
    is_creased = shading.normals == "creased" or has_creases(
        surface, wound.edges, bends(normals, wound), shading.feature_angle
    )
    return shading.feature_angle if is_creased else None


def feature_edges(surface: Surface, shading: Shading, whatever_shading: bool) -> tuple[IntArray, IntArray]:
    """Return edges (k, 2) at which two faces meet at more than the feature angle, and those faces (k, 2).

    There are none where the surface is drawn without creases, unless `whatever_shading`.  Those that are part of
    nothing longer than SPECK are roughness.
    """
    if not (whatever_shading or crease_of(surface, shading)):
        return np.empty((0, 2), np.int64), np.empty((0, 2), np.int64)
    wound, normals = _wound(surface)
    is_sharp = bends(normals, wound) < np.cos(np.radians(shading.feature_angle))
    edges, x = surface.edges[wound.edges[is_sharp]], surface.vertices
    faces = np.stack([wound.left, wound.right], axis=1)[is_sharp] % len(surface.faces)
    part = connected(edges.T, len(x))[edges[:, 0]]
    total = np.bincount(part, np.linalg.norm(x[edges[:, 1]] - x[edges[:, 0]], axis=1))
    is_long = total[part] > SPECK * np.linalg.norm(np.ptp(x[surface.faces.ravel()], axis=0))
    return edges[is_long], faces[is_long]


def normals_shading(shading: Shading) -> Shading:
    """Return the same for all kinds of shading that `drawable` makes the same mesh for."""
    if shading.normals in ("smooth", "flat"):
        return Shading("smooth")
    return Shading(shading.normals, shading.feature_angle)


def poly_data(vertices: FloatArray, faces: IntArray, normals: AnyArray) -> vtkPolyData:
    """Return vertices (n, 3), normals (n, 3) and faces (m, 3) for VTK, which shares their memory."""
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


def with_cut(mesh: vtkPolyData, cut: Cut) -> vtkPolyData:
    """Return a mesh with the faces of a cut behind its own, and the cut's points behind its own."""
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
    ours = np.broadcast_to(cut.normal, cut.points.shape).astype(normals.dtype)
    faces = np.concatenate([faces_of(mesh), cut.faces + len(points)])
    joined = poly_data(np.concatenate([points, cut.points]), faces, np.concatenate([normals, ours]))
    joined.GetFieldData().ShallowCopy(mesh.GetFieldData())
    return joined


def copies_of(mesh: vtkPolyData) -> IntArray:
    """Return the vertices (k,) of the surface of which the points after its own are copies."""
    array = mesh.GetFieldData().GetArray(_COPIES)
    return np.empty(0, np.int64) if array is None or not array.GetNumberOfTuples() else vtk_to_numpy(array)


def faces_of(mesh: vtkPolyData) -> IntArray:
    """Return the points (m, 3) of a mesh's faces."""
    faces: IntArray = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return faces


def with_backs_of(mesh: vtkPolyData, other: vtkPolyData) -> None:
    """Let a mesh have an inside that can be seen, if another has."""
    array = other.GetFieldData().GetArray(_BACKS)
    if array is not None:
        mesh.GetFieldData().AddArray(array)


def has_backs(mesh: vtkPolyData, is_cut: bool = False, opacity: float = 1.0) -> bool:
    """Return whether the inside of a body can be seen, or could be if it is cut, and is to look otherwise.

    Whole bodies that are translucent look the same on both sides.
    """
    if opacity < 1 and not is_cut:
        return False
    array = mesh.GetFieldData().GetArray(_BACKS)
    return array is not None and bool(array.GetValue(int(is_cut)))


def outward_faces(mesh: vtkPolyData, is_cut: bool = False, opacity: float = 1.0) -> IntArray | None:
    """Return the vertices (m, 3) of faces, counter-clockwise seen from outside; None unless it `has_backs`."""
    return vertex_faces(mesh) if has_backs(mesh, is_cut, opacity) else None


def vertex_faces(mesh: vtkPolyData) -> IntArray:
    """Return the surface's vertices (m, 3) of faces as they are drawn."""
    copies = copies_of(mesh)
    return np.append(np.arange(mesh.GetNumberOfPoints() - len(copies)), copies)[faces_of(mesh)]


def warp_by_scalar(surface: Surface, field: FloatArray, top: float, up: float) -> Surface:
    """Return a flat surface raised along z by a field (n,), by `up` where that is `top`, and not where it is NaN."""
    x = surface.vertices
    share = np.clip(np.nan_to_num(field / top), -1, 1) if top > 0 else np.zeros(len(x))
    return Surface(np.column_stack([x[:, :2], x[:, 2] + up * share]), surface.faces, surface.name)


def bounds_of(points: FloatArray) -> list[float]:
    """Return the bounds (x, x, y, y, z, z) of points (n, 3)."""
    bounds: list[float] = np.stack([points.min(axis=0), points.max(axis=0)], axis=1).ravel().tolist()
    return bounds


def rise(bounds: Sequence[float], height: float) -> float:
    """Return the height of a height field: a fraction of the longest side of bounds (x, x, y, y, z, z)."""
    return height * max(high - low for low, high in zip(bounds[::2], bounds[1::2], strict=True))
