"""From a document to its questions: for each panel all that its answer depends on, and nothing else."""

from dataclasses import dataclass

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.distances.kinds import Spec

from ..document.document import Document, MeshFile, Place


@dataclass(frozen=True)
class Question:
    """The distance of every vertex from a place; equal questions have equal answers.

    mesh: the surface, by path and checksum; areas: of its operators.
    """

    mesh: MeshFile
    areas: str
    spec: Spec
    at: int | Place | None

    def is_about_the_same(self, other: "Question") -> bool:
        """Whether the other asks for the same distance, perhaps from elsewhere."""
        return (self.mesh, self.areas, self.spec) == (other.mesh, other.areas, other.spec)


def questions(document: Document) -> dict[int, Question]:
    """The question of each panel, by the panel's id."""
    return {
        panel.id: Question(
            document.mesh(panel.surface), document.areas, panel.shows.spec, document.point(panel.shows.point).at
        )
        for panel in document.panels
    }


def vertex_at(at: int | Place | None, surface: Surface) -> int:
    """The vertex a point stands for: itself, the nearest corner by weight, or the first source.

    VertexError if there is none, or it belongs to no face; ParameterError for a face that does not exist.
    """
    if at is None:
        return first_source(surface)
    if isinstance(at, Place):
        if at.face >= len(surface.faces):
            raise ParameterError(f"{surface.name} has no face {at.face}; it has {len(surface.faces)}.")
        return surface.check_vertex(int(surface.faces[at.face][int(np.argmax(at.weights))]))
    return surface.check_vertex(at)


def first_source(surface: Surface) -> int:
    """Where to start: the highest vertex (along y) of the largest component."""
    ids = np.flatnonzero(surface.component_of_vertex == 0)
    return int(ids[surface.vertices[ids, 1].argmax()])
