"""The table of distances: everything that has to be known of one before it is made.

The command line, the panels' controls, recipes, web pages, charts and the guide's table are made from it.  Importing it
imports neither numpy nor any distance.

Distances of other packages join through the entry point group `bihdist.distances`: each entry point is named with the
distance's word and leads to a `DistanceType`.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, Literal, Self

from ..errors import ParameterError

if TYPE_CHECKING:
    from ..laplacian import Laplacian
    from ..progress import Progress
    from ..surface import Surface
    from .distance import Distance

ENTRY_POINTS = "bihdist.distances"
Value = float | int | str


@dataclass(frozen=True)
class Parameter:
    """One number or word that a distance has.

    Attributes
    ----------
    name : str
        As it is typed.
    default : float, int or str
        The value where none is given; a whole number if the parameter takes whole numbers only.
    meaning : str
        In words, for help and tips.
    choices : tuple of str
        The words it may be; empty for a number.
    above : float
        What a number must exceed.
    shown : tuple of float
        The range that a control offers.
    logarithmic : bool
        Whether the control has equal steps of the logarithm.
    marks : tuple of float
        Values that the control should hit.
    at_most : float
        The largest number allowed.
    most : callable or None
        ``most(surface)`` is `at_most` where that depends on the surface.

    Examples
    --------
    >>> import bihdist
    >>> bihdist.Parameter("t", 1.0, "the time").parsed("1/4")
    0.25
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

    @property
    def is_whole(self) -> bool:
        """True if its values are whole numbers."""
        return isinstance(self.default, int)

    def checked(self, value: object) -> Value:
        """Return a value in the parameter's type.

        Parameters
        ----------
        value : object
            A number, or one of the choices.

        Returns
        -------
        float, int or str
            The value.

        Raises
        ------
        ParameterError
            If the value is not allowed.
        """
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
        """Return the value that a text means.

        Parameters
        ----------
        text : str
            One of the choices, or a number such as 50, 0.25 or 1/4.

        Returns
        -------
        float, int or str
            The value.

        Raises
        ------
        ParameterError
            If the text has no meaning, or a value that is not allowed.
        """
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
        """Return the shortest text that means a value.

        Parameters
        ----------
        value : float, int or str
            A value of the parameter.

        Returns
        -------
        str
            1/15 rather than its digits.
        """
        if isinstance(value, float):
            under = round(1 / value) if value > 1e-6 else 0
            if 1 < under <= 1000 and 1 / under == value:
                return f"1/{under}"
            return f"{value:g}" if float(f"{value:g}") == value else repr(value)
        return str(value)


def limited(parameter: Parameter, surface: "Surface") -> Parameter:
    """Return a parameter with the bounds it has on a surface; the same if these are the same on all surfaces."""
    if parameter.most is None:
        return parameter
    most = parameter.most(surface)
    return replace(parameter, at_most=most, shown=(parameter.shown[0], min(parameter.shown[1], most)))


