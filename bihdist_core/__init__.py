"""Biharmonic distance on triangle meshes (Lipman, Rustamov, Funkhouser), beside the distances it is compared with.

Arrays in, arrays out; no picture is drawn here.  From the bottom up, each module using only what stands before it:
errors, progress, blas; surface, mesh_io; operators; ordering, elimination_tree, factor; spectrum; laplacian;
distance and one module per distance; sampling.
"""

from .biharmonic import BiharmonicDistance
from .commute_time import CommuteTimeDistance
from .diffusion import DiffusionDistance
from .distance import Distance
from .errors import BihdistError, Cancelled, MeshError, OutputError, ParameterError, SolverError, VertexError
from .geodesic import GeodesicDistance
from .laplacian import Laplacian, eigenpairs
from .mesh_io import read_surface
from .sampling import farthest_points
from .spectral import PowerDistance, TruncatedBiharmonicDistance
from .spectrum import Spectrum
from .surface import Surface

__all__ = [
    "BiharmonicDistance",
    "BihdistError",
    "Cancelled",
    "CommuteTimeDistance",
    "DiffusionDistance",
    "Distance",
    "GeodesicDistance",
    "Laplacian",
    "MeshError",
    "OutputError",
    "ParameterError",
    "PowerDistance",
    "SolverError",
    "Spectrum",
    "Surface",
    "TruncatedBiharmonicDistance",
    "VertexError",
    "eigenpairs",
    "farthest_points",
    "read_surface",
]
