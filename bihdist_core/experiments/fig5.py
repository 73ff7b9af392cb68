"""Figure 5: biharmonic, geodesic and diffusion distance (t = 1) on several more shapes; the claims are figure 4's."""

from ..progress import Progress
from ._comparison import compared
from .result import Result
from .shapes import Shapes

TITLE = "Three distances on several shapes"


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Compare the distances on the other shapes; on the first only if `quick`."""
    names = shapes.names(*("animal", "hand", "genus3", "figure_pose2")[: 1 if quick else 4])
    return compared("fig5", TITLE, names, shapes, quick, progress)
