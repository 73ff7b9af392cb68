"""A mesh made finer around some of its vertices, the surface itself unchanged."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from ..arrays import BoolArray, IntArray
from ..errors import ParameterError
from ..surface import Surface

ROUNDS = 200
"""Far more than any refinement takes: each round halves the longest edges there are."""


def refined_around(surface: Surface, sources: npt.ArrayLike, least: float, reach: float, edges: float = 6) -> Surface:
    """Refine a surface around vertices (k,): at a distance r up to `reach` no edge is longer than r / edges.

    Nearer than `least` it is as fine as at this distance; both are in the mesh's unit, along straight lines. Old
    vertices keep their ids and come first. Edges are cut in the middle, always the longest of a face first (Rivara
    1984), so that no angle becomes less than about half of the least one there was. Raises VertexError for a bad id,
    ParameterError unless 0 < least <= reach and edges > 0.
    """
    ids = surface.check_vertices(sources)
    if not (0 < least <= reach and edges > 0 and np.isfinite(reach)):
        raise ParameterError(f"A refinement from {least:g} to {reach:g} with {edges:g} edges is not possible.")
    tree = cKDTree(surface.vertices[ids])
    for _ in range(ROUNDS):
        x, count = surface.vertices, len(surface.faces)
        length = np.linalg.norm(x[surface.edges[:, 0]] - x[surface.edges[:, 1]], axis=1)
        of_side = surface.edge_of_side.reshape(3, count)
        # Ranks, as equal lengths must be told apart in the same way by both faces.
        rank = np.empty(len(length), int)
        rank[np.argsort(length, kind="stable")] = np.arange(len(length))
        longest = rank[of_side].argmax(axis=0)
        edge = of_side[longest, np.arange(count)]
        away = tree.query(x)[0][surface.faces].min(axis=1)
        is_long = (length[edge] > np.maximum(away, least) / edges) & (away < reach)
        if not is_long.any():
            break
        cut = np.zeros(len(length), bool)
        cut[edge[is_long]] = True
        while True:
            more = cut[of_side].any(axis=0) & ~cut[edge]
            if not more.any():
                break
            cut[edge[more]] = True
        surface = _bisected(surface, of_side, longest, cut)
    return surface


def _bisected(surface: Surface, of_side: IntArray, longest: IntArray, cut: BoolArray) -> Surface:
    """Return the surface with edges cut (e,) bool in the middle.

    Of each face that has one, its longest edge is among them.
    """
    x, faces = surface.vertices, surface.faces
    middle = np.full(len(cut), -1)
    middle[cut] = len(x) + np.arange(cut.sum())
    touched = np.flatnonzero(cut[of_side].any(axis=0))
    first = longest[touched]
    # The longest edge is from a to b, c opposite.
    a, b, c = (faces[touched, (first + k) % 3] for k in range(3))
    m, n, p = (middle[of_side[(first + k) % 3, touched]] for k in range(3))
    # Halves (m, b, c) and (a, m, c); each is cut again from m if its outer edge is.
    whole_b, whole_a = n < 0, p < 0
    new = [
        np.stack([m, b, c], 1)[whole_b],
        np.stack([m, b, n], 1)[~whole_b],
        np.stack([m, n, c], 1)[~whole_b],
        np.stack([a, m, c], 1)[whole_a],
        np.stack([a, m, p], 1)[~whole_a],
        np.stack([p, m, c], 1)[~whole_a],
    ]
    others = np.delete(faces, touched, axis=0)
    points = np.concatenate([x, x[surface.edges[cut]].mean(axis=1)])
    return Surface(points, np.concatenate([others, *new]), surface.name)
