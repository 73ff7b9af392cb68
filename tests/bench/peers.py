"""The programs we are measured against, and slow, independent ways to the same numbers."""

from collections.abc import Callable
from importlib import metadata
from importlib.util import find_spec
from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from bihdist_core import Surface
from bihdist_core.laplacian import Component


def versions() -> str:
    """Names and versions of everything that takes part."""
    names = ("potpourri3d", "scipy", "numpy", "pyvista", "vtk", *filter(is_installed, OPTIONAL))
    return ", ".join(f"{name} {metadata.version(name)}" for name in names)


OPTIONAL = {
    "meshio": "meshio",
    "trimesh": "trimesh",
    "libigl": "igl",
    "cholespy": "cholespy",
    "pypardiso": "pypardiso",
    "pygeodesic": "pygeodesic",
}
"""What takes part where it is installed, and the modules' names."""


def is_installed(name: str) -> bool:
    """Whether one of the optional peers is."""
    return find_spec(OPTIONAL[name]) is not None


def heat_solver(vertices: np.ndarray, faces: np.ndarray):
    """potpourri3d's heat-method solver as its documentation makes it."""
    import potpourri3d

    return potpourri3d.MeshHeatMethodDistanceSolver(vertices, faces)


def exact_geodesic(mesh: tuple[np.ndarray, np.ndarray], sources: list[int]) -> list[np.ndarray]:
    """(n,) from each source, by pygeodesic, its set-up included."""
    from pygeodesic.geodesic import PyGeodesicAlgorithmExact

    solver = PyGeodesicAlgorithmExact(*mesh)
    return [solver.geodesicDistances(np.array([source]), None)[0] for source in sources]


def edge_graph(surface: Surface) -> sp.csr_matrix:
    """(n, n) edge lengths, both directions."""
    i, j = surface.edges.T
    lengths = np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)
    n = len(surface.vertices)
    return sp.csr_matrix((np.tile(lengths, 2), (np.r_[i, j], np.r_[j, i])), shape=(n, n))


def edge_distances(graph: sp.csr_matrix, sources: np.ndarray) -> np.ndarray:
    """(k, n) Dijkstra's."""
    return dijkstra(graph, indices=sources)


def edge_distances_to_file(graph: sp.csr_matrix, path: str, rows: int = 256) -> None:
    """All of them as an (n, n) float32 .npy file."""
    n = graph.shape[0]
    out = np.lib.format.open_memmap(path, "w+", np.float32, (n, n))
    for start in range(0, n, rows):
        out[start : start + rows] = dijkstra(graph, indices=np.arange(start, min(start + rows, n)))
    out.flush()


def cholmod(matrix: sp.csc_matrix) -> Callable[[np.ndarray], np.ndarray]:
    """Factor a symmetric positive definite matrix by CHOLMOD, through cholespy; what solves with the factor."""
    from cholespy import CholeskySolverD, MatrixType

    solver = CholeskySolverD(matrix.shape[0], matrix.indptr, matrix.indices, matrix.data, MatrixType.CSC)

    def solve(b: np.ndarray) -> np.ndarray:
        x = np.empty_like(b)
        solver.solve(b, x)
        return x

    return solve


def pardiso(matrix: sp.csc_matrix) -> Callable[[np.ndarray], np.ndarray]:
    """The same by PARDISO of Intel's library, through pypardiso."""
    from pypardiso import PyPardisoSolver

    solver, upper = PyPardisoSolver(mtype=2), sp.csr_matrix(sp.triu(matrix))
    solver.factorize(upper)
    return lambda b: solver.solve(upper, b)


def read_by_vtk(path: str) -> Any:
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkOFFReader
    from vtkmodules.vtkIOPLY import vtkPLYReader

    reader = {"off": vtkOFFReader, "obj": vtkOBJReader, "ply": vtkPLYReader}[path[-3:]]()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def read_by_meshio(path: str) -> Any:
    import meshio

    return meshio.read(path)


def read_by_trimesh(path: str) -> Any:
    import trimesh

    return trimesh.load(path, process=False)


def read_by_libigl(path: str) -> Any:
    import igl

    return igl.read_triangle_mesh(path)


def arpack_eigenvalues(component: Component, count: int, tolerance: float) -> np.ndarray:
    """(count,) smallest eigenvalues, by scipy's eigsh on our factor's solves, the constant projected out."""
    root = np.sqrt(component.areas)
    unit = root / np.linalg.norm(root)

    def centred(x: np.ndarray) -> np.ndarray:
        return x - unit * (unit @ x)

    def apply(x: np.ndarray) -> np.ndarray:
        return centred(root * component.solve(root * centred(x)))

    n = len(root)
    start = centred(np.random.default_rng(0).standard_normal(n))
    inverse, _ = eigsh(LinearOperator((n, n), matvec=apply, dtype=float), count, v0=start, tol=tolerance)
    return np.sort(1 / inverse)


class Reference:
    """Exact distances by SuperLU: no nested dissection, no fronts, no dual numbers; pairs in the half-order form."""

    def __init__(self, component: Component) -> None:
        self.areas, n = component.areas, len(component.areas)
        keep = np.arange(n) != component.pin
        self._keep, self._lu = keep, splu(component.stiffness[keep][:, keep].tocsc())

    def solve(self, b: np.ndarray) -> np.ndarray:
        """G b; b (n, k)."""
        x = np.zeros_like(b)
        x[self._keep] = self._lu.solve(b[self._keep])
        return x

    def biharmonic(self, source: int, targets: np.ndarray) -> np.ndarray:
        """(k,) distances: solve L y = e_i - e_j, centre y by area, d = |y|_A."""
        b = np.zeros((len(self.areas), len(targets)))
        b[source] += 1
        b[targets, np.arange(len(targets))] -= 1
        y = self.solve(b)
        y -= self.areas @ y / self.areas.sum()
        return np.sqrt(self.areas @ y**2)
