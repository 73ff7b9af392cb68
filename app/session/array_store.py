"""Surfaces and fields from Python instead of files, and fields of files, by the checksums that documents name them by.

Those from Python are saved as an .npz archive of plain arrays: `surface/A/vertices`, `surface/A/faces` and
`surface/A/name` of a surface A, and `field/height` of a field.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from bihdist_core import ParameterError, PointCloud, Surface, TetrahedralMesh
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.distances.answers import Answer, given_answer
from bihdist_core.file_content import open_regular
from bihdist_core.formats.array_file import archived_array, opened_archive
from bihdist_core.mesh_like import MeshLike
from bihdist_core.sources.source import Source, checked_source

from ..document.document import Document, FieldArray, MeshFile, comparison, usual_specs
from ..document.page import Recipe
from ..document.quantities import Quantity, quantity
from ..document.second_mesh_edits import open_second_mesh

if TYPE_CHECKING:
    from bihdist_core.formats.vertex_arrays import VertexArray

Mesh = MeshLike
"""A file or the name of a sample, or what else `Surface.of` takes."""
Values = npt.ArrayLike | os.PathLike[str]
"""Numbers (n,) at the vertices, or a file of them: FILE, or FILE:ARRAY where it has several."""


class ArrayStore:
    """See the module.  Whoever has been given something may ask for it on any thread.

    What has been given stays: the history may come back to it.
    """

    def __init__(self) -> None:
        self._surfaces: dict[str, Surface] = {}
        self._fields: dict[str, FloatArray] = {}
        self._labels: dict[str, VertexArray] = {}

    def add_surface(self, surface: Surface, name: str = "A") -> MeshFile:
        """Keep a surface; what a document calls it."""
        digest = _checksum(surface.vertices, _corners(surface))
        self._surfaces[digest] = surface
        return MeshFile(name, "", digest)

    def add_field(self, name: str, values: Values, surface: str = "A") -> FieldArray:
        """Keep a field (n,) of real numbers, NaN where undefined, or of a file; what a document calls it.

        ParameterError for anything else, and for a name that is none.
        """
        if isinstance(values, str | os.PathLike):
            from bihdist_core.formats.vertex_arrays import split_array

            return self.add_file(FieldArray(name, "", surface, *split_array(os.fspath(values))))
        try:
            numbers = np.asarray(
                np.ma.filled(np.ma.asarray(values, np.float64), np.nan) if np.ma.isMA(values) else values
            )
            if numbers.dtype.kind not in "biufO":
                raise TypeError
            numbers = numbers.astype(np.float64)
        except (TypeError, ValueError):
            raise ParameterError(f"The field {name!r} is not an array of real numbers.") from None
        if numbers.ndim != 1:
            raise ParameterError(
                f"The field {name!r} has the shape {numbers.shape}; it needs one value for each vertex."
            )
        if np.isinf(numbers).any():
            vertex = int(np.flatnonzero(np.isinf(numbers))[0])
            raise ParameterError(
                f"The field {name!r} is {numbers[vertex]} at vertex {vertex}; use NaN where it is undefined."
            )
        numbers.flags.writeable = False
        field = FieldArray(name, _checksum(numbers), surface)
        self._fields[field.sha256] = numbers
        return field

    def add_file(self, field: FieldArray) -> FieldArray:
        """Keep a field of a file, and return it with its checksum; ParameterError if it is not as its checksum says."""
        from bihdist_core.formats.vertex_arrays import read_vertex_array  # with the readers of all formats

        return self.add_array(field, read_vertex_array(field.path, field.array))

    def add_array(self, field: FieldArray, found: VertexArray) -> FieldArray:
        """Keep a field that has been read from its file; see `add_file`."""
        digest = self.add_field(field.name, found.values, field.surface).sha256
        if found.names:
            labels = hashlib.sha256(f"{digest} {found.names}".encode()).hexdigest()
            self._fields[labels], self._labels[labels], digest = self._fields[digest], found, labels
        if field.sha256 not in ("", digest):
            raise _changed(field.path, field.name)
        return replace(field, sha256=digest)

    def surface(self, mesh: MeshFile) -> Surface:
        """Return the surface a document means; ParameterError if it was never given."""
        if mesh.sha256 not in self._surfaces:
            raise ParameterError(f"The surface {mesh.name!r} was given from Python, and is no longer available.")
        return self._surfaces[mesh.sha256]

    def field(self, sha256: str, name: str) -> FloatArray:
        """Return the values (n,) of a field; ParameterError if they were never given."""
        if sha256 not in self._fields:
            raise ParameterError(f"The field {name!r} was given from Python, and is no longer available.")
        return self._fields[sha256]

    def answer(self, field: FieldArray, surface: Surface) -> Answer:
        """Return a field on its surface; ParameterError unless it has a value for each vertex."""
        values = self.checked_field(field, surface)
        return given_answer(field.name, values, surface.faces, self._labels.get(field.sha256))

    def checked_field(self, field: FieldArray, surface: Surface) -> FloatArray:
        """Return the values (n,) of a field; ParameterError unless there is one for each vertex of the surface."""
        values = self.field(field.sha256, field.name)
        if len(values) != len(surface.vertices):
            raise ParameterError(
                f"The field {field.name!r} has {len(values):,} values, and {surface.name} has "
                f"{len(surface.vertices):,} vertices."
            )
        return values

    def update(self, other: ArrayStore) -> None:
        """Keep what another keeps."""
        self._surfaces.update(other._surfaces)
        self._fields.update(other._fields)
        self._labels.update(other._labels)

    # ------------------------------------------------------------------ files
    def arrays(self, document: Document) -> dict[str, AnyArray]:
        """Return the arrays that a document needs, by their names in an archive."""
        arrays: dict[str, AnyArray] = {}
        for mesh in document.surfaces:
            if not mesh.path and mesh.change is None:
                surface, at = self.surface(mesh), f"surface/{mesh.name}"
                arrays |= {f"{at}/vertices": surface.vertices, f"{at}/faces": _corners(surface)}
                arrays[f"{at}/name"] = np.array(surface.name)
        given = (field for field in document.fields if not field.path)
        return arrays | {f"field/{field.name}": self.field(field.sha256, field.name) for field in given}

    @classmethod
    def read(cls, recipe: Recipe) -> ArrayStore:
        """Read the arrays that the document of a recipe needs, from the recipe's archive and from files of fields.

        Raises ParameterError if one is missing, is none, lacks something, or holds something else.
        """
        given, document, path = cls(), recipe.document, recipe.arrays
        for field in document.fields:
            if field.path:
                given.add_file(field)
        if not holds_arrays(document):
            return given
        if not os.path.isfile(path):
            raise ParameterError(f"The arrays given from Python are missing: {path or 'no archive is named'}.")
        with open_regular(path, "archive") as file, opened_archive(file, path) as archive:
            for mesh in document.surfaces:
                if not mesh.path and mesh.change is None:
                    at = f"surface/{mesh.name}"
                    vertices, faces, name = (archived_array(archive, f"{at}/{part}", path) for part in PARTS)
                    _check(given.add_surface(_made(vertices, faces, str(name))), mesh, path)
            for field in document.fields:
                if not field.path:
                    _check(
                        given.add_field(field.name, archived_array(archive, f"field/{field.name}", path)), field, path
                    )
        return given


PARTS = ("vertices", "faces", "name")


def holds_arrays(document: Document) -> bool:
    """Return whether a document names anything that stands in no file of its own."""
    return not all(field.path for field in document.fields) or not all(mesh.path for mesh in document.surfaces)


def is_archive(path: str | os.PathLike[str]) -> bool:
    """Return whether a file holds arrays that were given: whether it may be replaced by such a one."""
    try:
        with open_regular(path, "archive") as file, opened_archive(file, path) as archive:
            return all(name.startswith(("surface/", "field/")) for name in archive.namelist())
    except ParameterError:
        return False


def comparison_of_arrays(
    mesh: Mesh,
    distances: Sequence[str | Quantity] | None,
    fields: Mapping[str, Values],
    sources: tuple[Source | str | None, ...],
    areas: str = "voronoi",
) -> tuple[Document, ArrayStore]:
    """Return a mesh with a panel for each distance from each source, and one for each field that none of them names.

    None stands for the usual distances.
    """
    if isinstance(distances, str):
        raise ParameterError(f"Distances are given as a list, such as [{distances!r}], not a text.")
    if not isinstance(fields, Mapping):
        raise ParameterError(f"The fields are given by name, as a dict of arrays, not as {type(fields).__name__}.")
    given = ArrayStore()
    entry = _entry(mesh, given)
    own = tuple(given.add_field(name, values) for name, values in fields.items())
    has_faces = bool(entry.path) or len(given.surface(entry).faces) > 0
    usual = usual_specs(entry.path, has_faces)
    shows = usual if distances is None else tuple(_quantity(each, fields) for each in distances)
    return replace(comparison(entry.path, shows, sources, areas, own), surfaces=(entry,)), given


def with_second_mesh(document: Document, given: ArrayStore, mesh: Mesh, at: Source | str | None = None) -> Document:
    """Return a document with a second mesh, whose distances start `at` a source, kept as the first one is."""
    return open_second_mesh(document, _entry(mesh, given), None if at is None else checked_source(at))


def _entry(mesh: Mesh, given: ArrayStore) -> MeshFile:
    return MeshFile("A", str(mesh)) if isinstance(mesh, str | os.PathLike) else given.add_surface(Surface.of(mesh))


def _quantity(shows: Any, fields: Collection[str]) -> Quantity:
    if isinstance(shows, str):
        return quantity(shows, fields=fields)
    if not isinstance(shows, Quantity):
        raise ParameterError(f"{shows!r} is not a distance; write it in words, such as 'diffusion(t=1/4)'.")
    return shows


def _corners(surface: Surface) -> IntArray:
    """Return the faces (m, 3) of a surface, or the tetrahedra (m, 4) of a solid."""
    return surface.tetrahedra if isinstance(surface, TetrahedralMesh) else surface.faces


def _made(vertices: AnyArray, corners: AnyArray, name: str) -> Surface:
    """Return what has these corners: points if there are none."""
    if not len(corners):
        return PointCloud(vertices, name)
    return TetrahedralMesh(vertices, corners, name) if corners.shape[1] == 4 else Surface(vertices, corners, name)


def _checksum(*arrays: AnyArray) -> str:
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def _check(found: MeshFile | FieldArray, wanted: MeshFile | FieldArray, path: str | os.PathLike[str]) -> None:
    if found.sha256 != wanted.sha256:
        raise _changed(path, wanted.name)


def _changed(path: str | os.PathLike[str], name: str) -> ParameterError:
    return ParameterError(f"{path}: {name!r} has changed since its checksum was recorded.")
