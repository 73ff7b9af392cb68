"""From a recipe to a page that computes: one HTML file with the mesh, the kernel and what is shown."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core import Laplacian, ParameterError, Surface
from bihdist_core.distances.answers import Distances
from bihdist_core.distances.kinds import Spec
from bihdist_core.distances.spectral import SpectralDistance
from bihdist_core.distances.unfolding_mesh import UnfoldingMesh
from bihdist_core.progress import Progress, part
from bihdist_core.whole_file import check_output, whole_file

from ..document.page import Recipe
from ..figures.export import compute, open_document
from ..session.array_store import ArrayStore
from ..session.loaded_mesh import LoadedMesh
from .contents import Contents
from .html_file import page_text
from .points import StoredPoints
from .scene import Json, scene_of
from .stored_field import StoredField
from .stored_mesh import StoredMesh

FORMATS = (".html",)

MOST_VERTICES = 200_000
"""Of a page: with more, browsers have no memory for the kernel, or people no patience."""

SIMPLIFIED = 100_000

BYTES_EACH = 2.6
"""Of the file, for a coordinate of a vertex in eigenpairs."""


@dataclass(frozen=True)
class Page:
    """What a page holds.

    differs: by how much distances differ on the page's mesh from those on the original, as fractions of their maxima,
    from the source and three vertices far apart; and by how much fields of the user's own do, "field mine", for being
    kept in single precision.
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
        """How many of them distances took along, by the names of these."""
        return {name: each.scales.shape[1] for name, each in self.points.items()}

    def write(self, path: str | os.PathLike[str]) -> int:
        """Into a .html file, all or nothing; how many bytes these are.  OutputError."""
        check_output(path, FORMATS)
        text = page_text(self.scene, self.mesh, self.points, self.given).encode()
        with whole_file(path) as temporary:
            temporary.write_bytes(text)
        return len(text)


def page_of(
    recipe: Recipe,
    given: ArrayStore | None = None,
    precision: str = "24",
    eigenpairs: int = 0,
    progress: Progress | None = None,
) -> Page:
    """Read and compute what a page of a recipe holds.

    eigenpairs: up to so many may go along for each distance that needs them.  ParameterError for what a page cannot
    show, a mesh of more than MOST_VERTICES vertices, and eigenpairs beyond those allowed.
    """
    Contents.of(recipe.document)  # before a mesh is read
    document, surfaces = open_document(recipe, given or ArrayStore.read(recipe))
    contents = Contents.of(document)
    loaded = surfaces[document.surfaces[0].name]
    check_size(loaded.surface, loaded.mesh.path)
    _check_eigenpairs(contents, loaded, eigenpairs, part(progress, 0, 0.3))
    recipe = replace(recipe, document=contents.document)
    answers = compute(contents.document, surfaces, part(progress, 0.3, 0.5))
    mesh = StoredMesh.of(loaded.surface, precision)
    _check_geodesic(contents, mesh)
    distances = Distances(Laplacian(mesh.surface, document.areas))
    differs = _differences(contents, loaded, mesh, distances, part(progress, 0.5, 1))
    points = {name: StoredPoints.of(_spectral(distances, spec)) for name, spec in contents.by_eigenpairs.items()}
    for name, each in points.items():
        maximum = _maximum(loaded, document.areas, contents, name)
        differs[str(contents.fields[name])] += each.error / max(maximum, 1e-300)
    fields = {each.word: loaded.own_field(document.field(each.name)) for each in contents.own}
    own = {word: StoredField.of(values, mesh.ids) for word, values in fields.items()}
    differs |= {word: each.error for word, each in own.items()}
    stored = {"bits": 24 if precision == "24" else precision, "backs": mesh.has_backs, "differs": differs}
    scene = scene_of(recipe, contents, surfaces, answers, stored)
    return Page(scene, mesh, points, tuple(answer.label for answer in answers), differs, own)


def check_size(surface: Surface, path: str = "") -> None:
    """ParameterError for a mesh that is too large for a page, with what makes it smaller."""
    if len(surface.vertices) > MOST_VERTICES:
        raise ParameterError(
            f"{surface.name} has {len(surface.vertices):,} vertices, and a page has up to {MOST_VERTICES:,}; make it "
            f"smaller with: bihdist perturb {path or 'MESH'} --simplify {SIMPLIFIED} -o smaller.ply"
        )


