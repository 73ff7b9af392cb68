"""Meshes of other libraries into surfaces, by their attributes: none of these libraries is imported."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import MeshError, ParameterError
from ..sentences import shortened
from ..surface import Surface
from ..tetrahedra import TetrahedralMesh
from .mesh_io import read_surface
from .polygons import Polygons, triangulated

ARRAYS = (("vertices", "faces"), ("vertices", "triangles"), ("coordinates", "faces"))
"""Attributes of vertices and faces that objects have: trimesh's, Open3D's, nilearn's."""

KNOWN = (
    "a path, (vertices, faces), or an object of PyVista (PolyData), trimesh (Trimesh), meshio (Mesh), Open3D "
    "(TriangleMesh), nibabel (GiftiImage) or nilearn"
)


def surface_of(mesh: Any, faces: Any = None, name: str | None = None) -> Surface:
    """Return the surface of a mesh of any kind that `Surface.of` lists; raises as that does."""
    if faces is not None:
        if isinstance(mesh, str | os.PathLike):
            raise ParameterError(
                f"{os.fspath(mesh)!r} names a file, which has its own faces; leave out {shortened(repr(faces), 60)}, "
                "or take what `read_surface` reads."
            )
        return Surface(mesh, faces, name or "surface")
    if isinstance(mesh, Surface):
        return mesh
    if isinstance(mesh, str | os.PathLike):
        return read_surface(mesh)
    if isinstance(mesh, tuple | list):
        if len(mesh) != 2:
            raise ParameterError(f"A mesh is {KNOWN}, not a {type(mesh).__name__} of {len(mesh)}.")
        return Surface(mesh[0], mesh[1], name or "surface")
    for is_its, converted in READERS:
        if is_its(mesh):
            return converted(mesh, name or type(mesh).__name__)
    for x, f in ARRAYS:
        if hasattr(mesh, x) and hasattr(mesh, f):
            return Surface(np.asarray(getattr(mesh, x)), np.asarray(getattr(mesh, f)), name or type(mesh).__name__)
    is_graph = any(hasattr(mesh, name) for name in ("edges", "n_edges", "tocsr"))
    hint = " Distances of graphs and matrices take Graph.of(...).laplacian() or Laplacian.from_matrices(...)."
    raise ParameterError(f"A mesh is {KNOWN}, not {type(mesh).__name__}.{hint if is_graph else ''}")


def _of_pyvista(mesh: Any, name: str) -> Surface:
    if not hasattr(mesh, "regular_faces"):
        raise MeshError(f"{name}: only PyVista's PolyData is a surface; take mesh.extract_surface() first.")
    if mesh.n_strips:
        raise MeshError(f"{name}: PyVista's triangle strips are not read; take mesh.triangulate() first.")
    if mesh.is_all_triangles:
        return Surface(mesh.points, mesh.regular_faces, name)
    rings = [np.asarray(ring) for ring in mesh.irregular_faces]
    return _of_polygons(np.asarray(mesh.points), rings, name)


def _of_meshio(mesh: Any, name: str) -> Surface:
    rings: list[npt.NDArray[Any]] = []
    kinds = [block.type for block in mesh.cells]
    for block in mesh.cells:
        if block.type in ("triangle", "quad") or block.type.startswith("polygon"):
            rings += list(np.asarray(block.data))
    if "tetra" in kinds:
        return TetrahedralMesh(mesh.points, mesh.get_cells_type("tetra"), name)
    if not rings and kinds:
        raise MeshError(f"{name} has cells of the type {', '.join(kinds)} only; extract its surface first.")
    return _of_polygons(np.asarray(mesh.points), rings, name)


def _of_nibabel(mesh: Any, name: str) -> Surface:
    points, triangles = (mesh.agg_data(intent) for intent in ("pointset", "triangle"))
    for found, what in ((points, "points"), (triangles, "triangles")):
        if not isinstance(found, np.ndarray):
            raise MeshError(f"{name} has no array of {what}, or several; a surface needs one.")
    return Surface(points, triangles, name)


def _of_polygons(points: npt.NDArray[Any], rings: list[npt.NDArray[Any]], name: str) -> Surface:
    sizes = np.array([len(ring) for ring in rings], np.int64)
    corners = np.concatenate([np.empty(0, np.int64), *rings]).astype(np.int64)
    faces, left_out, divided = triangulated(Polygons(points.astype(np.float64), sizes, corners))
    return Surface(points, faces, name, repairs=left_out, facts=divided)


def _of_open3d_tensors(mesh: Any, name: str) -> Surface:
    return surface_of(mesh.to_legacy(), None, name)


def _of_parts(mesh: Any, name: str) -> Surface:
    parts = ", ".join(map(repr, mesh.parts))
    raise MeshError(f"{name} has several parts; take one of mesh.parts: {parts}.")


READERS: tuple[tuple[Callable[[Any], bool], Callable[[Any, str], Surface]], ...] = (
    (lambda mesh: hasattr(mesh, "points") and hasattr(mesh, "n_points"), _of_pyvista),
    (lambda mesh: hasattr(mesh, "points") and hasattr(mesh, "cells_dict"), _of_meshio),
    (lambda mesh: hasattr(mesh, "agg_data"), _of_nibabel),
    (lambda mesh: hasattr(mesh, "to_legacy"), _of_open3d_tensors),
    (lambda mesh: hasattr(mesh, "parts") and hasattr(mesh.parts, "keys"), _of_parts),
)
"""A test whether an object is of a library, and a reader of its surface."""
