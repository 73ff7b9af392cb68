"""What can go wrong with a mesh, done on purpose: noise, holes, welded parts, a thin handle."""

from itertools import pairwise

import numpy as np

from ..errors import ParameterError
from ..surface import Surface

WIDTH = 0.25
"""Sides of a thin handle, as a share of those of the faces it joins."""


def noisy(surface: Surface, share: float, seed: int = 0) -> Surface:
    """Gaussian noise on each coordinate of each vertex; its standard deviation is `share` mean edge lengths."""
    shift = np.random.default_rng(seed).standard_normal(surface.vertices.shape)
    return Surface(surface.vertices + share * surface.mean_edge_length * shift, surface.faces, surface.name)


def punched(surface: Surface, distances: np.ndarray, radius: float) -> Surface:
    """Holes: the faces all of whose corners are nearer than `radius` to a centre are taken out.

    distances: (n, k) from each of k centres.  Vertex ids stay; what falls apart from the largest piece goes as well.
    """
    near = np.asarray(distances).min(axis=1) < radius
    rest = Surface(surface.vertices, surface.faces[~near[surface.faces].all(axis=1)], surface.name)
    largest = rest.component_of_vertex[rest.faces[:, 0]] == 0
    return Surface(rest.vertices, rest.faces[largest], surface.name)


def welded(surface: Surface, face_a: int, face_b: int) -> Surface:
    """Two parts grown together: both faces go, and their corners become one, halfway between.

    A closed surface gets one handle more.  Vertex ids stay; the corners of `face_b` then belong to no face.  Raises
    ParameterError if the two faces or their neighbours touch.
    """
    a, b = _opposite_corners(surface, face_a, face_b)
    follow = np.arange(len(surface.vertices))
    follow[b] = a
    x = surface.vertices.copy()
    x[a] = (x[a] + x[b]) / 2
    keep = np.delete(np.arange(len(surface.faces)), [face_a, face_b])
    return Surface(x, follow[surface.faces[keep]], surface.name)


def with_handle(surface: Surface, face_a: int, face_b: int) -> Surface:
    """A thin, straight, three-sided tube from the middle of one face to the middle of another.

    Vertex ids stay; the tube's come after them.  Raises ParameterError as `welded`.
    """
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


def _opposite_corners(surface: Surface, face_a: int, face_b: int) -> tuple[np.ndarray, np.ndarray]:
    """(3,) corners of both faces, paired so that the surface stays oriented and the pairs are as near as can be."""
    a, b = surface.faces[face_a], surface.faces[face_b]
    around = surface.faces[np.isin(surface.faces, a).any(axis=1)]
    beside = surface.faces[np.isin(surface.faces, b).any(axis=1)]
    if np.isin(around, beside).any():
        raise ParameterError(f"Faces {face_a} and {face_b} are too close to each other to be joined.")
    turns = [np.roll(b[::-1], k) for k in range(3)]
    x = surface.vertices
    return a, min(turns, key=lambda turn: float(((x[a] - x[turn]) ** 2).sum()))
