"""`bihdist graph`: tables of distances between nodes, by their names."""

import csv
import io
import json

import networkx
import numpy as np
import pytest

from tests.commands import ran, refused


@pytest.fixture
def graph(tmp_path):
    path = tmp_path / "roads.csv"
    path.write_text("from,to,km\nBern,Basel,100\nBern,Chur,240\nBasel,Chur,200\nBern,Thun,30\n")
    return path


def green(power, inverted=True):
    edges = {("Bern", "Basel"): 100, ("Bern", "Chur"): 240, ("Basel", "Chur"): 200, ("Bern", "Thun"): 30}
    known = networkx.Graph()
    known.add_weighted_edges_from((a, b, 1 / w if inverted else w) for (a, b), w in edges.items())
    inverse = np.linalg.pinv(networkx.laplacian_matrix(known).toarray())
    return list(known), np.linalg.matrix_power(inverse, power)


def table(text):
    return list(csv.DictReader(io.StringIO(text)))


def square(power, a, b, inverted=True):
    names, g = green(power, inverted)
    i, j = names.index(a), names.index(b)
    return g[i, i] + g[j, j] - 2 * g[i, j]


def test_pairs_are_written_by_name_with_lengths_or_weights(graph, capsys):
    for words, inverted in [(["--lengths"], True), ([], False)]:
        said = ran(capsys, "graph", graph, "--pairs", "Bern:Basel,Thun:Chur", *words).out
        rows = table(said[said.index("a,b,") :])
        assert [(row["a"], row["b"]) for row in rows] == [("Bern", "Basel"), ("Thun", "Chur")]
        for row in rows:
            assert np.isclose(float(row["resistance"]), square(1, row["a"], row["b"], inverted), rtol=1e-12)
            assert np.isclose(float(row["biharmonic"]) ** 2, square(2, row["a"], row["b"], inverted), rtol=1e-12)


def test_all_nodes_from_some_and_all_edges_go_into_files(graph, tmp_path, capsys):
    out = tmp_path / "out.csv"
    ran(capsys, "graph", graph, "--sources", "Chur", "--distance", "power(alpha=3),resistance", "-o", out)
    for row in table(out.read_text()):
        expected = square(3, "Chur", row["node"], inverted=False)
        assert np.isclose(float(row["power(alpha=3) from Chur"]) ** 2, expected, rtol=1e-6, atol=1e-14)
        assert np.isclose(
            float(row["resistance from Chur"]), square(1, "Chur", row["node"], inverted=False), atol=1e-12
        )
    facts = json.loads(ran(capsys, "graph", graph, "--edges", "-o", out, "--json").out)
    assert (facts["n_nodes"], facts["n_edges"], facts["n_rows"]) == (4, 4, 4)
    for row in table(out.read_text()):
        assert np.isclose(float(row["biharmonic"]) ** 2, square(2, row["a"], row["b"], inverted=False), rtol=1e-9)


def test_without_a_question_it_says_what_the_graph_is(graph, capsys):
    said = ran(capsys, "graph", graph).out
    values = np.linalg.eigvalsh(green(1, inverted=False)[1])[1:]
    assert "4 nodes, 4 edges, 1 component" in said
    assert f"Kirchhoff index {4 * values.sum():.10g}, biharmonic index {4 * (values**2).sum():.10g}" in said


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--pairs", "Bern:Genf"], "has no node 'Genf'; its nodes begin with Bern, Basel, Chur"),
        (["--pairs", "Bern:Chur", "--distance", "geodesic"], "needs faces"),
        (["--edges", "--distance", "diffusion"], "goes with biharmonic"),
        (["--sources", "Bern", "-o", "out.ply"], "out.ply"),
    ],
)
def test_what_cannot_be_is_refused(graph, words, message, capsys):
    assert message in refused(capsys, "graph", graph, *words)


def test_a_node_without_edges_is_a_component_and_has_its_own_name_in_messages(tmp_path, capsys):
    (tmp_path / "three.graph").write_text("3 1\n2\n1\n\n")
    assert "3 nodes, 1 edge, 2 components" in ran(capsys, "graph", tmp_path / "three.graph").out
    said = refused(capsys, "graph", tmp_path / "three.graph", "--pairs", "1:3")
    assert "node 3 is joined to no other" in said


def test_pairs_may_be_lines_of_a_file(graph, tmp_path, capsys):
    (tmp_path / "pairs.txt").write_text("Bern,Chur\nThun,Basel\n")
    said = ran(capsys, "graph", graph, "--pairs", f"@{tmp_path / 'pairs.txt'}").out
    assert [row["b"] for row in table(said[said.index("a,b,") :])] == ["Chur", "Basel"]
    with pytest.raises(SystemExit):
        ran(capsys, "graph", graph, "--pairs", "Bern")
    assert "two nodes with a colon between" in capsys.readouterr().err
