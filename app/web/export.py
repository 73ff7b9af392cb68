"""A recipe as an interactive web page: one HTML file with the mesh, the kernel and the viewer."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core import BihdistError, Laplacian, ParameterError, PointCloud, Surface, TetrahedralMesh
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer, Distances
from bihdist_core.distances.distance import unit_of
from bihdist_core.distances.distance_types import BUILT_IN, Spec
from bihdist_core.distances.spectral import SpectralDistance
from bihdist_core.distances.unfolding_mesh import unfolding_mesh
from bihdist_core.file_output import atomic_write, check_output
from bihdist_core.formats.mesh_names import holds_points
from bihdist_core.formats.vertex_count import announced_vertices
from bihdist_core.intrinsic import COTAN, TUFTED
from bihdist_core.progress import Progress, part
from bihdist_core.tetrahedra import SolidBoundary

from ..document.document import Document, MeshFile
from ..document.page import Recipe
from ..document.repairs import OPERATORS
from ..figures.export import compute, open_document
from ..scene.clipping import clip_plane, cut_through
from ..session.array_store import ArrayStore
from ..session.loaded_mesh import LoadedMesh, checked_path
from .contents import Contents
from .html_file import page_text
from .scene import Json, offered_panel, scene_of
from .stored_functions import stored_functions
from .stored_mesh import StoredMesh
from .stored_values import StoredField, StoredPoints

FORMATS = (".html",)

MOST_VERTICES = 200_000
"""Largest mesh of a page; beyond it browsers run out of memory, or take minutes."""

MOST_OF_SOLIDS = 50_000
"""Of tetrahedra, whose factor takes a browser about a minute then."""

SIMPLIFIED = 100_000

SOURCES = 8
"""Number of sources from which distances on the page's mesh are compared with those on the original. From other sources
they differ by up to 1.5 times as much on most meshes, and 5 times for commute-time distance on needles."""

BYTES_EACH = 2.6
"""Bytes of the file for one value of an eigenvector."""

EIGENPAIR_BYTES = 1_000_000
"""Bytes of the file that eigenpairs may take by default."""

OFFERED = tuple(
    Spec.parse(each.word, method="exact")
    for way in ("solved", "poles", "eigenpairs")
    for each in BUILT_IN
    if each.on_pages == way
)
"""Distances that readers can choose for a panel, besides those of the page's panels."""


