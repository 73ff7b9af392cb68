"""Figure 4: biharmonic, geodesic and diffusion distance (t = 1) on a person, front and back, the source on the back.

The paper: biharmonic isolines are nearly circles near the source and cross-sections of the limbs far away, without
local minima; geodesic distance has cusps and ridges; diffusion distance has a minimum on the front and elongated
isolines near the source.
"""

from ..progress import Progress
from ._comparison import compared
from .result import Result
from .shapes import Shapes

TITLE = "Three distances, front and back"


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compare the distances on the person."""
    return compared("fig4", TITLE, shapes.names("figure"), shapes, quick, progress)
