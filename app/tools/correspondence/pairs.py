"""Pairs of corresponding points on two surfaces; pure edits of them."""

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass, replace
from functools import partial

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source

from ...document.document import Document, Panel, Point, with_new_point
from ...document.on_surface import SurfaceItem
from ...document.part import Part, check_colour, next_colour
from ...document.quantities import Quantity
from ...document.removal import without_orphans

MOST_PAIRS = 200
"""Each has a column of distances on both surfaces for each panel."""


@dataclass(frozen=True)
class Pair:
    """Two points that correspond, by their names among the document's points.

    `first` is on the document's first surface, `second` on its second; one of them is empty as long as the other has
    no partner. `colour` is one of PIN_COLOURS.
    """

    first: str = ""
    second: str = ""
    colour: int = 0

    def __post_init__(self) -> None:
        if not (self.first or self.second) or self.first == self.second:
            raise ParameterError(f"A pair has two different points, not {self.first!r} and {self.second!r}.")
        check_colour(self.colour)

    @property
    def is_half(self) -> bool:
        """Return whether one of its points is still missing."""
        return not (self.first and self.second)

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the points that it has."""
        return tuple(name for name in (self.first, self.second) if name)


@dataclass(frozen=True)
class Pairs(Part):
    """The pairs of points on the first two surfaces.

    Attributes
    ----------
    pairs
        The pairs, in their order; the last may have one point only.
    """

    pairs: tuple[Pair, ...] = ()

    @property
    def points(self) -> tuple[str, ...]:
        return tuple(name for pair in self.pairs for name in pair.points)

    def check(self, document: Document) -> None:
        if len(set(self.points)) < len(self.points):
            raise ParameterError("Two pairs have a point in common.")
        if self.pairs and len(document.surfaces) < 2:
            raise ParameterError("Pairs need two surfaces, and there is one.")
        for pair in self.pairs:
            for name, mesh in zip((pair.first, pair.second), document.surfaces, strict=False):
                if name and document.point(name).surface != mesh.name:
                    raise ParameterError(f"The point {name!r} of a pair is not on the surface {mesh.name!r}.")
        if any(pair.is_half for pair in self.pairs[:-1]):
            raise ParameterError("Only the last pair may lack a point.")

    def without_points(self, points: Set[str]) -> "Pairs":
        return Pairs(tuple(pair for pair in self.pairs if not points & set(pair.points)))

    def without_surfaces(self, document: Document, surfaces: Set[str]) -> Document:
        """Remove the half pair, too: its point may be on the surface that stays."""
        return drop_half(document) if surfaces & {mesh.name for mesh in document.surfaces[:2]} else document

    def work(self, document: Document) -> Mapping[str, Iterable[object]]:
        at = {point.name: point for point in document.points}
        return {"pairs": [(pair, at.get(pair.first), at.get(pair.second)) for pair in self.pairs]}


def with_pairs(document: Document, pairs: Iterable[Pair]) -> Document:
    """Return the document with these pairs and no others; their points are there."""
    return document.with_part(Pairs(tuple(pairs)))


def sides(document: Document) -> tuple[str, str]:
    """Return the names of the two surfaces that pairs are of; ParameterError where there are not two."""
    if len(document.surfaces) < 2:
        raise ParameterError("Pairs need two meshes; open a second one.")
    return document.surfaces[0].name, document.surfaces[1].name


def show_instead(document: Document, wanted: Iterable[tuple[str, Quantity]]) -> Document:
    """Return the document with a panel for each of these surfaces and quantities, and no others; panels that their
    surfaces have keep their ids."""
    ids = {mesh.name: [panel.id for panel in document.panels_of(mesh.name)] for mesh in document.surfaces}
    panels, next_id = [], document.next_id
    for surface, shows in wanted:
        id, next_id = (ids[surface].pop(0), next_id) if ids[surface] else (next_id, next_id + 1)
        panels.append(Panel(id, shows, surface))
    return replace(document, panels=tuple(panels), next_id=next_id, range="own")


def other_side(document: Document, surface: str) -> str | None:
    """Return the surface that corresponds to this one; None where there is none."""
    names = [mesh.name for mesh in document.surfaces[:2]]
    return names[1 - names.index(surface)] if len(names) == 2 and surface in names else None


def half_pair(document: Document) -> Pair | None:
    """Return the pair that still waits for one of its points."""
    return document[Pairs].pairs[-1] if document[Pairs].pairs and document[Pairs].pairs[-1].is_half else None


def whole_pairs(document: Document) -> tuple[Pair, ...]:
    """Return the pairs of two points, in order."""
    return tuple(pair for pair in document[Pairs].pairs if not pair.is_half)


def waiting_point(document: Document) -> Point | None:
    """Return the point that waits for its partner."""
    half = half_pair(document)
    return None if half is None else document.point(*half.points)


def place_point(document: Document, surface: str, at: Source) -> Document:
    """Place a point without a partner, move it if it is on this surface, or add its partner.

    Raises ParameterError beyond MOST_PAIRS, for a surface without pairs, and for a pair that is there already.
    """
    names = sides(document)
    if surface not in names:
        raise ParameterError(f"Pairs relate the surfaces {names[0]} and {names[1]}, not {surface}.")
    side, half = names.index(surface), half_pair(document)
    if half is not None and (half.first, half.second)[side]:
        return move_pair_point(document, half.points[0], at)
    document, name = with_new_point(document, "pair", at, surface)
    if half is None:
        if len(document[Pairs].pairs) >= MOST_PAIRS:
            raise ParameterError(f"There are at most {MOST_PAIRS:,} pairs.")
        new = Pair(*((name, "") if side == 0 else ("", name)), colour=next_colour(document[Pairs].pairs))
        return with_pairs(document, (*document[Pairs].pairs, new))
    whole = replace(half, second=name) if side else replace(half, first=name)
    document = with_pairs(document, (*document[Pairs].pairs[:-1], whole))
    number = _number_of_equal(document, whole)
    if number:
        raise ParameterError(f"That is pair {number} already.")
    return document


def drop_half(document: Document) -> Document:
    """Return the document without the point that waits for its partner."""
    half = half_pair(document)
    return document if half is None else remove_pairs(document, [half])


def remove_pairs(document: Document, pairs: Iterable[Pair]) -> Document:
    """Return the document without these pairs; the numbers of those after them decrease."""
    gone = set(pairs)
    return without_orphans(document, with_pairs(document, (pair for pair in document[Pairs].pairs if pair not in gone)))


def move_pair_point(document: Document, name: str, at: Source) -> Document:
    """Put one of the points of a pair elsewhere on its surface."""
    return replace(document, points=tuple(replace(p, at=at) if p.name == name else p for p in document.points))


def add_pairs(document: Document, places: Iterable[tuple[int, int]]) -> Document:
    """Return the document with a pair of vertices for each of these, except those that are there.

    A half pair stays the last. Raises ParameterError beyond MOST_PAIRS.
    """
    half = half_pair(document)
    if half is not None:
        document = with_pairs(document, document[Pairs].pairs[:-1])
    known = {tuple(document.point(name).at for name in pair.points) for pair in document[Pairs].pairs}
    new = [pair for pair in dict.fromkeys(places) if pair not in known]
    if len(document[Pairs].pairs) + len(new) + (half is not None) > MOST_PAIRS:
        raise ParameterError(f"There are at most {MOST_PAIRS:,} pairs, not {len(document[Pairs].pairs) + len(new):,}.")
    for places_of_both in new:
        found = []
        for surface, at in zip(sides(document), places_of_both, strict=True):
            document, name = with_new_point(document, "pair", at, surface)
            found.append(name)
        pair = Pair(found[0], found[1], next_colour(document[Pairs].pairs))
        document = with_pairs(document, (*document[Pairs].pairs, pair))
    return document if half is None else with_pairs(document, (*document[Pairs].pairs, half))


def pair_instead(document: Document, places: Iterable[tuple[int, int]]) -> Document:
    """Replace all pairs by pairs of these vertices."""
    return add_pairs(remove_pairs(document, document[Pairs].pairs), places)


def number_of(document: Document, pair: Pair) -> int:
    """Return the number of a pair, from 1."""
    return document[Pairs].pairs.index(pair) + 1


def pair_words(document: Document, surface: str) -> tuple[str, ...]:
    """Return the next step on a surface where nothing is predicted, in more and in fewer words."""
    if other_side(document, surface) is None:
        return "Open a second mesh beside this one", "Open a second mesh"
    mine, other = ("A", "B") if surface == document.surfaces[0].name else ("B", "A")
    point, half = waiting_point(document), half_pair(document)
    if point is None or half is None:
        return f"Click a point, then its partner on {other}", "Click a point"
    number = number_of(document, half)
    if point.surface != surface:
        return f"Click where point {number} of {other} is on {mine}", f"Where is point {number}?"
    place = f"vertex {point.at}" if isinstance(point.at, int) else "in a face"
    return (
        f"Point {number}, {place}, waits for its partner on {other}",
        f"Point {number}, {place}, waits",
        f"Point {number} waits",
    )


def _number_of_equal(document: Document, pair: Pair) -> int:
    """Return the number of a pair before this one at the same places; 0 if there is none."""
    places = [document.point(name).at for name in pair.points]
    for number, each in enumerate(document[Pairs].pairs, 1):
        if each is not pair and not each.is_half and [document.point(name).at for name in each.points] == places:
            return number
    return 0


def items(document: Document) -> Iterator[SurfaceItem]:
    """Yield the pairs, all in one row."""
    pairs = document[Pairs].pairs
    if pairs:
        detail, remove_all = f"{len(pairs):,} of Correspondence", partial(pair_instead, places=())
        yield SurfaceItem("pairs", "Pairs", detail, "pin", remove_all, count=len(pairs), dock="pairs")
