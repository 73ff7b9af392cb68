"""What is done with one mesh: a function for each work, from the mesh to arrays and what is to be said of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from bihdist_core import Laplacian, Surface, read_surface
from bihdist_core.analysis.neighbours import nearest
from bihdist_core.analysis.parcels import Parcels, checked_mask, parcel_means
from bihdist_core.analysis.upright import axis_of, guess_up
from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.distance import Distance
from bihdist_core.distances.kinds import Spec
from bihdist_core.errors import ParameterError
from bihdist_core.formats.mesh_names import mesh_format
from bihdist_core.formats.parcel_labels import ParcelLabels, read_labels
from bihdist_core.formats.whole_numbers import read_whole_numbers
from bihdist_core.laplacian import eigenpairs
from bihdist_core.sources.source import Source
from bihdist_core.sources.words import short_words_of

from ..document.repairs import Repairs
from ..document.sources import FARTHEST
from ..session.chosen_sources import chosen_sources
from ..session.repaired_surface import kept_ids, repaired
from .results import Array
from .work_kinds import KINDS
from .work_order import WorkOrder


@dataclass(frozen=True, eq=False)
class Made:
    """arrays: by name, the result first; facts: what is to be said of them, in plain values."""

    arrays: Mapping[str, Array]
    facts: dict[str, Any]


class Mesh:
    """A mesh with what is computed of it once: the surface, the factor, the distances, the sources."""

    def __init__(self, path: str, name: str, wanted: WorkOrder) -> None:
        self.name, self.wanted = name, wanted
        repairs = Repairs(cut=wanted.file_for(wanted.cut, name), merge=wanted.merge)
        in_file = read_surface(path)
        surface, self.new_ids = repaired(in_file, repairs)
        self.surface: Surface = surface
        self._count, self._kept = in_file.n_vertices, kept_ids(self.new_ids, in_file.n_vertices)
        self.extension = mesh_format(path)
        self._sources: dict[str, list[Source]] = {}

    @cached_property
    def distances(self) -> Distances:
        """The distances on the scaled surface, whose factor all kinds of work share."""
        return Distances(Laplacian(self.scaled, self.wanted.areas))

    @cached_property
    def scaled(self) -> Surface:
        """The surface that distances and eigenpairs are those of."""
        if not self.wanted.normalise:
            return self.surface
        return replace(self.surface, vertices=self.surface.vertices * self.scale)

    @property
    def scale(self) -> float:
        """By what vertices are multiplied: 1, or what makes the area 1."""
        return 1 / float(np.sqrt(self.surface.face_areas.sum())) if self.wanted.normalise else 1.0

    def distance(self, words: str) -> Distance:
        """The distance of these words, such as "diffusion(t=1/4)"; ParameterError if there is none."""
        return self.distances.get(Spec.parse(words))

    def sources(self, words: str) -> list[Source]:
        """Where the fields of a distance start; the farthest points are those by it.

        ParameterError or VertexError for what is not on this mesh.
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
        """(n,) which vertices count, None for all; ParameterError if none does."""
        if not self.wanted.mask:
            return None
        file = self.wanted.file_for(self.wanted.mask, self.name)
        found = checked_mask(self.surface, self._of_vertices(read_whole_numbers(file, "mask", self._count)))
        if not found[self.surface.component_of_vertex >= 0].any():
            raise ParameterError(f"The mask in {file} leaves no vertex of {self.surface.name}.")
        return found

    @cached_property
    def counts(self) -> BoolArray:
        """(n,) the vertices of faces that are not masked: those that rules for sources choose from."""
        used = self.surface.component_of_vertex >= 0
        return used if self.mask is None else used & self.mask

    @cached_property
    def highest(self) -> int:
        """Where distances start where nothing is said: on the largest component that counts."""
        component = self.surface.component_of_vertex
        ids = np.flatnonzero(self.counts & (component == component[self.counts].min()))
        return int(ids[np.argmax(self.surface.vertices[ids] @ axis_of(guess_up(self.surface, self.extension)))])

    @cached_property
    def labels(self) -> IntArray:
        """(n,) the parcel of each vertex."""
        return self._of_vertices(self._labels.values)

    @property
    def label_names(self) -> Mapping[int, str]:
        """The names that the file of labels has for them."""
        return self._labels.names

    @cached_property
    def _labels(self) -> ParcelLabels:
        return read_labels(self.wanted.file_for(self.wanted.labels, self.name), self._count)

    def _of_vertices(self, values: IntArray) -> IntArray:
        """Values of the vertices in the mesh's file, of those that are left; others as they are, to be refused."""
        return values[self._kept] if len(values) == self._count else values


# ---------------------------------------------------------------------- works
def fields(mesh: Mesh, words: str, begin: int = 0, end: int | None = None) -> Made:
    """(n, k) the distance of every vertex from each source, of which begin to end are meant."""
    distance, sources = mesh.distance(words), mesh.sources(words)
    columns = distance.from_sources(sources[begin:end])
    if mesh.mask is not None:
        columns[~mesh.mask] = np.nan
    return Made(
        {"fields": _in(columns, mesh.wanted.dtype)}, facts_of_fields(distance, sources, mesh.wanted.sources.rule)
    )


