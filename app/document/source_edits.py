"""Edits of where fields start: members that join a source, leave it, or move; pure functions, as in `edits`."""

from collections.abc import Sequence

from bihdist_core.sources.source import BoundaryLoop, Curve, Member, Source, SourceSet, SurfacePoint

from .document import Document
from .edits import put_point, source_name

DIGITS = 4
"""Of the weights of places that are pointed at: far below what a pointer can tell."""


def place_in(face: int, weights: Sequence[float]) -> SurfacePoint:
    """Return the place in a face, with weights (3,) in few digits."""
    first, second = (round(max(float(w), 0.0), DIGITS) for w in weights[:2])
    first = min(first, 1.0)
    return SurfacePoint.of(face, first, min(second, round(1 - first, DIGITS)))


def place_at(corners: Sequence[int], face: int, weights: Sequence[float]) -> int | SurfacePoint:
    """Return the same, or the vertex where one of the face's corners (3,) has all of the weight."""
    place = place_in(face, weights)
    for corner, weight in zip(corners, place.weights, strict=True):
        if weight == 1:
            return int(corner)
    return place


def members_of(source: Source | None) -> tuple[Member, ...]:
    """Return the members of a source; none where it is nowhere yet."""
    if source is None:
        return ()
    return source.members if isinstance(source, SourceSet) else (source,)


def points_of(source: Source | None) -> tuple[Member, ...]:
    """Return the members that are points, in the order of `Pieces.points`: vertices first, then places in faces."""
    members = members_of(source)
    vertices = [each for each in members if not isinstance(each, SurfacePoint | BoundaryLoop | Curve)]
    return (*vertices, *(each for each in members if isinstance(each, SurfacePoint)))


def source_from(members: Sequence[Member]) -> Source:
    """Return the source that consists of these, one or more."""
    whole = SourceSet(tuple(members))
    return whole.members[0] if len(whole.members) == 1 else whole


def with_member(document: Document, panel: int, more: Source) -> Document:
    """Return the source that a panel shows and one more, whose members join it; unchanged where it shows none."""
    name = source_name(document, panel)
    if not name:
        return document
    members = (*members_of(document.point(name).at), *members_of(more))
    return put_point(document, name, source_from(members), document.panel(panel).surface)


def without_member(document: Document, panel: int, member: Member) -> Document:
    """Return the source that a panel shows without one of its members; the last one stays."""
    name = source_name(document, panel)
    left = [each for each in members_of(document.point(name).at) if each != member] if name else []
    return put_point(document, name, source_from(left), document.panel(panel).surface) if left else document


def with_moved(document: Document, name: str, whole: Source | None, member: Member, to: Source) -> Document:
    """Return the point of a name is at `whole`, of which one member is now elsewhere."""
    members = [other for each in members_of(whole) for other in (members_of(to) if each == member else (each,))]
    return put_point(document, name, source_from(members), document.point(name).surface)