@dataclass(frozen=True)
class DistanceType:
    """A distance before it is made: its names, its parameters, and what makes it.

    Attributes
    ----------
    word : str
        As it is typed.
    name : str
        In menus.
    hint : str
        What to look for in its fields.
    make : str or callable
        A function or class that is called with a Laplacian, the parameters and ``progress``, or where it is:
        ``"module:name"``.
    parameters : tuple of Parameter
        What can be chosen.
    quick : callable or None
        ``quick(distance)`` is the parameters of a fast stand-in to be shown until the distance is there, or None.
    squares : str
        The squared distance as a formula.
    scaling : str
        The p of the guide's table: the distance scales like the p-th power of lengths.
    cost : str
        In words.
    short : str
        The name where there is little room; empty for the whole one.
    is_complete : bool
        Whether it is made of all eigenpairs, so that nothing is left out and its accuracy can be told.
    on_pages : {"", "solved", "poles", "eigenpairs"}
        How web pages compute it: not at all, by their solver, by it at the poles of a rational function, or from
        eigenpairs that they take along.
    colour : str
        Of its curves in charts, as ``"#rrggbb"``; empty for any.
    meanwhile : str
        Where a function is that is called with a Laplacian and the parameters, and makes a coarse distance at once, to
        be shown until this one is made; None where there is none, or no need.

    Examples
    --------
    >>> import bihdist
    >>> heat = bihdist.Parameter("t", 1.0, "the time", shown=(0.0, 4.0))
    >>> kind = bihdist.DistanceType("warm", "Warmth", "even", "warmth:Warmth", (heat,))
    >>> kind.parameter("t").default
    1.0
    """

    word: str
    name: str
    hint: str
    make: str | Callable[..., "Distance"]
    parameters: tuple[Parameter, ...] = ()
    quick: Callable[["Distance"], Mapping[str, Value] | None] | None = None
    squares: str = ""
    scaling: str = ""
    cost: str = ""
    short: str = ""
    is_complete: bool = False
    on_pages: Literal["", "solved", "poles", "eigenpairs"] = ""
    colour: str = ""
    meanwhile: str = ""

    def parameter(self, name: str) -> Parameter:
        """Return the parameter of a name.

        Parameters
        ----------
        name : str
            As it is typed.

        Returns
        -------
        Parameter
            The one with this name.

        Raises
        ------
        ParameterError
            If there is none.
        """
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        own = ", ".join(p.name for p in self.parameters) or "none"
        raise ParameterError(f"{self.word} has no parameter {name!r}; it has {own}.")


@dataclass(frozen=True)
class Spec:
    """A distance's word with its own parameters and no others: equal specs are equal distances.

    Made by `of` or `parse`; as a text it is what `parse` reads: diffusion(t=1/4), biharmonic.  A coarse one stands for
    what `meanwhile` returns.
    """

    word: str
    values: tuple[tuple[str, Value], ...] = ()
    is_coarse: bool = False

    @classmethod
    def type_of(cls, word: str) -> DistanceType:
        """Return the row of the table that a word names; ParameterError, with all words, if there is none."""
        return distance_type(word)

    @classmethod
    def of(cls, word: str, **values: object) -> Self:
        """Make a spec; ParameterError for an unknown word or parameter, or a value that is not allowed."""
        found = cls.type_of(word)
        for name in values.keys() - _RETIRED.get(found.word, set()):
            found.parameter(name)
        return cls(found.word, tuple((p.name, p.checked(values.get(p.name, p.default))) for p in found.parameters))

    @classmethod
    def parse(cls, text: str, **defaults: object) -> Self:
        """Read ``word`` or ``word(name=value, ...)``; defaults are values of parameters not named, of any distance."""
        word, bracket, inside = text.strip().partition("(")
        found = cls.type_of(word.strip())
        values = {name: value for name, value in defaults.items() if name in {p.name for p in found.parameters}}
        if bracket and not inside.endswith(")"):
            raise ParameterError(f"{text!r} has no closing bracket; distances are written like diffusion(t=1/4).")
        for part in inside.removesuffix(")").split(",") if inside.removesuffix(")").strip() else ():
            name, equals, value = (x.strip() for x in part.partition("="))
            if not equals or not value:
                raise ParameterError(f"{part.strip()!r} in {text!r} is not like t=1/4.")
            if name not in _RETIRED.get(found.word, set()):
                values[name] = found.parameter(name).parsed(value)
        return cls.of(found.word, **values)

    def __str__(self) -> str:
        return self._with([name for name, value in self.values if value != self.distance_type.parameter(name).default])

    @property
    def canonical(self) -> str:
        """The text with every parameter, which stays true should a default change."""
        return self._with([name for name, _ in self.values])

    def _with(self, names: Sequence[str]) -> str:
        found = self.distance_type
        values = ", ".join(f"{name}={found.parameter(name).written(self[name])}" for name in names)
        return f"{self.word}({values})" if values else self.word

    def __getitem__(self, name: str) -> Value:
        return dict(self.values)[self.distance_type.parameter(name).name]

    @property
    def distance_type(self) -> DistanceType:
        """The row of the table that the word names."""
        return self.type_of(self.word)

    def changed(self, **values: object) -> Self:
        """Return a copy with other values of some parameters."""
        return self.of(self.word, **{**dict(self.values), **values})

    def limited_to(self, surface: "Surface") -> Self:
        """Return a copy with no value above what a surface allows."""
        most = {name: limited(self.distance_type.parameter(name), surface).at_most for name, _ in self.values}
        over = {
            name: int(most[name]) for name, value in self.values if not isinstance(value, str) and value > most[name]
        }
        return self.changed(**over) if over else self

    def load(self) -> Callable[..., Any]:
        """Import what makes the distance, so that `build` need not."""
        make = self.distance_type.make
        return _imported(make) if isinstance(make, str) else make

    @property
    def as_coarse(self) -> "Spec":
        """What stands for the coarse distance."""
        return replace(self, is_coarse=True)

    def meanwhile(self, laplacian: "Laplacian") -> "Distance | None":
        """Return a coarse distance that is there at once, to be shown until this one is made; None without need."""
        where = self.distance_type.meanwhile
        return _imported(where)(laplacian, **dict(self.values)) if where and not self.is_coarse else None

    def build(self, laplacian: "Laplacian", progress: "Progress | None" = None) -> "Distance":
        """Make the distance, which is where the long work is."""
        distance: Distance = self.load()(laplacian, **dict(self.values), progress=progress)
        distance.identity = self.canonical
        if words := distance.laplacian.operator_words:
            distance.label += words
        return distance

    def quick(self, distance: "Distance") -> "Spec | None":
        """Return a fast stand-in for the distance that this spec has made, or None."""
        values = quick(distance) if (quick := self.distance_type.quick) else None
        return None if values is None else self.changed(**values)


