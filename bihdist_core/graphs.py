"""Graphs, and what their Laplacian tells of them: resistances, biharmonic distances, and the sums over all pairs."""

from __future__ import annotations

import os
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp

from .arrays import FloatArray
from .errors import ParameterError
from .laplacian import Laplacian
from .progress import Progress


@dataclass(frozen=True, eq=False)
class Graph:
    """An undirected graph with positive weights.

    Attributes
    ----------
    weights : (n, n) sparse matrix
        The weights of edges, symmetric, without loops.
    nodes : sequence
        The names of the nodes (n,).
    name : str
        Name for messages.
    notes : sequence of str
        What was left out while it was read, in words.

    Examples
    --------
    >>> import bihdist, scipy.sparse
    >>> path = scipy.sparse.csr_matrix([[0, 1, 0], [1, 0, 1], [0, 1, 0]])
    >>> graph = bihdist.Graph.of(path)
    >>> graph.n_edges, graph.number(2)
    (2, 2)
    """

    weights: sp.csr_matrix
    nodes: Sequence[Hashable]
    name: str = "graph"
    notes: Sequence[str] = ()

    @classmethod
    def of(cls, graph: Any, weight: str = "weight", name: str = "graph") -> Graph:
        """Return a graph of networkx, or of a matrix of weights.

        Parameters
        ----------
        graph : networkx.Graph, (n, n) sparse matrix or array, or Graph
            Undirected; loops do not count.
        weight : str
            The attribute of networkx' edges that is their weight; edges without it have 1.
        name : str
            Name for messages.

        Returns
        -------
        Graph
            With networkx' nodes in their order, or rows 0 to n - 1.

        Raises
        ------
        ParameterError
            For a directed graph, a matrix that is not symmetric, and weights that are not positive.

        Examples
        --------
        >>> import bihdist, networkx
        >>> bihdist.Graph.of(networkx.karate_club_graph()).n_edges
        78
        """
        if isinstance(graph, cls):
            return graph
        if hasattr(graph, "is_directed") and hasattr(graph, "edges"):
            if graph.is_directed():
                raise ParameterError(f"{name} is directed; its undirected form is graph.to_undirected().")
            nodes = list(graph.nodes)
            number = {node: k for k, node in enumerate(nodes)}
            triples = [(number[i], number[j], w) for i, j, w in graph.edges(data=weight, default=1)]
            table = np.array(triples, float).reshape(-1, 3).T
            return cls(joined(table[0], table[1], table[2], nodes, name), nodes, name)
        if isinstance(graph, str | os.PathLike):
            raise ParameterError(f"{os.fspath(graph)!r} names a file; `read_graph` reads files.")
        matrix = sp.coo_matrix(graph)
        if matrix.shape[0] != matrix.shape[1]:
            raise ParameterError(f"{name}: the weights of a graph are an (n, n) matrix, not {matrix.shape}.")
        rows = range(matrix.shape[0])
        there = sp.csr_matrix(matrix)
        if abs(there - there.T).max() > 0:
            raise ParameterError(f"{name}: the weights of an undirected graph are a symmetric matrix.")
        return cls(joined(matrix.row, matrix.col, matrix.data, rows, name), rows, name)

    @property
    def n_edges(self) -> int:
        """The number of edges.

        Examples
        --------
        >>> import bihdist, networkx
        >>> bihdist.Graph.of(networkx.path_graph(5)).n_edges
        4
        """
        return int(self.weights.nnz) // 2

    @cached_property
    def _numbers(self) -> dict[Hashable, int]:
        return {node: k for k, node in enumerate(self.nodes)}

    def number(self, node: Hashable) -> int:
        """Return the row of a node.

        Parameters
        ----------
        node : hashable
            A name among `nodes`.

        Returns
        -------
        int
            Its place there.

        Raises
        ------
        ParameterError
            If there is no such node.

        Examples
        --------
        >>> import bihdist, networkx
        >>> bihdist.Graph.of(networkx.florentine_families_graph()).number("Medici")
        1
        """
        try:
            return self._numbers[node]
        except KeyError:
            some = ", ".join(str(each) for each in list(self.nodes)[:3])
            raise ParameterError(f"{self.name} has no node {node!r}; its nodes begin with {some}.") from None

    def with_inverse_weights(self) -> Graph:
        """Return the graph for weights that are lengths: a long edge conducts little.

        Returns
        -------
        Graph
            With 1 / weight for each weight.

        Examples
        --------
        >>> import bihdist, numpy
        >>> bihdist.Graph.of(numpy.array([[0, 4], [4, 0]])).with_inverse_weights().weights.toarray().tolist()
        [[0.0, 0.25], [0.25, 0.0]]
        """
        weights = self.weights.copy()
        weights.data = 1 / weights.data
        return Graph(weights, self.nodes, self.name, self.notes)

    def laplacian(self) -> Laplacian:
        """Return L = D - W, with the mass 1 at each node.

        Returns
        -------
        Laplacian
            For every distance but the geodesic one; squares of its commute-time distances are effective resistances.

        Examples
        --------
        >>> import bihdist, networkx
        >>> graph = bihdist.Graph.of(networkx.cycle_graph(4))
        >>> resistance = bihdist.CommuteTimeDistance(graph.laplacian()).from_source(0) ** 2
        >>> resistance.round(9).tolist()
        [0.0, 0.75, 1.0, 0.75]
        """
        degrees = np.asarray(self.weights.sum(axis=1)).ravel()
        return Laplacian.from_matrices(sp.diags(degrees) - self.weights, np.ones(len(degrees)), name=self.name)


