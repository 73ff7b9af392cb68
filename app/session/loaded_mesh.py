"""Surfaces that have been opened: read, checked against what was asked for, with their operators and distances."""

import hashlib
import os
import threading
import weakref
from collections.abc import Collection, Iterable
from dataclasses import replace
from functools import cached_property
from typing import Any, Protocol, TypeVar

import numpy as np

from bihdist_core import Laplacian, ParameterError, Surface
from bihdist_core.analysis.first_view import FirstLook, first_look
from bihdist_core.analysis.upright import guess_up
from bihdist_core.applications.changes import Perturbation
from bihdist_core.applications.perturbation import perturbed
from bihdist_core.arrays import IntArray
from bihdist_core.distances.answers import Answer, Distances
from bihdist_core.distances.distance_types import Spec
from bihdist_core.formats.mesh_io import mesh_content, read_surface, surface_in
from bihdist_core.formats.mesh_names import files_of, is_there, mesh_format
from bihdist_core.progress import Progress
from bihdist_core.sources.source import Source
from bihdist_core.tetrahedra import boundary_of

from ..document.camera import View
from ..document.document import Document, FieldArray, MeshFile, starting_points
from ..document.edits import put_point
from ..document.file import checksum
from ..samples import mesh_path
from .array_store import ArrayStore
from .derived_surfaces import map_to_derived
from .hemispheres import Hemispheres
from .questions import Question, source_at
from .repaired_surface import repaired

REMEMBERED = 8
"""Answers that a surface keeps itself."""


class Memory(Protocol):
    """The memory of a surface that questions of one kind have, for any thread."""

    def keep(self, areas: str, wanted: set[Spec]) -> None:
        """Forget what was found with other areas, or is of no use for these distances."""


MemoryKind = TypeVar("MemoryKind", bound=Memory)


