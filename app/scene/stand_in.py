"""Stand-ins for large surfaces while the camera moves: a point for each cluster of near vertices.

Clusters are the cells of a grid, each parted where the surface turns away, so that two sheets in one cell stay two.
Made in a third of a second for a million vertices, by NumPy, most of which releases the interpreter lock.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from bihdist_core.arrays import AnyArray, FloatArray, IntArray

from .drawable import copies_of, faces_of, poly_data, with_backs_of
from .face_look import map_attribute
from .splats import CORNERS, FAN, is_of_points

CLUSTERS = 40_000
"""About how many there are."""

NONE: Mapping[str, vtkDataArray] = MappingProxyType({})

WORTHWHILE = 2
"""Surfaces with fewer than so many times as many vertices are drawn themselves."""

CELLS_PER_PATCH = 1.5
"""Cells of a grid that a surface passes through, by how many of their sides would cover it."""

APART, APART_AT_CREASES = 0.0, 0.7
"""The cosine between normals of one cell from which on they belong to one cluster."""

MOST_CELLS = 1 << 20
"""Along a side of the grid, so that cells have numbers of 64 bits."""


class StandIn:
    """Clusters (k,) of a surface's points, with normals, and the faces whose corners lie in three of them."""

    def __init__(self, mesh: vtkPolyData, of_point: IntArray, count: int) -> None:
        self.mesh = mesh
        self._of_point, self._count = of_point, count

    def averaged(self, values: AnyArray, undefined: float) -> AnyArray:
        """Return means (k,) float32 of values (n,) over each cluster; `undefined` where all of its values are."""
        known = values != undefined
        if known.all():
            points, known_values = self._of_point, values
        else:
            points, known_values = self._of_point[known], values[known]
        # Points of no face are in a cluster of their own behind the others.
        count = np.bincount(points, minlength=self._count + 1)[:-1]
        total = np.bincount(points, known_values, self._count + 1)[:-1]
        return np.where(count > 0, total / np.maximum(count, 1), undefined).astype(np.float32)