def joined(i: Any, j: Any, weight: Any, nodes: Sequence[Hashable], name: str) -> sp.csr_matrix:
    """Return the symmetric (n, n) weights of edges; an edge that is listed in both directions counts once, others that
    are listed several times have the sum of their weights.

    Raises ParameterError for weights that are not positive, and different ones in both directions.
    """
    n, i, j, w = len(nodes), np.asarray(i, np.int64), np.asarray(j, np.int64), np.asarray(weight, np.float64)
    wrong = np.flatnonzero(~((w > 0) & np.isfinite(w)) & (i != j))
    if len(wrong):
        k = int(wrong[0])
        raise ParameterError(
            f"{name}: weights are positive, and that of the edge from {nodes[i[k]]} to {nodes[j[k]]} is {w[k]:g}."
        )
    apart = i != j
    one_way = sp.coo_matrix((w[apart], (i[apart], j[apart])), shape=(n, n)).tocsr()
    other_way = one_way.T.tocsr()
    both = one_way.multiply(other_way != 0) - other_way.multiply(one_way != 0)
    if both.nnz and abs(both).max() > 0:
        a, b = (int(each[0]) for each in both.nonzero())
        raise ParameterError(
            f"{name}: the edge from {nodes[a]} to {nodes[b]} has the weight {one_way[a, b]:g} and back "
            f"{other_way[a, b]:g}; the graph is to be undirected."
        )
    return sp.csr_matrix(one_way.maximum(other_way))


def kirchhoff_index(laplacian: Laplacian, progress: Progress | None = None) -> float:
    """Compute the sum of effective resistances over all pairs of nodes, n sum_k 1 / lambda_k.

    Parameters
    ----------
    laplacian : Laplacian
        Of a connected graph.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    float
        The Kirchhoff index; infinite if the graph is not connected.

    Examples
    --------
    >>> import bihdist, networkx
    >>> laplacian = bihdist.Graph.of(networkx.cycle_graph(6)).laplacian()
    >>> round(bihdist.kirchhoff_index(laplacian), 9)  # (n^3 - n) / 12
    17.5
    """
    return _sum_of_squares(laplacian, False, progress)


def biharmonic_index(laplacian: Laplacian, progress: Progress | None = None) -> float:
    """Compute the sum of squared biharmonic distances over all pairs of nodes, n sum_k 1 / lambda_k^2.

    Parameters
    ----------
    laplacian : Laplacian
        Of a connected graph.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    float
        The biharmonic index (Wei, Li and Yang 2021); infinite if the graph is not connected.

    Examples
    --------
    >>> import bihdist, networkx
    >>> laplacian = bihdist.Graph.of(networkx.complete_graph(5)).laplacian()
    >>> round(bihdist.biharmonic_index(laplacian), 9)  # 5 * 4 / 5^2
    0.8
    """
    return _sum_of_squares(laplacian, True, progress)


def _sum_of_squares(laplacian: Laplacian, biharmonic: bool, progress: Progress | None) -> float:
    """Return the sum over pairs of K_ii + K_jj - 2 K_ij, for K = C or K = G: n tr(K) - 1^T K 1."""
    component, n = laplacian.components[0], len(laplacian.surface.vertices)
    if len(component.vertices) < n:
        return float("inf")
    if not biharmonic:
        diagonal: FloatArray = component.green_diagonal(progress)
        return n * float(diagonal.sum()) - float(component.solve(np.ones(n)).sum())
    diagonal, u = component.biharmonic_diagonal(progress), component.u
    ones = component.solve(component.areas * component.solve(np.ones(n))) - u * (u.sum() / component.areas.sum())
    return n * float(diagonal.sum()) - float(ones.sum())
