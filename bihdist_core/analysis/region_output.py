"""Files of regions: the label of each vertex, and the mesh cut along their boundaries."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np

from ..arrays import IntArray
from ..formats.field_output import FIELD_FORMATS, write_fields
from ..mesh_like import MeshLike
from ..whole_file import check_output
from .region_mesh import RegionMesh
from .regions import Regions

LABEL_FORMATS = FIELD_FORMATS
REGION_MESH_FORMATS = (".ply", ".vtp")


def write_labels(
    path: str | os.PathLike[str], surface: MeshLike, regions: Regions, labels: Sequence[int] | None = None
) -> None:
    """Write the region of each vertex as the field `region`, NaN where there is none: .npy, .csv, .ply, .vtp or GIFTI.

    labels: (k,) what to write for region i, such as the id of its pin; i by default.  Raises OutputError if the file
    cannot be written.

    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
    >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 8])
    >>> regions = bihdist.voronoi_regions(plane, fields)
    >>> bihdist.write_labels("regions.npy", plane, regions, labels=[5, 7])
    >>> np.load("regions.npy").tolist()
    [5.0, 5.0, 5.0, 5.0, 5.0, 7.0, 5.0, 7.0, 7.0]
    """
    write_fields(path, surface, {"region": _labelled(regions.labels, labels)})


def write_region_mesh(path: str | os.PathLike[str], mesh: RegionMesh, labels: Sequence[int] | None = None) -> None:
    """Write the cut mesh as .ply or .vtp, with the field `region` at its vertices, each of which is in one region.

    labels: (k,) what to write for region i, such as the id of its pin; i by default.  Raises OutputError if the file
    cannot be written.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 24])
    >>> cut = bihdist.region_mesh(plane, fields)
    >>> bihdist.write_region_mesh("regions.ply", cut)
    >>> bihdist.read_surface("regions.ply").n_components
    2
    """
    check_output(path, REGION_MESH_FORMATS)
    write_fields(path, mesh.surface, {"region": _labelled(mesh.regions, labels)})


def _labelled(regions: IntArray, labels: Sequence[int] | None) -> IntArray:
    """(n,) the labels of regions (n,)."""
    if not (regions >= 0).any():
        return np.full(len(regions), np.nan)
    named = np.arange(int(regions.max()) + 1) if labels is None else np.asarray(labels)
    return np.where(regions >= 0, named[np.maximum(regions, 0)], np.nan)
