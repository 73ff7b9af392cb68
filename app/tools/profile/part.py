"""The path of a profile: through which points and how, also in words such as `source`, `pin:2` or a vertex."""

import re
from collections.abc import Sequence, Set
from dataclasses import dataclass, replace

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source, SurfacePoint, checked_source
from bihdist_core.sources.words import words_of

from ...document.document import Document, Point, free_names
from ...document.edits import show_dock
from ...document.looks import one_of
from ...document.part import Part
from ...document.shared_parts.pins import Pins

SECTIONS = {"section": "shorter", "section-longer": "longer", "section-whole": "whole"}
"""Ways of a profile by a plane through two points and a direction, and the part of the section that each takes."""

WAYS = ("auto", "exact", "edges", *SECTIONS)
"""How a profile goes from point to point: `GeodesicPaths`' methods, or by planes."""

_ONE = re.compile(r"f[0-9]+:[^,\s]+,[^,\s]+|[^,\s]+")
_POINT = re.compile(r"(source|pin)(?::([0-9]{1,9}))?")


@dataclass(frozen=True)
class Profile(Part):
    """The path along which fields are shown.

    points: names of the points that it goes through, all pins in their order if empty.  way: one of WAYS.  across: for
    a section, the direction (3,) that lies in its plane with the two points.  shares: of the maxima instead of values.
    """

    key = "profile"
    holds_points = False

    points: tuple[str, ...] = ()
    way: str = "auto"
    across: tuple[float, float, float] | None = None
    shares: bool = True

    def __post_init__(self) -> None:
        if self.way == "straightened":  # in files of before: paths that were nearly the shortest
            object.__setattr__(self, "way", "auto")
        one_of(self.way, WAYS, "way")
        if len(self.points) == 1:
            raise ParameterError("A profile goes through two points or more.")
        if self.across is not None and not any(self.across):
            raise ParameterError("A section needs a direction across, not 0, 0, 0.")

    def without_points(self, points: Set[str]) -> "Profile":
        return replace(self, points=()) if points & set(self.points) else self


def points_along(document: Document) -> tuple[str, ...]:
    """The names of the points that the profile goes through; of one pin alone, from the source to it."""
    if document[Profile].points:
        return document[Profile].points
    pins = document[Pins].points
    known = [point.name for point in document.points]
    return ("source", *pins) if len(pins) == 1 and "source" in known and "source" not in pins else pins


def words_in(text: str) -> list[str]:
    """`pin:1,f311:0.2,0.5 40` as words."""
    return _ONE.findall(text)


def with_profile(
    document: Document,
    through: Sequence[Source | str] = (),
    way: str = "auto",
    across: Sequence[float] | None = None,
) -> Document:
    """The document with the path through these points drawn on its panels; through all pins in their order if none.

    through: vertices and places in faces, "source" or "source:2", and "pin:1".  way: one of WAYS.  across: the
    direction (3,) in the planes of sections.  ParameterError for what is none of these, and for fewer than two points.
    """
    if way in SECTIONS and across is None:
        raise ParameterError("A section needs a direction that lies in its plane, such as 0,0,1: --across, or across=.")
    if across is not None and (len(across) != 3 or way not in SECTIONS):
        raise ParameterError("A direction across is three numbers, and goes with the way of a section.")
    names = []
    for word in through:
        known = _POINT.fullmatch(word) if isinstance(word, str) else None
        if known:
            names.append(_named(document, known[1], int(known[2] or 1)))
            continue
        at = checked_source(word)
        if not isinstance(at, int | SurfacePoint):
            raise ParameterError(f"A profile goes through vertices and places in faces, not {word}.")
        name = free_names("path", 1, [point.name for point in document.points])[0]
        document = replace(document, points=(*document.points, Point(name, at, document.surfaces[0].name)))
        names.append(name)
    x = None if across is None else (float(across[0]), float(across[1]), float(across[2]))
    profile = replace(document[Profile], points=tuple(names), way=way, across=x)
    document = show_dock(document.with_part(profile), "profile")
    if len(points_along(document)) < 2:
        raise ParameterError("A profile goes through two points or more; name them, or pins.")
    return document


def shows_path(document: Document) -> bool:
    """Whether the path is drawn on the panels: where the profile is open, and has two points."""
    return "profile" in document.docks and len(points_along(document)) > 1


def profile_words(document: Document) -> list[int | str]:
    """What `with_profile` takes for the points of a document's path; ParameterError where it cannot be said."""
    return [_word(document, name) for name in document[Profile].points]


def _named(document: Document, what: str, number: int) -> str:
    """The name of a source or a pin, by its number from 1."""
    points = _sources(document) if what == "source" else list(document[Pins].points)
    if not 1 <= number <= len(points):
        raise ParameterError(f"There is no {what} {number} for a profile to go through; there are {len(points)}.")
    return points[number - 1]


def _sources(document: Document) -> list[str]:
    """The points that panels show fields of, in order."""
    return list(dict.fromkeys(name for panel in document.panels for name in panel.shows.points))


def _word(document: Document, name: str) -> int | str:
    pins, sources, at = document[Pins].points, _sources(document), document.point(name).at
    if name in pins:
        return f"pin:{pins.index(name) + 1}"
    if name in sources:
        return f"source:{sources.index(name) + 1}" if len(sources) > 1 else "source"
    if isinstance(at, int):
        return at
    if isinstance(at, SurfacePoint):
        return words_of(at)
    raise ParameterError("The path goes through what is no point.")
