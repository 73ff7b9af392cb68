"""Types that `Surface.of` takes: paths, arrays, and objects of other libraries by the attributes that are read."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Protocol, TypeAlias

from .arrays import AnyArray

Rows: TypeAlias = AnyArray | Sequence[Sequence[float]]
"""(n, 3) coordinates or (m, 3) vertex ids."""


class VerticesAndFaces(Protocol):
    """A `Surface`, or a `Trimesh` of trimesh."""

    @property
    def vertices(self) -> Any:
        """The coordinates (n, 3)."""

    @property
    def faces(self) -> Any:
        """The faces' vertex ids (m, 3)."""


class VerticesAndTriangles(Protocol):
    """A `TriangleMesh` of Open3D."""

    @property
    def vertices(self) -> Any:
        """The coordinates (n, 3)."""

    @property
    def triangles(self) -> Any:
        """The triangles' vertex ids (m, 3)."""


class CoordinatesAndFaces(Protocol):
    """An `InMemoryMesh` or a `FileMesh` of nilearn."""

    @property
    def coordinates(self) -> Any:
        """The coordinates (n, 3)."""

    @property
    def faces(self) -> Any:
        """The faces' vertex ids (m, 3)."""


class PointsAndPolygons(Protocol):
    """A `PolyData` of PyVista."""

    @property
    def points(self) -> Any:
        """The coordinates (n, 3)."""

    @property
    def regular_faces(self) -> Any:
        """The faces' point ids (m, k), where all faces have as many corners."""


class PointsAndCells(Protocol):
    """A `Mesh` of meshio."""

    @property
    def points(self) -> Any:
        """The coordinates (n, 3)."""

    @property
    def cells_dict(self) -> Any:
        """Arrays of point ids by the type of cells."""


class DataByIntent(Protocol):
    """A `GiftiImage` of nibabel."""

    @property
    def agg_data(self) -> Any:
        """A function from a word to its array."""


MeshLike: TypeAlias = (
    str
    | os.PathLike[str]
    | tuple[Rows, Rows]
    | VerticesAndFaces
    | VerticesAndTriangles
    | CoordinatesAndFaces
    | PointsAndPolygons
    | PointsAndCells
    | DataByIntent
)
"""A mesh of any kind: what `Surface.of` takes and, like it, all that asks for a surface."""