def needed_eigenpairs(contents: Contents, loaded: LoadedMesh, progress: Progress | None = None) -> dict[str, int]:
    """How many eigenpairs each distance that needs them takes along, by its name; they are computed for that."""
    distances = loaded.distances(contents.document.areas)
    needed = {}
    for name, spec in contents.by_eigenpairs.items():
        distance = _spectral(distances, spec, progress)
        needed[name] = max(distance.points(component, progress).shape[1] for component in distance.laplacian.components)
    return needed


def eigenpair_bytes(count: int, vertices: int) -> int:
    """What so many eigenpairs take of the file, about."""
    return round(BYTES_EACH * count * vertices)


def _check_eigenpairs(contents: Contents, loaded: LoadedMesh, allowed: int, progress: Progress | None) -> None:
    count = len(loaded.surface.vertices)
    for name, needed in needed_eigenpairs(contents, loaded, progress).items():
        if needed > allowed:
            raise ParameterError(
                f"{contents.fields[name]} needs {needed:,} eigenpairs in the page, some "
                f"{size_words(eigenpair_bytes(needed, count))}; allow them with --eigenpairs {needed} (in Python "
                f"eigenpairs={needed}), or leave it out."
            )


def _check_geodesic(contents: Contents, mesh: StoredMesh) -> None:
    """ParameterError where a page would have to unfold faces that have no height."""
    is_geodesic = any(spec.word == "geodesic" for spec in contents.fields.values())
    if is_geodesic and UnfoldingMesh(mesh.surface).has_degenerate_faces:
        raise ParameterError(
            f"{mesh.surface.name} has faces without height, over which a page cannot measure geodesic distance; leave "
            "that out, remesh, or draw it with bihdist figure."
        )


def _differences(
    contents: Contents, loaded: LoadedMesh, mesh: StoredMesh, stored: Distances, progress: Progress | None
) -> dict[str, float]:
    """By the words of distances, the largest difference between the stored and the original mesh's, as a fraction."""
    if not contents.fields:
        return {}
    original, n = loaded.distances(contents.document.areas), len(mesh.ids)
    (at,) = np.flatnonzero(mesh.ids == contents.source)
    sources = list(dict.fromkeys([int(at), 0, n // 2, n - 1]))
    steps = [(spec, source) for spec in contents.fields.values() for source in sources]
    differs = {str(spec): 0.0 for spec in contents.fields.values()}
    for k, (spec, source) in enumerate(steps):
        step = part(progress, k / len(steps), (k + 1) / len(steps))
        answers = original.answer(spec, int(mesh.ids[source]), step), stored.answer(spec, source, step)
        a, b = (answer.field for answer in answers)
        if a is None or b is None:
            raise ParameterError(next(answer.failure for answer in answers if answer.field is None))
        top = float(np.nanmax(a, initial=0.0))
        if top > 0:
            differs[str(spec)] = max(differs[str(spec)], float(np.nanmax(np.abs(a[mesh.ids] - b))) / top)
    return differs


def _maximum(loaded: LoadedMesh, areas: str, contents: Contents, name: str) -> float:
    """The largest distance from the source by one of the distances."""
    assert contents.source is not None
    return loaded.distances(areas).answer(contents.fields[name], contents.source).maximum


def _spectral(distances: Distances, spec: Spec, progress: Progress | None = None) -> SpectralDistance:
    distance = distances.get(spec, progress)
    assert isinstance(distance, SpectralDistance)
    return distance


def write_page(
    recipe: Recipe,
    path: str | os.PathLike[str],
    given: ArrayStore | None = None,
    precision: str = "24",
    eigenpairs: int = 0,
    progress: Progress | None = None,
) -> tuple[Page, int]:
    """Make a page and write it, see `page_of`; the page, and how many bytes its file has.  OutputError."""
    check_output(path, FORMATS)
    page = page_of(recipe, given, precision, eigenpairs, progress)
    return page, page.write(path)


def size_words(size: int) -> str:
    """How large a file of so many bytes is: "241 kB", "1.2 MB"."""
    return f"{size / 1e6:.1f} MB" if size >= 1e6 else f"{size / 1e3:.0f} kB"
