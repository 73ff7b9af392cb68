"""Surfaces that have been opened: read, checked against what was asked for, with their operators and distances."""

import hashlib
import os
import threading
from collections.abc import Callable, Collection
from dataclasses import replace
from typing import Any

import numpy as np

from bihdist_core import Laplacian, ParameterError, Surface, read_surface
from bihdist_core.distances.answers import Answer, Distances, difference_of
from bihdist_core.distances.kinds import Spec
from bihdist_core.progress import Progress, part

from ..document.document import Document, MeshFile
from ..document.file import checksum
from ..samples import mesh_path
from .questions import DifferenceQuestion, Question, vertex_at


class Opened:
    """A surface that is there.  prepared: what whoever shows it has made of it."""

    def __init__(self, mesh: MeshFile, surface: Surface, prepared: Any = None) -> None:
        self.mesh = mesh
        self.surface = surface
        self.prepared = prepared
        self._distances: dict[str, Distances] = {}
        self._lock = threading.Lock()

    def distances(self, areas: str) -> Distances:
        """All distances on it with these vertex areas, each built once for whoever asks."""
        with self._lock:
            if areas not in self._distances:
                self._distances[areas] = Distances(Laplacian(self.surface, areas))
            return self._distances[areas]

    def answer(
        self,
        question: Question,
        progress: Progress | None = None,
        at_once: Callable[[Answer], None] | None = None,
    ) -> Answer:
        """See `Distances.answer`."""
        if isinstance(question, DifferenceQuestion):
            first = self.answer(question.minuend, part(progress, 0, 0.5))
            second = self.answer(question.subtrahend, part(progress, 0.5, 1))
            return difference_of(first, second, question.raw)
        vertex = vertex_at(question.at, self.surface)
        return self.distances(question.areas).answer(question.spec, vertex, progress, at_once)

    def settled(self, document: Document) -> Document:
        """The document with this surface's checksum, and its points where there is a vertex.

        VertexError or ParameterError for a point that is nowhere.
        """
        mine = {mesh.name for mesh in document.surfaces if is_same(mesh, self.mesh)}
        meshes = (replace(m, sha256=self.mesh.sha256) if m.name in mine else m for m in document.surfaces)
        points = []
        for point in document.points:
            vertex = vertex_at(point.at, self.surface) if point.surface in mine else None
            points.append(replace(point, at=vertex) if point.at is None else point)
        return replace(document, surfaces=tuple(meshes), points=tuple(points))

    def keep(self, areas: str, wanted: Collection[Spec]) -> None:
        """Forget distances with other areas, and of these what `Distances.keep` forgets."""
        with self._lock:
            self._distances = {known: d for known, d in self._distances.items() if known == areas}
        if areas in self._distances:
            self._distances[areas].keep(wanted)


def is_same(asked: MeshFile, there: MeshFile) -> bool:
    """Whether what is there will do for what is asked for."""
    return asked.path == there.path and asked.sha256 in ("", there.sha256)


def open_mesh(mesh: MeshFile, remedy: str = "") -> Opened:
    """Read the file.  remedy: a sentence about what to do where it is not the one that is meant.

    Raises ParameterError if it is missing, or has changed since the checksum was taken; MeshError if it is no mesh.
    """
    path = mesh_path(mesh.path)
    if not mesh.path or not os.path.exists(path):
        name = mesh.path if len(mesh.path) <= 200 else f"{mesh.path[:100]}..."
        raise ParameterError(f"The mesh {name} is not there. {remedy}".strip())
    surface, found = read_surface(path), checksum(path)
    if mesh.sha256 and found != mesh.sha256:
        said = f"The mesh {mesh.path} is not what it was when it was written down (its checksum differs). {remedy}"
        raise ParameterError(said.strip())
    return Opened(replace(mesh, sha256=found), surface)


def in_memory(surface: Surface, name: str = "A") -> Opened:
    """A surface that comes from no file."""
    digest = hashlib.sha256()
    for array in (surface.vertices, surface.faces):
        digest.update(np.ascontiguousarray(array).tobytes())
    return Opened(MeshFile(name, "", digest.hexdigest()), surface)
