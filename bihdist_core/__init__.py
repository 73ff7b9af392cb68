"""Biharmonic distance on triangle meshes (Lipman, Rustamov, Funkhouser), beside the distances it is compared with.

Arrays in, arrays out; no picture is drawn here.  From the bottom up, each module using only what stands before it:
errors, progress, blas; surface, mesh_io; operators; ordering, elimination_tree, factor; spectrum; laplacian;
distance and one module per distance; sampling, interpolation, correspondence, isolines, extrema, diagnostics.
`bihdist_core.experiments`, which is not imported here, computes the paper's figures and tables.
"""

from .biharmonic import BiharmonicDistance
from .commute_time import CommuteTimeDistance
from .correspondence import correspondence_prediction
from .diagnostics import (
    FieldChange,
    GradientJumps,
    TriangleSample,
    field_change,
    gradient_jumps,
    isotropy_ratio,
    smallest_distance,
    triangle_violations,
)
from .diffusion import DiffusionDistance
from .distance import Distance
from .errors import BihdistError, Cancelled, MeshError, OutputError, ParameterError, SolverError, VertexError
from .extrema import Extrema, extrema
from .geodesic import GeodesicDistance
from .interpolation import ShepardInterpolant
from .isoline_output import write_isolines
from .isolines import Isoline, isolines
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
    "Extrema",
    "FieldChange",
    "GeodesicDistance",
    "GradientJumps",
    "Isoline",
    "Laplacian",
    "MeshError",
    "OutputError",
    "ParameterError",
    "PowerDistance",
    "ShepardInterpolant",
    "SolverError",
    "Spectrum",
    "Surface",
    "TriangleSample",
    "TruncatedBiharmonicDistance",
    "VertexError",
    "correspondence_prediction",
    "eigenpairs",
    "extrema",
    "farthest_points",
    "field_change",
    "gradient_jumps",
    "isolines",
    "isotropy_ratio",
    "read_surface",
    "smallest_distance",
    "triangle_violations",
    "write_isolines",
]
