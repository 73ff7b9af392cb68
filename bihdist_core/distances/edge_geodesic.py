"""Shortest paths along mesh edges (Dijkstra): an upper bound of geodesic distance, some percent too long."""

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..surface import Surface


class EdgeGeodesic:
    """Lengths of shortest edge paths on one connected surface; any mesh, manifold or not.

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

    def distances(self, sources: npt.ArrayLike) -> np.ndarray:
        """(n,) lengths from one vertex or (n, k) from (k,) vertices, in the mesh's length unit; inf out of reach.

        Raises VertexError for an id that does not exist or belongs to no face.
        """
        # Not at the top: it is half of what `import bihdist_core` would take.
        from scipy.sparse.csgraph import dijkstra

        if np.ndim(sources) == 0:
            return dijkstra(self._graph, indices=self.surface.check_vertices(sources)[0])
        ids = self.surface.check_vertices(sources)
        return np.ascontiguousarray(dijkstra(self._graph, indices=ids).T)
