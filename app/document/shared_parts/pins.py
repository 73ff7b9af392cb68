"""Pins: points with a number, which tools measure at; pure edits of them."""

from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass, replace

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source, SurfacePoint
from bihdist_core.sources.words import short_words_of

from ..document import Document, Point, check_unique, free_names
from ..part import Part, check_colour, check_name, next_colour
from ..removal import without_orphans

MOST_PINS = 200
"""Their distances among each other are a matrix that somebody reads."""


@dataclass(frozen=True)
class Pin:
    """A pinned point, by its name among the document's points, with a name for the user and a colour of
    MARK_COLOURS."""

    point: str
    name: str = ""
    colour: int = 0

    def __post_init__(self) -> None:
        check_name(self.name, "pin")
        check_colour(self.colour)


@dataclass(frozen=True)
class Pins(Part):
    """The pins of a document.

    Attributes
    ----------
    pins
        The pins, in their order.
    """

    pins: tuple[Pin, ...] = ()

    @property
    def points(self) -> tuple[str, ...]:
        return tuple(pin.point for pin in self.pins)

    def number(self, point: str) -> int:
        """Return the number of the pin at a point, from 1; 0 for none."""
        return self.points.index(point) + 1 if point in self.points else 0

    def check(self, document: Document) -> None:
        check_unique(self.points, "pin at")

    def without_points(self, points: Set[str]) -> "Pins":
        return replace(self, pins=tuple(pin for pin in self.pins if pin.point not in points))

    def work(self, document: Document) -> Mapping[str, Iterable[object]]:
        return {"pins": [(pin, document.point(pin.point)) for pin in self.pins]}


def with_pins(document: Document, pins: Iterable[Pin]) -> Document:
    """Return the document with these pins and no others; their points are there."""
    return document.with_changed(Pins, pins=tuple(pins))


def add_pins(document: Document, places: Iterable[Source], surface: str = "A") -> Document:
    """Return the document with a pin at each vertex or point in a face that has none, in the least used colours.

    Raises ParameterError for other sources, and beyond MOST_PINS.
    """
    places = list(places)
    for at in places:
        if not isinstance(at, int | SurfacePoint):
            raise ParameterError(f"A pin is at a vertex or a place in a face, not at {short_words_of(at)}.")
    pins = list(document[Pins].pins)
    taken = {document.point(pin.point).at for pin in pins if document.point(pin.point).surface == surface}
    new = [at for at in dict.fromkeys(places) if at not in taken]
    if len(pins) + len(new) > MOST_PINS:
        raise ParameterError(f"There are at most {MOST_PINS:,} pins, not {len(pins) + len(new):,}.")
    names = free_names("pin", len(new), [point.name for point in document.points])
    for name in names:
        pins.append(Pin(name, colour=next_colour(pins)))
    points = [Point(name, at, surface) for name, at in zip(names, new, strict=True)]
    return with_pins(replace(document, points=(*document.points, *points)), pins)


def remove_pins(document: Document, points: Iterable[str]) -> Document:
    """Return the document without the pins at these points."""
    return without_orphans(document, document.with_part(document[Pins].without_points(set(points))))


def pinned_at(document: Document, place: Source, surface: str = "A") -> tuple[Document, str]:
    """Return the document with a pin at a place, and the name of its point."""
    document = add_pins(document, [place], surface)
    points = [document.point(name) for name in document[Pins].points]
    return document, next(point.name for point in points if (point.at, point.surface) == (place, surface))


def pin_instead(document: Document, places: Iterable[Source], surface: str = "A") -> Document:
    """Replace all pins by pins at these places."""
    return add_pins(remove_pins(document, document[Pins].points), places, surface)


def change_pin(document: Document, pin: Pin) -> Document:
    """Change the name or colour of the pin at a point."""
    return with_pins(document, (pin if old.point == pin.point else old for old in document[Pins].pins))


def move_pin(document: Document, point: str, place: int) -> Document:
    """Put a pin at a place among the others, 0 for the first."""
    others = [pin for pin in document[Pins].pins if pin.point != point]
    moved = [pin for pin in document[Pins].pins if pin.point == point]
    return with_pins(document, (*others[:place], *moved, *others[place:]))
