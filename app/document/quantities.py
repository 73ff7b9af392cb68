"""Quantities that a panel can show: something with a value at every vertex, in words and as data."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from bihdist_core.analysis.signature_types import SIGNATURES, SignatureSpec, is_signature
from bihdist_core.distances.distance_types import DistanceType, Spec
from bihdist_core.errors import ParameterError

from .json_values import flag, listed, placed, record, text
from .tools import tools

if TYPE_CHECKING:
    from .document import Document


class Choice(NamedTuple):
    """An entry of the menu of what a panel can show: its words, a tip, the quantity, and whether it is shown now."""

    words: str
    tip: str
    shows: "Quantity"
    is_shown: bool = False


class Quantity(ABC):
    """Something with a value, or a colour, at every vertex; subclasses are frozen dataclasses.

    What a tool adds is a subclass in its folder, which a row of `Tool.quantities` names; a module of `Tool.questions`
    registers what it asks.
    """

    is_distance: ClassVar[bool] = False
    """Whether it is the distance from a point, and nothing made of it."""

    is_difference: ClassVar[bool] = False
    """Whether it is one quantity less another, with a sign."""

    relates_surfaces: ClassVar[bool] = False
    """Whether it says what of one surface belongs where on another, so that there have to be two."""

    is_map: ClassVar[bool] = False
    """Whether it is shown in colours, one at each vertex, and has no values."""

    compares_meshes: ClassVar[bool] = False
    """Whether it says what a change of the mesh does to a distance."""

    in_percent: bool = False
    """Whether its values are percentage points."""

    done: ClassVar[str] = ""
    """What is done by its distance, such as "interpolated", where that can be chosen apart from the quantity."""

    @property
    @abstractmethod
    def word(self) -> str:
        """Return which quantity it is, whatever its parameters."""

    @property
    @abstractmethod
    def title(self) -> str:
        """Its name within a sentence."""

    @property
    @abstractmethod
    def heading(self) -> str:
        """Its name in heads and charts."""

    @property
    def short_heading(self) -> str:
        """A shorter name for a narrow head; "" where there is none."""
        return ""

    @property
    @abstractmethod
    def hint(self) -> str:
        """A sentence on what to look for."""

    @property
    def parts(self) -> "tuple[Quantity, ...]":
        """The two quantities of a difference; any other quantity has one part, itself."""
        return (self,)

    def check(self, document: "Document", surface: str) -> None:  # noqa: B027 (most need nothing)
        """ParameterError if a document has not what it is made of, on a surface of that name."""

    def marks_extrema(self, document: "Document") -> bool:
        """Return whether its extrema are marked in the window, although the document does not say so."""
        return False

    def with_paths(self, named: Callable[[str], str]) -> "Quantity":
        """Return the quantity with other paths of the files that it names."""
        return self

    def with_parts(self, parts: "tuple[Quantity, ...]") -> "Quantity":
        """Return the quantity made of other parts."""
        (part,) = parts
        return part

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the points that it starts from."""
        return ()

    @property
    def specs(self) -> tuple[Spec, ...]:
        """The distances it is made of."""
        return ()

    @property
    def parametrised(self) -> tuple[Spec, ...]:
        """What it has parameters of: the distances it is made of, or itself."""
        return self.specs

    def with_spec(self, spec: Spec) -> "Quantity":
        """Return the quantity by another distance, or with other parameters of its own."""
        return self

    def is_alike(self, other: "Quantity") -> bool:
        """Return whether another quantity is this one, perhaps with other values of its parameters."""
        pairs = list(zip(self.parts, other.parts, strict=False))
        parts = tuple(p.with_spec(*q.parametrised) if p.word == q.word and q.parametrised else p for p, q in pairs)
        return type(self) is type(other) and self.with_parts(parts) == other

    def moved_to(self, point: str) -> "Quantity":
        """Return the quantity from another point, where it starts from one."""
        return self

    @property
    def choices(self) -> tuple[Choice, ...]:
        """Variants of it, as a menu offers them."""
        return ()

    @classmethod
    def choice_by(cls, spec: Spec, has_other: bool) -> Choice | None:
        """Return this kind's choice in the menu of a distance; `has_other` tells whether there is a second mesh."""
        return None

    @abstractmethod
    def to_json(self) -> dict[str, Any]:
        """Return the quantity as records, texts and flags."""

    @classmethod
    @abstractmethod
    def from_json(cls, data: dict[str, Any], where: str) -> "Quantity | None":
        """Read what `to_json` has written; None for the data of another kind.

        ParameterError, with the place, for what is wrong.
        """

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> "Quantity | None":
        """Read what `str` has written; None for the words of another kind.

        `parameters` has the values that the words do not name. ParameterError for a wrong distance.
        """
        return None