@dataclass(frozen=True)
class Page:
    """The content of a page.

    Attributes
    ----------
    scene : dict
        What the viewer shows, as JSON.
    mesh : StoredMesh
        The mesh as the page holds it, rounded and packed.
    points : mapping of str to StoredPoints
        Eigenpairs, by the names of truncated distances.
    labels : tuple of str
        The labels of the panels.
    differs : mapping of str to float
        By how much distances on the page's mesh differ from those on the original, as fractions of their maxima: the
        largest difference from up to eight sources; from others it may be larger. For fields of the user's own
        ("field mine") the rounding to single precision, anywhere.
    given : mapping of str to StoredField
        Fields of the user's own.
    """

    scene: Json
    mesh: StoredMesh
    points: Mapping[str, StoredPoints]
    labels: tuple[str, ...]
    differs: Mapping[str, float]
    given: Mapping[str, StoredField]

    def __repr__(self) -> str:
        return f"Page({', '.join(self.labels)}, of {self.mesh.surface.name})"

    @property
    def eigenpairs(self) -> dict[str, int]:
        """Numbers of stored eigenpairs, by the names of distances."""
        return {name: each.scales.shape[1] for name, each in self.points.items()}

    def write(self, path: str | os.PathLike[str]) -> int:
        """Write the page.

        Parameters
        ----------
        path : path-like
            An .html file, which is written completely or not at all.

        Returns
        -------
        int
            Size of the file in bytes.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        check_output(path, FORMATS)
        text = page_text(self.scene, self.mesh, self.points, self.given).encode()
        with atomic_write(path) as temporary:
            temporary.write_bytes(text)
        return len(text)


def page_of(
    recipe: Recipe,
    given: ArrayStore | None = None,
    precision: str = "24",
    eigenpairs: int | None = None,
    progress: Progress | None = None,
    credit: str = "",
) -> Page:
    """Read and compute the content of a page.

    Parameters
    ----------
    recipe : Recipe
        What the page shows.
    given : ArrayStore, optional
        Arrays that the recipe refers to; by default they are read from beside it.
    precision : str
        Of coordinates, one of `PRECISIONS`.
    eigenpairs : int, optional
        The most eigenpairs to store for each truncated distance. By default as many as fit into
        `EIGENPAIR_BYTES`, including those of distances that readers can choose.
    progress : Progress, optional
        Told of the progress.
    credit : str
        A line that the page shows, such as the author of the mesh.

    Raises
    ------
    ParameterError
        If a page cannot show the document, the mesh has more than `MOST_VERTICES` vertices, or a distance needs more
        eigenpairs than allowed.
    """
    Contents.of(recipe.document)  # before a mesh is read
    _check_announced(recipe.document.surfaces[0])
    document, surfaces = open_document(recipe, given or ArrayStore.read(recipe))
    contents = Contents.of(document)
    loaded = surfaces[document.surfaces[0].name]
    check_size(loaded.surface.name, len(loaded.surface.vertices), loaded.mesh.path, loaded.surface)
    laplacian, left_out = loaded.distances(document.areas).laplacian, list[str]()
    has_faces = len(laplacian.surface.faces) > 0
    if not has_faces:
        contents, left_out = contents.without_geodesic(loaded.surface.name)
    _check_eigenpairs(contents, len(loaded.surface.vertices), eigenpairs)
    recipe = replace(recipe, document=contents.document)
    answers = compute(contents.document, surfaces, part(progress, 0, 0.4))
    is_of_faces = has_faces and laplacian.operator == COTAN
    mesh = StoredMesh.of(loaded.surface, precision, None if is_of_faces else laplacian)
    _check_geodesic(contents, mesh)
    of_matrices = Distances(mesh.laplacian(document.areas))
    of_faces = Distances(Laplacian(mesh.surface)) if has_faces else of_matrices

    def on_page(spec: Spec) -> Distances:
        return of_faces if spec.word == "geodesic" else of_matrices

    differs = _differences(contents, loaded, mesh, on_page, part(progress, 0.4, 1))
    points = {name: StoredPoints.of(_spectral(of_matrices, spec)) for name, spec in contents.by_eigenpairs.items()}
    room = 0 if eigenpairs is not None else EIGENPAIR_BYTES - sum(map(_stored_bytes, points.values()))
    for name, each in points.items():
        maximum = _maximum(loaded, document.areas, contents, name)
        differs[str(contents.fields[name])] += each.error / max(maximum, 1e-300)
    fields = {each.word: _values(loaded.own_field(document.field(each.name))) for each in contents.own}
    own = {word: StoredField.of(values, mesh.ids) for word, values in fields.items()}
    differs |= {word: each.error for word, each in own.items()}
    backs = mesh.has_backs and document.opacity == 1 if document.clip is None else mesh.has_inside
    stored: Json = {"counts": _counts(loaded, mesh), "bits": 24 if precision == "24" else precision, "backs": backs}
    stored |= {"differs": differs, "sources": min(SOURCES, len(mesh.ids))}
    stored["operator"] = "" if is_of_faces else _operator_words(laplacian)
    scene = scene_of(recipe, contents, surfaces, answers, stored, credit)
    by_poles = {spec for spec in contents.fields.values() if spec.distance_type.on_pages == "poles"}
    scene["notes"] += left_out
    scene["cut"] = _cut(loaded.surface, document, mesh)
    scene |= stored_functions(of_matrices.laplacian, by_poles, laplacian)
    offered = _offered(contents, on_page, laplacian, scene["functions"], room)
    named = contents.with_offered(spec for spec, *_ in offered)
    for name, (spec, label, unit, its_points) in zip(list(named)[len(contents.fields) :], offered, strict=True):
        scene["offered"].append(offered_panel(name, spec, label, unit, recipe.document.range))
        points |= {name: its_points} if its_points else {}
    return Page(scene, mesh, points, tuple(answer.label for answer in answers), differs, own)


def _counts(loaded: LoadedMesh, mesh: StoredMesh) -> dict[str, int]:
    """Return how many there are of what a page is made of, by names in the plural."""
    surface, n = loaded.surface, len(mesh.ids)
    if isinstance(surface, PointCloud):
        return {"points": n}
    if isinstance(surface, SolidBoundary):
        return {"vertices": n, "tetrahedra": len(surface.tetrahedra)}
    return {"vertices": n, "faces": len(surface.faces)}


def _operator_words(laplacian: Laplacian) -> str:
    """Return what the operator of a page is that is not by cotangents of faces."""
    if isinstance(laplacian.surface, PointCloud):
        return "Of points, by Sharp and Crane"
    if isinstance(laplacian.surface, TetrahedralMesh):
        return "Linear elements in tetrahedra"
    areas = "Voronoi" if laplacian.areas_kind == "voronoi" else laplacian.areas_kind
    return OPERATORS[laplacian.operator] + ("" if laplacian.operator == TUFTED else f", {areas} areas")


def _cut(surface: Surface, document: Document, mesh: StoredMesh) -> Json | None:
    """Return where the clip plane cuts a solid, with the numbers that vertices have in the page; None for no cut."""
    cut = cut_through(surface, clip_plane(document.clip, surface))
    if cut is None:
        return None
    ends = np.argsort(mesh.ids)[np.searchsorted(np.sort(mesh.ids), cut.ends)]
    weights = np.round(cut.weights, 6).tolist()
    return {"ends": ends.ravel().tolist(), "weights": weights, "faces": cut.faces.ravel().tolist()}


def _values(own: Answer) -> FloatArray:
    """Return the values (n,) of a field of the user's own: of labels their places among those that are there."""
    if own.labels is None:
        assert own.field is not None
        return own.field
    values = own.labels.values
    return np.where(np.isnan(values), np.nan, np.searchsorted(np.flatnonzero(own.labels.counts), values))


