"""What a scanner sees of a solid from a few places: range shadows, uneven triangles, noise along the line of sight."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyvista as pv
import vtk
from scipy.spatial import cKDTree

from .edits import WorkOrder
from .fields import Field, unit
from .triangles import (
    adjacency,
    best_at_vertices,
    edge_lengths,
    edges_and_sides,
    face_normals,
    incidence,
    pieces,
    unpinched,
    used_only,
)

GRAZING = 0.26
"""Cosine of the angle between line of sight and normal, below which nothing comes back."""

RAGGED = 0.10
"""Standard deviation of that limit from vertex to vertex."""

NOISE = 0.06
"""Standard deviation along the line of sight, seen straight, in lengths of the shortest edge there."""

TREMOR = 0.16
"""Standard deviation of the shift along the surface, which makes triangles uneven, in the same lengths."""

ISLAND = 7
"""Pieces with fewer vertices are thrown away, as scanning programs do."""

SMOOTHING = 8
"""Rounds of averaging that keep the edge length from jumping where a shadow begins."""

SPECKS, BEHIND = 3, (0.012, 0.020)
"""How many bits float behind an edge, and how far behind it, metres."""

Mesh = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Views:
    """How each of k scanners sees each of n places.

    `towards` (k, n, 3) are unit directions to the scanner, `distance` (k, n), `cosine` (k, n) is 1 where seen straight,
    and 0 where not seen at all.
    """

    towards: np.ndarray
    distance: np.ndarray
    cosine: np.ndarray

    def best(self) -> np.ndarray:
        """(n,) the scanner that sees a place best."""
        return (self.cosine / self.distance).argmax(axis=0)


class Scanners:
    """Scanners at `places` (k, 3) round a solid that is given by a fine mesh of its surface."""

    def __init__(self, places: Sequence[Sequence[float]], points: np.ndarray, faces: np.ndarray) -> None:
        self._places = np.asarray(places, float)
        self._points, self._faces = points, faces
        mesh = pv.PolyData.from_regular_faces(points, faces)
        self._locator = vtk.vtkStaticCellLocator()
        self._locator.SetDataSet(mesh)
        self._locator.BuildLocator()

    def views(self, points: np.ndarray, normals: np.ndarray, lift: float) -> Views:
        """How they see `points` with unit `normals`; rays end `lift` above the surface, so as not to meet it there."""
        towards = self._places[:, None] - points
        distance = np.linalg.norm(towards, axis=2)
        towards /= distance[:, :, None]
        cosine = np.maximum((towards * normals).sum(axis=2), 0)
        for place, seen in zip(self._places, cosine, strict=True):
            for i in np.flatnonzero(seen > 0):
                if self._blocked(place, points[i] + lift * normals[i]):
                    seen[i] = 0
        return Views(towards, distance, cosine)

    def _blocked(self, start: np.ndarray, end: np.ndarray) -> bool:
        share, at, inside, part, cell = vtk.mutable(0.0), [0.0] * 3, [0.0] * 3, vtk.mutable(0), vtk.mutable(0)
        return bool(self._locator.IntersectWithLine(start, end, 1e-9, share, at, inside, part, cell))

    def wanted(self, step: float, finest: float, coarsest: float) -> WorkOrder:
        """Edge lengths as these scanners space their samples, `step` radians apart: longer afar and at an angle."""
        edges = edges_and_sides(self._faces)[0]
        n = len(self._points)
        lift = 0.5 * float(np.median(edge_lengths(self._points, edges)))
        views = self.views(self._points, _normals(self._points, self._faces), lift)
        spacing = (step * views.distance / np.maximum(views.cosine, 0.01)).min(axis=0)
        spacing = np.clip(spacing, finest, coarsest)
        near, valence = adjacency(edges, n), np.bincount(edges.ravel(), minlength=n)
        for _ in range(SMOOTHING):
            spacing = (near @ spacing) / valence
        tree = cKDTree(self._points)
        return lambda p: spacing[tree.query(p)[1]]

    def scan(self, points: np.ndarray, faces: np.ndarray, field: Field, seed: int) -> Mesh:
        """What they bring home of a fine enough mesh of the solid, which stands on z = 0."""
        rng = np.random.default_rng(seed)
        edges = edges_and_sides(faces)[0]
        shortest = best_at_vertices(edges, edge_lengths(points, edges), len(points))
        normals = _normals(points, faces)
        views = self.views(points, normals, 0.4 * float(np.median(shortest)))
        rough = rng.normal(size=views.cosine.shape)
        rough = rough + rough @ adjacency(edges, len(points))
        limit = np.maximum(GRAZING + RAGGED * rough / rough.std(), 0.03)
        # A face is there if one scanner has met its three corners.
        faces = faces[(views.cosine > limit)[:, faces].all(axis=2).any(axis=0)]
        specks = _specks(points, faces, views, field, rng)
        points, faces = unpinched(_shaken(points, normals, shortest, views, rng), faces)
        label, sizes = pieces(points, faces)
        return _together([used_only(points, faces[sizes[label[faces[:, 0]]] >= ISLAND]), *specks])


def _shaken(
    points: np.ndarray, normals: np.ndarray, shortest: np.ndarray, views: Views, rng: np.random.Generator
) -> np.ndarray:
    """The points as measured by the scanner that sees each best: the more at an angle, the less surely."""
    best = views.best(), np.arange(len(points))
    along = views.towards[best] / np.clip(views.cosine[best], 0.3, 1)[:, None]
    noise = NOISE * along * rng.normal(size=(len(points), 1))
    tremor = TREMOR * rng.normal(size=points.shape)
    tremor -= normals * (tremor * normals).sum(axis=1, keepdims=True)
    return points + shortest[:, None] * (noise + tremor)


def _specks(points: np.ndarray, faces: np.ndarray, views: Views, field: Field, rng: np.random.Generator) -> list[Mesh]:
    """Samples that hang between an edge and what lies behind it: bits of the edge, farther from a scanner."""
    edges, sides = edges_and_sides(faces)
    rim = np.unique(edges[sides[:, 1] < 0])
    edges = edges[(sides[:, 1] >= 0) & ~np.isin(edges, rim).any(axis=1)]
    out: list[Mesh] = []
    taken = np.empty((0, 3))
    for start, end in edges[rng.permutation(len(edges))]:
        cosine = views.cosine[:, start]
        scanner = int(np.where(cosine > 0, cosine, 2).argmin())
        bit, corners = used_only(points, faces[np.isin(faces, (start, end)).any(axis=1)])
        bit = bit - rng.uniform(*BEHIND) * views.towards[scanner, start]
        apart = np.linalg.norm(taken - bit[0], axis=1) > 5 * BEHIND[1]
        free = field(bit).min() > 0.3 * BEHIND[0] and bit[:, 2].min() > 0
        if 0 < cosine[scanner] < 0.5 and free and apart.all():
            out.append((bit, corners))
            taken = np.r_[taken, bit[:1]]
        if len(out) == SPECKS:
            break
    return out


def _normals(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """(n, 3) unit normals at the vertices."""
    return unit(incidence(faces, len(points)) @ face_normals(points, faces))


def _together(meshes: Sequence[Mesh]) -> Mesh:
    """All as one mesh, side by side."""
    first = np.cumsum([0, *(len(points) for points, _ in meshes)])
    faces = [faces + start for (_, faces), start in zip(meshes, first, strict=False)]
    return np.concatenate([points for points, _ in meshes]), np.concatenate(faces)
