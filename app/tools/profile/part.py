"""The path of a profile: through which points and how, also in words such as `source`, `pin:2` or a vertex."""

import re
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass, replace
from functools import partial

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source, SurfacePoint, checked_source
from bihdist_core.sources.words import words_of

from ...document.document import Document, with_new_point
from ...document.edits import show_dock
from ...document.looks import one_of
from ...document.on_surface import SurfaceItem
from ...document.part import Part
from ...document.shared_parts.pins import Pins

SECTIONS = {"section": "shorter", "section-longer": "longer", "section-whole": "whole"}
"""Ways of a profile by a plane through two points and a direction, and the part of the section that each takes."""

WAYS = ("auto", "exact", "edges", *SECTIONS)
"""How a profile goes from point to point: a method of `GeodesicPaths`, or a plane."""

_ONE = re.compile(r"f[0-9]+:[^,\s]+,[^,\s]+|[^,\s]+")
_POINT = re.compile(r"(source|pin)(?::([0-9]{1,9}))?")


@dataclass(frozen=True)
class Profile(Part):
    """The path along which fields are shown.

    Attributes
    ----------
    points
        The names of the points that it goes through; all pins in their order if empty.
    way
        How it leads from one to the next, one of WAYS.
    across
        The direction (3,) in the plane of a section, if one is given.
    shares
        Whether fractions of the maxima are shown instead of values.
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
            raise ParameterError("The direction across of a section cannot be 0, 0, 0.")

    def without_points(self, points: Set[str]) -> "Profile":
        return replace(self, points=()) if points & set(self.points) else self


def points_along(document: Document) -> tuple[str, ...]:
    """Return the names of the points that the profile goes through; with a single pin, from the source to it."""
    if document[Profile].points:
        return document[Profile].points
    pins = document[Pins].points
    known = [point.name for point in document.points]
    return ("source", *pins) if len(pins) == 1 and "source" in known and "source" not in pins else pins


def words_in(text: str) -> list[str]:
    """Return the words of text such as `pin:1,f311:0.2,0.5 40`."""
    return _ONE.findall(text)


def with_profile(
    document: Document,
    through: Sequence[Source | str] = (),
    way: str = "auto",
    across: Sequence[float] | None = None,
) -> Document:
    """Return the document with the path through these points drawn, through all pins if there are none.

    `through` has vertices, points in faces, "source" or "source:2", and "pin:1"; `way` is one of WAYS; `across` is
    the direction (3,) in the planes of sections. Raises ParameterError for other words, and for fewer than two
    points.
    """
    if way in SECTIONS and across is None:
        raise ParameterError("A section needs a direction that lies in its plane, such as 0,0,1: --across, or across=.")
    if across is not None and (len(across) != 3 or way not in SECTIONS):
        raise ParameterError("The direction across is three numbers, and only sections have one.")
    names = []
    for word in through:
        known = _POINT.fullmatch(word) if isinstance(word, str) else None
        if known:
            names.append(_named(document, known[1], int(known[2] or 1)))
            continue
        at = checked_source(word)
        if not isinstance(at, int | SurfacePoint):
            raise ParameterError(f"A profile goes through vertices and places in faces, not {word}.")
        document, name = with_new_point(document, "path", at, document.surfaces[0].name)
        names.append(name)
    x = None if across is None else (float(across[0]), float(across[1]), float(across[2]))
    profile = replace(document[Profile], points=tuple(names), way=way, across=x)
    document = show_dock(document.with_part(profile), "profile")
    if len(points_along(document)) < 2:
        raise ParameterError("A profile goes through two points or more; name them, or pins.")
    return document


def shows_path(document: Document) -> bool:
    """Return whether the path is drawn: the profile is open and has two points."""
    return "profile" in document.docks and len(points_along(document)) > 1


def items(document: Document) -> Iterator[SurfaceItem]:
    """Yield the path, which is removed by closing the profile."""
    if shows_path(document):
        detail = f"through {len(points_along(document)):,} points"
        close = partial(show_dock, dock="profile", is_open=False)
        yield SurfaceItem("path", "Path of the profile", detail, "line", close, dock="profile")


def profile_words(document: Document) -> list[int | str]:
    """Return the words of a path's points for `with_profile`; ParameterError if there are none."""
    return [_word(document, name) for name in document[Profile].points]


def _named(document: Document, what: str, number: int) -> str:
    """Return the name of a source or a pin, by its number from 1."""
    points = _sources(document) if what == "source" else list(document[Pins].points)
    if not 1 <= number <= len(points):
        raise ParameterError(f"There is no {what} {number} for a profile to go through; there are {len(points)}.")
    return points[number - 1]


def _sources(document: Document) -> list[str]:
    """Return the points that panels show fields of, in order."""
    return list(dict.fromkeys(name for panel in document.panels for name in panel.shows.points))


def _word(document: Document, name: str) -> int | str:
    sources, at = _sources(document), document.point(name).at
    if number := document[Pins].number(name):
        return f"pin:{number}"
    if name in sources:
        return f"source:{sources.index(name) + 1}" if len(sources) > 1 else "source"
    if isinstance(at, int):
        return at
    if isinstance(at, SurfacePoint):
        return words_of(at)
    raise ParameterError(f"The path goes through {name!r}, which is neither a vertex nor a place in a face.")