def _check_announced(mesh: MeshFile) -> None:
    """Refuse a file whose header announces too many vertices, unless it is made smaller on reading."""
    if mesh.path and mesh.change is None and not mesh.repairs.is_any:
        path = checked_path(mesh)
        check_size(os.path.basename(path), announced_vertices(path) or 0, mesh.path)


def check_size(name: str, vertices: int, path: str = "", surface: Surface | None = None) -> None:
    """Raise ParameterError for a mesh that is too large for a page, with what makes it smaller."""
    most, remedy = MOST_VERTICES, "make it smaller with: "
    remedy += f"bihdist perturb {path or 'MESH'} --simplify {SIMPLIFIED} -o smaller.ply"
    if isinstance(surface, SolidBoundary):
        most, remedy = MOST_OF_SOLIDS, "take coarser tetrahedra"
    elif isinstance(surface, PointCloud) or (path and holds_points(path)):
        remedy = "join near points with --merge TOLERANCE"
    if vertices > most:
        raise ParameterError(f"{name} has {vertices:,} vertices, and a page has up to {most:,}; {remedy}")


def needed_eigenpairs(contents: Contents) -> dict[str, int]:
    """Return the numbers of eigenpairs of the distances that need them, by the distances' names."""
    return {name: int(spec["k"]) for name, spec in contents.by_eigenpairs.items()}


def eigenpair_bytes(count: int, vertices: int) -> int:
    """Estimate the bytes that eigenpairs take in the file."""
    return round(BYTES_EACH * count * vertices)


def _stored_bytes(points: StoredPoints) -> int:
    return eigenpair_bytes(points.scales.shape[1], len(points.coordinates))


def _offered(
    contents: Contents, on_page: Callable[[Spec], Distances], original: Laplacian, functions: Json, room: int
) -> list[tuple[Spec, str, str, StoredPoints | None]]:
    """Return the distances that readers can choose, each with its label and its unit, which are those of the original
    Laplacian, and with its eigenpairs where these fit into `room` bytes."""
    found: list[tuple[Spec, str, str, StoredPoints | None]] = []
    shown = {spec.word for spec in contents.fields.values() if spec.word in functions}  # with a slider
    for spec in OFFERED:
        if spec in contents.fields.values() or spec.word in shown:
            continue
        if spec.word in functions:
            value = next(iter(spec.values))[1]
            step = next(each for each in functions[spec.word]["steps"] if each["value"] == value)
            found.append((spec, step["label"], step["unit"], None))
            continue
        points, distances = None, on_page(spec)
        stored = distances.laplacian.surface
        try:
            if spec.distance_type.on_pages == "eigenpairs":
                if eigenpair_bytes(int(spec["k"]), len(stored.vertices)) > room:
                    continue
                points = StoredPoints.of(_spectral(distances, spec))
            elif spec.word == "geodesic" and len(stored.faces) and unfolding_mesh(stored).has_degenerate_faces:
                continue
            distance = distances.get(spec)
            unit = unit_of(distance.length_power - (original.surface.dimension - 2) / 2)
            words = "" if spec.word == "geodesic" else original.operator_words
            found.append((spec, distance.label + words, unit, points))
        except BihdistError:
            continue  # the mesh does not have this distance
    return found


