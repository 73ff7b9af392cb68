"""Edits of a document's pairs of corresponding points; pure functions, as in `edits`."""

from collections.abc import Iterable
from dataclasses import replace

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source

from .document import Document, Point, free_names
from .instruments import PIN_COLOURS, Pair

MOST_PAIRS = 200
"""Each has a column of distances on both surfaces for each panel."""


def sides(document: Document) -> tuple[str, str]:
    """The names of the two surfaces that pairs are of; ParameterError where there are not two."""
    if len(document.surfaces) < 2:
        raise ParameterError("Pairs are of points on two meshes; open a second one beside the first.")
    return document.surfaces[0].name, document.surfaces[1].name


def other_side(document: Document, surface: str) -> str | None:
    """The surface that corresponds to this one; None where there is none."""
    names = [mesh.name for mesh in document.surfaces[:2]]
    return names[1 - names.index(surface)] if len(names) == 2 and surface in names else None


def half_pair(document: Document) -> Pair | None:
    """The pair that still waits for one of its points."""
    return document.pairs[-1] if document.pairs and document.pairs[-1].is_half else None


def whole_pairs(document: Document) -> tuple[Pair, ...]:
    """All others, in order; their numbers are their places among these, from 1."""
    return tuple(pair for pair in document.pairs if not pair.is_half)


def waiting_point(document: Document) -> Point | None:
    """The point that waits for its partner."""
    half = half_pair(document)
    return None if half is None else document.point(*half.points)


def place_point(document: Document, surface: str, at: Source) -> Document:
    """What a click does: a point that waits for its partner, which goes there if it is on this surface, or gets it.

    ParameterError beyond MOST_PAIRS, for a surface that no pairs are of, and for a pair that is there already.
    """
    names = sides(document)
    if surface not in names:
        raise ParameterError(f"Pairs are of {names[0]} and {names[1]}, not of {surface}.")
    side, half = names.index(surface), half_pair(document)
    if half is not None and (half.first, half.second)[side]:
        return move_pair_point(document, half.points[0], at)
    document, name = _with_point(document, surface, at)
    if half is None:
        if len(document.pairs) >= MOST_PAIRS:
            raise ParameterError(f"There are at most {MOST_PAIRS:,} pairs.")
        new = Pair(*((name, "") if side == 0 else ("", name)), colour=_next_colour(document))
        return replace(document, pairs=(*document.pairs, new))
    whole = replace(half, second=name) if side else replace(half, first=name)
    document = replace(document, pairs=(*document.pairs[:-1], whole))
    number = _same(document, whole)
    if number:
        raise ParameterError(f"That is pair {number} already.")
    return document


def drop_half(document: Document) -> Document:
    """Without the point that waits for its partner."""
    half = half_pair(document)
    return document if half is None else remove_pairs(document, [half])


def remove_pairs(document: Document, pairs: Iterable[Pair]) -> Document:
    """Without these; those after them have lower numbers then."""
    gone = set(pairs) & set(document.pairs)
    names = {name for pair in gone for name in pair.points}
    document = replace(document, pairs=tuple(pair for pair in document.pairs if pair not in gone))
    kept = {name for panel in document.panels for name in panel.shows.points} | set(document.isolines.through)
    kept |= {pin.point for pin in document.pins} | {anchor.point for anchor in document.anchors}
    kept |= set(document.profile.points)
    return replace(document, points=tuple(p for p in document.points if p.name not in names or p.name in kept))


def move_pair_point(document: Document, name: str, at: Source) -> Document:
    """Put one of the points of a pair elsewhere on its surface."""
    return replace(document, points=tuple(replace(p, at=at) if p.name == name else p for p in document.points))


def add_pairs(document: Document, places: Iterable[tuple[int, int]]) -> Document:
    """With a pair of vertices of the two surfaces each, but for those that are there; a half pair stays the last.

    ParameterError beyond MOST_PAIRS.
    """
    half = half_pair(document)
    if half is not None:
        document = replace(document, pairs=document.pairs[:-1])
    known = {tuple(document.point(name).at for name in pair.points) for pair in document.pairs}
    new = [pair for pair in dict.fromkeys(places) if pair not in known]
    if len(document.pairs) + len(new) + (half is not None) > MOST_PAIRS:
        raise ParameterError(f"There are at most {MOST_PAIRS:,} pairs, not {len(document.pairs) + len(new):,}.")
    for places_of_both in new:
        found = []
        for surface, at in zip(sides(document), places_of_both, strict=True):
            document, name = _with_point(document, surface, at)
            found.append(name)
        pair = Pair(found[0], found[1], _next_colour(document))
        document = replace(document, pairs=(*document.pairs, pair))
    return document if half is None else replace(document, pairs=(*document.pairs, half))


def pair_instead(document: Document, places: Iterable[tuple[int, int]]) -> Document:
    """Pairs of these vertices, and no others."""
    return add_pairs(remove_pairs(document, document.pairs), places)


def without_pairs_on(document: Document, surface: str) -> Document:
    """Without pairs that have a point on a surface."""
    return remove_pairs(document, [p for p in document.pairs if any(_is_on(document, n, surface) for n in p.points)])


def number_of(document: Document, pair: Pair) -> int:
    """From 1, in the order of the document."""
    return document.pairs.index(pair) + 1


def pair_words(document: Document, surface: str) -> tuple[str, ...]:
    """What a surface says where nothing is predicted: "Point 11, vertex 4440, waits for its partner on B", or what a
    click does there; then the same in fewer words.
    """
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


def _with_point(document: Document, surface: str, at: Source) -> tuple[Document, str]:
    (name,) = free_names("pair", 1, [point.name for point in document.points])
    return replace(document, points=(*document.points, Point(name, at, surface))), name


def _same(document: Document, pair: Pair) -> int:
    """The number of a pair before this one at the same places; 0 if there is none."""
    places = [document.point(name).at for name in pair.points]
    for number, each in enumerate(document.pairs, 1):
        if each is not pair and not each.is_half and [document.point(name).at for name in each.points] == places:
            return number
    return 0


def _is_on(document: Document, name: str, surface: str) -> bool:
    return document.point(name).surface == surface


def _next_colour(document: Document) -> int:
    counts = [sum(pair.colour == colour for pair in document.pairs) for colour in range(PIN_COLOURS)]
    return counts.index(min(counts))
