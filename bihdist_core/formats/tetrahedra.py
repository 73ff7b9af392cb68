"""Meshes of Medit (.mesh) and Gmsh (.msh): tetrahedra, or polygons."""

import tempfile
from pathlib import Path

import numpy as np

from ..arrays import AnyArray
from ..errors import MeshError
from .mesh_names import mesh_format
from .polygons import Polygons
from .vtk import polygons_of_cells

SURFACE = {"triangle": "POLYGONS", "quad": "POLYGONS"}


def read_tetrahedra(raw: bytes, name: str) -> Polygons:
    """Read a file by meshio; MeshError where it cannot be read, or where meshio is not installed."""
    try:
        import meshio
    except ImportError:
        raise MeshError(f"{name} is read by meshio; `pip install 'bihdist[meshio]'` brings it.") from None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"mesh{mesh_format(name)}")
        path.write_bytes(raw)
        try:
            mesh = meshio.read(path)
        except (Exception, SystemExit) as error:  # meshio ends the program where it knows no better
            raise MeshError(f"{name} cannot be read: {str(error) or type(error).__name__}.") from None
    cells: dict[str, list[AnyArray]] = {}
    # Gmsh writes the boundary of a solid as well.
    kinds = {"tetra": "TETRAHEDRA"} if any(block.type == "tetra" for block in mesh.cells) else SURFACE
    for block in mesh.cells:
        cells.setdefault(kinds.get(block.type, "other"), []).append(np.asarray(block.data))
    joined = {
        kind: (
            np.concatenate([np.full(len(part), part.shape[1]) for part in parts]),
            np.concatenate([part.ravel() for part in parts]),
        )
        for kind, parts in cells.items()
    }
    return polygons_of_cells(np.asarray(mesh.points, np.float64), joined, name)
