"""Removal of points and surfaces, with all that depends on them."""

from collections.abc import Set
from dataclasses import replace

from .document import Document
from .tools import part_types


def without_orphans(before: Document, after: Document) -> Document:
    """Return the document after, without points that were there only for what it has no more."""
    return without_points(after, before.held_points - after.held_points)


def without_points(document: Document, points: Set[str]) -> Document:
    """Remove points, which no panel and no isoline refers to, with whatever of tools refers to them."""
    return replace(
        document,
        points=tuple(point for point in document.points if point.name not in points),
        parts=tuple(part.without_points(points) for part in document.parts),
    )


def without_surfaces(document: Document, surfaces: Set[str]) -> Document:
    """Return the document, which still has these surfaces and their panels, without anything else of theirs.

    Points stay that panels show fields from.
    """
    for kind in part_types():
        document = document[kind].without_surfaces(document, surfaces)
    gone = {point.name for point in document.points if point.surface in surfaces}
    through = tuple(name for name in document.isolines.through if name not in gone)
    parts = tuple(part.without_points(gone) for part in document.parts)
    after = replace(document, isolines=replace(document.isolines, through=through), parts=parts)
    shown = {name for panel in document.panels for name in panel.shows.points}
    return without_points(without_orphans(document, after), gone - shown)
