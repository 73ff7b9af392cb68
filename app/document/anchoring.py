"""Edits of a document's anchors and what is interpolated from them; pure functions, as in `edits`."""

from collections.abc import Iterable
from dataclasses import replace

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Source

from .document import Anchor, Document, Point, free_names

MOST_ANCHORS = 500
"""Each has a column of distances for each panel."""


def add_anchor(
    document: Document, at: Source, value: float | None, surface: str = "A", name: str = ""
) -> tuple[Document, str]:
    """With an anchor there, and the name of its point; one that is there already gets the value.

    ParameterError beyond MOST_ANCHORS.
    """
    for anchor in document.anchors:
        point = document.point(anchor.point)
        if (point.at, point.surface) == (at, surface):
            return change_anchor(document, replace(anchor, value=value, left_out=False)), anchor.point
    if len(document.anchors) >= MOST_ANCHORS:
        raise ParameterError(f"There are at most {MOST_ANCHORS} anchors.")
    (point_name,) = free_names("anchor", 1, [point.name for point in document.points])
    return (
        replace(
            document,
            points=(*document.points, Point(point_name, at, surface)),
            anchors=(*document.anchors, Anchor(point_name, value, name=name)),
        ),
        point_name,
    )


def change_anchor(document: Document, anchor: Anchor) -> Document:
    """Another value or name of the anchor at a point."""
    return replace(document, anchors=tuple(anchor if old.point == anchor.point else old for old in document.anchors))


def remove_anchors(document: Document, points: Iterable[str]) -> Document:
    """Without the anchors at these points."""
    gone = set(points) & {anchor.point for anchor in document.anchors}
    document = replace(document, anchors=tuple(a for a in document.anchors if a.point not in gone))
    kept = {name for panel in document.panels for name in panel.shows.points}
    kept |= {pin.point for pin in document.pins} | set(document.isolines.through) | set(document.profile.points)
    kept |= {name for pair in document.pairs for name in pair.points}
    return replace(
        document, points=tuple(point for point in document.points if point.name not in gone or point.name in kept)
    )
