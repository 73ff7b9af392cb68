"""What a document says of instruments: pins, pairs, the profile, the scatter, selections, and which docks are open."""

from base64 import b64decode
from dataclasses import dataclass

from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError

from .looks import one_of

DOCKS = ("pins", "profile", "scatter", "statistics", "quality", "regions", "sources", "anchors", "pairs", "robustness")
"""The instruments, each in a dock of the window."""

SECTIONS = {"section": "shorter", "section-longer": "longer", "section-whole": "whole"}
"""Ways of a profile by a plane through two points and a direction, and the part of the section that each takes."""

WAYS = ("auto", "exact", "straightened", "edges", *SECTIONS)
"""How a profile goes from point to point: `GeodesicPaths`' methods, or by planes."""

PIN_COLOURS = 10
"""How many colours there are for pins and selections."""

LONGEST_NAME = 60

Runs = tuple[tuple[int, int], ...]
"""Vertex ids as runs: from the first to the last, both included, in order, apart."""


@dataclass(frozen=True)
class Pin:
    """A pinned point.

    point: its name among the document's points.  name: for the user, its number if empty.  colour: one of PIN_COLOURS.
    """

    point: str
    name: str = ""
    colour: int = 0

    def __post_init__(self) -> None:
        check_name(self.name, "pin")
        _check_colour(self.colour)


@dataclass(frozen=True)
class Pair:
    """Two points that correspond, by their names among the document's points.

    first: on the document's first surface, second: on its second; one of them is empty as long as it waits for its
    partner.  colour: one of PIN_COLOURS.
    """

    first: str = ""
    second: str = ""
    colour: int = 0

    def __post_init__(self) -> None:
        if not (self.first or self.second) or self.first == self.second:
            raise ParameterError(f"A pair is of two points, not of {self.first!r} and {self.second!r}.")
        _check_colour(self.colour)

    @property
    def is_half(self) -> bool:
        """Whether one of its points still waits for the other."""
        return not (self.first and self.second)

    @property
    def points(self) -> tuple[str, ...]:
        """The names of those that it has."""
        return tuple(name for name in (self.first, self.second) if name)


@dataclass(frozen=True)
class PinList:
    """How pins are listed.

    distance: whose distances among them, the first panel's if None.  shares: of the maxima instead of values.
    positions: whether their coordinates are listed.
    """

    distance: Spec | None = None
    shares: bool = False
    positions: bool = False


@dataclass(frozen=True)
class Profile:
    """Fields along a path.

    points: names of the points that it goes through, all pins in their order if empty.  way: one of WAYS.  across: for
    a section, the direction (3,) that lies in its plane with the two points.  shares: of the maxima instead of values.
    """

    points: tuple[str, ...] = ()
    way: str = "auto"
    across: tuple[float, float, float] | None = None
    shares: bool = True

    def __post_init__(self) -> None:
        one_of(self.way, WAYS, "way")
        if len(self.points) == 1:
            raise ParameterError("A profile goes through two points or more.")
        if self.across is not None and not any(self.across):
            raise ParameterError("A section needs a direction across, not 0, 0, 0.")


@dataclass(frozen=True)
class Scatter:
    """One panel's field against another's, by the panels' ids; the first two panels' if None."""

    across: int | None = None
    up: int | None = None
    shares: bool = True


@dataclass(frozen=True)
class DockPlaces:
    """Where open docks are in the window, and how large.

    width, height: of the window, in logical pixels.  state: what Qt says of the docks, as base64.
    """

    width: int
    height: int
    state: str

    def __post_init__(self) -> None:
        if min(self.width, self.height) < 1:
            raise ParameterError(f"A window has a size of 1 or more, not {self.width} x {self.height}.")
        try:
            b64decode(self.state, validate=True)
        except ValueError:
            raise ParameterError(f"The places of docks are base64, not {self.state[:20]!r}.") from None


@dataclass(frozen=True)
class Selection:
    """Vertices of a surface under a name, in one of PIN_COLOURS."""

    name: str
    runs: Runs
    colour: int = 0
    surface: str = "A"

    def __post_init__(self) -> None:
        check_name(self.name, "selection")
        _check_colour(self.colour)
        ends = [end for run in self.runs for end in run]
        apart = all(a[1] + 1 < b[0] for a, b in zip(self.runs[:-1], self.runs[1:], strict=True))
        if ends != sorted(ends) or (ends and ends[0] < 0) or not apart:
            raise ParameterError("A selection is runs of vertex ids that go up and do not touch.")


def check_name(name: str, what: str) -> None:
    if name and (not name.isprintable() or len(name) > LONGEST_NAME or name != name.strip()):
        raise ParameterError(f"The name of a {what} has up to {LONGEST_NAME} printable characters, not {name[:80]!r}.")


def _check_colour(colour: int) -> None:
    if not 0 <= colour < PIN_COLOURS:
        raise ParameterError(f"There are {PIN_COLOURS} colours, numbered from 0, and none is {colour}.")


AS_LISTED, ALONG_ALL_PINS, FIRST_TWO = PinList(), Profile(), Scatter()
"""What holds where nothing is said."""
