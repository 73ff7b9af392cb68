"""The surfaces of the experiments, by name, with what is expensive to compute about them."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np

from ..analysis.upright import axes_of
from ..applications.resizing import at_most, resized
from ..arrays import BoolArray, IntArray
from ..distances.answers import Distances
from ..distances.distance import Distance
from ..distances.distance_types import Spec
from ..distances.edge_geodesic import EdgeGeodesic
from ..errors import ParameterError
from ..formats.mesh_io import read_surface
from ..laplacian import Laplacian
from ..progress import Progress, steps
from ..surface import Surface
from .parts import Parts

NAMES = ("figure", "figure_pose2", "animal", "hand", "genus3", "domain", "scan")
"""The surfaces that the experiments know: y is up, and the front looks to +z (the animal's head is at +x)."""

UPPER_BACK = (0.5, 0.72)
"""Where figures 3 and 6 and others start from, on the back of the person: shares of width and height."""

SEEDS = ("vertex 0", "seed 1", "seed 2", "seed 3", "seed 4")
"""The first starts of every protocol: the first vertex, and some drawn at random once and for all."""

STARTS = 25
"""The number of starts for measurements that depend on one."""

LARGE = 20_000
"""Vertices from which on a mesh of the reader's is simplified once, before smaller ones are made from it."""


def starts(count: int = STARTS) -> tuple[str, ...]:
    """Return the first starts of every protocol, as many as one likes; beyond the first they are random."""
    return ("vertex 0", *(f"seed {number}" for number in range(1, count)))


class Shapes:
    """The surfaces by name, read when first needed; or, in the place of all of them, the reader's own.

    `meshes` are surfaces or paths of mesh files, `own` is the reader's surface, and `up` the axis that is up in all of
    them, such as "z" or "-y".
    """

    def __init__(
        self,
        meshes: Mapping[str, Surface | str | os.PathLike[str]] | None = None,
        own: Surface | None = None,
        up: str = "y",
    ) -> None:
        self._meshes = dict(meshes or {})
        self.own = own
        self.axes = axes_of(up)
        """(3, 3) columns: what is right, up and to the front."""
        self._surfaces: dict[str, Surface] = {}
        self._laplacians: dict[str, Laplacian] = {}
        self.kept: dict[object, object] = {}
        """Results of one experiment that another needs too."""

    @classmethod
    def from_folder(cls, folder: str | os.PathLike[str]) -> "Shapes":
        """Return the meshes `NAME.ply` of a folder."""
        return cls({name: Path(folder) / f"{name}.ply" for name in NAMES if (Path(folder) / f"{name}.ply").exists()})

    def names(self, *names: str) -> tuple[str, ...]:
        """Return the names of shapes that an experiment would look at; of the own surface instead, if there is one."""
        return (self.own.name,) if self.own is not None else names

    def __getitem__(self, name: str) -> Surface:
        """Return the surface of that name; ParameterError if there is none."""
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
        """Return the Laplacian of a shape, shared by all distances on it."""
        if name not in self._laplacians:
            self._laplacians[name] = Laplacian(self[name])
        return self._laplacians[name]

    def sized(self, name: str, count: int, progress: Progress | None = None) -> Surface:
        """Return the surface with `count` vertices, kept for the next experiment."""
        return self._made(f"{name} with {count} vertices", resized, name, count, progress)

    def at_most(self, name: str, count: int, progress: Progress | None = None) -> Surface:
        """Return the surface with at most `count` vertices if it goes: as it is, or simplified as far as it can be."""
        return self._made(f"{name} with at most {count} vertices", at_most, name, count, progress)

    def _made(
        self,
        key: str,
        change: Callable[[Surface, int, Progress | None], Surface],
        name: str,
        count: int,
        progress: Progress | None,
    ) -> Surface:
        if key not in self._surfaces:
            self._surfaces[key] = change(self._near(name, count), count, progress)
        return self._surfaces[key]

    def sizes(self, name: str, counts: Sequence[int], parts: Parts, progress: Progress | None = None) -> list[int]:
        """Return the numbers of vertices that the surface can have, and note the others as not done.

        Raises ParameterError where there are none.
        """
        there = []
        for step, count in steps(progress, counts):
            if parts.do(f"{count:,} vertices", self.sized, name, count, step) is not None:
                there.append(count)
        if not there:
            raise ParameterError(" ".join(dict.fromkeys(each.reason for each in parts.not_done)))
        return there

    def _near(self, name: str, count: int) -> Surface:
        """Return the surface, simplified to `LARGE` vertices if it has more; smaller sizes are made of that."""
        surface = self.connected(name)
        return self.at_most(name, LARGE) if count < LARGE < len(surface.vertices) else surface

    def connected(self, name: str) -> Surface:
        """Return the largest component of the surface, without vertices of no face."""
        surface = self[name]
        if surface.n_components > 1 or surface.unreferenced_count:
            return surface.component(0)[0]
        return surface

    def vertex_at(self, surface: Surface, x: float, y: float, side: str = "front") -> int:
        """Return the vertex of one of them seen at shares x and y of its width and height, from the "front" or the
        "back"."""
        ids = np.flatnonzero(surface.component_of_vertex == 0)
        places = surface.vertices[ids] @ self.axes
        low, high = places.min(axis=0), places.max(axis=0)
        at = low[:2] + np.array([x, y]) * (high - low)[:2]
        off = np.linalg.norm(places[:, :2] - at, axis=1)
        # Both sides have a vertex within an edge or so of the ray, unless it misses the surface.
        near = np.flatnonzero(off <= max(1.5 * surface.mean_edge_length, float(off.min())))
        depth = places[near, 2]
        return int(ids[near[np.argmin(depth) if side == "back" else np.argmax(depth)]])

    def pictured_source(self, name: str, side: str) -> int:
        """Return the vertex that figures 1, 4 and 5 start from, on the "front" or the "back" of the surface of that
        name."""
        return self.vertex_at(self[name], *PLACES[side].get(name, PLACES[side]["figure"]), side)


DISTANCES = ("biharmonic", "geodesic", "diffusion t = 1")


def distance(laplacian: Laplacian, kind: str, progress: Progress | None = None) -> Distance:
    """Return a distance by the words of the experiments: "biharmonic", "diffusion t = 1/4" stands for
    "diffusion(t=1/4)".

    Geodesic is exact on every mesh. SolverError if it cannot be had, or not accurately.
    """
    made = Distances(laplacian).get(spec_of(kind), progress)
    made.error_estimate()
    return made


def spec_of(kind: str) -> Spec:
    """Return the spec of a distance by the words of the experiments."""
    word, _, parameters = kind.partition(" ")
    # No verdict rests on an approximate one.
    return Spec.parse(f"{word}({parameters or ('method=exact' if word == 'geodesic' else '')})")


def distances_there(laplacian: Laplacian, parts: Parts, where: str) -> dict[str, Distance]:
    """Return the distances of `DISTANCES` that can be had on a surface.

    Why not of the others is noted, as "KIND on WHERE".
    """
    made = {kind: parts.do(f"{kind} on {where}", distance, laplacian, kind) for kind in DISTANCES}
    return {kind: each for kind, each in made.items() if each is not None}


def start_vertex(surface: Surface, seed: str = "vertex 0") -> int:
    """Return the vertex that a protocol starts from, on the largest component."""
    vertices = np.flatnonzero(surface.component_of_vertex == 0)
    number = 0 if seed == "vertex 0" else int(seed.removeprefix("seed "))
    return int(vertices[0] if number == 0 else np.random.default_rng(number).choice(vertices))


PLACES: dict[str, dict[str, tuple[float, float]]] = {
    "front": {"figure": (0.5, 0.75), "animal": (0.5, 0.62), "hand": (0.5, 0.4), "genus3": (0.5, 0.4)},
    "back": {
        "figure": UPPER_BACK,
        "figure_pose2": UPPER_BACK,
        "animal": (0.5, 0.62),
        "hand": (0.5, 0.45),
        "genus3": (0.5, 0.5),
    },
}
"""Where the pictured sources are: shares of width and height; those of the person for meshes of a reader."""


def random_sources(surface: Surface, count: int, among: BoolArray | None = None) -> list[int]:
    """Return (count,) vertices, equal each time: on the largest component, or `among` (n,) bool those of it.

    Some may be equal where there are few.
    """
    if among is None:
        return [start_vertex(surface, start) for start in starts(count + 1)[1:]]
    ids = np.flatnonzero(among & (surface.component_of_vertex == 0))
    return [int(np.random.default_rng(number).choice(ids)) for number in range(1, count + 1)] if len(ids) else []


def spread_points(surface: Surface, count: int, start: str | int = "vertex 0") -> IntArray:
    """Return (count,) vertices by farthest-point sampling along edges, from a protocol's start or from a vertex."""
    component, ids = surface.component(0)
    lengths = EdgeGeodesic(component)
    first = start_vertex(surface, start) if isinstance(start, str) else start
    points = [int(np.searchsorted(ids, first))]
    nearest = lengths.distances(points[0])
    while len(points) < count:
        points.append(int(np.argmax(nearest)))
        nearest = np.minimum(nearest, lengths.distances(points[-1]))
    return ids[points]
