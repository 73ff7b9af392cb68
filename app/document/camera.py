"""A camera as numbers that can be written down, and the names of the standard views."""

import math
from dataclasses import dataclass

from bihdist_core.analysis.view_directions import OBLIQUE_VIEWS
from bihdist_core.errors import ParameterError

from .looks import UPS, one_of

ANATOMICAL = (
    *("lateral", "medial", "dorsal", "ventral", "anterior", "posterior"),
    *("lateral-left", "medial-left", "lateral-right", "medial-right"),
)
"""Views of a brain, or of anything else where x points to the right, y to the front and z up (RAS)."""

VIEWS = (
    "auto", *OBLIQUE_VIEWS, "front", "back", "left", "right", "top", "bottom", "source", "relief", *ANATOMICAL
)  # fmt: skip
"""Standard views; `auto` is the first view that shows most of the shape, as long as it is to be chosen.

`source` looks at the first source from outside, `relief` is for height fields over x and y.  `lateral` and `medial`
become those of the mesh's hemisphere.
"""

SAME_VIEWS = {"superior": "dorsal", "inferior": "ventral"}
"""Other names of views."""

LARGEST = 1e100
"""No number of a camera is larger, and no direction shorter than one over this: then nothing overflows."""

WIDEST = 1e6
"""The tangent of the widest half angle, and one over that of the narrowest."""

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Camera:
    """The place of a camera and the direction in which it looks; ParameterError for numbers that make no camera.

    Attributes
    ----------
    position
        The point where the camera is.
    focal_point
        The point that it looks at.
    up
        The direction that is up in the picture.
    extent
        How far it sees at least, to each side and up and down, at distance 1: what lies inside is seen in a picture of
        any shape.
    """

    position: Vector
    focal_point: Vector
    up: Vector
    extent: tuple[float, float]

    def __post_init__(self) -> None:
        numbers = (*self.position, *self.focal_point, *self.up, *self.extent)
        if len(numbers) != 11 or not all(math.isfinite(x) and abs(x) <= LARGEST for x in numbers):
            raise ParameterError(f"A camera is eleven numbers, none beyond {LARGEST:g}, not {_shown(numbers)}.")
        back = tuple(a - b for a, b in zip(self.position, self.focal_point, strict=True))
        if min(math.hypot(*back), math.hypot(*self.up)) < 1 / LARGEST or not any(_cross(self.up, back)):
            raise ParameterError(
                "A camera needs a focal point away from its position, and an up direction across the line of sight."
            )
        if not all(1 / WIDEST <= x <= WIDEST for x in self.extent):
            raise ParameterError(f"A camera's extent is from {1 / WIDEST:g} to {WIDEST:g}, not {_shown(self.extent)}.")


View = str | Camera
"""The name of a standard view, fitted closely around the shape, or a camera."""


def checked_view(view: View) -> View:
    """Return the view; ParameterError for a name that none has."""
    if isinstance(view, str) and view not in VIEWS:
        raise ParameterError(f"There is no view {view!r}; choose one of {', '.join(VIEWS)}.")
    return view


@dataclass(frozen=True)
class SecondMeshView:
    """The view of a surface that stands beside the first one of a document.

    Attributes
    ----------
    surface
        Its name in the document.
    camera
        Its camera, as the document has one for its first surface.
    up
        The axis that points up, as the document has one for its first surface.
    """

    surface: str
    camera: View = "auto"
    up: str = "auto"

    def __post_init__(self) -> None:
        checked_view(self.camera)
        one_of(self.up, UPS, "direction")


def view_alike(view: View) -> View:
    """Return the view for another shape or up axis: "auto" for views that depend on the shape."""
    is_of_all = isinstance(view, str) and view not in (*OBLIQUE_VIEWS, "source", "relief", *ANATOMICAL)
    return view if is_of_all else "auto"


def _cross(a: tuple[float, ...], b: tuple[float, ...]) -> Vector:
    # Of unit vectors, so that nothing small vanishes.
    (ax, ay, az), (bx, by, bz) = (tuple(x / math.hypot(*v) for x in v) for v in (a, b))
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def _shown(numbers: tuple[float, ...]) -> str:
    return ", ".join(f"{x:g}" for x in numbers)