def _check_eigenpairs(contents: Contents, count: int, allowed: int | None) -> None:
    room = EIGENPAIR_BYTES
    for name, needed in needed_eigenpairs(contents).items():
        room -= eigenpair_bytes(needed, count)
        if room < 0 if allowed is None else needed > allowed:
            raise ParameterError(
                f"{contents.fields[name]} needs {needed:,} eigenpairs in the page, some "
                f"{size_words(eigenpair_bytes(needed, count))}; allow them with --eigenpairs {needed} (in Python "
                f"eigenpairs={needed}), or leave it out."
            )


def _check_geodesic(contents: Contents, mesh: StoredMesh) -> None:
    """Raise ParameterError if a page would have to measure geodesic distance over faces without height."""
    is_geodesic = any(spec.word == "geodesic" for spec in contents.fields.values())
    if is_geodesic and unfolding_mesh(mesh.surface).has_degenerate_faces:
        raise ParameterError(
            f"{mesh.surface.name} has faces without height, over which a page cannot measure geodesic distance; leave "
            "that out, remesh, or draw it with bihdist figure."
        )


def _differences(
    contents: Contents,
    loaded: LoadedMesh,
    mesh: StoredMesh,
    on_page: Callable[[Spec], Distances],
    progress: Progress | None,
) -> dict[str, float]:
    """Return the largest relative difference between the stored and the original mesh, by distance."""
    if not contents.fields:
        return {}
    original, n = loaded.distances(contents.document.areas), len(mesh.ids)
    (at,) = np.flatnonzero(mesh.ids == contents.source)
    first, count = [int(at), *_where_rounding_shows(mesh)], min(SOURCES, n)
    differs = {str(spec): 0.0 for spec in contents.fields.values()}
    for number, (name, spec) in enumerate(zip(differs, contents.fields.values(), strict=True)):
        # The next source is the vertex that differs most so far.
        sources, most = list(dict.fromkeys(first)), np.zeros(n)
        for k in range(count):
            step = part(progress, (number + k / count) / len(differs), (number + (k + 1) / count) / len(differs))
            source = sources[k]
            answers = original.answer(spec, int(mesh.ids[source]), step), on_page(spec).answer(spec, source, step)
            a, b = (answer.field for answer in answers)
            if a is None or b is None:
                raise ParameterError(next(answer.failure for answer in answers if answer.field is None))
            off, top = np.nan_to_num(np.abs(a[mesh.ids] - b)), float(np.nanmax(a, initial=0.0))
            if top > 0:
                differs[name] = max(differs[name], float(off.max()) / top)
            most = np.maximum(most, off)
            if k + 1 == len(sources):
                sources.append(int(np.where(np.isin(np.arange(n), sources), -1, most).argmax()))
    return differs


def _where_rounding_shows(mesh: StoredMesh) -> tuple[int, ...]:
    """Return an end of the shortest edge and a corner of the flattest face, where distances follow from these."""
    if mesh.matrices:
        return ()
    surface = mesh.surface
    ends = surface.vertices[surface.edges]
    shortest = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).argmin()
    return int(surface.edges[shortest, 0]), int(surface.faces[surface.face_heights.argmin(), 0])


def _maximum(loaded: LoadedMesh, areas: str, contents: Contents, name: str) -> float:
    """Return the maximum of a distance from the source."""
    assert contents.source is not None
    return loaded.distances(areas).answer(contents.fields[name], contents.source).maximum


def _spectral(distances: Distances, spec: Spec) -> SpectralDistance:
    distance = distances.get(spec)
    assert isinstance(distance, SpectralDistance)
    return distance


def write_page(
    recipe: Recipe,
    path: str | os.PathLike[str],
    given: ArrayStore | None = None,
    precision: str = "24",
    eigenpairs: int | None = None,
    progress: Progress | None = None,
    credit: str = "",
) -> tuple[Page, int]:
    """Compute a page with `page_of` and write it; return the page and the size of its file in bytes."""
    check_output(path, FORMATS)
    page = page_of(recipe, given, precision, eigenpairs, progress, credit)
    return page, page.write(path)


def size_words(size: int) -> str:
    """Return the size of a file in words: "241 kB", "1.2 MB"."""
    return f"{size / 1e6:.1f} MB" if size >= 1e6 else f"{size / 1e3:.0f} kB"
