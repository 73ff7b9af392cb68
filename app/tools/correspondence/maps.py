"""Maps from the first surface to the second: of files, what errors are measured by, how they are shown."""

import os
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.scalars import whole_number

from ...document.document import Document, Panel, Point, free_names, unlike
from ...document.json_values import record, text
from ...document.looks import one_of
from ...document.part import Part
from ...document.quantities import DistanceFrom, Quantity, read_spec
from .pairs import Pairs

if TYPE_CHECKING:
    from bihdist_core.surface import Surface

    from .map_answers import MapQuestion, PositionQuestion

MOST_MAPS = 5
"""Shown beside the surface that they lead to."""

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

    def at(self, named: Callable[[str], str]) -> "MapFile":
        """The map with another path."""
        return self if self.path == SAME_IDS else replace(self, path=named(self.path))

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


@dataclass(frozen=True)
class MapColours(Quantity):
    """Where a map from the document's first surface leads, in colours; see `bihdist_core.applications.carrying`.

    by: the distance by which the document's pairs make the map, the path of one of its maps, or "": the surface's own
    colours by position, which are those of the vertices that maps lead to.
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

    def check(self, document: Document, surface: str) -> None:
        if not self.by:
            return
        if isinstance(self.by, str):
            document[Maps].of(self.by)
        check_two(document)
        if surface != document.surfaces[0].name:
            raise ParameterError(f"Maps are from the surface {document.surfaces[0].name!r}, and shown on it.")

    def question(self, document: Document, surface: str) -> "PositionQuestion | MapQuestion":
        """What has to be answered to show where the map leads."""
        from .map_answers import map_question

        return map_question(self, document, surface)

    def with_paths(self, named: Callable[[str], str]) -> "MapColours":
        return MapColours(MapFile(self.by).at(named).path) if isinstance(self.by, str) and self.by else self

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


@dataclass(frozen=True)
class Maps(Part):
    """Maps in files, and what all maps are measured by."""

    maps: tuple[MapFile, ...] = ()
    truth: Truth = Truth()

    def of(self, path: str) -> MapFile:
        """The map in a file; ParameterError if there is none."""
        found = next((each for each in self.maps if each.path == path), None)
        if found is None:
            raise ParameterError(f"There is no map {path!r}.")
        return found

    def check(self, document: Document) -> None:
        unlike([map.path for map in self.maps], "map")
        if self.maps:
            check_two(document)

    def without_surfaces(self, document: Document, surfaces: Set[str]) -> Document:
        return without_maps(document)

    def with_paths(self, named: Callable[[str], str]) -> "Maps":
        file, partners = (each and each.at(named) for each in (self.truth.file, self.truth.partners))
        return Maps(tuple(map.at(named) for map in self.maps), replace(self.truth, file=file, partners=partners))

    def check_files(self, surfaces: Mapping[str, "Surface"]) -> None:
        """Every map is one between the first two surfaces."""
        from .map_answers import map_in

        for map in self.maps:
            map_in(map, *list(surfaces.values())[:2])


def check_two(document: Document) -> None:
    """ParameterError where there are not two surfaces."""
    if len(document.surfaces) < 2:
        raise ParameterError("A map is from one surface to another, and there are not two.")


def show_maps(document: Document, by: Sequence[Spec | str] | None = None) -> Document:
    """The second surface in its colours by position, and the first once for each map.

    by: distances, and paths of the document's maps; if None all of these, and the distances that panels show or that
    maps are by.  ParameterError where there are not two surfaces.
    """
    if len(document.surfaces) < 2:
        raise ParameterError("A map is from one mesh to another; open a second one beside the first.")
    first, second = (mesh.name for mesh in document.surfaces[:2])
    specs = list(dict.fromkeys(spec for panel in document.panels for spec in panel.shows.specs))
    if by is None:
        by = [*(specs if document[Pairs].pairs else ()), *(map.path for map in document[Maps].maps)][:MOST_MAPS]
    by = by or [Spec.of("biharmonic")]
    wanted = [(second, MapColours()), *((first, MapColours(each)) for each in by)]
    ids = {name: [panel.id for panel in document.panels_of(name)] for name in (first, second)}
    panels, next_id = [], document.next_id
    for surface, shows in wanted:
        id, next_id = (ids[surface].pop(0), next_id) if ids[surface] else (next_id, next_id + 1)
        panels.append(Panel(id, shows, surface))
    return replace(document, panels=tuple(panels), next_id=next_id, range="own")


def shows_maps(document: Document) -> bool:
    """Whether a panel shows one."""
    return any(panel.shows.is_map for panel in document.panels)


def with_map(document: Document, map: MapFile) -> Document:
    """With one more, shown beside the others; one of the same file goes."""
    maps = tuple(each for each in document[Maps].maps if each.path != map.path)
    document = document.with_part(replace(document[Maps], maps=(*maps, map)))
    if len(document[Maps].maps) > MOST_MAPS:
        raise ParameterError(f"There are at most {MOST_MAPS} maps of files.")
    return show_maps(document)


def without_maps(document: Document) -> Document:
    """Without maps and what they are measured by, as when one of the surfaces becomes another.

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
    """Where fields of a surface start: where they do already, or have done."""
    names = [name for panel in document.panels_of(surface) for name in panel.shows.points]
    names += [p.name for p in document.points if p.surface == surface and p.name.startswith("source")]
    if names:
        return document, names[0]
    (name,) = free_names("source", 1, [point.name for point in document.points])
    return replace(document, points=(*document.points, Point(name, None, surface))), name


def with_truth(document: Document, truth: Truth) -> Document:
    """Measured by something else."""
    return document.with_part(replace(document[Maps], truth=truth))
