"""How fields and surfaces look, as far as a document says it: isolines, colours, shading, and which way is up."""

import math
from dataclasses import dataclass, replace

from bihdist_core.errors import ParameterError

MOST_ISOLINES = 1000
LARGEST = 1e100
"""Of values; their inverses are the smallest."""

RANGES = ("own", "shared", "shares")
"""Where colour bars end: at the field's own maximum, at the largest of all panels of a unit, or all at 100 %."""

NORMALS = ("auto", "smooth", "creased", "flat")
UPS = ("auto", "x", "-x", "y", "-y", "z", "-z")
PROJECTIONS = ("perspective", "orthographic")

Stops = tuple[tuple[float, tuple[float, float, float]], ...]
"""Places from 0 to 1, and the colours (RGB from 0 to 1) there."""


def one_of(value: str, choices: tuple[str, ...], what: str) -> str:
    """The value; ParameterError if it is none of the choices."""
    if value not in choices:
        raise ParameterError(f"There is no {what} {value!r}; choose one of {', '.join(choices)}.")
    return value


@dataclass(frozen=True)
class Isolines:
    """Which values have a line.

    count: about so many, at multiples of a round step (1, 2, 2.5 or 5 times a power of ten); without `round`, of equal
    steps from 0 to the maximum.  spacing: of multiples, or values, in the field's unit, instead.  bold: every so many
    is bolder, none for 0.  labels: the lines' values stand on them.  through: the names of points that have a line of
    their own.
    """

    count: int = 20
    spacing: float | None = None
    values: tuple[float, ...] = ()
    bold: int = 0
    labels: bool = False
    through: tuple[str, ...] = ()
    round: bool = True

    def __post_init__(self) -> None:
        if not 0 <= self.count <= MOST_ISOLINES:
            raise ParameterError(f"There are 0 to {MOST_ISOLINES:,} steps between isolines, not {self.count}.")
        if self.spacing is not None and not 1 / LARGEST <= self.spacing <= LARGEST:
            raise ParameterError(f"The spacing of isolines is a positive number, not {self.spacing:g}.")
        if self.spacing is not None and self.values:
            raise ParameterError("Isolines have a spacing or values, not both.")
        if len(self.values) > MOST_ISOLINES or not all(abs(value) <= LARGEST for value in self.values):
            raise ParameterError(
                f"Isolines have up to {MOST_ISOLINES:,} values, all of them numbers up to {LARGEST:g}."
            )
        if tuple(sorted(set(self.values))) != self.values:
            object.__setattr__(self, "values", tuple(sorted(set(self.values))))
        if not 0 <= self.bold <= MOST_ISOLINES:
            raise ParameterError(f"Every so many isolines are bolder, 0 to {MOST_ISOLINES}, not {self.bold}.")

    def scaled(self, factor: float) -> "Isolines":
        """The same lines of a field that is so many times as large."""
        if factor == 1 or (self.spacing is None and not self.values):
            return self
        spacing = None if self.spacing is None else min(factor * self.spacing, LARGEST)
        values = tuple(max(-LARGEST, min(factor * value, LARGEST)) for value in self.values)
        return replace(self, spacing=spacing, values=values)


@dataclass(frozen=True)
class Colours:
    """The colours of fields.

    map: a word of the drawing's maps, "" for that of the style; with stops, the name of a map of one's own.  bands: one
    colour from each isoline to the next.
    """

    map: str = ""
    stops: Stops = ()
    reversed: bool = False
    bands: bool = False

    def __post_init__(self) -> None:
        places = [place for place, _ in self.stops]
        shares = [share for _, colour in self.stops for share in colour]
        if self.stops and (len(places) < 2 or places[0] != 0 or places[-1] != 1 or places != sorted(places)):
            raise ParameterError("A colour map has two colours or more, at places that go up from 0 to 1.")
        if not all(len(colour) == 3 for _, colour in self.stops) or not all(0 <= share <= 1 for share in shares):
            raise ParameterError("A colour is red, green and blue, each from 0 to 1.")


@dataclass(frozen=True)
class Shading:
    """The surface itself.

    normals: "smooth", "creased" (split where faces meet at more than `crease` degrees), "flat" (one for each face), or
    "auto", which is creased where the surface has sharp edges.  wireframe: the edges of the mesh over it.
    """

    normals: str = "auto"
    crease: float = 40.0
    wireframe: bool = False

    def __post_init__(self) -> None:
        one_of(self.normals, NORMALS, "shading")
        if not 0 < self.crease < 180 or not math.isfinite(self.crease):
            raise ParameterError(f"A crease is an angle between 0 and 180 degrees, not {self.crease:g}.")


def shaded(
    before: Shading, normals: str | None = None, crease: float | None = None, wireframe: bool | None = None
) -> Shading:
    """Shading with what is given changed; an angle alone makes it creased."""
    if normals is None and crease is not None:
        normals = "creased"
    return Shading(
        before.normals if normals is None else normals,
        before.crease if crease is None else crease,
        before.wireframe if wireframe is None else wireframe,
    )


TWENTY_STEPS, NO_LINES, OF_THE_STYLE, AS_IT_IS = Isolines(), Isolines(count=0), Colours(), Shading()
"""What holds where nothing is said."""
