"""Options of figures: of `bihdist figure`, as an argument of `bihdist.figure`, and as a part of a recipe."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Curve, Source
from bihdist_core.sources.words import words_of

from .document import Document, Point
from .lists import split_list
from .page import Recipe
from .source_edits import members_of


@dataclass(frozen=True)
class Starts:
    """The start of a field."""

    at: Source

    def words(self, files: Mapping[Curve, str]) -> str:
        """Return the source as an option says it; ParameterError if a curve has no file."""
        if any(curve not in files for curve in curves_of(self.at)):
            raise ParameterError("A source is a curve, which a line names by its file; save it first.")
        return words_of(self.at, files)


def as_argument(value: Any, files: Mapping[Curve, str]) -> Any:
    """Return a value as Python writes it: words for sources that are no vertex."""
    if isinstance(value, list):
        return [as_argument(each, files) for each in value]
    if isinstance(value, Starts):
        return value.at if isinstance(value.at, int) else value.words(files)
    return value


def curves_in(document: Document) -> list[Curve]:
    """Return the curves that fields start from, each once: a line needs a file of each."""
    return list(dict.fromkeys(curve for at in document.sources for curve in curves_of(at)))


def curves_of(at: Source | None) -> list[Curve]:
    """Return the curves among the members of a source."""
    return [member for member in members_of(at) if isinstance(member, Curve)]


USUAL = Recipe(Document())


class NotExpressible(ParameterError):
    """Why a line cannot say it."""


def digits(value: float) -> str:
    """The shortest digits that are the number again."""
    return repr(value if isinstance(value, int) else float(value))


def with_commas(values: Any) -> str:
    """Numbers, as `numbers` reads them."""
    return ",".join(map(digits, values))


def numbers(text: str) -> tuple[float, ...]:
    """Read numbers with commas between them; ParameterError for other text."""
    try:
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise ParameterError(f"{text!r} is not numbers with commas between them") from None


@dataclass(frozen=True)
class Option:
    """One option of the command, and the argument of the function that means what it means.

    Parameters
    ----------
    name : str
        By which values are known; with hyphens the option's word if it has no `flag`.
    meaning : str
        The help of the command.
    default : object
        Of the argument.
    flag : str
        The option's word where that is not the name.
    group, key : str
        The argument of Python that has this one among its keys, "" where it is an argument of its own, and its key
        there, the name if empty.
    metavar, choices
        As argparse takes them.
    read, write : callable
        From the text behind the option to the value, with a ParameterError for any other text, and back; None is an
        option without text.
    bare : object
        The value of the option without text.
    is_list : bool
        The value is a list, and the option has commas between what `read` and `write` know.
    may_be_lone : bool
        The argument takes one of them without a list, too.
    replaces_panels : bool
        Other panels are shown than those of the distances.
    is_flag : bool
        It has no value, though what it means where it is not given depends on others.
    """

    name: str
    meaning: str
    default: Any = None
    flag: str = ""
    group: str = "marks"
    key: str = ""
    metavar: str | None = None
    choices: tuple[str, ...] | None = None
    read: Callable[[str], Any] = str
    write: "Callable[[Any], str | Starts | None]" = lambda value: value if isinstance(value, str) else digits(value)
    bare: Any = None
    is_list: bool = False
    may_be_lone: bool = False
    replaces_panels: bool = False
    is_flag: bool = False

    @property
    def word(self) -> str:
        """Such as `--isoline-labels`."""
        return f"--{self.flag or self.name.replace('_', '-')}"

    @property
    def argument(self) -> tuple[str, str]:
        """The argument of Python, and the key in it, "" for the argument itself."""
        return (self.group, self.key or self.name) if self.group else (self.name, "")

    @property
    def is_switch(self) -> bool:
        """Whether the option has no value: given or not."""
        return self.is_flag or (self.default is False and self.bare is None)

    def is_usual(self, value: Any) -> bool:
        """Whether an argument is as if it were not given; one without elements is."""
        if not isinstance(value, str) and (isinstance(value, Mapping | Sequence) or hasattr(value, "__array__")):
            return len(value) == 0
        return bool(value == self.default)

    def from_text(self, text: str) -> Any:
        """The value that the text behind the option means; ParameterError, or ValueError of a number, for none."""
        return [self.read(word) for word in split_list(text)] if self.is_list else self.read(text)

    def words(self, value: Any) -> "tuple[str, list[str | Starts] | None]":
        """The option as it is typed, and what its text has between commas; None for an option without text."""
        if self.is_switch:
            return self.word if value else f"--no-{self.word[2:]}", None
        texts = [self.write(each) for each in (value if self.is_list else [value])]
        return self.word, None if None in texts else [text for text in texts if text is not None]


@dataclass(frozen=True)
class Row:
    """Options that belong together, with the parts of a recipe that they express.

    Parameters
    ----------
    options
        The options.
    parts
        The parts of documents and pages, such as "Isolines.bold".
    get
        Returns the values of those options that a recipe needs, by name; NotExpressible where none can say it.
    put
        Returns the recipe with such values; ParameterError where they make no sense.
    is_of_two
        Whether it is put once all else is, and the second mesh is there.
    made_from
        Returns the document that the row has made a document from, and the option's value; None for no value.
    reason
        Why no option needs to express the parts, if none does.
    """

    options: tuple[Option, ...] = ()
    parts: tuple[str, ...] = ()
    get: Callable[[Recipe], Mapping[str, Any]] = lambda recipe: {}
    put: Callable[[Recipe, Mapping[str, Any]], Recipe] = lambda recipe, values: recipe
    is_of_two: bool = False
    made_from: Callable[[Document], tuple[Document, Any]] | None = None
    reason: str = ""

    @property
    def is_late(self) -> bool:
        """Whether it makes another document of the one that all other rows are about."""
        return self.is_of_two or self.made_from is not None


def attribute(path: str, meaning: str, metavar: str | None = None, name: str = "", **how: Any) -> Row:
    """Return the row of an option for an attribute such as "document.isolines.bold", a switch if its values are flags.

    `name` is that of the argument, by default the attribute's; `how` has further fields of `Option`.
    """
    owner, _, last = path.rpartition(".")
    usual = _at(USUAL, path)
    option = Option(name or last, meaning, usual, metavar=metavar, **how)

    def get(recipe: Recipe) -> dict[str, Any]:
        value = _at(recipe, path)
        return {} if value == usual else {option.name: value}

    def put(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
        changed: Recipe = with_attribute(recipe, path, values[option.name])
        return changed

    return Row((option,), (f"{type(_at(USUAL, owner)).__name__}.{last}",), get, put)


def unsaid(reason: str, *parts: str) -> Row:
    """Parts that no figure shows."""
    return Row(parts=parts, reason=reason)


def with_attribute(owner: Any, path: str, value: Any) -> Any:
    """A frozen value with another at a path of attributes."""
    name, _, rest = path.partition(".")
    return replace(owner, **{name: with_attribute(getattr(owner, name), rest, value) if rest else value})


def _at(owner: Any, path: str) -> Any:
    return reduce(getattr, path.split(".") if path else [], owner)


def vertex_of(point: Point) -> int | None:
    """The vertex that a point is at, None where nobody has put it; NotExpressible for a point elsewhere."""
    if point.at is not None and not isinstance(point.at, int):
        raise NotExpressible("An anchor is not at a vertex.")
    return point.at


def vertex(text: str) -> int:
    """A vertex id; ParameterError for other text."""
    try:
        return int(text)
    except ValueError:
        raise ParameterError(f"{text!r} is not a vertex id (a whole number)") from None