class LoadedMesh:
    """A surface that has been read or made, with what is known of it.

    Attributes
    ----------
    prepared
        What the view has made of it.
    origin
        The surface that it is made from, if it is made from another.
    ids
        The vertices (n,) of the origin that its own are, -1 for new ones.
    new_ids
        The id here of each vertex of the file; None where all keep theirs.
    """

    def __init__(
        self,
        mesh: MeshFile,
        surface: Surface,
        given: ArrayStore | None = None,
        origin: "LoadedMesh | None" = None,
        ids: IntArray | None = None,
        new_ids: IntArray | None = None,
    ) -> None:
        self.origin = origin
        self.new_ids = new_ids
        self.ids = np.arange(len(surface.vertices)) if ids is None else ids
        self.mesh = mesh
        self.surface = boundary_of(surface)
        self._measured = surface
        self.prepared: Any = None
        self._given = given or ArrayStore()
        self._looks: dict[str, FirstLook] = {}
        self._distances: dict[str, Distances] = {}
        self._memories: dict[type, Any] = {}
        self._last: dict[Question, Answer] = {}
        self._shown_with: tuple[weakref.ref[LoadedMesh], ...] = ()
        self._lock = threading.Lock()

    @property
    def is_solid(self) -> bool:
        """Whether distances run through tetrahedra, of which the surface is the boundary."""
        return self._measured is not self.surface

    def is_of(self, mesh: MeshFile) -> bool:
        """Return whether this is the surface of a mesh."""
        return is_same(mesh, self.mesh)

    @cached_property
    def has_faces_of_origin(self) -> bool:
        """Return whether it differs from what it is made from in the places of its vertices alone."""
        return self.origin is not None and np.array_equal(self.surface.faces, self.origin.surface.faces)

    @cached_property
    def up(self) -> str:
        """The axis that points up, unless whoever opened it put it here: `guessed_up`."""
        return self.guessed_up()

    def guessed_up(self, progress: Progress | None = None) -> str:
        """Return the axis that points up: guessed, or that of what it is made from."""
        if self.origin is not None:
            return self.origin.up
        return guess_up(self.surface, mesh_format(self.mesh.path and mesh_path(self.mesh.path)), progress)

    def first_look(self, up: str) -> FirstLook:
        """Return the first view with an axis up, and where a field starts; what is made from it is seen alike."""
        if up not in self._looks:
            look = first_look(self.surface, up)
            self._looks[up] = look if self.origin is None else replace(look, view=self.origin.first_look(up).view)
        return self._looks[up]

    def view_of(self, view: View, up: str) -> View:
        """Return the view, or that which "auto" stands for with an axis up; a lateral view is of a hemisphere.

        ParameterError where the hemisphere is not known.
        """
        if view in ("lateral", "medial"):
            return f"{view}-{self.memory(Hemispheres).side(self)}"
        return self.first_look(up).view if view == "auto" else view

    def distances(self, areas: str) -> Distances:
        """Return all distances on it with these vertex areas, each built once for whoever asks."""
        with self._lock:
            if areas not in self._distances:
                self._distances[areas] = Distances(Laplacian(self._measured, areas, self.mesh.repairs.operator))
            return self._distances[areas]

    def set_shown_with(self, others: Iterable["LoadedMesh"]) -> None:
        """Set the surfaces that are shown with this one, which whoever shows them keeps."""
        self._shown_with = tuple(map(weakref.ref, others))

    def shown_with(self, mesh: MeshFile | None) -> "LoadedMesh | None":
        """Return a surface that is shown with this one, or itself; None if it is not there."""
        for each in (*(ref() for ref in self._shown_with), self):
            if mesh is not None and each is not None and is_same(mesh, each.mesh):
                return each
        return None

    def answer_once(self, question: Question, progress: Progress | None = None) -> Answer:
        """Return the answer to a question; the last few are kept, for fields that are compared again and again."""
        with self._lock:
            known = self._last.get(question)
        if known is None:
            known = question.answer(self, progress)
            with self._lock:
                if known.field is not None:
                    self._last[question] = known
                while len(self._last) > REMEMBERED:
                    del self._last[next(iter(self._last))]
        return known

    def own_field(self, field: FieldArray) -> Answer:
        """Return a field of the user's own."""
        return self._given.answer(field, self.surface)

    def memory(self, kind: type[MemoryKind]) -> MemoryKind:
        """Return the memory that questions of one kind have of this surface, empty at first."""
        with self._lock:
            found: MemoryKind = self._memories.setdefault(kind, kind())
            return found

    def resolve_points(self, document: Document) -> Document:
        """Return the document with this surface's checksum, and its points on it.

        Which way is up, and from where it is seen, are those of the first surface, where they were left to be chosen.

        VertexError or ParameterError for a point or an inset that is nowhere, and for a field that has not a value for
        each vertex.
        """
        mine = {mesh.name for mesh in document.surfaces if is_same(mesh, self.mesh)}
        if mine and self.origin is None:
            self.surface.check_vertices([inset.vertex for inset in document.insets])
        if document.surfaces and document.surfaces[0].name in mine:
            up = self._up_in(document, document.surfaces[0].name)
            document = replace(document, up=up, camera=self.view_of(document.camera, up))
        for field in document.fields:
            if field.surface in mine:
                self._given.checked_field(field, self.surface)
        views = []
        for each in document.second_views:
            up = self.up if each.up == "auto" else each.up
            is_mine = each.surface in mine
            views.append(replace(each, up=up, camera=self.view_of(each.camera, up)) if is_mine else each)
        document = replace(document, second_views=tuple(views))
        found, change = self.mesh.sha256, self.mesh.change
        meshes = (
            replace(m, sha256=found, change=change, repairs=self.mesh.repairs) if m.name in mine else m
            for m in document.surfaces
        )
        points = []
        for point in document.points:
            if point.image_of and point.surface in mine:
                original = document.point(point.image_of).at
                points.append(replace(point, at=self._image(original)) if original is not None else point)
                continue
            up = self._up_in(document, point.surface)
            if point.surface in mine and point.at is None:
                point = replace(point, at=self.first_look(up).source)
            elif point.surface in mine:
                source_at(point.at, self.surface)
            points.append(point)
        return replace(document, surfaces=tuple(meshes), points=tuple(points))

    def _image(self, at: Source) -> Source:
        return at if self.origin is None else map_to_derived(at, self)

    def _up_in(self, document: Document, name: str) -> str:
        up = document.up_of(name)
        return self.up if up == "auto" else up

    def keep(self, areas: str, wanted: Collection[Spec]) -> None:
        """Forget distances with other areas, of these what `Distances.keep` forgets, and what was made of them."""
        with self._lock:
            self._distances = {known: d for known, d in self._distances.items() if known == areas}
            memories = tuple(self._memories.values())
        for memory in memories:
            memory.keep(areas, {*wanted})
        if areas in self._distances:
            self._distances[areas].keep(wanted)


