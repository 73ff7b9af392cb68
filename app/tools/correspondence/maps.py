"""Maps from the first surface to the second: of files, what errors are measured by, how they are shown."""

import os
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.scalars import whole_number

from ...document.document import Document, check_unique, with_new_point
from ...document.file import checksum
from ...document.json_values import record, text
from ...document.looks import one_of
from ...document.part import Part
from ...document.quantities import DistanceFrom, Quantity, read_spec
from .pairs import Pairs, show_instead

if TYPE_CHECKING:
    from bihdist_core.arrays import IntArray
    from bihdist_core.surface import Surface

MOST_MAPS = 5
"""Shown beside the surface that they lead to."""

MAP, MAP_BY, POSITIONS = "map ", "map by ", "position colours"
"""The beginning of the words of a map of a file and of a map by pairs; the words of colours by position."""

SAME_IDS = "identity"
"""The path of the map that takes each vertex to that of the same id."""

TRUTHS = ("auto", "none", "identity", "file")
"""The kinds of truth; "auto" is "identity" if both surfaces have the same faces."""


@dataclass(frozen=True)
class MapFile:
    """The path of a map from vertices to vertices, or SAME_IDS, with the checksum of the file."""

    path: str
    sha256: str = ""

    def __post_init__(self) -> None:
        if not self.path:
            raise ParameterError(f"A map is the path of a file, or {SAME_IDS!r}.")

    def at(self, named: Callable[[str], str]) -> "MapFile":
        """Return the map with another path."""
        return self if self.path == SAME_IDS else replace(self, path=named(self.path))

    @property
    def name(self) -> str:
        """Its name for the user."""
        return "same ids" if self.path == SAME_IDS else os.path.splitext(os.path.basename(self.path))[0]


@dataclass(frozen=True)
class Truth:
    """The truth of maps from the document's first surface to its second.

    `word` is one of TRUTHS and `file` the true map of "file". `partners` has the symmetric partner of each vertex of
    the second surface, which counts as right, too, with `mirror`. Errors are found at so many `samples`, 0 for all
    vertices.
    """

    word: str = "auto"
    file: MapFile | None = None
    partners: MapFile | None = None
    mirror: bool = False
    samples: int = 400

    def __post_init__(self) -> None:
        one_of(self.word, TRUTHS, "truth")
        if whole_number(self.samples, "A number of sampled vertices") < 0:
            raise ParameterError(f"The number of sampled vertices is 0, for all, or more, not {self.samples}.")
        if (self.word == "file") != (self.file is not None):
            raise ParameterError('A truth names a file if it is "file", and otherwise none.')
        if self.mirror and self.partners is None:
            raise ParameterError("Symmetric partners can count as right only with the file of their map.")


@dataclass(frozen=True)
class MapColours(Quantity):
    """A map from the document's first surface, in colours; see `bihdist_core.applications.correspondence`.

    `by` is the distance by which the document's pairs make the map, the path of one of its maps, or "" for the
    surface's own colours by position, which maps to it show.
    """

    by: Spec | str = ""
    is_map = True
    relates_surfaces = True

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
        return f"{MAP_BY}{self.by.distance_type.name.lower()}" if isinstance(self.by, Spec) else str(self)

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

    def check(self, document: Document, surface: str) -> None:
        if not self.by:
            return
        if isinstance(self.by, str):
            document[Maps].of(self.by)
        check_two(document)
        if surface != document.surfaces[0].name:
            raise ParameterError(f"Maps are from the surface {document.surfaces[0].name!r}, and shown on it.")

    def with_paths(self, named: Callable[[str], str]) -> "MapColours":
        return MapColours(MapFile(self.by).at(named).path) if isinstance(self.by, str) and self.by else self

    def to_json(self) -> dict[str, Any]:
        return {"map": self.by} if isinstance(self.by, str) else {"map_by": self.by.canonical}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        if "map" in data:
            return cls(record(data, where, {"map": text})["map"])
        return cls(record(data, where, {"map_by": read_spec})["map_by"]) if "map_by" in data else None

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        return map_colours(words, **parameters) if words == POSITIONS or words.startswith(MAP) else None


def map_colours(text: str, **parameters: object) -> MapColours:
    """Return the quantity with these words, as `str` writes them; ParameterError for others."""
    if text == POSITIONS:
        return MapColours()
    if text.startswith(MAP_BY):
        return MapColours(Spec.parse(text.removeprefix(MAP_BY), **parameters))
    if text.startswith(MAP) and text.removeprefix(MAP).strip():
        return MapColours(text.removeprefix(MAP).strip())
    raise ParameterError(f"{text!r} is not a map; write 'map by biharmonic', 'map FILE' or {POSITIONS!r}.")


