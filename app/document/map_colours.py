"""The quantity of a map between the document's two surfaces, and what the document says of such maps."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import whole_number

from .json_values import record, text
from .looks import one_of
from .quantities import Quantity, read_spec

MAP, MAP_BY, POSITIONS = "map ", "map by ", "position colours"
"""What the words of a map begin with, of one that pairs make by a distance, and the words of what it leads to."""

SAME_IDS = "identity"
"""In the place of a file: each vertex is mapped to that of the same id."""

TRUTHS = ("auto", "none", "identity", "file")
"""Where it stands what is right: "auto" takes the same ids where both surfaces have the same faces."""


@dataclass(frozen=True)
class MapFile:
    """A map from vertices to vertices: path of a file, or SAME_IDS.  sha256: of the file's bytes."""

    path: str
    sha256: str = ""

    def __post_init__(self) -> None:
        if not self.path:
            raise ParameterError(f"A map stands in a file, or is {SAME_IDS!r}.")

    @property
    def name(self) -> str:
        """For the user."""
        return "same ids" if self.path == SAME_IDS else os.path.splitext(os.path.basename(self.path))[0]


@dataclass(frozen=True)
class Truth:
    """What maps from the document's first surface to its second are measured by.

    word: one of TRUTHS.  file: the map that is right, where it stands in one.  partners: for each vertex of the second
    surface its symmetric partner; mirror: whether that counts as right, too.  samples: of so many vertices errors are
    found, 0 for all.
    """

    word: str = "auto"
    file: MapFile | None = None
    partners: MapFile | None = None
    mirror: bool = False
    samples: int = 400

    def __post_init__(self) -> None:
        one_of(self.word, TRUTHS, "truth")
        if whole_number(self.samples, "A number of sampled vertices") < 0:
            raise ParameterError(f"Errors are found of a number of vertices, or of all for 0, not of {self.samples}.")
        if (self.word == "file") != (self.file is not None):
            raise ParameterError("A truth that stands in a file, and no other, names it.")
        if self.mirror and self.partners is None:
            raise ParameterError("For symmetric partners to count as right, they have to be known: name their map.")


SAME_FACES = Truth()
"""As long as nobody has said anything."""


@dataclass(frozen=True)
class MapColours(Quantity):
    """Where a map from the document's first surface leads, in colours; see `bihdist_core.applications.carrying`.

    by: the distance by which the document's pairs make the map, the path of one of its maps, or "": the surface's own
    colours by position, which are those of the vertices that maps lead to.
    """

    by: Spec | str = ""
    is_map = True

    def __str__(self) -> str:
        return f"{MAP_BY}{self.by}" if isinstance(self.by, Spec) else f"{MAP}{self.by}" if self.by else POSITIONS

    @property
    def specs(self) -> tuple[Spec, ...]:
        return (self.by,) if isinstance(self.by, Spec) else ()

    def with_spec(self, spec: Spec) -> "MapColours":
        return MapColours(spec)

    @property
    def done(self) -> str:  # type: ignore[override]
        return "mapped" if self.specs else ""

    @property
    def word(self) -> str:
        return f"{MAP_BY}{self.by.word}" if isinstance(self.by, Spec) else str(self)

    @property
    def title(self) -> str:
        return f"{MAP_BY}{self.by.kind.name.lower()}" if isinstance(self.by, Spec) else str(self)

    @property
    def heading(self) -> str:
        if not self.by:
            return "Positions"
        return "Full map" if isinstance(self.by, Spec) else f"Map {MapFile(self.by).name}"

    @property
    def hint(self) -> str:
        if not self.by:
            return "red, green and blue from x, y and z: the colours that maps to this surface have"
        return "each vertex has the colour of the one that it is mapped to"

    def to_json(self) -> dict[str, Any]:
        return {"map": self.by} if isinstance(self.by, str) else {"map_by": self.by.in_full}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        if "map" in data:
            return cls(record(data, where, {"map": text})["map"])
        return cls(record(data, where, {"map_by": read_spec})["map_by"]) if "map_by" in data else None

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        return map_colours(words, **parameters) if words == POSITIONS or words.startswith(MAP) else None


def map_colours(text: str, **parameters: object) -> MapColours:
    """From words as `str` writes them; ParameterError for others."""
    if text == POSITIONS:
        return MapColours()
    if text.startswith(MAP_BY):
        return MapColours(Spec.parse(text.removeprefix(MAP_BY), **parameters))
    if text.startswith(MAP) and text.removeprefix(MAP).strip():
        return MapColours(text.removeprefix(MAP).strip())
    raise ParameterError(f"{text!r} is no map: write 'map by biharmonic', 'map FILE' or {POSITIONS!r}.")
