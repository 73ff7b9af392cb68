"""The table of distances: everything that has to be known of one before it is made.

The command line, the panels' controls, recipes and the guide's table are made from it.  Importing it imports neither
numpy nor any distance.

A distance of somebody else's joins through the entry point group `bihdist.distances`: each entry point is named with
the distance's word and leads to a `Kind`.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any

from ..errors import ParameterError

if TYPE_CHECKING:
    from ..laplacian import Laplacian
    from ..progress import Progress
    from ..surface import Surface
    from .distance import Distance

GROUP = "bihdist.distances"
Value = float | int | str


@dataclass(frozen=True)
class Parameter:
    """One number or word that a distance has.

    choices: what a word may be.  above: what a number must exceed, at_most: and not; a whole number if the default is
    one.  shown: from where to where a control offers it, in equal steps of its logarithm if `logarithmic`; marks:
    values it should hit.  most: the `at_most` that a surface has, where that depends on it.
    """

    name: str
    default: Value
    meaning: str
    choices: tuple[str, ...] = ()
    above: float = 0.0
    shown: tuple[float, float] = (0.0, 1.0)
    logarithmic: bool = False
    marks: tuple[float, ...] = ()
    at_most: float = math.inf
    most: "Callable[[Surface], int] | None" = None

    def on(self, surface: "Surface") -> "Parameter":
        """The parameter with the values that it can have on a surface."""
        if self.most is None:
            return self
        most = self.most(surface)
        return replace(self, at_most=most, shown=(self.shown[0], min(self.shown[1], most)))

    @property
    def is_whole(self) -> bool:
        """Whether its values are whole numbers."""
        return isinstance(self.default, int)

    def checked(self, value: object) -> Value:
        """The value in its own type; ParameterError if it is none that the parameter can have."""
        if self.choices:
            if value not in self.choices:
                raise ParameterError(f"{self.name} must be one of {', '.join(self.choices)}, not {_shown(value)}.")
            return str(value)
        try:
            number = math.nan if isinstance(value, (bool, str)) else float(value)  # type: ignore[arg-type]
        except (TypeError, ValueError, OverflowError):
            number = math.nan
        if not (self.above < number < math.inf and number <= self.at_most) or (self.is_whole and number != int(number)):
            kind = "a whole number" if self.is_whole else "a number"
            most = "" if self.at_most == math.inf else f" and at most {self.at_most:,}"
            raise ParameterError(f"{self.name} must be {kind} above {self.above:g}{most}, not {_shown(value)}.")
        return int(number) if self.is_whole else number

    def parsed(self, text: str) -> Value:
        """The value that a text means: a word, 50, 0.25, 1/4."""
        if self.choices:
            return self.checked(text)
        if self.is_whole and text.isdecimal() and len(text) < 30:
            return self.checked(int(text))
        try:
            number = float(Fraction(text)) if "/" in text else float(text)
        except (ValueError, ZeroDivisionError, OverflowError):
            return self.checked(text)
        return self.checked(number)

    def written(self, value: Value) -> str:
        """The shortest text that means the value: 1/15 rather than its digits."""
        if isinstance(value, float):
            under = round(1 / value) if value > 1e-6 else 0
            if 1 < under <= 1000 and 1 / under == value:
                return f"1/{under}"
            return f"{value:g}" if float(f"{value:g}") == value else repr(value)
        return str(value)


@dataclass(frozen=True)
class Kind:
    """One distance, before it is made.

    word: as it is typed; name: in a menu; hint: what to look for; squares: the squared distance as a formula; scaling:
    the p of the guide's table; cost: in words.  make: a function or class that is called with a Laplacian, the
    parameters and `progress`, or where it is: "module:name".  quick(distance): the parameters of a fast stand-in to be
    shown until this one is there, or None.
    """

    word: str
    name: str
    hint: str
    make: str | Callable[..., "Distance"]
    parameters: tuple[Parameter, ...] = ()
    quick: Callable[["Distance"], Mapping[str, Value] | None] = field(default=lambda distance: None)
    squares: str = ""
    scaling: str = ""
    cost: str = ""

    def parameter(self, name: str) -> Parameter:
        """ParameterError if there is none of that name."""
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        own = ", ".join(p.name for p in self.parameters) or "none"
        raise ParameterError(f"{self.word} has no parameter {name!r}; it has {own}.")


@dataclass(frozen=True)
class Spec:
    """A kind of distance with its own parameters and no others: equal specs are equal distances.

    Made by `of` or `parse`; as a text it is what `parse` reads: diffusion(t=1/4), biharmonic.
    """

    word: str
    values: tuple[tuple[str, Value], ...] = ()

    @staticmethod
    def of(word: str, **values: object) -> "Spec":
        """ParameterError for an unknown word or parameter, or a value that cannot be."""
        kind = kind_of(word)
        for name in values:
            kind.parameter(name)
        return Spec(word, tuple((p.name, p.checked(values.get(p.name, p.default))) for p in kind.parameters))

    @staticmethod
    def parse(text: str, **defaults: object) -> "Spec":
        """From `word` or `word(name=value, ...)`; defaults: values of parameters not named, of any distance."""
        word, bracket, inside = text.strip().partition("(")
        kind = kind_of(word.strip())
        values = {name: value for name, value in defaults.items() if name in {p.name for p in kind.parameters}}
        if bracket and not inside.endswith(")"):
            raise ParameterError(f"{text!r} has no closing bracket; distances are written like diffusion(t=1/4).")
        for part in inside.removesuffix(")").split(",") if inside.removesuffix(")").strip() else ():
            name, equals, value = (x.strip() for x in part.partition("="))
            if not equals or not value:
                raise ParameterError(f"{part.strip()!r} in {text!r} is not like t=1/4.")
            values[name] = kind.parameter(name).parsed(value)
        return Spec.of(kind.word, **values)

    def __str__(self) -> str:
        return self._with([name for name, value in self.values if value != self.kind.parameter(name).default])

    @property
    def in_full(self) -> str:
        """The words of this distance with every parameter, which stay true should a default change."""
        return self._with([name for name, _ in self.values])

    def _with(self, names: Sequence[str]) -> str:
        kind = self.kind
        values = ", ".join(f"{name}={kind.parameter(name).written(self[name])}" for name in names)
        return f"{self.word}({values})" if values else self.word

    def __getitem__(self, name: str) -> Value:
        return dict(self.values)[self.kind.parameter(name).name]

    @property
    def kind(self) -> Kind:
        """The kind of distance that the word names."""
        return kind_of(self.word)

    def changed(self, **values: object) -> "Spec":
        """A copy with other values of some parameters."""
        return Spec.of(self.word, **{**dict(self.values), **values})

    def on(self, surface: "Surface") -> "Spec":
        """A copy with no value above what a surface has."""
        most = {name: self.kind.parameter(name).on(surface).at_most for name, _ in self.values}
        over = {
            name: int(most[name]) for name, value in self.values if not isinstance(value, str) and value > most[name]
        }
        return self.changed(**over) if over else self

    def load(self) -> Callable[..., "Distance"]:
        """Import what makes it, so that `build` need not."""
        make = self.kind.make
        if isinstance(make, str):
            module, _, name = make.partition(":")
            make = getattr(import_module(module), name)
        return make

    def build(self, laplacian: "Laplacian", progress: "Progress | None" = None) -> "Distance":
        """The distance, ready to be asked; this is where the long work is."""
        distance = self.load()(laplacian, **dict(self.values), progress=progress)
        distance.identity = self.in_full
        return distance

    def quick(self, distance: "Distance") -> "Spec | None":
        """A fast stand-in for the distance that this spec has made, or None."""
        values = self.kind.quick(distance)
        return None if values is None else self.changed(**values)


def kind_of(word: str) -> Kind:
    """ParameterError, with all words, if there is none."""
    if isinstance(word, str) and word in _BY_WORD:
        return _BY_WORD[word]
    known = kinds()
    if not isinstance(word, str) or word not in known:
        raise ParameterError(f"There is no distance {word!r}; choose one of {', '.join(known)}.")
    found = known[word]
    kind = _loaded(found)
    if kind.word != word:
        raise ParameterError(f"The distance {word!r} of {found.value} calls itself {kind.word!r}.")
    return kind


@cache
def kinds() -> dict[str, Any]:
    """By word, ours first: a Kind, or the entry point of somebody else's, which is not imported before it is asked for.

    A word of ours stands for ours.
    """
    others = {point.name: point for point in sorted(entry_points(group=GROUP), key=lambda point: point.name)}
    return {**_BY_WORD, **{word: point for word, point in others.items() if word not in _BY_WORD}}


@cache
def _loaded(point: Any) -> Kind:
    try:
        kind = point.load()
    except Exception as error:
        raise ParameterError(f"The distance {point.name!r} of {point.value} cannot be loaded: {error}.") from error
    if not isinstance(kind, Kind):
        raise ParameterError(f"The distance {point.name!r} of {point.value} is no Kind but a {type(kind).__name__}.")
    return kind


def _shown(value: object) -> str:
    text = repr(value) if not isinstance(value, int) or abs(value) < 10**30 else "a number of many digits"
    return text if len(text) <= 40 else f"{text[:37]}..."


PAPER_TIMES = (1 / 15, 1 / 8, 1 / 4, 1.0, 4.0)
_PAIRS = Parameter(
    "k", 200, "how many eigenpairs", shown=(1, 2000), most=lambda surface: surface.largest_component_size - 1
)

FRAME = 12_000
"""Vertices up to which an exact geodesic field is there within a frame of a drag, some 60 ms."""


def _quick_geodesic(distance: "Distance") -> dict[str, Value] | None:
    is_slow = getattr(distance, "method", "") == "exact" and len(distance.surface.vertices) > FRAME
    return {"method": "heat"} if is_slow else None


OURS = (
    Kind(
        "biharmonic",
        "Biharmonic",
        "round near the source, follows the shape far away",
        "bihdist_core.distances.biharmonic:BiharmonicDistance",
        squares="Σ (Δφₖ)² / λₖ², all k",
        scaling="1",
        cost="one factorization; two solves for each source",
    ),
    Kind(
        "truncated",
        "Biharmonic, truncated",
        "the biharmonic distance from its first eigenpairs: blurred at the source",
        "bihdist_core.distances.spectral:TruncatedBiharmonicDistance",
        (_PAIRS,),
        squares="Σ (Δφₖ)² / λₖ², k ≤ K",
        scaling="1",
        cost="K eigenpairs once; sources cost next to nothing",
    ),
    Kind(
        "power",
        "1/λ^α family",
        "larger α: smoother, less local",
        "bihdist_core.distances.spectral:PowerDistance",
        (Parameter("alpha", 1.5, "the power α of 1/λ", above=1.0, shown=(1.05, 8.0)), _PAIRS),
        squares="Σ (Δφₖ)² / λₖ^α, k ≤ K",
        scaling="α − 1",
        cost="the same",
    ),
    Kind(
        "commute-time",
        "Commute-time",
        "a spike at the source, almost flat elsewhere",
        "bihdist_core.distances.commute_time:CommuteTimeDistance",
        squares="Σ (Δφₖ)² / λₖ, all k",
        scaling="0",
        cost="one factorization; one solve",
    ),
    Kind(
        "diffusion",
        "Diffusion",
        "small t: flat far away; large t: stretched near the source",
        "bihdist_core.distances.diffusion:DiffusionDistance",
        (
            Parameter(
                "t",
                1.0,
                "diffusion time",
                shown=(PAPER_TIMES[0], PAPER_TIMES[-1]),
                logarithmic=True,
                marks=PAPER_TIMES,
            ),
        ),
        squares="Σ exp(−t λₖ/λ₁) (Δφₖ)²",
        scaling="−1",
        cost="eigenpairs up to a tolerance, more for small t",
    ),
    Kind(
        "geodesic",
        "Geodesic",
        "round near the source, creases where shortest paths meet",
        "bihdist_core.distances.geodesic:GeodesicDistance",
        (
            Parameter(
                "method",
                "auto",
                "how it is computed; auto: exactly where that takes 5 s at most, else by the heat method",
                choices=("auto", "exact", "heat", "dijkstra"),
            ),
        ),
        quick=_quick_geodesic,
        squares="length of the shortest path, squared",
        scaling="1",
        cost="exact and Dijkstra: a search for each source; heat: two factorizations, two solves",
    ),
)
_BY_WORD = {kind.word: kind for kind in OURS}
