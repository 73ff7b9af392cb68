"""Parts of a recipe in words: the options of a command, and the arguments of a function."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from bihdist_core.errors import ParameterError

from .document import Document, Point
from .page import Page, Recipe
from .starts import Starts

USUAL, USUAL_PAGE = Document(), Page()


class NotExpressible(ParameterError):
    """Why a line cannot say it."""


@dataclass(frozen=True)
class CommandFragment:
    """A part in words: options with their values (None for a switch), and arguments by name.

    Where a field starts is put into words at the end, since a curve has to have a file.
    """

    options: tuple[tuple[str, "str | Starts | None"], ...] = ()
    arguments: dict[str, Any] = field(default_factory=dict)


NOTHING = CommandFragment()


def of_document(name: str, option: str, argument: str) -> Callable[[Recipe], CommandFragment]:
    """A field that is said by one option; a switch if it is a flag."""
    return lambda recipe: if_unusual(getattr(recipe.document, name), getattr(USUAL, name), option, argument)


def of_page(name: str, option: str, argument: str) -> Callable[[Recipe], CommandFragment]:
    return lambda recipe: if_unusual(getattr(recipe.page, name), getattr(USUAL_PAGE, name), option, argument)


def if_unusual(value: Any, usual: Any, option: str, argument: str) -> CommandFragment:
    if value == usual:
        return NOTHING
    return as_switch(option, argument) if isinstance(value, bool) else with_value(option, argument, value)


def only_usual(get: Callable[[Recipe], Any], sentence: str) -> Callable[[Recipe], CommandFragment]:
    """What no option says yet."""
    usual = get(Recipe(USUAL, USUAL_PAGE))

    def say(recipe: Recipe) -> CommandFragment:
        if get(recipe) != usual:
            raise NotExpressible(sentence)
        return NOTHING

    return say


def as_switch(option: str, argument: str) -> CommandFragment:
    return CommandFragment(((option, None),), {argument: True})


def with_value(option: str, argument: str, value: Any) -> CommandFragment:
    return CommandFragment(((option, value if isinstance(value, str) else digits(value)),), {argument: value})


def digits(value: float) -> str:
    """The shortest digits that are the number again."""
    return repr(value if isinstance(value, int) else float(value))


def vertex_of(point: Point) -> int | None:
    """That of an anchor, or of a point that isolines pass through; None where nobody has put it."""
    if point.at is not None and not isinstance(point.at, int):
        raise NotExpressible("An anchor is at no vertex.")
    return point.at
