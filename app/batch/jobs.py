"""A function for each kind of work, from a mesh to arrays and their metadata."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from bihdist_core import Laplacian, Signature, Surface, read_surface
from bihdist_core.analysis.neighbours import nearest
from bihdist_core.analysis.parcels import Parcels, checked_mask, parcel_means
from bihdist_core.analysis.signature_types import SignatureSpec, is_signature
from bihdist_core.analysis.upright import axis_of, guess_up
from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray
from bihdist_core.distances.accuracy import ErrorEstimate
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance import Distance
from bihdist_core.distances.distance_types import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.formats.mesh_names import mesh_format
from bihdist_core.formats.whole_numbers import ParcelLabels, read_labels, read_whole_numbers
from bihdist_core.laplacian import eigenpairs
from bihdist_core.sources.pieces import Pieces, pieces_of
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import short_words_of
from bihdist_core.surface import with_faces

from ..document.sources import ALL, FARTHEST
from ..session.chosen_sources import Chosen, chosen_sources
from ..session.repaired_surface import kept_ids, repaired
from .results import Array
from .work_order import KINDS, WorkOrder


@dataclass(frozen=True, eq=False)
class Computed:
    """Arrays by name, the result first, and their metadata in plain values."""

    arrays: Mapping[str, Array]
    metadata: dict[str, Any]


class BatchMesh:
    """A mesh with what is computed of it once: the surface, the factor, the distances, the sources."""

    def __init__(self, path: str, name: str, wanted: WorkOrder) -> None:
        self.name, self.wanted = name, wanted
        in_file = read_surface(path)
        surface, self.new_ids = repaired(in_file, wanted.repairs)
        self.surface: Surface = surface
        self._count, self._kept = in_file.n_vertices, kept_ids(self.new_ids, in_file.n_vertices)
        self.extension = mesh_format(path)
        self._sources: dict[str, list[Source]] = {}

    @cached_property
    def distances(self) -> Distances:
        """The distances on the scaled surface, whose factor all kinds of work share."""
        return Distances(Laplacian(self.scaled, self.wanted.areas, self.wanted.operator))

    @cached_property
    def scaled(self) -> Surface:
        """The surface of distances and eigenpairs."""
        if not self.wanted.normalise:
            return self.surface
        return replace(self.surface, vertices=self.surface.vertices * self.scale)

    @property
    def scale(self) -> float:
        """The factor of the vertices: 1, or the one that makes the area 1."""
        if not self.wanted.normalise:
            return 1.0
        return 1 / float(np.sqrt(with_faces(self.surface, "areas scaled to 1").face_areas.sum()))

    def distance(self, words: str) -> Distance:
        """Return the distance of these words, such as "diffusion(t=1/4)"; ParameterError for other words."""
        return self.distances.get(Spec.parse(words))

    def sources(self, words: str) -> list[Source]:
        """Return the sources of a distance, by which farthest points are chosen.

        Raises ParameterError or VertexError for what is not on this mesh.
        """
        # A mask that does not fit is refused whatever the rule.
        asked, surface, counts = self.wanted.sources, self.surface, self.counts
        by = words if asked.rule == FARTHEST else ""
        if by not in self._sources:
            among = None if self.mask is None else counts
            found = chosen_sources(asked, surface, lambda: self.distance(words), self.name, among, lambda: self.highest)
            self._sources[by] = found.sources
        return self._sources[by]

    @cached_property
    def mask(self) -> BoolArray | None:
        """The mask (n,) of the vertices that count, None for all; ParameterError if none does."""
        if not self.wanted.mask:
            return None
        file = self.wanted.file_for(self.wanted.mask, self.name)
        found = checked_mask(self.surface, self._of_vertices(read_whole_numbers(file, "mask", self._count)))
        if not found[self.surface.component_of_vertex >= 0].any():
            raise ParameterError(f"The mask in {file} leaves no vertex of {self.surface.name}.")
        return found

    @cached_property
    def counts(self) -> BoolArray:
        """The vertices (n,) of faces that are not masked, from which rules choose sources."""
        used = self.surface.component_of_vertex >= 0
        return used if self.mask is None else used & self.mask

    @cached_property
    def highest(self) -> int:
        """The usual source: the highest vertex on the largest component that counts."""
        component = self.surface.component_of_vertex
        ids = np.flatnonzero(self.counts & (component == component[self.counts].min()))
        return int(ids[np.argmax(self.surface.vertices[ids] @ axis_of(guess_up(self.surface, self.extension)))])

    @property
    def labels(self) -> IntArray:
        """The parcel (n,) of each vertex."""
        return self._of_vertices(self.labels_in_file.values)

    @cached_property
    def labels_in_file(self) -> ParcelLabels:
        """The labels as their file has them, with names."""
        return read_labels(self.wanted.file_for(self.wanted.labels, self.name), self._count)

    def _of_vertices(self, values: IntArray) -> IntArray:
        """Return values of the vertices that are left of those in the mesh's file; others as they are, to be
        refused."""
        return values[self._kept] if len(values) == self._count else values


# ---------------------------------------------------------------------- works
def fields(mesh: BatchMesh, words: str, begin: int = 0, end: int | None = None) -> Computed:
    """Compute the distance (n, k) of every vertex from the sources `begin` to `end`, or a signature (n, 1)."""
    if is_signature(words):
        return signature(mesh, words)
    columns = mesh.distance(words).from_sources(mesh.sources(words)[begin:end])
    if mesh.mask is not None:
        columns[~mesh.mask] = np.nan
    return fields_computed(mesh, words, _in(columns, mesh.wanted.dtype))


def signature(mesh: BatchMesh, words: str) -> Computed:
    """Compute a signature (n, 1) of the vertices."""
    spec = SignatureSpec.parse(words)
    found: Signature = spec.load()(mesh.distances.laplacian, **dict(spec.values))
    values = found.values if mesh.mask is None else np.where(mesh.mask, found.values, np.nan)
    metadata = _described(spec, found.label, found.unit, ErrorEstimate.of(found.accuracy))
    return Computed({"fields": _in(values[:, None], mesh.wanted.dtype)}, metadata)


def fields_computed(mesh: BatchMesh, words: str, columns: Array) -> Computed:
    """Describe the distances (n, k) of every vertex from the sources."""
    return Computed({"fields": columns}, _sources_metadata(mesh, words))


def pairs(mesh: BatchMesh, words: str) -> Computed:
    """Compute the distances (k, k) among the sources, or their means (p, p) between parcels."""
    distance = mesh.distance(words)
    if mesh.wanted.labels:
        return parcels_computed(mesh, words, parcel_means(distance, mesh.labels, mesh.mask))
    return pairs_computed(mesh, words, _in(distance.pairwise(mesh.sources(words)), mesh.wanted.dtype))


def pairs_computed(mesh: BatchMesh, words: str, among: Array) -> Computed:
    """Describe distances among sources, with the root of the area, by which benchmarks divide."""
    area = float(np.sqrt(mesh.scaled.face_areas.sum()))
    arrays: dict[str, Array] = {"dist": among}
    if mesh.wanted.arrays in ("npz", "mat"):
        arrays["sqrt_area"] = np.array(area)
    return Computed(arrays, {**_sources_metadata(mesh, words), "sqrt_area": area})


def neighbours(mesh: BatchMesh, words: str, begin: int = 0, end: int | None = None) -> Computed:
    """Compute the vertices (s, k) nearest to each source, nearest first, and their distances."""
    sources = Chosen(mesh.sources(words)).vertices("Neighbours")[begin:end]
    return neighbours_computed(mesh, words, *nearest(mesh.distance(words), sources, mesh.wanted.nearest, mesh.mask))


def neighbours_computed(mesh: BatchMesh, words: str, indices: IntArray, values: FloatArray) -> Computed:
    """Describe nearest vertices (m, k) and their distances (m, k)."""
    metadata = {"indices": "-1 where there is none", "order": "nearest first, equal ones by number"}
    arrays = {"indices": indices, "distances": _in(values, mesh.wanted.dtype)}
    return Computed(arrays, {**_sources_metadata(mesh, words), **metadata})


def parcels_computed(mesh: BatchMesh, words: str, found: Parcels) -> Computed:
    """Describe the mean distances (m, m) between parcels by their labels, names and sizes."""
    metadata = {**_distance_metadata(mesh.distance(words)), "labels": found.labels.tolist()}
    names = [mesh.labels_in_file.names.get(label, "") for label in found.labels.tolist()]
    metadata |= {"names": names} if any(names) else {}
    metadata |= {"counts": found.counts.tolist(), "means": "of the distances of all pairs of vertices"}
    return Computed({"means": _in(found.distances, mesh.wanted.dtype)}, metadata)


def eigen(mesh: BatchMesh, words: str = "") -> Computed:
    """Compute eigenvalues (k,), eigenvectors (n, k) orthonormal by area, and areas (n,)."""
    laplacian = mesh.distances.laplacian
    most = sum(component.most_eigenpairs for component in laplacian.components)
    found = eigenpairs(laplacian, min(mesh.wanted.eigenpairs, most))
    vectors = _in(found.eigenvectors, mesh.wanted.dtype)
    arrays = {"eigenvalues": found.eigenvalues, "eigenvectors": vectors, "areas": laplacian.areas}
    metadata = {
        "parameters": {"eigenpairs": len(found.eigenvalues)},
        "unit": "eigenvalues: 1 / mesh units^2",
        "normalisation": "sum of areas times eigenvector squared is 1",
    }
    return Computed(arrays, metadata)


def fps(mesh: BatchMesh, words: str) -> Computed:
    """Compute vertices (k,), each the farthest from those before it, the highest first."""
    found = np.array(mesh.sources(words))
    return Computed({"vertices": found}, _distance_metadata(mesh.distance(words)))


WORK: dict[str, Callable[..., Computed]] = {
    kind.word: globals()[kind.function] for kind in KINDS.values() if kind.function
}


def _sources_metadata(mesh: BatchMesh, words: str) -> dict[str, Any]:
    """Describe a distance, with its unit and accuracy, and the sources."""
    distance, sources = mesh.distance(words), mesh.sources(words)
    named = [each if isinstance(each, int) else short_words_of(each) for each in sources]
    are_vertices = named == sources
    pieces = [] if are_vertices else [pieces_of(each, distance.surface) for each in sources]
    is_all = mesh.wanted.sources.rule == ALL and len(sources) == len(distance.surface.vertices)
    return {**_distance_metadata(distance, pieces), "sources": "all" if is_all else named}


def _distance_metadata(distance: Distance, pieces: Sequence[Pieces] = ()) -> dict[str, Any]:
    spec = Spec.parse(distance.identity)
    return _described(spec, distance.label, distance.unit, distance.error_estimate(pieces=pieces))


def _described(spec: Spec, label: str, unit: str, error_estimate: ErrorEstimate) -> dict[str, Any]:
    return {
        "distance": spec.canonical,
        "parameters": dict(spec.values),
        "label": label,
        "unit": unit,
        "normalisation": "none",
        "accuracy": error_estimate.share,
        "accuracy_text": error_estimate.text,
        "accuracy_sources": error_estimate.sources,
    }


def _in(array: AnyArray, dtype: str) -> AnyArray:
    return np.ascontiguousarray(array, dtype=dtype)
