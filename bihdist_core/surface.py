"""A triangle mesh, checked once and never changed: the input of everything else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from importlib import import_module
from math import isfinite
from operator import index
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from .arrays import BoolArray, FloatArray, IntArray, array_of, real_numbers
from .coincident_points import merged_within
from .counts import counted
from .errors import MeshError, ParameterError, VertexError
from .kernel.library import library
from .mesh_arrays import checked_faces, checked_vertices, place_unused
from .mesh_like import MeshLike, Rows

Coordinates = FloatArray | list[FloatArray]
"""(3, m): vectors, each coordinate for itself."""

FLAT_RATIO = 1e-7
"""A face whose height is less than this share of its longest side is flat (see `degenerate_faces`)."""


@dataclass(frozen=True, eq=False)
class Surface:
    """A triangle mesh, checked once and never changed.

    Parameters
    ----------
    vertices : (n, 3) array_like
        Coordinates; kept as a read-only float64 copy.
    faces : (m, 3) array_like of int
        Vertex ids; kept as a read-only int64 copy.
    name : str
        Name for messages.
    repairs : sequence of str
        What was repaired while a file was read, in words.
    facts : sequence of str
        How a file was read where that is no repair, such as polygons that were divided into triangles.

    Raises
    ------
    MeshError
        For wrong shapes, a coordinate that is not finite (but NaN at a vertex of no face), a vertex id out of range, or
        no faces.

    Notes
    -----
    Vertex ids are the caller's and never change.  Faces that name a vertex twice and repeated faces (same three
    vertices) are dropped, which `repairs` says.

    Examples
    --------
    >>> import bihdist
    >>> corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> square = bihdist.Surface(corners, [[0, 1, 2], [0, 2, 3]])
    >>> square, square.area, square.n_components, len(square.boundary_edges)
    (Surface(surface: 4 vertices, 2 faces), 1.0, 1, 4)
    """

    dimension: ClassVar[int] = 2
    nouns: ClassVar[tuple[str, str]] = ("vertex", "vertices")
    """What one of `vertices` is called, and several."""

    vertices: FloatArray
    faces: IntArray
    name: str = "surface"
    repairs: Sequence[str] = field(default=())
    facts: Sequence[str] = field(default=())

    def __post_init__(self) -> None:
        vertices = checked_vertices(self.vertices, self.name)
        faces, dropped = checked_faces(self.faces, len(vertices), self.name)
        placed = place_unused(vertices, faces, self.name)
        vertices.flags.writeable = faces.flags.writeable = False
        for key, value in [("vertices", vertices), ("faces", faces), ("repairs", (*self.repairs, *dropped))]:
            object.__setattr__(self, key, value)
        object.__setattr__(self, "facts", (*self.facts, *placed))

    @classmethod
    def of(cls, mesh: MeshLike | Rows, faces: npt.ArrayLike | None = None, *, name: str | None = None) -> Surface:
        """Return the surface of a mesh of any kind; a Surface is itself.

        Parameters
        ----------
        mesh : MeshLike
            A path, as of `read_surface`; vertices (n, 3), alone or in a pair with their faces; or an object of PyVista
            (PolyData), trimesh (Trimesh), meshio (Mesh), Open3D (TriangleMesh), nibabel (GiftiImage) or nilearn.
        faces : (m, 3) array_like of int, optional
            The faces, if `mesh` is vertices.
        name : str, optional
            Name for messages.

        Returns
        -------
        Surface
            With the vertex ids of the mesh; polygons are divided into triangles, which `facts` says.

        Raises
        ------
        MeshError
            As `read_surface` and `Surface` raise it, and for an object without faces.
        ParameterError
            For an object of another kind.

        Notes
        -----
        Wherever a surface is asked for, these meshes are taken, too.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.Surface.of(pyvista.Plane(i_resolution=2, j_resolution=2)).facts
        ('4 quads divided into 8 triangles',)
        >>> corners, faces = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        >>> bihdist.Surface.of(corners, faces, name="triangle")
        Surface(triangle: 3 vertices, 1 faces)
        """
        from .formats.mesh_objects import surface_of

        return surface_of(mesh, faces, name)

    def to_pyvista(self, fields: Mapping[str, npt.ArrayLike] | None = None) -> Any:
        """Return a `pyvista.PolyData` with vertex k as point k.

        Parameters
        ----------
        fields : mapping of str, optional
            Arrays (n,) or (n, k) by name, which become point data.

        Returns
        -------
        pyvista.PolyData
            The mesh.

        Raises
        ------
        ImportError
            If PyVista is not installed.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> surface = bihdist.Surface.of(pyvista.Icosphere(nsub=2))
        >>> field = bihdist.BiharmonicDistance(surface).from_source(0)
        >>> shown = surface.to_pyvista({"distance": field})
        >>> shown.n_points, shown.array_names
        (162, ['distance'])
        """
        mesh = import_module("pyvista").PolyData.from_regular_faces(self.vertices, self.faces)
        for name, values in (fields or {}).items():
            mesh.point_data[name] = values
        return mesh

    def to_trimesh(self) -> Any:
        """Return a `trimesh.Trimesh` with the same vertices and faces.

        Returns
        -------
        trimesh.Trimesh
            The mesh.

        Raises
        ------
        ImportError
            If trimesh is not installed.

        Examples
        --------
        >>> import bihdist
        >>> triangle = bihdist.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> float(triangle.to_trimesh().area)
        0.5
        """
        return import_module("trimesh").Trimesh(self.vertices, self.faces, process=False)

    def __getstate__(self) -> dict[str, object]:
        return {each.name: getattr(self, each.name) for each in fields(self)}

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state)
        # Arrays come back from a pickle writeable.
        self.vertices.flags.writeable = self.faces.flags.writeable = False

    def __repr__(self) -> str:
        return f"Surface({self.name}: {len(self.vertices):,} vertices, {len(self.faces):,} faces)"

    def check_vertex(self, vertex: int) -> int:
        """Check a vertex id.

        Parameters
        ----------
        vertex : int
            Any whole number.

        Returns
        -------
        int
            The id.

        Raises
        ------
        VertexError
            If there is no such vertex, or it belongs to no face.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        >>> triangle = bihdist.Surface(corners, [[0, 1, 2]], "triangle")
        >>> try:
        ...     triangle.check_vertex(3)
        ... except bihdist.VertexError as error:
        ...     print(error)
        triangle has no vertex 3; ids run from 0 to 2.
        """
        n = len(self.vertices)
        try:
            vertex = index(None if isinstance(vertex, bool) else vertex)  # type: ignore[arg-type]
        except TypeError:
            raise VertexError(
                f"{self.name}: {vertex!r} is not a vertex id; ids are whole numbers from 0 to {n - 1}."
            ) from None
        if not 0 <= vertex < n:
            raise VertexError(f"{self.name} has no {self.nouns[0]} {vertex}; ids run from 0 to {n - 1}.")
        if self.component_of_vertex[vertex] < 0:
            raise VertexError(f"{self.name}: {self._without_distances(vertex)}")
        return vertex

    def _without_distances(self, vertex: int) -> str:
        """Return why no distance is defined from a vertex, and what to take instead."""
        used = np.flatnonzero(self.component_of_vertex >= 0)
        nearest = used[int(((self.vertices[used] - self.vertices[vertex]) ** 2).sum(axis=1).argmin())]
        why = f"vertex {vertex} belongs to no face, so no distance is defined from it"
        return f"{why}; the nearest that does is {nearest}."

    def check_vertices(self, vertices: npt.ArrayLike | Sequence[object]) -> IntArray:
        """Check vertex ids.

        Parameters
        ----------
        vertices : (k,) array_like of int
            Vertex ids.

        Returns
        -------
        (k,) int64 ndarray
            The ids.

        Raises
        ------
        VertexError
            For the first id that is no vertex, or that belongs to no face.

        Examples
        --------
        >>> import bihdist
        >>> triangle = bihdist.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> triangle.check_vertices([2, 0]).tolist()
        [2, 0]
        """
        try:
            ids = np.atleast_1d(np.asarray(vertices))
        except ValueError:
            raise VertexError(f"{self.name}: vertex ids are one row, and these differ in length.") from None
        n = len(self.vertices)
        # One by one it takes a second for a million.
        if ids.ndim == 1 and ids.dtype.kind in "iu" and ((ids >= 0) & (ids < n)).all():
            known = ids.astype(np.int64)
            if (self.component_of_vertex[known] >= 0).all():
                return known
        return np.array([self.check_vertex(v) for v in ids], np.int64)

    def check_field(self, field: npt.ArrayLike) -> FloatArray:
        """Check the values of a field.

        Parameters
        ----------
        field : (n,) array_like
            A number for each vertex.

        Returns
        -------
        (n,) float64 ndarray
            The values.

        Raises
        ------
        ParameterError
            For another shape, or values that are not real numbers.

        Examples
        --------
        >>> import bihdist
        >>> triangle = bihdist.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> triangle.check_field([1, 2, 3]).dtype
        dtype('float64')
        >>> try:
        ...     triangle.check_field([1, 2])
        ... except bihdist.ParameterError as error:
        ...     print(error)
        A field is a real number for each of 3 vertices, not an array of shape (2,).
        """
        values, n = real_numbers(field, "Values of a field"), len(self.vertices)
        if values.shape != (n,):
            raise ParameterError(
                f"A field is a real number for each of {n:,} vertices, not an array of shape {values.shape}."
            )
        return values

    @property
    def shape(self) -> Surface:
        """The triangles that tell what is in front of what: the surface itself, or between neighbours of points.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=2)
        >>> bihdist.Surface.of(sphere).shape
        Surface(PolyData: 162 vertices, 320 faces)
        """
        return self

    # ------------------------------------------------------------------ connectivity
    @cached_property
    def component_of_vertex(self) -> IntArray:
        """The component of each vertex (n,), the one with most vertices first (0); -1 for a vertex of no face.

        Vertices that share a face are connected, also through a single vertex.

        Examples
        --------
        >>> import bihdist
        >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> others = [[5, 0, 0], [6, 0, 0], [5, 1, 0], [9, 9, 9]]
        >>> surface = bihdist.Surface(square + others, [[4, 5, 6], [0, 1, 2], [0, 2, 3]])
        >>> surface.component_of_vertex.tolist()
        [0, 0, 0, 0, 1, 1, 1, -1]
        """
        n, f = len(self.vertices), self.faces
        label = connected(f.T, n)
        if not label.any():  # then there is but one, with every vertex
            return label
        used = np.zeros(n, bool)
        used[f] = True
        return ranked_components(label, used)

    @property
    def n_vertices(self) -> int:
        """The number of vertices, with those of no face.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 9, 9]]
        >>> surface = bihdist.Surface(corners, [[0, 1, 2]])
        >>> surface.n_vertices, surface.unreferenced_count
        (4, 1)
        """
        return len(self.vertices)

    @property
    def n_faces(self) -> int:
        """The number of faces.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        >>> # the second is the first, turned over
        >>> bihdist.Surface(corners, [[0, 1, 2], [2, 1, 0]]).n_faces
        1
        """
        return len(self.faces)

    @cached_property
    def n_components(self) -> int:
        """The number of connected components.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=1)
        >>> bihdist.Surface.of(sphere + sphere.translate((3, 0, 0))).n_components
        2
        """
        return int(self.component_of_vertex.max()) + 1

    @property
    def largest_component_size(self) -> int:
        """The number of vertices of component 0.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> both = pyvista.Icosphere(nsub=1) + pyvista.Icosphere(nsub=2, center=(3, 0, 0))
        >>> surface = bihdist.Surface.of(both)
        >>> surface.n_vertices, surface.largest_component_size
        (204, 162)
        """
        return int((self.component_of_vertex == 0).sum())

    @property
    def unreferenced_count(self) -> int:
        """The number of vertices that belong to no face.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 9, 9]]
        >>> surface = bihdist.Surface(corners, [[0, 1, 2]])
        >>> surface.unreferenced_count
        1
        >>> bihdist.BiharmonicDistance(surface).from_source(0).round(3).tolist()
        [0.0, 0.612, 0.612, nan]
        """
        return int((self.component_of_vertex < 0).sum())

    def component(self, index: int) -> tuple[Surface, IntArray]:
        """Return one connected component as a surface of its own.

        Parameters
        ----------
        index : int
            The number of the component, 0 for the one with most vertices.

        Returns
        -------
        surface : Surface
            The component.
        ids : (k,) int64 ndarray
            The ids that its vertices have here, ascending.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> both = pyvista.Icosphere(nsub=1) + pyvista.Icosphere(nsub=2, center=(3, 0, 0))
        >>> smaller, ids = bihdist.Surface.of(both).component(1)
        >>> smaller.n_vertices, ids[:3].tolist()
        (42, [0, 1, 2])
        """
        ids = np.flatnonzero(self.component_of_vertex == index)
        if len(ids) == len(self.vertices):
            return self, ids
        new = np.full(len(self.vertices), -1)
        new[ids] = np.arange(len(ids))
        faces = self.faces[self.component_of_vertex[self.faces[:, 0]] == index]
        return Surface(self.vertices[ids], new[faces], self.name), ids

    def merged(self, tolerance: float = 0.0) -> tuple[Surface, IntArray]:
        """Merge vertices that are in one place.

        Parameters
        ----------
        tolerance : float
            Vertices so near to each other, or nearer, are merged; unit length.

        Returns
        -------
        surface : Surface
            The surface with one vertex for each place, that with the least id.  `repairs` says which faces lost a
            corner or became another's and were dropped, `facts` how many vertices were merged.
        ids : (n,) int64 ndarray
            The id there of each vertex here.

        Raises
        ------
        ParameterError
            For a tolerance below 0 or not finite.
        MeshError
            If no face is left.

        Notes
        -----
        No vertex moves farther than the tolerance, those that are left are farther apart, and they keep their order.

        Examples
        --------
        >>> import bihdist
        >>> one, other = [[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> torn = bihdist.Surface(one + other, [[0, 1, 2], [3, 4, 5]])
        >>> whole, new = torn.merged()
        >>> torn.n_components, whole.n_components, new.tolist()
        (2, 1, [0, 1, 2, 0, 2, 3])
        """
        if not (isfinite(tolerance) and tolerance >= 0):
            raise ParameterError(f"A tolerance is a length, 0 or more, not {tolerance!r}.")
        kept, ids = merged_within(self.vertices, tolerance)
        count = len(ids) - len(kept)
        if not count:
            return self, ids
        fact = f"{counted(count, 'vertex', 'vertices')} merged with others within {tolerance:g}"
        faces = ids[self.faces]
        return Surface(self.vertices[kept], faces, self.name, self.repairs, (*self.facts, fact)), ids

    def without(self, vertices: npt.ArrayLike) -> Surface:
        """Cut vertices out: the faces that touch them are gone, and all ids stay as they are.

        Parameters
        ----------
        vertices : (k,) array_like of int, or (n,) array_like of bool
            Ids, or True for the vertices that go.

        Returns
        -------
        Surface
            The vertices cut out are still there, like others that are left without a face, and have no distance (NaN);
            `repairs` says how much is gone.

        Raises
        ------
        VertexError
            For ids that are not on the surface.
        ParameterError
            For what is neither ids nor booleans.
        MeshError
            If no face is left.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> square = bihdist.Surface(corners, [[0, 1, 2], [0, 2, 3]])
        >>> square.without([1])
        Surface(surface: 4 vertices, 1 faces)
        >>> square.without(square.vertices[:, 1] < square.vertices[:, 0]).unreferenced_count
        1
        """
        gone = self._chosen(vertices)
        left = np.flatnonzero(~gone[self.faces].any(axis=1))
        if not len(left):
            raise MeshError(f"{self.name}: no face is left without {counted(int(gone.sum()), 'vertex', 'vertices')}.")
        if len(left) == len(self.faces):
            return self
        n_faces = counted(len(self.faces) - len(left), "face")
        cut = f"{counted(int(gone.sum()), 'vertex', 'vertices')} cut out, with {n_faces}"
        return Surface(self.vertices, self.faces[left], self.name, (*self.repairs, cut), self.facts)

    def _chosen(self, vertices: npt.ArrayLike) -> BoolArray:
        """Return (n,) whether a vertex is among ids (k,), or those of booleans (n,), be it of a face or not."""
        n, found = len(self.vertices), array_of(vertices, "Vertices")
        is_ids = found.ndim == 1 and (found.dtype.kind in "iu" or not found.size)
        if found.shape != (n,) if found.dtype.kind == "b" else not is_ids:
            raise ParameterError(
                f"Vertices are ids (k,), or booleans for all {n:,} of {self.name}, and no {found.dtype} array of shape "
                f"{found.shape}."
            )
        ids = np.flatnonzero(found) if found.dtype.kind == "b" else found.astype(np.int64)
        wrong = ids[(ids < 0) | (ids >= n)]
        if len(wrong):
            raise VertexError(f"{self.name} has no {self.nouns[0]} {wrong[0]}; ids run from 0 to {n - 1}.")
        chosen = np.zeros(n, bool)
        chosen[ids] = True
        return chosen

    @cached_property
    def _sides(self) -> tuple[IntArray, IntArray]:
        """The edges (e, 2), ascending, and the edge of each face's sides 01, 12, 20 (3m,), all 01 first."""
        f, n = self.faces, len(self.vertices)
        if lib := library():
            edges, of_side = np.empty((f.size, 2), np.int64), np.empty(f.size, np.int64)
            count = lib.bih_edges(n, len(f), f, edges, of_side, np.empty(n + 1 + 2 * f.size, np.int32))
            return edges[:count].copy(), of_side
        tail, head = f.T.ravel(), f[:, [1, 2, 0]].T.ravel()
        key = np.minimum(tail, head) * n + np.maximum(tail, head)
        # Not by np.unique: where that counts, other Python threads stand still.
        order = key.argsort()
        key = key[order]
        first = np.append(True, key[1:] != key[:-1])
        of_side = np.empty(len(key), np.int64)
        of_side[order] = np.cumsum(first.astype(np.int64)) - 1
        return np.stack(np.divmod(key[first], n), 1), of_side

    @property
    def edges(self) -> IntArray:
        """The vertex ids (e, 2) of the edges, smaller first, each edge once.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> square = bihdist.Surface(corners, [[0, 1, 2], [0, 2, 3]])
        >>> square.edges.tolist()
        [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
        """
        return self._sides[0]

    @property
    def edge_of_side(self) -> IntArray:
        """The edge of each face's sides 01, 12, 20 (3m,), all 01 first, then all 12, then all 20.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> square = bihdist.Surface(corners, [[0, 1, 2], [0, 2, 3]])
        >>> square.edge_of_side.tolist()
        [0, 1, 3, 4, 1, 2]
        >>> square.edges[square.edge_of_side[4]].tolist()  # side 20 of face 0
        [0, 2]
        """
        return self._sides[1]

    @cached_property
    def faces_per_edge(self) -> IntArray:
        """The number of faces that meet at each edge (e,), 1 on a boundary, more than 2 where not manifold.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> square = bihdist.Surface(corners, [[0, 1, 2], [0, 2, 3]])
        >>> square.faces_per_edge.tolist()  # the diagonal, edge 1, has two
        [1, 2, 1, 1, 1]
        """
        return np.bincount(self._sides[1], minlength=len(self.edges))

    @property
    def boundary_edges(self) -> IntArray:
        """The edges (b, 2) with one face.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> square = bihdist.Surface(corners, [[0, 1, 2], [0, 2, 3]])
        >>> square.boundary_edges.tolist()
        [[0, 1], [0, 3], [1, 2], [2, 3]]
        """
        edges: IntArray = self.edges[self.faces_per_edge == 1]
        return edges

    @cached_property
    def boundary_loop_count(self) -> int:
        """The number of connected pieces of the boundary.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> tube = pyvista.Cylinder(resolution=12, capping=False).clean()
        >>> bihdist.Surface.of(tube).boundary_loop_count
        2
        """
        b = self.boundary_edges
        if not len(b):
            return 0
        ends, b = np.unique(b, return_inverse=True)
        b = b.reshape(-1, 2)
        return int(connected(b.T, len(ends)).max()) + 1

    @property
    def nonmanifold_edge_count(self) -> int:
        """The number of edges with more than two faces.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, 0, 0]]
        >>> bihdist.Surface(corners, [[0, 1, 2], [0, 1, 3], [0, 1, 4]]).nonmanifold_edge_count
        1
        """
        return int((self.faces_per_edge > 2).sum())

    @property
    def nonmanifold_vertex_count(self) -> int:
        """The number of vertices whose faces fall apart into several fans.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0]]
        >>> bow_tie = bihdist.Surface(corners, [[0, 2, 1], [0, 3, 4]])
        >>> bow_tie.nonmanifold_vertex_count
        1
        """
        return len(self.nonmanifold_vertices)

    @cached_property
    def nonmanifold_vertices(self) -> IntArray:
        """The vertices (k,) whose faces fall apart into several fans.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0]]
        >>> bow_tie = bihdist.Surface(corners, [[0, 2, 1], [0, 3, 4]])
        >>> bow_tie.nonmanifold_vertices.tolist()
        [0]
        """
        m = len(self.faces)
        # Two corners at one vertex are in one fan if their faces share an edge there.  Side s of a face has the
        # corners s and s + 1; the corners of a face are numbered face + m * corner.
        of_side = self._sides[1]
        order = np.argsort(of_side, kind="stable")
        same = np.flatnonzero(of_side[order][1:] == of_side[order][:-1])
        left, right = order[same], order[same + 1]
        corner = self.faces.T.ravel()

        def ends(side: IntArray) -> tuple[IntArray, IntArray]:
            a, b = side, side % m + (side // m + 1) % 3 * m
            swap = corner[a] > corner[b]
            return np.where(swap, b, a), np.where(swap, a, b)

        joined = np.concatenate([np.stack(pair) for pair in zip(ends(left), ends(right), strict=True)], axis=1)
        fan = connected(joined, 3 * m)
        vertex_of_fan = np.empty(fan.max() + 1, np.int64)
        vertex_of_fan[fan] = corner
        return np.flatnonzero(np.bincount(vertex_of_fan) > 1)

    @property
    def is_manifold(self) -> bool:
        """True if no edge has more than two faces, and the faces of each vertex are one fan.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.Surface.of(pyvista.Icosphere(nsub=1)).is_manifold
        True
        >>> corners = [[0, 0, 0], [1, 1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0]]
        >>> bow_tie = bihdist.Surface(corners, [[0, 2, 1], [0, 3, 4]])
        >>> bow_tie.is_manifold
        False
        """
        return self.nonmanifold_edge_count == 0 and self.nonmanifold_vertex_count == 0

    @property
    def genus(self) -> int | None:
        """Handles of all components together; None where the mesh is not manifold or not orientable.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = bihdist.Surface.of(pyvista.Icosphere(nsub=2))
        >>> sphere.genus, bihdist.with_handle(sphere, 0, 200).genus
        (0, 1)
        """
        used = len(self.vertices) - self.unreferenced_count
        twice = 2 * self.n_components - self.boundary_loop_count - (used - len(self.edges) + len(self.faces))
        return twice // 2 if self.is_manifold and twice % 2 == 0 else None

    # ------------------------------------------------------------------ measures
    def sides(self) -> list[FloatArray]:
        """Return the sides of each face as vectors.

        Returns
        -------
        list of (3, m) float64 ndarray
            Side k is opposite to corner k, with coordinates first: each step then runs over contiguous memory, which is
            several times faster.

        Examples
        --------
        >>> import bihdist
        >>> triangle = bihdist.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> first, second, third = triangle.sides()
        >>> first.ravel().tolist(), (first + second + third).ravel().tolist()
        ([-1.0, 1.0, 0.0], [0.0, 0.0, 0.0])
        """
        x, f = np.ascontiguousarray(self.vertices.T), self.faces
        corners = [x.take(f[:, k], axis=1) for k in range(3)]
        return [corners[(k + 2) % 3] - corners[(k + 1) % 3] for k in range(3)]

    @cached_property
    def _face_measures(self) -> tuple[FloatArray, FloatArray]:
        """The areas (m,) and the squares of the longest edges (m,)."""
        if lib := library():
            areas, longest = np.empty((2, len(self.faces)))
            lib.bih_measures(len(self.faces), self.vertices, self.faces, areas, longest)
            return areas, longest
        a, b, c = self.sides()
        normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        longest = np.maximum(np.maximum(dots(a, a), dots(b, b)), dots(c, c))
        return np.sqrt(dots(normal, normal)) / 2, longest

    @property
    def face_areas(self) -> FloatArray:
        """The areas (m,) of the faces, unit length squared.

        Examples
        --------
        >>> import bihdist
        >>> bihdist.Surface([[0, 0, 0], [3, 0, 0], [0, 4, 0]], [[0, 1, 2]]).face_areas.tolist()
        [6.0]
        """
        return self._face_measures[0]

    @property
    def area(self) -> float:
        """The area of all faces together, unit length squared.

        Examples
        --------
        >>> import bihdist, math, pyvista
        >>> sphere = bihdist.Surface.of(pyvista.Icosphere(nsub=3))
        >>> # a little less than the sphere it approximates
        >>> print(f"{sphere.area / (4 * math.pi):.4f}")
        0.9952
        """
        return float(self.face_areas.sum())

    @property
    def bounds(self) -> FloatArray:
        """The least and the greatest coordinates (2, 3) of vertices that belong to a face.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [3, 0, 0], [0, 4, 0], [9, 9, 9]]  # the last is of no face
        >>> bihdist.Surface(corners, [[0, 1, 2]]).bounds.tolist()
        [[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]]
        """
        used = self.vertices[self.component_of_vertex >= 0]
        return np.stack([used.min(axis=0), used.max(axis=0)])

    @cached_property
    def face_heights(self) -> FloatArray:
        """The faces' heights (m,) over their longest sides, as a share of these; 0 for three points in one place.

        Examples
        --------
        >>> import bihdist
        >>> sliver = bihdist.Surface([[0, 0, 0], [1, 0, 0], [0.5, 0.001, 0]], [[0, 1, 2]])
        >>> sliver.face_heights.tolist()
        [0.001]
        """
        areas, longest = self._face_measures
        return 2 * areas / np.where(longest > 0, longest, 1)

    @cached_property
    def degenerate_faces(self) -> IntArray:
        """The faces (k,) of (nearly) no area, with a height less than the fraction `FLAT_RATIO` of the longest side.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]]
        >>> bihdist.Surface(corners, [[0, 1, 3], [0, 1, 2]]).degenerate_faces.tolist()
        [1]
        """
        return np.flatnonzero(self.face_heights < FLAT_RATIO)

    @cached_property
    def in_proper_face(self) -> BoolArray:
        """Whether each vertex (n,) belongs to a face that is not degenerate.

        Examples
        --------
        >>> import bihdist
        >>> corners = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]]
        >>> bihdist.Surface(corners, [[0, 1, 3], [0, 1, 2]]).in_proper_face.tolist()
        [True, True, False, True]
        """
        proper = np.zeros(len(self.vertices), bool)
        proper[np.delete(self.faces, self.degenerate_faces, axis=0)] = True
        return proper

    @cached_property
    def mean_edge_length(self) -> float:
        """Mean length of the edges, unit length.

        Examples
        --------
        >>> import bihdist
        >>> bihdist.Surface([[0, 0, 0], [3, 0, 0], [0, 4, 0]], [[0, 1, 2]]).mean_edge_length
        4.0
        """
        i, j = self.edges.T
        x = np.ascontiguousarray(self.vertices.T)
        along = x.take(i, axis=1) - x.take(j, axis=1)
        return float(np.sqrt(dots(along, along)).mean())


def with_faces(mesh: MeshLike, what: str) -> Surface:
    """Return the surface of a mesh; ParameterError where it has no faces, which `what` needs, in the plural."""
    surface = Surface.of(mesh)
    if not len(surface.faces):
        raise ParameterError(f"{surface.name}: {what} need faces, and there are none.")
    return surface


def dots(a: Coordinates, b: Coordinates) -> FloatArray:
    """Return (m,) inner products of (3, m) columns; faster than einsum along the short axis."""
    product = a[0] * b[0]
    product += a[1] * b[1]
    product += a[2] * b[2]
    return product


def vertex_normals(surface: Surface) -> FloatArray:
    """Return (n, 3) unit normals at the vertices, by face area; 0 where there is none."""
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    total = np.zeros_like(surface.vertices)
    for k in range(3):
        np.add.at(total, surface.faces[:, k], cross)
    normals: FloatArray = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)
    return normals


def connected(edges: IntArray, n: int) -> IntArray:
    """Return (n,) component, from 0 in the order of their least vertices, of each vertex of a graph with edges (2, e),
    or with the sides of faces (3, m).

    Without the compiled kernel each tree joins that of its least neighbour, until none has a neighbour: some ten rounds
    (Liu and Tarjan, Simple Concurrent Connected Components Algorithms, 2022).  SciPy's search is slower.
    """
    if lib := library():
        label, rows = np.empty(n, np.int64), np.ascontiguousarray(edges.T, np.int64)
        lib.bih_connected(n, *rows.shape, rows, label)
        return label
    root = np.arange(n)
    i, j = edges[:-1].ravel(), edges[1:].ravel()
    while len(i):
        low, high = np.minimum(i, j), np.maximum(i, j)
        np.minimum.at(root, high, low)
        while not np.array_equal(root, above := root.take(root)):
            root = above
        i, j = root.take(low), root.take(high)
        apart = np.flatnonzero(i != j)
        i, j = i.take(apart), j.take(apart)
    # Not counted in booleans, which would hold up other Python threads.
    return (np.cumsum((root == np.arange(n)).astype(np.int64)) - 1).take(root)


def ranked_components(label: IntArray, used: BoolArray) -> IntArray:
    """Return (n,) components, the one with most vertices first (0), of labels (n,); -1 for vertices that are not used
    (n,)."""
    count = np.bincount(label[used])
    rank = np.empty(len(count), np.int64)
    rank[np.argsort(-count, kind="stable")] = np.arange(len(count))
    return np.where(used, rank[np.minimum(label, len(count) - 1)], -1)
