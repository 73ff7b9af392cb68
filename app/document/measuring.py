"""Edits of what a document says of measuring: pins, selections, regions, docks; pure functions, as in `edits`."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from bihdist_core.applications.changes import joined_runs
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source, SurfacePoint
from bihdist_core.sources.words import short_words_of

from .document import Document, Point, free_names
from .instruments import DOCKS, PIN_COLOURS, Pin, Runs, Selection
from .looks import one_of

MOST_PINS = 200
"""Their distances among each other are a matrix that somebody reads."""


def add_pins(document: Document, places: Iterable[Source], surface: str = "A") -> Document:
    """A pin at each vertex or place in a face that has none, each in the colour that fewest have.

    ParameterError for other sources, and beyond MOST_PINS.
    """
    places = list(places)
    for at in places:
        if not isinstance(at, int | SurfacePoint):
            raise ParameterError(f"A pin is at a vertex or a place in a face, not at {short_words_of(at)}.")
    taken = {document.point(pin.point).at for pin in document.pins if document.point(pin.point).surface == surface}
    new = [at for at in dict.fromkeys(places) if at not in taken]
    if len(document.pins) + len(new) > MOST_PINS:
        raise ParameterError(f"There are at most {MOST_PINS:,} pins, not {len(document.pins) + len(new):,}.")
    names = free_names("pin", len(new), [point.name for point in document.points])
    for name, at in zip(names, new, strict=True):
        document = replace(
            document,
            points=(*document.points, Point(name, at, surface)),
            pins=(*document.pins, Pin(name, colour=_next_colour(document))),
        )
    return document


def remove_pins(document: Document, points: Iterable[str]) -> Document:
    """Without the pins at these points; a profile through them goes through all that are left."""
    gone = set(points) & {pin.point for pin in document.pins}
    profile = document.profile
    if gone & set(profile.points):
        profile = replace(profile, points=())
    document = replace(document, pins=tuple(pin for pin in document.pins if pin.point not in gone), profile=profile)
    kept = {name for panel in document.panels for name in panel.shows.points}
    kept |= {anchor.point for anchor in document.anchors} | set(document.isolines.through)
    kept |= {name for pair in document.pairs for name in pair.points}
    return replace(
        document, points=tuple(point for point in document.points if point.name not in gone or point.name in kept)
    )


def pinned_at(document: Document, place: Source, surface: str = "A") -> tuple[Document, str]:
    """With a pin at a place, and the name of its point."""
    document = add_pins(document, [place], surface)
    points = [document.point(pin.point) for pin in document.pins]
    return document, next(point.name for point in points if (point.at, point.surface) == (place, surface))


def pin_instead(document: Document, places: Iterable[Source], surface: str = "A") -> Document:
    """Pins at these places, and no others."""
    return add_pins(remove_pins(document, [pin.point for pin in document.pins]), places, surface)


def change_pin(document: Document, pin: Pin) -> Document:
    """Another name or colour of the pin at a point."""
    return replace(document, pins=tuple(pin if old.point == pin.point else old for old in document.pins))


def move_pin(document: Document, point: str, place: int) -> Document:
    """Put a pin at a place among the others, 0 for the first."""
    others = [pin for pin in document.pins if pin.point != point]
    moved = [pin for pin in document.pins if pin.point == point]
    return replace(document, pins=(*others[:place], *moved, *others[place:]))


def points_along(document: Document) -> tuple[str, ...]:
    """The names of the points that the profile goes through; of one pin alone, from the source to it."""
    if document.profile.points:
        return document.profile.points
    pins = tuple(pin.point for pin in document.pins)
    known = [point.name for point in document.points]
    return ("source", *pins) if len(pins) == 1 and "source" in known and "source" not in pins else pins


def select(document: Document, name: str, vertices: np.ndarray, surface: str = "A") -> Document:
    """Vertices (k,) as the selection of a name, instead of the old one of that name; none at all remove it."""
    before = document.selections
    if not len(vertices):
        return replace(document, selections=tuple(each for each in before if each.name != name))
    old = next((each for each in before if each.name == name), None)
    if old is None:
        counts = [sum(each.colour == colour for each in before) for colour in range(PIN_COLOURS)]
        new = Selection(name, runs_of(vertices), counts.index(min(counts)), surface)
        return replace(document, selections=(*before, new))
    new = Selection(name, runs_of(vertices), old.colour, surface)
    return replace(document, selections=tuple(new if each is old else each for each in before))


def change_selection(document: Document, name: str, new_name: str | None = None, colour: int | None = None) -> Document:
    """Another name or colour for a selection; ParameterError for a name that is empty or that another has."""
    if name not in [each.name for each in document.selections]:
        raise ParameterError(f"There is no selection {name!r}.")
    wanted = name if new_name is None else new_name.strip()
    if not wanted:
        raise ParameterError("A selection needs a name.")
    return replace(
        document,
        selections=tuple(
            replace(each, name=wanted, colour=each.colour if colour is None else colour) if each.name == name else each
            for each in document.selections
        ),
    )


def runs_of(vertices: np.ndarray) -> Runs:
    """Vertex ids (k,) as runs."""
    ids = np.unique(np.asarray(vertices, np.int64))
    if not len(ids):
        return ()
    breaks = np.flatnonzero(np.diff(ids) > 1)
    firsts, lasts = ids[np.append(0, breaks + 1)], ids[np.append(breaks, len(ids) - 1)]
    return tuple(zip(firsts.tolist(), lasts.tolist(), strict=True))


def vertices_of(runs: Runs) -> np.ndarray:
    """(k,) the vertex ids of runs."""
    firsts, lasts = np.array(runs, np.int64).reshape(-1, 2).T
    counts = lasts - firsts + 1
    # A scattered selection has as many runs as vertices.
    return np.arange(counts.sum()) + np.repeat(firsts - np.cumsum(counts) + counts, counts)


def runs_in_words(runs: Runs) -> str:
    """ "3,5-9"."""
    return ",".join(f"{first}" if first == last else f"{first}-{last}" for first, last in runs)


def runs_from_words(text: str) -> Runs:
    """Vertex ids and ranges of them, both ends included, in any order; ParameterError for other words."""
    runs: list[tuple[int, int]] = []
    for word in text.split(","):
        ends = word.strip().split("-")
        if len(ends) > 2 or not all(end.strip().isdecimal() for end in ends):
            raise ParameterError(f"{word!r} is no vertex id or range of them, such as 12 or 40-77.")
        first, last = int(ends[0]), int(ends[-1])
        if last < first:
            raise ParameterError(f"The range {word.strip()} ends before it begins.")
        runs.append((first, last))
    return joined_runs(runs)


def select_instead(document: Document, chosen: Iterable[Runs], surface: str = "A") -> Document:
    """Each of these as a selection, and no others."""
    found = list(chosen)
    names = free_names("selection", len(found), [])
    selections = [
        Selection(name, runs, k % PIN_COLOURS, surface) for k, (name, runs) in enumerate(zip(names, found, strict=True))
    ]
    return replace(document, selections=tuple(selections))


def show_dock(document: Document, dock: str, is_open: bool = True) -> Document:
    """Open or close one of DOCKS."""
    one_of(dock, DOCKS, "dock")
    others = tuple(each for each in document.docks if each != dock)
    return replace(document, docks=(*others, dock) if is_open else others)


def mark_extrema(document: Document, is_shown: bool = True) -> Document:
    """Whether extrema away from the source have triangles, in figures too."""
    return replace(document, extrema=is_shown)


def show_regions(document: Document, panel: int, is_shown: bool = True) -> Document:
    """Whether a panel shows the regions of the pins by its distance."""
    others = tuple(id for id in document.regions if id != panel)
    return replace(document, regions=(*others, panel) if is_shown else others)


def _next_colour(document: Document) -> int:
    counts = [sum(pin.colour == colour for pin in document.pins) for colour in range(PIN_COLOURS)]
    return counts.index(min(counts))
