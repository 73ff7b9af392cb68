# The public names and where they live; each is imported when it is first asked for.
from .biharmonic import BiharmonicDistance as BiharmonicDistance
from .commute_time import CommuteTimeDistance as CommuteTimeDistance
from .correspondence import correspondence_prediction as correspondence_prediction
from .diagnostics import (
    FieldChange as FieldChange,
)
from .diagnostics import (
    GradientJumps as GradientJumps,
)
from .diagnostics import (
    TriangleSample as TriangleSample,
)
from .diagnostics import (
    field_change as field_change,
)
from .diagnostics import (
    gradient_jumps as gradient_jumps,
)
from .diagnostics import (
    isotropy_ratio as isotropy_ratio,
)
from .diagnostics import (
    smallest_distance as smallest_distance,
)
from .diagnostics import (
    triangle_violations as triangle_violations,
)
from .diffusion import DiffusionDistance as DiffusionDistance
from .distance import Distance as Distance
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
from .geodesic import GeodesicDistance as GeodesicDistance
from .interpolation import ShepardInterpolant as ShepardInterpolant
from .isoline_output import write_isolines as write_isolines
from .isoline_tracing import (
    Isoline as Isoline,
)
from .isoline_tracing import (
    isolines as isolines,
)
from .laplacian import (
    Laplacian as Laplacian,
)
from .laplacian import (
    eigenpairs as eigenpairs,
)
from .mesh_io import read_surface as read_surface
from .persistence import (
    Extrema as Extrema,
)
from .persistence import (
    extrema as extrema,
)
from .sampling import farthest_points as farthest_points
from .spectral import (
    PowerDistance as PowerDistance,
)
from .spectral import (
    TruncatedBiharmonicDistance as TruncatedBiharmonicDistance,
)
from .spectrum import Spectrum as Spectrum
from .surface import Surface as Surface