class ByDistance(Quantity):
    """Made by one distance."""

    spec: Spec

    @property
    def before(self) -> str:
        """The words before those of the distance."""
        return ""

    def __str__(self) -> str:
        return f"{self.before}{self.spec}"

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (self.spec,)

    @property
    def word(self) -> str:
        return f"{self.before}{self.spec.word}"

    @property
    def title(self) -> str:
        return f"{self.before}{self.spec.distance_type.name.lower()}"

    def with_spec(self, spec: Spec) -> Quantity:
        return replace(self, spec=spec)  # type: ignore[type-var]


class FromPoint(ByDistance):
    """Made by one distance from a named point."""

    point: str

    @property
    def points(self) -> tuple[str, ...]:
        return (self.point,)

    def moved_to(self, point: str) -> Quantity:
        return replace(self, point=point)  # type: ignore[type-var]


@dataclass(frozen=True)
class DistanceFrom(FromPoint):
    """The distance of every vertex from a named point."""

    spec: Spec
    point: str = "source"
    is_distance = True

    @property
    def heading(self) -> str:
        return kind_name(self.spec.distance_type)

    @property
    def short_heading(self) -> str:
        return self.spec.distance_type.short

    @property
    def hint(self) -> str:
        return self.spec.distance_type.hint

    def to_json(self) -> dict[str, Any]:
        return {"distance": self.spec.canonical, "from": self.point}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity:
        values = record(data, where, {"distance": read_spec, "from": text})
        return cls(values["distance"], values["from"])

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity:
        return cls(Spec.parse(words, **parameters), point)


@dataclass(frozen=True)
class OwnField(Quantity):
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
    def heading(self) -> str:
        return self.name

    @property
    def hint(self) -> str:
        return "a field of your own"

    def to_json(self) -> dict[str, Any]:
        return {"field": self.name}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        return cls(record(data, where, {"field": text})["field"]) if "field" in data else None


@dataclass(frozen=True)
class VertexSignature(Quantity):
    """A value of each vertex that follows from the whole spectrum, such as the heat kernel signature; it starts
    nowhere."""

    spec: SignatureSpec

    def __str__(self) -> str:
        return str(self.spec)

    @property
    def word(self) -> str:
        return self.spec.word

    @property
    def title(self) -> str:
        return self.spec.distance_type.name.lower()

    @property
    def heading(self) -> str:
        return self.spec.distance_type.name

    @property
    def short_heading(self) -> str:
        return self.spec.distance_type.short

    @property
    def hint(self) -> str:
        return self.spec.distance_type.hint

    @property
    def parametrised(self) -> tuple[Spec, ...]:
        return (self.spec,)

    def with_spec(self, spec: Spec) -> "VertexSignature":
        return replace(self, spec=spec)  # type: ignore[arg-type]

    def to_json(self) -> dict[str, Any]:
        return {"signature": self.spec.canonical}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        if "signature" not in data:
            return None
        return cls(record(data, where, {"signature": partial(_read, SignatureSpec)})["signature"])

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        return cls(SignatureSpec.parse(words, **parameters)) if is_signature(words) else None


@dataclass(frozen=True)
class Difference(Quantity):
    """One quantity less another: each as a fraction of its maximum, or, if raw, as it is (in equal units)."""

    minuend: Quantity
    subtrahend: Quantity
    raw: bool = False
    is_difference = True

    def __post_init__(self) -> None:
        for part in self.parts:
            if part.is_map:
                raise ParameterError(f"A difference is of fields, and {part} is shown in colours.")

    def __str__(self) -> str:
        return f"{'raw ' if self.raw else ''}{self.minuend} - {self.subtrahend}"

    @property
    def in_percent(self) -> bool:  # type: ignore[override]
        return not self.raw

    @property
    def parts(self) -> tuple[Quantity, ...]:
        return (self.minuend, self.subtrahend)

    def with_parts(self, parts: tuple[Quantity, ...]) -> "Difference":
        first, second = parts
        return replace(self, minuend=first, subtrahend=second)

    @property
    def points(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys((*self.minuend.points, *self.subtrahend.points)))

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (*self.minuend.specs, *self.subtrahend.specs)

    @property
    def parametrised(self) -> tuple[Spec, ...]:
        return (*self.minuend.parametrised, *self.subtrahend.parametrised)

    @property
    def word(self) -> str:
        return f"{self.minuend.word} - {self.subtrahend.word}"

    @property
    def title(self) -> str:
        return f"{self.minuend.title} - {self.subtrahend.title}"

    @property
    def heading(self) -> str:
        return quantity_name(self)

    @property
    def hint(self) -> str:
        return f"positive where {self.minuend.title} is larger, negative where {self.subtrahend.title} is"

    def to_json(self) -> dict[str, Any]:
        return {"difference": [part.to_json() for part in self.parts], "raw": self.raw}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        if "difference" not in data:
            return None
        values = record(data, where, {"difference": listed(_part_from), "raw": flag})
        if len(values["difference"]) != 2:
            raise ParameterError(f"{where}.difference must be two distances, not {len(values['difference'])}.")
        return cls(values["difference"][0], values["difference"][1], values["raw"])


