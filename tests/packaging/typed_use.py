"""What users write, as type checkers see it: mypy reads it among the checks, and a test runs it.

With `warn_unused_ignores` an ignored error has to be one.
"""

from pathlib import Path

import numpy as np

import app as bihdist
from bihdist_core import BiharmonicDistance, GeodesicDistance, Laplacian, MeshLike, Surface, isolines
from bihdist_core.arrays import FloatArray, IntArray


def right(vertices: FloatArray, faces: IntArray, path: Path) -> None:
    """Each in the types that it is said to have."""
    surface = Surface(vertices, faces)
    bihdist.write_mesh(path, surface)
    meshes: list[MeshLike] = [surface, path, str(path), (vertices, faces), surface.to_pyvista()]
    for mesh in meshes:
        field: FloatArray = BiharmonicDistance(mesh).from_source(0)
        isolines(mesh, field, [0.1])
    distance = bihdist.BiharmonicDistance(vertices, faces)
    one: float = distance.between(1, "2")
    many: FloatArray = distance.between([1, 3], np.array([2, 4]))
    assert np.isclose(many[0], one)
    areas: FloatArray = Laplacian(Surface.of(vertices.tolist(), faces)).areas
    assert areas.shape == (surface.n_vertices,)
    assert isinstance(bihdist.__version__, str)


def wrong(surface: Surface) -> None:
    """What is refused before it is run."""
    Laplacian(12)  # type: ignore[arg-type]
    isolines(12, [0.0], [0.1])  # type: ignore[arg-type]
    GeodesicDistance(surface, 3)  # type: ignore[arg-type]
    surface.area = 2  # type: ignore[misc]
    BiharmonicDistance(surface).from_source(1.5)  # type: ignore[arg-type]
