"""Perturbations of a mesh: noise, holes, welded parts, a thin handle (paper, Figs. 3, 6, 7)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..distances.edge_geodesic import EdgeGeodesic
from ..errors import ParameterError
from ..formats.mesh_io import read_surface
from ..mesh_like import MeshLike
from ..progress import Progress
from ..scalars import real_number, whole_number
from ..surface import Surface, vertex_normals, with_faces
from .changes import WAYS, Perturbation, Runs
from .resizing import simplified

WIDTH = 0.25
"""Sides of a thin handle, as a fraction of those of the faces it joins."""


def noisy(surface: MeshLike, sigma: float, seed: int = 0, along: str = "xyz") -> Surface:
    """Add Gaussian noise to each vertex.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    sigma : float
        Standard deviation in mean edge lengths, at least 0.
    seed : int
        Seed of the random numbers.
    along : {"xyz", "normals"}
        On each coordinate, or along the normal of the vertex.

    Returns
    -------
    Surface
        The noisy surface.

    Raises
    ------
    ParameterError
        For another word, and for a `sigma` that is not a finite number of at least 0.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = bihdist.Surface.of(pyvista.Icosphere(nsub=3))
    >>> moved = abs(bihdist.noisy(sphere, 0.1).vertices - sphere.vertices)
    >>> # of a normal distribution 0.08
    >>> print(f"{moved.mean() / sphere.mean_edge_length:.2f}")
    0.08
    """
    surface = with_faces(surface, "changes")
    if along not in WAYS:
        raise ParameterError(f"Noise is along one of {', '.join(WAYS)}, not {along!r}.")
    if not 0 <= real_number(sigma, "The size of noise") < np.inf:
        raise ParameterError(f"The size of noise is a number of mean edge lengths of at least 0, not {sigma!r}.")
    random = np.random.default_rng(seed)
    if along == "xyz":
        shift = random.standard_normal(surface.vertices.shape)
    else:
        shift = random.standard_normal((len(surface.vertices), 1)) * vertex_normals(surface)
    return Surface(surface.vertices + sigma * surface.mean_edge_length * shift, surface.faces, surface.name)


def with_holes(surface: MeshLike, count: int, radius: float = 0.05, seed: int = 0) -> Surface:
    """Cut round holes at random vertices.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    count : int
        How many holes, at least one.
    radius : float
        Along edges, in roots of the surface's area, at most 1.
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Surface
        The surface with its vertex ids. What falls apart from the largest piece of a component is taken out, too.

    Raises
    ------
    ParameterError
        For no holes, a radius that is not above 0 and at most 1, and where nothing or all would be left.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = bihdist.Surface.of(pyvista.Icosphere(nsub=3))
    >>> sphere.boundary_loop_count
    0
    >>> bihdist.with_holes(sphere, 3, seed=1).boundary_loop_count
    3
    """
    surface = with_faces(surface, "holes")
    if whole_number(count, "The number of holes") < 1:
        raise ParameterError(f"The number of holes is a whole number from 1, not {count!r}.")
    if not 0 < real_number(radius, "The radius of holes") <= 1:
        raise ParameterError(f"The radius of holes is a fraction of the root of the area, from 0 to 1, not {radius!r}.")
    candidates = np.flatnonzero(surface.component_of_vertex >= 0)
    centres = np.random.default_rng(seed).choice(candidates, min(count, len(candidates)), replace=False)
    unit = float(np.sqrt(surface.face_areas.sum()))
    rest = punched(surface, EdgeGeodesic(surface).distances(centres), radius * unit)
    if len(rest.faces) == len(surface.faces):
        raise ParameterError(
            f"Holes of a radius of {radius:g} roots of the area hold no face of {surface.name}; choose a larger radius."
        )
    return rest


def punched(surface: Surface, distances: FloatArray, radius: float) -> Surface:
    """Take out the faces all of whose corners are nearer than `radius` to one of k centres.

    `distances` (n, k) are those from the centres. Vertex ids stay; see `without`.
    """
    near = np.nanmin(np.asarray(distances), axis=1, initial=np.inf) < radius
    return without(surface, np.flatnonzero(near))


def without(surface: Surface, vertices: npt.ArrayLike) -> Surface:
    """Take out the faces all of whose corners are among vertices (k,).

    Vertex ids stay; what falls apart from the largest piece of a component is taken out, too. Raises ParameterError if
    nothing is left.
    """
    gone = np.zeros(len(surface.vertices), bool)
    gone[np.asarray(vertices, int)] = True
    left = surface.faces[~gone[surface.faces].all(axis=1)]
    if not len(left):
        raise ParameterError(f"Nothing would be left of {surface.name}; remove less.")
    rest = Surface(surface.vertices, left, surface.name)
    was, now = (each.component_of_vertex[left[:, 0]] for each in (surface, rest))
    # Components are numbered from the largest.
    largest = np.full(surface.n_components, rest.n_components)
    np.minimum.at(largest, was, now)
    return Surface(rest.vertices, left[now == largest[was]], surface.name)


def without_faces(surface: Surface, cut: Runs) -> Surface:
    """Take out some faces; vertex ids stay, and pieces that are apart then stay, too.

    Raises ParameterError for faces that are not there, and if nothing is left.
    """
    count, last = len(surface.faces), max((last for _, last in cut), default=-1)
    if last >= count:
        raise ParameterError(f"{surface.name} has {count:,} faces, numbered from 0, so no face {last}.")
    is_left = np.ones(count, bool)
    for first, last in cut:
        is_left[first : last + 1] = False
    if not is_left.any():
        raise ParameterError(f"Nothing would be left of {surface.name}; remove less.")
    return Surface(surface.vertices, surface.faces[is_left], surface.name)


def posed(surface: Surface, pose: Surface) -> Surface:
    """Return the surface in another pose: its faces between the vertices of `pose`.

    Raises ParameterError where the other's vertices or faces are not numbered alike.
    """
    if len(pose.vertices) != len(surface.vertices):
        raise ParameterError(
            f"{pose.name} has {len(pose.vertices):,} vertices and {surface.name} {len(surface.vertices):,}; "
            "another pose has the same, in the same order."
        )
    if not np.array_equal(_faces_in_order(surface), _faces_in_order(pose)):
        raise ParameterError(
            f"The faces of {pose.name} join other vertices than those of {surface.name}; another pose has the same."
        )
    return Surface(pose.vertices, surface.faces, surface.name)


def _faces_in_order(surface: Surface) -> IntArray:
    """Return (m, 3) whatever the order of faces and corners in the file."""
    faces = np.sort(surface.faces, axis=1)
    return faces[np.lexsort(faces.T)]


def _without_loose_vertices(surface: Surface) -> tuple[Surface, IntArray]:
    """Take out vertices that are in no face, and return (k,) what the others were."""
    ids, index = np.unique(surface.faces, return_inverse=True)
    return Surface(surface.vertices[ids], index.reshape(-1, 3), surface.name), ids


def face_at(surface: Surface, vertex: int) -> int:
    """Return the largest face at a vertex, the first of equal ones. Raises VertexError for a bad vertex."""
    faces = np.flatnonzero((surface.faces == surface.check_vertex(vertex)).any(axis=1))
    return int(faces[surface.face_areas[faces].argmax()])


def welded(surface: MeshLike, face_a: int, face_b: int) -> Surface:
    """Join two parts of a surface: two faces are taken out, and their corners become one, halfway between.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    face_a, face_b : int
        The two faces.

    Returns
    -------
    Surface
        The joined surface with its vertex ids; the corners of `face_b` belong to no face. A closed surface gets one
        more handle.

    Raises
    ------
    ParameterError
        If the two faces or their neighbours touch.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = bihdist.Surface.of(pyvista.Icosphere(nsub=2))
    >>> sphere.genus, bihdist.welded(sphere, 0, 200).genus
    (0, 1)
    """
    surface = with_faces(surface, "welds")
    a, b = _opposite_corners(surface, face_a, face_b)
    follow = np.arange(len(surface.vertices))
    follow[b] = a
    x = surface.vertices.copy()
    x[a] = (x[a] + x[b]) / 2
    keep = np.delete(np.arange(len(surface.faces)), [face_a, face_b])
    return Surface(x, follow[surface.faces[keep]], surface.name)


def with_handle(surface: MeshLike, face_a: int, face_b: int) -> Surface:
    """Add a handle: a thin, straight, three-sided tube from the middle of one face to the middle of another.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    face_a, face_b : int
        The two faces.

    Returns
    -------
    Surface
        The surface with its vertex ids; the vertices of the tube come after them.

    Raises
    ------
    ParameterError
        If the two faces or their neighbours touch.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = bihdist.Surface.of(pyvista.Icosphere(nsub=3))
    >>> tube = bihdist.with_handle(sphere, 0, 640)
    >>> sphere.genus, tube.genus, tube.n_vertices - sphere.n_vertices
    (0, 1, 99)
    """
    surface = with_faces(surface, "handles")
    a, b = _opposite_corners(surface, face_a, face_b)
    x, n = surface.vertices, len(surface.vertices)
    mouths = []
    for corners in (x[a], x[b]):
        middle = corners.mean(axis=0)
        mouths.append(middle + WIDTH * (corners - middle))
    gap = float(np.linalg.norm(mouths[0].mean(axis=0) - mouths[1].mean(axis=0)))
    side = float(np.mean([np.linalg.norm(m - np.roll(m, 1, axis=0), axis=1).mean() for m in mouths]))
    rings = max(2, round(gap / side) + 1)
    t = np.linspace(0, 1, rings)[:, None, None]
    tube = ((1 - t) * mouths[0] + t * mouths[1]).reshape(-1, 3)
    loops = [a, *(n + 3 * np.arange(rings)[:, None] + np.arange(3)), b]
    faces = [np.delete(surface.faces, [face_a, face_b], axis=0)]
    for one, two in pairwise(loops):
        for k in range(3):
            p, q, r, s = one[k], one[(k + 1) % 3], two[(k + 1) % 3], two[k]
            faces.append(np.array([[p, q, r], [p, r, s]]))
    return Surface(np.concatenate([x, tube]), np.concatenate(faces), surface.name)


def _opposite_corners(surface: Surface, face_a: int, face_b: int) -> tuple[IntArray, IntArray]:
    """Return (3,) corners of both faces, paired so that the surface stays oriented and pairs are near each other."""
    a, b = surface.faces[face_a], surface.faces[face_b]
    around = surface.faces[np.isin(surface.faces, a).any(axis=1)]
    beside = surface.faces[np.isin(surface.faces, b).any(axis=1)]
    if np.isin(around, beside).any():
        raise ParameterError(f"Faces {face_a} and {face_b} are too close to each other to be joined.")
    turns = [np.roll(b[::-1], k) for k in range(3)]
    x = surface.vertices
    return a, min(turns, key=lambda turn: float(((x[a] - x[turn]) ** 2).sum()))


def perturbed(
    surface: Surface, change: Perturbation, progress: Progress | None = None, pose: Surface | None = None
) -> tuple[Surface, IntArray]:
    """Change a surface, and return it with (n',) the vertex that each of its vertices was, -1 for new ones.

    `pose` is the mesh in the file `change.pose`, which is read if None. Raises ParameterError as the single changes,
    VertexError for vertices that are not there, and MeshError for a pose that cannot be read.
    """
    result, ids = with_faces(surface, "changes"), np.arange(len(surface.vertices))
    if change.pose:
        result = posed(result, read_surface(change.pose) if pose is None else pose)
    if change.cut:
        result = without_faces(result, change.cut)
    if change.simplify is not None:
        # Counted are vertices that belong to faces.
        result, before = _without_loose_vertices(result)
        result, ids_left = simplified(result, change.simplify, progress)
        ids = before[ids_left]
    if change.noise:
        result = noisy(result, change.noise, change.seed, change.along)
    if change.holes:
        result = with_holes(result, change.holes, change.radius, change.seed)
    for pair, join in ((change.weld, welded), (change.handle, with_handle)):
        if pair is not None:
            ends = [face_at(result, image_of(surface, ids, vertex, result)) for vertex in pair]
            result = join(result, *ends)
    new = np.full(len(result.vertices) - len(ids), -1)
    return result, np.concatenate([ids, new])


def image_of(surface: Surface, ids: IntArray, vertex: int, result: Surface) -> int:
    """Return the vertex of a perturbed surface that a vertex is, or is nearest to where it is gone.

    `ids` are those that `perturbed` returns. Raises VertexError for a bad vertex.
    """
    vertex = surface.check_vertex(vertex)
    stays = np.flatnonzero((ids >= 0) & (result.component_of_vertex[: len(ids)] >= 0))
    away = np.linalg.norm(surface.vertices[ids[stays]] - surface.vertices[vertex], axis=1)
    return int(stays[away.argmin()])
