"""How fields and surfaces look, as far as a document says it: isolines, colours, shading, and which way is up."""

from dataclasses import dataclass, replace

from bihdist_core.errors import ParameterError

MOST_ISOLINES = 1000
LARGEST = 1e100
"""Of values; their inverses are the smallest."""

RANGES = ("own", "shared", "fraction")
"""Where colour bars end: at the field's own maximum, at the largest of all panels of a unit, or all at 100 %."""

AXES: dict[str, tuple[float, float, float]] = {
    "x": (1.0, 0.0, 0.0),
    "-x": (-1.0, 0.0, 0.0),
    "y": (0.0, 1.0, 0.0),
    "-y": (0.0, -1.0, 0.0),
    "z": (0.0, 0.0, 1.0),
    "-z": (0.0, 0.0, -1.0),
}
"""Directions (x, y, z) by the names of the axes."""

NORMALS = ("auto", "smooth", "creased", "flat")
UPS = ("auto", "x", "-x", "y", "-y", "z", "-z")

Stops = tuple[tuple[float, tuple[float, float, float]], ...]
"""Places from 0 to 1, and the colours (RGB from 0 to 1) there."""


def one_of(value: str, choices: tuple[str, ...], what: str) -> str:
    """The value; ParameterError if it is none of the choices."""
    if value not in choices:
        raise ParameterError(f"There is no {what} {value!r}; choose one of {', '.join(choices)}.")
    return value


@dataclass(frozen=True)
class Isolines:
    """The values at which isolines are drawn.

    Attributes
    ----------
    count
        The approximate number of lines, at multiples of a round step (1, 2, 2.5 or 5 times a power of ten); without
        `round`, the number of equal steps from 0 to the maximum.
    spacing
        The step between lines, in the field's unit, which replaces the count.
    values
        The values themselves, in the field's unit, which replace count and spacing.
    bold
        Every so many lines is bolder; 0 for none.
    labels
        Whether lines are labelled with their values.
    through
        The names of points that have an isoline of their own.
    round
        Whether steps are round numbers.
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
            raise ParameterError(f"The number of isoline steps is from 0 to {MOST_ISOLINES:,}, not {self.count}.")
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
            raise ParameterError(f"Bold isolines are every n-th, with n from 0 to {MOST_ISOLINES}, not {self.bold}.")

    def scaled(self, factor: float) -> "Isolines":
        """Return the same lines for a field that is so many times as large."""
        if factor == 1 or (self.spacing is None and not self.values):
            return self
        spacing = None if self.spacing is None else min(factor * self.spacing, LARGEST)
        values = tuple(max(-LARGEST, min(factor * value, LARGEST)) for value in self.values)
        return replace(self, spacing=spacing, values=values)


@dataclass(frozen=True)
class Colours:
    """The colours of fields.

    Attributes
    ----------
    map
        The name of a colour map, "" for that of the style; with stops, the name of the user's own map.
    stops
        The user's own map: positions from 0 to 1, each with its red, green and blue.
    reversed
        Whether the map runs backwards.
    bands
        Whether there is one colour from each isoline to the next.
    """

    map: str = ""
    stops: Stops = ()
    reversed: bool = False
    bands: bool = False

    def __post_init__(self) -> None:
        places = [place for place, _ in self.stops]
        shares = [share for _, colour in self.stops for share in colour]
        if self.stops and (len(places) < 2 or places[0] != 0 or places[-1] != 1 or places != sorted(places)):
            raise ParameterError("A colour map has two or more colours, at increasing positions from 0 to 1.")
        if not all(len(colour) == 3 for _, colour in self.stops) or not all(0 <= share <= 1 for share in shares):
            raise ParameterError("A colour has red, green and blue, each from 0 to 1.")


@dataclass(frozen=True)
class Shading:
    """The shading of surfaces.

    Attributes
    ----------
    normals
        One of "smooth", "creased" (split where faces meet at more than `feature_angle` degrees), "flat" (one normal for
        each face) and "auto", which is creased where the surface has sharp edges.
    feature_angle
        The angle between normals of neighbouring faces above which an edge is sharp, in degrees.
    show_edges
        Whether the edges of the mesh are drawn over it.
    """

    normals: str = "auto"
    feature_angle: float = 40.0
    show_edges: bool = False

    def __post_init__(self) -> None:
        one_of(self.normals, NORMALS, "shading")
        if not 0 < self.feature_angle < 180:
            raise ParameterError(f"The feature angle is between 0 and 180 degrees, not {self.feature_angle:g}.")


@dataclass(frozen=True)
class Clip:
    """A plane beyond which surfaces are cut away.

    Attributes
    ----------
    normal
        The direction in which they are.
    kept
        The fraction of a surface's extent along the normal that is left.
    """

    normal: tuple[float, float, float] = (1.0, 0.0, 0.0)
    kept: float = 0.5

    def __post_init__(self) -> None:
        if not all(abs(part) <= LARGEST for part in self.normal) or not any(self.normal):
            raise ParameterError(f"The normal of a clip plane is a direction, not {self.normal}.")
        if not 0 <= self.kept <= 1:
            raise ParameterError(f"A clip plane keeps a fraction of the surface from 0 to 1, not {self.kept:g}.")

    @classmethod
    def from_words(cls, words: str) -> "Clip":
        """Return the plane that is written as "x", "-y@0.3" or "0.2,0.1,0.9@0.4"."""
        along, _, kept = words.partition("@")
        try:
            x, y, z = AXES[along] if along in AXES else map(float, along.split(","))
            return cls((x, y, z), float(kept or 0.5))
        except ValueError:
            raise ParameterError(
                f"{words!r} is not a clip plane: write an axis such as x or -y, or a normal such as 0.2,0.1,0.9, and "
                "perhaps the fraction to keep: x@0.3"
            ) from None

    def __str__(self) -> str:
        named = next((word for word, normal in AXES.items() if normal == self.normal), "")
        return f"{named or ','.join(map(repr, self.normal))}@{self.kept!r}"


CURVATURE = "curvature"
"""The scalars of a base that are not read but computed: the mean curvature."""


@dataclass(frozen=True)
class Base:
    """Scalars in grey on the surface, under isolines in the colours of the field.

    Attributes
    ----------
    scalars
        CURVATURE or the name of a field of the user's own, which comes first; "" for none.
    gradual
        Whether greys go over into each other; otherwise scalars of both signs have two greys.
    white_isolines
        Whether isolines are white instead, or what else stands out from all colours of the style.
    """

    scalars: str = ""
    gradual: bool = False
    white_isolines: bool = False


TWENTY_STEPS, NO_LINES, OF_THE_STYLE, AS_IT_IS, NO_BASE = Isolines(), Isolines(count=0), Colours(), Shading(), Base()
"""What holds where nothing is said."""