@cache
def quantity_kinds() -> tuple[type[Quantity], ...]:
    """Return the kinds of quantity that a panel can show, in the order in which their words and data are tried."""
    return (OwnField, VertexSignature, *(tool.load(name) for tool in tools() for name in tool.quantities), DistanceFrom)


def kind_name(kind: DistanceType) -> str:
    """Return the name of a distance in heads, with the power of the family's weights as a raised letter."""
    return kind.name.replace("^α", "ᵅ")


def quantity_name(shows: Quantity) -> str:
    """Return the name of a quantity in the head of a panel: "Biharmonic", "Biharmonic − Geodesic", "1/λᵅ"."""
    return " − ".join(part.heading.removesuffix(" family") for part in shows.parts)


def column_names(shown: Sequence[Quantity], are_short: bool = False) -> list[str]:
    """Return the names of quantities for the columns of a table.

    Different ones that would be alike are written as they are typed. With `are_short`, for columns with little room,
    they are as "Biharm." and "Biharm. − Geod.".
    """
    names = [quantity_name(shows) for shows in shown]
    if are_short:
        names = [" − ".join(part.short_heading or quantity_name(part) for part in shows.parts) for shows in shown]
    typed = [str(shows) for shows in shown]
    words = set(zip(names, typed, strict=True))
    is_shared = {name: sum(name == other for other, _ in words) > 1 for name in names}
    return [text if is_shared[name] else name for name, text in zip(names, typed, strict=True)]


def own_fields(shows: Quantity) -> tuple[OwnField, ...]:
    """Return the fields of the user's own that a quantity is made of."""
    return tuple(part for part in shows.parts if isinstance(part, OwnField))


def quantity(text: str, point: str = "source", fields: Collection[str] = (), **parameters: object) -> Quantity:
    """Read a distance as `Spec.parse` does, or two: "biharmonic - diffusion(t=1/4)", "raw biharmonic - geodesic".

    What tools add, such as "interpolant by biharmonic", can stand for a distance, unless it is shown in colours; so can
    the user's own `fields`, by name. `parameters` has the values that the text does not name. ParameterError for any
    other text.
    """
    words = text.strip()
    # A hyphen in a word has no spaces about it.
    parts = words.removeprefix("raw ").split(" - ")
    if len(parts) > 2:
        raise ParameterError(f"{text!r} has {len(parts)} distances; a difference has two.")
    found: list[Quantity] = []
    for part in (part.strip() for part in parts):
        try:
            read = (kind.from_words(part, point, parameters) for kind in quantity_kinds())
            found.append(OwnField(part) if part in fields else next(each for each in read if each is not None))
        except ParameterError as error:
            names = f" The fields are {', '.join(fields)}." if fields else ""
            if str(error).startswith("There is no distance"):
                names = f" Signatures are {', '.join(SIGNATURES)}, and a difference is written 'a - b'.{names}"
            raise ParameterError(f"{error}{names}") from None
    if len(found) == 1:
        if words.startswith("raw "):
            raise ParameterError(f"{text!r} is not a difference; only differences can be raw.")
        return found[0]
    return Difference(found[0], found[1], words.startswith("raw "))


def quantity_from(data: Any, where: str) -> Quantity:
    """Read what `to_json` of a quantity has written; ParameterError, with the place, for anything else."""
    found = Difference.from_json(data, where) if isinstance(data, dict) else None
    return _part_from(data, where) if found is None else found


def _part_from(data: Any, where: str) -> Quantity:
    if not isinstance(data, dict):
        return DistanceFrom.from_json(data, where)
    read = (kind.from_json(data, where) for kind in quantity_kinds())
    return next(each for each in read if each is not None)


def read_spec(data: Any, where: str) -> Spec:
    """Return a distance from its words in full; ParameterError, with the place, for anything else."""
    return _read(Spec, data, where)


def _read(kind: type[Spec], data: Any, where: str) -> Spec:
    return placed(kind.parse, where, text=text(data, where))


def from_point(shows: "Spec | Quantity", point: str) -> Quantity:
    """Return a quantity, or a distance, from another point."""
    if isinstance(shows, Spec):
        return DistanceFrom(shows, point)
    return shows.with_parts(tuple(part.moved_to(point) for part in shows.parts))
