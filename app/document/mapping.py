"""Edits of a document's maps between its two surfaces, and of what they are measured by; pure functions."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError

from .document import Document, Panel, Point, free_names
from .map_colours import SAME_FACES, SAME_IDS, MapColours, MapFile, Truth
from .quantities import DistanceFrom

MOST_MAPS = 5
"""Shown beside the surface that they lead to."""


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
        by = [*(specs if document.pairs else ()), *(map.path for map in document.maps)][:MOST_MAPS]
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
    maps = tuple(each for each in document.maps if each.path != map.path)
    document = replace(document, maps=(*maps, map))
    if len(document.maps) > MOST_MAPS:
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
    return replace(document, maps=(), truth=SAME_FACES)


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
    return replace(document, truth=truth)


def with_map_paths(document: Document, path_of: Callable[[str], str]) -> Document:
    """The same with other paths of the files of maps, wherever they are named."""

    def moved(map: MapFile | None) -> MapFile | None:
        return None if map is None else replace(map, path=_moved(map.path))

    def _moved(path: str) -> str:
        return path if path in ("", SAME_IDS) else path_of(path)

    panels = tuple(
        replace(panel, shows=MapColours(_moved(panel.shows.by)))
        if isinstance(panel.shows, MapColours) and isinstance(panel.shows.by, str)
        else panel
        for panel in document.panels
    )
    truth = replace(document.truth, file=moved(document.truth.file), partners=moved(document.truth.partners))
    maps = tuple(replace(map, path=_moved(map.path)) for map in document.maps)
    return replace(document, panels=panels, maps=maps, truth=truth)
