"""New places of what a document names once vertices of its surface have been merged or cut out."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import IntArray
from bihdist_core.sources.source import BoundaryLoop, Curve, Member, Source, SurfacePoint

from ..document.document import Document, MeshFile, starting_points
from ..document.removal import without_points
from ..document.source_edits import members_of, source_from
from .loaded_mesh import LoadedMesh
from .repaired_surface import kept_ids

FindMesh = Callable[[MeshFile], LoadedMesh | None]


def remap_vertices(document: Document, before: Document, find: FindMesh) -> Document:
    """Move all that names vertices of meshes with other repairs than before to where these vertices are now.

    `find` returns the surface of a mesh, None where it is not there. Sources that are gone start where a field does at
    first; pins, anchors and insets that are gone are left out.
    """
    for mesh in document.surfaces:
        was = next((each for each in before.surfaces if each.name == mesh.name), mesh)
        if mesh.change is None and was.path == mesh.path and was.repairs != mesh.repairs:
            old, new = find(was), find(mesh)
            if old is not None and new is not None:
                document = _remap_mesh(document, mesh.name, old, new)
    return document


def _remap_mesh(document: Document, name: str, old: LoadedMesh, new: LoadedMesh) -> Document:
    kept = kept_ids(old.new_ids, len(old.surface.vertices))
    vertices = kept if new.new_ids is None else new.new_ids[kept]
    sources = [point.at for point in document.points if point.surface == name and not point.image_of]
    moved = _VertexMap(old.surface, new.surface, vertices, sources)
    points = [
        replace(point, at=moved.source(point.at)) if point.surface == name and not point.image_of else point
        for point in document.points
    ]
    needed = {*document.isolines.through, *(point.name for point in starting_points(document))}
    were = {point.name for point in document.points if point.at is None}
    gone = {point.name for point in points if point.at is None} - needed - were
    parts = tuple(part.with_vertices(name, vertices) for part in document.parts)
    insets = document.insets
    if document.surfaces[0].name == name:
        there = [(inset, moved.member(inset.vertex)) for inset in insets]
        insets = tuple(replace(inset, vertex=vertex) for inset, vertex in there if isinstance(vertex, int))
    return without_points(replace(document, points=tuple(points), parts=parts, insets=insets), gone)


class _VertexMap:
    """Maps sources of a surface to another; `vertices` (n,) has the id there of each vertex here."""

    def __init__(self, old: Surface, new: Surface, vertices: IntArray, sources: Iterable[Source | None]) -> None:
        self._old, self._new, self._vertices = old, new, vertices
        members = [member for source in sources for member in members_of(source)]
        places = [place for member in members for place in _places_of(member)]
        corners = vertices[old.faces[[place.face for place in places if place.face < len(old.faces)]]].reshape(-1, 3)
        near = np.zeros(len(new.vertices), bool)
        near[corners] = True
        faces = np.flatnonzero(near[new.faces].all(axis=1))
        self._face_of = {frozenset(new.faces[face].tolist()): face for face in faces.tolist()}

    def source(self, source: Source | None) -> Source | None:
        """Return a source there, None where nothing of it is left."""
        left = [there for each in members_of(source) if (there := self.member(each)) is not None]
        return source_from(left) if left else None

    def member(self, member: Member) -> Member | None:
        """Return a part of a source there, None where it is gone."""
        if isinstance(member, SurfacePoint):
            return self._place(member)
        if isinstance(member, BoundaryLoop):
            return member if member.number < self._new.boundary_loop_count else None
        if isinstance(member, Curve):
            places = [place for each in member.places if isinstance(place := self._place(each), SurfacePoint)]
            return Curve(tuple(places), member.closed) if len(places) == len(member.places) else None
        there = int(self._vertices[member])
        return there if self._new.component_of_vertex[there] >= 0 else None

    def _place(self, place: SurfacePoint) -> SurfacePoint | int | None:
        """Return a place in the face with the same corners; the nearest corner where that has collapsed."""
        corners = self._vertices[self._old.faces[place.face]].tolist()
        weights = dict(zip(corners, place.weights, strict=True))
        if len(weights) < 3:
            return self.member(int(self._old.faces[place.face][int(np.argmax(place.weights))]))  # type: ignore[return-value]
        face = self._face_of.get(frozenset(corners))
        if face is None:
            return None
        first, second, third = (weights[corner] for corner in self._new.faces[face].tolist())
        return SurfacePoint(face, (first, second, third))


def _places_of(member: Member) -> tuple[SurfacePoint, ...]:
    if isinstance(member, Curve):
        return member.places
    return (member,) if isinstance(member, SurfacePoint) else ()
