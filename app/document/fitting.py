"""Whether the parts of a document fit together: names are unlike, and what they mean is there."""

from typing import TYPE_CHECKING

from bihdist_core.errors import ParameterError

from .map_colours import MapColours
from .quantities import own_fields

if TYPE_CHECKING:
    from .document import Document


def check_names(document: "Document") -> None:
    """ParameterError for two of one name, and for the name of nothing."""
    surfaces = _unlike([mesh.name for mesh in document.surfaces], "surface")
    points = _unlike([point.name for point in document.points], "point")
    fields = _unlike([field.name for field in document.fields], "field")
    _unlike([panel.id for panel in document.panels], "panel")
    _unlike([pin.point for pin in document.pins], "pin at")
    _unlike([selection.name for selection in document.selections], "selection")
    _unlike([each.surface for each in document.beside], "surface")
    _unlike(list(document.docks), "dock")
    for placed in (document.points, document.panels, document.fields, document.selections, document.beside):
        _known([each.surface for each in placed], surfaces, "surface")
    for named in (
        [point.image_of for point in document.points if point.image_of],
        [name for panel in document.panels for name in panel.shows.points],
        [anchor.point for anchor in document.anchors],
        list(document.isolines.through),
        [pin.point for pin in document.pins],
        [name for pair in document.pairs for name in pair.points],
        list(document.profile.points),
    ):
        _known(named, points, "point")
    _known([part.name for panel in document.panels for part in own_fields(panel.shows)], fields, "field")
    _check_pairs(document)
    _check_maps(document)


def _check_pairs(document: "Document") -> None:
    names = [name for pair in document.pairs for name in pair.points]
    if len(set(names)) < len(names):
        raise ParameterError("Two pairs have a point in common.")
    if document.pairs and len(document.surfaces) < 2:
        raise ParameterError("Pairs are of points on two surfaces, and there are not two.")
    for pair in document.pairs:
        for name, mesh in zip((pair.first, pair.second), document.surfaces, strict=False):
            if name and document.point(name).surface != mesh.name:
                raise ParameterError(f"The point {name!r} of a pair is not on the surface {mesh.name!r}.")
    if any(pair.is_half for pair in document.pairs[:-1]):
        raise ParameterError("Of all pairs only the last may still wait for one of its points.")


def _check_maps(document: "Document") -> None:
    known = _unlike([map.path for map in document.maps], "map")
    shown = [(panel, panel.shows.by) for panel in document.panels if isinstance(panel.shows, MapColours)]
    _known([by for _, by in shown if isinstance(by, str) and by], known, "map")
    led = {panel.surface for panel, by in shown if by}
    if (led or document.maps) and len(document.surfaces) < 2:
        raise ParameterError("A map is from one surface to another, and there are not two.")
    if led - {document.surfaces[0].name if document.surfaces else ""}:
        raise ParameterError(f"Maps are from the surface {document.surfaces[0].name!r}, and shown on it.")


def _unlike(names: list, what: str) -> set:
    for k, name in enumerate(names):
        if name in names[:k]:
            raise ParameterError(f"There are two {what}s {name!r}.")
    return set(names)


def _known(names: list[str], known: set[str], what: str) -> None:
    for name in names:
        if name not in known:
            raise ParameterError(f"There is no {what} {name!r}.")