def is_same(asked: MeshFile, there: MeshFile) -> bool:
    """Return whether what is there will do for what is asked for."""
    if (asked.path, asked.sha256 or there.sha256) != (there.path, there.sha256):
        return False
    if not asked.repairs.is_same(there.repairs):
        return False
    if asked.change is None or there.change is None:
        return asked.change is there.change
    return replace(asked.change, pose_sha256=asked.change.pose_sha256 or there.change.pose_sha256) == there.change


def match_sources(document: Document, name: str, first: LoadedMesh, loaded: LoadedMesh) -> Document:
    """Put the sources of a second mesh, where nobody has put them, at the vertices of the first's sources.

    That is done for two poses of one shape, which have the same faces; others are left as they are.
    """
    (mesh, *_), points = document.surfaces, starting_points(document)
    open_ones = [point for point in points if point.surface == name and point.at is None]
    known = [point.at for point in points if point.surface == mesh.name and isinstance(point.at, int)]
    if name == mesh.name or not (open_ones and known) or not np.array_equal(first.surface.faces, loaded.surface.faces):
        return document
    if len(first.surface.vertices) == len(loaded.surface.vertices):
        for point, at in zip(open_ones, known, strict=False):
            document = put_point(document, point.name, at, name)
    return document


def open_mesh(
    mesh: MeshFile,
    given: ArrayStore | None = None,
    remedy: str = "",
    there: Collection[LoadedMesh] = (),
    progress: Progress | None = None,
) -> LoadedMesh:
    """Read a mesh's file, or take its arrays from those given.

    Parameters
    ----------
    mesh
        The mesh.
    given
        The surfaces and fields from Python.
    remedy
        A sentence on what to do where a file is not the one meant.
    there
        Surfaces that are open, for one that is made from another.
    progress
        Called with the progress of making it.

    Raises
    ------
    ParameterError
        If the file is missing, or has changed since the checksum was taken.
    MeshError
        If it is no mesh.
    """
    if mesh.change is not None:
        itself = replace(mesh, change=None)
        origin = next((each for each in there if is_same(itself, each.mesh)), None) or open_mesh(itself, given, remedy)
        if origin.is_solid:
            raise ParameterError(f"{origin.surface.name} has tetrahedra, and only a surface can be changed.")
        change, pose = _with_pose(mesh.change, remedy)
        made, ids = perturbed(origin.surface, change, progress, pose)
        return LoadedMesh(replace(origin.mesh, name=mesh.name, change=change), made, given, origin, ids)
    surface, found = _read(mesh, remedy) if mesh.path else ((given or ArrayStore()).surface(mesh), mesh.sha256)
    repairs = mesh.repairs
    if repairs.cut and not repairs.cut_sha256:
        repairs = replace(repairs, cut_sha256=checksum(repairs.cut))
    surface, new_ids = repaired(surface, repairs, remedy)
    return LoadedMesh(replace(mesh, sha256=found, repairs=repairs), surface, given, new_ids=new_ids)


def unmerged(mesh: MeshFile, given: ArrayStore) -> Surface:
    """Return the surface of a mesh before vertices are merged, with all components; the errors of `open_mesh`."""
    return open_mesh(replace(mesh, repairs=replace(mesh.repairs, merge=None, largest_component=False)), given).surface


def _read(mesh: MeshFile, remedy: str) -> tuple[Surface, str]:
    """Read the surface in a file, and the file's checksum."""
    path = checked_path(mesh, remedy)
    if len(files_of(path)) > 1:
        surface, found = read_surface(path), checksum(path)
    else:
        content = mesh_content(path)
        surface, found = surface_in(content, os.path.basename(path)), hashlib.sha256(content).hexdigest()
    if mesh.sha256 and found != mesh.sha256:
        sentence = f"The mesh {mesh.path} has changed since its checksum was recorded. {remedy}"
        raise ParameterError(sentence.strip())
    return surface, found


def _with_pose(change: Perturbation, remedy: str) -> tuple[Perturbation, Surface | None]:
    """Return a change with the checksum of its other pose, and that; None if there is none."""
    if not change.pose:
        return change, None
    pose, found = _read(MeshFile("", change.pose, change.pose_sha256), remedy)
    return replace(change, pose_sha256=found), pose


def checked_path(mesh: MeshFile, remedy: str = "") -> str:
    """Return the path of a mesh's file, empty for a surface in memory; ParameterError if it is missing."""
    path = mesh_path(mesh.path) if mesh.path else ""
    if path and not is_there(path):
        raise ParameterError(f"The mesh {mesh.path} is not there. {remedy}".strip())
    return path
