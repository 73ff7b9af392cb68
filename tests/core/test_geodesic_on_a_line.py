"""Meshes pressed onto a line, of flat faces alone: their geodesic distances are those along the Reeb graph."""

from itertools import combinations, pairwise

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components, dijkstra

from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.surface import Surface
from tests.core.nasty_meshes import nasty_mesh
from tests.shapes import bumpy, grid, torus


def reeb_distances(t, faces):
    """(n, n) of vertices at t (n,): what a face has at one place is one point of it."""
    levels, number, same, ways = np.unique(t).tolist(), {}, [], []
    for face in faces.tolist():
        parts = [(v,) for v in face] + [(min(e), max(e)) for e in combinations(face, 2)]

        def at(level, part):
            """The number of an edge's point at a level: of a vertex, or between two."""
            name = next((v for v in part if t[v] == level), (part, level))
            return number.setdefault(name, len(number))

        within = {part: [x for x in levels if min(t[[*part]]) <= x <= max(t[[*part]])] for part in parts}
        for level in levels:
            same += pairwise([at(level, part) for part in parts if level in within[part]])
        ways += [(at(x, part), at(y, part), y - x) for part in parts for x, y in pairwise(within[part])]
    joined = sp.coo_matrix((np.ones(len(same)), np.transpose(same)), shape=(len(number),) * 2)
    count, point = connected_components(joined, directed=False)
    lengths = {(point[i], point[j]): length for i, j, length in ways}
    graph = sp.csr_matrix((list(lengths.values()), np.transpose(list(lengths))), shape=(count, count))
    points = point[[number[v] for v in range(len(t))]]
    return dijkstra(graph, directed=False, indices=points)[:, points]


def pressed(surface, rng, way):
    t = surface.vertices[:, 0] if way != "anywhere" else rng.normal(size=len(surface.vertices))
    return np.round(4 * t) if way == "whole numbers" else t


@pytest.mark.parametrize("shape", [bumpy(30), grid(5, 4), torus(8, 5), "nasty"], ids=lambda s: getattr(s, "name", s))
@pytest.mark.parametrize("way", ["along an axis", "anywhere", "whole numbers"])
def test_all_on_a_line(shape, way):
    """Many places are those of several vertices, or all but the line's own rounding apart."""
    for seed in range(4):
        rng = np.random.default_rng(seed)
        surface = Surface(*nasty_mesh(seed, 40)) if shape == "nasty" else shape
        used, faces = np.unique(surface.faces, return_inverse=True)
        surface = Surface(surface.vertices[used], faces.reshape(-1, 3))
        t, direction = pressed(surface, rng, way), rng.normal(size=3)
        expected = reeb_distances(t, surface.faces) * np.linalg.norm(direction)
        for line in (direction, np.linalg.norm(direction) * np.eye(3)[0]):
            solver = ExactGeodesic(Surface(t[:, None] * line, surface.faces))
            found = np.stack([solver.distances(v) for v in range(len(t))])
            np.testing.assert_allclose(
                np.nan_to_num(found, nan=np.inf), expected, rtol=0, atol=1e-13 * expected[np.isfinite(expected)].max()
            )
