"""Shortest paths along mesh edges (Dijkstra): an upper bound of geodesic distance, too long by 4 to 6 % in
the mean on most samples, and by 13 % on long, thin faces."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..surface import Surface


class EdgeGeodesic:
    """Shortest paths along edges and their lengths; any mesh, manifold or not.

    Edges of length 0 (coincident vertices) are kept: they connect their ends at no cost.
    """

    def __init__(self, surface: Surface) -> None:
        self.surface = surface
        i, j = surface.edges.T.astype(np.int32)  # older csgraph takes no other indices
        lengths = np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)
        n = len(surface.vertices)
        # csgraph takes a stored zero in a sparse graph for an edge of length 0, so nothing is dropped here.
        # Both directions are stored: scipy's undirected mode would build the transpose at every call.
        self._graph = sp.csr_array(
            (np.tile(lengths, 2), (np.concatenate([i, j]), np.concatenate([j, i]))), shape=(n, n)
        )

    def distances(self, sources: npt.ArrayLike) -> FloatArray:
        """Return (n,) lengths from one vertex or (n, k) from (k,) vertices, in the mesh's length unit; inf out of
        reach.

        Raises VertexError for an id that does not exist or belongs to no face.
        """
        # Not at the top: it is half of what `import bihdist_core` would take.
        from scipy.sparse.csgraph import dijkstra

        if np.ndim(sources) == 0:
            lengths: FloatArray = dijkstra(self._graph, indices=self.surface.check_vertices(sources)[0])
            return lengths
        ids = self.surface.check_vertices(sources)
        return np.ascontiguousarray(dijkstra(self._graph, indices=ids).T)

    def distances_with(self, vertices: IntArray, offsets: FloatArray) -> FloatArray:
        """Return (n,) least length from any of (k,) vertices, each with an offset (k,) to be added; inf out of
        reach."""
        from scipy.sparse.csgraph import dijkstra

        n = len(self.surface.vertices)
        graph = self._graph
        # One vertex more, from which the offsets lead to theirs; the least where there are several.
        order = np.lexsort((offsets, vertices))
        ids, first = np.unique(vertices[order], return_index=True)
        more = sp.csr_array(
            (
                np.append(graph.data, offsets[order][first]),
                np.append(graph.indices, ids.astype(graph.indices.dtype)),
                np.append(graph.indptr, graph.indptr[-1] + len(ids)),
            ),
            shape=(n + 1, n + 1),
        )
        lengths: FloatArray = dijkstra(more, indices=n)[:n]
        return lengths

    def path(self, start: int, stop: int) -> IntArray:
        """Return (k,) vertices of a shortest path, both ends included; ParameterError where there is none."""
        from scipy.sparse.csgraph import dijkstra

        start, stop = (int(v) for v in self.surface.check_vertices([start, stop]))
        before = dijkstra(self._graph, indices=start, return_predecessors=True)[1]
        path = [stop]
        while path[-1] != start:
            path.append(int(before[path[-1]]))
            if path[-1] < 0:
                raise ParameterError(f"There is no path from vertex {start} to vertex {stop} along edges.")
        return np.array(path[::-1])
