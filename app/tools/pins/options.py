"""Pins as figures are told of them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source, SurfacePoint, checked_source
from bihdist_core.sources.words import short_words_of, words_of

from ...document.lists import file_in, split_list
from ...document.option import NotExpressible, Option, Row, unsaid
from ...document.page import Recipe
from ...document.part import MARK_COLOURS
from ...document.shared_parts.pins import Pins, pin_instead, with_pins
from ...document.sources import Sources, sources_from_words


def _pins_of(recipe: Recipe) -> dict[str, Any]:
    """Return the option for pins in their usual colours."""
    document, pins = recipe.document, recipe.document[Pins].pins
    points = [document.point(pin.point) for pin in pins]
    if any(point.surface != document.surfaces[0].name for point in points):
        raise NotExpressible("A pin is on another mesh.")
    if len({point.at for point in points}) < len(points):
        raise NotExpressible("Two pins are at one place.")
    if [pin.colour for pin in pins] != [k % MARK_COLOURS for k in range(len(pins))]:
        raise NotExpressible("Pins have colours of their own.")
    places = [point.at for point in points if isinstance(point.at, int | SurfacePoint)]
    if len(places) < len(points):
        raise NotExpressible("A pin is not at a single point.")
    words = [at if isinstance(at, int) else words_of(at) for at in places]
    named = dict(zip(words, (pin.name for pin in pins), strict=True))
    if not recipe.page.pin_names or not any(named.values()):
        return {"pins": words} if pins else {}
    if list(_pins_from_words(_pins_text(named)).values()) != list(named.values()):
        raise NotExpressible("The name of a pin has a comma or a bracket.")
    return {"pins": named}


def _with_pins(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    document, pins = recipe.document, values["pins"]
    if isinstance(pins, Sources):
        from ...session.chosen_sources import chosen_on

        spec = next((spec for panel in document.panels for spec in panel.shows.specs), Spec.of("biharmonic"))
        pins = chosen_on(pins, document.surfaces[0], spec, document.areas).sources
    named = pins if isinstance(pins, Mapping) else dict.fromkeys(pins, "")
    names = {_point(checked_source(at)): name for at, name in named.items()}
    document = pin_instead(document, names, document.surfaces[0].name)
    named_pins = [replace(pin, name=name) for pin, name in zip(document[Pins].pins, names.values(), strict=True)]
    page = replace(recipe.page, pin_names=any(names.values()))
    return replace(recipe, document=with_pins(document, named_pins), page=page)


def _point(at: Source) -> Source:
    if not isinstance(at, int | SurfacePoint):
        raise ParameterError(f"A pin is at a vertex or a place in a face, and {short_words_of(at)} is neither.")
    return at


def _pins_from_words(text: str) -> Any:
    """Read sources, or places with names, 12=ear,40, as a mapping."""
    if "=" not in text or file_in(text.strip()):
        return sources_from_words(text)
    return {at.strip(): name.strip() for at, _, name in (word.partition("=") for word in split_list(text))}


def _pins_text(pins: Sequence[int | str] | Mapping[int | str, str]) -> str:
    names = pins if isinstance(pins, Mapping) else dict.fromkeys(pins, "")
    return ",".join(f"{at}={name}" if name else f"{at}" for at, name in names.items())


ROWS = (
    Row(
        (
            Option(
                "pins",
                "numbered pins at vertices or places in faces (12,f311:0.2,0.5), or names with lines to them "
                "(12=ear,f311:0.2,0.5=tip), or chosen as by --sources: farthest:5, or those in a file, @FILE, "
                "or - for standard input",
                (),
                metavar="V[=NAME],…|@FILE",
                read=_pins_from_words,
                write=_pins_text,
            ),
        ),
        ("Pins.pins", "Pin.point", "Pin.colour", "Pin.name", "Page.pin_names"),
        _pins_of,
        _with_pins,
    ),
    unsaid("for the window's list", "PinsListing.distance", "PinsListing.shares", "PinsListing.positions"),
)
