"""What a panel can show: something with a value at every vertex, in words and as data."""

from collections.abc import Collection
from dataclasses import dataclass, replace

from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError

from .map_colours import MAP, POSITIONS, MapColours, map_colours
from .parts import Alone, ByDistance


@dataclass(frozen=True)
class DistanceFrom(ByDistance):
    """The distance of every vertex from a named point."""

    spec: Spec
    point: str = "source"

    @property
    def points(self) -> tuple[str, ...]:
        return (self.point,)

    @property
    def hint(self) -> str:
        """What to look for."""
        return self.spec.kind.hint


@dataclass(frozen=True)
class OwnField(Alone):
    """One of the document's fields, by its name; it starts nowhere."""

    name: str

    def __str__(self) -> str:
        return self.name

    @property
    def word(self) -> str:
        return f"field {self.name}"

    @property
    def title(self) -> str:
        return self.name

    @property
    def hint(self) -> str:
        return "a field of your own"


@dataclass(frozen=True)
class Interpolant(ByDistance):
    """The values of the document's anchors, interpolated by a distance (paper, section 5.2); it starts nowhere.

    total: the sum of the anchors' weights instead.
    """

    spec: Spec
    total: bool = False

    @property
    def before(self) -> str:
        return TOTAL if self.total else INTERPOLANT

    @property
    def hint(self) -> str:
        if self.total:
            return "how far the anchors' influence reaches, as the logarithm of the sum of their weights"
        return "no extrema but at the anchors, and at tips of the shape without one"


@dataclass(frozen=True)
class ChangeOf(ByDistance):
    """How a distance differs on a changed surface from what it was before, each as a fraction of its maximum.

    At the vertices that both have.  point: on the changed surface.
    """

    spec: Spec
    point: str = "source"

    @property
    def before(self) -> str:
        return CHANGE

    @property
    def points(self) -> tuple[str, ...]:
        return (self.point,)

    @property
    def hint(self) -> str:
        return "positive where it is larger after the change, negative where it was before"


@dataclass(frozen=True)
class Prediction(ByDistance):
    """How badly each vertex fits the point that waits for its partner, by a distance (paper, section 5.2).

    From the document's pairs; it starts nowhere.  Nothing where no point of the other surface waits.
    """

    spec: Spec

    @property
    def before(self) -> str:
        return PREDICTION

    @property
    def hint(self) -> str:
        return "least where distances from the pairs are most like those of the point"


CHANGE = "change of "
"""What the words of a change begin with."""

INTERPOLANT, TOTAL = "interpolant by ", "weights by "
"""What the words of an interpolant begin with."""

PREDICTION = "prediction by "
"""What the words of a prediction begin with."""

Part = DistanceFrom | OwnField | Interpolant | ChangeOf | Prediction | MapColours
"""What a difference is made of."""


@dataclass(frozen=True)
class Difference:
    """One distance less another: each as a fraction of its maximum, or, if raw, as it is (in equal units)."""

    minuend: Part
    subtrahend: Part
    raw: bool = False

    def __post_init__(self) -> None:
        for part in self.parts:
            if isinstance(part, MapColours):
                raise ParameterError(f"A difference is of fields, and {part} is shown in colours.")

    def __str__(self) -> str:
        return f"{'raw ' if self.raw else ''}{self.minuend} - {self.subtrahend}"

    @property
    def parts(self) -> tuple[Part, ...]:
        return (self.minuend, self.subtrahend)

    def with_parts(self, parts: tuple[Part, ...]) -> "Difference":
        """The difference of others."""
        first, second = parts
        return replace(self, minuend=first, subtrahend=second)

    @property
    def points(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys((*self.minuend.points, *self.subtrahend.points)))

    @property
    def specs(self) -> tuple[Spec, ...]:
        """The distances it is made of."""
        return (*self.minuend.specs, *self.subtrahend.specs)

    @property
    def hint(self) -> str:
        """What to look for."""
        return f"positive where {self.minuend.title} is larger, negative where {self.subtrahend.title} is"


Quantity = DistanceFrom | OwnField | Interpolant | ChangeOf | Prediction | MapColours | Difference
"""What a panel can show: something with a value, or a colour, at every vertex."""


def own_fields(shows: Quantity) -> tuple[OwnField, ...]:
    """Those that a quantity is made of."""
    return tuple(part for part in shows.parts if isinstance(part, OwnField))


def quantity(text: str, point: str = "source", fields: Collection[str] = (), **parameters: object) -> Quantity:
    """From a distance as `Spec.parse` reads it, or two: "biharmonic - diffusion(t=1/4)", "raw biharmonic - geodesic".

    "interpolant by biharmonic" and "prediction by biharmonic" are as good as a distance.
    "map by biharmonic" and "position colours" are shown in colours.

    fields: names of the user's own, each as good as a distance.  parameters: values of those not named in the text.
    ParameterError for what is neither.
    """
    words = text.strip()
    # A hyphen in a word has no spaces about it.
    parts = words.removeprefix("raw ").split(" - ")
    if len(parts) > 2:
        raise ParameterError(f"{text!r} has {len(parts)} distances; a difference has two.")
    found: list[Part] = []
    for part in (part.strip() for part in parts):
        try:
            if part in fields:
                found.append(OwnField(part))
            elif part.startswith((INTERPOLANT, TOTAL)):
                distance = part.removeprefix(INTERPOLANT).removeprefix(TOTAL)
                found.append(Interpolant(Spec.parse(distance, **parameters), part.startswith(TOTAL)))
            elif part.startswith(PREDICTION):
                found.append(Prediction(Spec.parse(part.removeprefix(PREDICTION), **parameters)))
            elif part == POSITIONS or part.startswith(MAP):
                found.append(map_colours(part, **parameters))
            elif part.startswith(CHANGE):
                found.append(ChangeOf(Spec.parse(part.removeprefix(CHANGE), **parameters), point))
            else:
                found.append(DistanceFrom(Spec.parse(part, **parameters), point))
        except ParameterError as error:
            names = f" The fields are {', '.join(fields)}." if fields else ""
            raise ParameterError(f"{error}{names}") from None
    if len(found) == 1:
        if words.startswith("raw "):
            raise ParameterError(f"{text!r} is no difference, which alone may be raw.")
        return found[0]
    return Difference(found[0], found[1], words.startswith("raw "))


def from_point(shows: "Spec | Quantity", point: str) -> Quantity:
    """The same quantity from another point."""
    if isinstance(shows, Spec):
        return DistanceFrom(shows, point)
    return shows.with_parts(
        tuple(replace(part, point=point) if isinstance(part, DistanceFrom | ChangeOf) else part for part in shows.parts)
    )