def stand_in(mesh: vtkPolyData, clusters: int = CLUSTERS) -> StandIn | None:
    """Make the stand-in of a mesh made by `drawable`, on any thread; None if that is small or has no area."""
    if is_of_points(mesh):
        return _some_hexagons(mesh, clusters // 2)
    x, faces = vtk_to_numpy(mesh.GetPoints().GetData()), faces_of(mesh)
    used = np.zeros(len(x), bool)
    used[faces.ravel()] = True
    shown = np.flatnonzero(used)
    if len(shown) < WORTHWHILE * clusters:
        return None
    normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
    coordinates = [np.ascontiguousarray(each) for each in x.T]
    least = APART_AT_CREASES if len(copies_of(mesh)) else APART
    cluster = _clusters([each[shown] for each in coordinates], normals[shown], _side(x, faces, clusters), least)
    count = int(cluster.max()) + 1
    of_point = np.full(len(x), count)
    of_point[shown] = cluster
    size = np.bincount(cluster, minlength=count)
    centres = np.stack([np.bincount(cluster, each[shown], count) / size for each in coordinates], 1)
    sums = [np.bincount(cluster, np.ascontiguousarray(each)[shown], count) for each in normals.T]
    means = np.stack(sums, 1).astype(float, copy=False)
    means /= np.maximum(np.linalg.norm(means, axis=1, keepdims=True), 1e-30)
    kept = _faces(of_point, faces, centres, means)
    if not len(kept):
        return None
    made = poly_data(centres, kept, means.astype(np.float32))
    with_backs_of(made, mesh)
    return StandIn(made, of_point, count)


def _some_hexagons(mesh: vtkPolyData, most: int) -> StandIn | None:
    """Return every so many of a mesh's hexagons, larger, as a stand-in; None if there are few."""
    x, copies = vtk_to_numpy(mesh.GetPoints().GetData()), copies_of(mesh)
    step = -(-len(copies) // (CORNERS * most))
    if step < WORTHWHILE:
        return None
    chosen = np.arange(len(copies)).reshape(-1, CORNERS)[::step].ravel()
    corners = len(x) - len(copies) + chosen
    centres = x[copies[chosen]]
    places = centres + np.sqrt(step) * (x[corners] - centres)
    faces = (CORNERS * np.arange(len(chosen) // CORNERS)[:, None, None] + FAN).reshape(-1, 3)
    normals = vtk_to_numpy(mesh.GetPointData().GetNormals())[corners]
    of_point = np.full(len(x), len(corners))
    of_point[corners] = np.arange(len(corners))
    return StandIn(poly_data(places, faces, normals), of_point, len(corners))


def _side(x: FloatArray, faces: IntArray, clusters: int) -> float:
    """Return the side of a cell, such that the surface passes through about as many cells as clusters are wanted."""
    # Some of the faces tell the area well enough.
    some = faces[:: max(1, len(faces) // 100_000)]
    a, b, c = (x[some[:, k]] for k in range(3))
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2 * len(faces) / len(some)
    return float(np.sqrt(CELLS_PER_PATCH * area / clusters))


def _clusters(x: list[FloatArray], normals: AnyArray, side: float, least: float) -> IntArray:
    """Return the cluster (n,) of each point.

    The points of a cell whose normals have less than the `least` cosine with its first normal are a cluster of their
    own.
    """
    lows = [float(each.min()) for each in x]
    longest = max(float(each.max()) - low for each, low in zip(x, lows, strict=True))
    side = max(side, longest / (MOST_CELLS - 1), np.finfo(float).tiny)
    key = np.zeros(len(x[0]), np.int64)
    for each, low in zip(x, lows, strict=True):
        key *= MOST_CELLS
        key += ((each - low) / side).astype(np.int64)
    order = key.argsort()
    sorted_key = key[order]
    begins = np.append(True, sorted_key[1:] != sorted_key[:-1])
    cell = np.cumsum(begins.astype(np.int64)) - 1
    first = order[np.flatnonzero(begins)]
    n = normals[order]
    along = np.einsum("ij,ij->i", n, normals[first][cell])
    # Numbers of halves of cells, and then only of those that are there.
    half = 2 * cell + (along < least)
    is_there = np.zeros(2 * len(first), np.int64)
    is_there[half] = 1
    number = np.cumsum(is_there) - 1
    found = np.empty(len(key), np.int64)
    found[order] = number[half]
    return found


def _faces(of_point: IntArray, faces: IntArray, centres: FloatArray, normals: FloatArray) -> IntArray:
    """Return the faces (m, 3) with corners in three clusters, each once, without those that are turned over."""
    a, b, c = (of_point.take(faces[:, k]) for k in range(3))
    whole = np.flatnonzero((a != b) & (b != c) & (c != a))
    found = np.stack([a[whole], b[whole], c[whole]], 1)
    p, q, r = (centres[found[:, k]] for k in range(3))
    is_ahead = np.einsum("ij,ij->i", np.cross(q - p, r - p), normals[found].sum(axis=1)) > 0
    found = found[is_ahead]
    ordered = np.sort(found, axis=1)
    count = len(centres)
    by_corners = ((ordered[:, 0] * count + ordered[:, 1]) * count + ordered[:, 2]).argsort(kind="stable")
    ordered = ordered[by_corners]
    is_first = np.ones(len(ordered), bool)
    is_first[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    return np.ascontiguousarray(found[by_corners[is_first]])


class StandInActor:
    """Draws a stand-in as another actor draws its surface: with its properties and shaders; hidden at first."""

    def __init__(self, full: vtkActor) -> None:
        self._full = full
        self.stand_in: StandIn | None = None
        self._values = np.empty(0, np.float32)
        self._array = numpy_to_vtk(self._values)
        self._tints: dict[str, vtkDataArray] = {}
        self._averaged: tuple[int, int] | None = None  # of which array, and when that was last changed
        self.mapper = vtkPolyDataMapper()
        self.actor = vtkActor()
        self.actor.SetMapper(self.mapper)
        self.actor.SetProperty(full.GetProperty())
        self.actor.SetShaderProperty(full.GetShaderProperty())
        self.actor.VisibilityOff()

    def take(self, stand_in: StandIn | None) -> None:
        """Stand in for another surface; None if nothing can."""
        self.show(False)
        self.stand_in, self._averaged, self._tints = stand_in, None, {}
        if stand_in is None:
            self.mapper.SetInputData(vtkPolyData())
            return
        own = vtkPolyData()
        own.ShallowCopy(stand_in.mesh)
        self._values = np.empty(own.GetNumberOfPoints(), np.float32)
        self._array = numpy_to_vtk(self._values)
        own.GetPointData().AddArray(self._array)
        self.mapper.SetInputData(own)

    @property
    def is_shown(self) -> bool:
        """True if the next picture is of the stand-in."""
        return bool(self.actor.GetVisibility())

    def show(
        self,
        is_shown: bool,
        values: vtkDataArray | None = None,
        undefined: float = 0.0,
        tints: Mapping[str, vtkDataArray] = NONE,
    ) -> None:
        """Draw this instead of the other actor, or that again.

        Parameters
        ----------
        values
            (n,) of all points of the surface, under the name that they have there.
        tints
            (n, 4) colours or (n,) shares, by the names that the shader knows.
        """
        if is_shown and self.stand_in is not None and values is not None:
            self._follow(self.stand_in, values, undefined)
            self._follow_tints(self.stand_in, tints)
        else:
            is_shown = False
        if is_shown != self.is_shown:
            self.actor.SetVisibility(is_shown)
            self._full.SetVisibility(not is_shown)

    def _follow(self, stand_in: StandIn, values: vtkDataArray, undefined: float) -> None:
        """Show the values of now, in the colours of now."""
        full = self._full.GetMapper()
        if self.mapper.GetLookupTable() is not full.GetLookupTable():
            self.mapper.SetLookupTable(full.GetLookupTable())
        state = (id(values), values.GetMTime())
        if state == self._averaged:
            return
        if self._averaged is None:
            name = values.GetName()
            self._array.SetName(name)
            self.mapper.UseLookupTableScalarRangeOn()
            self.mapper.SetScalarModeToUsePointFieldData()
            self.mapper.SelectColorArray(name)
            self.mapper.InterpolateScalarsBeforeMappingOn()
            map_attribute(self.mapper, "isolineAttribute", name)
        self._averaged = state
        self._values[:] = stand_in.averaged(vtk_to_numpy(values), undefined)
        self._array.Modified()

    def _follow_tints(self, stand_in: StandIn, tints: Mapping[str, vtkDataArray]) -> None:
        """Give each cluster the mean colour of its points, so that it is selected by the fraction of them that are."""
        for name in [name for name in self._tints if name not in tints]:
            del self._tints[name]
            self.mapper.RemoveVertexAttributeMapping(f"{name}Attribute")
        for name, tint in tints.items():
            if self._tints.get(name) is tint:
                continue
            self._tints[name] = tint
            means = [stand_in.averaged(each, np.nan) for each in np.atleast_2d(vtk_to_numpy(tint).T)]
            array = numpy_to_vtk(np.ascontiguousarray(np.stack(means, 1)), deep=True)
            array.SetName(name)
            own = self.mapper.GetInput()
            own.GetPointData().AddArray(array)
            own.Modified()
            map_attribute(self.mapper, f"{name}Attribute", name)
