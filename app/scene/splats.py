"""Points as VTK draws them: a hexagon about each, in the plane of its neighbours and as large as its spacing.

A field is continued over each hexagon by its slope there, so that neighbours, which overlap, agree, and isolines go on
from one to the next.
"""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from bihdist_core import PointCloud
from bihdist_core.arrays import AnyArray, FloatArray, IntArray

CORNERS = 6
SIZE = 0.9
"""Distance of a hexagon's corners from its point, in mean distances of the point's neighbours."""

_ENDS, _SLOPES = "ends", "slopes"
_TURN = 2 * np.pi * np.arange(CORNERS) / CORNERS
FAN = np.array([[0, k, k + 1] for k in range(1, CORNERS - 1)])


def hexagons(cloud: PointCloud) -> tuple[FloatArray, IntArray, IntArray]:
    """Return the corners (6k, 3) of hexagons, their faces (4k, 3), and the points (6k,) that corners belong to.

    Corners are numbered from the number of points on.
    """
    shown = np.flatnonzero(cloud.component_of_vertex >= 0)
    across, along = _axes(cloud.normals)
    radius = SIZE * _spacing(cloud)
    offset = np.cos(_TURN)[:, None] * across[shown, None] + np.sin(_TURN)[:, None] * along[shown, None]
    corners = cloud.vertices[shown, None] + radius[shown, None, None] * offset
    first = len(cloud.vertices) + CORNERS * np.arange(len(shown))
    return corners.reshape(-1, 3), (first[:, None, None] + FAN).reshape(-1, 3), np.repeat(shown, CORNERS)


def put_slopes(mesh: vtkPolyData, cloud: PointCloud) -> None:
    """Keep with a mesh how fields change over its hexagons, for `at_corners`."""
    # The slope of the plane that fits differences to all neighbours best.
    (i, j), axes = np.concatenate([cloud.edges, cloud.edges[:, ::-1]]).T, _axes(cloud.normals)
    apart = cloud.vertices[j] - cloud.vertices[i]
    p, q = (np.einsum("ij,ij->i", apart, axis[i]) for axis in axes)
    pp, pq, qq = (np.bincount(i, each, len(cloud.vertices)) for each in (p * p, p * q, q * q))
    area = pp * qq - pq**2
    factor = SIZE * _spacing(cloud) / np.where(area > 1e-6 * (pp + qq) ** 2, area, np.inf)
    slopes = np.stack([(qq[i] * p - pq[i] * q) * factor[i], (pp[i] * q - pq[i] * p) * factor[i]], axis=1)
    ends = numpy_to_vtkIdTypeArray(np.stack([i, j], axis=1), deep=True)
    for array, name in ((ends, _ENDS), (numpy_to_vtk(slopes, deep=True), _SLOPES)):
        array.SetName(name)
        mesh.GetFieldData().AddArray(array)


def is_of_points(mesh: vtkPolyData) -> bool:
    """Return whether a mesh is of hexagons."""
    return mesh.GetFieldData().GetArray(_ENDS) is not None


def at_corners(mesh: vtkPolyData, values: AnyArray, undefined: float) -> AnyArray | None:
    """Return a field (n,) at the corners (6k,) of hexagons; None for a mesh that has none."""
    if not is_of_points(mesh):
        return None
    (i, j), slopes = (
        vtk_to_numpy(mesh.GetFieldData().GetArray(_ENDS)).T,
        vtk_to_numpy(mesh.GetFieldData().GetArray(_SLOPES)).T,
    )
    # Beside what is undefined nothing is known of the slope.
    change = np.where((values[i] == undefined) | (values[j] == undefined), 0.0, values[j] - values[i])
    across, along = (np.bincount(i, change * each, len(values)) for each in slopes)
    least, most = values.copy(), values.copy()
    known = change != 0
    np.minimum.at(least, i[known], values[j[known]])
    np.maximum.at(most, i[known], values[j[known]])
    corners = values[:, None] + across[:, None] * np.cos(_TURN) + along[:, None] * np.sin(_TURN)
    clipped: AnyArray = np.clip(corners, least[:, None], most[:, None]).ravel()
    return clipped


def _axes(normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two unit vectors (n, 3) each at right angles to normals and to each other."""
    least = np.eye(3)[np.abs(normals).argmin(axis=1)]
    across = np.cross(normals, least)
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    return across, np.cross(normals, across)


def _spacing(cloud: PointCloud) -> FloatArray:
    """Return the mean distance (n,) of each point's neighbours."""
    i, j = cloud.edges.T
    length = np.linalg.norm(cloud.vertices[i] - cloud.vertices[j], axis=1)
    ends = np.concatenate([i, j])
    total = np.bincount(ends, np.tile(length, 2), len(cloud.vertices))
    return total / np.maximum(np.bincount(ends, minlength=len(cloud.vertices)), 1)
