# The public names and where they live; each is imported when it is first asked for.
from .analysis.bands import Band, band
from .analysis.circles import Circle, geodesic_circles
from .analysis.diagnostics import (
    FieldChange,
    GradientJumps,
    TriangleSample,
    field_change,
    gradient_jumps,
    isotropy_ratio,
    smallest_distance,
    triangle_violations,
)
from .analysis.field_scatter import FieldScatter, field_scatter
from .analysis.field_statistics import Agreement, FieldStatistics, field_agreement, field_statistics, rank_correlation
from .analysis.geodesic_paths import GeodesicPaths
from .analysis.isoline_tracing import Isoline, isolines, write_isolines
from .analysis.neighbours import nearest
from .analysis.parcels import Parcels, parcel_means
from .analysis.persistence import Extrema, OtherExtrema, extrema, other_extrema
from .analysis.places import Places
from .analysis.plane_sections import plane_section
from .analysis.quality import FieldQuality, apparent_source, difference_quality, field_quality
from .analysis.region_boundaries import Boundary, region_boundaries, write_boundaries
from .analysis.region_mesh import RegionMesh, region_mesh, write_labels, write_region_mesh
from .analysis.regions import Regions, voronoi_regions
from .analysis.sampling import farthest_points, write_samples
from .analysis.selecting import Brush, cut_out, write_selection
from .analysis.signatures import (
    Signature,
    biharmonic_kernel_signature,
    centrality,
    heat_kernel_signature,
    wave_kernel_signature,
)
from .analysis.surface_paths import SurfacePath, write_profile
from .analysis.triangle_samples import triangle_sample, triangle_samples
from .analysis.truncation import TruncationLoss, truncation_loss
from .applications.correspondence import Correspondence, correspondence_prediction
from .applications.interpolation import ShepardInterpolant
from .applications.map_errors import ErrorCurve, error_curve, map_errors
from .applications.perturbation import noisy, welded, with_handle, with_holes
from .applications.resizing import simplified
from .applications.tips import at_tips, tips
from .distances.biharmonic import BiharmonicDistance
from .distances.commute_time import CommuteTimeDistance
from .distances.difference import difference
from .distances.diffusion import DiffusionDistance
from .distances.distance import Distance
from .distances.distance_types import DistanceType, Parameter
from .distances.embedding import Embedding
from .distances.geodesic import GeodesicDistance
from .distances.power import PowerDistance
from .distances.spectral import TruncatedBiharmonicDistance
from .errors import (
    BihdistError,
    Cancelled,
    MeshError,
    MissingFileError,
    MissingInputError,
    NotEnoughMemory,
    OutputError,
    ParameterError,
    SolverError,
    VertexError,
)
from .formats.mesh_io import read_surface
from .formats.pins import Pins, read_pins, write_pins
from .formats.surface_output import write_mesh
from .formats.vertex_maps import read_map, write_map
from .formats.vertex_values import read_vertex_values
from .graph_files import read_graph
from .graphs import Graph, biharmonic_index, kirchhoff_index
from .laplacian import Laplacian, eigenpairs
from .mesh_like import MeshLike
from .point_cloud import PointCloud
from .solver.spectrum import Spectrum
from .sources.source import BoundaryLoop, Curve, SourceSet, SurfacePoint
from .sources.words import source_from_words
from .sparse_inverse import SparseFactor, diagonal_of_inverse, inverse_on_pattern
from .surface import Surface
from .tetrahedra import TetrahedralMesh

__all__ = [
    "Agreement",
    "Band",
    "BiharmonicDistance",
    "BihdistError",
    "Boundary",
    "BoundaryLoop",
    "Brush",
    "Cancelled",
    "Circle",
    "CommuteTimeDistance",
    "Correspondence",
    "Curve",
    "DiffusionDistance",
    "Distance",
    "DistanceType",
    "Embedding",
    "ErrorCurve",
    "Extrema",
    "FieldChange",
    "FieldQuality",
    "FieldScatter",
    "FieldStatistics",
    "GeodesicDistance",
    "GeodesicPaths",
    "GradientJumps",
    "Graph",
    "Isoline",
    "Laplacian",
    "MeshError",
    "MeshLike",
    "MissingFileError",
    "MissingInputError",
    "NotEnoughMemory",
    "OtherExtrema",
    "OutputError",
    "Parameter",
    "ParameterError",
    "Parcels",
    "Pins",
    "Places",
    "PointCloud",
    "PowerDistance",
    "RegionMesh",
    "Regions",
    "ShepardInterpolant",
    "Signature",
    "SolverError",
    "SourceSet",
    "SparseFactor",
    "Spectrum",
    "Surface",
    "SurfacePath",
    "SurfacePoint",
    "TetrahedralMesh",
    "TriangleSample",
    "TruncatedBiharmonicDistance",
    "TruncationLoss",
    "VertexError",
    "apparent_source",
    "at_tips",
    "band",
    "biharmonic_index",
    "biharmonic_kernel_signature",
    "centrality",
    "correspondence_prediction",
    "cut_out",
    "diagonal_of_inverse",
    "difference",
    "difference_quality",
    "eigenpairs",
    "error_curve",
    "extrema",
    "farthest_points",
    "field_agreement",
    "field_change",
    "field_quality",
    "field_scatter",
    "field_statistics",
    "geodesic_circles",
    "gradient_jumps",
    "heat_kernel_signature",
    "inverse_on_pattern",
    "isolines",
    "isotropy_ratio",
    "kirchhoff_index",
    "map_errors",
    "nearest",
    "noisy",
    "other_extrema",
    "parcel_means",
    "plane_section",
    "rank_correlation",
    "read_graph",
    "read_map",
    "read_pins",
    "read_surface",
    "read_vertex_values",
    "region_boundaries",
    "region_mesh",
    "simplified",
    "smallest_distance",
    "source_from_words",
    "tips",
    "triangle_sample",
    "triangle_samples",
    "triangle_violations",
    "truncation_loss",
    "voronoi_regions",
    "wave_kernel_signature",
    "welded",
    "with_handle",
    "with_holes",
    "write_boundaries",
    "write_isolines",
    "write_labels",
    "write_map",
    "write_mesh",
    "write_pins",
    "write_profile",
    "write_region_mesh",
    "write_samples",
    "write_selection",
]
