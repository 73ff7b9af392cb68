# The public names and where they live; each is imported when it is first asked for.
from .analysis.correspondence import correspondence_prediction as correspondence_prediction
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
from .analysis.interpolation import ShepardInterpolant as ShepardInterpolant
from .analysis.isoline_output import write_isolines as write_isolines
from .analysis.isoline_tracing import (
    Isoline as Isoline,
)
from .analysis.isoline_tracing import (
    isolines as isolines,
)
from .analysis.persistence import (
    Extrema as Extrema,
)
from .analysis.persistence import (
    extrema as extrema,
)
from .analysis.sampling import farthest_points as farthest_points
from .distances.biharmonic import BiharmonicDistance as BiharmonicDistance
from .distances.commute_time import CommuteTimeDistance as CommuteTimeDistance
from .distances.difference import difference as difference
from .distances.diffusion import DiffusionDistance as DiffusionDistance
from .distances.distance import Distance as Distance
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
from .laplacian import (
    Laplacian as Laplacian,
)
from .laplacian import (
    eigenpairs as eigenpairs,
)
from .solver.spectrum import Spectrum as Spectrum
from .surface import Surface as Surface
