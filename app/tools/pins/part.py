"""The look of the list of pins, as a part of the document, and the pins in the list of marks."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from bihdist_core.distances.distance_types import Spec

from ...document.document import Document
from ...document.on_surface import SurfaceItem, place_words
from ...document.part import Part
from ...document.shared_parts.pins import Pin, Pins, pin_instead, remove_pins


@dataclass(frozen=True)
class PinsListing(Part):
    """The columns of the list of pins.

    Attributes
    ----------
    distance
        The distance among the pins; None for that of the first panel.
    shares
        Whether fractions of the maxima are listed instead of values.
    positions
        Whether coordinates are listed, too.
    """

    key = "pin_list"

    distance: Spec | None = None
    shares: bool = False
    positions: bool = False


def items(document: Document) -> Iterator[SurfaceItem]:
    """Yield the pins, as a group."""
    pins = document[Pins].pins
    if pins:
        members = tuple(_item(document, pin, number) for number, pin in enumerate(pins, 1))
        remove_all = partial(pin_instead, places=())
        yield SurfaceItem("pins", "Pins", f"{len(pins):,}", "pin", remove_all, members=members, dock="pins")


def _item(document: Document, pin: Pin, number: int) -> SurfaceItem:
    detail = pin.name or place_words(document.point(pin.point).at)
    remove = partial(remove_pins, points=[pin.point])
    return SurfaceItem(f"pins:{pin.point}", f"Pin {number}", detail, "dot", remove, pin.colour)