def facts_of_fields(distance: Distance, sources: list[Source], rule: str = "") -> dict[str, Any]:
    """What stands beside fields in their JSON: the distance, its unit and accuracy, and the sources."""
    is_all = rule == "all" and len(sources) == len(distance.surface.vertices)
    return {**_facts_of_distance(distance), "sources": "all" if is_all else _named(sources)}


def pairs(mesh: Mesh, words: str) -> Made:
    """(k, k) the distances among the sources, or (p, p) their means between parcels."""
    distance = mesh.distance(words)
    if mesh.wanted.labels:
        return parcels_made(mesh, distance, parcel_means(distance, mesh.labels, mesh.mask))
    sources = mesh.sources(words)
    among = distance.pairwise(sources)
    return Made(*pairs_made(mesh, distance, sources, _in(among, mesh.wanted.dtype)))


def pairs_made(
    mesh: Mesh, distance: Distance, sources: list[Source], among: Array
) -> tuple[dict[str, Array], dict[str, Any]]:
    """With the root of the area, by which benchmarks divide."""
    area = float(np.sqrt(mesh.scaled.face_areas.sum()))
    arrays: dict[str, Array] = {"dist": among}
    if mesh.wanted.arrays in ("npz", "mat"):
        arrays["sqrt_area"] = np.array(area)
    return arrays, {**facts_of_fields(distance, sources, mesh.wanted.sources.rule), "sqrt_area": area}


def neighbours(mesh: Mesh, words: str, begin: int = 0, end: int | None = None) -> Made:
    """(s, k) the vertices nearest to each source, nearest first, and how far they are."""
    distance, sources = mesh.distance(words), mesh.sources(words)
    found = nearest(distance, sources_as_vertices(sources)[begin:end], mesh.wanted.nearest, mesh.mask)
    return neighbours_made(mesh, distance, sources, *found)


def sources_as_vertices(sources: list[Source]) -> list[int]:
    """ParameterError for a source that is no vertex."""
    for each in sources:
        if not isinstance(each, int):
            raise ParameterError(f"Neighbours are those of vertices, and {short_words_of(each)} is none.")
    return sources  # type: ignore[return-value]


def neighbours_made(
    mesh: Mesh, distance: Distance, sources: list[Source], indices: IntArray, values: FloatArray
) -> Made:
    """Nearest vertices (m, k) and their distances (m, k), with the facts about them."""
    facts = {"indices": "-1 where there is none", "order": "nearest first, equal ones by number"}
    arrays = {"indices": indices, "distances": _in(values, mesh.wanted.dtype)}
    return Made(arrays, {**facts_of_fields(distance, sources, mesh.wanted.sources.rule), **facts})


def parcels_made(mesh: Mesh, distance: Distance, found: Parcels) -> Made:
    """Mean distances between parcels (m, m), with their labels, the names of these and their sizes."""
    facts = {**_facts_of_distance(distance), "labels": found.labels.tolist()}
    names = [mesh.label_names.get(label, "") for label in found.labels.tolist()]
    facts |= {"names": names} if any(names) else {}
    facts |= {"counts": found.counts.tolist(), "means": "of the distances of all pairs of vertices"}
    return Made({"means": _in(found.distances, mesh.wanted.dtype)}, facts)


def eigen(mesh: Mesh, words: str = "") -> Made:
    """Eigenvalues (k,), eigenvectors (n, k) orthonormal by area, areas (n,)."""
    laplacian = mesh.distances.laplacian
    most = sum(component.most_eigenpairs for component in laplacian.components)
    found = eigenpairs(laplacian, min(mesh.wanted.eigenpairs, most))
    vectors = _in(found.eigenvectors, mesh.wanted.dtype)
    arrays = {"eigenvalues": found.eigenvalues, "eigenvectors": vectors, "areas": laplacian.areas}
    facts: dict[str, Any] = {
        "parameters": {"eigenpairs": len(found.eigenvalues)},
        "unit": "eigenvalues: 1 / mesh units^2",
    }
    facts["normalisation"] = "sum of areas times eigenvector squared is 1"
    return Made(arrays, facts)


def fps(mesh: Mesh, words: str) -> Made:
    """(k,) the vertices, each the farthest from those before it; the first is the highest."""
    found = np.array(mesh.sources(words))
    return Made({"vertices": found}, _facts_of_distance(mesh.distance(words)))


WORK: dict[str, Callable[..., Made]] = {kind.word: globals()[kind.function] for kind in KINDS.values() if kind.function}


def _facts_of_distance(distance: Distance) -> dict[str, Any]:
    error_estimate = distance.error_estimate()
    return {
        "distance": distance.identity or distance.label,
        "parameters": dict(Spec.parse(distance.identity).values) if distance.identity else {},
        "label": distance.label,
        "unit": distance.unit,
        "normalisation": "none",
        "accuracy": error_estimate.share,
        "accuracy_text": error_estimate.text,
    }


def _named(sources: list[Source]) -> list[int | str]:
    return [each if isinstance(each, int) else short_words_of(each) for each in sources]


def _in(array: AnyArray, dtype: str) -> AnyArray:
    return np.ascontiguousarray(array, dtype=dtype)
