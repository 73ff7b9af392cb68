"""Pins as figures are told of them."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bihdist_core.sources.source import Source, SurfacePoint, checked_source
from bihdist_core.sources.words import words_of

from ...document.labels import MARK_COLOURS
from ...document.option import NotExpressible, Option, Row, unsaid, vertex
from ...document.page import Recipe
from ...document.shared_parts.pins import Pins, pin_instead


def _pins_of(recipe: Recipe) -> dict[str, Any]:
    """In the colours that they get by themselves."""
    document, pins = recipe.document, recipe.document[Pins].pins
    points = [document.point(pin.point) for pin in pins]
    if any(point.surface != document.surfaces[0].name for point in points):
        raise NotExpressible("A pin is on another mesh.")
    if len({point.at for point in points}) < len(points):
        raise NotExpressible("Two pins are at one place.")
    if [pin.colour for pin in pins] != [k % MARK_COLOURS for k in range(len(pins))]:
        raise NotExpressible("Pins have other colours than usual.")
    places = [point.at for point in points if isinstance(point.at, int | SurfacePoint)]
    if len(places) < len(points):
        raise NotExpressible("A pin is at more than a point.")
    return {"pins": [at if isinstance(at, int) else words_of(at) for at in places]} if pins else {}


def _with_pins(recipe: Recipe, values: Mapping[str, Any]) -> Recipe:
    document, places = recipe.document, [checked_source(at) for at in values["pins"]]
    return replace(recipe, document=pin_instead(document, places, document.surfaces[0].name))


def _point(text: str) -> Source:
    """A vertex id, or a place in a face from its words."""
    return checked_source(text if text.strip().startswith("f") else vertex(text))


ROWS = (
    Row(
        (
            Option(
                "pins",
                "a pin with a number at a vertex or a place in a face (f311:0.2,0.5); repeat for more, in their order",
                (),
                flag="pin",
                metavar="V",
                read=_point,
                write=str,
                repeats=True,
            ),
        ),
        ("Pins.pins", "Pin.point", "Pin.colour"),
        _pins_of,
        _with_pins,
    ),
    unsaid("for the window's list", "PinsListing.distance", "PinsListing.shares", "PinsListing.positions"),
    unsaid("figures show numbers", "Pin.name"),
)