@dataclass(frozen=True)
class Maps(Part):
    """Maps in files, and the truth that all maps are measured by.

    Attributes
    ----------
    maps
        The files of the maps.
    truth
        The truth that the errors of all maps are measured by.
    """

    maps: tuple[MapFile, ...] = ()
    truth: Truth = Truth()

    def of(self, path: str) -> MapFile:
        """Return the map in a file; ParameterError if there is none."""
        found = next((each for each in self.maps if each.path == path), None)
        if found is None:
            raise ParameterError(f"There is no map {path!r}.")
        return found

    def check(self, document: Document) -> None:
        check_unique([map.path for map in self.maps], "map")
        if self.maps:
            check_two(document)

    def without_surfaces(self, document: Document, surfaces: Set[str]) -> Document:
        return without_maps(document)

    def with_paths(self, named: Callable[[str], str]) -> "Maps":
        file, partners = (each and each.at(named) for each in (self.truth.file, self.truth.partners))
        return Maps(tuple(map.at(named) for map in self.maps), replace(self.truth, file=file, partners=partners))

    def check_files(self, surfaces: Mapping[str, "Surface"]) -> None:
        """Raise ParameterError unless every map is one between the first two surfaces."""
        for map in self.maps:
            map_in(map, *list(surfaces.values())[:2])


def map_file(path: str, one: "Surface", two: "Surface") -> MapFile:
    """Return the map in a file, from one surface to another, with its checksum; ParameterError for other files."""
    from bihdist_core.formats.vertex_maps import read_map

    if path != SAME_IDS:
        read_map(path, one, two)
    return MapFile(path, "" if path == SAME_IDS else checksum(path))


def map_in(map: MapFile, one: "Surface", two: "Surface") -> "IntArray":
    """Return the map (n,); ParameterError if its file has changed, or is no map between these surfaces."""
    from bihdist_core.formats.vertex_maps import read_map

    if map.sha256 and checksum(map.path) != map.sha256:
        raise ParameterError(f"The map {map.path} has changed since it was chosen (its checksum differs).")
    return read_map(map.path, one, two)


def check_two(document: Document) -> None:
    """Raise ParameterError unless there are two surfaces."""
    if len(document.surfaces) < 2:
        raise ParameterError("A map is between two meshes; open a second one beside the first.")


def show_maps(document: Document, by: Sequence[Spec | str] | None = None) -> Document:
    """Show the second surface in its colours by position, and the first once for each map.

    `by` has distances and paths of the document's maps; None stands for all of these, and for the distances that
    panels show. Raises ParameterError without a second surface.
    """
    check_two(document)
    first, second = (mesh.name for mesh in document.surfaces[:2])
    specs = list(dict.fromkeys(spec for panel in document.panels for spec in panel.shows.specs))
    if by is None:
        by = [*(specs if document[Pairs].pairs else ()), *(map.path for map in document[Maps].maps)][:MOST_MAPS]
    by = by or [Spec.of("biharmonic")]
    wanted = [(second, MapColours()), *((first, MapColours(each)) for each in by)]
    return show_instead(document, wanted)


def shows_maps(document: Document) -> bool:
    """Return whether a panel shows a map."""
    return any(panel.shows.is_map for panel in document.panels)


def with_map(document: Document, map: MapFile) -> Document:
    """Return the document with one more map, which replaces one of the same file."""
    maps = tuple(each for each in document[Maps].maps if each.path != map.path)
    document = document.with_changed(Maps, maps=(*maps, map))
    if len(document[Maps].maps) > MOST_MAPS:
        raise ParameterError(f"There are at most {MOST_MAPS} maps of files.")
    return show_maps(document)


def without_maps(document: Document) -> Document:
    """Return the document without maps and their truth, as when one of the surfaces is replaced.

    A panel of a map by a distance shows that distance; others of maps go, but for the last panel of their surface.
    """
    kept = [panel for panel in document.panels if not panel.shows.is_map or panel.shows.specs]
    seen = {panel.surface for panel in kept}
    last = {panel.surface: panel for panel in document.panels if panel.surface not in seen}.values()
    document = replace(document, panels=tuple(p for p in document.panels if p in kept or p in last))
    for panel in document.panels:
        if panel.shows.is_map:
            spec = panel.shows.specs[0] if panel.shows.specs else Spec.of("biharmonic")
            document, name = _with_source(document, panel.surface)
            shown = replace(panel, shows=DistanceFrom(spec, name))
            document = replace(document, panels=tuple(shown if p.id == panel.id else p for p in document.panels))
    return document.with_part(Maps())


def _with_source(document: Document, surface: str) -> tuple[Document, str]:
    """Return the document with a source on a surface, and its name."""
    names = [name for panel in document.panels_of(surface) for name in panel.shows.points]
    names += [p.name for p in document.points if p.surface == surface and p.name.startswith("source")]
    if names:
        return document, names[0]
    return with_new_point(document, "source", None, surface)


def with_truth(document: Document, truth: Truth) -> Document:
    """Return the document with another truth."""
    return document.with_changed(Maps, truth=truth)