def distance_type(word: str) -> DistanceType:
    """Return the type of a word, or of another name for it; ParameterError, with all words, if there is none."""
    if isinstance(word, str) and word in _BY_WORD:
        return _BY_WORD[word]
    known = distance_types()
    if not isinstance(word, str) or word not in known:
        plain = word.lower().replace("_", "-") if isinstance(word, str) else ""
        if built_in := _BY_WORD.get(_ALIASES.get(plain, plain)):
            return built_in
        meant = f"did you mean geodesic(method={plain})? Otherwise " if plain in _METHODS else ""
        raise ParameterError(f"There is no distance {word!r}; {meant}choose one of {', '.join(known)}.")
    point = known[word]
    found = _loaded(point)
    if found.word != word:
        raise ParameterError(f"The distance {word!r} of {point.value} calls itself {found.word!r}.")
    return found


@cache
def distance_types() -> dict[str, Any]:
    """Return, by word and the built-in ones first, each DistanceType, or the entry point of one not yet imported.

    The words of built-in distances stand for these alone.
    """
    others = {point.name: point for point in sorted(entry_points(group=ENTRY_POINTS), key=lambda point: point.name)}
    return {**_BY_WORD, **{word: point for word, point in others.items() if word not in _BY_WORD}}


@cache
def _loaded(point: Any) -> DistanceType:
    try:
        found = point.load()
    except Exception as error:
        raise ParameterError(f"The distance {point.name!r} of {point.value} cannot be loaded: {error}.") from error
    if not isinstance(found, DistanceType):
        raise ParameterError(
            f"The distance {point.name!r} of {point.value} is a {type(found).__name__}, not a DistanceType."
        )
    return found


def _imported(where: str) -> Any:
    """Import what is at "module:name"."""
    module, _, name = where.partition(":")
    return getattr(import_module(module), name)


def _shown(value: object) -> str:
    text = repr(value) if not isinstance(value, int) or abs(value) < 10**30 else "a number of many digits"
    text = text.removesuffix(".0") if isinstance(value, float) else text
    return text if len(text) <= 40 else f"{text[:37]}..."


