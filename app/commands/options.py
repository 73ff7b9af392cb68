"""Options that several commands have: the distance with its parameters, the vertex areas, vertex ids."""

import argparse
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from typing import Any

from bihdist_core.distances.kinds import OURS, Spec, kinds
from bihdist_core.errors import ParameterError
from bihdist_core.sources.words import source_from_words

from ..document.document import COMPARISON
from ..document.option import Option, Row, vertex as vertex_from_words
from ..document.quantities import Quantity, quantity
from ..figures.options import VERTEX_AREAS

PANELS = f"a panel; repeat for more (default: {', '.join(str(spec) for spec in COMPARISON)})"
SOURCE = "vertex (12), several (12+40+7), place in a face (f311:0.2,0.5), boundary loop (loop:0) or curve (curve.json)"
PARAMETERS = {p.name: p for kind in OURS for p in kind.parameters}
"""By name: the parameters of our distances, each of which is an option."""


def add_distance(parser: argparse.ArgumentParser, several: str = "") -> None:
    """`--distance`, and an option for each parameter of ours, which holds where the distance does not say otherwise."""
    words = f"{', '.join(kinds())}; with parameters like 'diffusion(t=1/4)', or two like 'biharmonic - geodesic'"
    if several:
        parser.add_argument("--distance", metavar="NAME", action="append", help=f"{words}: {several}")
    else:
        text = f"{words} (default: biharmonic)"
        parser.add_argument("--distance", metavar="NAME", default="biharmonic", help=text)
    for name, parameter in PARAMETERS.items():
        of = ", ".join(kind.word for kind in OURS if parameter in kind.parameters)
        parser.add_argument(
            f"--{name}",
            metavar="{" + ",".join(parameter.choices) + "}" if parameter.choices else name.upper()[:1],
            help=f"{parameter.meaning}, for {of} (default: {parameter.written(parameter.default)})",
        )


def add_output(parser: argparse.ArgumentParser, files: str) -> None:
    """Add the option of the file that is written."""
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help=files)


def add_rows(parser: argparse.ArgumentParser, *rows: Row | Option, **meanings: str) -> None:
    """Options of the table of figures' options.  None stands for what is not given.

    meanings: of some, by name, instead of their own.
    """
    for option in _options(rows):
        how: dict[str, Any] = {"dest": option.name, "help": meanings.get(option.name, option.meaning)}
        if option.is_switch:
            parser.add_argument(option.word, action=argparse.BooleanOptionalAction, default=None, **how)
            continue
        how |= {"nargs": "?", "const": option.bare} if option.bare is not None else {}
        how |= {"action": "append"} if option.repeats else {}
        how |= {"metavar": option.metavar, "choices": option.choices, "type": _argument(option.read)}
        parser.add_argument(option.word, **how)


def _options(rows: Iterable[Row | Option]) -> Iterator[Option]:
    for row in rows:
        yield from row.options if isinstance(row, Row) else (row,)


def given(options: argparse.Namespace, *known: Row | Option) -> dict[str, Any]:
    """The values of those options that are given, by the names of their arguments."""
    found = {option.name: getattr(options, option.name) for option in _options(known)}
    return {name: value for name, value in found.items() if value is not None}


def _argument(read: Callable[[str], Any]) -> Callable[[str], Any]:
    """How argparse reads it; what is wrong is the same sentence."""
    if read in (int, float, str):
        return read

    def read_argument(text: str) -> Any:
        try:
            return read(text)
        except ParameterError as error:
            raise argparse.ArgumentTypeError(str(error)) from None

    return read_argument


source, vertex = _argument(source_from_words), _argument(vertex_from_words)
"""A source from its words, and a vertex id."""


def add_areas(parser: argparse.ArgumentParser) -> None:
    """Add the option of how vertex areas are measured."""
    add_rows(parser, VERTEX_AREAS)


def specs(options: argparse.Namespace, texts: Sequence[str]) -> list[Spec]:
    """The distances that texts mean with the options beside them; ParameterError for an option that none has."""
    for text in texts:
        if " - " in text:
            raise ParameterError(f"{text!r} is a field, and has no value between two vertices; name a distance.")
    found = [Spec.parse(text, **given_parameters(options)) for text in texts]
    check_parameters(options, found)
    return found


def quantities(options: argparse.Namespace, texts: Sequence[str], fields: Sequence[str] = ()) -> list[Quantity]:
    """What texts mean with the options beside them: distances, differences, and a recipe's own fields."""
    found = [quantity(text, fields=fields, **given_parameters(options)) for text in texts]
    check_parameters(options, [spec for shows in found for spec in shows.specs])
    return found


def given_parameters(options: argparse.Namespace) -> dict[str, Any]:
    """The parameters that have been named, by option."""
    given = {name: getattr(options, name) for name in PARAMETERS}
    return {name: PARAMETERS[name].parsed(text) for name, text in given.items() if text is not None}


def check_parameters(options: argparse.Namespace, specs: Sequence[Spec]) -> None:
    """ParameterError for a parameter that none of the distances has: it would be ignored."""
    known = {parameter.name for each in specs for parameter in each.kind.parameters}
    for name in given_parameters(options):
        if name not in known:
            shown = ", ".join(dict.fromkeys(each.word for each in specs))
            raise ParameterError(f"--{name} {getattr(options, name)} is no parameter of {shown}.")


def vertices(text: str) -> list[int]:
    """Vertex ids from a text such as "3,17,42"; argparse.ArgumentTypeError for another text."""
    return [vertex(word) for word in text.split(",")]


def count(text: str) -> int:
    """How many of something, from a text; argparse.ArgumentTypeError for another text."""
    return int(_checked(text, int, lambda value: value >= 1, "a whole number from 1"))


def positive(text: str) -> float:
    """A positive finite number from a text; argparse.ArgumentTypeError for another text."""
    return _checked(text, float, lambda value: 0 < value < math.inf, "a positive number")


def share(text: str) -> float:
    """A fraction from 0 to 1 from a text; argparse.ArgumentTypeError for another text."""
    return _checked(text, float, lambda value: 0 <= value <= 1, "a fraction from 0 to 1")


def _checked(text: str, read: Callable[[str], float], holds: Callable[[float], bool], what: str) -> float:
    with suppress(ValueError):
        if holds(value := read(text)):
            return value
    raise argparse.ArgumentTypeError(f"{text!r} is not {what}")
