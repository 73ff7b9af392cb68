"""Surfaces that are made from others: where points of these are on them, and what is asked of them ahead."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core import ParameterError
from bihdist_core.applications.perturbation import image_of
from bihdist_core.distances.answers import Answer
from bihdist_core.progress import Progress, part
from bihdist_core.sources.source import Source, SourceSet

from ..document.document import Document
from ..document.source_edits import members_of
from .questions import Question, questions, source_at, vertex_at

if TYPE_CHECKING:
    from .loaded_mesh import LoadedMesh


def map_to_derived(at: Source, loaded: "LoadedMesh") -> Source:
    """Map a place of the surface that another is made from to that: its vertices, or the nearest that are left.

    ParameterError for what is not of vertices, VertexError for one that is not there.
    """
    assert loaded.origin is not None
    if loaded.has_faces_of_origin:
        source_at(at, loaded.surface)
        return at
    images: dict[int, None] = {}
    for member in members_of(at):
        if not isinstance(member, int):
            raise ParameterError("Only vertices carry over to a mesh with other faces, not places in faces or curves.")
        images[image_of(loaded.origin.surface, loaded.ids, member, loaded.surface)] = None
    found = tuple(images)
    return found[0] if len(found) == 1 else SourceSet(found)


def counterpart(vertex: int | None, here: "LoadedMesh | None", there: "LoadedMesh | None") -> int | None:
    """Return a vertex's counterpart on another surface, where one is made from the other; None if there is none."""
    if vertex is None or here is None or there is None:
        return None
    if there.origin is here:
        found = np.flatnonzero(there.ids == vertex)
        return int(found[0]) if len(found) else None
    if here.origin is there and here.ids[vertex] >= 0:
        return int(here.ids[vertex])
    return None


def propagate_source(document: Document, before: Document, loaded: "LoadedMesh") -> Document:
    """Move the original of a point that was moved on a changed surface, so that the point follows.

    Onto what is new there it does not move at all.
    """
    were = {point.name: point for point in before.points}
    for point in document.points:
        was, original = were.get(point.name), were.get(point.image_of)
        is_here = point.surface == loaded.mesh.name and point.image_of
        if not is_here or was is None or original not in document.points or point.at in (None, was.at):
            continue
        at: Source | None = point.at
        if not loaded.has_faces_of_origin:
            vertices = [vertex_at(member, loaded.surface) for member in members_of(point.at)]
            old = tuple(dict.fromkeys(int(loaded.ids[vertex]) for vertex in vertices if loaded.ids[vertex] >= 0))
            at = None if not old else old[0] if len(old) == 1 else SourceSet(old)
        if at is not None:
            points = (replace(p, at=at) if p.name == point.image_of else p for p in document.points)
            document = replace(document, points=tuple(points))
    return document


def answers_ahead(
    document: Document, found: Sequence["LoadedMesh"], there: Sequence["LoadedMesh"], progress: Progress
) -> Iterator[tuple[Question, Answer]]:
    """Answer what a document asks of surfaces that are not shown yet, so that none is ever seen without its fields.

    `found` holds these surfaces, `there` those that are shown.
    """
    by_name = {}
    for mesh in document.surfaces:
        matching = [loaded for loaded in (*found, *there) if loaded.is_of(mesh)]
        if matching:
            by_name[mesh.name] = matching[0]
            document = matching[0].resolve_points(document)
    surfaces = {panel.id: by_name.get(panel.surface) for panel in document.panels}
    asked = [(question, surfaces[id]) for id, question in questions(document).items()]
    new = [(question, loaded) for question, loaded in asked if loaded is not None and loaded in found]
    for k, (question, loaded) in enumerate(new):
        yield question, loaded.answer_once(question, part(progress, k / len(new), (k + 1) / len(new)))