PAPER_TIMES = (1 / 15, 1 / 8, 1 / 4, 1.0, 4.0)
_PAIRS = Parameter(
    "k", 200, "how many eigenpairs", shown=(1, 2000), most=lambda surface: surface.largest_component_size - 1
)

FRAME_VERTICES = 12_000
"""Up to so many vertices an exact geodesic field is computed within a frame of a drag, some 60 ms."""


def _quick_geodesic(distance: "Distance") -> dict[str, Value] | None:
    is_slow = getattr(distance, "method", "") == "exact" and len(distance.surface.vertices) > FRAME_VERTICES
    return {"method": "virtual-sources"} if is_slow else None


BUILT_IN = (
    DistanceType(
        "biharmonic",
        "Biharmonic",
        "round near the source, follows the shape far away",
        "bihdist_core.distances.biharmonic:BiharmonicDistance",
        squares="Σ (Δφₖ)² / λₖ², all k",
        scaling="1",
        cost="one factorization; two solves for each source",
        short="Biharm.",
        is_complete=True,
        on_pages="solved",
        colour="#1f4fbf",
    ),
    DistanceType(
        "truncated",
        "Biharmonic, truncated",
        "the biharmonic distance from its first eigenpairs: blurred at the source",
        "bihdist_core.distances.spectral:TruncatedBiharmonicDistance",
        (_PAIRS,),
        squares="Σ (Δφₖ)² / λₖ², k ≤ K",
        scaling="1",
        cost="K eigenpairs once; sources cost next to nothing",
        short="Trunc.",
        on_pages="eigenpairs",
        colour="#4bb4d8",
    ),
    DistanceType(
        "power",
        "1/λ^α family",
        "larger α: smoother, less local",
        "bihdist_core.distances.power:PowerDistance",
        (Parameter("alpha", 1.5, "the power α of 1/λ", above=1.0, shown=(1.05, 8.0)),),
        squares="Σ (Δφₖ)² / λₖ^α, all k",
        scaling="α − 1",
        cost="some twenty factorizations for all α; as many solves",
        is_complete=True,
        on_pages="poles",
    ),
    DistanceType(
        "commute-time",
        "Commute-time",
        "a spike at the source, almost flat elsewhere",
        "bihdist_core.distances.commute_time:CommuteTimeDistance",
        squares="Σ (Δφₖ)² / λₖ, all k",
        scaling="0",
        cost="one factorization; one solve",
        short="Commute",
        is_complete=True,
        on_pages="solved",
        colour="#7d4cb8",
    ),
    DistanceType(
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
        cost="few eigenpairs for large t, else eight factorizations; as many solves",
        short="Diffus.",
        is_complete=True,
        meanwhile="bihdist_core.distances.diffusion:coarse_diffusion",
        on_pages="poles",
    ),
    DistanceType(
        "geodesic",
        "Geodesic",
        "round near the source, creases where shortest paths meet",
        "bihdist_core.distances.geodesic:GeodesicDistance",
        (
            Parameter(
                "method",
                "auto",
                "how it is computed; auto is exact where that takes 5 s at most, else uses virtual sources",
                choices=("auto", "exact", "virtual-sources", "heat", "dijkstra"),
            ),
        ),
        quick=_quick_geodesic,
        squares="length of the shortest path, squared",
        scaling="1",
        cost="a search for each source; heat: two factorizations, two solves",
        short="Geod.",
        on_pages="solved",
        colour="#c2272d",
    ),
)
_BY_WORD = {each.word: each for each in BUILT_IN}
_RETIRED = {"power": {"k"}}
"""Parameters that distances had once, which old texts and recipes hold."""
_ALIASES = {"commute": "commute-time"}
"""Other words for built-in distances, in lower case."""
_METHODS = _BY_WORD["geodesic"].parameter("method").choices[1:]
"""Methods of the geodesic distance that are often taken for distances of their own."""
