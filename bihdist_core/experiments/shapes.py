"""The surfaces of the experiments, by name, with what is expensive to compute about them."""

import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ..applications.resizing import resized
from ..distances.answers import Distances
from ..distances.distance import Distance
from ..distances.edge_geodesic import EdgeGeodesic
from ..distances.kinds import Spec
from ..errors import ParameterError
from ..formats.mesh_io import read_surface
from ..laplacian import Laplacian
from ..progress import Progress
from ..surface import Surface

NAMES = ("figure", "figure_pose2", "animal", "hand", "genus3", "domain", "scan")
"""The surfaces that the experiments know: y is up, and the front looks to +z (the animal's head is at +x)."""

SEEDS = ("vertex 0", "seed 1", "seed 2", "seed 3", "seed 4")
"""The starts of every protocol: the first vertex, and four drawn at random once and for all."""


class Shapes:
    """The surfaces by name, read when first needed; or, in the place of all of them, the reader's own.

    meshes: surfaces or paths of mesh files.  own: the reader's surface.
    """

    def __init__(
        self, meshes: Mapping[str, Surface | str | os.PathLike[str]] | None = None, own: Surface | None = None
    ) -> None:
        self._meshes = dict(meshes or {})
        self.own = own
        self._surfaces: dict[str, Surface] = {}
        self._laplacians: dict[str, Laplacian] = {}

    @classmethod
    def from_folder(cls, folder: str | os.PathLike[str]) -> "Shapes":
        """The meshes `NAME.ply` of a folder."""
        return cls({name: Path(folder) / f"{name}.ply" for name in NAMES if (Path(folder) / f"{name}.ply").exists()})

    def names(self, *names: str) -> tuple[str, ...]:
        """These names, of shapes that an experiment would look at; the own surface's instead, if there is one."""
        return (self.own.name,) if self.own is not None else names

    def __getitem__(self, name: str) -> Surface:
        """The surface of that name; ParameterError if there is none."""
        if self.own is not None and name == self.own.name:
            return self.own
        if name not in self._surfaces:
            if name not in self._meshes:
                raise ParameterError(f"This experiment needs the surface {name!r}, which is not among those given.")
            mesh = self._meshes[name]
            surface = mesh if isinstance(mesh, Surface) else read_surface(mesh)
            self._surfaces[name] = Surface(surface.vertices, surface.faces, name, surface.repairs)
        return self._surfaces[name]

    def laplacian(self, name: str) -> Laplacian:
        """Its Laplacian, shared by all distances on it."""
        if name not in self._laplacians:
            self._laplacians[name] = Laplacian(self[name])
        return self._laplacians[name]

    def sized(self, name: str, count: int, progress: Progress | None = None) -> Surface:
        """The surface with `count` vertices, kept for the next experiment."""
        key = f"{name} with {count} vertices"
        if key not in self._surfaces:
            surface = self[name]
            if surface.component_count > 1 or surface.unreferenced_count:
                surface = surface.component(0)[0]
            self._surfaces[key] = resized(surface, count, progress)
        return self._surfaces[key]


DISTANCES = ("biharmonic", "geodesic", "diffusion t = 1")


def distance(laplacian: Laplacian, kind: str, progress: Progress | None = None) -> Distance:
    """A distance by the words of the experiments: "biharmonic", "diffusion t = 1/4" stands for "diffusion(t=1/4)".

    Geodesic is exact on manifold surfaces of up to 20,000 vertices, else by the heat method; the label says which.
    SolverError if it cannot be had, or not accurately.
    """
    word, _, parameters = kind.partition(" ")
    made = Distances(laplacian).get(Spec.parse(f"{word}({parameters})"), progress)
    made.certificate()
    return made


def start_vertex(surface: Surface, seed: str = "vertex 0") -> int:
    """The vertex that a protocol starts from, on the largest component."""
    vertices = np.flatnonzero(surface.component_of_vertex == 0)
    number = SEEDS.index(seed)
    return int(vertices[0] if number == 0 else np.random.default_rng(number).choice(vertices))


def spread_points(surface: Surface, count: int, seed: str = "vertex 0") -> np.ndarray:
    """(count,) vertices by farthest-point sampling along edges from the start of a protocol."""
    component, ids = surface.component(0)
    lengths = EdgeGeodesic(component)
    points = [int(np.searchsorted(ids, start_vertex(surface, seed)))]
    nearest = lengths.distances(points[0])
    while len(points) < count:
        points.append(int(np.argmax(nearest)))
        nearest = np.minimum(nearest, lengths.distances(points[-1]))
    return ids[points]


def vertex_at(surface: Surface, x: float, y: float, side: str = "front") -> int:
    """The vertex seen at shares x and y of the surface's width and height, from the front (+z) or from the "back"."""
    vertices = surface.vertices
    ids = np.flatnonzero(surface.component_of_vertex == 0)
    low, high = vertices[ids].min(axis=0), vertices[ids].max(axis=0)
    at = low[:2] + np.array([x, y]) * (high - low)[:2]
    off = np.linalg.norm(vertices[ids, :2] - at, axis=1)
    # Both sides have a vertex within an edge or so of the ray, unless it misses the surface.
    near = ids[off <= max(1.5 * surface.mean_edge_length, float(off.min()))]
    depth = vertices[near, 2]
    return int(near[np.argmin(depth) if side == "back" else np.argmax(depth)])
