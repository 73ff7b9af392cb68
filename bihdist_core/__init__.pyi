# The public names and where they live; each is imported when it is first asked for.
from .analysis.bands import (
    Band as Band,
    band as band,
)
from .analysis.diagnostics import (
    FieldChange as FieldChange,
    GradientJumps as GradientJumps,
    TriangleSample as TriangleSample,
    field_change as field_change,
    gradient_jumps as gradient_jumps,
    isotropy_ratio as isotropy_ratio,
    smallest_distance as smallest_distance,
    triangle_violations as triangle_violations,
)
from .analysis.field_scatter import (
    FieldScatter as FieldScatter,
    field_scatter as field_scatter,
)
from .analysis.field_statistics import (
    Agreement as Agreement,
    FieldStatistics as FieldStatistics,
    field_agreement as field_agreement,
    field_statistics as field_statistics,
    rank_correlation as rank_correlation,
)
from .analysis.geodesic_paths import (
    GeodesicPaths as GeodesicPaths,
)
from .analysis.isoline_output import write_isolines as write_isolines
from .analysis.isoline_tracing import (
    Isoline as Isoline,
    isolines as isolines,
)
from .analysis.neighbours import nearest as nearest
from .analysis.parcels import Parcels as Parcels, parcel_means as parcel_means
from .analysis.persistence import (
    Extrema as Extrema,
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
    FieldQuality as FieldQuality,
    OtherExtrema as OtherExtrema,
    apparent_source as apparent_source,
    difference_quality as difference_quality,
    field_quality as field_quality,
    geodesic_circles as geodesic_circles,
    other_extrema as other_extrema,
    triangle_sample as triangle_sample,
    triangle_samples as triangle_samples,
)
from .analysis.region_boundaries import (
    Boundary as Boundary,
    region_boundaries as region_boundaries,
    write_boundaries as write_boundaries,
)
from .analysis.region_mesh import RegionMesh as RegionMesh, region_mesh as region_mesh
from .analysis.region_output import (
    write_labels as write_labels,
    write_region_mesh as write_region_mesh,
)
from .analysis.regions import (
    Regions as Regions,
    voronoi_regions as voronoi_regions,
)
from .analysis.sampling import (
    farthest_points as farthest_points,
    write_samples as write_samples,
)
from .analysis.selecting import (
    Brush as Brush,
    cut_out as cut_out,
    write_selection as write_selection,
)
from .analysis.surface_paths import (
    SurfacePath as SurfacePath,
)
from .analysis.truncation import (
    TruncationLoss as TruncationLoss,
    truncation_loss as truncation_loss,
)
from .applications.correspondence import (
    Correspondence as Correspondence,
    correspondence_prediction as correspondence_prediction,
)
from .applications.interpolation import ShepardInterpolant as ShepardInterpolant
from .applications.map_errors import ErrorCurve as ErrorCurve, error_curve as error_curve, map_errors as map_errors
from .applications.perturbation import (
    noisy as noisy,
    welded as welded,
    with_handle as with_handle,
    with_holes as with_holes,
)
from .applications.resizing import simplified as simplified
from .applications.tips import at_tips as at_tips, tips as tips
from .distances.biharmonic import BiharmonicDistance as BiharmonicDistance
from .distances.commute_time import CommuteTimeDistance as CommuteTimeDistance
from .distances.difference import difference as difference
from .distances.diffusion import DiffusionDistance as DiffusionDistance
from .distances.distance import Distance as Distance
from .distances.embedding import Embedding as Embedding
from .distances.geodesic import GeodesicDistance as GeodesicDistance
from .distances.spectral import (
    PowerDistance as PowerDistance,
    TruncatedBiharmonicDistance as TruncatedBiharmonicDistance,
)
from .errors import (
    BihdistError as BihdistError,
    Cancelled as Cancelled,
    MeshError as MeshError,
    MissingFileError as MissingFileError,
    NotEnoughMemory as NotEnoughMemory,
    OutputError as OutputError,
    ParameterError as ParameterError,
    SolverError as SolverError,
    VertexError as VertexError,
)
from .formats.mesh_io import read_surface as read_surface
from .formats.mesh_output import write_mesh as write_mesh
from .formats.pins import (
    Pins as Pins,
    read_pins as read_pins,
    write_pins as write_pins,
)
from .formats.vertex_maps import read_map as read_map, write_map as write_map
from .laplacian import (
    Laplacian as Laplacian,
    eigenpairs as eigenpairs,
)
from .solver.spectrum import Spectrum as Spectrum
from .sources.source import (
    BoundaryLoop as BoundaryLoop,
    Curve as Curve,
    SourceSet as SourceSet,
    SurfacePoint as SurfacePoint,
)
from .sources.words import source_from_words as source_from_words
from .surface import Surface as Surface
