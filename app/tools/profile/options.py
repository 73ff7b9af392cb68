"""The path of a profile as figures are told of it."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.errors import ParameterError

from ...document.option import NotExpressible, Option, Row, numbers, unsaid, with_commas
from ...document.page import Recipe
from .part import SECTIONS, WAYS, Profile, profile_words, shows_path, with_profile, words_in

WAY = Option(
    "way",
    "from point to point by auto, exact or edges; or by a section, section-longer, section-whole (default: auto)",
    "auto",
    metavar="NAME",
    choices=WAYS,
)


def direction(text: str) -> tuple[float, ...]:
    """Return three numbers from words; ParameterError for other text."""
    try:
        found = numbers(text)
    except ParameterError:
        found = ()
    if len(found) != 3:
        raise ParameterError(f"{text!r} is not a direction such as 0,0,1")
    return found


ACROSS = Option("across", "for a section: a direction in its plane", metavar="X,Y,Z", read=direction, write=with_commas)


def _path_of(recipe: Recipe) -> dict[str, Any]:
    """Return the points of the path and its way, if it is drawn."""
    document, profile = recipe.document, recipe.document[Profile]
    if not shows_path(document):
        return {}
    try:
        values: dict[str, Any] = {"profile": profile_words(document) or True}
    except ParameterError as error:
        raise NotExpressible(str(error)) from error
    if profile.way != "auto":
        values["way"] = profile.way
    if profile.way in SECTIONS:
        if profile.across is None:
            raise NotExpressible("The plane of the section turns with the view.")
        values["across"] = profile.across
    return values


def _with_path(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    if "profile" not in values:
        raise ParameterError("--way and --across need --profile.")
    through, way = values["profile"], values.get("way", "auto")
    through = () if through is True else through
    return replace(recipe, document=with_profile(recipe.document, through, way, values.get("across")))


ROWS = (
    Row(
        (
            Option(
                "profile",
                "draw the path through points: vertices, places in faces, source, pin:1 (without points: through the "
                "pins in order)",
                False,
                metavar="V,…",
                read=words_in,
                write=lambda words: None if words is True else ",".join(map(str, words)),
                bare="",
            ),
            WAY,
            ACROSS,
        ),
        ("Document.docks", "Profile.points", "Profile.way", "Profile.across"),
        _path_of,
        _with_path,
    ),
    unsaid("for the window's chart", "Profile.shares"),
)
