# The public names and where they live; each is imported when it is first asked for.
from .analysis.bands import (
    Band as Band,
)
from .analysis.bands import (
    band as band,
)
from .analysis.diagnostics import (
    FieldChange as FieldChange,
)
from .analysis.diagnostics import (
    GradientJumps as GradientJumps,
)
from .analysis.diagnostics import (
    TriangleSample as TriangleSample,
)
from .analysis.diagnostics import (
    field_change as field_change,
)
from .analysis.diagnostics import (
    gradient_jumps as gradient_jumps,
)
from .analysis.diagnostics import (
    isotropy_ratio as isotropy_ratio,
)
from .analysis.diagnostics import (
    smallest_distance as smallest_distance,
)
from .analysis.diagnostics import (
    triangle_violations as triangle_violations,
)
from .analysis.field_scatter import (
    FieldScatter as FieldScatter,
)
from .analysis.field_scatter import (
    field_scatter as field_scatter,
)
from .analysis.field_statistics import (
    Agreement as Agreement,
)
from .analysis.field_statistics import (
    FieldStatistics as FieldStatistics,
)
from .analysis.field_statistics import (
    field_agreement as field_agreement,
)
from .analysis.field_statistics import (
    field_statistics as field_statistics,
)
from .analysis.field_statistics import (
    rank_correlation as rank_correlation,
)
from .analysis.geodesic_paths import (
    GeodesicPaths as GeodesicPaths,
)
from .analysis.isoline_output import write_isolines as write_isolines
from .analysis.isoline_tracing import (
    Isoline as Isoline,
)
from .analysis.isoline_tracing import (
    isolines as isolines,
)
from .analysis.neighbours import nearest as nearest
from .analysis.parcels import Parcels as Parcels
from .analysis.parcels import parcel_means as parcel_means
from .analysis.persistence import (
    Extrema as Extrema,
)
from .analysis.persistence import (
    extrema as extrema,
)
from .analysis.places import (
    Places as Places,
)
from .analysis.plane_sections import (
    plane_section as plane_section,
)
from .analysis.profile_output import (
    write_profile as write_profile,
)
from .analysis.quality import (
    Circle as Circle,
)
from .analysis.quality import (
    FieldQuality as FieldQuality,
)
from .analysis.quality import (
    OtherExtrema as OtherExtrema,
)
from .analysis.quality import (
    apparent_source as apparent_source,
)
from .analysis.quality import (
    difference_quality as difference_quality,
)
from .analysis.quality import (
    field_quality as field_quality,
)
from .analysis.quality import (
    geodesic_circles as geodesic_circles,
)
from .analysis.quality import (
    other_extrema as other_extrema,
)
from .analysis.quality import (
    triangle_sample as triangle_sample,
)
from .analysis.quality import (
    triangle_samples as triangle_samples,
)
from .analysis.region_boundaries import (
    Boundary as Boundary,
)
from .analysis.region_boundaries import (
    region_boundaries as region_boundaries,
)
from .analysis.region_boundaries import (
    write_boundaries as write_boundaries,
)
from .analysis.region_mesh import RegionMesh as RegionMesh
from .analysis.region_mesh import region_mesh as region_mesh
from .analysis.region_output import (
    write_labels as write_labels,
)
from .analysis.region_output import (
    write_region_mesh as write_region_mesh,
)
from .analysis.regions import (
    Regions as Regions,
)
from .analysis.regions import (
    voronoi_regions as voronoi_regions,
)
from .analysis.sampling import (
    farthest_points as farthest_points,
)
from .analysis.sampling import (
    write_samples as write_samples,
)
from .analysis.selecting import (
    Brush as Brush,
)
from .analysis.selecting import (
    cut_out as cut_out,
)
from .analysis.selecting import (
    write_selection as write_selection,
)
from .analysis.surface_paths import (
    SurfacePath as SurfacePath,
)
from .analysis.truncation import (
    TruncationLoss as TruncationLoss,
)
from .analysis.truncation import (
    truncation_loss as truncation_loss,
)
from .applications.correspondence import Correspondence as Correspondence
from .applications.correspondence import correspondence_prediction as correspondence_prediction
from .applications.interpolation import ShepardInterpolant as ShepardInterpolant
from .applications.map_errors import ErrorCurve as ErrorCurve
from .applications.map_errors import error_curve as error_curve
from .applications.map_errors import map_errors as map_errors
from .applications.perturbation import noisy as noisy
from .applications.perturbation import welded as welded
from .applications.perturbation import with_handle as with_handle
from .applications.perturbation import with_holes as with_holes
from .applications.resizing import simplified as simplified
from .applications.tips import at_tips as at_tips
from .applications.tips import tips as tips
from .distances.biharmonic import BiharmonicDistance as BiharmonicDistance
from .distances.commute_time import CommuteTimeDistance as CommuteTimeDistance
from .distances.difference import difference as difference
from .distances.diffusion import DiffusionDistance as DiffusionDistance
from .distances.distance import Distance as Distance
from .distances.embedding import Embedding as Embedding
from .distances.geodesic import GeodesicDistance as GeodesicDistance
from .distances.spectral import (
    PowerDistance as PowerDistance,
)
from .distances.spectral import (
    TruncatedBiharmonicDistance as TruncatedBiharmonicDistance,
)
from .errors import (
    BihdistError as BihdistError,
)
from .errors import (
    Cancelled as Cancelled,
)
from .errors import (
    MeshError as MeshError,
)
from .errors import (
    OutputError as OutputError,
)
from .errors import (
    ParameterError as ParameterError,
)
from .errors import (
    SolverError as SolverError,
)
from .errors import (
    VertexError as VertexError,
)
from .formats.mesh_io import read_surface as read_surface
from .formats.mesh_output import write_mesh as write_mesh
from .formats.pins import (
    Pins as Pins,
)
from .formats.pins import (
    read_pins as read_pins,
)
from .formats.pins import (
    write_pins as write_pins,
)
from .formats.vertex_maps import read_map as read_map
from .formats.vertex_maps import write_map as write_map
from .laplacian import (
    Laplacian as Laplacian,
)
from .laplacian import (
    eigenpairs as eigenpairs,
)
from .solver.spectrum import Spectrum as Spectrum
from .sources.source import (
    BoundaryLoop as BoundaryLoop,
)
from .sources.source import (
    Curve as Curve,
)
from .sources.source import (
    SourceSet as SourceSet,
)
from .sources.source import (
    SurfacePoint as SurfacePoint,
)
from .sources.words import source_from_words as source_from_words
from .surface import Surface as Surface
