"""Repairs that are made to the surface in a file before anything is measured on it."""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bihdist_core.errors import ParameterError
from bihdist_core.formats.mesh_names import mesh_name

if TYPE_CHECKING:
    from .document import Document, MeshFile

OPERATORS = {
    "cotan": "Cotangents of the faces",
    "intrinsic-delaunay": "Intrinsic Delaunay",
    "tufted": "Tufted cover",
}
"""The operators that a mesh can have, with their names in menus; the first is the paper's."""

NAME = "{name}"
"""In a path it stands for the name of each mesh."""


@dataclass(frozen=True)
class Repairs:
    """The repairs that are made to a mesh when it is read.

    Attributes
    ----------
    cut
        A file with 1 for each vertex that stays and 0 for each that is cut out, in the order of the mesh's file; "" for
        none.
    cut_sha256
        The checksum of that file's bytes; empty as long as any content will do.
    merge
        The distance, in mesh units, up to which vertices become one, after the cut; None for no merging.
    largest_component
        Whether only the connected component with most vertices is kept, after cut and merge.
    operator
        One of OPERATORS, for faces that are too thin for the paper's, or edges of more than two.
    """

    cut: str = ""
    cut_sha256: str = ""
    merge: float | None = None
    largest_component: bool = False
    operator: str = "cotan"

    def __post_init__(self) -> None:
        if self.merge is not None and not (math.isfinite(self.merge) and self.merge >= 0):
            raise ParameterError(f"Vertices are merged within a length, 0 or more, not {self.merge:g}.")
        if self.operator not in OPERATORS:
            raise ParameterError(f"There is no operator {self.operator!r}; choose one of {', '.join(OPERATORS)}.")

    def of(self, mesh: str) -> "Repairs":
        """These of the mesh at a path, whose name stands for {name}."""
        return replace(self, cut=self.cut.replace(NAME, mesh_name(mesh)))

    @property
    def is_any(self) -> bool:
        """Return whether anything is done."""
        return self != NO_REPAIRS

    def is_same(self, there: "Repairs") -> bool:
        """Return whether what has been made by others will do."""
        return replace(self, cut_sha256=self.cut_sha256 or there.cut_sha256) == there


NO_REPAIRS = Repairs()


def with_repairs(document: "Document", surface: str = "", **changes: Any) -> "Document":
    """Return the document with other repairs of its meshes, or of one of them with what is made from it.

    `changes` are fields of `Repairs`; others stay as they are. ParameterError where two meshes would have one mask.
    """
    meant = _of_the_file(document, surface) if surface else document.surfaces
    if surface and "operator" in changes:
        # One mesh by two operators is two meshes.
        meant = tuple(mesh for mesh in meant if mesh.name == surface or mesh.change is not None)
    cut = changes.get("cut")
    if cut is not None:
        changes["cut_sha256"] = ""
    if cut and NAME not in cut and len({mesh.path for mesh in meant}) > 1:
        raise ParameterError(f"{cut} would cut two meshes; write {NAME} in the path for the name of each.")
    meshes = (
        replace(mesh, repairs=replace(mesh.repairs, **changes).of(mesh.path)) if mesh in meant else mesh
        for mesh in document.surfaces
    )
    return replace(document, surfaces=tuple(meshes))


def without_repairs(document: "Document", surface: str) -> "Document":
    """Return the document with a mesh as it is in its file, and what is made from it made from that."""
    meant = _of_the_file(document, surface)
    meshes = (replace(mesh, repairs=NO_REPAIRS) if mesh in meant else mesh for mesh in document.surfaces)
    return replace(document, surfaces=tuple(meshes))


def _of_the_file(document: "Document", surface: str) -> "tuple[MeshFile, ...]":
    """Return a mesh with what is made from it."""
    shown = document.mesh(surface)
    return tuple(m for m in document.surfaces if (m.path, m.sha256) == (shown.path, shown.sha256))
