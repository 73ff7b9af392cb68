"""Graphs, their files and their sums over pairs, against dense pseudo-inverses and networkx."""

import networkx
import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    Graph,
    ParameterError,
    PowerDistance,
    biharmonic_index,
    kirchhoff_index,
    read_graph,
)

KNOWN = {
    "karate": networkx.karate_club_graph,
    "florentine": networkx.florentine_families_graph,
    "les miserables": networkx.les_miserables_graph,
}


@pytest.mark.parametrize("make", KNOWN.values(), ids=KNOWN)
def test_k_harmonic_distances_of_known_graphs_are_those_of_the_pseudo_inverse(make):
    graph = make()
    inverse = np.linalg.pinv(networkx.laplacian_matrix(graph).toarray().astype(float))
    laplacian = Graph.of(graph).laplacian()
    n = len(inverse)
    for distance, k, close in [
        (CommuteTimeDistance(laplacian), 1, 1e-12),
        (BiharmonicDistance(laplacian), 2, 1e-12),
        (PowerDistance(laplacian, 3), 3, 1e-8),
    ]:
        green = np.linalg.matrix_power(inverse, k)
        expected = np.diag(green)[:, None] + np.diag(green) - 2 * green
        assert np.abs(distance.from_sources(np.arange(n)) ** 2 - expected).max() < close * expected.max()
    some, other = next(iter(graph)), list(graph)[-1]
    known = networkx.resistance_distance(graph, some, other, weight="weight", invert_weight=False)
    assert np.isclose(CommuteTimeDistance(laplacian).between(0, n - 1) ** 2, known, rtol=1e-12)
    values = np.linalg.eigvalsh(networkx.laplacian_matrix(graph).toarray().astype(float))[1:]
    assert np.isclose(kirchhoff_index(laplacian), n * (1 / values).sum(), rtol=1e-12)
    assert np.isclose(biharmonic_index(laplacian), n * (values**-2.0).sum(), rtol=1e-12)


def test_indices_of_a_graph_in_two_parts_are_infinite():
    laplacian = Graph.of(networkx.disjoint_union(networkx.path_graph(3), networkx.path_graph(4))).laplacian()
    assert kirchhoff_index(laplacian) == biharmonic_index(laplacian) == np.inf


def write_list(graph, path):
    lines = [f"{i},{j},{w!r}" for i, j, w in graph.edges(data="weight")]
    path.write_text("\n".join(["# friends", "from,to,weight", *lines, *(",".join(r.split(",")[1::-1] + r.split(",")[2:])
                                                                        for r in lines[:5])]))  # fmt: skip


def write_metis(graph, path):
    number = {node: k for k, node in enumerate(graph, 1)}
    lines = (" ".join(f"{number[j]} {graph[i][j]['weight']}" for j in graph[i]) for i in graph)
    path.write_text("\n".join([f"% weighted\n{len(graph)} {graph.number_of_edges()} 001", *lines]))


WRITERS = {
    "edges.csv": write_list,
    "graph.mtx": lambda graph, path: scipy.io.mmwrite(path, sp.coo_matrix(networkx.to_scipy_sparse_array(graph))),
    "graph.npz": lambda graph, path: sp.save_npz(path, sp.csr_matrix(networkx.to_scipy_sparse_array(graph))),
    "graph.graph": write_metis,
    "graph.graphml": lambda graph, path: networkx.write_graphml_xml(graph, path),
}


@pytest.mark.parametrize("name", WRITERS)
def test_every_file_of_a_graph_has_its_edges_and_weights(name, tmp_path):
    graph = networkx.les_miserables_graph()
    WRITERS[name](graph, tmp_path / name)
    found, expected = read_graph(tmp_path / name), Graph.of(graph)
    assert (len(found.nodes), found.n_edges) == (77, 254)
    assert np.isclose(kirchhoff_index(found.laplacian()), kirchhoff_index(expected.laplacian()), rtol=1e-12)
    if name in ("edges.csv", "graph.graphml"):
        a, b = (each.number("Valjean") for each in (found, expected))
        assert found.weights[a].sum() == expected.weights[b].sum()


def test_numbers_need_no_comma_and_loops_are_left_out(tmp_path):
    (tmp_path / "roads.txt").write_text("# from to\n7\t9\n9\t7\n9\t12\n12\t12\n")
    graph = read_graph(tmp_path / "roads.txt")
    assert (graph.nodes, graph.n_edges, graph.notes) == ([7, 9, 12], 2, ["1 loop left out"])
    assert graph.with_inverse_weights().weights.sum() == 4


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.csv", "a,b,1\nb,a,2\n", "from a to b has the weight 1 and back 2"),
        ("a.csv", "a,b,1\n\nb,c,x\n", "line 3: the weight 'x' is not a number"),
        ("a.csv", "a,b\nc\n", "line 2: an edge has two nodes"),
        ("a.csv", "a;b;1,5\nb;c;2,5\n", "line 1: the weight '1,5' is not a number"),
        ("a.csv", "1,2,5\n2,3\n", "line 2 has no weight, unlike lines before"),
        ("a.csv", "1,2,-1\n", "that of the edge from 1 to 2 is -1"),
        ("a.csv", "", "has no edge"),
        ("a.graph", "", "has no edge"),
        ("a.graph", "3 1\n2\n7\n\n", "an edge ends at node 7; nodes are numbered from 1 to 3"),
        ("a.graph", "3 2\n2\n1\n\n", "says that it has 3 nodes and 2 edges, and lists 1"),
        ("a.graphml", "<graphml><graph><edge source='x' target='y'/></graph></graphml>", "'x', which is no node"),
        ("a.mtx", "nothing", "cannot be read as Matrix Market"),
        ("a.npz", "nothing", "is not a sparse matrix of SciPy"),
        ("a.doc", "", "is not a file of a graph"),
    ],
)
def test_files_that_are_no_graph_are_refused_by_the_place(name, text, message, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(ParameterError, match=message):
        read_graph(tmp_path / name)


@pytest.mark.parametrize(
    ("graph", "message"),
    [
        (networkx.DiGraph([(0, 1)]), "directed"),
        (np.array([[0.0, 1.0], [2.0, 0.0]]), "symmetric"),
        (np.ones((2, 3)), r"\(n, n\)"),
        ("roads.csv", "'roads.csv' names a file; `read_graph` reads files"),
    ],
)
def test_what_is_no_undirected_graph_is_refused(graph, message):
    with pytest.raises(ParameterError, match=message):
        Graph.of(graph)


def test_distances_of_a_graph_ask_for_its_laplacian():
    known = networkx.path_graph(3)
    for graph in (known, Graph.of(known), Graph.of(known).weights):
        with pytest.raises(ParameterError, match=r"Graph\.of\(\.\.\.\)\.laplacian\(\)"):
            BiharmonicDistance(graph)
