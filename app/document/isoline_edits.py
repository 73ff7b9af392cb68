"""Isolines through points: edits of a document."""

from dataclasses import replace

from .document import Document, Point, free_names
from .removal import without_orphans


def pass_through(document: Document, vertices: tuple[int, ...], surface: str = "A") -> Document:
    """One more line through each of the vertices of a surface."""
    names = free_names("line", len(vertices), [point.name for point in document.points])
    points = [Point(name, vertex, surface) for name, vertex in zip(names, vertices, strict=True)]
    through = (*document.isolines.through, *names)
    return replace(document, points=(*document.points, *points), isolines=replace(document.isolines, through=through))


def pass_through_none(document: Document) -> Document:
    """Without lines through points, and without the points that only these had."""
    return without_orphans(document, replace(document, isolines=replace(document.isolines, through=())))
